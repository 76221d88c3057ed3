#!/usr/bin/env python3
"""The result table of a study from study.h5 alone: h5py and numpy, no code of fracas.

usage: table_from_study.py STUDY/study.h5

Prints a line a point, tab-separated, in SI units; the columns are the keys of the JSON summary of `fracas report`.
"""
import math
import sys

import h5py
import numpy as np

USABLE = {0: "FRAGMENTED", 1: "INTACT", 2: "TIME_LIMIT"}
OUTCOMES = ["FRAGMENTED", "INTACT", "TIME_LIMIT", "NONFINITE", "ENERGY_DRIFT", "FAILED"]


def student_cdf(t, n):
    """P(T <= t) for n degrees of freedom, t >= 0 (Abramowitz & Stegun 26.7.3 and 26.7.4)."""
    theta = math.atan(t / math.sqrt(n))
    cos2 = math.cos(theta) ** 2
    term = math.cos(theta) if n % 2 else 1.0
    total = 0.0
    for k in range(1 if n % 2 else 0, n - 1, 2):
        total += term
        term *= cos2 * (k + 1) / (k + 2)
    central = math.sin(theta) * total
    if n % 2:
        central = 2 / math.pi * (theta + central)
    return 0.5 + central / 2


def student_quantile(p, n):
    low, high = 0.0, 1e3
    while high - low > 1e-13 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if student_cdf(middle, n) < p else (low, middle)
    return (low + high) / 2


def estimate(row, key, values):
    """Mean over replicas, its standard deviation and the half width of its 95 % interval."""
    values = values[np.isfinite(values)]
    n = len(values)
    deviation = values.std(ddof=1) if n > 1 else math.nan
    row[key + ".n"] = n
    row[key + ".mean"] = values.mean() if n else math.nan
    row[key + ".deviation"] = deviation
    row[key + ".half_width"] = student_quantile(0.975, n - 1) * deviation / math.sqrt(n) if n > 1 else math.nan


def laws(row, young, density, strength, fracture_energy, rate):
    """Scales and mean-size laws (docs/theory/size-laws.md)."""
    speed = math.sqrt(young / density)
    row["scale.size"] = s0 = young * fracture_energy / strength**2
    row["scale.rate"] = rate0 = speed * strength**3 / (young**2 * fracture_energy)
    e = rate / rate0 if rate > 0 else math.nan  # a ring that spins or is accelerated begins at 0: the laws say nothing
    row["law.zmr"] = s0 * 4.5 / (1 + 4.5 * e ** (2 / 3))
    row["law.grady"] = s0 * (24 / e**2) ** (1 / 3)
    row["law.glenn_chudnovsky"] = s0 * 4 / e * math.sinh(math.asinh(1.5 * e) / 3)
    row["law.zmr2"] = s0 * 4.5 / (1 + 0.77 * e**0.25 + 5.4 * e**0.75)


def quantile(size, weight, share, step):
    """Of grouped sizes where they are multiples of a step, else the least size with that share of the weight."""
    kind, where = np.unique(np.round(size / step) * step if step > 0 else size, return_inverse=True)
    inside = np.bincount(where, weight)
    after = np.cumsum(inside)
    k = np.searchsorted(after, share * after[-1])
    return kind[k] + step * ((share * after[-1] - after[k] + inside[k]) / inside[k] - 0.5)


def sizes(row, key, size, mass, step):
    """By number and by mass (docs/theory/estimators.md)."""
    row[key + ".n"] = len(size)
    some = len(size) > 0
    row[key + ".mean.value"] = size.mean() if some else math.nan
    row[key + ".mass_mean.value"] = (mass * size).sum() / mass.sum() if some else math.nan
    row[key + ".variation.value"] = size.std() / size.mean() if some else math.nan
    for percent in (5, 25, 50, 75, 95):
        for name, weight in (("quantile", np.ones(len(size))), ("mass_quantile", mass)):
            row[f"{key}.{name}_{percent:02}.value"] = quantile(size, weight, percent / 100, step) if some else math.nan


def pooled(row, size, mass, elements, group, step, dimension):
    """Of all fragments of a point; `group`: the realization of each."""
    some = len(size) > 0
    row["cut"] = cut = {1: 1.5, 2: math.sqrt(2.5)}[dimension] * ((size**dimension).sum() / elements.sum()) ** (1 / dimension) if some else 0
    above = size > cut
    sizes(row, "fragment", size, mass, step)
    sizes(row, "resolved", size[above], mass[above], step)
    row["unresolved.share.value"] = (~above).mean() if some else math.nan
    row["unresolved.mass_share.value"] = mass[~above].sum() / mass.sum() if some else math.nan
    n = np.bincount(group)
    a = len(n)
    estimate(row, "largest_size", np.array([size[group == i][mass[group == i].argmax()] for i in range(a)]))
    estimate(row, "largest_share", np.array([mass[group == i].max() / mass[group == i].sum() for i in range(a)]))


