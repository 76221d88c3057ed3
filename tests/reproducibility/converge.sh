# ctest-labels: ci
# fracas converge from end to end: a coarse mesh is found out and a fine one holds, what is interrupted goes on to the same numbers, more
# replicas extend all studies, and what cannot be refined is said so.
. tests/support/campaigns.sh

# bar ELEMENTS LENGTH REPLICAS: seconds of one core at most.
bar()
{
    cat <<END2
name: bar
seed: 7
model: bar
geometry: {ends: periodic, length: $2, area: 1 mm2}
mesh: {elements: $1}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: time, end: 300 ns, safety: 0.25}
replicas: $3
output: {history: 0}
END2
}

# verdict REFINEMENT NUMBER FOLDER: the last field of its line.
verdict()
{
    awk -F, -v r="$1" -v n="$2" '$1 == r && $4 == n {print $NF}' "$3/converge.csv"
}

# Elements of 0.1 mm are as long as fragments should be, and fewer than one element breaks where there is none: the count moves. One of
# 5 um is a twenty-fifth of a fragment: within 5 % it does not, with strengths in common by far not (fixed seeds).
bar 100 '10 mm' 32 > coarse.yaml
expect 0 "$fracas" converge coarse.yaml --study coarse --jobs 1
said 'mesh  half the element size'
said '4 times the work'
[ "$(verdict mesh count coarse)" = moved ] || { cat coarse/converge.csv >&2; fail "a coarse mesh was not found out"; }
for what in step beta; do
    [ "$(verdict $what onset_time coarse)" = holds ] || fail "strengths are not in common: $(verdict $what onset_time coarse)"
done
bar 1000 '5 mm' 24 > fine.yaml
expect 0 "$fracas" converge fine.yaml --study fine --jobs 2 --tolerance 8
! grep -q moved fine/converge.csv || { cat fine/converge.csv >&2; fail "a fine mesh is said to move numbers"; }
for what in mesh step beta end; do
    for number in count size dissipated onset_time; do
        case $(verdict $what $number fine) in
        holds | shifted) ;;
        *) cat fine/converge.csv >&2; fail "$what, $number is $(verdict $what $number fine)" ;;
        esac
    done
done

# The same command computes nothing and says the same; the studies are those of `fracas run`, and JSON has the numbers of the CSV file.
cp coarse/converge.csv before.csv
"$fracas" converge coarse.yaml --study coarse --jobs 1 --json > coarse.json 2> said
[ "$(grep -c 'is complete, nothing to compute' said)" -eq 5 ] || { cat said >&2; fail "a complete study was computed again"; }
cmp before.csv coarse/converge.csv
expect 0 "$fracas" run coarse/mesh.yaml --study again --jobs 1
same coarse/mesh again
expect 0 "$fracas" verify coarse/step
/usr/bin/python3 - <<'END2'
import csv, json, math
told = json.load(open("coarse.json"))
rows = list(csv.DictReader(open("coarse/converge.csv")))
assert len(rows) == len(told["numbers"]) >= 12 and told["left_out"] == []
assert sum(told[v] for v in ("moved", "shifted", "holds", "unclear", "unknown")) == len(rows)
for row, number in zip(rows, told["numbers"]):
    assert row["verdict"] == number["verdict"] and row["refinement"] == number["refinement"] and row["number"] == number["number"]
    assert (row["method"] == "welch") == (row["refinement"] == "mesh")
    for key in ("difference", "low", "high", "relative", "half_widths", "p", "p_holm"):
        same = row[key] == "" if number[key] is None else math.isclose(float(row[key]), number[key], rel_tol=1e-14, abs_tol=1e-300)
        assert same, (key, row, number)
    assert math.isclose(number["difference"], number["refined"]["mean"] - number["base"]["mean"], rel_tol=1e-9, abs_tol=1e-9 * abs(number["base"]["mean"]))
END2

