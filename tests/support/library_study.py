#!/usr/bin/env python3
"""usage: library_study.py LIBRARY CAMPAIGN STUDY.h5 [all]

Computes realizations of the study again with libfracas, by ctypes: the first and last of each point, or all. Every column of
every table must have the bytes of the study, and no column may be missing on either side."""
import ctypes
import sys
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_int64, c_size_t, c_void_p

import h5py
import numpy as np

library, campaign_path, study_path = sys.argv[1:4]
fracas = ctypes.CDLL(library)
TABLES = 6


class Column(ctypes.Structure):
    _fields_ = [("name", c_char_p), ("type", c_char_p), ("unit", c_char_p), ("meaning", c_char_p), ("width", c_size_t), ("bytes", c_size_t)]


def declare(name, result, *arguments):
    function = getattr(fracas, name)
    function.restype, function.argtypes = result, arguments
    return function


error = declare("fracas_error", c_char_p)
declare("fracas_campaign_open", c_int, c_char_p, POINTER(c_void_p))
declare("fracas_campaign_open_text", c_int, c_char_p, c_size_t, c_char_p, POINTER(c_void_p))
declare("fracas_campaign_resolved", c_int, c_void_p, POINTER(c_void_p))
declare("fracas_text_close", None, c_void_p)
declare("fracas_campaign_close", None, c_void_p)
declare("fracas_campaign_points", c_size_t, c_void_p)
declare("fracas_campaign_point_replicas", c_int64, c_void_p, c_size_t)
declare("fracas_campaign_columns", c_size_t, c_void_p)
declare("fracas_campaign_column_at", c_int, c_void_p, c_size_t, POINTER(Column))
declare("fracas_campaign_value", c_int, c_void_p, c_size_t, c_size_t, POINTER(c_double), POINTER(c_char_p))
declare("fracas_table_name", c_char_p, c_int)
declare("fracas_table_columns", c_size_t, c_int)
declare("fracas_table_column_at", c_int, c_int, c_size_t, POINTER(Column))
declare("fracas_table_find", c_int, c_int, c_char_p, POINTER(c_size_t))
declare("fracas_realizer_open", c_int, c_void_p, c_size_t, POINTER(c_void_p))
declare("fracas_realizer_close", None, c_void_p)
declare("fracas_realizer_strengths", c_size_t, c_void_p)
declare("fracas_realizer_draw", c_int, c_void_p, c_int64, c_void_p)
declare("fracas_realizer_compute", c_int, c_void_p, POINTER(c_int64), c_size_t, c_void_p, c_int, POINTER(c_void_p))
declare("fracas_compute_one", c_int, c_void_p, c_size_t, c_int64, POINTER(c_void_p))
declare("fracas_realization_rows", c_size_t, c_void_p, c_int)
declare("fracas_realization_get", c_int, c_void_p, c_int, c_size_t, c_void_p, c_size_t)
declare("fracas_realization_number", c_int, c_void_p, c_char_p, POINTER(c_double))
declare("fracas_realization_close", None, c_void_p)


def must(status):
    if status:
        sys.exit(f"status {status}: {error().decode()}")


def columns(table):
    column = Column()
    for i in range(fracas.fracas_table_columns(table)):
        must(fracas.fracas_table_column_at(table, i, byref(column)))
        yield i, column


def values(realization, table, i, column):
    rows = fracas.fracas_realization_rows(realization, table)
    dtype = np.dtype(column.type.decode())
    assert column.bytes == dtype.itemsize * column.width
    array = np.empty((rows, column.width), dtype)
    must(fracas.fracas_realization_get(realization, table, i, array.ctypes.data, array.nbytes))
    return array


def same(realization, row, study):
    """Compares a realization with row `row` of the study."""
    for table in range(TABLES):
        group = study.get(fracas.fracas_table_name(table).decode())
        if group is None:
            assert fracas.fracas_realization_rows(realization, table) == 0
            continue
        seen = {"offset"} if table else set()
        begin, end = (row, row + 1) if table == 0 else group["offset"][row:row + 2]
        for i, column in columns(table):
            name = column.name.decode()
            data = group[name]
            found = values(realization, table, i, column)
            stored = data[begin:end].reshape(end - begin, -1)
            assert data.attrs["unit"] == column.unit, name
            assert found.dtype == stored.dtype and found.shape == stored.shape, (name, found.shape, stored.shape)
            assert found.tobytes() == stored.tobytes(), f"{name} of realization {row} differs"
            seen.add(name)
        assert seen == set(group), set(group) ^ seen


def check_points(campaign, study):
    column, number, text = Column(), c_double(), c_char_p()
    names = {"hash", "replicas"}
    for i in range(fracas.fracas_campaign_columns(campaign)):
        must(fracas.fracas_campaign_column_at(campaign, i, byref(column)))
        name = column.name.decode()
        names.add(name)
        for p in range(len(study["point/hash"])):
            must(fracas.fracas_campaign_value(campaign, p, i, byref(number), byref(text)))
            stored = study["point"][name][p]
            if column.type == b"text":
                assert text.value == bytes(stored), (name, text.value, stored)
            else:
                assert np.float64(number.value).tobytes() == np.float64(stored).tobytes(), name
    assert names == set(study["point"]), names ^ set(study["point"])


