# Ctrl-C drains: what runs is finished and kept, status 3, and the same command goes on. Meanwhile the study is
# locked. A second Ctrl-C stops at once.
. tests/support/campaigns.sh

# interrupted STUDY: the run in the background ends with status 3 and says how to resume.
interrupted()
{
    drain
    [ $status -eq 3 ] || { cat background >&2; fail "status $status instead of 3"; }
    grep -q 'same command goes on' background || fail "it did not say how to resume"
    [ ! -e "$1/study.h5" ] || fail "$1 is complete, though it was interrupted"
}

campaign small.yaml 20 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2
for signal in INT TERM; do
    hold
    start --no-report small.yaml --study drained --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    wait_segments drained $(($(segments drained) + 2))
    second=0
    "$fracas" run --no-report small.yaml --study drained > said 2>&1 || second=$?
    "$fracas" status drained > state
    kill -$signal "$session"
    interrupted drained
    grep -q '^draining' background || fail "it did not say that it drains"
    [ $second -eq 4 ] || { cat said >&2; fail "status $second of a second run"; }
    said 'pid [0-9]'
    grep -q 'being computed' state || { cat state >&2; fail "status does not know that it runs"; }
    "$fracas" status drained > state
    grep -q 'interrupted' state || { cat state >&2; fail "status does not know that it was interrupted"; }
done
expect 0 "$fracas" run --no-report small.yaml --study drained
same undisturbed drained

hold
start --no-report small.yaml --study stopped --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments stopped 2
kill -INT "$session"
kill -TERM "$session" 2>/dev/null || true
interrupted stopped
expect 0 "$fracas" run --no-report small.yaml --study stopped
same undisturbed stopped

# The starter gets it alone, and passes it on.
hold
start --no-report small.yaml --study passed --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments passed 2
kill -TERM "$(named fracas-starter)"
interrupted passed
expect 0 "$fracas" run --no-report small.yaml --study passed
same undisturbed passed

# Drained by the user's own mpirun.
hold
launch -n 2 "$faulty" run --no-report small.yaml --study direct --lanes 1 --lease-time 0 --segment-size 1e-6 > background 2>&1 &
session=$!
wait_segments direct 2
kill -USR1 "$session"
interrupted direct
expect 0 "$fracas" run --no-report small.yaml --study direct
same undisturbed direct
