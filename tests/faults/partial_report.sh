# ctest-labels: ci
# The report of a study that is not complete: while a run goes on, after interruptions, with segments lost, extended, without an index,
# with nothing done. What it says of points that are complete is, to the last digit, what it says of the complete study.
. tests/support/campaigns.sh

# points STUDY FILE: of each complete point of the JSON summary its hash and statistics; how many there are in $complete.
points()
{
    "$fracas" report "$1" --json > "$2.json" 2> said || { cat said >&2; fail "no report of $1"; }
    complete=$(/usr/bin/python3 - "$2" <<'PYTHON'
import json, sys
study = json.load(open(sys.argv[1] + ".json"))
lines = [json.dumps([p["hash"], p["progress"], p["statistics"], p["outcomes"]]) for p in study["points"] if p["progress"]["complete"]]
open(sys.argv[1], "w").write("".join(line + "\n" for line in sorted(lines)))
keys = "planned", "done", "failed", "missing"
for key in keys: # the study is the sum of its points
    assert study["progress"][key] == sum(p["progress"][key] for p in study["points"]), key
assert study["progress"]["complete"] == all(p["progress"]["complete"] for p in study["points"])
print(len(lines))
PYTHON
)
}

# value FILE EXPRESSION: of the summary `s`.
value()
{
    /usr/bin/python3 -c 'import json, sys; s = json.load(open(sys.argv[1])); print(eval(sys.argv[2]))' "$1.json" "$2"
}

# part_of A B: every line of A is one of B.
part_of()
{
    while read -r line; do
        grep -qxF "$line" "$2" || fail "$1 has a point that $2 has otherwise: $line"
    done < "$1"
}

campaign small.yaml 20 '3e4 1/s, 6e4 1/s, 1e5 1/s'
expect 0 "$fracas" run small.yaml --study whole --jobs 2
points whole all
[ "$complete" -eq 3 ] || fail "$complete points of 3 in the complete study"
[ "$(value all 's["partial"]')" = False ] || fail "the complete study is called partial"
[ "$(value all 's["complete"]')" = True ] || fail "the complete study is not"
grep -q 'partial' whole/report/index.html && fail "the page of the complete study speaks of a partial one"

# Nothing is done yet: planned by a run that drains at once.
mkdir none
cp whole/campaign.yaml none
sqlite3 whole/index.sqlite .dump | sqlite3 none/index.sqlite
sqlite3 none/index.sqlite "UPDATE realization SET status = 'planned', segment = NULL, outcome = NULL; DELETE FROM segment"
expect 3 "$fracas" report none
said 'no realization of none is done yet, of 60'
[ ! -e none/report ] || fail "a report of nothing"

# Stopped at several places.
interruption=0 some=0
while [ $interruption -lt 3 ]; do
    hold
    start small.yaml --study stopped --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    wait_segments stopped $(($(segments stopped) + 9))
    kill_session
    release
    done=$(sqlite3 stopped/index.sqlite "SELECT count(*) FROM realization WHERE status = 'done'")
    [ "$done" -lt 60 ] || fail "it was over before it was killed"
    points stopped now
    [ "$(value now 's["partial"] and not s["complete"]')" = True ] || fail "the interrupted study is not called partial"
    part_of now all
    [ "$complete" -eq 0 ] || some=$((some + 1))
    [ "$(value now 's["progress"]["done"]')" -eq "$done" ] || fail "the report has not all of the $done realizations that are done"
    expect 0 "$fracas" report stopped
    said "warning: partial: $done of 60 realizations done: every number is of these alone"
    grep -q "partial: $done of 60 realizations done" stopped/report/index.html || fail "the page does not say that it is of $done realizations"
    [ "$(sqlite3 stopped/index.sqlite 'SELECT coalesce(sum(fragments), 0) FROM realization')" -eq \
        "$(($(wc -l < stopped/report/fragments.csv) - 1))" ] || fail "fragments.csv has not every fragment"
    interruption=$((interruption + 1))
done
echo "$interruption interruptions, $some of them with complete points"
[ "$some" -ge 1 ] || fail "no interruption left a point complete"

# While a run goes on.
campaign long.yaml 400 '3e4 1/s, 6e4 1/s, 1e5 1/s'
hold
start long.yaml --study going --jobs 1 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments going 5
points going now
kill_session
release
[ "$(value now 's["partial"] and 0 < s["progress"]["done"] < 1200')" = True ] || fail "the report while a run goes on is none of a part"

# All done, study.h5 lost: from the segments, all numbers and files are those of the complete study.
expect 0 "$fracas" run small.yaml --study stopped --jobs 2
same whole stopped
rm stopped/study.h5
points stopped now
cmp all now || fail "the numbers from segments differ from those of study.h5"
cmp whole/report/fragments.csv stopped/report/fragments.csv || fail "fragments.csv from segments differs"
cmp whole/report/points.csv stopped/report/points.csv || fail "points.csv from segments differs"
cmp whole/report/energies-point-0.svg stopped/report/energies-point-0.svg || fail "the energies from segments differ"
expect 0 "$fracas" report stopped
said 'partial: 60 of 60 realizations done, but study.h5 is not there'
expect 0 "$fracas" merge stopped
points stopped now
[ "$(value now 's["partial"]')" = False ] || fail "a merged study is called partial"

# A segment is missing, another damaged.
rm stopped/study.h5
set -- stopped/segments/*.h5
mv "$1" gone
printf x | dd of="$2" bs=1 seek=1000 conv=notrunc status=none
points stopped now
part_of now all
[ "$(value now 's["progress"]["missing"]')" -ge 2 ] || fail "what two lost segments held is not missing"
expect 0 "$fracas" report stopped
said "segment $(basename "$1") is left out (.fracas verify. checks the study): .*is not there"
said "segment $(basename "$2") is left out .*damaged: it has .* bytes of checksum"
said ' missing: every number is of these alone'
expect 0 "$fracas" run small.yaml --study stopped --jobs 2
same whole stopped

# Extended and interrupted: not the old study.h5. Points keep their numbers, however they are counted now.
campaign more.yaml 20 '2e4 1/s, 3e4 1/s, 6e4 1/s, 1e5 1/s'
hold
start more.yaml --study stopped --jobs 1 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments stopped $(($(segments stopped) + 1))
kill_session
release
points stopped now
[ "$(value now 's["partial"]')" = True ] || fail "the old study.h5 is passed for the extended study"
[ "$(value now 'len(s["points"])')" -eq 4 ] || fail "the extended study has not its new point"
part_of all now
expect 5 "$fracas" picture stopped
said 'pictures come with the complete study: stopped/study.h5 is of another campaign than stopped/campaign.yaml'

# Without an index: study.h5 if it is of the campaign, else a remedy.
cp -r whole bare
rm bare/index.sqlite*
points bare now
cmp all now || fail "without an index study.h5 has other numbers"
[ "$(value now '"study.h5 is taken as it is" in s["warnings"][0]["text"]')" = True ] || fail "nothing is said of the lost index"
rm -f stopped/index.sqlite*
expect 5 "$fracas" report stopped
said 'fracas reindex.*stopped/study.h5 is of another campaign than stopped/campaign.yaml'
rm stopped/study.h5
expect 5 "$fracas" report stopped
said 'index.sqlite is not there; `fracas reindex`.*there is no stopped/study.h5'
