"""Checks what the analysis wrote into a study against docs/examples/table_from_study.py and against the study itself.

usage: check_report.py STUDY SOURCE
STUDY holds study.h5, table.txt, summary.json and report/.
"""
import base64
import csv
import glob
import hashlib
import html
import html.parser
import json
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

import h5py
import numpy as np

study, source = sys.argv[1:3]
report = os.path.join(study, "report")
summary = json.load(open(os.path.join(study, "summary.json")))
sys.path.insert(0, os.path.join(source, "docs/examples"))
sys.dont_write_bytecode = True
from check_numbers import check, same
from check_summary import ENERGIES, check_fits, check_pages, check_series
from table_from_study import student_quantile

# Every key is on its page; the series and fits in it are those of the files beside it.
check_pages(summary, source)
for p, point in enumerate(summary["points"]):
    check_series(p, point, report)
    check_fits(p, point, study)

# The example script gives the numbers of the JSON summary, and those of points.csv.
written, rows = check(study, source)
assert written == summary and len(rows) == len(summary["points"])
# Why a number is not there.
for point in summary["points"]:
    assert (point["statistics"]["law.mott"] is None) == ("law.mott" in point["reasons"])

# Effects of parameters, from (estimators.29) and (estimators.30): rows of all settings, and of each where there are several.
def student_of(freedom):
    """The 0.975 quantile for any number of degrees of freedom, by x = sqrt(f) tan(a) and Simpson's rule."""
    whole = math.sqrt(math.pi) * math.gamma(freedom / 2) / (2 * math.gamma((freedom + 1) / 2)) if freedom < 300 else None
    if whole is None:  # Cornish and Fisher, to 1e-9
        z = 1.959963984540054
        return z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2) + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * freedom**3)
    low, high = 0.0, math.pi / 2
    for _ in range(60):
        middle = (low + high) / 2
        y = np.cos(np.linspace(0, middle, 2001)) ** (freedom - 1)
        part = middle / 6000 * (y[0] + y[-1] + 4 * y[1::2].sum() + 2 * y[2:-1:2].sum())
        low, high = (middle, high) if part < 0.475 * 2 * whole else (low, middle)
    return math.sqrt(freedom) * math.tan(low)

def effect_of(pairs, key):
    """Change, low, high, least, most over pairs of points."""
    of = [(rows[p], rows[q]) for p, q in pairs if rows[p][key + ".mean"] > 0 and rows[q][key + ".mean"] > 0]
    if not of:
        return [math.nan] * 5
    ratio = [b[key + ".mean"] / a[key + ".mean"] for a, b in of]
    serves = {p: sum(p in pair for pair in pairs if all(rows[q][key + ".mean"] > 0 for q in pair)) for pair in pairs for p in pair}
    u = [((c * rows[p][key + ".deviation"] / rows[p][key + ".mean"]) ** 2 / rows[p][key + ".n"], rows[p][key + ".n"]) for p, c in serves.items() if c]
    mean, v = sum(map(math.log, ratio)) / len(of), sum(x for x, n in u)
    freedom = v * v / sum(x * x / (n - 1) for x, n in u) if v > 0 else math.nan
    half = student_of(freedom) * math.sqrt(v) / len(of) if v > 0 else math.nan
    return [math.expm1(x) for x in (mean, mean - half, mean + half)] + [min(ratio) - 1, max(ratio) - 1]

with open(os.path.join(report, "effects.csv"), encoding="utf-8") as file:
    effects = list(csv.DictReader(file))
place, whole, each, said = 0, [], 0, 0
parameters = [point["parameters"] for point in summary["points"]]
names = {name for of in parameters for name in of if not name.startswith("derived.") and (name in summary["varying"] or not re.match("mesh|time", name))}
changing = [name for name in names if len({str(of.get(name)) for of in parameters}) > 1]
alike = lambda name, p, q: parameters[p].get(name) is None or parameters[q].get(name) is None or parameters[p][name] == parameters[q][name]
points = range(len(rows))
for path in summary["varying"]:
    value = [of.get(path) for of in parameters]
    others = [name for name in changing if name != path and not all(alike(name, p, q) for p in points for q in points if value[p] == value[q])]
    levels = list(dict.fromkeys(x for x in value if x is not None))
    levels = levels if isinstance(levels[0], str) else sorted(levels)
    steps = list(zip(levels, levels[1:])) if len(levels) <= 12 else []
    steps += [(levels[0], levels[-1])] * (len(steps) > 1 and not isinstance(levels[0], str))
    for a, b in steps:
        pairs = [(p, q) for p in range(len(rows)) for q in range(len(rows)) if (value[p], value[q]) == (a, b) and all(alike(name, p, q) for name in others)]
        known = [pair for pair in pairs if any(rows[i][key + ".mean"] > 0 for key in ("count", "size") for i in pair[:1]) and
                 any(rows[pair[0]][key + ".mean"] > 0 and rows[pair[1]][key + ".mean"] > 0 for key in ("count", "size"))]
        for group in [known] * bool(known) + [[pair] for pair in known] * (len(known) > 1):
            line = effects[place]
            place += 1
            assert line["parameter"] == path and int(line["settings"]) == len(group) and (line["at"] == "" or group is not known)
            whole += [line] * (group is known)
            if isinstance(a, str) or (a, b) == (levels[0], levels[-1]):
                each += group is not known
                said += group is known
            for key in ("count", "size"):
                for name, wanted in zip(("value", "low", "high", "least", "most"), effect_of(group, key)):
                    found = line[f"{key}_change.{name}"]
                    assert (found == "") == math.isnan(wanted) and (found == "" or abs(float(found) - wanted) < 1e-9 * (1 + abs(wanted))), (path, a, b, key, name, found, wanted)
