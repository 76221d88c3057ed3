"""Checks the package fracas on the studies that tests/unit/python.sh has made in this folder."""
import glob
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time

import h5py
import numpy as np

import fracas


def same(ours, theirs):
    theirs = np.char.decode(theirs) if theirs.dtype.kind == "S" else theirs
    np.testing.assert_array_equal(ours, theirs, strict=False)


def check_whole(path):
    """Every dataset of study.h5, with its unit and meaning, all at once and realization by realization."""
    seen = set()
    with fracas.open(path) as study, h5py.File(path + "/study.h5") as raw:
        assert not study.partial and study.attributes["seed"] == raw.attrs["seed"] == 7 and "name: small" in study.campaign
        tables = {"point": study.points, "realization": study.realizations, "fragment": study.fragments, "history": study.histories,
                  "interface": study.interfaces}
        for group, table in tables.items():
            for name in raw[group]:
                if name == "offset":
                    continue
                data = raw[group][name]
                same(table[name], data[()])
                assert (table.units[name], table.descriptions[name]) == (data.attrs["unit"].decode(), data.attrs["description"].decode())
                seen.add(f"{group}/{name}")
        owner = raw["realization/point"][()].repeat(np.diff(raw["fragment/offset"][()]))
        same(study.fragments["point"], owner)
        same(study.fragments["replica"], raw["realization/replica"][()].repeat(np.diff(raw["fragment/offset"][()])))
        row = len(raw["realization/point"]) - 1
        one = study.realization(int(raw["realization/point"][row]), int(raw["realization/replica"][row]))
        for group, table in (("fragment", one.fragments), ("history", one.history), ("interface", one.interfaces)):
            first, last = raw[group]["offset"][row:row + 2]
            for name in table:
                same(table[name], raw[group][name][first:last])
            assert first < last or (group, path) == ("history", "plates")
        assert one["dissipated"] == raw["realization/dissipated"][row] and list(one["momentum"]) == list(raw["realization/momentum"][row])
        labels = study.realizations.labels("outcome")
        assert labels == ["FRAGMENTED", "INTACT", "TIME_LIMIT", "NONFINITE", "ENERGY_DRIFT", "FAILED"] == list(study.summary["points"][0]["outcomes"])
        if "mesh" in raw:
            for p in range(len(raw["point/hash"])):
                mesh = study.mesh(p)
                for name in mesh:
                    first, last = raw["mesh"][name.split("_")[0] + "_offset"][p:p + 2]
                    same(mesh[name], raw["mesh"][name][first:last])
                    assert last > first
                assert set(mesh) == {name for name in raw["mesh"] if not name.endswith("offset")} and mesh["element_node"].max() == len(mesh["node_position"]) - 1
    return len(seen)


def check_elements(path, motion=np.inf):
    """Fragments of elements: as many of each as stored, and their middles before any motion within `motion` [m] of the stored ones."""
    pieces = 0
    with fracas.open(path) as study:
        for point, replica in zip(study.realizations["point"], study.realizations["replica"]):
            one = study.realization(int(point), int(replica))
            rows = one.element_fragments
            assert np.array_equal(np.bincount(rows), one.fragments["elements"])
            pieces = max(pieces, len(one.fragments["mass"]))
            if not study.points["derived.surface"][point]:
                runs = (np.diff(rows, append=rows[0]) != 0).sum()  # along a chain a fragment is in one piece, over its ends in a closed one
                assert runs == (len(one.fragments["mass"]) if len(one.fragments["mass"]) > 1 else 0)
                continue
            mesh = study.mesh(int(point))
            corner = mesh["node_position"][mesh["element_node"][:, :3]]
            area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2
            middle = [np.bincount(rows, area * corner[:, :, x].mean(axis=1)) / np.bincount(rows, area) for x in range(3)]
            apart = np.linalg.norm(np.transpose(middle) - one.fragments["position"], axis=1).max()
            assert apart < motion, (apart, motion)
    assert pieces > 3, pieces


def check_alone():
    """study.h5 alone has its campaign."""
    os.mkdir("alone")
    shutil.copy("whole/study.h5", "alone")
    with fracas.open("alone/study.h5") as alone, fracas.open("whole") as whole:
        assert alone.campaign == whole.campaign and alone.campaign.startswith("# A campaign as resolved")
    assert "0/1: computed again, the same bytes" in fracas.replay("alone/study.h5", 0, 1)
    assert fracas.plan("alone/study.h5")["realizations"] == 18
    with h5py.File("alone/study.h5", "r+") as file:
        del file["campaign"]
    refused(5, "has no campaign.yaml", lambda: fracas.open("alone").campaign)


