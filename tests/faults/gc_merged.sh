# `gc --merged`, killed at calls that change a file: every realization stays in a segment, and all commands go on from there.
. tests/support/campaigns.sh

campaign small.yaml 3 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 1
expect 0 "$fracas" run --no-report small.yaml --study lost --jobs 1 --lanes 1 --lease-time 0 --segment-size 1e-6 # a segment a realization

library=$(dirname "$fracas")/tests/failing_calls.so
# killed STATUS K: the command on a copy, killed at the K-th such call; 0 only counts.
killed()
{
    rm -rf victim state
    cp -r lost victim
    : > state && truncate -s 1M state # a failing_state and more
    expect "$1" env FAILING_CALLS="disk parent $2 kill" FAILING_STATE=state FAILING_UNDER=victim FAILING_ALONE=1 LD_PRELOAD="$library" \
        "$fracas" gc victim --merged
}
killed 0 0
[ "$(ls victim/segments)" = "$(cd victim/segments && ls study-*.h5)" ] || fail "other segments are there: $(ls victim/segments)"
[ "$(stat -c %i victim/study.h5)" = "$(stat -c %i victim/segments/study-*.h5)" ] || fail "study.h5 is there twice"
calls=$(od -An -tu8 -N8 state | tr -d ' ')
[ "$calls" -ge 10 ] || fail "gc --merged changes no file"
for at in $(seq 1 $((calls / 5)) "$calls"); do
    killed 137 "$at"
    expect 0 "$fracas" verify victim
    rm -rf half
    cp -r victim half
    expect 0 "$fracas" run --no-report small.yaml --study victim
    said 'nothing to compute'
    expect 0 "$fracas" gc victim --merged
    expect 0 "$fracas" verify victim --full
    same undisturbed victim
done
[ "$(ls victim/segments | wc -l)" = 1 ] || fail "segments are left: $(ls victim/segments)"

# From there: a lost index and study.h5 are made again, and the study grows as one that kept its segments.
rm victim/index.sqlite* victim/study.h5
expect 0 "$fracas" reindex victim
expect 0 "$fracas" merge victim
same undisturbed victim
expect 0 "$fracas" gc victim --merged
for study in victim half undisturbed; do expect 0 "$fracas" extend $study --replicas 4; done
same undisturbed victim
same undisturbed half
expect 0 "$fracas" verify victim --full
expect 0 "$fracas" gc victim --merged
expect 0 "$fracas" verify victim --full
[ "$(ls victim/segments | wc -l)" = 1 ] || fail "segments are left: $(ls victim/segments)"

# A study.h5 that is damaged, of a failure or missing stands for nothing: all segments stay.
cp -r lost victim2
printf x | dd of=victim2/study.h5 bs=1 seek=9000 conv=notrunc 2> dd
expect 5 "$fracas" gc victim2 --merged
expect 0 "$fracas" verify lost
[ "$(ls victim2/segments)" = "$(ls lost/segments)" ] || fail "segments went without a sound study.h5"
rm victim2/study.h5
expect 3 "$fracas" gc victim2 --merged
[ "$(ls victim2/segments)" = "$(ls lost/segments)" ] || fail "segments went without study.h5"
expect 2 "$fracas" gc victim2 --merged --dry-run