# The figures: of all of them together a mark for each line of converge.csv, filled where it differs, with its numbers beside it; the page has them.
# figures FOLDER
figures()
{
    /usr/bin/python3 - "$1" <<'END3'
import csv, math, os, re, sys
import xml.etree.ElementTree as xml
report = os.path.join(sys.argv[1], "report")
rows = list(csv.DictReader(open(os.path.join(sys.argv[1], "converge.csv"))))
page = open(os.path.join(report, "index.html"), encoding="utf-8").read()
names = sorted({row["number"] for row in rows})
assert sorted(name for name in os.listdir(report) if name.endswith(".svg")) == [f"converge-{name}.svg" for name in names]
assert len(re.findall('class="mark', page)) == len(rows) >= 12
for name in names:
    of = [row for row in rows if row["number"] == name]
    drawing = xml.parse(os.path.join(report, f"converge-{name}.svg"))
    marks = [path.get("class") for path in drawing.iter("{http://www.w3.org/2000/svg}path") if path.get("class").startswith("mark")]
    assert len(marks) == len(of), (name, len(marks), len(of))
    assert marks.count("mark") == sum(row["verdict"] in ("moved", "shifted") for row in of), (name, marks)
    with open(os.path.join(report, f"converge-{name}.csv"), encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    for kind in ("mark", "box"):
        drawn = [line for line in lines if line["kind"] == kind]
        assert len(drawn) == len(of), (name, kind)
        (label,) = [key for key in lines[0] if key.startswith(f"change of {name} [")]
        relative = label.endswith("[%]")
        assert relative == all(row["relative"] for row in of)
        factor = 100 if relative else {"1": 1, "µm": 1e6, "mm": 1e3, "m": 1, "mJ": 1e3, "ns": 1e9}[label[:-1].rpartition("[")[2]]
        for row in of:
            half = float(row["base_half_width"]) / (float(row["base_mean"]) if relative else 1)
            part = "relative_{}" if relative else "{}"
            wanted = (-half, half, 0) if kind == "box" else (float(row[part.format("low")]), float(row[part.format("high")]),
                                                             float(row["relative" if relative else "difference"]))
            found = [line for line in drawn if line["refined"] == row["refinement"] and
                     all(math.isclose(float(line[key]), factor * number, rel_tol=1e-11, abs_tol=1e-9)
                         for key, number in zip(("low", "high", label), wanted))]
            assert found, (name, kind, row)
assert any("[%]" not in line for line in re.findall("change of [a-z_]* .[^ ]*.", page)) == (sys.argv[1] == "coarse") # no dust to begin with
assert page.count("<tr>") == 1 + len(rows) and all(f'href="converge-{name}.csv"' in page for name in names)
END3
}
figures coarse || fail "the figures of coarse"
figures fine || fail "the figures of fine"

# Interrupted in the second study: status 3; with the same command the same end.
bar 1600 '16 mm' 40 > long.yaml
expect 0 "$fracas" converge long.yaml --study undisturbed --jobs 2
setsid "$fracas" converge long.yaml --study long --jobs 2 > background 2>&1 &
session=$!
await 'second study' grep -q 'long/step: ' background
kill -INT "$session"
status=0
wait "$session" || status=$?
[ $status -eq 3 ] || { cat background >&2; fail "status $status of an interrupted one"; }
[ -z "$(processes)" ] || fail "processes outlive it"
session=
[ ! -e long/mesh ] && [ ! -e long/converge.csv ] || fail "it went on"
expect 3 "$fracas" converge long.yaml --study long --jobs 2 --walltime 1s
expect 0 "$fracas" converge long.yaml --study long --jobs 2
cmp long/converge.csv undisturbed/converge.csv
for what in base end step beta mesh; do
    same long/$what undisturbed/$what
done

# More replicas extend every study; another campaign is refused before anything is written.
expect 0 "$fracas" converge coarse.yaml --study coarse --jobs 2 --replicas 40 --only mesh
[ "$(sed -n 's/.*,refined,.*//p' coarse/report/converge-count.csv | wc -l)" = 1 ] && ! grep -q beta coarse/report/converge-count.csv || fail "refinements that were not asked for"
[ "$(awk -F, 'NR > 1 {print $6, $9}' coarse/converge.csv | sort -u)" = '40 40' ] || { cat coarse/converge.csv >&2; fail "not 40 replicas"; }
sed 's/1e5/2e5/' coarse.yaml > other.yaml
expect 5 "$fracas" converge other.yaml --study coarse
said 'loading.rate'
grep -q 'rate: 100000' coarse/base.yaml || fail "a refused campaign was written"

# What cannot be refined, what is no use, and who may not start it.
sed 's/law: nitsche, fracture_energy: 100 J.m2, beta: 4/law: rigid-link, fracture_energy: 100 J\/m2/; s/safety: 0.25/safety: 0.14/' coarse.yaml > rigid.yaml
expect 2 "$fracas" converge rigid.yaml --study rigid --only beta
said 'its interfaces have no cohesive.beta'
[ ! -e rigid ] || fail "a refused campaign was written"
expect 0 "$fracas" converge rigid.yaml --study rigid --replicas 1 --jobs 1
said 'beta: 1 point left out'
said 'without an interval'
expect 2 "$fracas" converge coarse.yaml --part 1/2
expect 2 "$fracas" converge coarse.yaml --tolerance 0
expect 2 "$fracas" converge coarse.yaml --only steps
expect 2 launch -n 1 "$fracas" converge coarse.yaml
said 'several runs'
