# SPDX-License-Identifier: GPL-3.0-or-later
"""Campaigns: written, checked, computed, watched and compared, all by the program."""
from __future__ import annotations

import json
import os
import re
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Callable, Union

from .command import Error, PathLike, call, call_json
from .study import Study
from .table import Table, flatten, from_rows

Campaign = Union[PathLike, Mapping[str, Any]]
Say = Union[Callable[[str], object], None]


def to_yaml(of: Mapping[str, Any], indent: str = "") -> str:
    """A campaign as YAML: a line for each value, which is written as JSON, for JSON is YAML, too.

    >>> print(to_yaml({"mesh": {"elements": 500}}))
    mesh:
      elements: 500
    """
    lines = ""
    for key, value in of.items():
        if isinstance(value, Mapping) and value:
            lines += f"{indent}{key}:\n{to_yaml(value, indent + '  ')}"
        else:
            lines += f"{indent}{key}: {json.dumps(value, default=lambda array: array.tolist(), ensure_ascii=False)}\n"
    return lines


def write(campaign: Mapping[str, Any], path: PathLike) -> Path:
    """Writes a campaign file; arrays of numpy may stand for lists. `plan` checks it.

    >>> fracas.write({"name": "my-bar", "model": "bar", "loading": {"type": "imposed-rate", "rate": "1e4 1/s"}}, "my-bar.yaml")
    """
    Path(path).write_text(to_yaml(campaign), encoding="utf-8")
    return Path(path)


@contextmanager
def located(text: str, name: str) -> Iterator[None]:
    """An error that names places of this text, which nobody has as a file, shows their lines."""
    try:
        yield
    except Error as error:
        def show(place: re.Match[str]) -> str:
            return f"campaign:{place[1]} `{text.splitlines()[int(place[1]) - 1].strip()}`"
        told = re.sub(re.escape(name) + r":(\d+):\d+", show, str(error)).replace(name + ": and", "campaign: and")
        raise Error(told, error.status) from None


@contextmanager
def _file(campaign: Campaign) -> Iterator[PathLike]:
    """The file of a campaign; of a mapping one for now, in this folder, from which it may name others."""
    if not isinstance(campaign, Mapping):
        yield campaign
        return
    handle, name = tempfile.mkstemp(".yaml", ".campaign-", os.curdir)
    try:
        text = to_yaml(campaign)
        with open(handle, "w", encoding="utf-8") as file:
            file.write(text)
        with located(text, name):
            yield name
    finally:
        os.unlink(name)


def plan(campaign: Campaign, **options: Any) -> dict[str, Any]:
    """Checks a campaign, a file or a mapping, and says what it would compute: `fracas plan --json`.

    >>> fracas.plan("my-bar.yaml")["realizations"]
    192
    """
    with _file(campaign) as path:
        return call_json("plan", path, **options)


def run(campaign: Campaign, study: PathLike | None = None, say: Say = None, **options: Any) -> Study:
    """Computes a campaign, or what its study lacks, and opens the study. Options are those of `fracas run`.

    `say` gets the lines that tell how far it is. If some realizations FAILED, there is a warning.

    >>> study = fracas.run("my-bar.yaml", jobs=2, say=print)
    """
    with _file(campaign) as path:
        text = call("run", path, study=study, say=say, **options)
    report = re.search(r"^report: (.*)/report/index\.html$", text, re.M)
    return Study(study or report[1])


def _path(study: PathLike | Study) -> PathLike:
    return study.path if isinstance(study, Study) else study


def extend(study: PathLike | Study, replicas: int, say: Say = None, **options: Any) -> Study:
    """Computes more replicas of every point of a study, and opens it again.

    >>> study = fracas.extend(study, replicas=256)
    """
    call("extend", _path(study), replicas=replicas, say=say, **options)
    return Study(_path(study))


def retry(study: PathLike | Study, say: Say = None, **options: Any) -> Study:
    """Computes again what FAILED in a study, and opens it again.

    >>> study = fracas.retry(study, point=3)
    """
    call("retry", _path(study), failed=True, say=say, **options)
    return Study(_path(study))


def replay(study: PathLike | Study, point: int, replica: int, **options: Any) -> str:
    """Computes a realization of a study again and says that its record has the same bytes; Error with 5 if it has not.

    >>> print(fracas.replay("studies/my-bar", point=3, replica=7))
    """
    return call("replay", _path(study), f"{point}/{replica}", **options).rstrip()


def status(study: PathLike | Study) -> dict[str, Any]:
    """How far a study is, point by point, also while it is being computed: `fracas status --json`.

    >>> fracas.status("studies/my-bar")["done"]
    96
    """
    return call_json("status", _path(study))


def watch(study: PathLike | Study, every: float = 2.0) -> Iterator[dict[str, Any]]:
    """The status of a study each `every` seconds, until no run computes it; also if it runs on another host.

    >>> for state in fracas.watch("studies/my-bar"):
    ...     print(state["done"], "of", state["realizations"])
    """
    while True:
        state = status(study)
        yield state
        if not state["running"] and state["lock"] != "elsewhere":
            return
        time.sleep(every)


def compare(a: PathLike | Study, b: PathLike | Study, by: str | None = None) -> Table:
    """In which numbers two studies differ, and how surely: a row for each pair of points and statistic. `attributes` has the rest.

    >>> table = fracas.compare("studies/coarse", "studies/fine").frame()
    >>> table[table.p_holm < 0.05]
    """
    found = call_json("compare", _path(a), _path(b), by=by)
    rows = [{**{key: value for key, value in point.items() if key != "values"}, "statistic": name, **flatten(numbers)}
            for point in found.pop("points") for name, numbers in point["values"].items()]
    return from_rows("compare", rows, {}, attributes=found)
