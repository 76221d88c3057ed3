"""Checks a data package that `fracas export` wrote: against the standard's rules, against itself, and against study.h5. No code of fracas.

usage: check_export.py STUDY [FOLDER]
FOLDER is the package, STUDY/export if not given. Ends with status 1 and what is wrong at the first fault.

The rules are those of Frictionless Data Package 1 (Data Package, Tabular Data Resource, Table Schema, CSV dialect by default).
"""
import csv
import hashlib
import json
import math
import os
import re
import sys

import h5py
import numpy as np

OUTCOMES = ["FRAGMENTED", "INTACT", "TIME_LIMIT", "NONFINITE", "ENERGY_DRIFT", "FAILED"]
KEYS = {"points": ["point"], "realizations": ["point", "replica"], "fragments": ["point", "replica", "fragment"],
        "histories": ["point", "replica", "row"], "cracks": ["point", "replica", "number"], "breaks": ["point", "replica", "row"], "probes": ["point", "replica", "row"], "reactions": ["point", "replica", "row"], "statistics": ["point", "key"], "energies": ["point", "time"], "convergence": ["point", "replicas"]}
PARENTS = {"realizations": "points", "fragments": "realizations", "histories": "realizations", "cracks": "realizations", "breaks": "realizations", "probes": "realizations", "reactions": "realizations", "statistics": "points",
           "energies": "points", "convergence": "points"}


def wanted(true, *what):
    if not true:
        sys.exit("check_export: " + " ".join(map(str, what)))


def same(ours, theirs):
    """15 digits are within half a unit of the last, 5e-15 of the value at most; reading it back rounds by 1.1e-16."""
    return ours is None and math.isnan(theirs) or ours is not None and math.isclose(ours, theirs, rel_tol=5.2e-15, abs_tol=0)


# ---- what a package must be ----

def number(text, place):
    wanted(re.fullmatch(r"-?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?", text), place, "is no number:", text)
    return float(text)


def integer(text, place):
    wanted(re.fullmatch(r"-?\d+", text), place, "is no integer:", text)
    return int(text)


READ = {"integer": integer, "number": number, "string": lambda text, place: text}


def check_field(field, place):
    wanted(set(field) <= {"name", "type", "unit", "description", "constraints"}, place, "has other properties", sorted(field))
    wanted(field["type"] in READ and field["name"] and field["description"], place, "lacks name, type or description", field)
    wanted(("unit" in field) == (field["type"] != "string") or field["name"] == "value", place, "has no unit, or is text with one:", field)


def read(resource, folder):
    """The rows of a table as dictionaries, None where nothing is."""
    name = resource["name"]
    wanted(resource["profile"] == "tabular-data-resource" and re.fullmatch("[a-z0-9._-]+", name), name, "is no tabular resource")
    wanted(resource["path"] == name + ".csv" and resource["encoding"] == "utf-8", name, "lies elsewhere:", resource["path"])
    content = open(os.path.join(folder, resource["path"]), "rb").read()
    wanted(len(content) == resource["bytes"], name, "has", len(content), "bytes and not", resource["bytes"])
    wanted("sha256:" + hashlib.sha256(content).hexdigest() == resource["hash"], name, "is not what was hashed")
    schema = resource["schema"]
    wanted(schema["missingValues"] == [""], name, "has other missing values", schema["missingValues"])
    lines = list(csv.reader(content.decode().splitlines()))
    names = [field["name"] for field in schema["fields"]]
    wanted(lines[0] == names, name, "has the head", lines[0], "and the fields", names)
    wanted(len(set(names)) == len(names), name, "has two columns of one name")
    for field in schema["fields"]:
        check_field(field, name)
    rows = []
    for n, line in enumerate(lines[1:], 2):
        wanted(len(line) == len(names), name, "line", n, "has", len(line), "columns and not", len(names))
        row = {}
        for field, text in zip(schema["fields"], line):
            place = f"{name} line {n} column {field['name']}"
            row[field["name"]] = READ[field["type"]](text, place) if text else None
            allowed = field.get("constraints", {}).get("enum")
            wanted(allowed is None or text in allowed, place, "is none of", allowed, ":", text)
        rows.append(row)
    return rows


def key_of(row, fields):
    return tuple(row[field] for field in fields)