def check_half():
    """The realizations of a partial study are those of the whole one, to the bit."""
    with fracas.open("half") as half, fracas.open("whole") as whole:
        assert half.partial and os.path.exists("half/study.h5") and len(glob.glob("half/segments/*.h5")) >= 3, os.listdir("half/segments")
        point, replica = half.realizations["point"], half.realizations["replica"]
        there = set(zip(point.tolist(), replica.tolist()))
        assert len(there) == len(point) == fracas.status("half")["done"] and 9 <= len(point) < 18
        assert {(0, 0), (0, 1), (2, 0), (2, 1)} <= there and {p for p, _ in there} == {0, 1, 2}
        assert sorted(there) == list(zip(point, replica))  # in plan order
        for name in ("points", "realizations", "fragments", "histories", "interfaces"):
            ours, theirs = getattr(half, name), getattr(whole, name)
            assert list(ours) == list(theirs) and ours.units == theirs.units
            kept = np.array([pair in there for pair in zip(theirs["point"], theirs["replica"])]) if "point" in theirs else slice(None)
            for column in theirs:
                same(ours[column], theirs[column][kept])
        for pair in there:
            same(half.realization(*pair).fragments["position"], whole.realization(*pair).fragments["position"])
        refused(2, "no realization of point 0 and replica 9 by now", half.realization, 0, 9)
        assert half.summary["partial"] and half.statistics["count.n"].sum() == len(point)


def check_report():
    """Statistics, energies and convergence are the report's, to the last digit."""
    study = fracas.open("whole")
    summary = json.loads(subprocess.run([fracas.program(), "report", "whole", "--json"], check=True, capture_output=True, text=True).stdout)
    assert study.summary == summary and len(study.statistics["count.mean"]) == 3
    for number, point in enumerate(summary["points"]):
        for key, value in {**point["parameters"], **point["statistics"]}.items():
            ours = study.statistics[key][number]
            assert ours == value or value is None and (ours == "" or np.isnan(ours)), (key, ours, value)
    assert study.statistics.units["size.mean"] == "m" and study.statistics.descriptions["law.mott"] == "mean size by Mott"
    assert all(text for name, text in study.statistics.descriptions.items() if name != "label" and name in summary["units"]["statistics"])
    found = [row["count"]["high"] for point in summary["points"] for row in point["convergence"]]
    assert list(study.convergence["count.high"]) == found and study.convergence.units["size.low"] == "m"
    energies = study.energies
    assert energies.units["kinetic.mean"] == "J" and energies.units["time"] == "s" and energies.units["running"] == "1"
    last = energies["dissipated.mean"][energies["point"] == 2][-1]
    assert abs(last / summary["points"][2]["energies"]["end"]["dissipated"]["mean"] - 1) < 1e-14  # a table has 15 digits
    assert len(fracas.open("plates").energies) == 0


def refused(status, words, call, *arguments, **options):
    """The call raises what the program says, with its status."""
    try:
        call(*arguments, **options)
    except fracas.Error as error:
        assert error.status == status and words in str(error), (error.status, str(error))
        return str(error)
    raise AssertionError(f"no error: {words}")


def check_errors():
    refused(5, "is no study", fracas.open, "planned")
    shutil.copytree("half", "empty")
    subprocess.run(["sqlite3", "empty/index.sqlite", "UPDATE realization SET status = 'planned', segment = NULL"], check=True)
    refused(3, "goes on", fracas.open, "empty")
    shutil.copytree("whole", "again")
    subprocess.run(["sqlite3", "again/index.sqlite", "UPDATE realization SET status = 'planned' WHERE replica = 5"], check=True)
    assert fracas.open("again").partial and len(fracas.open("again").realizations["point"]) == 15
    shutil.copytree("whole", "cut")
    with open("cut/study.h5", "r+b") as file:
        file.truncate(5000)
    refused(5, "fracas verify cut", fracas.open, "cut")
    os.unlink("cut/study.h5")
    with open("cut/index.sqlite", "wb") as file:
        file.write(b"nonsense" * 1000)
    refused(5, "fracas verify cut", fracas.open, "cut")
    refused(2, "output: {interfaces: true}", lambda: fracas.open("whole").mesh(0))
    refused(5, "is no study", fracas.status, "planned")
    refused(2, "unknown option", fracas.plan, "one.yaml", haste=True)
    place = os.environ.pop("FRACAS")
    os.environ["FRACAS"] = "nowhere"
    refused(6, "nowhere", fracas.program)
    os.environ["FRACAS"] = place


