#!/usr/bin/python3
"""How many vectors a strength field needs, where it is kept by the eigenvectors of its covariance or by Nystrom's columns of it.

    bench/karhunen_loeve.py [SIDE [COVARIANCE LENGTH]]    a plate of 3 SIDE^2 sites (as in bench_field), SIDE = 32; l in element sizes

The covariance that k vectors leave out has no negative eigenvalue: its largest entry is the largest variance that is left out of a
site. Printed: the k that brings it to 5e-3, for eigenvectors (Karhunen-Loeve) and for the columns of sites that Cholesky's pivots
choose (Nystrom); and the largest error of a correlation with 50 eigenvectors once each site's variance is made 1 again.
"""
import sys

import numpy as np

WANTED = 5e-3


def plate(side):
    middle = np.array([[0.5, 0], [0, 0.5], [0.5, 0.5]])
    corner = np.array([[i, j] for j in range(side) for i in range(side)])
    return (corner[:, None, :] + middle).reshape(-1, 2)


def covariance(name, y):
    return np.exp(-y) if name == "exponential" else (1 + np.sqrt(3) * y) * np.exp(-np.sqrt(3) * y)  # matern of smoothness 1.5


def eigenvectors(c):
    value, vector = np.linalg.eigh(c)
    value, vector = value[::-1], vector[:, ::-1]
    left = 1 - np.cumsum(value * vector**2, axis=1).min(axis=0)
    few = vector[:, :50] * np.sqrt(value[:50])
    few /= np.sqrt((few**2).sum(axis=1))[:, None]
    return int(np.argmax(left <= WANTED)) + 1, np.abs(few @ few.T - c).max()


def columns(c):
    n = len(c)
    factor, left = np.zeros((n, n)), np.ones(n)
    for k in range(n):
        pivot = int(np.argmax(left))
        if left[pivot] <= WANTED:
            return k
        factor[:, k] = (c[:, pivot] - factor[:, :k] @ factor[pivot, :k]) / np.sqrt(left[pivot])
        left -= factor[:, k] ** 2
    return n


def main():
    side = int(sys.argv[1]) if len(sys.argv) > 1 else 32
    cases = [(name, l) for name in ("exponential", "matern") for l in (2, 5, 20)]
    if len(sys.argv) > 3:
        cases = [(sys.argv[2], float(sys.argv[3]))]
    x = plate(side)
    d = np.sqrt(((x[:, None] - x) ** 2).sum(axis=2))
    print("sites  covariance   l/h  eigenvectors  columns  error of 50")
    for name, l in cases:
        c = covariance(name, d / l)
        vectors, error = eigenvectors(c)
        print(f"{len(x):5}  {name:11}  {l:3g}  {vectors:12}  {columns(c):7}  {error:.1e}", flush=True)


main()