def check_keys(package, rows):
    for resource in package["resources"]:
        name, schema = resource["name"], resource["schema"]
        wanted(schema["primaryKey"] == KEYS[name], name, "has the primary key", schema["primaryKey"])
        keys = [key_of(row, KEYS[name]) for row in rows[name]]
        wanted(len(set(keys)) == len(keys) and None not in {value for key in keys for value in key}, name, "has a primary key twice, or none")
        foreign = schema.get("foreignKeys", [])
        wanted(len(foreign) == (name in PARENTS), name, "has the foreign keys", foreign)
        for key in foreign:
            parent = key["reference"]["resource"]
            wanted(parent == PARENTS[name] and key["fields"] == key["reference"]["fields"] == KEYS[parent], name, "points elsewhere:", key)
            there = {key_of(row, KEYS[parent]) for row in rows[parent]}
            for row in rows[name]:
                wanted(key_of(row, key["fields"]) in there, name, "points at no line of", parent, ":", key_of(row, key["fields"]))


# ---- what is in it ----

def columns_of(group, skip=()):
    """Columns and units of a group of study.h5, its vectors as three."""
    columns, units = {}, {}
    for name, dataset in group.items():
        if name in skip:
            continue
        values, unit = dataset[()], dataset.attrs["unit"]
        unit = unit.decode() if isinstance(unit, bytes) else str(unit)
        for i, axis in enumerate("xyz" if values.ndim > 1 else [""]):
            columns[name + ("_" + axis if axis else "")] = values[:, i] if axis else values
            units[name + ("_" + axis if axis else "")] = unit
    return columns, units


def compare(name, rows, columns, beside=()):
    """Every column of the study, and no other but those `beside`."""
    wanted(not rows or set(rows[0]) == set(columns) | set(beside), name, "has other columns:", set(rows[0]) ^ (set(columns) | set(beside)) if rows else "")
    for key, values in columns.items():
        wanted(len(values) == len(rows), name, "has", len(rows), "lines and not", len(values))
        for n, (row, value) in enumerate(zip(rows, values), 2):
            place = (name, "line", n, "column", key, "is", row[key], "and in study.h5", value)
            if isinstance(value, bytes):
                wanted((row[key] or "").encode() == value, *place)
            elif key == "outcome":
                wanted(row[key] == OUTCOMES[value], *place)
            else:
                wanted(same(row[key], value), *place)


def check_units(resource, units):
    for field in resource["schema"]["fields"]:
        if field["name"] in units:
            wanted(field.get("unit", "") == (units[field["name"]] if field["type"] != "string" else ""), resource["name"], "has a wrong unit:", field)


def check_parts(study, package, rows, name, group, number):
    """fragments.csv, histories.csv and probes.csv: rows of a group by the realizations that they are of."""
    offset = study[group + "/offset"][()]
    columns, units = columns_of(study[group], ("offset",))
    if "probe" in columns:  # by its name, the first word of each
        names = np.array([text.split()[0] for text in study.attrs["probes"].decode().split("; ")], "S")
        columns["probe"] = list(names[columns["probe"]])
    of = np.repeat(np.arange(len(offset) - 1), np.diff(offset))
    realization, _ = columns_of(study["realization"])
    for key in ("point", "replica", "outcome"):
        columns[key] = realization[key][of]
    columns[number] = np.arange(len(of)) - offset[of]
    compare(name, rows[name], columns)
    check_units(package[name], units)


def check_statistics(package, points, statistics, parameters):
    """The long form has every number of points.csv that is no parameter, in its unit; so has the summary."""
    fields = [field for field in package["points"]["schema"]["fields"] if field["name"] not in parameters]
    wanted([field["name"] for field in fields[:1]] != [] and len(statistics) == len(points) * len(fields), "statistics has", len(statistics),
           "lines for", len(points), "points of", len(fields), "numbers")
    expected = [(row["point"], field["name"], row[field["name"]], field["unit"]) for row in points for field in fields]
    for n, (line, numbers) in enumerate(zip(statistics, expected), 2):
        wanted((line["point"], line["key"], line["value"], line["unit"]) == numbers, "statistics line", n, "is", line, "and points.csv has", numbers)


