# ctest-sanitize
# ctest-labels: ci
# A study from a stranger (docs/decisions/trust.md): no command waits for a pipe in the place of a file, writes through a
# symbolic link or takes an empty name for a folder; merge-studies owns the bytes it takes.
. tests/support/campaigns.sh

campaign small.yaml 4 '3e4 1/s, 1e5 1/s'
for part in 1 2; do
    expect 3 "$fracas" run small.yaml --study part$part --no-report --part $part/2 --jobs 2
done
expect 0 "$fracas" run small.yaml --study sound --jobs 2

# at_once STATUS COMMAND...: as expect, and within seconds.
at_once()
{
    wanted=$1
    shift
    expect "$wanted" timeout -s KILL 20 "$@"
}

# content STUDY...: all of it.
content()
{
    find "$@" ! -name 'index*' -printf '%p %y %l\n' | sort
    find "$@" -type f ! -name 'index*' -exec sha256sum {} + | sort
    for study; do sqlite3 "$study/index.sqlite" .dump; done
}

# Segments as links to a store: merge-studies takes their bytes.
mkdir store
mv part2/segments/*.h5 store
for file in store/*; do ln -s "../../$file" part2/segments/; done
cp -a part1 linked
expect 0 "$fracas" verify part2
expect 0 "$fracas" merge-studies linked part2
[ -z "$(find linked/segments -type l)" ] || fail "a link was taken for a segment"

# A damaged study is refused, and both stay as they are.
before=$(content part1 part2)
one=$(ls store/* | head -n 1)
python3 -c 'import sys
with open(sys.argv[1], "r+b") as f: f.seek(3000); byte = f.read(1)[0]; f.seek(3000); f.write(bytes([byte ^ 1]))' "$one"
expect 5 "$fracas" merge-studies part1 part2
said "nothing is taken from a damaged study; .fracas run part2/campaign.yaml --study part2. repairs it: .*damaged"
rm "$one"
expect 5 "$fracas" merge-studies part1 part2
said 'is not there'
[ "$before" = "$(content part1 part2)" ] || fail "a refused merge-studies changed something"
rm -r store part2
expect 0 "$fracas" merge linked
same sound linked
expect 0 "$fracas" verify --full linked

# A pipe in the place of each file: no command waits.
for name in campaign.yaml lock index.sqlite index.sqlite-wal index.sqlite-shm index.sqlite-journal fits.csv study.h5 segment; do
    rm -rf piped
    cp -r sound piped
    [ $name != segment ] || name=segments/$(ls sound/segments | head -n 1)
    rm -f piped/$name
    mkfifo piped/$name
    commands='status verify gc reindex'
    [ $name != fits.csv ] || commands='verify report'
    for command in $commands; do
        status=0
        timeout -s KILL 20 "$fracas" $command piped > said 2>&1 || status=$?
        case $status in 0 | 5) ;; *) cat said; fail "status $status of $command with a pipe as $name" ;; esac
    done
done
mkfifo pipe
at_once 2 "$fracas" plan pipe
said 'pipe is no file'
at_once 5 "$fracas" submit small.yaml --time 1:00:00 --script pipe
said 'it is a pipe'

# A link in the place of each file or folder to be written: its target stays.
mkdir elsewhere
echo precious > elsewhere/victim
for name in lock index.sqlite index.sqlite-wal index.sqlite-shm index.sqlite-journal; do
    rm -rf linked
    cp -r sound linked
    rm -f linked/$name linked/study.h5
    ln -s ../elsewhere/victim linked/$name
    for command in gc merge; do at_once 5 "$fracas" $command linked; done
    said "$name: it is a symbolic link"
done
rm -rf linked # these are renamed over
cp -r sound linked
cp sound/campaign.yaml elsewhere/campaign
ln -sf ../elsewhere/campaign linked/campaign.yaml
ln -sf ../elsewhere/victim linked/study.h5
at_once 0 "$fracas" reindex linked
at_once 0 "$fracas" run small.yaml --study linked --jobs 1
same sound linked
ln -sf ../elsewhere/victim linked/fits.csv
at_once 0 "$fracas" fit linked --resamples 99
[ "$(find linked -type l)" = linked/campaign.yaml ] || fail "a link is left" # that of the user's own campaign file stays
for name in segments attachments report export pictures .reindex; do
    rm -rf linked
    cp -r sound linked
    rm -rf linked/$name linked/study.h5
    ln -s ../elsewhere linked/$name
    touch elsewhere/.left.tmp-1 elsewhere/0123456789abcdef0123456789abcdef elsewhere/index.sqlite elsewhere/x.damaged
    case $name in
    segments) commands='gc merge reindex' ;;
    attachments) commands=gc ;;
    report) commands=report ;;
    export) commands=export ;;
    pictures) commands= ;;
    .reindex) commands='gc reindex' ;;
    esac
    for command in $commands; do
        at_once 5 "$fracas" $command linked
        said "$name: it is a symbolic link"
    done
    [ "$(ls -A elsewhere | wc -l)" -eq 6 ] || { ls -A elsewhere; fail "a link was followed by $command: $name"; }
done
grep -q precious elsewhere/victim || fail "the victim of a link is gone"
[ "$(wc -c < elsewhere/victim)" -eq 9 ] || fail "the victim of a link was written"
cmp sound/campaign.yaml elsewhere/campaign

# The user may reach a study by a link.
ln -s sound reached
expect 0 "$fracas" report reached
expect 0 "$fracas" run small.yaml --study reached
expect 0 "$fracas" gc reached

# An empty name is no folder.
for command in status report fit export verify picture merge reindex gc 'retry --failed' 'extend --replicas 9' run plan sample; do
    expect 2 "$fracas" ${command%% *} '' $(echo "$command" | sed 's/^[a-z]*//')
    said 'is empty: an empty name would be the folder'
