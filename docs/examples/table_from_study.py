#!/usr/bin/env python3
"""The result table of a study from study.h5 alone: h5py and numpy, no code of fracas.

usage: table_from_study.py STUDY/study.h5

Prints a line a point, tab-separated, in SI units; the columns are the rate, every key of the statistics in the JSON summary of
`fracas report` (docs/formats/summary.md), and how many realizations ended how. A test compares them all with the program's own.
"""
import math
import sys

import h5py
import numpy as np

from estimates_from_study import estimates, student_quantile

USABLE = {0: "FRAGMENTED", 1: "INTACT", 2: "TIME_LIMIT"}
OUTCOMES = ["FRAGMENTED", "INTACT", "TIME_LIMIT", "NONFINITE", "ENERGY_DRIFT", "FAILED"]


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
    """Of the strengths, for Mott's law: NaN unless they are weibull or flaws (docs/theory/scaling-laws.md)."""
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


def piece_strength(point, p, modulus, fracture_energy):
    """Mean strength of a piece s0 long, and its modulus, where interfaces have a size effect by volume (17 to 19); else None."""
    def real(name):
        return point[name][p] if name in point else math.nan
    mean, least, volume = real("derived.strength_mean"), real("strength.minimum"), real("strength.reference_volume")
    uniform = "strength.distribution" in point and point["strength.distribution"][p] == b"uniform"
    if uniform and math.isnan(least):
        least = real("strength.mean") - math.sqrt(3) * real("strength.deviation")
    if math.isnan(mean) or math.isnan(volume) and math.isnan(real("strength.flaw_density")):
        return None
    power = 1 if real("cohesive.critical_opening") > 0 else 2
    least = 0.0 if math.isnan(least) else least
    h = length_of(point, p) / real("mesh.elements")
    if math.isfinite(modulus):
        m = modulus * (1 - least / mean)
        if m <= power * (1 + 1e-9):
            return None
        above, density = mean - least, real("strength.flaw_density")
        if math.isfinite(density):
            flaws = density * real("geometry.area") * h
            above = (real("strength.maximum") - least) * math.gamma(1 + 1 / m) * flaws ** (-1 / m)
        strength_of = lambda s: least + above * (h / s) ** (1 / m)
    else:
        m, n = math.nan, h * real("geometry.area") / volume
        if not (mean - least) * (n + 1) < 8 * least or not uniform:
            return None
        strength_of = lambda s: least + (mean - least) * (n + 1) / (n * s / h + 1)
    low, high = h * 1e-60, h * 1e60
    for _ in range(400):
        s = math.sqrt(low * high)
        strength = strength_of(s)
        energy = fracture_energy * (strength / mean if power == 1 else 1)
        low, high = (s, high) if s * strength**2 < point["material.young"][p] * energy else (low, s)
    return strength, m * strength / (strength - least), energy


def laws(row, young, density, strength, fracture_energy, modulus, rate):
    """Scales and scaling laws of the mean size (docs/theory/scaling-laws.md)."""
    speed = math.sqrt(young / density)
    row["scale.time"] = young * fracture_energy / (strength**2 * speed)
    row["scale.size"] = s0 = young * fracture_energy / strength**2
    row["scale.rate"] = rate0 = speed * strength**3 / (young**2 * fracture_energy)
    row["scale.modulus"] = modulus
    e = rate / rate0 if rate > 0 else math.nan  # a ring that spins or is accelerated begins at 0: the laws say nothing
    row["law.zmr"] = s0 * 4.5 / (1 + 4.5 * e ** (2 / 3))
    row["law.grady"] = s0 * (24 / e**2) ** (1 / 3)
    row["law.glenn_chudnovsky"] = s0 * 4 / e * math.sinh(math.asinh(1.5 * e) / 3)
    row["law.zmr2"] = s0 * 4.5 / (1 + 0.77 * e**0.25 + 5.4 * e**0.75)
    row["law.mott"] = math.sqrt(2 * math.pi / (density * modulus * young)) * strength / rate if rate > 0 else math.nan


