"""usage: check_python_kernel.py NAME: realizations of NAME.yaml by fracas.realize are those of the study NAME and of ./realize, in C."""
import subprocess
import sys

import numpy as np

import fracas

name = sys.argv[1]
study = fracas.open(name)
points = len(study.points["hash"])
compared = 0
for point in sorted({0, points // 2, points - 1}):
    lines = subprocess.run(["./realize", name + ".yaml", str(point), "2"], check=True, capture_output=True, text=True).stdout.splitlines()
    for replica in (0, 1):
        stored, ours = study.realization(point, replica), fracas.realize(name + ".yaml", point, replica)
        tables = [(stored.numbers, ours.numbers), (stored.fragments, ours.fragments), (stored.history, ours.history)]
        if study.attributes["interfaces"]:
            tables.append((stored.interfaces, ours.interfaces))
        for theirs, table in tables:
            assert set(table) == set(theirs) and {of: table.units[of] for of in theirs} == theirs.units
            for column in theirs:
                assert table[column].tobytes() == theirs[column].tobytes() and table[column].dtype == theirs[column].dtype, (point, replica, column)
                compared += 1
        _, fragments, end, size = lines[replica].split("\t")
        total = 0.0
        for one in ours.fragments["size"]:  # in the order of the example in C
            total += one
        assert (int(fragments.split()[0]), float(end.split()[1]), float(size.split()[2])) == (
            ours["fragments"], ours["end_time"], total / len(ours.fragments["size"])), (lines[replica], total)

if name == "bar":  # strengths of one's own, those of replica 1, make it replica 1
    fed = fracas.realize("bar.yaml", 0, 0, strength=study.realization(0, 1).interfaces["strength"])
    assert fed["dissipated"] == study.realization(0, 1)["dissipated"] != study.realization(0, 0)["dissipated"] and fed["replica"] == 0
    for arguments, words in (((0, 0, np.ones(3)), "(500,)"), ((9,), "point 9"), ((0, -1), "replica -1")):
        try:
            fracas.realize("bar.yaml", *arguments)
            raise SystemExit(f"no error: {words}")
        except fracas.Error as error:
            assert error.status == 2 and words in str(error), str(error)
    try:
        fracas.realize({"name": "x", "modle": "bar"})
        raise SystemExit("no error")
    except fracas.Error as error:
        told = str(error).splitlines()  # all errors of the file, by line
        assert [line.split("`: ")[1].split(" `")[0] for line in told] == ["the file has no", "the file has no", "unknown key"], told
        assert told[-1].startswith('campaign:2 `modle: "bar"`: unknown key'), told
print(name, compared, "columns are the same in Python, C and the study")