def check_errors(campaign, realizer, realization):
    """Each wrong call is refused with its message, and gives nothing."""
    handle, number, index = c_void_p(), c_double(), c_size_t()

    def refused(words, status):
        assert status == 2 and words in error().decode(), (words, status, error())
        assert not handle

    bad = b"name: bad\nseed: 1\nmodell: bar\n"
    refused("mine.yaml:3:1: unknown key `modell`", fracas.fracas_campaign_open_text(bad, len(bad), b"mine.yaml", byref(handle)))
    bad += b"replicas: none\n"
    refused("mine.yaml:3:1: unknown key `modell`", fracas.fracas_campaign_open_text(bad, len(bad), b"mine.yaml", byref(handle)))
    assert [line.split(": ")[0] for line in error().decode().splitlines()] == ["mine.yaml:3:1", "mine.yaml:4:11"], error()
    refused("there is no campaign file", fracas.fracas_campaign_open(b"no/such.yaml", byref(handle)))
    refused("there is no point 9999", fracas.fracas_realizer_open(campaign, 9999, byref(handle)))
    refused("there is no point 9999", fracas.fracas_compute_one(campaign, 9999, 0, byref(handle)))
    refused("replica -1", fracas.fracas_compute_one(campaign, 0, -1, byref(handle)))
    refused("-1 threads", fracas.fracas_realizer_compute(realizer, byref(c_int64(0)), 1, None, -1, byref(handle)))
    refused("did you mean `fragments`", fracas.fracas_realization_number(realization, b"fragmentz", byref(number)))
    refused("`momentum` has 3 values", fracas.fracas_realization_number(realization, b"momentum", byref(number)))
    refused("there is no table 6", fracas.fracas_table_find(TABLES, b"mass", byref(index)))
    refused("has no column 99", fracas.fracas_table_column_at(0, 99, byref(Column())))
    refused("bytes, not 3", fracas.fracas_realization_get(realization, 0, 0, (ctypes.c_char * 3)(), 3))


def check_strengths(realizer, replica, row, study):
    """The strengths that a replica draws, given back by hand, make the same realization."""
    n = fracas.fracas_realizer_strengths(realizer)
    strength = np.empty(n)
    must(fracas.fracas_realizer_draw(realizer, replica, strength.ctypes.data))
    realization = c_void_p()
    must(fracas.fracas_realizer_compute(realizer, byref(c_int64(replica)), 1, strength.ctypes.data, 2, byref(realization)))
    same(realization, row, study)
    fracas.fracas_realization_close(realization)


def check_text(path, campaign):
    """The resolved text of the campaign is a campaign, whose text is the same."""
    text, again, other = c_void_p(), c_void_p(), c_void_p()
    must(fracas.fracas_campaign_resolved(campaign, byref(text)))
    resolved = ctypes.string_at(text)
    if b"attachments/" not in resolved:  # copies of files are in a study alone
        must(fracas.fracas_campaign_open_text(resolved, len(resolved), path.encode(), byref(other)))
        must(fracas.fracas_campaign_resolved(other, byref(again)))
        assert ctypes.string_at(again) == resolved
    fracas.fracas_campaign_close(other)
    fracas.fracas_text_close(again)
    fracas.fracas_text_close(text)


with h5py.File(study_path) as study:
    campaign, count = c_void_p(), 0
    must(fracas.fracas_campaign_open(campaign_path.encode(), byref(campaign)))
    assert fracas.fracas_campaign_points(campaign) == len(study["point/hash"])
    check_points(campaign, study)
    check_text(campaign_path, campaign)
    points, replicas = study["realization/point"][()], study["realization/replica"][()]
    for p in range(len(study["point/hash"])):
        rows = np.flatnonzero(points == p)
        if len(sys.argv) < 5:
            rows = rows[[0, -1]]
        assert fracas.fracas_campaign_point_replicas(campaign, p) > replicas[rows].max()
        realizer = c_void_p()
        must(fracas.fracas_realizer_open(campaign, p, byref(realizer)))
        wanted = (c_int64 * len(rows))(*replicas[rows])
        made = (c_void_p * len(rows))()
        must(fracas.fracas_realizer_compute(realizer, wanted, len(rows), None, 0, made))
        for row, realization in zip(rows, made):
            same(c_void_p(realization), row, study)
            count += 1
        if p == 0:
            check_errors(campaign, realizer, c_void_p(made[0]))
            check_strengths(realizer, int(replicas[rows[-1]]), rows[-1], study)
            one = c_void_p()
            must(fracas.fracas_compute_one(campaign, p, int(replicas[rows[-1]]), byref(one)))
            same(one, rows[-1], study)
            fracas.fracas_realization_close(one)
        for realization in made:
            fracas.fracas_realization_close(c_void_p(realization))
        fracas.fracas_realizer_close(realizer)
    fracas.fracas_campaign_close(campaign)
print(f"{count} realizations of {campaign_path} have the bytes of the study")
assert count > 0