assert place == len(effects)
assert [(e["parameter"], e["from"], e["to"], e["settings"]) for e in summary["effects"]] == [(e["parameter"], e["from"], e["to"], int(e["settings"])) for e in whole]

# What the checks below look at.
with h5py.File(study + "/study.h5", "r") as file:
    realization = {name: column[()] for name, column in file["realization"].items()}
    fragment = {name: column[()] for name, column in file["fragment"].items()}
model = [point["parameters"].get("model") for point in summary["points"]]

# Convergence: its last row is of all replicas, the rows before of the first 4, 8, 16, ...
convergence = list(csv.DictReader(open(os.path.join(report, "convergence.csv"))))
for p, row in enumerate(rows):
    of = [line for line in convergence if int(line["point"]) == p]
    usable = int(row["usable"])
    assert [int(line["replicas"]) for line in of] == [4 * 2**k for k in range(20) if 4 * 2**k < usable] + [usable] * (usable > 0)
    for name, key in (("count", "count.mean"), ("size", "size.mean"), ("fragment.mean", "fragment.mean.value")) if of else ():
        assert same(float(of[-1][name + ".value"]), row[key]), key

# Energies over time: at each time of the histories the first row at or after it, the last one beyond.
with h5py.File(study + "/study.h5", "r") as file:
    intervals = int(file.attrs.get("history", 0))
    history = {name: column[()] for name, column in file["history"].items()}
energies = list(csv.DictReader(open(os.path.join(report, "energies.csv"))))
for p, point in enumerate(summary["points"]):
    used = np.flatnonzero((realization["point"] == p) & (realization["outcome"] <= 2))
    of = [line for line in energies if int(line["point"]) == p]
    assert bool(of) == (intervals > 0 and len(used) > 0)
    for j, line in list(enumerate(of))[::7]:
        time = j * point["parameters"]["time.end"] / intervals
        assert same(float(line["time"]), time) and int(line["realizations"]) == len(used)
        begin, end = history["offset"][used], history["offset"][used + 1]
        place = [b + np.searchsorted(history["time"][b:e], time) for b, e in zip(begin, end)]
        assert int(line["running"]) == sum(at < e for at, e in zip(place, end))
        for name in ENERGIES:
            value = history[name][np.minimum(place, end - 1)]
            ends = (value.min(), value.max()) if len(used) < 20 else np.quantile(value, (0.05, 0.95))
            for which, expected in zip(("mean", "low", "high"), (value.mean(), *ends)):  # sums of both signs, and interpolation
                assert math.isclose(float(line[f"{name}.{which}"]), expected, rel_tol=1e-11, abs_tol=1e-12 * abs(value).max()), (name, which)

# Slopes: numpy's weighted fit of the points that the series of that name has.
MAKERS = ("loading.rate", "loading.radial", "loading.velocity")
others = [path for path in summary["varying"] if path not in MAKERS]
groups = {}
for row, point in zip(rows, summary["points"]):
    groups.setdefault(tuple(point["parameters"][path] for path in others), []).append(row)


def fisher_beyond(x, above, below):
    """P(F > x), by Gauss's rule over the angle whose sine squared is of the beta distribution."""
    end = math.asin(math.sqrt(below / (below + above * x)))
    node, weight = np.polynomial.legendre.leggauss(400)
    angle = end * (node + 1) / 2
    log = (below - 1) * np.log(np.sin(angle)) + (above - 1) * np.log(np.cos(angle))
    log += math.log(2) + math.lgamma((above + below) / 2) - math.lgamma(above / 2) - math.lgamma(below / 2)
    return float(np.sum(weight * np.exp(log)) * end / 2)


def known_of(group, of_what="size"):
    """The points of a line: log rate, log of the mean, error, degrees of freedom behind it, whether its variance is shared, and the freedom of that (or None)."""
    of = [row for row in group if row["rate"] > 0 and row["size.mean"] > 0 and row["count.mean"] != 1 and row[of_what + ".mean"] > 0]
    n = np.array([row[of_what + ".n"] for row in of], float)
    relative = np.array([row[of_what + ".deviation"] / row[of_what + ".mean"] if row[of_what + ".n"] > 1 else 0 for row in of])**2
    behind = n - 1
    few = n < 8
    together = None
    if any(behind > 0) and any(few):
        every = np.average(relative, weights=behind)
        together = sum(behind[few])
        own = np.average(relative[few], weights=behind[few]) if together else 0
        relative[few] = max(own, every) if together < 4 or not own else own
        together = together or sum(behind)
        behind[few] = together
    x, y = (np.array([math.log(row[key]) for row in of]) for key in ("rate", of_what + ".mean"))
    used = relative > 0
    return x[used], y[used], np.sqrt(relative / n)[used], behind[used], few[used], together if any(used & few) else None, (x, y)


def misfit_of(chi2, freedom, derivative, error, behind, few):
    """Of a least-squares fit: rows of derivative are d(fitted)/d(constants)."""
    if all(few):
        return fisher_beyond(chi2 / freedom, freedom, behind[0])
    weighted = derivative / error[:, None]
    kept = 1 - np.einsum("ia,ia->i", weighted @ np.linalg.inv(weighted.T @ weighted), weighted)
    a = np.sum((kept**2 / behind)[~few])
    if any(few):
        a += (np.sum(kept[few])**2 + np.sum(kept[few]**2)) / (2 * behind[few][0])
    return fisher_beyond(chi2 / (freedom + 2 * a - 6 * a / (freedom + 2)), freedom, freedom * (freedom + 2) / (3 * a))


