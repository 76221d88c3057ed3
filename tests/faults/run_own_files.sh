# ctest-labels: ci
# Nothing of a user's is lost: a study is not made in a folder that has files of the user's own where a study has its own, no
# campaign.yaml with changes by hand is written over, and no output is written over an input or another's file.
. tests/support/campaigns.sh

campaign small.yaml 2 '1e5 1/s'
sed 's/^name: small/# lab book, page 41\nname: small\nparallel: {parts: 1}/' small.yaml > own.yaml

content() { (cd "$1" && find . ! -name 'index.sqlite-*' -printf '%p %i %y %l\n' | sort && find . -type f ! -name 'index.sqlite-*' -exec sha256sum {} + | sort); }

# refused COMMAND...: status 2, and the folder `case` is as it was.
refused()
{
    before=$(content case)
    expect 2 "$@"
    [ "$before" = "$(content case)" ] || { content case; fail "it was $before: $*"; }
}

# ---- a folder with the campaign in it ----

mkdir case
cp own.yaml case/campaign.yaml
refused "$fracas" run case/campaign.yaml --study case --jobs 1
said '^fracas: case/campaign.yaml is there already, and no run of fracas wrote it: choose another folder'
(cd case && expect 2 "$fracas" run campaign.yaml --study . && said '^fracas: ./campaign.yaml is there already' && rm said)
refused "$fracas" run small.yaml --study case --jobs 1
refused "$fracas" submit case/campaign.yaml --study case --time 1h
chmod a-w case/campaign.yaml
refused "$fracas" run case/campaign.yaml --study case --jobs 1
rm -f case/campaign.yaml
ln -s ../own.yaml case/campaign.yaml
refused "$fracas" run case/campaign.yaml --study case --jobs 1
rm case/campaign.yaml
ln -s ../nowhere.yaml case/campaign.yaml
refused "$fracas" run own.yaml --study case --jobs 1
rm case/campaign.yaml
echo 'x: [' > case/campaign.yaml
refused "$fracas" run own.yaml --study case --jobs 1
rm case/campaign.yaml

# Other names of a study's files.
for name in study.h5 index.sqlite lock report/index.html segments/plan.txt fields/notes checkpoints/x campaign.yaml.tmp; do
    rm -rf case
    mkdir -p "case/$(dirname $name)"
    echo mine > case/$name
    refused "$fracas" run small.yaml --study case --jobs 1
    said "case/${name%%/*} is there already, and no run of fracas wrote it"
done
rm -rf case
mkdir case
sqlite3 case/index.sqlite 'CREATE TABLE mine (x)'
refused "$fracas" run small.yaml --study case --jobs 1
said 'index.sqlite'

# ---- what a run has made goes on, wherever it was killed ----

expect 0 "$fracas" run small.yaml --study one --jobs 1
# begun NAME: the folder `case` of a run that was killed, named by what it has.
begun()
{
    expect 0 "$fracas" run small.yaml --study case --jobs 1
    same one case
    rm -rf case
    mkdir case
}
rm -rf case
mkdir case
begun 'a folder'
mkdir case/segments
: > case/lock
begun 'segments'
mkdir case/segments
echo 'host=h pid=1 since=x start=1 boot=b job=- restart=0' > case/lock
expect 4 "$fracas" run small.yaml --study case --jobs 1
echo half > case/index.sqlite # which a run is making
expect 4 "$fracas" run small.yaml --study case --jobs 1
rm case/index.sqlite
: > case/lock
: > case/index.sqlite && begun 'an index of no bytes'
mkdir case/segments && sqlite3 case/index.sqlite 'PRAGMA journal_mode = WAL; PRAGMA user_version = 0; VACUUM' > /dev/null
begun 'an index of no tables'
mkdir case/segments && cp one/index.sqlite case && sqlite3 case/index.sqlite 'DELETE FROM realization; DELETE FROM segment' && begun 'an index'
mkdir case/segments && head -c 200 one/campaign.yaml > case/campaign.yaml.tmp && begun 'a half-written campaign.yaml'
mkdir case/segments && cp one/campaign.yaml case && begun 'a campaign.yaml'
cp -r one/segments case && begun 'segments alone'

