# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of equal length, each with its unit and meaning, read when they are asked for."""
from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

if TYPE_CHECKING:
    import pandas
    import xarray as _xarray


@dataclass(frozen=True)
class Column:
    """How to read an array (rows) or (rows, k), its unit (SI; "1" of a pure number, "" of text) and its meaning."""

    read: Callable[[], np.ndarray]
    unit: str = ""
    description: str = ""


@dataclass(repr=False)
class Table(Mapping[str, np.ndarray]):
    """Arrays by name. `units` and `descriptions` say what they are.

    >>> study.realizations["dissipated"].mean(), study.realizations.units["dissipated"]
    (0.0079, 'J')
    """

    name: str
    columns: dict[str, Column]
    attributes: dict[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name].read()

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        return f"{self.name}: " + ", ".join(f"{name} [{unit}]" if unit else name for name, unit in self.units.items())

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column.

        >>> study.fragments.units["size"]
        'm'
        """
        return {name: column.unit for name, column in self.columns.items()}

    @property
    def descriptions(self) -> dict[str, str]:
        """Meaning of each column.

        >>> study.fragments.descriptions["mass"]
        'mass'
        """
        return {name: column.description for name, column in self.columns.items()}

    def labels(self, name: str) -> list[str]:
        """Names of the numbers 0, 1, ... of a column whose meaning lists them (0 FRAGMENTED, 1 INTACT, ...); of others none.

        >>> study.realizations.labels("outcome")[0]
        'FRAGMENTED'
        """
        return re.findall(r"\d+ ([A-Z][A-Z_]+)\b", self.columns[name].description)

    def frame(self, *names: str) -> pandas.DataFrame:
        """These columns (all) as a pandas.DataFrame, with `units` and `descriptions` in its `attrs`.

        A vector becomes a column for each component (position_x, or node_0), and a number with names its name.

        >>> study.realizations.frame("point", "outcome", "fragments")
        """
        import pandas
        values: dict[str, Any] = {}
        units = {}
        for name in names or self.columns:
            array, labels = self[name], self.labels(name)
            if array.ndim == 2:
                parts = "xyz" if array.dtype.kind == "f" and array.shape[1] == 3 else range(array.shape[1])
                values.update({f"{name}_{part}": column for part, column in zip(parts, array.T)})
                units.update({f"{name}_{part}": self.units[name] for part in parts})
            else:
                values[name] = pandas.Categorical.from_codes(array, labels) if labels else array
                units[name] = self.units[name]
        frame = pandas.DataFrame(values)
        frame.attrs = {"units": units, "descriptions": {name: self.descriptions[name] for name in names or self.columns}}
        return frame

    def xarray(self, *names: str) -> _xarray.Dataset:
        """These columns (all) as an xarray.Dataset whose variables have the attributes `units` and `long_name`.

        >>> study.fragments.xarray("size")["size"].attrs["units"]
        'm'
        """
        import xarray
        variables = {}
        for name in names or self.columns:
            array, column = self[name], self.columns[name]
            dimensions = ("row", f"{name}_component")[:array.ndim]
            variables[name] = (dimensions, array, {"units": column.unit, "long_name": column.description})
        return xarray.Dataset(variables, attrs=self.attributes)


def flatten(of: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """The values of nested objects, by their keys joined with dots.

    >>> flatten({"size": {"mean": 1.0}})
    {'size.mean': 1.0}
    """
    flat: dict[str, Any] = {}
    for key, value in of.items():
        flat.update(flatten(value, f"{before}{key}.") if isinstance(value, Mapping) else {before + key: value})
    return flat


def from_rows(name: str, rows: list[dict[str, Any]], units: Mapping[str, str], descriptions: Mapping[str, str] | None = None,
              attributes: dict[str, Any] | None = None) -> Table:
    """Objects of JSON, one a row: null is NaN among numbers and empty among texts.

    >>> from_rows("two", [{"x": 1}, {"x": None}], {"x": "m"})["x"]
    array([ 1., nan])
    """
    def array(key: str) -> np.ndarray:
        values = [row.get(key) for row in rows]
        if any(isinstance(value, str) for value in values):
            return np.array([value or "" for value in values])
        if any(value is None for value in values):
            return np.array([np.nan if value is None else value for value in values], float)
        return np.array(values)

    names = dict.fromkeys(key for row in rows for key in row)
    return Table(name, {key: Column(lambda key=key: array(key), units.get(key, ""), (descriptions or {}).get(key, "")) for key in names},
                 attributes or {})