def slope(group, of_what="size"):
    x, y, sigma, behind, few, together, everything = known_of(group, of_what)
    weighted = len(x) > 0
    if not weighted:
        x, y = everything
        sigma = np.ones(len(x))
    if len(x) < 3 or np.ptp(x) == 0:
        return None
    (exponent, _), covariance = np.polyfit(x, y, 1, w=1 / sigma, cov="unscaled")
    chi2 = np.sum(((y - np.polyval(np.polyfit(x, y, 1, w=1 / sigma), x)) / sigma)**2)
    freedom = len(x) - 2
    error = math.sqrt(covariance[0, 0] * max(1 if weighted else 0, chi2 / freedom))
    half_width = student_quantile(0.975, freedom) * error
    if not weighted:
        return len(x), exponent, error, half_width, None, None, None
    misfit = misfit_of(chi2, freedom, np.stack((np.ones(len(x)), x), axis=1), sigma, behind, few)
    return len(x), exponent, error, half_width, chi2, misfit, together


def slopes(of_what):
    """Of each series, if there are several, and of all points."""
    series = [slope(group, of_what) for group in groups.values()] if len(groups) > 1 else []
    return [fit for fit in [*series, slope(rows, of_what)] if fit] if slope(rows, of_what) else []


def check_slopes(listed, expected, sign):
    assert len(listed) == len(expected)
    for ours, theirs in zip(listed, expected):
        assert ours["points"] == theirs[0] and (ours["mott"] is None or ours["mott"] == -sign and math.isclose(ours["grady"], -sign * 2 / 3))
        for key, value in zip(("slope", "standard_error", "half_width", "chi2", "misfit", "pooled_freedom"), theirs[1:]):
            assert ours[key] is value is None or math.isclose(ours[key], value, rel_tol=1e-7, abs_tol=1e-12), (key, ours[key], value)  # numpy solves by SVD


expected = slopes("size")
mixed = sum(any(row["rate"] > 0 and row["size.mean"] > 0 and row["count.mean"] != 1 for row in group) for group in groups.values())
for i, ours in enumerate(summary["slopes"], 1):
    last = i == len(expected)
    assert ours["mixes"] == (mixed if last else 1) and (not last or ours["series"] == "all points" + f", {mixed} series mixed" * (mixed > 1))
assert ("series, which differ in more than the strain rate" in open(os.path.join(report, "index.html"), encoding="utf-8").read()) == (
    bool(expected) and mixed > 1)
check_slopes(summary["slopes"], expected, 1)
check_slopes(summary["count_slopes"], slopes("count"), -1)
much = any(row["dust_share"] > 0.05 for row in rows)
check_slopes(summary["count_large_slopes"], slopes("count_large") if much else [], -1)
has_length = [math.isfinite(point["parameters"].get("derived.length") or math.nan) for point in summary["points"]]
for of in summary["slopes"] + summary["count_slopes"] + summary["count_large_slopes"] if len(set(has_length)) == 1 else []:
    assert (of["mott"] is not None) == (of["grady"] is not None) == has_length[0]

# Slopes between neighbouring rates, in the summary and the file.
expected, certain = [], []  # certain: whether there is an interval, and its freedom
for group in groups.values():
    of = sorted((row for row in group if row["rate"] > 0 and not math.isnan(row["size.mean"])), key=lambda row: row["rate"])
    for low, high in zip(of, of[1:]):
        x = math.log(high["rate"] / low["rate"])
        if x > 1e-9 and low["count.mean"] != 1 and high["count.mean"] != 1:
            errors = [(row["size.deviation"] / row["size.mean"])**2 / row["size.n"] for row in (low, high)]
            expected.append((low["rate"], high["rate"], math.log(high["size.mean"] / low["size.mean"]) / x,
                             math.sqrt(sum(errors)) / x))
            n = [row["size.n"] for row in (low, high)]
            some = min(n) > 1 and (sum(errors) > 0 or min(n) >= 8)
            freedom = sum(errors)**2 / sum(v**2 / (m - 1) for v, m in zip(errors, n)) if some and sum(errors) > 0 else None
            certain.append((some, freedom))
assert len(summary["windows"]) == len(expected)
lines = [line for line in csv.DictReader(open(os.path.join(report, "slopes.csv")))]
of_counts = summary["count_slopes"] + summary["count_large_slopes"]
assert len(lines) == len(summary["slopes"]) + len(expected) + len(of_counts)
assert [line["kind"] for line in lines[len(lines) - len(of_counts):]] == (
    ["count"] * len(summary["count_slopes"]) + ["count_large"] * len(summary["count_large_slopes"]))
for ours, line in zip(summary["slopes"] + of_counts, lines[:len(summary["slopes"])] + lines[len(lines) - len(of_counts):]):
    for key in ("slope", "standard_error", "half_width", "chi2", "misfit", "pooled_freedom"):
        assert ours[key] is None and line[key] == "" or math.isclose(ours[key], float(line[key]), rel_tol=1e-12), key
for ours, line, theirs in zip(summary["windows"], lines[len(summary["slopes"]):], expected):
    for key, value in zip(("from_rate", "to_rate", "slope", "standard_error"), theirs):
        for mine in (ours[key], float(line[key]) if line[key] else None):
            assert mine is None and math.isnan(value) or math.isclose(mine, value, rel_tol=1e-9), (key, mine, value)

