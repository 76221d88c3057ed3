# SPDX-License-Identifier: GPL-3.0-or-later
"""The kernel, by libfracas (library/fracas.h): realizations computed in this process."""
from __future__ import annotations

import ctypes
from contextlib import ExitStack
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from .campaign import Campaign, located, to_yaml
from .command import Error, program
from .study import Realization
from .table import Column, Table


class _Column(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char_p), ("type", ctypes.c_char_p), ("unit", ctypes.c_char_p), ("meaning", ctypes.c_char_p),
                ("width", ctypes.c_size_t), ("bytes", ctypes.c_size_t)]


@lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """libfracas of the program: beside it where it was built, in ../lib where it is installed, or where the system has it.

    >>> fracas.kernel.library().fracas_version()
    b'0.2.1'
    """
    folder = Path(program()).resolve().parent
    for path in (folder / "libfracas.so", *folder.parent.glob("lib*/libfracas.so.0"), *folder.parent.glob("lib/*/libfracas.so.0"), "libfracas.so.0"):
        try:
            found = ctypes.CDLL(str(path))
            break
        except OSError:
            continue
    else:
        raise Error(f"no libfracas beside {folder}, in {folder.parent}/lib or where the system looks: install it with the program", 6)
    for name in ("fracas_error", "fracas_version", "fracas_table_name"):
        getattr(found, name).restype = ctypes.c_char_p
    for name in ("fracas_table_columns", "fracas_realization_rows", "fracas_realizer_strengths"):
        getattr(found, name).restype = ctypes.c_size_t
    return found


def _check(status: int) -> None:
    if status:
        raise Error(library().fracas_error().decode(), status)


def _open(stack: ExitStack, name: str, *arguments: Any) -> ctypes.c_void_p:
    """What fracas_NAME makes, closed with the stack."""
    made = ctypes.c_void_p()
    _check(getattr(library(), f"fracas_{name}")(*arguments, ctypes.byref(made)))
    stack.callback(getattr(library(), f"fracas_{name.split('_')[0]}_close"), made)
    return made


def _campaign(stack: ExitStack, campaign: Campaign) -> ctypes.c_void_p:
    if not hasattr(campaign, "items"):
        return _open(stack, "campaign_open", str(campaign).encode())
    text = to_yaml(campaign)
    with located(text, "campaign"):
        return _open(stack, "campaign_open_text", text.encode(), ctypes.c_size_t(len(text.encode())), b"campaign")


def _tables(realization: ctypes.c_void_p) -> dict[str, Table]:
    """The tables of a realization by name, as study.h5 has them."""
    found, number = {}, 0
    while name := library().fracas_table_name(number):
        rows, columns = library().fracas_realization_rows(realization, number), {}
        for i in range(library().fracas_table_columns(number)):
            of = _Column()
            _check(library().fracas_table_column_at(number, ctypes.c_size_t(i), ctypes.byref(of)))
            values = np.empty((rows, of.width) if of.width > 1 else rows, of.type.decode())
            _check(library().fracas_realization_get(realization, number, ctypes.c_size_t(i), values.ctypes, ctypes.c_size_t(values.nbytes)))
            columns[of.name.decode()] = Column(lambda values=values: values, of.unit.decode(), of.meaning.decode())
        found[name.decode()] = Table(name.decode(), columns)
        number += 1
    return found


def realize(campaign: Campaign, point: int = 0, replica: int = 0, strength: np.ndarray | None = None, threads: int = 0) -> Realization:
    """Computes a realization of a campaign, a file or a mapping: the record that `fracas run` stores, to the last bit.

    `strength` [Pa], of every interface or Gauss point in the order of `fracas sample`, takes the place of those that the replica draws.
    `threads` may share a large surface; the numbers stay. Until it ends, Ctrl-C waits.

    >>> fracas.realize("campaigns/examples/ring-mott.yaml", point=1, replica=7).fragments["size"].mean()
    """
    with ExitStack() as stack:
        realizer = _open(stack, "realizer_open", _campaign(stack, campaign), ctypes.c_size_t(point))
        given = None
        if strength is not None:
            given, wanted = np.ascontiguousarray(strength, float), library().fracas_realizer_strengths(realizer)
            if given.shape != (wanted,):
                raise Error(f"strengths of the shape {given.shape}; point {point} needs ({wanted},)", 2)
        made = ctypes.c_void_p()
        _check(library().fracas_realizer_compute(realizer, ctypes.byref(ctypes.c_int64(replica)), ctypes.c_size_t(1),
                                                 given.ctypes if given is not None else None, threads, ctypes.byref(made)))
        stack.callback(library().fracas_realization_close, made)
        tables = _tables(made)
    return Realization(tables["realization"], tables.__getitem__)
