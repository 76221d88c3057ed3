# ctest-sanitize
# ctest-mpirun
# A campaign file that is edited while it runs: the run goes on with what it has read, also where its ranks are started again.
# Ranks of mpirun read the file; they go on with no other.
. tests/support/campaigns.sh

campaign small.yaml 40 '1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study plain
hold
start small.yaml --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6 # a segment a realization: the run is in its middle
wait_segments studies/small 1
sed -i 's/^name: small/name: other/; s/1e5/2e5/' small.yaml
kill -9 "$(ranks | head -n 1)"
finish
if [ $starter = mpirun ]; then
    [ "$status" -eq 2 ] || { cat background >&2; fail "status $status of ranks that find another campaign file"; }
    grep -q 'small.yaml was edited while the run computed it' background || { cat background >&2; fail "it is not said"; }
    campaign small.yaml 40 '1e5 1/s'
    expect 0 "$fracas" run small.yaml
    status=0
fi
[ "$status" -eq 0 ] || { cat background >&2; fail "status $status of a run whose campaign file is edited"; }
grep -q 'started again' background || { cat background >&2; fail "no rank was killed"; }
same plain studies/small
[ -e studies/small/report/index.html ] || fail "no report of the run"
[ ! -e studies/other ] || fail "the edited file has a study"