for ours, (some, freedom) in zip(summary["windows"], certain):
    assert (ours["half_width"] is not None) == some
    if freedom:
        assert math.isclose(fisher_beyond((ours["half_width"] / ours["standard_error"])**2, 1, freedom), 0.05, rel_tol=1e-6)

# Crossovers: chi2 is that of the constants, and the least about them.
used = [known_of(group) for group in groups.values() if any(row["rate"] > 0 and not math.isnan(row["size.mean"]) for row in group)]
assert len(summary["crossovers"]) == len(used)
for fit, of in zip(summary["crossovers"], used):
    x, y, error, behind, few, together, _ = of
    assert fit["points"] == len(x) and (fit["reason"] is None) == (fit["rate"]["value"] is not None)
    if fit["reason"] is not None:
        continue

    def chi2(size, rate, k):
        return np.sum(((y - math.log(size) + np.logaddexp(0, k * (x - math.log(rate)))) / error)**2)

    best = np.array([fit["size"]["value"], fit["rate"]["value"], -fit["high_exponent"]["value"]])
    assert math.isclose(chi2(*best), fit["chi2"], rel_tol=1e-9)
    for step in np.vstack((np.eye(3), -np.eye(3))) * 1e-3:
        assert chi2(*(best * (1 + step))) > fit["chi2"]
    z = -best[2] * (math.log(best[1]) - x)
    soft = 1 / (1 + np.exp(-z))
    derivative = np.stack((np.ones(len(x)), soft * best[2], -soft * z), axis=1)  # by the logarithms of the constants
    misfit = misfit_of(fit["chi2"], len(x) - 3, derivative, error, behind, few)
    assert math.isclose(fit["misfit"], misfit, rel_tol=1e-5) and fit["pooled_freedom"] == together
    assert math.isclose(fit["inflation"], max(1, math.sqrt(fit["chi2"] / (len(x) - 3))), rel_tol=1e-9)
    for name in ("size", "rate", "high_exponent"):
        assert fit[name]["low"] < fit[name]["value"] < fit[name]["high"]
        assert 0 < 2 * fit[name]["standard_error"] < fit[name]["high"] - fit[name]["low"]

# So does the SQL example, from the index, as far as the index goes.
if shutil.which("sqlite3"):
    with open(os.path.join(source, "docs/examples/table_from_index.sql")) as script:
        printed = subprocess.run(["sqlite3", "-json", study + "/index.sqlite"], stdin=script, check=True,
                                 capture_output=True, text=True).stdout
    for row, point, line in zip(rows, summary["points"], json.loads(printed), strict=True):
        assert line["point"] == point["hash"]
        assert [line["planned"], line["done"] + line["failed"]] == [row["realizations"]] * 2
        assert line["used"] == row["usable"] and line["failed"] == row["FAILED"]
        for key, unit in (("count", ""), ("dissipated", "_J")):
            assert same(line[f"{key}_mean{unit}"], row[key + ".mean"])
            assert same(line[f"{key}_deviation{unit}"], row[key + ".deviation"])
else:
    print("not checked: table_from_index.sql, for want of the sqlite3 shell")

# The terminal table shows those numbers: each to half a unit of its last digit (and a hair: ties round to even).
UNIT = {"n": 1e-9, "u": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3}
text = open(os.path.join(study, "table.txt")).read().splitlines()
size_unit, energy_unit = (UNIT[re.findall(r"\[(\w?)%s\]" % unit, text[1])[-1]] for unit in "mJ")  # after the parameters


def shows(cell, value, unit=1.0):
    if cell == "-":
        assert math.isnan(value), (cell, value)
        return
    mantissa, _, exponent = cell.partition("e")
    last = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    assert abs(float(cell) - value / unit) <= 0.5 * last * (1 + 1e-6), (cell, value / unit)


for row, line in zip(rows, text[2:]):
    cells = line.replace(" +- ", "+-").split()[len(summary["varying"]) + ("strain rate" in text[0]):]
    assert [int(cells[0]), int(cells[1])] == [row["usable"], row["unusable"]]
    units = {"count": 1.0, "size": size_unit, "dissipated": energy_unit}
    for cell, (key, unit) in zip(cells[2:5], units.items()):
        mean, _, half_width = cell.partition("+-")
        shows(mean, row[key + ".mean"], unit)
        if mean != "-":
            shows(half_width, row[key + ".half_width"], unit)
    laws = ("law.zmr", "law.grady", "law.glenn_chudnovsky") + ("law.mott",) * ("Mott" in text[0])
    for cell, key in zip(cells[5:], laws):
        shows(cell, row[key], size_unit)
    shows(cells[5 + len(laws)], row["size.mean"] / row["law.zmr"])
    shows(cells[6 + len(laws)], row["residual"])
    shows(cells[7 + len(laws)], row["created"])

# A line of fragments.csv for each fragment of the study, with its numbers to 15 digits.
size, mass, position, spin = (fragment[name] for name in ("size", "mass", "position", "spin"))
fragments = list(csv.DictReader(open(os.path.join(report, "fragments.csv"))))
assert len(fragments) == len(size)
for line, expected, heavy, place, turning in zip(fragments, size, mass, position, spin):
    assert math.isclose(float(line["size"]), expected, rel_tol=1e-14)
    assert math.isclose(float(line["mass"]), heavy, rel_tol=1e-14)
    assert math.isclose(float(line["position_x"]), place[0], rel_tol=1e-14)
    assert all(math.isclose(float(line["spin_" + axis]), turning[i], rel_tol=1e-14) for i, axis in enumerate("xyz"))

