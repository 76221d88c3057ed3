#!/usr/bin/env python3
"""Largest and least principal stress of an element [Pa] at each instant of STUDY/fields, which `fields:` of a campaign writes.

usage: stress_from_fields.py STUDY [THICKNESS]        thickness [m] of a shell, whose fields have forces by length
"""
import glob
import sys

import h5py
import numpy as np

for path in sorted(glob.glob(f"{sys.argv[1]}/fields/*/body-*.hdf")):
    with h5py.File(path) as file:
        cells = file["VTKHDF/CellData"]
        s = cells["stress"][:] if "stress" in cells else cells["N"][:] / float(sys.argv[2])
    principal = np.linalg.eigvalsh(s[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3))  # xx, yy, zz, xy, yz, xz
    print(path, f"{principal.max():.4g} {principal.min():.4g}", sep="\t")
