"""Compares what a point of the JSON summary has of fits, convergence with replicas and energies with fits.csv, convergence.csv and energies.csv:
every number of the one is in the other. Those tables are checked by check_report.py, from study.h5.
"""
import csv
import math
import os

PLAIN = ("rank", "log_likelihood", "aicc", "delta_aicc", "bic", "ks", "ks_p", "ad", "ad_p")
ENERGIES = ("kinetic", "elastic", "cohesive", "dissipated", "dissipated_bending", "friction", "damped", "created", "work")


def check_pages(summary, source):
    """docs/formats/summary.md names every key."""
    page = open(os.path.join(source, "docs/formats/summary.md")).read()
    named = [summary, *summary["slopes"], *summary["warnings"]]
    for point in summary["points"]:
        named += [point, point.get("decision", {}), *point["convergence"]]
        if point["energies"]:
            named += [point["energies"], point["energies"]["end"]]
        if point["fits"]:
            named += [point["fits"], point["fits"]["data"], *point["fits"]["families"], point["fits"].get("comparison", {})]
    for key in {key for of in named for key in of}:
        assert f"`{key}`" in page, f"docs/formats/summary.md does not name {key}"


def lines_of(path, p):
    with open(path) as file:
        return [line for line in csv.DictReader(file) if line["point"] == str(p)]


def alike(value, text):
    """A number of the summary and one of a table, which has 15 digits."""
    return value is None and text == "" or value is not None and text != "" and math.isclose(value, float(text), rel_tol=1e-14)


def check_series(p, point, report):
    rows, lines = point["convergence"], lines_of(os.path.join(report, "convergence.csv"), p)
    assert len(rows) == len(lines), (len(rows), len(lines))
    for row, line in zip(rows, lines):
        keys = {key[:-6] for key in line if key.endswith(".value")}
        assert set(row) == {"replicas", *keys} and row["replicas"] == int(line["replicas"])
        for key in keys:
            assert set(row[key]) == {"value", "low", "high"}
            for part, value in row[key].items():
                assert alike(value, line[f"{key}.{part}"]), (key, part, value, line)
    of, lines = point["energies"], lines_of(os.path.join(report, "energies.csv"), p)
    assert (of is None) == (not lines)
    if of is None:
        return
    last = lines[-1]
    assert set(of) == {"file", "times", "realizations", "band", "end"} and of["file"] == "energies.csv"
    assert of["times"] == len(lines) and of["realizations"] == int(last["realizations"])
    assert of["band"] == ("least to greatest" if of["realizations"] < 20 else "quantiles 0.05 to 0.95")
    assert set(of["end"]) == {"time", "running", *ENERGIES}
    assert of["end"]["running"] == int(last["running"]) and alike(of["end"]["time"], last["time"])
    for name in ENERGIES:
        assert set(of["end"][name]) == {"mean", "low", "high"}
        for part, value in of["end"][name].items():
            assert alike(value, last[f"{name}.{part}"]), (name, part, value)


def check_fits(p, point, study, moved=False):
    """Every line of fits.csv of the point, each once, with all its digits, and no number that is not there."""
    told, path = point["fits"], os.path.join(study, "fits.csv")
    lines = [line for line in csv.DictReader(open(path)) if line["hash"] == point["hash"]] if os.path.exists(path) else []
    assert (told is None) == (not lines)
    if told is None:
        return
    left = {(line["family"], line["quantity"]): line for line in lines}
    assert len(left) == len(lines) and (moved or {line["point"] for line in lines} == {str(p)})
    assert set(told) == {"preferred", "data", "families"} | ({"comparison"} if ("comparison", "p") in left else set())
    assert {told["preferred"]} == ({line["family"] for line in lines if line["quantity"] == "rank" and float(line["value"]) == 1} or {None})

    def number(family, quantity, value):
        line = left.pop((family, quantity), {"value": ""})
        assert value is None and line["value"] == "" or value == float(line["value"] or "nan"), (family, quantity, value, line)
        return line

    def interval(family, quantity, of):
        assert set(of) == {"value", "low", "high", "unit", "resamples"}
        line = number(family, quantity, of["value"])
        for part in ("low", "high"):
            assert of[part] is None and line[part] == "" or of[part] == float(line[part] or "nan"), (family, quantity, part, of, line)
        assert of["unit"] == line["unit"] and of["resamples"] == int(line["resamples"] or 0)

    for key, value in told["data"].items():
        if key == "fingerprint":
            assert value == left.pop(("data", key))["note"]
            continue
        interval("data", key, value) if isinstance(value, dict) else number("data", key, value)
    for of in told["families"]:
        name = of["family"]
        assert set(of) == {"family", "fitted", "reason", "resamples", "parameters", *PLAIN}
        line = left.pop((name, "fitted"))
        assert of["fitted"] is (line["value"] == "1") and (of["reason"] or "") == line["note"] and of["fitted"] is (of["reason"] is None)
        for key in ("ks_p", "ad_p"):
            assert of["resamples"] == int(left.get((name, key), {}).get("resamples") or 0)
        for key in PLAIN:
            number(name, key, of[key])
        for key, value in of["parameters"].items():
            interval(name, key, value)
    if "comparison" in told:
        of = told["comparison"]
        assert set(of) == {"vuong", "likelihood_ratio", "p", "resamples", "note"}
        for key in ("vuong", "likelihood_ratio"):
            number("comparison", key, of[key])
        line = number("comparison", "p", of["p"])
        assert of["note"] == line["note"] and of["resamples"] == int(line["resamples"] or 0)
    assert not left, f"the summary lacks {sorted(left)} of fits.csv"
