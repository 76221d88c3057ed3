# ctest-sanitize
# Fields that a campaign file asks for: a run writes those of the realizations that it names, with the bytes of a replay, and nothing else.
. tests/support/campaigns.sh

# wanted FILE FIELDS
wanted()
{
    campaign "$1" 5 '6e4 1/s, 1e5 1/s'
    echo "fields: $2" >> "$1"
}

campaign plain.yaml 5 '6e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report plain.yaml --study plain --jobs 1
[ ! -e plain/fields ] || fail "fields were written for nothing"

wanted extreme.yaml '{realizations: extreme, every: 100 ns}'
expect 0 "$fracas" run --no-report extreme.yaml --study extreme --jobs 2
cp said ran
same plain extreme
/usr/bin/python3 - <<'END' > names || fail "other realizations were chosen"
import os
import h5py

study = h5py.File("extreme/study.h5")["realization"]
point, replica, count = (study[name][()] for name in ("point", "replica", "fragments"))
names = set()
for p in 0, 1:
    of = sorted((n, r) for q, r, n in zip(point, replica, count) if q == p)
    assert of[0][0] < of[-1][0], of
    names |= {f"{p}-{of[0][1]}", f"{p}-{of[-1][1]}"}
assert names == set(os.listdir("extreme/fields")), (names, os.listdir("extreme/fields"))
print(*sorted(names))
END
for name in $(cat names); do
    grep -q "^extreme/fields/$name: fields of replica ${name#*-} of point ${name%-*}\$" ran || fail "the run says nothing of $name"
    expect 0 "$fracas" replay plain "${name%-*}/${name#*-}" --fields "again-$name" --every 100ns
    diff -r -x fields.txt -x note "again-$name" "extreme/fields/$name" || fail "$name: other fields than those of a replay"
done

# What the plan says of them: an upper bound, since realizations here end before time.end, of four folders; files beside the grids are small.
expect 0 "$fracas" plan extreme.yaml
said '^Fields of 4 realizations add up to [0-9.]* MB beside them\.$'
expect 0 "$fracas" plan extreme.yaml --json
/usr/bin/python3 - <<'END' || fail "the plan's size of fields"
import glob, json, os

planned = json.load(open("said"))["bytes_fields"]
instants = len(glob.glob("extreme/fields/*/body-*.hdf"))
written = sum(map(os.path.getsize, glob.glob("extreme/fields/*/*.hdf")))
assert 0.9 < planned / (4 * 4) / (written / instants) < 1.02, (planned, instants, written)  # 0, 100, 200, 300 ns
END
expect 0 "$fracas" plan plain.yaml
! grep -q Fields said || fail "fields are planned for nothing"

# All instants in one file have no date, either.
for k in 1 2; do
    expect 0 "$fracas" replay plain 0/0 --fields whole-$k --one-file
    sleep 1 # HDF5 counts seconds
done
diff -r whole-1 whole-2 || fail "the same fields have other bytes a second later"

# What is there stays, half a folder of a run that was killed goes.
set -- $(cat names)
echo mine > "extreme/fields/$1/note"
mv "extreme/fields/$2" "extreme/fields/$2.part"
rm "extreme/fields/$2.part/body-1.hdf"
expect 0 "$fracas" run --no-report extreme.yaml --study extreme
said 'complete, nothing to compute'
said "^extreme/fields/$2: fields"
! grep -q "^extreme/fields/$1" said || fail "$1 was written again"
grep -q mine "extreme/fields/$1/note" || fail "$1 was removed"
diff -r -x fields.txt -x note "again-$2" "extreme/fields/$2" || fail "$2: other fields after an interruption"
[ "$(ls extreme/fields | wc -l)" = 4 ] || fail "a part is left"

# Ordered by another number: the folders of the former choice go.
wanted extreme.yaml '{realizations: extreme, by: dissipated}'
expect 0 "$fracas" run --no-report extreme.yaml --study extreme
/usr/bin/python3 - <<'END' || fail "other realizations than those of the least and the greatest dissipated energy"
import os
import h5py

study = h5py.File("extreme/study.h5")["realization"]
point, replica, energy = (study[name][()] for name in ("point", "replica", "dissipated"))
names = set()
for p in 0, 1:
    of = sorted((e, r) for q, r, e in zip(point, replica, energy) if q == p)
    names |= {f"{p}-{of[0][1]}", f"{p}-{of[-1][1]}"}