# Every SVG is well-formed; with the size figures, a mark for each row of data.
with_mean = sum(not math.isnan(row["size.mean"]) for row in rows)
SVG = "{http://www.w3.org/2000/svg}"


def drawings(name):
    """A figure of more than six series is of several drawings: NAME, NAME-2, ..."""
    return [name] + [f"{name}-{k}" for k in range(2, 13) if os.path.exists(os.path.join(report, f"{name}-{k}.svg"))]


def found(name, what):
    return [each for one in drawings(name) for each in xml.parse(os.path.join(report, one + ".svg")).findall(f".//{SVG}path[@class={what}")]


def marks(name):
    return len(found(name, "'mark']"))


for name in glob.glob(os.path.join(report, "*.svg")):
    xml.parse(name)
PDF = "PDF</a>" in open(os.path.join(report, "index.html"), encoding="utf-8").read()  # not in a program without librsvg
drawn = {name[:-4] for name in os.listdir(report) if name.endswith(".svg")}
assert {name[:-4] for name in os.listdir(report) if name.endswith(".pdf")} == (drawn if PDF else set())
assert marks("count-against-rate") == with_mean
assert marks("size-against-rate") == marks("size-against-rate-normalised") == with_mean
assert len(glob.glob(os.path.join(report, "sizes-point-*.svg"))) == with_mean
assert len(glob.glob(os.path.join(report, "energies-point-*.svg"))) == with_mean
together = found("sizes", f"'line']/{SVG}title")
assert len(together) == with_mean

# The data of each chart: of the means, the numbers of the summary; of the sizes, the fragments themselves.
def data(name):
    lines = []
    for one in drawings(name):
        with open(os.path.join(report, one + ".csv"), encoding="utf-8") as file:
            head, *more = csv.reader(file)
            lines += more
    assert head[:3] == ["panel", "series", "kind"] and head[5:] == ["low", "high"]
    return head, lines


if with_mean:
    head, lines = data("size-against-rate")
    unit = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3}[re.fullmatch(r"mean fragment size \[(.?)m\]", head[4]).group(1)]
    assert head[3] == "strain rate [1/s]"
    means = sorted(tuple(map(float, line[3:5])) + tuple(float(field) if field else math.nan for field in line[5:]) for line in lines
                   if line[2] == "mark")
    wanted = sorted((row["rate"], row["size.mean"], row["size.mean"] - row["size.half_width"], row["size.mean"] + row["size.half_width"])
                    for row in rows if not math.isnan(row["size.mean"]))
    assert len(means) == len(wanted) == with_mean
    for ours, theirs in zip(means, wanted):
        assert all(math.isclose(a * b, c, rel_tol=1e-13) or (math.isnan(a) and math.isnan(c)) for a, b, c in zip(ours, (1, unit, unit, unit), theirs))
    assert {line[1] for line in lines if line[2] == "curve"} <= {"ZMR", "Grady", "GC", "ZMR-2", "fitted crossover", ""}
    # Counts with and, where there is any, without dust; the lines pass through what the summary has of them.
    head, lines = data("count-against-rate")
    assert head[3:5] == ["strain rate [1/s]", "mean number of fragments"]
    for key, which in (("count", False), ("count_large", True)):
        means = sorted(tuple(float(field or "nan") for field in line[3:]) for line in lines if line[2] == "mark" and line[1].endswith(", without dust") == which)
        wanted = sorted((row["rate"], row[key + ".mean"], row[key + ".mean"] - row[key + ".half_width"], row[key + ".mean"] + row[key + ".half_width"])
                        for row in rows if row[key + ".mean"] > 0)
        wanted = [] if which and not much else wanted
        assert len(means) == len(wanted) and np.allclose(means, wanted, rtol=1e-13, equal_nan=True)
    for of in summary["count_slopes"] if len(groups) == 1 else []:
        x, y = np.array([[math.log(float(field)) for field in line[3:5]] for line in lines if line[2] == "curve"]).T
        assert np.allclose(np.diff(y) / np.diff(x), of["slope"], rtol=1e-9)
usable = [np.flatnonzero((realization["point"] == p) & (realization["outcome"] <= 2)) for p in range(len(rows))]
for p, at in enumerate(usable):
    sizes = np.sort(np.concatenate([size[slice(*fragment["offset"][i:i + 2])] for i in at])) if len(at) else np.array([])
    if not len(sizes):
        continue
    head, lines = data(f"sizes-point-{p}")
    unit = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3}[re.fullmatch(r"fragment size s \[(.?)m\]", head[3]).group(1)]
    values = np.array([[float(field) for field in line[3:5]] for line in lines])
    first = np.concatenate([[True], np.diff(sizes) > 1e-9 * sizes[1:]])  # those that differ by rounding are one
    assert len(values) == first.sum() and {line[2] for line in lines} == {"steps"}
    assert np.allclose(values[:, 0] * unit, sizes[first], rtol=1e-9, atol=0)
    assert np.allclose(values[:, 1], 1 - np.flatnonzero(first) / len(sizes), rtol=1e-12, atol=0)

