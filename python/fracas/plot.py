# SPDX-License-Identifier: GPL-3.0-or-later
"""The report's figures in matplotlib, from the tables that `fracas report` writes beside them: nothing is computed again."""
from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from .command import Error
from .study import Study, read_csv

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LINEAR = ("energies", "fragments", "bands")  # of the axes, which are else logarithmic
PANEL, SERIES, KIND, X, Y, LOW, HIGH = range(7)  # of a line


def figure(study: Study, name: str, ax: Axes | None = None, panel: int = 1) -> Axes:
    """Draws NAME.csv of the study's report as the report's figure of this name, or another of its panels, and returns the axes.

    >>> fracas.plot.figure(study, "convergence-point-0")
    """
    from matplotlib import pyplot
    path = study.report() / f"{name}.csv"
    if not path.exists():
        there = sorted(file.stem for file in path.parent.glob("*.svg"))
        raise Error(f"the report of {study.path} has no figure {name}; it has {', '.join(there)}", 2)
    rows = read_csv(path)
    ax = ax or pyplot.subplots()[1]
    labels = [label.split(" | ")[min(panel, label.count(" | ") + 1) - 1] for label in list(rows[0])[X:LOW]]
    lines = [list(row.values()) for row in rows if row["panel"] == panel]
    for (series, kind), of in groupby(lines, key=lambda line: (line[SERIES], line[KIND])):
        _draw(ax, series, kind, list(zip(*of)))
    ax.set(xlabel=labels[0], ylabel=labels[1], title=rows[0].get("title") and lines[0][-1] or "")
    if not name.startswith(LINEAR):
        ax.set(xscale="log", yscale="linear" if name.startswith("convergence") else "log")
    elif panel == 2:
        ax.set(yscale="log")
    if len(ax.get_legend_handles_labels()[1]) > 1:
        ax.legend()
    return ax


def _draw(ax: Axes, series: str | None, kind: str, columns: list[tuple[Any, ...]]) -> None:
    x = columns[X]
    y, low, high = (np.array(columns[at], float) for at in (Y, LOW, HIGH))
    if kind == "mark":
        ax.errorbar(x, y, np.where(np.isnan([low, high]), 0, [y - low, high - y]), fmt="o", capsize=3, label=series)
    elif kind == "box":
        ax.vlines(x, low, high, linewidth=6, alpha=0.3, label=series)
    else:
        line, = ax.plot(x, y, drawstyle="steps-pre" if kind == "steps" else "default", label=series)
        if kind == "band":
            ax.fill_between(x, low, high, color=line.get_color(), alpha=0.2, linewidth=0)


def size_against_rate(study: Study, ax: Axes | None = None, normalised: bool = False) -> Axes:
    """Mean fragment size against strain rate with 95 % intervals, beside the scaling laws.

    >>> fracas.plot.size_against_rate(study).figure.savefig("size.pdf")
    """
    return figure(study, "size-against-rate" + ("-normalised" if normalised else ""), ax)


def count_against_rate(study: Study, ax: Axes | None = None) -> Axes:
    """Mean number of fragments against strain rate with 95 % intervals.

    >>> fracas.plot.count_against_rate(study)
    """
    return figure(study, "count-against-rate", ax)


def sizes(study: Study, point: int | None = None, ax: Axes | None = None) -> Axes:
    """Share of the fragments that are at least so large: over the mean size, or of one point.

    >>> fracas.plot.sizes(study, point=2)
    """
    return figure(study, "sizes" if point is None else f"sizes-point-{point}", ax)


def masses(study: Study, ax: Axes | None = None) -> Axes:
    """Number of fragments of a body of mass m or more, a curve a point.

    >>> fracas.plot.masses(study)
    """
    return figure(study, "masses", ax)


def counts(study: Study, point: int, ax: Axes | None = None) -> Axes:
    """Mean number of fragments of a point over time, with its band, if the campaign keeps histories.

    >>> fracas.plot.counts(study, point=2)
    """
    return figure(study, f"fragments-point-{point}", ax)


def energies(study: Study, point: int, ax: Axes | None = None, bands: bool = False) -> Axes:
    """Energies over time of the replica nearest to the mean, or of all with their bands, if the campaign keeps histories.

    >>> fracas.plot.energies(study, point=2)
    """
    return figure(study, f"{'bands' if bands else 'energies'}-point-{point}", ax)
