"""Checks frames and figures of the package fracas, as it is installed, on the study that tests/unit/python_notebook.sh has made."""
import csv
import subprocess

import numpy as np
from matplotlib import pyplot

import fracas

version = subprocess.run([fracas.program(), "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
assert "venv" in fracas.__file__ and fracas.__version__ == version, (fracas.__file__, fracas.__version__, version)

study = fracas.open("one")
frame = study.fragments.frame()
assert len(frame) == len(study.fragments["mass"]) and frame.attrs["units"]["position_x"] == "m" and frame.attrs["descriptions"]["mass"] == "mass"
assert list(frame.position_y) == list(study.fragments["position"][:, 1]) and list(study.fragments.frame("size").columns) == ["size"]
counts = frame.groupby(["point", "replica"])["mass"].count()
assert list(counts) == list(study.realizations["fragments"])
outcome = study.realizations.frame().outcome
assert (outcome.cat.codes == study.realizations["outcome"]).all() and set(outcome) <= {"FRAGMENTED", "TIME_LIMIT"}
assert study.statistics.frame().attrs["units"]["size.mean"] == "m" and list(study.points.frame().model) == ["bar", "bar"]
sizes = study.fragments.xarray()
assert sizes["velocity"].shape == (len(frame), 3) and sizes["size"].attrs == {"units": "m", "long_name": study.fragments.descriptions["size"]}


def lines_of(name, kind):
    with open(f"one/report/{name}.csv", newline="") as file:
        lines = [line for line in csv.reader(file) if line[2] == kind and line[0] == "1"]
    return {series: np.array([[float(value or "nan") for value in line[3:]] for line in lines if line[1] == series]) for series in {line[1] for line in lines}}


# Every figure has the points of its table, with the intervals.
marks, = lines_of("size-against-rate", "mark").values()
ax = fracas.plot.size_against_rate(study)
bar, = ax.containers
assert np.array_equal(bar.lines[0].get_xydata(), marks[:, :2]) and ax.get_xscale() == ax.get_yscale() == "log" and ax.get_ylabel() == "mean fragment size [µm]"
low, high = (line.get_ydata() for line in bar.lines[1])
assert np.allclose(low, marks[:, 2], rtol=1e-12) and np.allclose(high, marks[:, 3], rtol=1e-12)
mean, half = study.statistics["size.mean"], study.statistics["size.half_width"]
assert np.allclose(marks[:, 1] / 1e6, mean, rtol=1e-14) and np.allclose(marks[:, 3] / 1e6, mean + half, rtol=1e-14)
for draw, name, kind, scale in ((fracas.plot.masses, "masses", "steps", "log"), (fracas.plot.sizes, "sizes", "steps", "log"),
                                (lambda of: fracas.plot.energies(of, 1), "energies-point-1", "curve", "linear"),
                                (lambda of: fracas.plot.counts(of, 1), "fragments-point-1", "band", "linear"),
                                (lambda of: fracas.plot.energies(of, 0, bands=True), "bands-point-0", "band", "linear")):
    ax = draw(study)
    drawn = {line.get_label(): line for line in ax.lines}
    for series, values in lines_of(name, kind).items():
        assert np.array_equal(drawn[series].get_xydata(), values[:, :2]), (name, series)
    assert ax.get_yscale() == scale and (len(ax.collections) > 0) == (kind == "band") and (ax.lines[0].get_drawstyle() == "steps-pre") == (kind == "steps")
final, = lines_of("fragments-point-1", "mark").values()  # its interval is not symmetric
bar, = fracas.plot.counts(study, 1).containers
assert np.allclose(bar.lines[2][0].get_segments()[0][:, 1], final[0, 2:], rtol=1e-12) and final[0, 3] - final[0, 1] != final[0, 1] - final[0, 2]
given = pyplot.subplots()[1]
assert fracas.plot.count_against_rate(study, given) is given and fracas.plot.figure(study, "energies-point-0", panel=2).get_yscale() == "log"
try:
    fracas.plot.figure(study, "nothing")
    raise SystemExit("a figure of nothing")
except fracas.Error as error:
    assert error.status == 2 and "masses" in str(error)
