# ctest-labels: ci
# ctest-timeout: 600
# A realization computed again has the bytes of the study: finished or not, one round or several, strengths and meshes from files.
. tests/support/campaigns.sh
. "$source/tests/support/replayed.sh"

for name in bar-sequential bar-replay ring-variants plate-akantu membrane; do
    expect 0 "$fracas" run --no-report "$small/$name.yaml" --study "$name" --jobs 2
    replayed "$name" 2
done

# An unfinished study has them in its segments.
campaign part.yaml 6 '1e5 1/s'
expect 3 "$fracas" run --no-report part.yaml --study part --part 1/2 --jobs 1
done=$(sqlite3 part/index.sqlite "SELECT min(replica) FROM realization WHERE status = 'done'")
missing=$(sqlite3 part/index.sqlite "SELECT min(replica) FROM realization WHERE status != 'done'")
expect 0 "$fracas" replay part "0/$done"
expect 3 "$fracas" replay part "0/$missing"
said 'is not computed, or not yet'

# A study with one other bit is told apart, with the column's name.
expect 0 "$fracas" run --no-report part.yaml --study whole --jobs 2
expect 0 "$fracas" replay whole 0/1
/usr/bin/python3 - <<'PY'
import h5py, numpy
with h5py.File("whole/study.h5", "r+") as study:
    first = study["fragment/offset"][1]
    column = study["fragment/mass"]
    column[first] = numpy.nextafter(column[first], 1)
PY
expect 5 "$fracas" replay whole 0/1
said 'differs from the study: first in /fragment/mass, row 0 of the realization: stored .*, computed '
expect 0 "$fracas" replay whole 0/2

# Another program version's, and what is no realization.
/usr/bin/python3 - <<'PY'
import h5py
with h5py.File("whole/study.h5", "r+") as study:
    old = study.attrs["program_version"]
    study.attrs.modify("program_version", "0.0.1".ljust(len(old), "\0").encode()[:len(old)])
PY
expect 5 "$fracas" replay whole 0/2
said 'was computed by fracas 0.0.1'
said 'replay it with 0.0.1'
for bad in 0 0/ 0/x 1.0/0 0/-1 0/1/2 a/b 99999999999999999999/0; do
    expect 2 "$fracas" replay whole "$bad"
    said 'POINT/REPLICA is'
done
expect 2 "$fracas" replay whole 1/0
said 'there is no point 1'
expect 2 "$fracas" replay whole 0/6
said 'there is no replica 6 of point 0'
