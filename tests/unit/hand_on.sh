# A study.h5 that somebody hands on, without its folder and the files that its campaign named: every command that looks at a study reads
# it, replays have its bytes, those that change a study refuse it and say how to make a study of it, and that study goes on as the first.
. tests/support/campaigns.sh

# Strengths from a file, common random numbers, and an axis for the figures; then a surface, and a rule for replicas.
campaign bar.yaml 3 '1e5, 2e5'
i=0
while [ $i -lt 500 ]; do
    echo $((290000000 + i * 7919 % 20000000))
    i=$((i + 1))
done > strengths.csv
sed -i -e 's/^strength:.*/strength: {distribution: file, file: strengths.csv}/' -e 's/^  - loading.rate.*/&\n  - cohesive.beta: [4, 5]/' bar.yaml
printf 'random_numbers: common\nreport: {x: cohesive.beta}\n' >> bar.yaml
cat > plate.yaml <<'END_OF_FILE'
name: plate
seed: 3
model: membrane
geometry: {width: 2 mm, height: 1 mm, thickness: 0.1 mm}
mesh: {divisions: 6}
material: {young: 370 GPa, poisson: 0.22, density: 3900 kg/m3}
cohesive: {fracture_energy: 50 J/m2}
strength: {scale: 300 MPa, shape: 10}
loading: {rate: 1e5 1/s}
time: {stop: time, end: 0.5 us}
replicas: 2
output: {history: 10, interfaces: true}
END_OF_FILE
campaign rule.yaml 3 '1e5'
sed -i "s,^replicas: 3,replicas: {minimum: 8\, maximum: 16\, until: {quantity: mean-count\, relative-half-width: 1e-4\, confidence: 0.95}}," rule.yaml

# planned FILE: its plan, without times of this machine.
planned()
{
    "$fracas" plan "$1" --jobs 1 --json | grep -v 'second\|bytes_'
}

for name in bar plate rule; do
    expect 0 "$fracas" run $name.yaml --study first-$name --jobs 2
    planned $name.yaml > $name.plan
    "$fracas" sample $name.yaml --replica 1 --csv - > $name.sample
    mkdir -p away/$name
    cp first-$name/study.h5 away/$name
done
mkdir gone
mv bar.yaml plate.yaml rule.yaml strengths.csv gone

for name in bar plate rule; do
    lone=away/$name/study.h5
    expect 0 "$fracas" report $lone --json
    sed '/^  "name":/d' said > lone.json
    "$fracas" report first-$name --json | sed '/^  "name":/d' | cmp - lone.json || fail "the report of $lone has other numbers"
    cmp first-$name/report/points.csv away/$name/report/points.csv
    for figure in "first-$name"/report/*.svg; do
        cmp "$figure" "away/$name/report/${figure##*/}" || fail "a figure of $lone differs"
    done
    expect 0 "$fracas" report $lone --quiet -o elsewhere-$name
    [ -s elsewhere-$name/index.html ]
    expect 0 "$fracas" export $lone --to tables-$name
    expect 0 "$fracas" picture $lone -o pictures-$name
    expect 0 "$fracas" fit $lone --resamples 99 --point 0 --jobs 1
    expect 0 "$fracas" compare $lone first-$name --json
    mv said compared
    expect 0 "$fracas" compare first-$name first-$name --json
    grep -v '^  "name"\|"study"\|away' compared | sort > a
    grep -v '^  "name"\|"study"\|first' said | sort > b
    grep -q '"paired": true' a
    grep -c '"paired": true' a | cmp - /dev/fd/3 3<<END_OF_COUNT || fail "points of $lone are paired otherwise"
