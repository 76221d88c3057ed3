#!/usr/bin/env python3
"""How straight the cracks of a plate run, and whether they follow the directions of its mesh, from study.h5 alone.

usage: cracks_from_study.py STUDY/study.h5        of a campaign with output: {interfaces: true}

Prints a line a point, means over replicas with 95 % intervals: share of the vertices between two broken interfaces where a crack turns by
less than 15 degrees; mean of cos(8 angle), by length, over the broken interfaces and over all (1: all along multiples of 45 degrees).
"""
import math
import sys

import h5py
import numpy as np

from estimates_from_study import student_quantile


def along(vector):
    length = np.linalg.norm(vector, axis=1)
    return np.sum(length * np.cos(8 * np.arctan2(vector[:, 1], vector[:, 0]))) / length.sum()


def straight(ends, vector):
    """Of vertices with two broken interfaces; an interface leaves its first end along its vector, its second against it."""
    found = {}
    for k, (a, b) in enumerate(ends):
        found.setdefault(a, []).append(vector[k])
        found.setdefault(b, []).append(-vector[k])
    pairs = [p for p in found.values() if len(p) == 2]
    return np.mean([np.dot(a, b) < -math.cos(math.radians(15)) * np.linalg.norm(a) * np.linalg.norm(b) for a, b in pairs])


with h5py.File(sys.argv[1]) as study:
    of, offset, broke = study["realization/point"][:], study["interface/offset"][:], study["interface/break_time"][:]
    for p in np.unique(of):
        rows = {what: slice(*study[f"mesh/{what}_offset"][p:p + 2]) for what in ("node", "interface")}
        ends = study["mesh/interface_node"][rows["interface"]][:, :2]
        node = study["mesh/node_position"][rows["node"]]
        vector = node[ends[:, 1]] - node[ends[:, 0]]
        values = []
        for r in np.flatnonzero(of == p):
            broken = broke[offset[r]:offset[r + 1]] > 0  # 0: in a notch
            values.append((straight(ends[broken], vector[broken]), along(vector[broken]), along(vector)))
        n = len(values)
        half = student_quantile(0.975, n - 1) * np.std(values, axis=0, ddof=1) / math.sqrt(n)
        print(p, " ".join(f"{m:.3f} +- {h:.3f}" for m, h in zip(np.mean(values, axis=0), half)), sep="\t")