# ---- campaign.yaml of a study ----

inode() { stat -c %i one/campaign.yaml; }
before=$(inode)
rm one/study.h5
expect 0 "$fracas" run one/campaign.yaml --study one --jobs 1
[ "$before" = "$(inode)" ] || fail "campaign.yaml, the same, is written again"
echo 'parallel: {parts: 1} # on my machine' >> one/campaign.yaml
cp one/campaign.yaml edited.yaml
rm one/study.h5
expect 0 "$fracas" run one/campaign.yaml --study one --jobs 1
cmp edited.yaml one/campaign.yaml || fail "a change by hand is lost"
expect 0 "$fracas" extend one --replicas 3 --jobs 1
said 'one/campaign.yaml had changes by hand; it is one/campaign.yaml.before-'
cmp edited.yaml one/campaign.yaml.before-* || fail "a change by hand is lost when the study grows"
cp one/campaign.yaml kept.yaml
chmod a-w one/campaign.yaml
expect 2 "$fracas" extend one --replicas 4 --jobs 1
said 'one/campaign.yaml is write-protected'
chmod u+w one/campaign.yaml
mv one/campaign.yaml elsewhere.yaml
ln -s ../elsewhere.yaml one/campaign.yaml
expect 2 "$fracas" extend one --replicas 4 --jobs 1
said 'one/campaign.yaml is no file but a link'
cmp kept.yaml elsewhere.yaml
rm one/campaign.yaml
cp kept.yaml one/campaign.yaml
expect 0 "$fracas" run one/campaign.yaml --study one --jobs 1

# ---- outputs ----

rm -rf case
cp -r one case
cp own.yaml case/q.yaml
cd case
ln q.yaml hard.csv
ln -s q.yaml soft.csv
echo 'my notes' > notes.txt
cd ..
for name in q.yaml hard.csv soft.csv notes.txt study.h5; do
    refused "$fracas" sample case/q.yaml --csv case/$name
    refused "$fracas" sample case/q.yaml --vtk case/$name
done
said 'name another file'
for name in q.yaml hard.csv soft.csv notes.txt; do refused "$fracas" status case --prometheus case/$name; done
refused "$fracas" submit case/q.yaml --time 1h --script case/hard.csv
refused "$fracas" submit case/q.yaml --time 1h --output case/hard.csv
expect 0 "$fracas" sample case/q.yaml --csv strengths.csv --vtk strengths.vtk
expect 0 "$fracas" sample case/q.yaml --csv strengths.csv --vtk strengths.vtk
expect 2 "$fracas" sample case/q.yaml --csv both.csv --vtk both.csv
sed 's/^strength: .*/strength: {distribution: file, file: given.csv}/' small.yaml > given.yaml
sed 's/.*,//; 1d; s/$/ /' strengths.csv > given.csv
expect 0 "$fracas" plan given.yaml
expect 2 "$fracas" sample given.yaml --csv given.csv
said 'sample: --csv given.csv would replace given.csv, which is read'
for name in index.html points.csv datapackage.json; do
    mkdir -p page
    echo mine > page/$name
    case $name in datapackage.json) commands='export\ --to' ;; index.html) commands='report\ -o' ;; *) commands='report\ -o export\ --to' ;; esac
    for command in $(echo "$commands" | sed 's/\\ /,/g'); do
        expect 2 "$fracas" "${command%,*}" one "${command#*,}" page
        said "page/$name is there already"
        [ "$(cat page/*)" = mine ] || fail "it is replaced: page/$name"
        [ "$(ls page)" = $name ] || fail "beside it is written: page/$name"
    done
    rm -r page
done
for times in once twice; do
    expect 0 "$fracas" report one -o "page"
    expect 0 "$fracas" export one --to "tables"
done

# converge writes campaign files of its own.
mkdir -p many
cp own.yaml many/mesh.yaml
expect 2 "$fracas" converge small.yaml --study many --jobs 1
said 'many/mesh.yaml is not as a run writes it'
[ "$(ls many)" = mesh.yaml ] || fail "a refused converge has written $(ls many)"
rm -r many
for name in converge.csv report/index.html report/converge-size.csv; do
    mkdir -p many/report
    echo mine > many/$name
    expect 2 "$fracas" converge small.yaml --study many --jobs 1
    said "many/$name is there already"
    [ "$(find many -type f)" = many/$name ] || fail "a refused converge has written $(find many -type f)"
    [ "$(cat many/$name)" = mine ] || fail "it is replaced: many/$name"
    rm -r many
