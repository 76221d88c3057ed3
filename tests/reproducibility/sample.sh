# ctest-timeout: 300
# What `fracas sample` shows are the strengths of a run, to the last bit, at the places of its mesh.
. tests/support/campaigns.sh

campaign bar.yaml 3 '1e5 1/s'
cat > plate.yaml <<'END'
name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 4 mm, height: 2 mm, thickness: 0.1 mm}
mesh: {divisions: 6, amplitude: 0.2}
material: {young: 370 GPa, density: 3900 kg/m3, poisson: 0.22}
cohesive: {law: nitsche, fracture_energy: 50 J/m2}
strength: {distribution: weibull, minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {type: expansion, rate: 1e4 1/s}
time: {stop: time, end: 10 ns}
sweep:
  - mesh.divisions: [4, 6]
replicas: 2
output: {history: 1, interfaces: true}
END
for body in bar plate; do
    expect 0 "$fracas" run --no-report $body.yaml --study $body
    for file in $body.yaml $body/campaign.yaml; do # a study's own file draws the same
        expect 0 "$fracas" sample $file --point $([ $body = bar ] && echo 0 || echo 1) --replica 1 --csv $body.csv --vtk $body.vtk --json
        cat said > $body.json
        /usr/bin/python3 - $body <<'END'
import csv, json, math, statistics, sys
import h5py
body = sys.argv[1]
rows = list(csv.DictReader(open(body + ".csv")))
drawn = [float(r["strength_Pa"]) for r in rows]
with h5py.File(body + "/study.h5") as study:
    realization = [i for i, (p, r) in enumerate(zip(study["realization/point"], study["realization/replica"]))
                   if r == 1 and p == (0 if body == "bar" else 1)][0]
    of = slice(*study["interface/offset"][realization:realization + 2])
    assert drawn == list(study["interface/strength"][of]), "the run had other strengths"
assert [int(r["interface"]) for r in rows] == list(range(len(drawn))) and all(r["gauss_point"] == "0" for r in rows)

# 12 digits of lengths below 0.1 m.
where = [[float(r[k]) for k in ("x_m", "y_m", "z_m")] for r in rows]
if body == "bar":
    assert all(abs(x[0] - 0.01 * (i + 1) / 500) < 1e-13 and x[1] == x[2] == 0 for i, x in enumerate(where))

words = open(body + ".vtk").read().split("\n", 2)[2].split()
def block(key, width, skip):
    at = words.index(key)
    count = int(words[at + 1])
    values = words[at + skip:at + skip + count * width]
    return [values[i:i + width] for i in range(0, len(values), width)]
points = [[float(x) for x in p] for p in block("POINTS", 3, 3)]
at = words.index("default") + 1
assert [float(x) for x in words[at:]] == drawn, "VTK and CSV differ"
if body == "bar":
    assert len(points) == len(drawn) and all(math.dist(p, x) < 1e-13 for p, x in zip(points, where))
else: # each line's middle is where the interface is
    lines = [[int(x) for x in line[1:]] for line in block("CELLS", 3, 3)]
    assert len(lines) == len(drawn)
    for (a, b), x in zip(lines, where):
        assert math.dist([(p + q) / 2 for p, q in zip(points[a], points[b])], x) < 1e-13

summary = json.load(open(body + ".json"))
assert summary["strengths"] == len(drawn) and summary["replica"] == 1
assert abs(summary["mean"] / statistics.fmean(drawn) - 1) < 1e-13 and abs(summary["deviation"] / statistics.stdev(drawn) - 1) < 1e-9
assert summary["weakest"]["strength"] == min(drawn) and drawn[summary["strongest"]["interface"]] == max(drawn)
below = sum(s < summary["q25"] for s in drawn) / len(drawn)
assert abs(below - 0.25) <= 1 / len(drawn), below
END
    done
done
expect 0 "$fracas" sample bar.yaml --replica 1 --csv -
cmp said bar.csv || fail "--csv - is not what --csv writes"

# A replica that no campaign asks for has its strengths too; another one has others.
expect 0 "$fracas" sample bar.yaml --replica 12345 --csv other.csv
if cmp -s other.csv bar.csv; then fail "two replicas are alike"; fi

expect 2 "$fracas" sample bar.yaml --point 1
said 'there is no point 1 in campaign small; it has 1, from 0 on'
expect 2 "$fracas" sample bar.yaml --replica -1
said 'replica is `-1`'
expect 2 "$fracas" sample bar.yaml --csv - --json
said 'csv - and --json both print'
expect 2 "$fracas" sample bar.yaml --vtk -
said 'vtk is `-`'
expect 6 "$fracas" sample bar.yaml --csv nowhere/bar.csv
said 'cannot write nowhere/bar.csv: No such file'

# A file that cannot be written leaves what was there, and nothing else; a device or a pipe is no file to be replaced or removed.
cp bar.csv kept.csv
if (ulimit -f 1; trap '' XFSZ; "$fracas" sample bar.yaml --replica 2 --csv kept.csv) > said 2>&1; then fail "a file of 1 KiB was enough"; fi
said 'cannot write kept.csv: File too large'
cmp bar.csv kept.csv || fail "what could not be replaced was lost"
[ "$(ls | grep -c 'kept.csv')" -eq 1 ] || fail "half a file was left: $(ls)"
mkfifo pipe
cat pipe > piped.csv &
expect 0 "$fracas" sample bar.yaml --replica 1 --csv pipe
wait
cmp piped.csv bar.csv || fail "a pipe does not get what a file gets"
[ -p pipe ] || fail "the pipe was replaced"
ln -s /dev/full full # the link can be lost without harm
expect 6 "$fracas" sample bar.yaml --vtk full
said 'cannot write full: No space left on device'
[ -h full ] || fail "a link to a device was removed"
expect 0 "$fracas" distributions
for name in constant uniform normal lognormal gamma weibull flaws; do said "^$name"; done
