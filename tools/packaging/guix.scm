;; SPDX-License-Identifier: GPL-3.0-or-later
;; Never run: see README.md there. From the top of the tree: guix build -f tools/packaging/guix.scm
(use-modules (guix packages) (guix gexp) (guix build-system cmake) ((guix licenses) #:prefix license:)
             (gnu packages maths) (gnu packages mpi) (gnu packages sqlite) (gnu packages serialization)
             (gnu packages ninja) (gnu packages pkg-config) (gnu packages tls) (gnu packages digest))

(package
  (name "fracas")
  (version "0.2.1")
  (source (local-file "../.." "fracas-checkout" #:recursive? #t))
  (build-system cmake-build-system)
  (arguments (list #:tests? #f #:configure-flags #~(list "-DBUILD_TESTING=OFF" "-DFRACAS_PDF=OFF")))
  (native-inputs (list pkg-config ninja))
  (inputs (list gsl hdf5 openmpi sqlite libyaml udunits random123 xxhash openssl))
  (home-page "SOURCE")
  (synopsis "Fracture campaign simulator")
  (description "Monte-Carlo fragmentation of bars, rings, plates and shells with cohesive interfaces.")
  (license license:gpl3+))