# Fragments of a body by mass: all points, dust among them; left of a mark all are dust.
if os.path.exists(os.path.join(report, "masses.csv")):
    head, lines = data("masses")
    kilogram = {"p": 1e-15, "n": 1e-12, "µ": 1e-9, "m": 1e-6, "": 1e-3, "k": 1.0}[re.fullmatch(r"fragment mass m \[(.?)g\]", head[3]).group(1)]
    step = [np.array([float(field) for field in line[3:5]]) for line in lines if line[2] == "steps"]
    dust_ends = [(float(line[3]) * kilogram, float(line[4])) for line in lines if line[2] == "mark"]
    for p, at in enumerate(usable):
        of = [slice(*fragment["offset"][i:i + 2]) for i in at]
        heavy, dust = (np.concatenate([column[where] for where in of] or [[]]) for column in (mass, fragment["dust"]))
        if not len(heavy):
            continue
        ascending = np.sort(heavy)
        first = np.concatenate([[True], np.diff(ascending) > 1e-9 * ascending[1:]])
        mine, step = np.array(step[:first.sum()]), step[first.sum():]
        assert np.allclose(mine[:, 0] * kilogram, ascending[first], rtol=1e-9, atol=0)
        assert np.allclose(mine[:, 1], (len(heavy) - np.flatnonzero(first)) / len(at), rtol=1e-12, atol=0)
        assert math.isclose(mine[0, 1], rows[p]["count.mean"], rel_tol=1e-12)
        if any(dust == 0) and min(heavy[dust == 0]) > ascending[0] * (1 + 1e-9):
            end, number = dust_ends.pop(0)
            assert math.isclose(end, min(heavy[dust == 0]), rel_tol=1e-13) and math.isclose(number, (heavy * (1 + 1e-9) >= end).sum() / len(at), rel_tol=1e-12)
    assert not step and not dust_ends

PREFIX = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3, "M": 1e6}


def unit_of(label, symbol):
    return PREFIX[re.search(rf"\[(.?){symbol}\]$", label).group(1)]


# Bands of energies are those of energies.csv; a ring's kinetic energy less what it begins with.
for p in range(len(rows)):
    of = [line for line in energies if int(line["point"]) == p]
    if not os.path.exists(os.path.join(report, f"bands-point-{p}.csv")):
        assert not of or int(of[0]["realizations"]) < 2
        continue
    head, lines = data(f"bands-point-{p}")
    curves = [name for name in ENERGIES if name != "created" and  # friction, bending and damping where they are
              (name not in ("dissipated_bending", "friction", "damped") or any(float(row[f"{name}.high"]) > 0 for row in of))]
    assert len(lines) == len(curves) * len(of) and {line[2] for line in lines} == {"band"}
    second, joule = unit_of(head[3], "s"), unit_of(head[4], "J")
    for e, name in enumerate(curves):
        start = float(of[0]["kinetic.mean"]) if name == "kinetic" and float(of[0]["time"]) == 0 else 0
        for line, row in zip(lines[e * len(of):], of):
            assert line[1] == name.replace("_", ", ", 1) + (" - start" if start > 0 else "")
            assert math.isclose(float(line[3]) * second, float(row["time"]), rel_tol=1e-13)
            for field, key in ((4, "mean"), (5, "low"), (6, "high")):  # the start is taken off: rounding of that
                assert math.isclose(float(line[field]) * joule, float(row[f"{name}.{key}"]) - start, rel_tol=1e-12, abs_tol=1e-14 * start + 1e-300)

# Convergence in per cent of the last, for numbers that are not 0.
for p in range(len(rows)):
    of = [line for line in convergence if int(line["point"]) == p]
    if len(of) < 2:
        assert not os.path.exists(os.path.join(report, f"convergence-point-{p}.csv"))
        continue
    head, lines = data(f"convergence-point-{p}")
    keys = [key[:-6] for key in of[0] if key.endswith(".value") and of[-1][key] and float(of[-1][key]) != 0]
    assert [line[1] for line in lines[::len(of)]] == keys and len(lines) == len(keys) * len(of)
    for line, (key, row) in zip(lines, ((key, row) for key in keys for row in of)):
        assert float(line[3]) == int(row["replicas"])
        assert math.isclose(float(line[4]), 100 * (float(row[key + ".value"]) / float(of[-1][key + ".value"]) - 1), rel_tol=1e-9, abs_tol=1e-11)

# Fits, where there are any: shares above the cut, and the survival functions of their parameters.
SURVIVAL = {
    "exponential": lambda x, of: np.exp(-x / of["mu"]),
    "rayleigh": lambda x, of: np.exp(-x**2 / (2 * of["sigma"]**2)),
    "shifted-rayleigh": lambda x, of: np.exp(-np.maximum(x - of["x0"], 0)**2 / (2 * of["sigma"]**2)),
    "weibull": lambda x, of: np.exp(-(x / of["lambda"])**of["k"]),
    "weibull-3": lambda x, of: np.exp(-(np.maximum(x - of["x0"], 0) / of["lambda"])**of["k"]),
    "lognormal": lambda x, of: np.array([math.erfc((math.log(v) - math.log(of["m"])) / (of["sigma"] * math.sqrt(2))) / 2 for v in x]),
}
if os.path.exists(os.path.join(study, "fits.csv")):
    fits = list(csv.DictReader(open(os.path.join(study, "fits.csv"))))
    checked = 0
    for p, at in enumerate(usable):
        of = {(row["family"], row["quantity"]): float(row["value"]) for row in fits if row["point"] == str(p) and row["value"]}
        if ("data", "cut") not in of or not os.path.exists(os.path.join(report, f"fits-point-{p}.csv")):
            continue
        head, lines = data(f"fits-point-{p}")
        metre, cut = unit_of(head[3], "m"), of["data", "cut"]
        sizes = np.sort(np.concatenate([size[slice(*fragment["offset"][i:i + 2])] for i in at]))
        sizes = sizes[sizes > cut]
        steps = np.array([[float(field) for field in line[3:5]] for line in lines if line[2] in ("steps", "mark")])
        first = np.concatenate([[True], np.diff(sizes) > 1e-9 * sizes[1:]])
        assert np.allclose(steps[:, 0] * metre, sizes[first] - of["data", "lattice"] / 2, rtol=1e-9, atol=0)
        assert np.allclose(steps[:, 1], 1 - np.flatnonzero(first) / len(sizes), rtol=1e-12, atol=0)
        best = sorted((value, family) for (family, quantity), value in of.items() if quantity == "rank")[:3]
        assert list(dict.fromkeys(line[1] for line in lines if line[2] == "curve")) == [family for _, family in best]
        for _, family in best:
            if family in SURVIVAL:
                curve = np.array([[float(field) for field in line[3:5]] for line in lines if line[1] == family])
                parameters = {quantity: value for (name, quantity), value in of.items() if name == family}
                wanted = SURVIVAL[family](curve[:, 0] * metre, parameters) / SURVIVAL[family](np.array([cut]), parameters)
                assert np.allclose(curve[:, 1], wanted, rtol=1e-9, atol=1e-300), family
                checked += 1
    assert checked > 0

