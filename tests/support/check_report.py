"""Checks what the analysis wrote into a study against docs/examples/table_from_study.py and against the study itself.

usage: check_report.py STUDY SOURCE
STUDY holds study.h5, table.txt, summary.json and report/.
"""
import csv
import glob
import html
import html.parser
import json
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

import h5py

study, source = sys.argv[1:3]
report = os.path.join(study, "report")
summary = json.load(open(os.path.join(study, "summary.json")))
script = os.path.join(source, "docs/examples/table_from_study.py")
printed = subprocess.run([sys.executable, script, study + "/study.h5"], check=True, capture_output=True,
                         text=True).stdout.splitlines()
keys = printed[0].split("\t")
rows = [dict(zip(keys, map(float, line.split("\t")))) for line in printed[1:]]


def same(ours, theirs):
    """Both sum up to 32 000 values of one sign: 32 000 x 1.1e-16 = 4e-12 relative at the very worst."""
    if ours is None:
        return math.isnan(theirs)
    return math.isclose(ours, theirs, rel_tol=1e-11, abs_tol=0)


# The example script gives the numbers of the JSON summary, and those of points.csv.
points = list(csv.DictReader(open(os.path.join(report, "points.csv"))))
assert len(summary["points"]) == len(rows) == len(points)
for row, point, line in zip(rows, summary["points"], points):
    assert line["hash"] == point["hash"]
    compared = 0
    for key, value in row.items():
        if key in point["statistics"]:
            assert same(point["statistics"][key], value), (key, point["statistics"][key], value)
            assert same(float(line[key]) if line[key] else None, value), (key, line[key], value)
            compared += 1
        elif key in point["outcomes"]:
            assert point["outcomes"][key] == value == int(line["outcome." + key])
        else:
            assert key == "rate" and point["parameters"]["loading.rate"] == value
    assert compared == len(row) - 7  # all but the rate and the outcomes

# So does the SQL example, from the index, as far as the index goes.
if shutil.which("sqlite3"):
    with open(os.path.join(source, "docs/examples/table_from_index.sql")) as script:
        printed = subprocess.run(["sqlite3", "-json", study + "/index.sqlite"], stdin=script, check=True,
                                 capture_output=True, text=True).stdout
    for row, point, line in zip(rows, summary["points"], json.loads(printed), strict=True):
        assert line["point"] == point["hash"]
        assert [line["planned"], line["done"] + line["failed"]] == [row["realizations"]] * 2
        assert line["used"] == row["usable"] and line["failed"] == row["FAILED"]
        for key, unit in (("count", ""), ("dissipated", "_J")):
            assert same(line[f"{key}_mean{unit}"], row[key + ".mean"])
            assert same(line[f"{key}_deviation{unit}"], row[key + ".deviation"])
else:
    print("not checked: table_from_index.sql, for want of the sqlite3 shell")

# The terminal table shows those numbers: each to half a unit of its last digit (and a hair: ties round to even).
UNIT = {"n": 1e-9, "u": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3}
text = open(os.path.join(study, "table.txt")).read().splitlines()
size_unit, energy_unit = (UNIT[re.search(r"\[(\w?)%s\]" % unit, text[1]).group(1)] for unit in "mJ")


def shows(cell, value, unit=1.0):
    if cell == "-":
        assert math.isnan(value), (cell, value)
        return
    mantissa, _, exponent = cell.partition("e")
    last = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    assert abs(float(cell) - value / unit) <= 0.5 * last * (1 + 1e-6), (cell, value / unit)


for row, line in zip(rows, text[2:]):
    cells = line.replace(" +- ", "+-").split()[len(summary["varying"]):]
    assert [int(cells[0]), int(cells[1])] == [row["usable"], row["unusable"]]
    units = {"count": 1.0, "size": size_unit, "dissipated": energy_unit}
    for cell, (key, unit) in zip(cells[2:5], units.items()):
        mean, _, half_width = cell.partition("+-")
        shows(mean, row[key + ".mean"], unit)
        if mean != "-":
            shows(half_width, row[key + ".half_width"], unit)
    for cell, key in zip(cells[5:8], ("law.zmr", "law.grady", "law.glenn_chudnovsky")):
        shows(cell, row[key], size_unit)
    shows(cells[8], row["size.mean"] / row["law.zmr"])
    shows(cells[9], row["residual"])
    shows(cells[10], row["created"])

# A line of fragments.csv for each fragment of the study, with its numbers to 15 digits.
with h5py.File(study + "/study.h5", "r") as file:
    size, mass, position = (file["fragment/" + name][()] for name in ("size", "mass", "position"))
fragments = list(csv.DictReader(open(os.path.join(report, "fragments.csv"))))
assert len(fragments) == len(size)
for line, expected, heavy, place in zip(fragments, size, mass, position):
    assert math.isclose(float(line["size"]), expected, rel_tol=1e-14)
    assert math.isclose(float(line["mass"]), heavy, rel_tol=1e-14)
    assert math.isclose(float(line["position_x"]), place[0], rel_tol=1e-14)

# Every SVG is well-formed; with the size figures, a mark for each row of data.
with_mean = sum(not math.isnan(row["size.mean"]) for row in rows)
SVG = "{http://www.w3.org/2000/svg}"


def marks(name):
    return len(xml.parse(os.path.join(report, name)).findall(f".//{SVG}path[@class='mark']"))


for name in glob.glob(os.path.join(report, "*.svg")):
    xml.parse(name)
assert marks("size-against-rate.svg") == marks("size-against-rate-normalised.svg") == with_mean
assert len(glob.glob(os.path.join(report, "sizes-point-*.svg"))) == with_mean
assert len(glob.glob(os.path.join(report, "energies-point-*.svg"))) == with_mean
together = xml.parse(os.path.join(report, "sizes.svg")).findall(f".//{SVG}path[@class='line']/{SVG}title")
assert len(together) == with_mean


# The page: the same marks, a table row a point, balanced, and nothing fetched from elsewhere.
class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.marks, self.rows, self.links = [], 0, 0, []

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.marks += attributes.get("class") == "mark"
        self.rows += tag == "tr" and "tbody" in self.open
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]
        assert tag != "script"
        if tag not in ("meta", "link"):
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in ("meta", "link"):
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


source_text = open(os.path.join(report, "index.html"), encoding="utf-8").read()
page = Page()
page.feed(source_text)
assert page.open == []
assert page.marks == 2 * with_mean
assert page.rows == len(rows)
for link in page.links:
    assert link.startswith("data:") or os.path.exists(os.path.join(report, link)), link
assert "url(" not in source_text and "@import" not in source_text
assert f"<h1>{html.escape(summary['name'])}</h1>" in source_text
assert summary["campaign"] in source_text and summary["seed"] in source_text
assert source_text.count("<li>") == len(summary["warnings"])

# Nothing is left of the temporary names.
assert not [name for name in os.listdir(report) if name.startswith(".")]
