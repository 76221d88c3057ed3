# ctest-labels: ci
# A realization that crashes, aborts, ends its process, hangs or takes all memory is FAILED, with the reason, and nothing else is: with
# a process for each lease and without. A fault that does not come back costs nothing at all.
. tests/support/campaigns.sh

campaign small.yaml 12 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2

# fault WHAT ISOLATION REASON OPTIONS...
fault()
{
    what=$1 isolation=$2 reason=$3
    shift 3
    export FRACAS_TEST_FAULT=$what:1:5
    expect 1 "$faulty" run --no-report small.yaml --study $what-$isolation --jobs 2 --isolation $isolation "$@"
    unset FRACAS_TEST_FAULT
    expect 0 "$fracas" status $what-$isolation
    said '^realizations *24: 23 done, 1 failed, 0 leased, 0 planned$'
    said "^  point 1 replica 5, 3 attempts: .*$reason"
    [ "$(sqlite3 $what-$isolation/index.sqlite "SELECT count(*) FROM realization WHERE reason LIKE '%${reason%%.*}%'")" -eq 1 ] ||
        fail "the index does not say '$reason' of one realization"
    same crash-lease $what-$isolation
}

# Sanitizers need a hint to leave the lack of memory to us.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}allocator_may_return_null=1"
for isolation in lease none; do
    fault crash $isolation 'its process died of signal 11 (Segmentation fault)'
    fault abort $isolation 'its process died of signal 6 (Aborted); it said: a test asked for this abort'
    fault exit $isolation 'its process ended after 0 of 1 records'
    fault memory $isolation '--memory-limit lets a lease allocate 256 MB: no memory for what a test asked for' --memory-limit 256
    fault hang $isolation 'its process was killed after the 1 s that a lease may take (--lease-limit)' \
        --lease-limit 1s --lanes 1 --lease-time 0
done

/usr/bin/python3 - <<'END'
import h5py, numpy
good, bad = h5py.File("undisturbed/study.h5"), h5py.File("crash-none/study.h5")
g, b = good["realization"], bad["realization"]
faulty = (b["point"][:] == 1) & (b["replica"][:] == 5)
assert faulty.sum() == 1 and (b["outcome"][:] == 5).tolist() == faulty.tolist()
for name in g:
    numpy.testing.assert_array_equal(g[name][:][~faulty], b[name][:][~faulty], name)
END

# events STUDY KIND
events()
{
    sqlite3 "$1/index.sqlite" "SELECT count(*) FROM event WHERE kind = '$2'"
}

# Gone on the second attempt.
for isolation in lease none; do
    export FRACAS_TEST_FAULT="crash:1:5:$work/happened-$isolation"
    expect 0 "$faulty" run --no-report small.yaml --study once-$isolation --jobs 2 --isolation $isolation
    [ -e happened-$isolation ] || fail "nothing happened"
    same undisturbed once-$isolation
done
unset FRACAS_TEST_FAULT
[ "$(events once-none 'server replaced')" -eq 1 ] || fail "a crash without isolation did not kill the server"
[ "$(events once-lease 'lease failed')" -ge 1 ] || fail "a crash of a lease was not noted"

# A model that cannot be built without a crash: its point is FAILED, the other one is not.
export FRACAS_TEST_FAULT=model:1:0
expect 1 "$faulty" run --no-report small.yaml --study model --jobs 2
unset FRACAS_TEST_FAULT
expect 0 "$fracas" status model
said '^realizations *24: 12 done, 12 failed, 0 leased, 0 planned$'
said '^  point 1 replica 11, 3 attempts: its process died of signal 11'

# Without a process for each lease nothing is written while a batch is computed: one that takes longer than a segment may get old is
# written when it ends, and not after the next one.
sed 's/elements: 500/elements: 1200/' small.yaml > long.yaml # some 20 ms a realization
expect 0 "$fracas" run --no-report long.yaml --study aged --jobs 1 --isolation none --lanes 1 --segment-age 0.001
[ "$(sqlite3 aged/index.sqlite "SELECT max(rows) FROM segment")" -eq 1 ] || fail "a batch waited in memory while the next was computed"
