# A run watched from another process: its map on a terminal, lines, JSON and Prometheus elsewhere. The numbers at the end are the report's.
. tests/support/campaigns.sh
check() { /usr/bin/python3 "$source/tests/support/check_watch.py" "$@" || fail "check_watch.py $1"; }

campaign small.yaml 8 '6e4 1/s, 1e5 1/s'
export FRACAS_TEST_PAUSE=0.3 FRACAS_TEST_FAULT=crash:1:5
hold
start small.yaml --study live --jobs 2 --lanes 1 --lease-time 0 --segment-age 0.3
unset FRACAS_TEST_PAUSE FRACAS_TEST_FAULT
wait_segments live 1

# Ctrl-C in the middle, and three watchers to the end.
"$fracas" status live --watch --interval 0.2s > lines 2> lines.err &
lines=$!
"$fracas" report live --live --interval 0.5s > pages 2>&1 &
pages=$!
check terminal "$fracas" status live --watch --interval 0.2s
until grep -q realizations pages; do sleep 0.01; done
grep -q 'partial: .*; this page loads itself again every 1 s' live/report/index.html || fail "the page does not say so"
grep -q '<meta http-equiv="refresh" content="1"/>' live/report/index.html || fail "the page does not load itself again"
release
check prometheus live.prom "$fracas" status live --watch --interval 0.2s --json --prometheus live.prom > looks
for watcher in $lines $pages; do
    status=0
    wait $watcher || status=$?
    [ $status -eq 1 ] || { cat lines lines.err pages >&2; fail "a watcher ended with $status"; }
done
kill_session
grep -q '^fracas: live/report/index.html: [0-9]* of 16 realizations done' pages || fail "no page on the way"
! grep -q 'http-equiv="refresh"' live/report/index.html || fail "the last page loads itself again"
"$fracas" report live --json > report.json
check numbers looks report.json live.prom
grep -q '^20.*Z [0-9]* of 16 realizations done, .*; mean count to .* % or better at [12] of 2 points' lines || fail "no line of the run"
tail -1 lines | grep -q ' 15 of 16 realizations done, 1 failed.*computed, some realizations FAILED' || fail "the last line"
grep -q '1 realization of live FAILED: .fracas status live' lines.err || fail "the end is not told"
[ "$(wc -l < lines)" -ge 3 ] || fail "too few lines"
! LC_ALL=C grep -q "$(printf '\033')" lines || fail "colours in a file"

expect 0 "$fracas" status live --verbose
said '^  20.*Z  started  *16 of 16 realizations of 2 points to do, 2 workers$'
said '^  20.*Z  finished '

# On a terminal: one frame of a study that is computed, in colours unless somebody refuses them, and none on a dumb one.
check colours "$fracas" status live --watch
for command in 'report live' 'plan small.yaml'; do
    # shellcheck disable=SC2086 # words
    check narrow "$fracas" $command
done
campaign done.yaml 4 '1e5 1/s'
expect 0 "$fracas" run done.yaml --study done --quiet
[ ! -s said ] || { cat said >&2; fail "--quiet speaks"; }
[ -s done/report/index.html ] || fail "--quiet leaves no report"
expect 0 "$fracas" run done.yaml --study done --quiet
[ ! -s said ] || { cat said >&2; fail "--quiet speaks of a complete study"; }
sed 's/100 J/1000 J/; s/end: 300 ns/end: 60 ns/' done.yaml > held.yaml
check warned "$fracas" run held.yaml --no-report --jobs 1
expect 0 "$fracas" run done.yaml --study bare --no-report
[ ! -e bare/report ] || fail "--no-report leaves a report"
same done bare
expect 0 "$fracas" report bare
cmp done/report/points.csv bare/report/points.csv || fail "a report that is made later differs"
expect 0 "$fracas" status done --watch --prometheus done.prom
said ' 4 of 4 realizations done, 0 failed; .*; complete'
grep -q '^fracas_complete{study="done"} 1$' done.prom || fail "it is not complete"

# Nobody computes it any more.
hold
start small.yaml --study dead --jobs 1 --lanes 1 --lease-time 0
has_begun() { [ -s dead/lock ] && "$fracas" status dead > said 2>&1; }
await 'study that is computed' has_begun
kill_session
release
expect 3 "$fracas" status dead --watch --interval 0.05s
said 'no run computes dead any more; interrupted: .fracas run dead/campaign.yaml'

expect 2 "$fracas" report live --interval 1s
said 'report: --interval is for --live'
expect 2 "$fracas" status live --interval 1s
said 'status: --interval is for --watch'
expect 2 "$fracas" status live --watch --interval 1
said 'interval is .1.; it must be a time above 0 with its unit'
expect 6 "$fracas" status live --prometheus nowhere/x.prom
said 'cannot write nowhere'
