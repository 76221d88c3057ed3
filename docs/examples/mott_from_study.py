#!/usr/bin/env python3
"""Fragment sizes of each point of a study by Mott's length x0 = sqrt(2 P_F/(rho gamma))/edot (docs/theory/scaling-laws.md), P_F the mean
strength of an interface.

usage: fracas report STUDY --json | mott_from_study.py STUDY/study.h5

Prints a line a point: x0 [m], then means over replicas with their 95 % intervals: mean size by x0, share of the fragments from x0 to
2 x0, deviation of the sizes by their mean.
"""
import json
import math
import sys

import h5py
import numpy as np

from estimates_from_study import student_quantile

with h5py.File(sys.argv[1]) as study:
    strength, modulus, rate, young, density = (study["point/" + name][:] for name in (
        "derived.strength_mean", "derived.strength_modulus", "derived.strain_rate", "material.young", "material.density"))
    of, offset, size = study["realization/point"][:], study["fragment/offset"][:], study["fragment/size"][:]
for p, point in enumerate(json.load(sys.stdin)["points"]):
    x0 = math.sqrt(2 / (modulus[p] * young[p] * density[p])) * strength[p] / rate[p]
    found = []
    for r in np.flatnonzero(of == p):
        s = size[offset[r]:offset[r + 1]] / x0
        found.append((s.mean(), np.mean((s > 1) & (s < 2)), s.std() / s.mean()))
    n = len(found)
    half = student_quantile(0.975, n - 1) * np.std(found, axis=0, ddof=1) / math.sqrt(n)
    print(point["label"], f"x0 {x0:.4g}", " ".join(f"{m:.3f} +- {h:.3f}" for m, h in zip(np.mean(found, axis=0), half)), sep="\t")
