"""Estimates from all fragments of a point together, from the equations of docs/theory/estimators.md (14 to 22) alone.

Used by table_from_study.py. Intervals of eight realizations and more are resampled with random numbers of its own, so they are those of fracas within the noise of
2000 resamples.
"""
import math
import statistics as normal

import numpy as np

RESAMPLES = 2000
SHARES = (5, 25, 50, 75, 95)  # percent, of the quantiles
HEADLINES = ("count", "size", "dissipated", "largest_share", "fragment.mean", "fragment.mass_mean", "fragment.variation")
PHI = normal.NormalDist()


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


def divided(a, b):
    """a/b, NaN where there is nothing to divide by."""
    return np.divide(a, b, out=np.full(np.broadcast(a, b).shape, math.nan), where=b != 0)


class Fragments:
    """Those of the usable realizations of a point: for each different size, how many and of what mass each realization has."""

    def __init__(self, pieces, lattice, surface):
        size, mass, elements = (np.concatenate([piece[name] for piece in pieces] or [[]]) for name in ("size", "mass", "elements"))
        of = np.repeat(np.arange(len(pieces)), [len(piece["size"]) for piece in pieces])
        power = 2 if surface else 1
        step = (size**power).sum() / elements.sum() if len(size) else math.nan
        self.cut = math.sqrt(2.5 * step) if surface else 1.5 * step  # (14)
        self.lattice = lattice
        if lattice:  # every size is a multiple of it
            size = np.rint(size / lattice) * lattice
        self.size, place = np.unique(size, return_inverse=True)
        self.number, self.mass = np.zeros((2, len(pieces), len(self.size)))
        np.add.at(self.number, (of, place), 1)
        np.add.at(self.mass, (of, place), mass)
        self.large = self.size > self.cut

    def quantiles(self, weight, percents, large):
        """(16), of each row of weights: of sizes, one a column. Of the large alone W counts from the cut."""
        size, weight = (self.size[self.large], weight[:, self.large]) if large else (self.size, weight)
        if not len(size):
            return np.full((len(percents), len(weight)), math.nan)
        to = np.cumsum(weight, axis=1)
        found = []
        for percent in percents:
            wanted = percent / 100 * to[:, -1]
            k = (to >= wanted[:, None] * (1 - 1e-12)).argmax(axis=1)  # the first; rounding of a sum must not skip it
            rows = np.arange(len(to))
            value = size[k]
            if self.lattice:
                value = value + self.lattice * (divided(wanted - (to[rows, k] - weight[rows, k]), weight[rows, k]) - 0.5)
            found.append(np.where(to[:, -1] > 0, value, math.nan))
        return np.array(found)

    def sizes(self, key, number, mass, large, values):
        """(15) and (16) of resamples: `number` and `mass` have one a row."""
        s = np.where(self.large, self.size, 0) if large else self.size
        count, heavy = (number[:, self.large], mass[:, self.large]) if large else (number, mass)
        n, m = count.sum(axis=1), heavy.sum(axis=1)
        mean = divided(number @ s, n)
        around = self.size[self.large] if large else self.size
        spread = np.array([row @ (around - middle)**2 for row, middle in zip(count, mean)])  # as sum s^2/N - mean^2, without its cancellation
        values[key + ".mean"], values[key + ".mass_mean"] = mean, divided(mass @ s, m)
        values[key + ".variation"] = divided(np.sqrt(divided(spread, n)), mean)
        for name, weight in (("quantile", number), ("mass_quantile", mass)):
            for percent, value in zip(SHARES, self.quantiles(weight, SHARES, large)):
                values[f"{key}.{name}_{percent:02d}"] = value
        return n, m

    def variances(self, weight, values):
        """(19) and (20); a realization drawn w times is w realizations."""
        group = self.number.sum(axis=1)
        with np.errstate(invalid="ignore"):
            average = self.number @ self.size / group
        inside = np.array([row @ (self.size - middle)**2 for row, middle in zip(self.number, average)])
        n, all_of = weight.sum(axis=1), weight @ group
        grand = divided(weight @ (group * average), all_of)
        between = np.array([row @ (group * (average - middle)**2) for row, middle in zip(weight, grand)])
        typical = divided(all_of - divided(weight @ group**2, all_of), n - 1)
        within = divided(weight @ inside, all_of - n)
        component = divided(divided(between, n - 1) - within, typical)
        values["variance.within"], values["variance.between"] = within, component
        values["variance.intraclass"] = divided(component, within + component)
        values["variance.design_effect"] = 1 + (typical - 1) * values["variance.intraclass"]
        return typical

    def of(self, weight):
        """Every ratio of sums and quantile, for each row of weights: how often each realization is taken."""
        values = {}
        number, mass = weight @ self.number, weight @ self.mass
        n, m = self.sizes("fragment", number, mass, False, values)
        large, heavy = self.sizes("resolved", number, mass, True, values)
        values["unresolved.share"], values["unresolved.mass_share"] = 1 - divided(large, n), 1 - divided(heavy, m)  # (17)
        for share in ("unresolved.share", "unresolved.mass_share"):
            values[share] = np.where(np.abs(values[share]) < 1e-15, 0, values[share])  # m and heavy are sums of the same masses
        self.typical = self.variances(weight, values)
        return values, n, large


