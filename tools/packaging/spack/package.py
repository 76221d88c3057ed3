# SPDX-License-Identifier: GPL-3.0-or-later
# Never run: see README.md there.
from spack.package import *


class Fracas(CMakePackage):
    """Fracture campaign simulator: Monte-Carlo fragmentation of bars, rings, plates and shells."""

    git = "SOURCE"
    license("GPL-3.0-or-later")
    version("0.2.1", tag="0.2.1")

    depends_on("c", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("gsl")
    depends_on("hdf5~mpi")
    depends_on("mpi")
    depends_on("sqlite@3.37:")
    depends_on("libyaml")
    depends_on("udunits")
    depends_on("random123")
    depends_on("xxhash")
    depends_on("openssl")

    generator("ninja")

    def cmake_args(self):
        return [self.define("BUILD_TESTING", False), self.define("FRACAS_PDF", False)]
