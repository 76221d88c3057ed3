#!/usr/bin/env python3
"""Masses, sizes and spins of all fragments of each point, from study.h5 alone: h5py and numpy, no code of fracas.

usage: fragments_from_study.py STUDY/study.h5 [THICKNESS]

Prints a line a point, tab-separated, in SI units; masses and spins without dust. With a thickness [m] also the shares of all fragments
that are narrower than it and than twice it.
"""
import sys

import h5py
import numpy as np

COLUMNS = ["fragments", "dust", "dust_mass", "mass", "mass_cv", "median_by_mean", "p90_by_mean", "elements", "spin_rms"]


def main(path, thickness=None):
    with h5py.File(path) as study:
        point, offset = study["realization/point"][:], study["fragment/offset"][:]
        fragment = {name: study["fragment/" + name][:] for name in ("mass", "size", "elements", "dust", "spin")}
    print("\t".join(["point"] + COLUMNS + (["below_h", "below_2h"] if thickness else [])))
    for p in np.unique(point):
        rows = np.concatenate([np.arange(offset[r], offset[r + 1]) for r in np.flatnonzero(point == p)])
        here = {name: values[rows] for name, values in fragment.items()}
        dust = here["dust"].astype(bool)
        large = here["mass"][~dust] if (~dust).any() else np.array([np.nan])
        mean = large.mean()
        values = [len(rows), dust.sum(), here["mass"][dust].sum() / here["mass"].sum(), mean, large.std() / mean, np.median(large) / mean,
                  np.quantile(large, 0.9) / mean, here["elements"].mean(), np.sqrt((here["spin"][~dust]**2).sum(axis=1).mean()) if (~dust).any() else np.nan]
        if thickness:
            values += [(here["size"] < thickness).mean(), (here["size"] < 2 * thickness).mean()]
        print("\t".join([str(p)] + [f"{v:d}" if isinstance(v, (int, np.integer)) else f"{v:.4g}" for v in values]))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) == 3 else None)
