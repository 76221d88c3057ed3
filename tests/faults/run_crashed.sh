# A realization that crashes costs itself alone: status 1, one FAILED row, every other one as in an undisturbed run.
. tests/support/campaigns.sh

campaign small.yaml 12 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run small.yaml --study undisturbed --jobs 2
export FRACAS_TEST_CRASH=1:5
expect 1 "$fracas" run small.yaml --study crashed --jobs 2
said 'replica 5 of point 1 .* FAILED.*signal 11'
expect 1 "$fracas" run small.yaml --study alone --jobs 1 --lanes 1 --shuffle
same crashed alone
unset FRACAS_TEST_CRASH
before=$(stat -c %Y.%i crashed/study.h5)
expect 1 "$fracas" run small.yaml --study crashed # failed for good: nothing is computed again
[ "$before" = "$(stat -c %Y.%i crashed/study.h5)" ] || fail "study.h5 was written again"

/usr/bin/python3 - <<'END'
import h5py, numpy
good, bad = h5py.File("undisturbed/study.h5"), h5py.File("crashed/study.h5")
assert good.attrs["complete"] == 1 and bad.attrs["complete"] == 0
g, b = good["realization"], bad["realization"]
faulty = (b["point"][:] == 1) & (b["replica"][:] == 5)
assert faulty.sum() == 1 and (b["outcome"][:] == 5).tolist() == faulty.tolist()
assert numpy.isnan(b["kinetic"][:][faulty]).all()
for name in g:
    column, other = g[name][:], b[name][:]
    assert len(column) == len(other) == 24, name
    if name in ("point", "replica", "outcome", "fragments", "steps", "kinetic", "dissipated", "residual", "onset_time"):
        numpy.testing.assert_array_equal(column[~faulty], other[~faulty], name)
END

# Its server killed: the other one computes what was lost. A server is the child of a rank, which is the child of mpirun.
tries=0
while :; do
    start small.yaml --study lost --jobs 2 --lanes 1 --segment-size 1e-6
    wait_segments lost 2
    set -- $(cat /proc/[0-9]*/stat 2>/dev/null | awk -v session="$session" '
        {name[$1] = $2; parent[$1] = $4; of[$1] = $6}
        END {for (p in name) if (of[p] == session && name[p] == "(fracas)" && name[parent[parent[p]]] == "(mpirun)") print p}')
    [ $# -ne 2 ] || break
    kill_session # a busy machine kept this script waiting until the run was over, or caught it half: once more
    rm -rf lost
    tries=$((tries + 1))
    [ $tries -lt 20 ] || fail "there should be two servers, not: $*"
done
kill -9 "$1"
status=0
wait "$session" || status=$?
session=
[ $status -eq 0 ] || { cat background >&2; fail "status $status after a server died"; }
grep -q 'compute server of rank . died of signal 9' background || fail "it did not say that a server died"
same undisturbed lost
