# The commands for studies, killed at a call that changes a file. Repeated, each ends well.
. tests/support/campaigns.sh

campaign small.yaml 6 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2
expect 0 "$fracas" run --no-report small.yaml --study lost --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6 # many segments

# The first such call, one in the middle, the last (tests/support/failing_calls.h).
library=$(dirname "$fracas")/tests/failing_calls.so
# killed STATUS K COMMAND: the command on a copy that has something to do for it, killed at the K-th call; 0 only counts.
killed()
{
    rm -rf victim state
    cp -r lost victim
    rm victim/study.h5
    echo half > victim/segments/.x.h5.tmp-1
    : > state && truncate -s 1M state # a failing_state and more
    expect "$1" env FAILING_CALLS="disk parent $2 kill" FAILING_STATE=state FAILING_UNDER=victim FAILING_ALONE=1 LD_PRELOAD="$library" \
        "$fracas" "$3" victim
}
for command in reindex gc merge; do
    killed 0 0 $command
    calls=$(od -An -tu8 -N8 state | tr -d ' ')
    [ "$calls" -ge 1 ] || fail "$command changes no file"
    for at in 1 $(((calls + 1) / 2)) "$calls"; do
        killed 137 "$at" $command
        expect 0 "$fracas" $command victim
        expect 0 "$fracas" merge victim
        same undisturbed victim
        expect 0 "$fracas" verify victim --full
    done
done