# Crack patterns: of rings with a FRAGMENTED realization, six at most with the first and the last; a band a fragment.
rings = [p for p, name in enumerate(model) if name == "ring" and summary["points"][p]["outcomes"]["FRAGMENTED"] > 0]
pictures = sorted(int(re.search(r"(\d+)\.svg", name).group(1)) for name in glob.glob(report + "/pattern-point-*.svg"))
assert len(pictures) == min(6, len(rings)) and set(pictures) <= set(rings)
assert not rings or pictures[0] == rings[0] and pictures[-1] == rings[-1]
for p in pictures:
    i = np.flatnonzero((realization["point"] == p) & (realization["outcome"] == 0))[0]
    of = {name: column[slice(*fragment["offset"][i:i + 2])] for name, column in fragment.items() if name != "offset"}
    radius = summary["points"][p]["parameters"]["geometry.radius"]
    lines = list(csv.DictReader(open(os.path.join(report, f"pattern-point-{p}.csv"))))
    assert sorted(int(line["fragment"]) for line in lines) == list(range(len(of["mass"])))
    angles = [float(line["angle"]) for line in lines]
    assert angles == sorted(angles)
    drawing = xml.parse(os.path.join(report, f"pattern-point-{p}.svg"))
    bands = drawing.findall(f".//{SVG}path")
    bands = [path for path in bands if path.get("class").startswith("band ")]
    assert len(bands) == len(lines) == realization["fragments"][i]
    assert len(drawing.findall(f".//{SVG}circle[@class='dust']")) == of["dust"].sum()
    arrows = drawing.findall(f".//{SVG}path[@class='ink']")
    moving = [line for line in lines if line["dust"] == "0"]
    fastest = max(math.hypot(float(line["relative_radial"]), float(line["relative_circumferential"])) for line in moving)
    for line in moving if len(lines) <= 60 else []:
        x, y = (float(line["relative_" + name]) * 30 / fastest for name in ("radial", "circumferential"))
        if math.hypot(x, y) > 1.5:  # pixels
            begin = [float(number) for number in re.findall(r"-?[\d.]+", arrows.pop(0).get("d"))][:4]
            c, s = math.cos(float(line["angle"])), math.sin(float(line["angle"]))
            assert math.hypot(begin[2] - begin[0] - (x * c - y * s), begin[3] - begin[1] + (x * s + y * c)) < 0.03
    assert not arrows
    colours = [path.get("class") for path in bands]
    assert all(a != b for a, b in zip(colours, colours[1:] + colours[:1])) or len(colours) < 2
    scale = float(drawing.find(f".//{SVG}circle[@class='axis']").get("r")) / radius
    exaggeration = {round(float(line["drawn_displacement"]) / float(line["displacement"]), 6) for line in lines}
    assert len(exaggeration) == 1
    for line, path in zip(lines, bands):
        f = int(line["fragment"])
        x, y = of["position"][f, :2]
        half, distance, angle = of["size"][f] / (2 * radius), math.hypot(x, y), math.atan2(y, x)
        assert math.isclose(float(line["angle"]), angle, rel_tol=1e-12, abs_tol=1e-12)
        assert math.isclose(float(line["displacement"]), distance - radius * math.sin(half) / half, rel_tol=1e-9,
                            abs_tol=1e-12 * radius)
        # The band: the ends of its arcs are as far apart as the fragment is long, and it lies where it was pushed.
        place = [float(number) for number in re.findall(r"-?[\d.]+", path.get("d"))]
        ends = np.array([place[0:2], place[7:9], place[9:11], place[16:18]]) - 235
        assert place[4:7] == [0, half > math.pi / 2, 0] and place[13:16] == [0, half > math.pi / 2, 1]
        outer = place[2] / scale / radius
        chord = np.linalg.norm(ends[1] - ends[0]) / (2 * outer * scale * radius)
        assert abs(chord - math.sin(half)) < 0.03 / (outer * scale * radius), (chord, half)  # coordinates to 0.01
        push = exaggeration.copy().pop() * (distance - radius * math.sin(half) / half)
        middle = (ends[0] + ends[1]) / 2 / scale * [1, -1]
        far = outer * radius * math.cos(half) + push
        assert np.linalg.norm(middle - [far * math.cos(angle), far * math.sin(angle)]) * scale < 0.03


