# Cracks of surfaces over time: tables of the data package against study.h5, the figure of the report, and what has none.
# Closed forms: verification/cracks.
. tests/support/campaigns.sh

cat > plate.yaml <<'YAML'
name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 5 mm, height: 5 mm, thickness: 1 mm}
mesh: {divisions: 12, amplitude: 0.1}
material: {young: 275 GPa, density: 2750 kg/m3, poisson: 0.2}
cohesive: {fracture_energy: 100 J/m2}
strength: {distribution: weibull, minimum: 0, scale: 330 MPa, shape: 10}
notch: {from_x: -2.5 mm, to_x: -1 mm, from_y: 0, to_y: 0}
loading: {type: expansion, rate: 2e4 1/s}
time: {stop: time, end: 0.4 us}
replicas: 2
output: {history: 20, interfaces: true}
sweep:
  - mesh.divisions: [12, 14]
YAML
sed 's/, interfaces: true//' plate.yaml > without.yaml
sed '/^notch/d; s/^model: membrane/model: shell/' plate.yaml > shell.yaml
campaign bar.yaml 3 '1e5'
expect 0 "$fracas" run plate.yaml --study plate --jobs 2
expect 0 "$fracas" run without.yaml --study without --jobs 2
expect 0 "$fracas" run shell.yaml --study shell --jobs 2
expect 0 "$fracas" run bar.yaml --study bar --jobs 2

# Fragments by a damage: at 1 the script asserts those of the study, at 0 every element is one.
for of in plate shell; do
    /usr/bin/python3 "$source/docs/examples/fragments_by_damage.py" $of/study.h5 1 0.5 0 > damage.tsv || fail "fragments of $of by damage"
    awk -F '\t' '$4 > $5 || $5 > $6 || $6 != ($1 ? 392 : 288) { exit 1 } $4 < $5 { more++ } END { exit !(NR == 4 && more) }' damage.tsv ||
        { cat damage.tsv; fail "fragments of $of do not grow as less damage counts"; }
done

# What has no cracks to tell; a package without them names none.
expect 2 "$fracas" export bar --cracks
said 'bars and rings have no cracks that run: leave --cracks out'
expect 2 "$fracas" export without --cracks
said 'the study keeps no interfaces, by which cracks are known: set `output: {interfaces: true}`'
cp -r plate partial
rm partial/study.h5
expect 3 "$fracas" export partial --cracks
said 'finish its run first, or leave --cracks out'
expect 0 "$fracas" export plate --cracks
cp -r plate/export first
expect 0 "$fracas" export plate
[ ! -e plate/export/cracks.csv ] && [ ! -e plate/export/breaks.csv ] || fail "the cracks of the package of before"
expect 0 "$fracas" export shell --cracks

expect 0 "$fracas" report plate
expect 0 "$fracas" report without
[ -e plate/report/cracks-point-1.svg ] && grep -q 'id="cracks-over-time"' plate/report/index.html || fail "no figure"
! grep -q cracks-over-time without/report/index.html || fail "a figure without interfaces"

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }
/usr/bin/python3 "$source/tests/support/check_export.py" plate first
/usr/bin/python3 "$source/tests/support/check_export.py" shell
/usr/bin/python3 - <<'END_OF_CHECK' || fail "the numbers of cracks"
import csv
import h5py
import numpy as np

