#!/usr/bin/env python3
"""Mott's fragmentation as a process: flaws open at random, at a rate that grows as exp(t), where no wave has been.

Lengths are in x0 = sqrt(2 P_F/(rho gamma))/edot, times in 1/(gamma edot): a break relieves sqrt(t) on either side after the
time t. Prints the mean size, its standard error, and the share of fragments between x0 and 2 x0 (docs/theory/scaling-laws.md).
"""
import bisect
import math

import numpy as np

LENGTH, END = 20000, 6.0  # after END nothing is left to break: exp(6) flaws per x0 were tried
random = np.random.default_rng(1)
number = random.poisson(LENGTH * math.exp(END))
place = random.uniform(0, LENGTH, number)
time = END + np.log(random.uniform(0, 1, number))
broken, since = [], []
for i in np.argsort(time):
    k = bisect.bisect(broken, place[i])
    if broken:  # only the next breaks on both sides can have relieved it
        after, before = k % len(broken), k - 1
        if (broken[after] - place[i]) % LENGTH < math.sqrt(time[i] - since[after]):
            continue
        if (place[i] - broken[before]) % LENGTH < math.sqrt(time[i] - since[before]):
            continue
    broken.insert(k, place[i])
    since.insert(k, time[i])
size = np.diff(broken + [broken[0] + LENGTH])
print(f"{size.mean():.3f} +- {size.std() / math.sqrt(len(size)):.3f} x0, {np.mean((size > 1) & (size < 2)):.2f} between 1 and 2")
