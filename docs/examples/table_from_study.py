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


def weibull_shape(ratio):
    """Of strengths whose deviation/(mean - minimum) is `ratio`, by halving."""
    low, high = 1e-3, 10.0
    while high - low > 1e-15 * high:
        x = (low + high) / 2
        less = math.lgamma(1 + 2 * x) - 2 * math.lgamma(1 + x) < math.log1p(ratio**2)
        low, high = (x, high) if less else (low, x)
    return 1 / low


def modulus_of(point, p):
    """Of the strengths, for Mott's law: NaN unless they are weibull or flaws (docs/theory/size-laws.md)."""
    def real(name, missing=math.nan):
        value = point[name][p] if name in point else math.nan
        return missing if math.isnan(value) else value
    distribution = point["strength.distribution"][p] if "strength.distribution" in point else b""
    mean, minimum = real("derived.strength_mean"), real("strength.minimum", 0.0)
    if distribution == b"weibull":
        m = real("strength.shape")
        if math.isnan(m):
            m = weibull_shape(real("strength.deviation") / (real("strength.mean") - minimum))
    elif distribution == b"flaws" and real("strength.flaw_density") * real("geometry.area") * length_of(point, p) > (
            math.log(2) * real("mesh.elements")):
        m = real("strength.exponent")
    else:
        return math.nan
    return m * mean / (mean - minimum)


def laws(row, young, density, strength, fracture_energy, modulus, rate):
    """Scales and mean-size laws (docs/theory/size-laws.md)."""
    speed = math.sqrt(young / density)
    row["scale.size"] = s0 = young * fracture_energy / strength**2
    row["scale.rate"] = rate0 = speed * strength**3 / (young**2 * fracture_energy)
    e = rate / rate0 if rate > 0 else math.nan  # a ring that spins or is accelerated begins at 0: the laws say nothing
    row["law.zmr"] = s0 * 4.5 / (1 + 4.5 * e ** (2 / 3))
    row["law.grady"] = s0 * (24 / e**2) ** (1 / 3)
    row["law.glenn_chudnovsky"] = s0 * 4 / e * math.sinh(math.asinh(1.5 * e) / 3)
    row["law.zmr2"] = s0 * 4.5 / (1 + 0.77 * e**0.25 + 5.4 * e**0.75)
    row["law.mott"] = math.sqrt(2 * math.pi / (density * modulus * young)) * strength / rate if rate > 0 else math.nan


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
        size = study["fragment/size"][()]
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
        fragment = np.zeros(len(elements), bool)
        for i in np.flatnonzero(used):
            fragment[offset[i]:offset[i + 1]] = True
        row["elements"] = elements[fragment].mean() if fragment.any() else math.nan
        row["dust_share"] = dust[fragment].mean() if fragment.any() else math.nan
        laws(row, point["material.young"][p], point["material.density"][p], point["derived.strength_mean"][p],
             fracture_energy_of(point, p), modulus_of(point, p), math.nan if is_surface(point, p) else rate)
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