def interval(value, jackknife, resampled):
    """(18): BCa (Efron and Tibshirani 1993, 14.9 to 14.15), expanded: low and high. For each also the share of the resamples below it, and the standard error
    that their number gives it as a normal quantile: of the bias correction, and of the order statistic."""
    resampled = resampled[np.isfinite(resampled)]
    if not len(resampled) or not math.isfinite(value):
        return math.nan, math.nan, ()
    below = ((resampled < value).mean() + (resampled <= value).mean()) / 2  # ties are halved
    below = min(max(below, 0.5 / len(resampled)), 1 - 0.5 / len(resampled))
    lean = jackknife.mean() - jackknife
    square = (lean**2).sum()
    acceleration = (lean**3).sum() / (6 * square**1.5) if square > 0 else 0.0
    z0, ends, count, n = PHI.inv_cdf(below), [], len(resampled), len(jackknife)
    far = math.sqrt(n / (n - 1)) * student_quantile(0.975, n - 1)
    for z in (-far, far):
        room = 1 - acceleration * (z0 + z)
        share = PHI.cdf(z0 + (z0 + z) / room) if room > 0 else float(z > 0)
        share = min(max(share, 1 / count), 1 - 1 / count)
        bias = math.sqrt(below * (1 - below) / count) / PHI.pdf(z0) * (1 + 1 / room**2)
        order = math.sqrt(share * (1 - share) / count) / PHI.pdf(PHI.inv_cdf(share))
        ends.append((share, math.hypot(bias, order)))
    low, high = np.quantile(resampled, [share for share, _ in ends], method="inverted_cdf")
    return low, high, tuple(ends)


def bootstrap(fragments, n, seed):
    """Value of each number, its leave-one-out values and its resamples."""
    generator = np.random.Generator(np.random.PCG64(seed))
    drawn = generator.multinomial(n, np.full(n, 1 / n), size=RESAMPLES).astype(float)
    return fragments.of(np.ones((1, n)))[0], fragments.of(1 - np.eye(n))[0], fragments.of(drawn)[0]


def standard_error(value, jackknife):
    """e of (18)."""
    n = len(jackknife)
    return math.sqrt((n - 1) / n * ((jackknife - value)**2).sum()) if n > 1 else math.nan


def with_intervals(row, fragments, n):
    """NAME.value, .low and .high of every number; returns the resamples, with where among them the ends are."""
    resamples = {}
    if n < 8:
        left_out = fragments.of(1 - np.eye(n))[0] if n > 1 else {}
        for key, (value,) in fragments.of(np.ones((1, n)))[0].items():
            half = student_quantile(0.975, n - 1) * standard_error(value, left_out[key]) if n > 1 else math.nan
            row[key + ".value"], row[key + ".low"], row[key + ".high"] = value, value - half, value + half
        return resamples
    values, jackknife, resampled = bootstrap(fragments, n, 1)
    for key, (value,) in values.items():
        low, high, ends = interval(value, jackknife[key], resampled[key])
        row[key + ".value"], row[key + ".low"], row[key + ".high"] = value, low, high
        resamples[key] = resampled[key], ends
    return resamples


def alike(first, second):
    """|x1 - x2| over its limit in (22); 0 where nothing says how far apart halves may be. Of each half: value, variance of one replica's part, number."""
    (x1, v1, n1), (x2, v2, n2) = first, second
    apart, freedom, hair = abs(x1 - x2), n1 + n2 - 2, 1e-12 * max(abs(x1), abs(x2))
    if not math.isfinite(apart) or apart <= hair or freedom < 1:
        return 0.0
    scatter = math.sqrt(sum((n - 1) * v for n, v in ((n1, v1), (n2, v2)) if n > 1) / freedom)
    if scatter <= hair:
        return math.inf if 2 / math.comb(n1 + n2, n1) < 1 / 1600 else 0.0
    return apart / (student_quantile(1 - 1 / 3200, freedom) * scatter * math.sqrt(1 / n1 + 1 / n2))