def check_summary(study_folder, resource, points, parameters):
    path = os.path.join(study_folder, "report/summary.json")
    if not os.path.exists(path):
        return
    summary = json.load(open(path))
    units = {field["name"]: field["unit"] for field in resource["schema"]["fields"] if "unit" in field}
    for key, unit in [*summary["units"]["parameters"].items(), *summary["units"]["statistics"].items()]:
        wanted(units[key] == unit, "summary.json has another unit of", key, ":", unit)
    wanted(set(summary["units"]["statistics"]) == set(summary["points"][0]["statistics"]) if points else True, "summary.json lacks units")
    for row, point in zip(points, summary["points"], strict=True):
        there = dict(point["statistics"], **{"outcome." + name: count for name, count in point["outcomes"].items()})
        wanted(set(there) == set(row) - parameters, "summary.json has other keys:", set(there) ^ (set(row) - parameters))
        for key, value in there.items():
            wanted(same(row[key], math.nan if value is None else value), "points.csv", key, "is", row[key], "and in summary.json", value)


def check_series(study_folder, folder, package):
    """Those that a report has too are checked there, by check_report.py: the same bytes."""
    for name in ("energies", "convergence"):
        path = os.path.join(study_folder, "report", name + ".csv")
        if os.path.exists(path):
            wanted(open(path).read() == open(os.path.join(folder, name + ".csv")).read(), name, "is not that of the report")
        for field in package[name]["schema"]["fields"]:
            key = field["name"].rpartition(".")[0]
            unit = {"point": "1", "time": "s", "running": "1", "realizations": "1", "replicas": "1", "dissipated": "J"}.get(key or field["name"])
            wanted(unit in (None, field["unit"]), name, "has a wrong unit:", field)


def check(study_folder, folder):
    package = json.load(open(os.path.join(folder, "datapackage.json")))
    wanted(package["profile"] == "tabular-data-package" and re.fullmatch("[a-z0-9._/-]+", package["name"]), "profile or name", package["name"])
    resources = {resource["name"]: resource for resource in package["resources"]}
    wanted(len(resources) == len(package["resources"]), "two resources of one name")
    wanted(list(resources)[:6] == ["points", "realizations", "fragments", "statistics", "energies", "convergence"], "other resources:", list(resources))
    rows = {name: read(resource, folder) for name, resource in resources.items()}
    check_keys(package, rows)
    with h5py.File(os.path.join(study_folder, "study.h5"), "r") as study:
        text = {key: value.decode() if isinstance(value, bytes) else str(value) for key, value in study.attrs.items()}
        wanted([package["campaign"], package["seed"], package["program_version"]] ==
               [text["campaign"], text["seed"], text["program_version"]] and package["complete"] == bool(study.attrs["complete"]),
               "comes from another study:", package["sources"])
        columns, units = columns_of(study["realization"])
        compare("realizations", rows["realizations"], columns)
        check_units(resources["realizations"], units)
        check_parts(study, resources, rows, "fragments", "fragment", "fragment")
        if "histories" in rows:
            check_parts(study, resources, rows, "histories", "history", "row")
        wanted(("probes" in rows) == ("probe" in study), "probes.csv is there, or is not")
        if "probes" in rows:
            check_parts(study, resources, rows, "probes", "probe", "row")
        wanted(("reactions" in rows) == ("reaction" in study), "reactions.csv is there, or is not")
        if "reactions" in rows:
            check_parts(study, resources, rows, "reactions", "reaction", "row")
        columns, units = columns_of(study["point"])
        parameters = set(columns) | {"point"}
        compare("points", [{key: row[key] for key in row if key in columns} for row in rows["points"]], columns)
        check_units(resources["points"], units)
        wanted([row["point"] for row in rows["points"]] == list(range(len(columns["hash"]))), "points are not numbered")
    check_statistics(resources, rows["points"], rows["statistics"], parameters)
    check_series(study_folder, folder, resources)
    check_summary(study_folder, resources["points"], rows["points"], parameters)
    here = {name for name in os.listdir(folder) if name.endswith(".csv") or name.startswith(".")}
    wanted(folder != os.path.join(study_folder, "export") or here == {name + ".csv" for name in rows}, "files that are not of the package:", here)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    check(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else os.path.join(sys.argv[1], "export"))
