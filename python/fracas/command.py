# SPDX-License-Identifier: GPL-3.0-or-later
"""The program fracas: where it is, and what it says."""
from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any, Callable, Union

PathLike = Union[str, "os.PathLike[str]"]


class Error(Exception):
    """A failure: the program's message, and `status`, its exit status (docs/formats/exit-status.md).

    >>> try:
    ...     fracas.plan({"name": "bar", "modle": "bar"})
    ... except fracas.Error as error:
    ...     print(error.status, error)
    """

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


def program() -> str:
    """Path of the program: $FRACAS; or on PATH, beside this Python, beside this package's lib, or built in its source tree.

    >>> fracas.program()
    '/usr/bin/fracas'
    """
    here = Path(__file__).resolve().parents
    named = os.environ.get("FRACAS")
    places = [Path(named)] if named else [
        Path(shutil.which("fracas") or ""), Path(sys.prefix, "bin", "fracas"), *(folder / "bin" / "fracas" for folder in here),
        *(here[2] / "build" / preset / "fracas" for preset in ("release", "werror"))]
    for path in places:
        if path.is_file() and os.access(path, os.X_OK):
            return str(path)
    raise Error(f"FRACAS names no program: {named}" if named else
                "no program fracas: install it, or let the environment's FRACAS name it (build/release/fracas of the source tree)", 6)


def arguments(options: dict[str, Any]) -> list[str]:
    """Options as the command line has them: walltime="1h" is --walltime 1h, and force=True is --force."""
    words: list[str] = []
    for name, value in options.items():
        if value is not None and value is not False:
            words += ["--" + name.replace("_", "-")] + ([] if value is True else [str(value)])
    return words


def call(*words: PathLike, say: Callable[[str], object] | None = None, **options: Any) -> str:
    """Runs a command to its end and returns its standard output. `say` gets each line of standard error as it comes.

    An exit status but 0 and 1 raises Error; 1, some realizations FAILED, is a warning. Ctrl-C reaches the program, too: it stores
    what it computes and ends with 3.

    >>> fracas.call("report", "studies/my-bar", json=True)
    """
    command = [program(), *(os.fspath(word) for word in words), *arguments(options)]
    said: list[str] = []
    interrupts = 0
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output, subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE, text=True, encoding="utf-8") as process:
        while True:
            try:
                for line in process.stderr or ():
                    said.append(line.rstrip("\n"))
                    if say:
                        say(said[-1])
                status = process.wait()
                break
            except KeyboardInterrupt:
                interrupts += 1
                if interrupts > 1:
                    process.terminate()
        output.seek(0)
        text = output.read()
    errors = [line.removeprefix("fracas: ") for line in said if line.startswith("fracas: ")] or said[-1:]
    message = "\n".join(errors) or f"{' '.join(command)} ended with status {status}"
    if status == 1:
        warnings.warn(message, stacklevel=3)
    elif status != 0:
        raise Error(message, status if status > 0 else 128 - status)
    return text


def call_json(*words: PathLike, **options: Any) -> dict[str, Any]:
    """What a command prints with --json.

    >>> fracas.call_json("status", "studies/my-bar")["done"]
    640
    """
    return json.loads(call(*words, json=True, **options))


def meanings(option: str) -> dict[str, tuple[str, str]]:
    """Unit and meaning of each key in the tables that `fracas reference --OPTION` prints, which end with both.

    >>> meanings("statistics")["size.mean"]
    ('m', 'mean over replicas of: mean fragment size')
    """
    rows = re.findall(r"^\| `([^`]+)` \|.* \| (\S*) ?\| (.*) \|$", call("reference", **{option: True}), re.M)
    return {key: (unit, text) for key, unit, text in rows}
