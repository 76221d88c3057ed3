# A study of 1 million realizations that take no time, stopped when half of them are done: status answers within 1 s, going on takes less
# than 5 s until leases can be given out, rank 0 has less than 500 MB. A bound on time holds if one of a few tries keeps it: the
# machine may be busy with something else.
# ctest-labels: storm
# ctest-serial
# ctest-timeout: 1800
. "$(dirname "$0")/../support/campaigns.sh"
bench=$(dirname "$fracas")/bench_scheduler

all=1000000

# number KEY FILE: the first number under a key of JSON.
number()
{
    awk -F'[:,]' -v key="\"$1\"" '{gsub(/ /, "", $1)} $1 == key {print $2 + 0; exit}' "$2"
}

# within VALUE BOUND WHAT
within()
{
    echo "$3: $1 (at most $2)"
    awk -v value="$1" -v bound="$2" 'BEGIN {exit !(value > 0 && value <= bound)}' || fail "$3: $1, more than $2"
}

# Best of up to 20 tries, s.
status_time()
{
    best=1000000000
    for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
        from=$(date +%s%N)
        expect 0 "$fracas" status study
        took=$((($(date +%s%N) - from) / 1000))
        [ $took -gt $best ] || best=$took
        [ $best -gt 1000000 ] || break
    done
    awk -v us=$best 'BEGIN {print us / 1e6}'
}

# stop_half: starts the study anew and stops it when half of it is done.
stop_half()
{
    rm -rf study
    setsid "$bench" --tasks $all --points 100 --jobs 2 --study study > background 2>&1 &
    session=$!
    tries=0
    half=0
    while [ "${half:-0}" -lt $((all / 2)) ]; do
        tries=$((tries + 1))
        [ $tries -lt 3000 ] || { cat background; fail "half of the study is not done after ten minutes"; }
        sleep 0.1
        "$fracas" status study --json > progress 2>/dev/null || continue
        half=$(number done progress)
    done
    kill -TERM $session
    status=0
    wait $session || status=$?
    session=
    [ $status -eq 3 ] || { cat background; fail "the run ended with status $status instead of 3"; }
}

resume=1000000
for i in 1 2 3; do
    stop_half
    half=$(number done progress)
    [ "$half" -lt $all ] || fail "it was over before it could be stopped"
    [ $i -gt 1 ] || within "$(status_time)" 1 "status of a study half done [s]"
    "$bench" --tasks $all --points 100 --jobs 2 --study study --json > figures 2> said || { cat said; fail "going on"; }
    # `planned` is rank 0's; `around` has the start of the ranks, and their end.
    resume=$(awk -v a="$(number planned figures)" -v b="$(number around figures)" -v least=$resume 'BEGIN {print a + b < least ? a + b : least}')
    within "$(number memory figures)" 500e6 "memory of rank 0 [bytes]"
    expect 0 "$fracas" status study --json
    [ "$(number done said)" -eq $all ] || fail "not all realizations are done"
    awk -v value="$resume" 'BEGIN {exit !(value > 5)}' || break
done
within "$resume" 5 "until leases can be given out, on a study half done [s]"
within "$(status_time)" 1 "status of a complete study [s]"
