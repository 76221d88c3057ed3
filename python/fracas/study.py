# SPDX-License-Identifier: GPL-3.0-or-later
"""A study, opened: docs/formats/study.md says what is in its files."""
from __future__ import annotations

import csv
import json
import re
import sqlite3
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any, Callable
from urllib.parse import quote

import h5py
import numpy as np

from .command import Error, PathLike, call, call_json, meanings
from .table import Column, Table, flatten, from_rows

ASKED_BY = {"interface": "output: {interfaces: true}", "mesh": "output: {interfaces: true} and a surface", "decision": "replicas: {until: ...}",
            "probe": "probes: {tip: [9 mm, 0]}", "reaction": "output: {reactions: edges}"}


def _connect(path: Path) -> sqlite3.Connection:
    """An index, to read. SQLite needs files beside it, unless nobody writes: as in a folder that cannot be written."""
    uri = f"file:{quote(str(path.resolve()))}?mode=ro"
    index = sqlite3.connect(uri, uri=True)
    try:
        index.execute("SELECT 1 FROM sqlite_master")
    except sqlite3.OperationalError:
        index.close()
        index = sqlite3.connect(uri + "&immutable=1", uri=True)
    return index


def _sources(folder: Path) -> tuple[list[Path], list[tuple[int, int]]]:
    """study.h5 and nothing; or, while it lacks what the index has, segments, the newest last, and segment and row of each realization."""
    whole, path = folder / "study.h5", folder / "index.sqlite"
    if not path.exists():
        if whole.exists():
            return [whole], []
        raise Error(f"{folder} is no study: it has neither study.h5 nor index.sqlite", 5)
    index = _connect(path)
    try:
        sealed = index.execute("SELECT value FROM meta WHERE key = 'study_seal'").fetchone()
        planned, left = index.execute("SELECT count(*), total(status IN ('planned', 'leased')) FROM realization").fetchone()
        if whole.exists() and sealed and sealed[0] and not left:
            with h5py.File(whole, "r") as file:
                if len(file["realization/point"]) == planned:
                    return [whole], []
        segments = index.execute("SELECT id, name FROM segment ORDER BY id").fetchall()
        rows = index.execute("SELECT segment, row FROM realization WHERE status = 'done' AND segment IS NOT NULL").fetchall()
    finally:
        index.close()
    if not rows:
        raise Error(f"{folder}: no realization is done yet; `fracas run {folder}/campaign.yaml --study {folder}` goes on", 3)
    number = {identity: n for n, (identity, _) in enumerate(segments)}
    return [folder / "segments" / name for _, name in segments], [(number[segment], row) for segment, row in rows]


def _text(values: Any) -> Any:
    """Text of HDF5 as Python's; numbers as they are."""
    if isinstance(values, bytes):
        return values.decode()
    return np.char.decode(values) if values.dtype.kind == "S" else values


