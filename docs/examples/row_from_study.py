#!/usr/bin/env python3
"""How fast a crack along a row of edges runs, and how much softens beside the row, from study.h5 alone.

usage: row_from_study.py STUDY/study.h5 FROM TO        of a campaign with output: {interfaces: true}

Prints a line a point, for its first replica: speed [m/s] by least squares of the breaks with FROM < x < TO [m]; length broken [m]; damage by
length of the interfaces beside the row of the notch over that of the row, and both together over the length broken.
"""
import sys

import h5py
import numpy as np

begin, end = float(sys.argv[2]), float(sys.argv[3])
with h5py.File(sys.argv[1]) as study:
    of = study["realization/point"][:]
    for p in np.unique(of):
        place, ends = (study[f"mesh/{what}"][slice(*study[f"mesh/{rows}_offset"][p:p + 2])]
                       for what, rows in (("node_position", "node"), ("interface_node", "interface")))
        own = slice(*study["interface/offset"][np.flatnonzero(of == p)[0]:][:2])
        damage, time = study["interface/damage"][own], study["interface/break_time"][own]
        a, b = place[ends[:, 0]], place[ends[:, 1]]
        length, middle = np.linalg.norm(b - a, axis=1), 0.5 * (a + b)
        notch, broken = time == 0, time > 0
        row = abs(middle[:, 1] - np.median(middle[notch, 1])) < 1e-9
        soft = [np.sum((damage * length)[which & ~notch]) for which in (row, ~row)]
        within = broken & (middle[:, 0] > begin) & (middle[:, 0] < end)
        speed = np.polyfit(time[within], middle[within, 0], 1)[0] if within.sum() > 2 else np.nan
        all_broken = length[broken].sum()
        print(f"{p}\t{speed:.0f}\t{all_broken:.5f}\t{soft[1] / soft[0]:.2f}\t{sum(soft) / all_broken:.2f}")
