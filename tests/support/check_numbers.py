"""Compares every number of STUDY/report/points.csv and summary.json with docs/examples/table_from_study.py, which has them from study.h5 alone.

usage: check_numbers.py STUDY SOURCE

A number that the script does not know is a fault: who adds a statistic adds its equation there, written without a look at ours.
"""
import csv
import json
import math
import os
import statistics
import subprocess
import sys

import numpy as np

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


def rank_of(share):
    return statistics.NormalDist().inv_cdf(min(max(share, 1e-6), 1 - 1e-6))


def is_end(ours, end, resampled):
    """An end of a bootstrap interval is where a share of the resamples is below it, as a normal quantile to five times the noise of the 2000
    that each of both programs draws: 0.58 standard deviations at a share of 0.025. Of few realizations the correction may be steep and the end at the
    least or the greatest resample, whatever the noise: three at most."""
    share, noise = end
    resampled = resampled[np.isfinite(resampled)]
    hair = 1e-11 * np.abs(resampled).max()
    if np.ptp(resampled) <= hair: # all alike
        return abs(ours - resampled[0]) <= hair
    below, to = (resampled < ours - hair).mean() - 1 / len(resampled), (resampled <= ours + hair).mean() + 1 / len(resampled)
    room = min(5 * math.sqrt(2) * noise, 3)
    return rank_of(below) - room <= rank_of(share) <= rank_of(to) + room


# What a difference of variances is compared with: those may be 1e3 times as large, and come from sums of 1e6 terms.
SCALE = {"variance.between": "variance.within.value", "variance.design_effect": "variance.group"}


def near(key, row, resamples, unsure):
    """How our value of the key is compared with that of the script."""
    name, _, part = key.rpartition(".")
    if part in ("low", "high") and name in resamples and math.isfinite(row[key]):
        resampled, ends = resamples[name]
        return lambda ours, _: ours is not None and is_end(ours, ends[part == "high"], resampled)
    if part in ("low", "high") and not key.startswith("variance.") and math.isfinite(row[key]): # value -+ t e: what it is made of is as exact, not what is left of it
        size = max(abs(row[name + ".value"]), abs(row[name + ".high"] - row[name + ".low"]))
        return lambda ours, theirs: ours is not None and abs(ours - theirs) <= 1e-10 * size
    if key.startswith("variance.") and math.isfinite(row[key]):
        scale = row[SCALE[name]] if name in SCALE else 1 if name == "variance.intraclass" else 0
        return lambda ours, theirs: ours is not None and math.isclose(ours, theirs, rel_tol=1e-9, abs_tol=1e-11 * scale)
    if part in ("deviation", "half_width") and name not in NEAR and math.isfinite(row.get(name + ".mean", math.nan)):
        floor = 1e-14 * abs(row[name + ".mean"]) # of equal values it is 0, or the rounding of their mean: 1e-16, times Student's t of few
        return lambda ours, theirs: same(ours, theirs) or ours is not None and abs(ours - theirs) <= floor
    if key in unsure:
        return lambda ours, _: ours in (0, 1)
    if key == "unconverged":
        return lambda ours, theirs: abs(ours - theirs) <= len(unsure)
    return NEAR.get(key.partition(".")[0], same)


def read(study, source):
    """What the script finds, and that it prints it."""
    sys.path.insert(0, os.path.join(source, "docs/examples"))
    import table_from_study
    printed = subprocess.run([sys.executable, table_from_study.__file__, os.path.join(study, "study.h5")], check=True, capture_output=True,
                             text=True).stdout.splitlines()
    found = table_from_study.table(os.path.join(study, "study.h5"))
    assert len(printed) == 1 + len(found)
    for (row, *_), line in zip(found, printed[1:]):
        assert printed[0].split("\t") == list(row) and line == "\t".join(f"{value:.15g}" for value in row.values())
    return found


def check_point(found, point, line):
    row, resamples, unsure = found
    ours, parameters = point["statistics"], point["parameters"]
    unknown = set(ours) - set(row)
    assert not unknown, f"docs/examples/table_from_study.py must derive {sorted(unknown)} from study.h5, too"
    for key, value in row.items():
        if key in ours:
            alike_of = near(key, row, resamples, unsure)
            assert alike_of(ours[key], value), (key, ours[key], value)
            cell = float(line[key]) if line[key] else None
            assert same(cell, math.nan if ours[key] is None else ours[key]) and alike_of(cell, value), (key, line[key], value)
        elif key in point["outcomes"]:
            assert point["outcomes"][key] == value == int(line["outcome." + key]), key
    assert same(parameters["derived.strain_rate"], row["rate"])
    assert line["hash"] == point["hash"] and int(line["replicas"]) == point["replicas"]
    for key, value in parameters.items():
        assert line[key] == value or line[key] == "" and value is None or math.isclose(float(line[key]), value, rel_tol=1e-14), key
    assert set(line) == set(ours) | set(parameters) | {"outcome." + name for name in point["outcomes"]} | {"point", "hash", "replicas"}


def check(study, source):
    """The summary, and the rows of the script."""
    summary = json.load(open(os.path.join(study, "report/summary.json")))
    points = list(csv.DictReader(open(os.path.join(study, "report/points.csv"))))
    found = read(study, source)
    for of, point, line in zip(found, summary["points"], points, strict=True):
        check_point(of, point, line)
    return summary, [row for row, *_ in found]


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(len(check(*sys.argv[1:])[1]), "points compared")
