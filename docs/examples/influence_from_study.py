#!/usr/bin/env python3
"""Which uncertain parameters decide into how many fragments a body breaks: from study.h5 alone, with h5py and numpy.

usage: influence_from_study.py STUDY/study.h5

Prints a line for each number that varies from point to point, tab-separated: its path; its rank correlation (Spearman) with the mean
count of fragments of a point; and the partial one, which holds the ranks of all other parameters fixed. Of n points without influence
the first is 0 +- 1/sqrt(n - 1).
"""
import sys

import h5py
import numpy as np

USABLE = {0: "FRAGMENTED", 1: "INTACT", 2: "TIME_LIMIT"}


def ranks(values):
    """From 0; values that are equal have the mean of their ranks."""
    _, which, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    return (last - (counts + 1) / 2)[which]


def mean_counts(study):
    """Mean over usable realizations of the number of fragments of each point."""
    realization = study["realization"]
    used = np.isin(realization["outcome"][()], list(USABLE))
    point, fragments = realization["point"][used], realization["fragments"][used]
    return np.array([fragments[point == p].mean() for p in range(len(study["point/hash"]))])


def influence(path):
    with h5py.File(path, "r") as study:
        columns = {name: column[()] for name, column in study["point"].items() if column.dtype.kind == "f"}
        counts = mean_counts(study)
    varied = [name for name, values in columns.items() if not name.startswith("derived.") and len(np.unique(values)) > 1]
    table = np.array([ranks(columns[name]) for name in varied] + [ranks(counts)])
    correlation = np.corrcoef(table)
    inverse = np.linalg.inv(correlation)
    return [(name, correlation[j, -1], -inverse[j, -1] / np.sqrt(inverse[j, j] * inverse[-1, -1])) for j, name in enumerate(varied)]


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print("parameter", "rank correlation", "partial", sep="\t")
    for name, whole, partial in influence(sys.argv[1]):
        print(name, f"{whole:+.3f}", f"{partial:+.3f}", sep="\t")
