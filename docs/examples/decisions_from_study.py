#!/usr/bin/env python3
"""Every decision on the number of replicas, again from study.h5 alone: h5py, no code of fracas.

usage: decisions_from_study.py STUDY/study.h5

Prints a line a decision, tab-separated, and ends with status 1 if a recorded one is not what its realizations give: the mean to
the bit, the half width to 1e-11 (Student's t is solved in another way here), the round and the stop exactly.
"""
import math
import os
import sys

import h5py

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from estimates_from_study import student_quantile  # noqa: E402
from table_from_study import USABLE  # noqa: E402

QUANTITIES = ["mean-count", "mean-size", "dissipated"]
STOPS = ["goes on", "precise", "maximum"]


def values_of(study, quantity):
    """One value a realization, None for one that does not count, summed as fracas does: in the order of the rows."""
    outcome = study["realization/outcome"][:].tolist()
    if quantity == 0:
        value = [float(count) for count in study["realization/fragments"][:].tolist()]
    elif quantity == 2:
        value = study["realization/dissipated"][:].tolist()
    else:
        offset, size = study["fragment/offset"][:].tolist(), study["fragment/size"][:].tolist()
        value = []
        for first, end in zip(offset, offset[1:]):
            total = 0.0
            for i in range(first, end):
                total += size[i]
            value.append(total / (end - first) if end > first else None)
    return [v if o in USABLE else None for o, v in zip(outcome, value)]


def decide(values, minimum, maximum, relative, confidence):
    """Yields (replicas, used, mean, half width, stop) of each round; `values` are those of one point in replica order."""
    replicas = minimum
    while True:
        used = [v for v in values[:replicas] if v is not None]
        mean = half_width = math.nan
        if used:
            total = squares = 0.0
            for v in used:
                total += v
            mean = total / len(used)
            for v in used:
                squares += (v - mean) * (v - mean)
            if len(used) > 1:
                t = student_quantile(0.5 * (1 + confidence), len(used) - 1)
                half_width = t * math.sqrt(squares / (len(used) - 1)) / math.sqrt(len(used))
        stop = 1 if half_width <= relative * abs(mean) else 2 if replicas >= maximum else 0
        yield replicas, len(used), mean, half_width, stop
        if stop:
            return
        replicas = min(maximum, replicas + 8 * -(-((replicas + 1) // 2) // 8))


def same(a, b, tolerance):
    return abs(a - b) <= tolerance * abs(a) or (math.isnan(a) and math.isnan(b))


def main(path):
    wrong = 0
    with h5py.File(path) as study:
        if "decision" not in study:
            sys.exit(f"{path}: no rule decided on replicas here")
        d = {name: study["decision/" + name][:].tolist() for name in study["decision"]}
        point = study["realization/point"][:].tolist()
        print("\t".join(["point", "round", "replicas", "quantity", "mean", "half_width", "stop"]))
        value = {q: values_of(study, q) for q in set(d["quantity"])}
        row = 0
        for p in sorted(set(d["point"])):
            values = [v for q, v in zip(point, value[d["quantity"][row]]) if q == p]
            rule = (d["minimum"][row], d["maximum"][row], d["relative_half_width"][row], d["confidence"][row])
            for number, (replicas, used, mean, half_width, stop) in enumerate(decide(values, *rule)):
                found = row < len(d["point"]) and d["point"][row] == p and d["round"][row] == number and \
                    d["replicas"][row] == replicas and d["used"][row] == used and same(d["mean"][row], mean, 0.0) and \
                    same(d["half_width"][row], half_width, 1e-11) and d["stop"][row] == stop
                wrong += not found
                print("\t".join([str(p), str(number), str(replicas), QUANTITIES[d["quantity"][row]], f"{mean:.6g}",
                                 f"{half_width:.3g}", STOPS[stop]]) + ("" if found else "\tNOT AS RECORDED"))
                row += 1
            wrong += len(values) != replicas
        wrong += row != len(d["point"])
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