for name, folder in ("plate", "first"), ("shell", "shell/export"):
    cracks, breaks = [list(csv.DictReader(open(f"{folder}/{table}.csv"))) for table in ("cracks", "breaks")]
    with h5py.File(f"{name}/study.h5") as study:
        mesh, every, one = study["mesh"], study["interface"], study["realization"]
        for i, (point, replica) in enumerate(zip(one["point"], one["replica"])):
            rows = slice(*every["offset"][i : i + 2])
            place = mesh["node_position"][slice(*mesh["node_offset"][point : point + 2])]
            node = mesh["interface_node"][slice(*mesh["interface_offset"][point : point + 2])]
            size = np.linalg.norm(place[node[:, 1]] - place[node[:, 0]], axis=1)
            time = every["break_time"][rows]
            broken, notch = time > 0, time == 0
            assert broken.sum() > 20 and (notch.sum() > 3) == (name == "plate")
            of = [[row for row in table if (row["point"], row["replica"]) == (str(point), str(replica))] for table in (cracks, breaks)]
            order = np.lexsort((np.arange(len(time)), time))
            order = order[broken[order]]
            assert [int(row["interface"]) for row in of[1]] == list(order)
            # Sums of some 300 lengths, 15 digits.
            assert np.allclose([float(row["length"]) for row in of[1]], np.cumsum(size[order]), rtol=1e-12, atol=0)
            ends = [row for row in of[0] if not row["met"]] # which have the lengths of those that they met
            assert abs(sum(float(row["length"]) for row in ends) / size[broken].sum() - 1) < 1e-12
            assert abs(sum(float(row["notch"]) for row in ends) - size[notch].sum()) < 1e-12 * size.sum()
            assert sum(int(row["breaks"]) for row in ends) == broken.sum()
            assert all(float(row["extent"] or 0) < float(row["reach"]) * (1 + 1e-12) for row in ends if row["extent"])
END_OF_CHECK

# Python has both tables, with units.
FRACAS=$fracas PYTHONPATH=$source/python PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - <<'END_OF_CHECK' || fail "the cracks of Python"
import csv
import fracas

study = fracas.open("plate")
assert study.cracks.units["fastest"] == "m/s" and study.breaks.units["time"] == "s" and study.cracks.descriptions["met"]
for name, table in ("cracks", study.cracks), ("breaks", study.breaks):
    rows = list(csv.DictReader(open(f"first/{name}.csv")))
    assert list(table) == list(rows[0]) and len(rows) > 3
    for key in table:
        assert len(table[key]) == len(rows)
        assert all(row[key] == "" if number != number else float(row[key]) == number for row, number in zip(rows, table[key])), key
try:
    fracas.open("bar").cracks
except fracas.Error as error:
    assert error.status == 2 and "bars and rings have no cracks that run" in str(error)
else:
    raise AssertionError("a bar has no cracks")
END_OF_CHECK

# The figure draws one realization's breaks, and its last; speeds are over the c_R of its caption.
/usr/bin/python3 - <<'END_OF_CHECK' || fail "the figure of cracks"
import csv
import re

caption = re.search(r'id="cracks-point-1".*?<figcaption>(.*?)</figcaption>', open("plate/report/index.html", encoding="utf-8").read(), re.S).group(1)
replica = re.search(r"Replica (\d+),", caption).group(1)
rayleigh = float(re.search(r"= ([\d.e+]+) m/s", caption).group(1))
# Plane stress, nu = 0.2: the root of x^3 - 8 x^2 + 17.6 x - 9.6 in (0, 1) is 0.819359.
assert abs(rayleigh / (0.819359 * 275e9 / 2.4 / 2750) ** 0.5 - 1) < 1e-4, rayleigh
breaks = [row for row in csv.DictReader(open("first/breaks.csv")) if (row["point"], row["replica"]) == ("1", replica)]
drawn = list(csv.reader(open("plate/report/cracks-point-1.csv")))[1:]
for panel, name, column, scale, digits in ("1", "all cracks", "length", 1e3, 1e-9), ("2", "tip of the longest crack", "speed", 1 / rayleigh, 1e-3):
    curve = [(float(row[3]), float(row[4])) for row in drawn if row[:2] == [panel, name]]
    wanted = [(1e9 * float(row["time"]), scale * float(row[column])) for row in breaks if row[column]]
    assert len(curve) > 5, (name, len(curve))
    for x, y in curve:
        assert any(abs(x / t - 1) < 1e-9 and abs(y / value - 1) < digits for t, value in wanted), (name, x, y, wanted[:3])
    assert panel == "2" or abs(curve[-1][1] / wanted[-1][1] - 1) < 1e-9
END_OF_CHECK
