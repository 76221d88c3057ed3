# ctest-sanitize
# A realization that crashes costs itself alone: status 1, one FAILED row, every other one as in an undisturbed run.
. tests/support/campaigns.sh

campaign small.yaml 12 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2
export FRACAS_TEST_FAULT=crash:1:5
expect 1 "$faulty" run --no-report small.yaml --study crashed --jobs 2
said 'replica 5 of point 1 .* FAILED.*signal 11'
expect 1 "$faulty" run --no-report small.yaml --study alone --jobs 1 --lanes 1 --shuffle
same crashed alone
unset FRACAS_TEST_FAULT
before=$(stat -c %Y.%i crashed/study.h5)
expect 1 "$fracas" run --no-report small.yaml --study crashed # failed for good: nothing is computed again
# The same told by a rank of the user's own launcher.
expect 1 env OMPI_COMM_WORLD_RANK=0 OMPI_MCA_ess_singleton_isolated=1 "$fracas" run --no-report small.yaml --study crashed --walltime 1h
said 'FAILED: .*which and why: fracas status crashed'
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
