# ctest-sanitize
# What is not run: a study that is complete, of another campaign, or that cannot be written; a wrong campaign.
. tests/support/campaigns.sh

campaign small.yaml 4 '1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study done
before=$(stat -c %y.%i done/study.h5)
expect 0 "$fracas" run --no-report small.yaml --study done
said 'complete'
[ "$before" = "$(stat -c %y.%i done/study.h5)" ] || fail "study.h5 of a complete study was written again"

campaign other.yaml 4 '2e5 1/s'
expect 5 "$fracas" run other.yaml --study done
said 'loading.rate'
campaign two.yaml 1 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report two.yaml --study two
campaign two.yaml 1 '5e4 1/s, 1e5 1/s'
expect 5 "$fracas" run two.yaml --study two
said 'loading.rate is 30000 1/s in the study (its point 0), but 50000 1/s in this campaign file'
campaign other.yaml 3 '1e5 1/s'
expect 5 "$fracas" run other.yaml --study done
said 'replicas'
[ "$before" = "$(stat -c %y.%i done/study.h5)" ] || fail "a refused campaign changed study.h5"

sed 's/elements: 500/elements: -1/' small.yaml > wrong.yaml
expect 2 "$fracas" run wrong.yaml --study wrong
[ ! -e wrong ] || fail "a wrong campaign left something behind"
expect 2 "$fracas" run absent.yaml --study wrong
said 'there is no campaign file absent.yaml'

# The study's own campaign file, edited: refused before the index knows of it, so that what is put back goes on.
cp -r done edited
sed -i 's/rate: 100000 /rate: 123456 /' edited/campaign.yaml
! cmp -s done/campaign.yaml edited/campaign.yaml || fail "this test edits nothing"
expect 5 "$fracas" run edited/campaign.yaml --study edited
said '1 of its 1 points are not in the campaign; if campaign.yaml of the study was edited put it back'
cp done/campaign.yaml edited/campaign.yaml
expect 0 "$fracas" run --no-report small.yaml --study edited
said 'nothing to compute'

: > file
expect 6 "$fracas" run small.yaml --study file/study
said 'file'
expect 6 env PATH=/nowhere FRACAS_MPIRUN=1 "$fracas" run small.yaml --study no-mpirun
said 'openmpi-bin'
expect 0 env PATH=/nowhere "$fracas" run --no-report small.yaml --study no-mpirun # one machine needs none
same done no-mpirun

# study.h5 lost after the end: it is merged again, nothing is computed.
cp done/study.h5 kept.h5
rm done/study.h5
expect 0 "$fracas" run --no-report small.yaml --study done
cmp kept.h5 done/study.h5 || fail "merged again, it differs"

expect 2 "$fracas" run small.yaml --study ''
said 'study is empty'
expect 2 "$fracas" run small.yaml --study file
said 'is not a folder'

expect 2 "$fracas" run small.yaml --study many --jobs 100000
said 'jobs 100000'

# What goes wrong while the study is prepared is told, and nothing else goes wrong with it.
rm done/study.h5
mkdir done/segments/folder.h5
expect 6 "$fracas" run small.yaml --study done
said 'folder.h5'
! grep -q 'started again' said || { cat said >&2; fail "rank 0 died instead of telling"; }
rmdir done/segments/folder.h5
expect 0 "$fracas" run --no-report small.yaml --study done
cmp kept.h5 done/study.h5 || fail "merged again, it differs"

# A study of another format version is refused by that name. Its segments are left where they are though the index is lost.
cp -r done aged
for aged in aged/study.h5 aged/segments/*.h5; do
    /usr/bin/python3 -c 'import h5py, sys; h5py.File(sys.argv[1], "r+").attrs.modify("format_version", 1)' "$aged"
done
expect 5 "$fracas" report aged
said 'study.h5 has format version 1; this program reads \(3 to \)\{0,1\}6: use the program version that wrote it'
ls aged/segments/*.h5 > theirs
rm aged/index.sqlite*
expect 0 "$fracas" run --no-report small.yaml --study aged
said 'left aged/segments/.* which has format version 1, not 6; move it away'
cmp kept.h5 aged/study.h5 || fail "computed again beside segments of another format version, it differs"
while read -r segment; do
    [ -e "$segment" ] || fail "$segment is gone"
done < theirs
sqlite3 aged/index.sqlite "UPDATE meta SET value = '1' WHERE key = 'format_version'"
expect 5 "$fracas" run small.yaml --study aged
said 'format version 1; this program reads \(3 to \)\{0,1\}6: use the program version that wrote it'

# MPI that never comes up: one signal is enough.
mkdir bin
printf '#!/bin/sh\n: > "%s/mpirun-began"\nexec sleep 1000\n' "$PWD" > bin/mpirun
chmod +x bin/mpirun
FRACAS_MPIRUN=1 PATH=$PWD/bin:$PATH "$fracas" run --no-report small.yaml --study silent > said 2>&1 &
run=$!
await 'start of mpirun' [ -e mpirun-began ]
kill -TERM $run
status=0
wait $run || status=$?
[ $status -eq 3 ] || { cat said >&2; fail "status $status of a run that was stopped before MPI came up"; }

# The study's own campaign file: of another campaign, damaged.
expect 0 "$fracas" verify --full done
sed 's/fracture_energy: 100/fracture_energy: 101/' done/campaign.yaml > other.yaml
cp done/campaign.yaml kept.yaml
cp other.yaml done/campaign.yaml
expect 5 "$fracas" verify done
said '1 of its 1 points are not in the campaign'
expect 5 "$fracas" run small.yaml --study done
said 'done/campaign.yaml is not the campaign of done/index.sqlite: .* remove it and run again'
rm done/campaign.yaml
expect 0 "$fracas" run --no-report small.yaml --study done
cmp kept.yaml done/campaign.yaml || fail "campaign.yaml is not as it was"
sed 's/law: nitsche/law: of-tomorrow/' kept.yaml > done/campaign.yaml
for command in 'run small.yaml --study done' 'verify done' 'report done'; do
    # shellcheck disable=SC2086 # words
    expect 5 "$fracas" $command
    said 'unknown law `of-tomorrow`'
    said 'another version of fracas'
done
cp other.yaml done/campaign.yaml
echo 'x: [' >> done/campaign.yaml
expect 5 "$fracas" verify done
said "study's campaign file is damaged"
expect 5 "$fracas" status done
cp kept.yaml done/campaign.yaml
expect 0 "$fracas" verify --full done

# A complete study that lost a segment, and one whose index was cut off at its birth, are made whole by the same command.
cp done/study.h5 kept.h5
rm "$(ls done/segments/*.h5 | head -n 1)"
expect 5 "$fracas" verify done
expect 0 "$fracas" run --no-report small.yaml --study done
cmp kept.h5 done/study.h5 || fail "computed again, it differs"
expect 0 "$fracas" verify --full done
mkdir -p begun/segments
cp done/campaign.yaml begun
: > begun/index.sqlite
expect 0 "$fracas" run --no-report small.yaml --study begun
cmp kept.h5 begun/study.h5 || fail "begun again, it differs"

# Segments of the same points with other output: not taken over.
sed 's/history: 20/history: 40/' small.yaml > longer.yaml
expect 0 "$fracas" run --no-report longer.yaml --study longer
rm -r longer/index.sqlite* longer/study.h5 longer/segments
cp -r done/segments longer/segments
expect 0 "$fracas" run --no-report longer.yaml --study longer
expect 0 "$fracas" run --no-report longer.yaml --study fresh
same longer fresh
rm done/campaign.yaml
expect 5 "$fracas" run longer.yaml --study done
said 'history'
