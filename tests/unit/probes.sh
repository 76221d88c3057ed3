# Probes of a campaign: what a run stores does not depend on lanes, processes or interruptions; readers, Python and the data package agree
# with study.h5; a study keeps its probes; what is wrong has one message. Closed forms: verification/probes.
. tests/support/campaigns.sh

campaign plain.yaml 9 '2e4, 1e5'
{ cat plain.yaml; echo 'probes: {left: [0], middle: [5.003 mm, 0], right: [10 mm]}'; } > probed.yaml

# The same bytes whatever the lanes, processes, and after an interruption; beside the probes, the records of a run without them.
expect 0 "$fracas" run probed.yaml --study one --jobs 1 --lanes 1
expect 0 "$fracas" run probed.yaml --study two --jobs 2 --lanes 8 --shuffle
cmp one/study.h5 two/study.h5 || fail "other bytes with 8 lanes"
expect 0 "$fracas" run plain.yaml --study plain --jobs 2
expect 0 "$fracas" verify --full one
expect 0 "$fracas" replay one 1/4
said 'the same bytes'
expect 0 "$fracas" run one/campaign.yaml --study again --jobs 2
cmp one/study.h5 again/study.h5 || fail "the resolved file gives other bytes"
cp -r one partial
rm partial/study.h5
expect 0 "$fracas" report partial
expect 0 "$fracas" merge partial
cmp one/study.h5 partial/study.h5 || fail "the merge gives other bytes"
rm -r one/report # made anew, from study.h5
expect 0 "$fracas" report one
[ -e one/report/probes-point-1.svg ] && grep -q 'id="probes-over-time"' one/report/index.html || fail "no figure"
! grep -q probes-over-time plain/report/index.html || fail "a figure without probes"

# Forces of held edges.
cat > plate.yaml <<'END'
name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 5 mm, height: 5 mm, thickness: 1 mm, left: held, right: held}
mesh: {divisions: 12, order: 2, amplitude: 0.1}
material: {young: 275 GPa, density: 2750 kg/m3, poisson: 0.2}
cohesive: {fracture_energy: 100 J/m2}
strength: {distribution: weibull, minimum: 0, scale: 330 MPa, shape: 10}
loading: {type: expansion, rate: 1e4 1/s}
time: {stop: time, end: 0.2 us}
replicas: 3
output: {history: 20, interfaces: true, reactions: edges}
END
expect 0 "$fracas" run plate.yaml --study held --jobs 1 --lanes 1
expect 0 "$fracas" run plate.yaml --study other --jobs 2 --lanes 8
cmp held/study.h5 other/study.h5 || fail "other forces with 8 lanes"
expect 0 "$fracas" run held/campaign.yaml --study third --jobs 2
cmp held/study.h5 third/study.h5 || fail "the resolved file has no reactions"
expect 0 "$fracas" verify --full held
expect 0 "$fracas" replay held 0/2
[ -e held/report/reactions-point-0.svg ] && grep -q 'id="reactions-over-time"' held/report/index.html || fail "no figure of reactions"
! grep -q reactions-over-time one/report/index.html || fail "a figure without reactions"
sed 's/, reactions: edges//' plate.yaml > free.yaml
expect 5 "$fracas" run free.yaml --study held
said 'output.reactions is edges in the study, but nothing in this campaign file'
sed 's/, left: held, right: held//' plate.yaml > free.yaml
expect 2 "$fracas" plan free.yaml
said 'point 0: output.reactions asks for the forces of held edges and nodes, but none is held; leave it out, or hold one'
sed 's/interfaces: true}/interfaces: true, reactions: edges}/' plain.yaml > free.yaml
expect 2 "$fracas" plan free.yaml
said 'point 0: output.reactions asks for the forces of held edges and nodes, but surfaces alone have edges; leave it out'

# A study keeps its probes.
expect 5 "$fracas" run plain.yaml --study one
said 'probes is left 0 0 0; middle 0.005003 0 0; right 0.01 0 0 in the study, but nothing in this campaign file'
expect 5 "$fracas" run probed.yaml --study plain