# The page: the same marks with either axes, a table row a point, numbered captions, balanced, and nothing fetched from elsewhere.
class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.marks, self.rows, self.links, self.bands = [], {}, {}, [], 0
        self.lists, self.warnings, self.captions, self.cells, self.scripts = [], 0, [], {}, 0

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "figure":  # frames of films have no name
            self.figure = attributes.get("id")
        if attributes.get("class") == "mark":
            self.marks[self.figure] = self.marks.get(self.figure, 0) + 1
        self.bands += str(attributes.get("class")).startswith("band ")
        if tag == "table":
            self.table = attributes["id"]
        if tag == "tr" and "tbody" in self.open:
            self.rows[self.table] = self.rows.get(self.table, 0) + 1
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]
        if tag == "script":
            assert not attributes  # its text is on the page
            self.scripts += 1
        self.warnings += tag == "li" and "warnings" in self.lists
        if tag == "ul":
            self.lists.append(attributes.get("class"))
        if tag == "figcaption":
            self.captions.append("")
        if tag in ("td", "th"):
            self.cells.setdefault(self.table, []).append("")
        if tag not in ("meta", "link"):
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in ("meta", "link"):
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag
        if tag == "ul":
            self.lists.pop()

    def handle_data(self, text):
        if "figcaption" in self.open:
            self.captions[-1] += text
        if self.open and self.open[-1] in ("td", "th"):  # without the units, which are small
            self.cells[self.table][-1] += text


source_text = open(os.path.join(report, "index.html"), encoding="utf-8").read()
page = Page()
page.feed(source_text)
assert page.open == []
(policy,) = re.findall(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)"/>', source_text)
(script,) = re.findall(r"<script>(.*?)</script>", source_text, re.S)
digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
assert "default-src 'none'" in policy and f"script-src 'sha256-{digest}';" in policy, policy
assert page.scripts == 1
# Marks on two and three pairs of axes; of a figure, for a new one may have marks, too.
for name in ("size-against-rate", "size-against-rate-normalised", "count-against-rate"):
    assert page.marks.get(name, 0) == 2 * with_mean, name
for path in glob.glob(report + "/fits-point-*.csv"):
    name = os.path.basename(path)[:-4]
    with open(path, encoding="utf-8") as file:
        assert page.marks.get(name, 0) == 3 * sum(line[2] == "mark" for line in csv.reader(file)), name
for number, caption in enumerate((caption for caption in page.captions if caption.startswith("Figure")), 1):
    assert caption.startswith(f"Figure {number}. ") and f", campaign {summary['campaign'][:12]}, fracas {summary['version']}." in caption
assert number == len(drawn) - len(glob.glob(os.path.join(report, "surface-*-*-*.svg"))) + len(glob.glob(os.path.join(report, "surface-*.csv")))
shown_points = [i * (len(rows) - 1) // (min(12, len(rows)) - 1) if len(rows) > 1 else 0 for i in range(min(12, len(rows)))]
assert page.rows.pop("headline") == len(shown_points)
head, cells = page.cells["headline"][:5 if "ZMR" in text[0] else 4], page.cells["headline"]
for place, p in enumerate(shown_points, 1):
    line = cells[place * len(head):(place + 1) * len(head)]
    assert line[0] == summary["points"][p]["label"] and int(line[1]) == rows[p]["usable"]
    for cell, key, unit in zip(line[2:], ("count", "size", "size"), (1.0, size_unit, rows[p]["law.zmr"])):
        mean, _, half_width = cell.partition(" ± ")
        shows(mean, rows[p][key + ".mean"], unit)
        if mean != "-":
            shows(half_width, rows[p][key + ".half_width"], unit)
assert page.rows.pop("results") == len(rows)
assert page.rows.pop("slopes", 0) == len(summary["slopes"])
assert page.rows.pop("count-slopes", 0) == len(summary["count_slopes"])
assert page.rows.pop("count-large-slopes", 0) == len(summary["count_large_slopes"])
assert page.rows.pop("windows", 0) == len(summary["windows"])
assert page.rows.pop("crossovers", 0) == sum(of["points"] > 1 for of in summary["crossovers"])
if os.path.exists(os.path.join(study, "fits.csv")):
    assert page.rows.pop("fits-table") == sum(row["quantity"] == "rank" for row in fits)
rate_alone = summary["axes"]["x"] == "derived.strain_rate" and len(summary["varying"]) < 2
assert page.rows.pop("effects", 0) == (0 if rate_alone else len(whole))
assert page.rows.pop("effects-each", 0) == (0 if rate_alone or each > 60 else each)
listed = re.search(r"all others being equal.*?<ul>(.*?)</ul>", source_text, re.S)
assert (listed.group(1).count("<li>") if listed else 0) == (0 if rate_alone else said)
assert page.rows.pop("motion", 0) == model.count("ring") and not page.rows
firsts = [np.flatnonzero((realization["point"] == p) & (realization["outcome"] == 0))[0] for p in pictures]
assert page.bands == sum(realization["fragments"][i] for i in firsts)
for link in page.links:
    assert link.startswith("data:") or f'id="{link[1:]}"' in source_text if link[0] == "#" or ":" in link else os.path.exists(os.path.join(report, link)), link
assert "url(" not in source_text and "@import" not in source_text
assert f"<h1>{html.escape(summary['name'])}</h1>" in source_text
assert summary["campaign"] in source_text and summary["seed"] in source_text
assert page.warnings == len({w["kind"] if w["point"] is not None else w["text"] for w in summary["warnings"]})

# Nothing is left of the temporary names.
assert not [name for name in os.listdir(report) if name.startswith(".")]