done
expect 2 "$fracas" merge-studies sound ''
expect 2 "$fracas" compare '' sound

# A study moved away under its run: nothing is said to be kept.
campaign longer.yaml 24 '3e4 1/s, 1e5 1/s'
hold
start longer.yaml --no-report --study moved --jobs 2 --segment-size 0.01
wait_segments moved 2
mv moved gone
finish
[ $status -eq 6 ] || { cat background; fail "status $status of a run without its study"; }
grep -q 'moved, or a part of it, was moved or removed' background || { cat background; fail "it is not said that the study is gone"; }
grep -q 'done and kept' background && fail "something is said to be kept"

# A study is not damaged because a run computes it.
hold
start longer.yaml --no-report --study busy --jobs 2 --segment-size 0.01
wait_segments busy 2
look()
{
    status=0
    "$fracas" verify --full busy > said 2>&1 || status=$?
    [ $status -eq 0 ] || [ $status -eq 4 ] || { cat said; fail "status $status of verify beside a run"; }
}
look
release
while [ -n "$(processes)" ]; do look; done
finish
[ $status -eq 0 ] || { cat background; fail "status $status of a run that was looked at"; }
expect 0 "$fracas" verify --full busy

# Reading commands change no byte and no name of a study, also beside the log of a killed run.
expect 0 "$fracas" fit sound --resamples 99
bytes()
{
    (cd "$1" && find . -type f ! -path './report/*' ! -path './export/*' ! -name '*-shm' -exec sha256sum {} + | sort)
}
cp -r gone killed
for study in sound killed; do
    before=$(bytes $study)
    for command in status report export verify 'verify --full' "compare sound"; do
        "$fracas" $command $study > said 2>&1 || [ $? -eq 3 ] || [ $study = killed ] || { cat said; fail "$command $study"; }
    done
    [ "$before" = "$(bytes $study)" ] || { bytes $study; fail "$before: a reading command changed $study"; }
done

[ -z "$(find sound -name 'index.sqlite-*')" ] || fail "a reading command left a file of SQLite's"

# fits.csv: a flipped bit is found, left out of reports with a word, and ends no run; a file of an older version, too.
for what in flipped empty older unreadable; do
    rm -rf fitted
    cp -r sound fitted
    case $what in
    flipped) sed -i '0,/,m,0\.000/s//,m,1.000/' fitted/fits.csv ;;
    empty) : > fitted/fits.csv ;;
    older) sed -i '/^,,study,seal/d' fitted/fits.csv ;;
    unreadable) rm fitted/fits.csv && mkdir fitted/fits.csv ;;
    esac
    cmp -s sound/fits.csv fitted/fits.csv && fail "fits.csv is not changed: $what"
    expect 0 "$fracas" report fitted
    said 'warning: the fits are left out: .*fits.csv'
    grep -q 'the fits are left out' fitted/report/index.html || fail "the page does not say that fits are left out"
    grep -q '"fits_left_out": "the fits are left out' fitted/report/summary.json || fail "nor does the summary"
    expect 0 "$fracas" run small.yaml --study fitted
    said 'warning: the fits are left out'
    if [ $what = older ]; then expect 0 "$fracas" verify fitted; else expect 5 "$fracas" verify fitted; fi
    said 'fits.csv'
    [ $what = unreadable ] || expect 5 "$fracas" fit fitted --point 0 --resamples 99
    [ $what = unreadable ] || expect 0 "$fracas" fit fitted --resamples 99
    [ $what = unreadable ] || cmp sound/fits.csv fitted/fits.csv
done
