#!/usr/bin/python3
"""Draws the strengths that `fracas sample FILE --csv strengths.csv` wrote, each as a dot where it is, with numpy and matplotlib alone.

usage: strengths_from_sample.py strengths.csv PICTURE

A body in the plane is seen from above, one in space from the direction (1, 1, 1), nearer dots over farther ones.
"""
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def main(path, picture):
    rows = np.genfromtxt(path, delimiter=",", names=True)
    place = np.stack([rows["x_m"], rows["y_m"], rows["z_m"]], axis=1) * 1e3
    strength = rows["strength_Pa"] / 1e6
    labels = ["x (mm)", "y (mm)"]
    if np.ptp(place[:, 2]) > 0:  # across, upward, towards the eye
        axes = np.array([[-1, 1, 0], [-1, -1, 2], [1, 1, 1]]) / np.sqrt([[2], [6], [3]])
        place, labels = place @ axes.T, ["across (mm)", "upward (mm)"]
    order = np.argsort(place[:, 2], kind="stable")
    figure, axis = plt.subplots(figsize=(6, 4.6))
    if np.ptp(place[:, 1]) > 0:
        dots = axis.scatter(place[order, 0], place[order, 1], c=strength[order], s=9, cmap="viridis")
        axis.set_aspect("equal")
        axis.set_xlabel(labels[0])
        axis.set_ylabel(labels[1])
        figure.colorbar(dots, label="strength (MPa)")
    else:  # a bar
        axis.plot(place[:, 0], strength, ".", markersize=3)
        axis.set_xlabel(labels[0])
        axis.set_ylabel("strength (MPa)")
    figure.savefig(picture, dpi=90, bbox_inches="tight")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