assert names == set(os.listdir("extreme/fields")), (names, os.listdir("extreme/fields"))
END

# Other instants, and a point with another number: no folder stays under the name of another.
wanted extreme.yaml '{realizations: extreme}'
expect 0 "$fracas" run --no-report extreme.yaml --study extreme
[ "$(ls "extreme/fields/$1" | grep -c '^body-[0-9]*.hdf$')" = 3 ] || fail "fields of other instants stay"
sed -i 's/\[6e4 1.s, 1e5 1.s\]/[2e5 1\/s, 6e4 1\/s, 1e5 1\/s]/' extreme.yaml
expect 0 "$fracas" run --no-report extreme.yaml --study extreme
for folder in extreme/fields/*; do
    name=${folder#extreme/fields/}
    rm -rf again
    expect 0 "$fracas" replay extreme "${name%-*}/${name#*-}" --fields again
    diff -r -x fields.txt again "$folder" || fail "$folder has fields of another realization"
done
[ "$(ls extreme/fields | cut -d- -f1 | sort -u | tr -d '\n')" = 012 ] || fail "not every point: $(ls extreme/fields)"

# A FAILED replica has no fields; instants are the onset, the peak and the end.
wanted first.yaml '{realizations: listed, replicas: [2, 1, 0]}'
status=0
FRACAS_TEST_FAULT=crash:0:0 "$faulty" run --no-report first.yaml --study first --jobs 1 > out 2> said || status=$?
[ $status -eq 1 ] || { cat said >&2; fail "status $status where a realization FAILED"; }
[ "$(echo $(ls first/fields))" = '0-1 0-2 1-0 1-1 1-2' ] || fail "chosen: $(ls first/fields)"
[ "$(ls first/fields/0-1 | grep -c '^body-[0-9]*.hdf$')" = 3 ] || fail "not three instants"

# Two at once: one writes, the other says who does.
rm -r extreme/fields
wanted slow.yaml '{realizations: listed, replicas: [0], every: 1 ns}'
sed -i 's/\[6e4 1.s, 1e5 1.s\]/[2e5 1\/s, 6e4 1\/s, 1e5 1\/s]/' slow.yaml
"$fracas" run --no-report slow.yaml --study extreme > first.out 2>&1 &
one=$!
for polls in $(seq 500); do [ ! -d extreme/fields/0-0.part ] || break; sleep 0.01; done
expect 4 "$fracas" run slow.yaml --study extreme
wait $one || { cat first.out >&2; fail "the first was disturbed"; }
for folder in extreme/fields/*; do
    /usr/bin/python3 -c 'import json, os, sys; assert {f["name"] for f in json.load(open(sys.argv[1] + "/body.hdf.series"))["files"]} <= set(os.listdir(sys.argv[1]))' "$folder" || fail "$folder is torn"
done

# A part of a study has no median of all.
wanted median.yaml '{realizations: median}'
expect 3 "$fracas" run --no-report median.yaml --study half --part 1/2
[ ! -e half/fields ] || fail "fields of half a study"

wanted wrong.yaml '{realizations: medium}'
expect 2 "$fracas" plan wrong.yaml
said 'wrong.yaml:15:24: unknown realizations `medium`; did you mean `median`'
wanted wrong.yaml '{realizations: median, replicas: [2]}'
expect 2 "$fracas" plan wrong.yaml
said '`replicas` belongs to realizations listed'
wanted wrong.yaml '{realizations: listed, replicas: 2}'
expect 2 "$fracas" plan wrong.yaml
said '`replicas`.*a list of whole numbers, as \[0, 7\]'
wanted wrong.yaml '{realizations: listed, replicas: [0, 99]}'
expect 2 "$fracas" plan wrong.yaml
said '`replicas` of `fields`: no point has a replica 99'
wanted wrong.yaml '{realizations: listed}'
expect 2 "$fracas" plan wrong.yaml
said 'needs `replicas`.*a list of whole numbers'
wanted wrong.yaml '{realizations: median, every: 1e-15 s}'
expect 2 "$fracas" run wrong.yaml --study wrong
said 'wrong.yaml:15:[0-9]*: every 1e-15 s are 3e+08 instants until time.end, .*; at most 10000'
[ ! -e wrong ] || fail "a study was made for a wrong file"
wanted wrong.yaml '{every: 10 ns}'
expect 2 "$fracas" plan wrong.yaml
said 'add realizations: median'