def is_narrow(x, w, drift, n):
    """(22): converged or not, and how far from the limits: 1 is at one of them."""
    if not all(map(math.isfinite, (x, w))):
        return 0, math.inf
    if n < 8 and w <= 1e-12 * abs(x):  # all alike, of few
        return 0, math.inf
    precise = w / (0.05 * abs(x)) if x else (0.0 if w == 0 else math.inf)
    return int(precise <= 1 and drift <= 1), min(abs(math.log(min(max(ratio, 1e-9), 1e9))) for ratio in (precise, drift))


def convergence(row, replicas, part, n):
    """`replicas`: a value a realization of those that are means; `part`: the fragments of realizations first to last - 1. Returns the keys that resampling noise
    may decide."""
    unsure, halves = set(), [(0, n // 2), (n // 2, n)] if n > 1 else []
    sums = []
    for begin, end in halves:
        fragments, count = part(begin, end), end - begin
        sums.append((count, fragments.of(np.ones((1, count)))[0], fragments.of(1 - np.eye(count))[0]))
    for key in HEADLINES:
        if key in replicas:
            x, w = row[key + ".mean"], row[key + ".half_width"]
            pieces = [replicas[key][begin:end] for begin, end in halves]
            parts = [(piece.mean(), piece.var(ddof=1) if len(piece) > 1 else math.nan, len(piece)) for piece in pieces]
        else:
            x, w = row[key + ".value"], (row[key + ".high"] - row[key + ".low"]) / 2
            parts = [(whole[key][0], count * standard_error(whole[key][0], without[key])**2, count) for count, whole, without in sums]
        row["converged." + key], away = is_narrow(x, w, alike(*parts) if parts else 0.0, n)
        if key not in replicas and away < 0.3:
            unsure.add("converged." + key)
        row["unconverged"] = row.get("unconverged", 0) + (math.isfinite(x) and not row["converged." + key])
    return unsure


def aspect_of(piece):
    large = piece["dust"] == 0
    return (piece["semi_axis_1"] / piece["semi_axis_2"])[large].mean() if large.any() else np.nan


def largest_of(piece):
    largest = piece["mass"].argmax()
    return piece["size"][largest], piece["mass"][largest] / piece["mass"].sum()


def estimates(row, pieces, lattice, surface, replicas, estimate):
    """Adds the estimates of a point to its row. `pieces`: the fragments of each usable realization; `lattice`: what every size is a multiple of
    [m], 0 if there is none; `replicas`: count, size and dissipated of each realization. Returns the resamples, and the keys in doubt."""
    n = len(pieces)
    largest = np.array([largest_of(piece) for piece in pieces], float).reshape(-1, 2)
    estimate(row, "largest_size", largest[:, 0])
    estimate(row, "largest_share", largest[:, 1])
    estimate(row, "aspect", np.array([aspect_of(piece) for piece in pieces], float))
    replicas = dict(replicas, largest_share=largest[:, 1])
    fragments = Fragments(pieces, lattice, surface)
    row["cut"] = fragments.cut
    row["fragment.n"], row["resolved.n"] = fragments.number.sum(), fragments.number[:, fragments.large].sum()
    resamples = with_intervals(row, fragments, n)
    row["variance.group"] = fragments.of(np.ones((1, n)))[0] and fragments.typical[0]
    row["variance.effective"] = divided(row["fragment.n"], np.array(row["variance.design_effect.value"]))[()]
    row["normalised.rate"] = row["rate"] / row["scale.rate"]
    for part in ("mean", "half_width"):
        row["normalised.size." + part] = row["size." + part] / row["scale.size"]
    for name, key in (("mean", "fragment.mean"), ("mass_mean", "fragment.mass_mean"), ("median", "fragment.quantile_50")):
        for end in ("value", "low", "high"):
            row[f"normalised.{name}.{end}"] = row[f"{key}.{end}"] / row["scale.size"]
        if key in resamples:
            resamples["normalised." + name] = resamples[key][0] / row["scale.size"], resamples[key][1]
    return resamples, convergence(row, replicas, lambda begin, end: Fragments(pieces[begin:end], lattice, surface), n)
