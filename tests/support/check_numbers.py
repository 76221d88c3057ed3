"""Compares every number of STUDY/report/points.csv and summary.json with docs/examples/table_from_study.py, which has them from study.h5 alone.

usage: check_numbers.py STUDY SOURCE

A number that the script does not know is a fault: who adds a statistic adds its equation there, written without a look at ours.
"""
import csv
import json
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True


def same(ours, theirs):
    """Both sum up to 32 000 values of one sign: 32 000 x 1.1e-16 = 4e-12 relative at the very worst."""
    if ours is None:
        return math.isnan(theirs)
    return math.isclose(ours, theirs, rel_tol=1e-11, abs_tol=0)


def alike(ours, theirs):
    """Motion of rings: sines, and the cancellation in numpy's inertia of short arcs, 1e-16/(a^2/3), a > 1e-3."""
    return same(ours, theirs) or ours is not None and math.isclose(ours, theirs, rel_tol=1e-9, abs_tol=1e-9)


# How near a number has to be, where the first part of its key is not to the last digits.
NEAR = {key: alike for key in ("radial_velocity", "radial_scatter", "circumferential_velocity", "angular_velocity")}


def read(study, source):
    """What the script prints, as a dictionary a point."""
    script = os.path.join(source, "docs/examples/table_from_study.py")
    printed = subprocess.run([sys.executable, script, os.path.join(study, "study.h5")], check=True, capture_output=True,
                             text=True).stdout.splitlines()
    keys = printed[0].split("\t")
    return [dict(zip(keys, map(float, line.split("\t")), strict=True)) for line in printed[1:]]


def check_point(row, point, line):
    statistics, parameters = point["statistics"], point["parameters"]
    unknown = set(statistics) - set(row)
    assert not unknown, f"docs/examples/table_from_study.py must derive {sorted(unknown)} from study.h5, too"
    for key, value in row.items():
        near = NEAR.get(key.partition(".")[0], same)
        if key in statistics:
            assert near(statistics[key], value), (key, statistics[key], value)
            assert near(float(line[key]) if line[key] else None, value), (key, line[key], value)
        elif key in point["outcomes"]:
            assert point["outcomes"][key] == value == int(line["outcome." + key]), key
        else:
            assert key == "rate" and same(parameters.get("derived.strain_rate", parameters.get("loading.rate")), value), key
    assert line["hash"] == point["hash"] and int(line["replicas"]) == point["replicas"]
    for key, value in parameters.items():
        assert line[key] == value or line[key] == "" and value is None or math.isclose(float(line[key]), value, rel_tol=1e-14), key
    assert set(line) == set(statistics) | set(parameters) | {"outcome." + name for name in point["outcomes"]} | {"point", "hash", "replicas"}


def check(study, source):
    summary = json.load(open(os.path.join(study, "report/summary.json")))
    points = list(csv.DictReader(open(os.path.join(study, "report/points.csv"))))
    rows = read(study, source)
    for row, point, line in zip(rows, summary["points"], points, strict=True):
        check_point(row, point, line)
    return summary, rows


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(len(check(*sys.argv[1:])[1]), "points compared")
