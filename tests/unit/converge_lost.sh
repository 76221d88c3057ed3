# What fracas converge says of realizations that it could not judge by: a bar whose interfaces are too soft for its higher rates, so that some runs of one
# point and all of another end ENERGY_DRIFT, and at the lowest rate nothing breaks.
. tests/support/campaigns.sh

cat > lossy.yaml <<END
name: lossy
seed: 7
model: bar
geometry: {ends: periodic, length: 2 mm, area: 1 mm2}
mesh: {elements: 40}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 1.25}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 330 MPa}
loading: {type: imposed-rate}
time: {stop: time, end: 300 ns, safety: 0.25}
sweep:
  - loading.rate: [1e2 1/s, 3e5 1/s, 7.5e5 1/s, 9e5 1/s]
replicas: 10
output: {history: 0}
END
expect 0 "$fracas" converge lossy.yaml --study lossy --jobs 2
cp said terminal.txt
"$fracas" converge lossy.yaml --study lossy --jobs 2 --json > lossy.json 2> said
for study in base mesh step beta end; do
    "$fracas" report lossy/$study > $study.txt 2>&1
done

# Every line is derived anew from the outcomes that the reports of the studies have; terminal, page and JSON say the same.
/usr/bin/python3 - <<'END' || fail "what is said of lost realizations"
import csv, html, json, re
terminal = open("terminal.txt").read()
page = html.unescape(open("lossy/report/index.html", encoding="utf-8").read())
told = json.load(open("lossy.json"))
rows = list(csv.DictReader(open("lossy/converge.csv")))
points = {s: list(csv.DictReader(open(f"lossy/{s}/report/points.csv"))) for s in ("base", "mesh", "step", "beta", "end")}
rates = ["100 1/s", "3e5 1/s", "7.5e5 1/s", "9e5 1/s"]
wanted, seen = [], set()
for study, of in points.items():
    for i, point in enumerate(of):
        usable, drift = int(point["usable"]), int(point["outcome.ENERGY_DRIFT"])
        assert usable + drift == 10
        ends = f"judged from {usable}" if usable else "none is left, its numbers are unknown"
        if drift:
            wanted.append((study, i, f"{study}, rate {rates[i]}: {drift} of 10 realizations ended ENERGY_DRIFT: {ends}"))
            seen.add("all" if not usable else "some")
        if usable and int(point["outcome.INTACT"]) == usable:
            wanted.append((study, i, f"{study}, rate {rates[i]}: all {usable} usable realizations end INTACT: "
                           "nothing breaks, and nothing is judged of how it breaks"))
            seen.add("whole")
    warnings = open(f"{study}.txt").read().count("\nwarning: ")
    assert warnings > 0
    wanted.append((study, None, f"{study}: its report has {warnings} warnings: fracas report lossy/{study}"))
assert seen == {"all", "some", "whole"}, seen
assert [(w["refinement"], w["point"], w["text"]) for w in told["warnings"]] == wanted, (told["warnings"], wanted)
assert re.findall("^warning: (.*)$", terminal, re.M) == [text for _, _, text in wanted]
assert re.findall("<li>warning: (.*)</li>", page) == [text for _, _, text in wanted]

# Figures and tables are of all five studies: they name the folder of them.
sources = re.findall('<span class="source">([^<]*)</span>', page)
assert len(sources) == page.count("<b>Figure") + page.count("<b>Table") >= 5, sources
assert all(re.fullmatch(r" ?lossy, fracas [^,]*\.", source) for source in sources), sources

# A point of which a study has lost all is in the table, and counted.
for study in ("mesh", "step", "beta", "end"):
    of = [row for row in rows if row["refinement"] == study]
    assert {row["point"] for row in of} == {"0", "1", "2", "3"}, study
    for row in of:
        lost = "0" in (points["base"][int(row["point"])]["usable"], points[study][int(row["point"])]["usable"])
        assert (row["verdict"] == "unknown") == lost and (row["difference"] == "") == lost, row
        assert not lost or int(row["refined_n"]) == int(points[study][int(row["point"])]["usable"]), row
    unknown = sum(row["verdict"] == "unknown" for row in of)
    assert unknown > 0 and f"{study}: of {len(of)} numbers" in terminal and f"{unknown} without an interval" in terminal
    assert re.search(f"^{study} +rate 9e5 1/s +count .* unknown$", terminal, re.M)
assert told["unknown"] == sum(row["verdict"] == "unknown" for row in rows)
END

# Asked for fewer replicas than there are, it says how many these are, and writes nothing; with them it prints the table. A campaign that differs
# in more is told what differs.
expect 0 "$fracas" converge lossy.yaml --study lossy --jobs 2 --replicas 12 --only beta
cp lossy/base.yaml before.yaml
for replicas in '' '--replicas 11'; do
    # shellcheck disable=SC2086 # two words
    expect 5 "$fracas" converge lossy.yaml --study lossy $replicas
    said 'lossy has 12 replicas of each point already: give --replicas 12 or more'
    ! grep -q 'campaign.yaml' said || fail "it says more than what to do"
done
cmp before.yaml lossy/base.yaml
expect 0 "$fracas" converge lossy.yaml --study lossy --jobs 2 --replicas 12
said '^mesh .* count '
sed 's/9e5 1/8e5 1/' lossy.yaml > other.yaml
expect 5 "$fracas" converge other.yaml --study lossy
! grep -q 'give --replicas' said || { cat said >&2; fail "replicas would not help"; }
said 'another campaign'
