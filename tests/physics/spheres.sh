# ctest-labels: storm
# ctest-serial
# ctest-timeout: 900
# The paper's sphere on coarse meshes: energies and first onsets by closed forms, ledgers that close, hardly any bending, more
# fragments at the higher rate, an octant that stands for its eighth of the whole.
. tests/support/campaigns.sh

cat > sphere.yaml <<'END'
name: sphere
seed: 1
model: shell
geometry: {shape: sphere, radius: 9.95 mm, thickness: 0.1 mm, part: octant}
mesh: {divisions: 60, amplitude: 0.1}
material: {young: 370 GPa, density: 3900 kg/m3, poisson: 0.22}
cohesive: {law: nitsche, fracture_energy: 50 J/m2}
strength: {distribution: weibull, minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {type: expansion}
time: {stop: time, safety: 0.5}
sweep:
  - cases:
      - {name: slow, loading.rate: 1e4 1/s, time.end: 500 ns}
      - {name: fast, loading.rate: 2e4 1/s, time.end: 250 ns}
      - {name: whole, loading.rate: 1e4 1/s, time.end: 500 ns, geometry: {part: whole}, mesh: {divisions: 38}}
replicas: 8
output: {history: 50}
END
expect 0 "$fracas" run sphere.yaml --study sphere
"$fracas" report sphere --json > sphere.json
/usr/bin/python3 "$source/docs/examples/fragments_from_study.py" sphere/study.h5 1e-4 > fragments.tsv
/usr/bin/python3 - <<'END'
import json, math
import h5py

study = h5py.File("sphere/study.h5")
realization, history = study["realization"], study["history"]
offset = history["offset"][:]
points = json.load(open("sphere.json"))["points"]
young, nu, density, radius, thickness = 370e9, 0.22, 3900, 9.95e-3, 1e-4
w = math.sqrt(2 * young / (density * radius**2 * (1 - nu)))
for p, point in enumerate(points):
    s = point["statistics"]
    assert s["usable"] == s["realizations"] == 8, point
    rate, part = (2e4 if p == 1 else 1e4), (1 if p == 2 else 1 / 8)
    mine = [r for r in range(len(realization["point"])) if realization["point"][r] == p]
    # Meshes of 3600 and 28 880 curved elements: areas are right to (edge/R)^4, 1e-6; so are masses, and kinetic energies of v = rate x.
    mass = part * 4 * math.pi * radius**2 * thickness * density
    kinetic = 0.5 * mass * (rate * radius)**2
    # Onset: no strength is below 264 MPa, the weakest of some 5000 (40 000) interfaces is within 1.5 MPa of it; the stress of elements
    # strays by 1 % (of a shell of such edges, docs/results/shell.md).
    earliest = math.asin(264e6 * (1 - nu) * w / (young * rate)) / w
    for r in mine:
        assert abs(realization["mass"][r] / mass - 1) < 1e-5 and abs(history["kinetic"][offset[r]] / kinetic - 1) < 1e-5
        assert 0.98 < realization["onset_time"][r] / earliest < 1.03, (realization["onset_time"][r], earliest)
        rows = range(offset[r], offset[r + 1])
        before = [i for i in rows if history["time"][i] < realization["onset_time"][r]]
        assert len(before) > 3 and max(abs(history["residual"][i]) for i in before) < 1e-12 * kinetic
    assert s["residual"] < 1e-3 and s["created"] < 1e-2, s
    # The sphere is stretched; bending has the share of what is not alike on both faces, (1 + h/2R)^2 - 1 = 1 % at onset, and of free edges.
    bending = sum(realization["dissipated_bending"][r] / realization["dissipated"][r] for r in mine) / len(mine)
    print("count", s["count.mean"], "+-", s["count.half_width"], "residual", s["residual"], "created", s["created"], "bending", bending)
    assert 0 < bending < 0.02

# The script for readers counts the same fragments, and their masses are the body's.
for point, line in zip(points, open("fragments.tsv").read().splitlines()[1:]):
    row, s = line.split("\t"), point["statistics"]
    assert int(row[1]) == round(8 * s["count.mean"]) and int(row[1]) - int(row[2]) == round(8 * s["count_large.mean"]), row
    large = (1 - float(row[3])) * 8 * realization["mass"][8 * points.index(point)]
    assert abs(float(row[4]) * (int(row[1]) - int(row[2])) / large - 1) < 2e-3, row # four digits are printed

slow, fast, whole = (p["statistics"] for p in points)
assert fast["count.mean"] - fast["count.half_width"] > 1.3 * (slow["count.mean"] + slow["count.half_width"])
# Planes of symmetry cut fragments, which then count in two octants: some 100 of 675, 7 % too many; and the meshes are not alike, of which dust
# (half of all fragments here) knows most. Without dust within 15 %, and the energies within 3 % beside the scatter of 8 replicas.
for name, share in (("dissipated", 0.03), ("count_large", 0.15)):
    ratio = 8 * slow[name + ".mean"] / whole[name + ".mean"]
    print(name, "of eight octants by that of the whole", ratio)
    assert abs(ratio - 1) < share
END