done

# Folders of a study, and its fits: what fracas wrote there goes, what somebody has put there stays.
rm -rf case
mkdir case
echo mine > case/fits.csv
refused "$fracas" run small.yaml --study case --jobs 1
said 'case/fits.csv is there already, and no run of fracas wrote it'
# mine FILE COMMAND...: refuses to replace FILE of the study `case`, writes nothing beside it, and replaces its own.
mine()
{
    name=$1
    shift
    rm -rf case
    cp -r one case
    mkdir -p "case/$(dirname "$name")"
    echo mine > case/$name
    refused "$@"
    said "case/$name is there"
    mv case/$name kept
    expect 0 "$@"
    [ -s case/$name ] || fail "it is not written: $name"
    expect 0 "$@"
    ! cmp -s kept case/$name || fail "it is not written again: $name"
}
mine fits.csv "$fracas" fit case --resamples 99 --jobs 1
mine export/points.csv "$fracas" export case
mine export/datapackage.json "$fracas" export case
for replica in 0 1; do # the report's realization is one of them
    mine vtk/point-0-replica-$replica-body-1.hdf "$fracas" export case --vtk --times 2 --replica $replica
    mine vtk/point-0-replica-$replica-interfaces-2.hdf "$fracas" export case --vtk --times 2 --replica $replica
    mine vtk/point-0-replica-$replica-body.hdf.series "$fracas" export case --vtk --times 2 --replica $replica
done
for folder in pictures p; do
    to="$fracas picture case"
    [ $folder = pictures ] || to="$to -o case/$folder"
    # shellcheck disable=SC2086 # words
    {
        mine $folder/surface-point-0-replica-0-1.svg $to --times 2
        mine $folder/surface-point-0-replica-0-2.svg $to --times 2 --table
        mine $folder/times-point-0.csv $to --times 2 --table
        mine $folder/surface-point-0-replica-0.html $to --film
        mine $folder/surface-point-0-replica-0-2.png $to --times 2 --png
    }
done
/usr/bin/python3 - case/p/surface-point-0-replica-0-2.png <<'PNG' || fail "the PNG is damaged"
import struct, sys, zlib
data, at, kinds = open(sys.argv[1], "rb").read(), 8, []
while at < len(data):
    (size,) = struct.unpack(">I", data[at:at + 4])
    assert zlib.crc32(data[at + 4:at + 8 + size]) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
    kinds.append(data[at + 4:at + 8])
    at += 12 + size
assert at == len(data) and kinds[0] == b"IHDR" and kinds[1] == b"tEXt" and kinds[-1] == b"IEND", kinds
PNG
# The grids of a replay have other arrays, and are somebody's.
rm -rf case
cp -r one case
mkdir case/vtk
expect 0 "$fracas" replay one 0/0 --fields fields --at end
cp fields/body-1.hdf case/vtk/point-0-replica-0-body-1.hdf
refused "$fracas" export case --vtk --times 2 --replica 0
said 'case/vtk/point-0-replica-0-body-1.hdf is there already, and is of no report or export of fracas: name another folder, or move it away'

# gc knows the names that a reindex gives.
rm -rf case
cp -r one case
for name in mine 20260101T000000.5-mine 20260101T000000 2026-01-01.1; do echo mine > case/index.sqlite.before-$name; done
printf 'no index' > case/index.sqlite
expect 0 "$fracas" reindex case
expect 0 "$fracas" gc case
said 'freed case/index.sqlite.before-2.*: an index that was replaced'
said 'left case/index.sqlite.before-mine '
[ "$(cat case/index.sqlite.before-* | grep -c '^mine$')" -eq 4 ] || fail "gc has removed somebody's"
[ "$(ls case/index.sqlite.before-* | wc -l)" -eq 4 ] || fail "gc has left an index"
