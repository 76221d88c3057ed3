#!/usr/bin/python3
"""Draws the strengths of the first realization of each point of a study, by the edges of its surface mesh.

    fracas run docs/examples/fields.yaml --study fields
    python3 docs/examples/fields_from_study.py fields/study.h5 fields.png

The campaign must keep interfaces (output.interfaces)."""
import sys

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection

study, picture = h5py.File(sys.argv[1]), sys.argv[2]
points = study["realization/point"][()]
order = np.unique(points)
figure, axes = plt.subplots(1, len(order), figsize=(4 * len(order), 3), squeeze=False)
for axis, point in zip(axes[0], order):
    first = np.flatnonzero(points == point)[0]
    strength = study["interface/strength"][slice(*study["interface/offset"][first:first + 2])] / 1e6
    position = study["mesh/node_position"][slice(*study["mesh/node_offset"][point:point + 2])] * 1e3
    ends = position[study["mesh/interface_node"][slice(*study["mesh/interface_offset"][point:point + 2])][:, :2]][:, :, :2]
    edges = LineCollection(ends, array=strength, cmap="viridis", linewidths=1.6, clim=(270, 380))
    axis.add_collection(edges)
    axis.autoscale()
    axis.set_aspect("equal")
    axis.set_title("point %d: %.0f to %.0f MPa" % (point, strength.min(), strength.max()), fontsize=9)
    axis.tick_params(labelsize=7)
figure.colorbar(edges, ax=list(axes[0]), label="strength (MPa)", fraction=0.02)
figure.savefig(picture, dpi=80, bbox_inches="tight")