def _ranges(first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """first[0], ..., last[0] - 1, first[1], ..."""
    counts = last - first
    return np.repeat(last - counts.cumsum(), counts) + np.arange(counts.sum())


def _connected(sides: np.ndarray, count: int) -> np.ndarray:
    """The lowest of the elements, 0 to count - 1, that each is connected to by pairs of neighbours."""
    lowest = np.arange(count)
    while True:
        before = lowest.copy()
        ends = before[sides]
        for side in (0, 1):
            np.minimum.at(lowest, ends[:, side], ends.min(axis=1))
        while not np.array_equal(lowest, lowest[lowest]):
            lowest = lowest[lowest]
        if np.array_equal(lowest, before):
            return lowest


def probe_places(attributes: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Names and places of the probes, "tip 0.009 0 0; middle 0 0 0" in the attribute `probes` of a study."""
    words = [probe.split() for probe in attributes.get("probes", "").split("; ") if probe]
    return {name: np.array(place, float) for name, *place in words}


class Realization:
    """What a study has of a realization, or what `fracas.realize` has computed.

    >>> realization = study.realization(point=2, replica=5)
    >>> realization["dissipated"], realization.fragments["size"].mean(), realization.history["time"][-1]
    (0.0135, 0.00013, 3e-07)
    """

    def __init__(self, numbers: Table, table: Callable[[str], Table], sides: Callable[[int, int], np.ndarray] | None = None) -> None:
        self.numbers, self._table, self._sides = numbers, table, sides

    def __getitem__(self, name: str) -> Any:
        return self.numbers[name][0]

    @property
    def fragments(self) -> Table:
        """Its fragments.

        >>> realization.fragments["mass"].sum()
        """
        return self._table("fragment")

    @property
    def history(self) -> Table:
        """Its energies and counts over time.

        >>> realization.history["broken"][-1]
        """
        return self._table("history")

    @property
    def interfaces(self) -> Table:
        """Its interfaces, if the campaign keeps them.

        >>> realization.interfaces["strength"].min()
        """
        return self._table("interface")

    @property
    def element_fragments(self) -> np.ndarray:
        """The row in `fragments` of each element, if the study keeps interfaces (and, of surfaces, is complete).

        >>> realization.fragments["mass"][realization.element_fragments]
        """
        if self._sides is None:
            raise Error("the fragments of elements are those of a study: of fracas.realize there is no mesh", 2)
        elements, broken = self.fragments["elements"], np.isfinite(self.interfaces["break_time"])
        lowest = _connected(self._sides(int(elements.sum()), len(broken))[~broken], int(elements.sum()))
        rows = np.unique(lowest, return_inverse=True)[1]
        if not np.array_equal(np.bincount(rows, minlength=len(elements)), elements):
            raise Error("the broken interfaces are not those between the fragments: see `fracas verify --full`", 5)
        return rows

    @property
    def probes(self) -> dict[str, Table]:
        """Time, displacement and velocity of each probe by its name, if the campaign has probes; of `fracas.realize` by its number, "0".

        >>> realization.probes["tip"]["displacement"][:, 0].max()
        """
        table = self._table("probe")
        number = table["probe"]
        names = list(probe_places(table.attributes)) or [str(n) for n in range(int(number.max(initial=-1)) + 1)]

        def of(n: int) -> Table:
            return Table("probe", {name: Column(lambda column=column: column.read()[number == n], column.unit, column.description)
                                   for name, column in table.columns.items() if name != "probe"}, table.attributes)
        return {name: of(n) for n, name in enumerate(names)}

    @property
    def reactions(self) -> dict[int, Table]:
        """Time and force on the body of each held edge by its tag, of nodes held by the n-th loading by -n, if
        the campaign keeps reactions.

        >>> realization.reactions[1]["force"][:, 0].min()
        """
        table = self._table("reaction")
        edge = table["edge"]

        def of(tag: int) -> Table:
            return Table("reaction", {name: Column(lambda column=column: column.read()[edge == tag], column.unit, column.description)
                                      for name, column in table.columns.items() if name != "edge"}, table.attributes)
        return {int(tag): of(tag) for tag in np.unique(edge)}


class Study:
    """A study whose arrays are read when they are asked for; of a partial one, the realizations that are done.

    >>> with fracas.open("studies/bar-rate-sweep") as study:
    ...     print(study.fragments["size"].mean(), study.fragments.units["size"])
    0.00013 m
    """

    def __init__(self, path: PathLike) -> None:
        path = Path(path)
        self.path = path.parent if path.name == "study.h5" else path
        self._whole: h5py.File | None = None
        try:
            self._files, where = _sources(self.path)
            if not where:
                self._whole = h5py.File(self._files[0], "r")
            with self._opened() as file:
                self.attributes: dict[str, Any] = {name: _text(value) for name, value in file.attrs.items()}
            self._order(where)
        except (OSError, KeyError, sqlite3.DatabaseError) as error:
            self.close()
            raise Error(f"{self.path} cannot be read ({error}): see `fracas verify {self.path}`", 5) from error

    @contextmanager
    def _opened(self, number: int = -1) -> Iterator[h5py.File]:
        """study.h5, or a segment, for as long as it is read: there can be thousands."""
        if self._whole is not None:
            yield self._whole
        else:
            with h5py.File(self._files[number], "r") as file:
                yield file

    def _each(self, what: str) -> list[np.ndarray]:
        """A dataset, of every file."""
        found = []
        for number in range(len(self._files)):
            with self._opened(number) as file:
                found.append(_text(file[what][()]))
        return found

    def _order(self, where: list[tuple[int, int]]) -> None:
        """Sets file and row of each realization, in plan order: by the newest file's points; others are no longer planned."""
        hashes, points, replicas = self._each("point/hash"), self._each("realization/point"), self._each("realization/replica")
        number = {name: row for row, name in enumerate(hashes[-1])}
        known = [np.array([number.get(name, -1) for name in names])[rows] for names, rows in zip(hashes, points)]
        file, row = np.array(where).T if where else (np.zeros(len(points[0]), int), np.arange(len(points[0])))
        at = np.cumsum([0] + [len(rows) for rows in points])[file] + row
        point, replica = np.concatenate(known)[at], np.concatenate(replicas)[at]
        order = np.lexsort((replica, point))
        order = order[point[order] >= 0]
        self._point, self._replica, self._file, self._row = point[order], replica[order], file[order], row[order]
        self._ends = {"realization": (self._row, self._row + 1)}

    @property
    def partial(self) -> bool:
        """True if study.h5 lacks what is done or planned, and the arrays are of the realizations that are done.

        >>> study.partial
        False
        """
        return self._whole is None

    def close(self) -> None:
        """Closes study.h5.

        >>> study.close()
        """
        if self._whole is not None:
            self._whole.close()

    def __enter__(self) -> Study:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"study {self.path}: {len(self._row)} realizations{', partial' if self.partial else ''}"

    @property
    def campaign(self) -> str:
        """The campaign as resolved: the text of campaign.yaml.

        >>> study.campaign.splitlines()[1]
        'name: bar-rate-sweep'
        """
        path = self.path / "campaign.yaml"
        if path.exists():
            return path.read_text()
        with self._opened() as file:
            if "campaign" not in file:
                raise Error(f"{self.path} has no campaign.yaml, and study.h5 none of format version {self.attributes['format_version']}", 5)
            return _text(file["campaign/resolved"][0])

    # ---- arrays ----

    def _bounds(self, group: str) -> tuple[np.ndarray, np.ndarray]:
        """First and last row (excluded), in its file, of what each realization has in a group."""
        if group not in self._ends:
            first, last = np.empty((2, len(self._row)), int)
            for number, offset in enumerate(self._each(group + "/offset")):
                here = self._file == number
                first[here], last[here] = offset[self._row[here]], offset[self._row[here] + 1]
            self._ends[group] = first, last
        return self._ends[group]

    def _column(self, group: str, name: str) -> np.ndarray:
        """What all realizations have in a column, in their order."""
        if (group, name) == ("realization", "point"):
            return self._point
        values = self._each(f"{group}/{name}")
        if not self.partial:
            return values[0]
        base = np.cumsum([0] + [len(rows) for rows in values])[self._file]
        first, last = self._bounds(group)
        return np.concatenate(values)[_ranges(base + first, base + last)]

    def _slice(self, group: str, name: str, row: int) -> np.ndarray:
        """What a realization has in a column."""
        first, last = self._bounds(group)
        with self._opened(self._file[row]) as file:
            return file[group][name][first[row]:last[row]]

    def _table(self, group: str, read: Callable[[str], np.ndarray]) -> Table:
        """The columns of a group, beside its offsets."""
        with self._opened() as file:
            if group not in file:
                raise Error(f"{self.path} has no /{group}{' by now' if self.partial else ''}: "
                            f"it comes from a campaign with `{ASKED_BY.get(group, group)}`", 2)
            return Table(group, {name: Column(lambda name=name: read(name), _text(data.attrs["unit"]), _text(data.attrs["description"]))
                                 for name, data in file[group].items() if not name.endswith("offset")}, self.attributes)

    def _newest(self, group: str) -> Table:
        """A group as study.h5, or the newest segment, has it."""
        def read(name: str) -> np.ndarray:
            with self._opened() as file:
                return _text(file[group][name][()])
        return self._table(group, read)

    def _ragged(self, group: str) -> Table:
        """A group with any number of rows for each realization, led by `point` and `replica` of each row."""
        table = self._table(group, lambda name: self._column(group, name))
        counts = np.subtract(*self._bounds(group)[::-1])
        for name in ("replica", "point"):
            of = self.realizations.columns[name]
            table.columns = {name: Column(lambda of=of: np.repeat(of.read(), counts), of.unit, of.description), **table.columns}
        return table

    @cached_property
    def points(self) -> Table:
        """The points, with every parameter by its path and the columns `derived.`.

        >>> study.points["derived.strain_rate"]
        array([1.e+03, 1.e+04, 1.e+05, 1.e+06])
        """
        return self._newest("point")

    @cached_property
    def realizations(self) -> Table:
        """The realizations in plan order; `point` is the row in `points`.

        >>> study.realizations.frame().groupby("point")["fragments"].mean()
        """
        return self._table("realization", lambda name: self._column("realization", name))

    @cached_property
    def fragments(self) -> Table:
        """The fragments of all realizations.

        >>> study.fragments["mass"].sum()
        """
        return self._ragged("fragment")

    @cached_property
    def histories(self) -> Table:
        """Energies and counts over time of all realizations.

        >>> study.histories.frame("point", "replica", "time", "dissipated")
        """
        return self._ragged("history")

    @cached_property
    def interfaces(self) -> Table:
        """The interfaces of all realizations, if the campaign keeps them.

        >>> study.interfaces["strength"].min()
        """
        return self._ragged("interface")

    @cached_property
    def probes(self) -> Table:
        """Displacements and velocities of the probes of all realizations, if the campaign has probes; `probe` is a number in `probe_places`.

        >>> study.probes.frame("point", "replica", "time", "probe", "displacement")
        """
        return self._ragged("probe")

    @cached_property
    def reactions(self) -> Table:
        """Forces of the held edges on the body, of all realizations, if the campaign keeps them.

        >>> study.reactions.frame("point", "replica", "time", "edge", "force")
        """
        return self._ragged("reaction")

    @property
    def probe_places(self) -> dict[str, np.ndarray]:
        """Place of each probe before any motion [m], by its name.

        >>> study.probe_places["tip"]
        array([0.009, 0.   , 0.   ])
        """
        return probe_places(self.attributes)

    @cached_property
    def decisions(self) -> Table:
        """The rounds of points whose replicas a rule decides.

        >>> study.decisions.frame("point", "round", "mean", "half_width")
        """
        return self._newest("decision")

    def mesh(self, point: int) -> dict[str, np.ndarray]:
        """The mesh of a point, if the campaign keeps interfaces and it is a surface; nodes and elements count from 0 in it.

        >>> mesh = study.mesh(0)
        >>> mesh["node_position"][mesh["interface_node"][:, :2]].shape
        (2981, 2, 3)
        """
        names = self._table("mesh", np.empty)
        with self._opened() as file:
            mesh = file["mesh"]
            ends = {name: mesh[name.split("_")[0] + "_offset"][point:point + 2] for name in names}
            return {name: mesh[name][first:last] for name, (first, last) in ends.items()}

    def realization(self, point: int, replica: int) -> Realization:
        """One realization, without reading the others.

        >>> study.realization(point=2, replica=5).fragments["size"].mean()
        0.00013
        """
        found = np.flatnonzero((self._point == point) & (self._replica == replica))
        if not len(found):
            raise Error(f"{self.path} has no realization of point {point} and replica {replica}{' by now' if self.partial else ''}", 2)

        def table(group: str) -> Table:
            return self._table(group, lambda name: self._slice(group, name, found[0]))

        def sides(elements: int, interfaces: int) -> np.ndarray:
            if self.points["derived.surface"][point]:
                return self.mesh(point)["interface_element"]
            return np.column_stack((np.arange(interfaces), np.arange(1, interfaces + 1) % max(elements, 1)))
        return Realization(table("realization"), table, sides)

    # ---- the report's numbers ----

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The JSON summary of `fracas report` (docs/formats/summary.md), which writes the study's report on the way.

        >>> [warning["text"] for warning in study.summary["warnings"]]
        """
        return call_json("report", self.path)

    def report(self) -> Path:
        """Writes the study's report, if this object has not done it, and returns its folder.

        >>> (study.report() / "size-against-rate.pdf").exists()
        True
        """
        self.summary  # the command that prints it writes the report
        return self.path / "report"

    @cached_property
    def statistics(self) -> Table:
        """Label, parameters and statistics of each point, as the report has them.

        >>> study.statistics.frame("derived.strain_rate", "size.mean", "size.half_width")
        """
        units = {**self.summary["units"]["parameters"], **self.summary["units"]["statistics"]}
        texts = {**self.points.descriptions, **{key: text for key, (_, text) in meanings("statistics").items()}}
        return from_rows("statistics", [{"label": point["label"], **point["parameters"], **point["statistics"]}
                                        for point in self.summary["points"]], units, texts, self.attributes)

    @cached_property
    def convergence(self) -> Table:
        """Headline numbers of each point from its first 4, 8, 16, ... replicas and from all, with intervals.

        >>> study.convergence.frame("point", "replicas", "count.value")
        """
        return self._listed("convergence", [{"point": number, **flatten(row)} for number, point in enumerate(self.summary["points"])
                                            for row in point["convergence"]])

    @cached_property
    def energies(self) -> Table:
        """Mean energies of each point over time, with their band, if the campaign keeps histories.

        >>> study.energies.frame("point", "time", "dissipated.mean")
        """
        return self._listed("energies", read_csv(self.report() / "energies.csv"))

    # ---- cracks over time, of surfaces with interfaces kept ----

    @cached_property
    def _cracks(self) -> dict[str, Table]:
        with tempfile.TemporaryDirectory() as folder:
            call("export", self.path, cracks=True, to=folder)
            package = json.loads((Path(folder) / "datapackage.json").read_text(encoding="utf-8"))
            fields = {one["name"]: one["schema"]["fields"] for one in package["resources"]}
            return {name: from_rows(name, read_csv(Path(folder) / f"{name}.csv"), {of["name"]: of.get("unit", "") for of in fields[name]},
                                    {of["name"]: of.get("description", "") for of in fields[name]}) for name in ("cracks", "breaks")}

    @property
    def cracks(self) -> Table:
        """The cracks of each realization of a surface: where they begin, how long they are, how many tips they have.

        They are made from the interfaces that the study keeps, by `fracas export --cracks` (docs/theory/cracks.md).

        >>> study.cracks.frame("point", "replica", "number", "length", "fastest")
        """
        return self._cracks["cracks"]

    @property
    def breaks(self) -> Table:
        """The breaks of which cracks are made, in the order of time: length of the crack and speed of its tip.

        >>> study.breaks.frame("point", "replica", "crack", "time", "crack_length", "speed")
        """
        return self._cracks["breaks"]

    def _listed(self, name: str, rows: list[dict[str, Any]]) -> Table:
        known = {"time": ("s", "time"), **meanings("statistics")}
        told = {key: known.get(key) or known.get(key.rpartition(".")[0]) or ("1", "") for key in (rows[0] if rows else ())}
        return from_rows(name, rows, {key: unit for key, (unit, _) in told.items()}, {key: text for key, (_, text) in told.items()})


def read_csv(path: Path) -> list[dict[str, Any]]:
    """The lines of a table of the report: an empty field is None, and what reads as a number is one.

    >>> read_csv(study.report() / "masses.csv")[0]["series"]
    'rate 1e3 1/s'
    """
    def value(text: str) -> Any:
        if re.fullmatch(r"-?\d+", text):
            return int(text)
        try:
            return float(text) if text else None
        except ValueError:
            return text
    with path.open(newline="", encoding="utf-8") as file:
        return [{key: value(text) for key, text in line.items()} for line in csv.DictReader(file)]


def open(path: PathLike) -> Study:
    """Opens a study: its folder, or study.h5 alone.

    >>> study = fracas.open("studies/bar-rate-sweep")
    """
    return Study(path)