$(grep -c '"paired": true' b)
END_OF_COUNT
    expect 0 "$fracas" verify --full $lone
    said 'is sound'
    planned $lone | cmp - $name.plan || fail "another plan of $lone"
    "$fracas" sample $lone --replica 1 --csv - | cmp - $name.sample || fail "another sample of $lone"
    for realization in 0/0 0/1; do
        expect 0 "$fracas" replay $lone $realization
        said 'computed again, the same bytes'
    done
    expect 0 "$fracas" replay $lone 0/1 --fields fields-$name --at end

    # What changes a study refuses it.
    cp $lone kept.h5
    for command in "extend $lone --replicas 9" "retry $lone --failed" "merge $lone" "reindex $lone" "gc $lone" "status $lone" \
        "merge-studies $lone first-$name" "merge-studies first-$name $lone"; do
        # shellcheck disable=SC2086
        expect 5 "$fracas" $command
        said "this command needs the whole study, which .fracas export $lone --study NEW. makes of it"
    done
    for command in run submit converge; do
        expect 2 "$fracas" $command $lone
        said ".fracas export $lone --study NEW. makes a study of it"
    done
    cmp kept.h5 $lone || fail "$lone was changed"

    # A study of it: nothing is computed again, and the bytes are the same.
    expect 0 "$fracas" export $lone --study new-$name
    same first-$name new-$name
    cmp first-$name/campaign.yaml new-$name/campaign.yaml
    expect 0 "$fracas" verify --full new-$name
    expect 2 "$fracas" export $lone --study new-$name
    said 'is no empty folder'
    expect 0 "$fracas" run new-$name/campaign.yaml --study new-$name
    expect 0 "$fracas" status new-$name
    said 'complete'
done
expect 2 "$fracas" export away/bar --study x --histories

# It grows as the first does, and its campaign computes the first again.
expect 0 "$fracas" extend new-bar --replicas 4 --jobs 2
expect 0 "$fracas" extend first-bar --replicas 4 --jobs 2
same new-bar first-bar
expect 0 "$fracas" run new-plate/campaign.yaml --study anew --jobs 2
same anew first-plate
cp away/plate/study.h5 of-any-name.h5
expect 0 "$fracas" plan of-any-name.h5
expect 0 "$fracas" export of-any-name.h5 --study of-any-name
same of-any-name first-plate

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "the rest skipped: python3-h5py is not installed"; exit 0; }
# The text reads as str, and is campaign.yaml; the files are those that it names.
/usr/bin/python3 - <<'END_OF_SCRIPT' || fail "h5py reads another campaign"
import h5py
with h5py.File("away/bar/study.h5") as study:
    text = study["campaign/resolved"].asstr()[0]
    files = {name: data[0] for name, data in study["campaign/attachments"].items()}
    assert isinstance(text, str) and text == open("new-bar/campaign.yaml").read().replace("replicas: 4", "replicas: 3"), text
    assert len(files) == study["campaign"].attrs["attachments"] == 1 and list(files.values()) == [open("gone/strengths.csv", "rb").read()]
    assert "attachments/" + list(files)[0] in text and "strengths.csv" not in text and "gone" not in text
with h5py.File("away/plate/study.h5") as study:
    assert "attachments" not in study["campaign"]
END_OF_SCRIPT

# change FILE NAME: another text in its place, of the same length; a version of fracas that there is not.
change()
{
    cp away/bar/study.h5 "$1"
    /usr/bin/python3 - "$1" "$2" <<'END_OF_SCRIPT'
import h5py, numpy, sys
with h5py.File(sys.argv[1], "r+") as study:
    if sys.argv[2] == "version":
        study.attrs["program_version"] = numpy.bytes_("9.9.9")
    else:
        text = study["campaign/resolved"]
        text[0] = text[0].replace(b"seed: 7", b"seed: 8" if sys.argv[2] == "seed" else b"sead: 7")
END_OF_SCRIPT
}

mkdir seed word
for what in seed word; do
    change $what/study.h5 $what
    expect 5 "$fracas" verify $what
    expect 5 "$fracas" replay $what 0/0
    expect 5 "$fracas" export $what --study never
    [ ! -e never ]
done
for command in plan sample; do
    expect 5 "$fracas" $command word/study.h5
    said 'the campaign in the file is damaged'
done
"$fracas" verify seed > said 2>&1 || true
said '/campaign is not the campaign of its results'
# Results of another version are looked at, and not gone on with: its campaign is computed anew.
mkdir other
change other/study.h5 version
expect 0 "$fracas" report other --quiet
expect 0 "$fracas" verify other
expect 5 "$fracas" replay other 0/0
said 'was computed by fracas 9.9.9'
expect 0 "$fracas" export other/study.h5 --study of-other
said 'without the results, which are of another version'
[ ! -e of-other/study.h5 ] && [ ! -e of-other/segments ]
expect 0 "$fracas" run of-other/campaign.yaml --study of-other --jobs 2
cmp of-other/study.h5 away/bar/study.h5 || fail "the campaign of another version is another"