def variance(row, size, group):
    """One-way analysis of variance."""
    n = np.bincount(group)
    a, mean = len(n), np.bincount(group, size) / np.maximum(n, 1)
    defined = a > 1 and len(size) > a
    within = ((size - mean[group]) ** 2).sum() / (len(size) - a) if len(size) > a else math.nan
    among = (n * (mean - size.mean()) ** 2).sum() / (a - 1) if defined else math.nan
    m0 = (len(size) - (n**2).sum() / len(size)) / (a - 1) if a > 1 else math.nan
    row["variance.within.value"], row["variance.group"] = within, m0
    row["variance.between.value"] = (among - within) / m0
    row["variance.intraclass.value"] = rho = (among - within) / (among + (m0 - 1) * within)
    row["variance.design_effect.value"] = 1 + (m0 - 1) * rho


def step_of(point, p):
    """What all sizes are multiples of; 0 of surfaces and graded meshes."""
    graded = "mesh.spacing" in point and point["mesh.spacing"][p] != b"uniform"
    return 0 if graded or is_surface(point, p) else length_of(point, p) / point["mesh.elements"][p]


def largest_ratio(values, dissipated):
    cracked = dissipated > 0
    return (values[cracked] / dissipated[cracked]).max() if cracked.any() else math.nan


def is_surface(point, p):
    return "geometry.thickness" in point and math.isfinite(point["geometry.thickness"][p])


def length_of(point, p):
    """Length of a bar, circumference of a ring."""
    if "model" in point and point["model"][p] == b"ring":
        return 2 * math.pi * point["geometry.radius"][p]
    return point["geometry.length"][p]


def fracture_energy_of(point, p):
    """As given, or of the mean strength where the critical opening is given (law stershic)."""
    opening = point["cohesive.critical_opening"][p] if "cohesive.critical_opening" in point else 0
    return opening * point["derived.strength_mean"][p] / 2 if opening > 0 else point["cohesive.fracture_energy"][p]


def table(path):
    with h5py.File(path, "r") as study:
        point = {name: column[()] for name, column in study["point"].items()}
        realization = {name: column[()] for name, column in study["realization"].items()}
        offset = study["fragment/offset"][()]
        elements, dust = study["fragment/elements"][()], study["fragment/dust"][()]
        size, mass = study["fragment/size"][()], study["fragment/mass"][()]
    rows = []
    for p in range(len(point["hash"])):
        mine = realization["point"] == p
        used = mine & np.isin(realization["outcome"], list(USABLE))
        of = {name: column[used] for name, column in realization.items()}
        rate = point.get("derived.strain_rate", point.get("loading.rate"))[p]  # the latter in studies before the former
        row = {"rate": rate, "realizations": mine.sum(), "usable": used.sum(),
               "unusable": mine.sum() - used.sum()}
        estimate(row, "count", of["fragments"].astype(float))
        estimate(row, "count_large", (of["fragments"] - of["fragments_dust"]).astype(float))
        if is_surface(point, p):  # mean over fragments of the square root of the area
            estimate(row, "size", np.array([size[offset[i]:offset[i + 1]].mean() for i in np.flatnonzero(used)]))
        else:
            estimate(row, "size", length_of(point, p) / of["fragments"])
        estimate(row, "dissipated", of["dissipated"])
        estimate(row, "onset_time", of["onset_time"])
        row["residual"] = largest_ratio(of["residual"], of["dissipated"])
        row["created"] = largest_ratio(of["created"], of["dissipated"])
        fragment, group = np.zeros(len(elements), bool), np.zeros(len(elements), int)
        for g, i in enumerate(np.flatnonzero(used)):
            fragment[offset[i]:offset[i + 1]] = True
            group[offset[i]:offset[i + 1]] = g
        pooled(row, size[fragment], mass[fragment], elements[fragment], group[fragment], step_of(point, p), 2 if is_surface(point, p) else 1)
        variance(row, size[fragment], group[fragment])
        row["elements"] = elements[fragment].mean() if fragment.any() else math.nan
        row["dust_share"] = dust[fragment].mean() if fragment.any() else math.nan
        laws(row, point["material.young"][p], point["material.density"][p], point["derived.strength_mean"][p],
             fracture_energy_of(point, p), math.nan if is_surface(point, p) else rate)
        for key, name in (("mean", "mean"), ("mass_mean", "mass_mean"), ("median", "quantile_50")):
            row[f"normalised.{key}.value"] = row[f"fragment.{name}.value"] / row["scale.size"]
        row["normalised.size.mean"] = row["size.mean"] / row["scale.size"]
        row["normalised.rate"] = rate / row["scale.rate"]
        for o, name in enumerate(OUTCOMES):
            row[name] = (realization["outcome"][mine] == o).sum()
        rows.append(row)
    return rows


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = table(sys.argv[1])
    print(*rows[0], sep="\t")
    for row in rows:
        print(*(f"{value:.15g}" for value in row.values()), sep="\t")