# Wrong ones.
wrong()
{
    { cat plain.yaml; echo "probes: $1"; } > wrong.yaml
    expect 2 "$fracas" plan wrong.yaml
    said "$2"
    [ "$(grep -c '^fracas:' said)" = 1 ] || fail "not one message for $1: $(cat said)"
}
wrong '{a: [11 mm]}' 'point 0: probe a at (0.011, 0, 0) m is 0.001 m away from the body, whose nearest point is (0.01, 0, 0) m'
wrong '{a: 5 mm}' '`a`: found `5 mm`; expected one to three lengths x, y, z, as \[9 mm, 0\]'
wrong '{a: [1, 2, 3, 4]}' 'expected one to three lengths'
wrong '{a: [5 MPa]}' '`5 MPa` is a stress; expected a length'
wrong '{a b: [0]}' '`a b` is no name of a probe'
wrong '[a]' 'expected names with places'
wrong '{}' 'expected names with places'
wrong "{$(for i in $(seq 17); do printf 'p%d: [0], ' "$i"; done)}" 'found 17 probes; at most 16'

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }
expect 0 "$fracas" export one --histories
/usr/bin/python3 "$source/tests/support/check_export.py" one
expect 0 "$fracas" export held
/usr/bin/python3 "$source/tests/support/check_export.py" held
PYTHONPATH=$source/python /usr/bin/python3 - <<'END'
import csv
import re

import fracas
import h5py
import numpy as np

with h5py.File("one/study.h5") as one, h5py.File("plain/study.h5") as plain:
    assert "probe" not in plain and "probes" not in plain.attrs
    for group in ("realization", "fragment", "history", "interface"):
        for name in plain[group]:
            assert one[group][name][()].tobytes() == plain[group][name][()].tobytes(), (group, name)
study = fracas.open("one")
places = study.probe_places
assert list(places) == ["left", "middle", "right"] and places["middle"][0] == 0.005003
rates = study.points["loading.rate"]
for point in 0, 1:
    for replica in range(9):
        realization = study.realization(point, replica)
        for name, probe in realization.probes.items():
            time, u = probe["time"], probe["displacement"]
            assert np.array_equal(time, realization.history["time"]) and not u[:, 1:].any()
            # A wave of 1e4 m/s from the first crack has not arrived anywhere before the onset: rate x t, to rounding.
            early = time <= realization["onset_time"]
            assert early.sum() > (3 if point == 0 else 0)
            error = np.abs(u[early, 0] - rates[point] * places[name][0] * time[early])
            assert (error <= 1e-13 * rates[point] * 0.01 * time[early]).all(), (name, error.max())
with fracas.open("held") as held:
    forces = held.realization(0, 1).reactions
    # Until the first onset edges that stretch a plate alike pull at it by the same force; later each has its own.
    assert list(forces) == [1, 2] and len(held.reactions["force"]) == 2 * len(held.histories["time"])
    early = forces[1]["time"] < held.realization(0, 1)["onset_time"]
    left, right = (forces[tag]["force"][:, 0] for tag in (1, 2))
    assert (left[1:] < 0).any() and np.abs(left + right)[early].max() < 0.02 * np.abs(left).max() < np.abs(left + right).max()
# The figure of reactions draws the typical replica: forces as in the study, to the digits of the figure.
drawn = list(csv.reader(open("held/report/reactions-point-0.csv")))
scale = {"N": 1, "kN": 1e-3, "MN": 1e-6, "mN": 1e3}
unit = re.search(r"\[(\w+)\]", drawn[0][4]).group(1)
with fracas.open("held") as held:
    dissipated = held.realizations["dissipated"]
    typical = int(np.argmin(np.abs(dissipated - dissipated.mean())))
    forces = held.realization(0, typical).reactions
    force = {tag: forces[tag]["force"][:, 0] for tag in (1, 2)}
for tag in 1, 2:
    curve = np.array([float(row[4]) for row in drawn[1:] if row[:2] == ["1", f"edge {tag}"]])
    assert np.allclose(curve, scale[unit] * force[tag], rtol=1e-9, atol=1e-9 * np.abs(curve).max()), tag
names = [line["probe"] for line in csv.DictReader(open("one/export/probes.csv"))]
assert [list(places)[n] for n in study.probes["probe"]] == names
END