def lattice_of(point, p):
    """Of a bar or ring of equal elements: what every size is a multiple of; else 0."""
    equal = "mesh.spacing" not in point or point["mesh.spacing"][p] == b"uniform"
    elements = point["mesh.elements"][p] if "mesh.elements" in point else math.nan
    return length_of(point, p) / elements if equal and elements > 0 and not is_surface(point, p) else 0


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
    """As given, or of the mean strength where the critical opening is given: then by the law's shape."""
    return point["derived.fracture_energy"][p]


def drift(row, of):
    """Largest |residual| over the run / largest energy at the end; how many realizations have more than 1 % of it."""
    largest = np.maximum.reduce([of["kinetic"], of["elastic"] + of["cohesive"] + of["dissipated"] + of["friction"], np.abs(of["work"])])
    drifts = of["residual"][largest > 0] / largest[largest > 0]
    row["drift"] = drifts.max() if len(drifts) else math.nan
    row["drifted"] = (drifts > 0.01).sum()


HELD = ("kinetic", "elastic", "cohesive", "dissipated", "friction")


def residual_total(of, rows):
    """Largest |residual| of a run / largest sum of the energies that a body has and has lost, over realizations (estimators.28)."""
    end = sum(of[name] for name in HELD)
    total = np.array([max([last, *sum(piece[name] for name in HELD)]) for last, piece in zip(end, rows)])
    return (of["residual"][total > 0] / total[total > 0]).max() if (total > 0).any() else math.nan


def final(row, of, pieces):
    """The final count (docs/theory/settled.md), from means over the realizations that cracked."""
    names = ("transits", "growth", "rest", "bound", "held", "vibrating", "count.value", "count.low", "count.high")
    row.update({"final." + name: math.nan for name in names})
    broke = of["broken"] > 0
    row["heated"] = (np.abs(of["residual_end"]) / of["vibrating"])[broke].max() if broke.any() else math.nan
    cracked = np.isfinite(of["transits"])
    most = np.array([piece["elements"].sum() for piece in pieces])[cracked] - of["fragments_held"][cracked]
    of = {name: column[cracked] for name, column in of.items()}
    counts = of["fragments"] - of["fragments_held"]
    if not len(counts):
        return
    free = counts > 0
    k, seen = of["transits"].mean(), counts.mean()
    growth = (of["growth"][free] * counts[free]).sum() / counts.sum() if free.any() else math.nan
    rest, bound, variance = (of[name].mean() for name in ("rest", "rest_bound", "rest_variance"))
    stored = np.divide(of["vibrating"], of["dissipated"], out=np.zeros(len(k * counts)), where=of["dissipated"] > 0)
    values = [k, growth, rest, bound, of["fragments_held"].mean(), stored.mean()]
    if seen > 1:
        if math.isfinite(rest):
            values += [seen + rest, seen, seen + min(bound, 1.5 * rest + 2 * math.sqrt(variance / len(counts)))]
        elif k >= 20:
            values += [seen * (1 + growth), seen, seen * (1.02 + growth)]
        else:
            low, high = (np.interp(k, (0, 5, 10, 20), share) for share in ((0, 0.37, 0.64, 0.865), (0.5, 0.71, 0.84, 0.95)))
            values += [2 * seen / (low + high), seen / high, seen / low]
        values[6:] = [min(value, most.mean()) for value in values[6:]]
    row.update(zip(("final." + name for name in names), values))


MOTION = ("radial_velocity", "radial_scatter", "circumferential_velocity", "angular_velocity")


def motion(of, radius):
    """Of the fragments of a ring, weighed by mass (docs/theory/estimators.md, 4 to 9): outward mean, scatter, rms along, mean |spin|."""
    if len(of["mass"]) < 2:
        return [math.nan] * 4
    angle = np.arctan2(of["position"][:, 1], of["position"][:, 0])
    outward = of["velocity"][:, 0] * np.cos(angle) + of["velocity"][:, 1] * np.sin(angle)
    along = of["velocity"][:, 1] * np.cos(angle) - of["velocity"][:, 0] * np.sin(angle)
    half = of["size"] / (2 * radius)
    inertia = of["mass"] * radius**2 * (1 - np.sinc(half / np.pi)**2)
    mean = np.average(outward, weights=of["mass"])
    return [mean, math.sqrt(np.average((outward - mean)**2, weights=of["mass"])),
            math.sqrt(np.average(along**2, weights=of["mass"])),
            np.average(np.abs(of["angular_momentum"][:, 2]) / inertia, weights=of["mass"])]


