# ctest-labels: ci
# A realization that computes for long goes on from its checkpoint after kill -9, in another batch, to the same bytes; one that is
# damaged or cannot be written costs time alone. The states themselves: tests/support/lanes.h; the files: unit/checkpoint.
. tests/support/campaigns.sh

campaign long.yaml 5 '1e5 1/s'
sed -i -e 's/elements: 500/elements: 2000/' -e 's/time: .*/time: {stop: time, end: 1.2 us, safety: 0.25}/' long.yaml
expect 0 "$fracas" run --no-report long.yaml --study whole --jobs 1

# begin STUDY: a run with a checkpoint of each replica.
begin()
{
    hold
    start --no-report long.yaml --study "$1" --jobs 1 --checkpoint-time 0.01
    wait_checkpoints "$1" 5
}

# steps STUDY: of the checkpoint of replica 0.
steps()
{
    "$fracas" status "$1" --json | /usr/bin/python3 -c 'import json, sys; print(next(c["steps"] for c in json.load(sys.stdin)["checkpoints"] if c["replica"] == 0))'
}

# ended STUDY: complete, with the bytes of an undisturbed run and without a checkpoint.
ended()
{
    cmp whole/study.h5 "$1/study.h5" || fail "$1: another study.h5"
    [ ! -e "$1/checkpoints" ] || fail "$1: checkpoints are left: $(ls "$1/checkpoints")"
    expect 0 "$fracas" verify --full "$1"
}

# In batches of other lanes, by two ranks. The first checkpoints after the start are later than the last ones before.
begin study
kill_session
release
before=$(steps study)
[ "$before" -gt 0 ] || fail "no step is told"
"$fracas" status study | grep -q 'point 0 replica 4: comput' || fail "status does not tell of a checkpoint"
cp -r study damaged
hold
start --no-report long.yaml --study study --jobs 2 --lanes 1 --checkpoint-time 0
is_further() { [ "$(steps study 2>/dev/null || echo "$before")" -ne "$before" ]; }
await 'later checkpoint' is_further
kill_session
release
after=$(steps study 2>/dev/null || echo 1000000000)
[ "$after" -gt "$before" ] || fail "it began anew: at step $after after $before"
expect 0 "$fracas" run --no-report long.yaml --study study --jobs 2 --lanes 4
ended study

# What a power cut behind the merge left of a complete study goes with the next run.
mkdir study/checkpoints
cp "$(find damaged/checkpoints -name '*-0')" study/checkpoints
expect 0 "$fracas" run --no-report long.yaml --study study --jobs 1
ended study

# One is damaged, one half written, one of nobody.
one=$(find damaged/checkpoints -name '*-0')
printf '\377' | dd of="$one" bs=1 seek=30000 conv=notrunc 2>/dev/null
cp "$one" "damaged/checkpoints/.half.tmp-1"
cp "$one" "${one%-0}-1000"
expect 0 "$fracas" run --no-report long.yaml --study damaged --jobs 1 --isolation none
said 'no longer needed'
said 'the seal at its end is not of its bytes; it is removed, and its realization computed from the start'
ended damaged

# Something else in the place of the folder is named.
rm -rf study/study.h5 study/index.sqlite*
: > study/checkpoints
expect 6 "$fracas" run long.yaml --study study --jobs 1
said 'study/checkpoints'
rm study/checkpoints
expect 0 "$fracas" run --no-report long.yaml --study study --jobs 1
ended study