CAMPAIGN = {
    "name": "small", "seed": 7, "model": "bar",
    "geometry": {"ends": "periodic", "length": "10 mm", "area": 1e-6}, "mesh": {"elements": 500},
    "material": {"young": "275 GPa", "density": "2750 kg/m3"}, "cohesive": {"law": "nitsche", "fracture_energy": "100 J/m2", "beta": 4},
    "strength": {"distribution": "uniform", "minimum": "299 MPa", "maximum": "301 MPa"},
    "loading": {"type": "imposed-rate", "rate": 1e5}, "time": {"stop": "quiet", "end": "300 ns", "quiet": "50 ns", "safety": 0.25},
    "sweep": [{"loading.rate": np.array([1e5, 2e5, 3e5])}], "replicas": 6, "output": {"history": 20, "interfaces": True}}


def check_campaigns():
    """A mapping is planned, refused, computed, extended, retried and compared as its file is by the program."""
    plans = [fracas.plan(campaign) for campaign in (CAMPAIGN, "one.yaml")]
    assert len({tuple(point["hash"] for point in plan["point"]) for plan in plans}) == 1 and plans[0]["realizations"] == 18
    wrong = {**CAMPAIGN, "cohesive": {"law": "nitsche", "gama": 1}}
    fracas.write(wrong, "wrong.yaml")
    said = subprocess.run([fracas.program(), "plan", "wrong.yaml"], capture_output=True, text=True)
    assert refused(2, "unknown key `gama`", fracas.plan, "wrong.yaml") == said.stderr.strip().removeprefix("fracas: ")
    assert refused(2, "unknown key `gama`", fracas.plan, wrong).startswith("campaign:15 `gama: 1`: ")
    fracas.write({**wrong, "replicas": 0}, "wrong.yaml")
    said = subprocess.run([fracas.program(), "plan", "wrong.yaml"], capture_output=True, text=True).stderr
    both = said.replace("fracas: ", "").strip()
    assert refused(2, "", fracas.plan, "wrong.yaml") == both and both.count("wrong.yaml:") == 2, both
    two = refused(2, "", fracas.plan, {**wrong, "replicas": 0}).splitlines()
    assert [line.split(":")[0] for line in two] == ["campaign", "campaign"] and "`replicas: 0`" in two[1], two
    lines = []
    study = fracas.run(CAMPAIGN, say=lines.append, jobs=2)
    assert str(study.path) == "studies/small" and "18 of 18 realizations" in lines[0]
    with open("whole/study.h5", "rb") as whole, open("studies/small/study.h5", "rb") as ours:
        assert whole.read() == ours.read()
    assert len(fracas.extend(study, 7).realizations["point"]) == 21 and len(fracas.retry(study).realizations["point"]) == 21
    assert "2/3: computed again, the same bytes" in fracas.replay(study, 2, 3)
    refused(2, "", fracas.replay, study, 2, 99)
    table = fracas.compare("half", study)
    found = fracas.call_json("compare", "half", study.path)
    rows = [(point["label"], name, value["a"]["mean"], value["p"]) for point in found["points"] for name, value in point["values"].items()]
    assert rows == list(zip(table["label"], table["statistic"], table["a.mean"], table["p"])) and table.attributes["b"] == found["b"]
    assert not glob.glob(".campaign-*")


def started(study, alive):
    """Waits until a run computes the study."""
    while alive():
        try:
            if fracas.status(study)["running"]:
                return
        except fracas.Error:  # there is no study yet
            time.sleep(0.01)


def check_watch():
    """A run is watched until it ends, and Ctrl-C, which reaches Python and the program, ends one with Error 3."""
    thread = threading.Thread(target=fracas.run, args=({**CAMPAIGN, "replicas": 300}, "watched"), kwargs={"jobs": 2})
    thread.start()
    started("watched", thread.is_alive)
    done = [state["done"] for state in fracas.watch("watched", 0.01)]
    thread.join()
    assert done == sorted(done) and done[-1] == 900 and len(done) >= 2, done
    fracas.write({**CAMPAIGN, "replicas": 10000}, "long.yaml")
    script = "import fracas\ntry: fracas.run('long.yaml', 'stopped', jobs=2)\nexcept fracas.Error as error: print(error.status, error)"
    run = subprocess.Popen([sys.executable, "-c", script], start_new_session=True, stdout=subprocess.PIPE, text=True)
    started("stopped", lambda: run.poll() is None)
    os.killpg(run.pid, signal.SIGINT)
    assert run.communicate()[0].startswith("3 ")


columns = check_whole("whole") + check_whole("plates")
check_elements("whole")
check_elements("half")
check_elements("rings")
# rates of at most 3e5 /s move no point, 5 mm from the middle at most, by more than 0.15 mm in 100 ns; elements have 0.4 mm and more
check_elements("plates", 2e-4)
check_alone()
check_half()
check_report()
check_errors()
check_campaigns()
check_watch()
print(columns, "columns are those of study.h5")
