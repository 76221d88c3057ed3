# bench_scheduler: its numbers, the files it leaves, and messages that cross.
. "$(dirname "$0")/../support/campaigns.sh"
bench=$(dirname "$fracas")/bench_scheduler

# number KEY: of the figures.
number()
{
    awk -F'[:,]' -v key="\"$1\"" '{gsub(/ /, "", $1)} $1 == key {print $2 + 0; exit}' figures
}

# holds EXPRESSION: of awk.
holds()
{
    awk "BEGIN {exit !($1)}" || { cat figures; fail "$1"; }
}

mkdir temporary
export TMPDIR="$work/temporary"
"$bench" --tasks 64 --task-time 0.02 --jobs 2 --lease-time 0 --json > figures 2> said || { cat said; fail "it does not run"; }
[ -z "$(ls temporary | grep fracas-bench)" ] || fail "it leaves its study behind"
holds "$(number tasks) == 64 && $(number workers) == 2"
# Eight batches of 8, on 2 workers: 0.64 s at least, which is all of the time that tasks take.
holds "$(number leases) >= 8 && $(number working) >= 0.64 && $(number wall) > $(number working)"
holds "$(number efficiency) > 0 && $(number efficiency) <= 1 && $(number working_efficiency) <= 1"
holds "$(number commits) >= 2 && $(number memory) > 1e6 && $(number memory) < 500e6"

# Which ones take long depends on their names: the same work, and a study that goes on.
for tasks in 200 400; do
    "$bench" --tasks $tasks --points 2 --long-share 0.05 --long-time 0.05 --jobs 2 --study kept --json > figures 2> said || { cat said; fail "it does not go on"; }
    holds "$(number tasks) == 200"
done
expect 0 "$fracas" status kept
said "400 done"
campaign small.yaml 2 '1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study theirs
expect 2 "$bench" --tasks 8 --study theirs
said 'theirs is the study of a campaign'
[ ! -e theirs/bench.yaml ] || fail "bench wrote into a campaign's study"
expect 2 "$bench" network
said "one argument too many"
expect 2 "$bench" --tasks 3 --points 2
expect 2 "$bench" --long-share 2

# Long leases to a rank that is sending a long segment: neither side may wait for the other.
expect 0 timeout -k 5 1000 "$bench" --tasks 80000 --segment-age 0.001 --jobs 3
