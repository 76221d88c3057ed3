# The simulation of a cluster (bench_cluster) against runs of 1 to 16 workers that sleep, from the first lease to the last worker's end.
# Work of 10 s a worker: leases of 1 s, some of which end when others have just begun, are a tenth of that, and how the last ones fall is
# chance; 5 % is half of it. Best of three tries: a machine that is busy with something else makes runs longer, never shorter.
# ctest-labels: storm
# ctest-serial
# ctest-timeout: 1800
. "$(dirname "$0")/../support/campaigns.sh"
simulated=$(dirname "$fracas")/bench_cluster bench=$(dirname "$fracas")/bench_scheduler

# check WORKERS TASKS OPTIONS... -- SETTINGS...
check()
{
    workers=$1
    tasks=$2
    shift 2
    options=
    while [ "$1" != -- ]; do options="$options $1"; shift; done
    shift
    expected=$("$simulated" workers=$workers "$@" | awk -v n=$workers '$1 == n {print $2}')
    for try in 1 2 3; do
        # shellcheck disable=SC2086 # options are words
        "$bench" --jobs $workers --tasks $tasks $options --json > figures 2> said || { cat said; fail "bench"; }
        took=$(awk -F'[:,]' '$1 ~ /"working"/ {print $2 + 0}' figures)
        echo "$workers workers,$options: $took s, simulated $expected s"
        ! awk -v a="$took" -v b="$expected" 'BEGIN {exit !(a > 0.95 * b && a < 1.05 * b)}' || return 0
    done
    fail "$workers workers took $took s, not within 5 % of the $expected s that are simulated"
}

for workers in 1 2 4 8 16; do
    check $workers $((500 * workers)) --task-time 0.02 -- work=10 task=0.02
done
# One in a hundred takes a hundred times as long: 1.99 times the work.
for workers in 2 8; do
    check $workers $((1000 * workers)) --task-time 0.005 --long-share 0.01 --long-time 0.5 -- work=9.95 task=0.005 share=0.01 longer=0.5
done
