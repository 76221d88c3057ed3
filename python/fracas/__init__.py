# SPDX-License-Identifier: GPL-3.0-or-later
"""Campaigns and studies of fracas in Python.

>>> import fracas
>>> study = fracas.run("campaigns/examples/bar-rate-sweep.yaml")
>>> study.statistics.frame("loading.rate", "size.mean", "size.half_width")
>>> fracas.plot.size_against_rate(study)
"""
from importlib import metadata

from . import kernel, plot
from .campaign import compare, extend, plan, replay, retry, run, status, watch, write
from .command import Error, call, call_json, program
from .kernel import realize
from .study import Realization, Study, open
from .table import Table

try:
    __version__ = metadata.version("fracas")
except metadata.PackageNotFoundError:  # imported from the source tree, not installed
    __version__ = "0+source"

__all__ = ["Error", "Realization", "Study", "Table", "call", "call_json", "compare", "extend", "kernel", "open", "plan", "plot", "program",
           "realize", "replay", "retry", "run", "status", "watch", "write"]