def flight(of):
    """Kinetic energy of the fragments of a surface as rigid bodies: of their centres of mass, of their spins (12 and 13)."""
    if len(of["mass"]) < 2:
        return [math.nan] * 2
    return [(of["mass"][:, None] * of["velocity"]**2).sum() / 2, (of["angular_momentum"] * of["spin"]).sum() / 2]


def by_realization(row, keys, pieces, values_of):
    values = np.array([values_of(of) for of in pieces], float).reshape(-1, len(keys))
    for key, column in zip(keys, values.T):
        estimate(row, key, column)


def rows_of(group, offset, used):
    """The rows of each of these realizations, by column."""
    return [{name: column[offset[i]:offset[i + 1]] for name, column in group.items()} for i in np.flatnonzero(used)]


def row_of(point, p, realization, fragment, history):
    """Every number of point p, and what `estimates` returns; the others are the columns of those groups, the latter two with offsets."""
    mine = realization["point"] == p
    used = mine & np.isin(realization["outcome"], list(USABLE))
    of = {name: column[used] for name, column in realization.items()}
    pieces = rows_of(*fragment, used)
    rate = point.get("derived.strain_rate", point.get("loading.rate"))[p]  # the latter in studies before the former
    surface, ring = is_surface(point, p), "model" in point and point["model"][p] == b"ring"
    row = {"rate": rate, "realizations": mine.sum(), "usable": used.sum(), "unusable": mine.sum() - used.sum()}
    replicas = {"count": of["fragments"].astype(float), "dissipated": of["dissipated"]}
    if surface:  # mean over fragments of the square root of the area
        replicas["size"] = np.array([piece["size"].mean() for piece in pieces])
    else:
        replicas["size"] = length_of(point, p) / of["fragments"]
    for key, values in replicas.items():
        estimate(row, key, values)
    estimate(row, "count_large", (of["fragments"] - of["fragments_dust"]).astype(float))
    estimate(row, "dissipated_bending", of["dissipated_bending"])
    estimate(row, "onset_time", of["onset_time"])
    by_realization(row, MOTION, pieces if ring else [], lambda piece: motion(piece, point["geometry.radius"][p]))
    by_realization(row, ("translation", "rotation"), pieces if surface else [], flight)
    row["residual"] = largest_ratio(of["residual"], of["dissipated"])
    row["residual_total"] = residual_total(of, rows_of(*history, used))
    row["created"] = largest_ratio(of["created"], of["dissipated"])
    drift(row, of)
    final(row, of, pieces)
    elements, dust = (np.concatenate([piece[name] for piece in pieces] or [[]]) for name in ("elements", "dust"))
    row["elements"] = elements.mean() if len(elements) else math.nan
    row["dust_share"] = dust.mean() if len(dust) else math.nan
    strength, modulus, energy = point["derived.strength_mean"][p], modulus_of(point, p), fracture_energy_of(point, p)
    if not surface:
        strength, modulus, energy = piece_strength(point, p, modulus, energy) or (strength, modulus, energy)
    laws(row, point["material.young"][p], point["material.density"][p], strength, energy, modulus, math.nan if surface else rate)
    found = estimates(row, pieces, lattice_of(point, p), surface, replicas, estimate)
    for o, name in enumerate(OUTCOMES):
        row[name] = (realization["outcome"][mine] == o).sum()
    return row, *found


def table(path):
    with h5py.File(path, "r") as study:
        point, realization, fragment, history = ({name: column[()] for name, column in study[group].items()}
                                                 for group in ("point", "realization", "fragment", "history"))
    parts = [(group, group.pop("offset")) for group in (fragment, history)]
    return [row_of(point, p, realization, *parts) for p in range(len(point["hash"]))]


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = [row for row, *_ in table(sys.argv[1])]
    print(*rows[0], sep="\t")
    for row in rows:
        print(*(f"{value:.15g}" for value in row.values()), sep="\t")
