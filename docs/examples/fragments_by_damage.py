#!/usr/bin/env python3
"""Fragments of a surface if interfaces counted as broken from a damage on, from study.h5 alone. fracas counts those of damage 1.

usage: fragments_by_damage.py STUDY/study.h5 DAMAGE...        of a campaign with output: {interfaces: true}

Prints a line a realization: point, replica, its largest damage below 1, then fragments by each damage.
"""
import sys

import h5py
import numpy as np


def parts(pairs, elements):
    """Number of parts that elements form when those of each pair hold together."""
    root = np.arange(elements)
    while True:
        one, other = root[pairs[:, 0]], root[pairs[:, 1]]
        apart = one != other
        if not apart.any():
            return len(np.unique(root))
        pairs = pairs[apart]
        np.minimum.at(root, np.maximum(one, other)[apart], np.minimum(one, other)[apart])
        while not np.array_equal(root, root[root]):
            root = root[root]


def main(path, damages):
    with h5py.File(path, "r") as study:
        mesh, record = study["mesh"], study["realization"]
        at, first = study["interface/offset"][:], mesh["interface_offset"][:]
        for i, (point, replica) in enumerate(zip(record["point"][:], record["replica"][:])):
            damage = study["interface/damage"][at[i] : at[i + 1]]
            pairs = mesh["interface_element"][first[point] : first[point + 1]]
            elements = mesh["element_offset"][point + 1] - mesh["element_offset"][point]
            broken = damage == 1
            counts = [parts(pairs[damage < limit], elements) for limit in damages]
            assert parts(pairs[~broken], elements) == record["fragments"][i]
            print(point, replica, "%.4g" % damage[~broken].max(initial=0), *counts, sep="\t")


if len(sys.argv) < 3:
    sys.exit(__doc__)
main(sys.argv[1], [float(d) for d in sys.argv[2:]])
