# ctest-mpirun: ci
# Three times kill -9 of every process of a run (parent, starter, ranks, servers, children) at random times, each
# after the first and before the last segment; what is resumed to its end is what an undisturbed run gives.
. tests/support/campaigns.sh

campaign small.yaml 30 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2
left=0
kill=1
while [ $kill -le 3 ]; do # of 60 segments, one for each realization
    hold
    start --no-report small.yaml --study killed --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    wait_segments killed $((left + $(random 1 6)))
    sleep "0.0$(random 10 49)"
    running=$(processes | wc -l)
    kill_session
    left=$(segments killed)
    release
    [ "$left" -lt 60 ] && [ ! -e killed/study.h5 ] || fail "it was over before kill $kill"
    echo "kill $kill at $left segments of 60"
    [ "$left" -ge 1 ] || fail "killed before the first segment"
    [ "$running" -ge 6 ] || fail "parent, starter, 2 ranks and 2 servers should have run, not $running processes"
    kill=$((kill + 1))
done
expect 0 "$fracas" run --no-report small.yaml --study killed --jobs 1 --lease-time 0 --segment-size 1e-6
[ "$(segments killed)" -gt "$left" ] || fail "the resumed run had nothing to do"
same undisturbed killed

# The parent alone: the others must not outlive it.
hold
start --no-report small.yaml --study orphaned --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments orphaned 2
kill -9 "$session"
wait_gone 'the kill of the parent'
release
expect 0 "$fracas" run --no-report small.yaml --study orphaned
same undisturbed orphaned
