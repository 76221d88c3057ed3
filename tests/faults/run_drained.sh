# Ctrl-C drains: what runs is finished and kept, status 3, and the same command goes on. Meanwhile the study is
# locked. A second Ctrl-C stops at once.
. tests/support/campaigns.sh

# interrupted: the status and last words of the run in the background.
interrupted()
{
    status=0
    wait "$session" || status=$?
    session=
    [ $status -eq 3 ] || { cat background >&2; fail "status $status instead of 3"; }
    grep -q 'same command goes on' background || fail "it did not say how to resume"
}

campaign small.yaml 20 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run small.yaml --study undisturbed --jobs 2
for signal in INT TERM; do
    start small.yaml --study drained --jobs 2 --lanes 1 --segment-size 1e-6
    wait_segments drained $(($(segments drained) + 2))
    expect 4 "$fracas" run small.yaml --study drained
    said 'pid [0-9]'
    kill -$signal "$session"
    interrupted
    grep -q '^draining' background || fail "it did not say that it drains"
    [ ! -e drained/study.h5 ] || fail "it was over before $signal"
done
expect 0 "$fracas" run small.yaml --study drained
same undisturbed drained

start small.yaml --study stopped --jobs 2 --lanes 1 --segment-size 1e-6
wait_segments stopped 2
kill -INT "$session"
kill -TERM "$session"
interrupted
[ ! -e stopped/study.h5 ] || fail "it was over before the signals"
expect 0 "$fracas" run small.yaml --study stopped
same undisturbed stopped

# Drained by the user's own mpirun.
launch -n 2 "$fracas" run small.yaml --study direct --lanes 1 --segment-size 1e-6 > background 2>&1 &
session=$!
wait_segments direct 2
kill -USR1 "$session"
interrupted
expect 0 "$fracas" run small.yaml --study direct
same undisturbed direct