# Beside its campaign.yaml it is no study of a run, which would replace it.
mkdir beside
cp -r away/bar/study.h5 new-bar/campaign.yaml new-bar/attachments beside
expect 2 "$fracas" run beside/campaign.yaml --study beside
said 'without the index and the segments of its run'
for command in report export fit picture status reindex merge gc 'replay 0/0' 'compare first-bar' 'extend --replicas 9' 'retry --failed'; do
    # shellcheck disable=SC2086
    set -- $command
    name=$1
    shift
    expect 5 "$fracas" "$name" beside "$@"
    said 'beside/study.h5 is of another campaign than the campaign.yaml beside it.* .fracas export beside/study.h5 --study NEW. makes'
done
expect 5 "$fracas" compare first-bar beside
said 'is of another campaign than the campaign.yaml beside it'
for two in 'beside new-bar' 'new-bar beside'; do
    # shellcheck disable=SC2086
    expect 5 "$fracas" merge-studies $two
    said 'beside has a study.h5 without the index and the segments of its run.*export beside/study.h5 --study NEW'
done
expect 5 "$fracas" verify beside
grep -q 'beside/study.h5 is of another campaign' said || fail "verify does not say what beside has"
cmp beside/study.h5 away/bar/study.h5 || fail "a run has replaced a study.h5 that was handed on"
if [ -e beside/index.sqlite ] || [ -e beside/segments ]; then fail "something was made of beside"; fi
expect 0 "$fracas" export beside/study.h5 --study of-beside
cmp of-beside/study.h5 away/bar/study.h5

# A whole study that has lost its campaign.yaml is none that was handed on: its segments are not looked at.
cp -r new-bar lost
rm lost/campaign.yaml
expect 5 "$fracas" verify lost
said 'campaign.yaml'

# A file of this version without the campaign is damaged.
mkdir bare
cp away/bar/study.h5 bare
/usr/bin/python3 -c 'import h5py; del h5py.File("bare/study.h5", "r+")["campaign"]'
for what in verify report picture; do
    expect 5 "$fracas" $what bare
    said '/campaign is not there'
done

# A report that was cut off before its page is in nobody's way.
mkdir cut
cp away/bar/study.h5 cut
expect 0 "$fracas" report cut/study.h5 --quiet
rm cut/report/index.html
expect 0 "$fracas" report cut/study.h5 --quiet
# Nothing is made of a file with a damaged value, or with attributes that are not those of its campaign.
mkdir flipped attribute
cp away/bar/study.h5 flipped
cp away/bar/study.h5 attribute
# flip FILE: a bit of a value.
flip()
{
    /usr/bin/python3 - "$1" <<'END_OF_SCRIPT'
import sys
import h5py
with h5py.File(sys.argv[1]) as study:
    at = study["fragment/mass"].id.get_chunk_info(0).byte_offset
with open(sys.argv[1], "r+b") as file:
    file.seek(at + 3)
    byte = file.read(1)
    file.seek(at + 3)
    file.write(bytes([byte[0] ^ 1]))
END_OF_SCRIPT
}
flip flipped/study.h5
/usr/bin/python3 -c 'import h5py
with h5py.File("attribute/study.h5", "r+") as study: study.attrs.modify("seed", study.attrs["seed"] + 1)'
for what in flipped attribute; do
    expect 5 "$fracas" verify $what
    expect 5 "$fracas" export $what/study.h5 --study never
    [ ! -e never ] || fail "a study is made of a damaged file"
done

# The message says what to do: a study makes the file again; a lone file may have another copy.
for command in report verify 'replay 0/0' 'compare first-bar'; do
    # shellcheck disable=SC2086
    set -- $command
    name=$1
    shift
    expect 5 "$fracas" "$name" flipped "$@"
    said 'flipped/study.h5 is damaged: get another copy'
done
expect 5 "$fracas" compare first-bar flipped
said 'flipped/study.h5 is damaged: get another copy'
cp -r new-bar hurt
expect 0 "$fracas" report hurt --quiet
flip hurt/study.h5
expect 5 "$fracas" report hurt --quiet
said 'hurt/study.h5 is damaged: remove it, and .fracas merge hurt. makes it again'
rm hurt/study.h5
expect 0 "$fracas" merge hurt
cmp hurt/study.h5 new-bar/study.h5

# One that was cut off before its campaign file is made by the same command.
mkdir -p again/segments again/attachments
expect 0 "$fracas" export away/bar/study.h5 --study again
cmp again/study.h5 away/bar/study.h5 || fail "after a cut the study is another"
expect 2 "$fracas" export away/bar/study.h5 --study again
said 'fracas merge again'
echo "handed on, looked at, replayed and gone on with"
