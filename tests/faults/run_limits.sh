# ctest-mpirun: storm
# Limits of machine and disk: too little space, files or inodes, files too big, too many open, a disk made read-only. Each is said with
# its remedy and status 6, and when it is gone the same command goes on to what an undisturbed run gives.
. tests/support/campaigns.sh

campaign small.yaml 40 '3e4 1/s, 1e5 1/s' # 2 MB of results
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2 --memory-limit 1000000 # MB: no machine has it

# What a start would fail on, or MPI hang on, is said before.
expect 6 sh -c "ulimit -n 24; '$fracas' run small.yaml --study study --jobs 2"
said 'may open 24 files.*ulimit -n'
expect 6 sh -c "ulimit -f 1000; '$fracas' run small.yaml --study study --jobs 2"
said 'ulimit -f'
[ ! -e study ] || fail "a refused run left something behind"
# The soft limit is raised; a lease has the smaller one of two limits of memory.
memory='ulimit -S -d 8000000'
(ulimit -S -d 8000000; "$fracas" --version) > /dev/null 2>&1 || memory=: # the shadow memory of a sanitizer
expect 0 sh -c "ulimit -S -n 24; $memory; '$fracas' run small.yaml --study raised --jobs 2 --memory-limit 1000"
same undisturbed raised

# A file that may not grow: dash counts in 512 bytes, so 8.5 MB for a study.h5 of 12 MB. First it is predicted, then it happens.
campaign more.yaml 450 '1e5 1/s'
expect 6 sh -c "ulimit -f 17000; '$fracas' run more.yaml --study big --jobs 2"
said 'study.h5 will have about .*ulimit -f'
expect 6 sh -c "ulimit -f 17000; '$fracas' run more.yaml --study big --jobs 2 --ignore-space"
said 'File too large.*ulimit -f'
[ -z "$(ls -A big | grep tmp)" ] || fail "a half written study.h5 was left"
expect 0 "$fracas" run --no-report more.yaml --study big --jobs 2
expect 0 "$fracas" verify big

cat > in-small-disk.sh <<'EOF2'
run() # STATUS WORDS OPTIONS...: in the small disk
{
    wanted=$1 words=$2
    shift 2
    status=0
    "$fracas" run --no-report small.yaml --study small/study --jobs 2 "$@" > said 2>&1 || status=$?
    [ $status -eq "$wanted" ] && grep -q "$words" said || { cat said; echo "status $status, not $wanted with: $words"; exit 1; }
}
fracas=$1 asked=${FRACAS_MPIRUN-}
mount -t tmpfs -o size=1m tmpfs small || exit 77
echo mounted
run 6 'will need about .* but its disk has 1.0 MB free.*output.history.*--ignore-space'
[ ! -e small/study ] || { echo "a refused run left something behind"; exit 1; }
export TMPDIR="$PWD/small" FRACAS_MPIRUN=1 # MPI would hang
run 6 "^fracas: MPI needs 10 MB for its own files in $TMPDIR (TMPDIR), but the disk has 1.0 MB free; free some, or set TMPDIR" --ignore-space
mount -o remount,ro small
run 6 "^fracas: MPI cannot make a folder .* in $TMPDIR (TMPDIR): Read-only file system; set TMPDIR" --ignore-space
! grep 'started' said || exit 1
mount -o remount,rw small
export TMPDIR="$PWD" FRACAS_MPIRUN="$asked"
run 6 'No space left on device; free some space.*the same command goes on' --ignore-space
mount -o remount,size=64m,nr_inodes=40 small
run 6 'room for .* more files.*df -i'
mount -o remount,nr_inodes=14 small
run 6 'No space left on device.*df -i.*the same command goes on' --ignore-space --segment-size 0.001
mount -o remount,ro small
run 6 'Read-only file system; mount it to be written'
mount -o remount,rw,nr_inodes=100000 small
run 0 '' --ignore-space
mount -o remount,ro small
! (ulimit -t 2; exec "$fracas" fit small/study) > /dev/null 2> said || { echo "fitted on a disk that is read-only"; exit 1; }
grep -q 'fits.csv could not be written.*fit a copy of the study' said || { cat said; exit 1; } # at once, not after the fits
mount -o remount,rw small
cp small/study/study.h5 resumed.h5
"$fracas" verify --full small/study
EOF2
mkdir small
root=-r
[ "$(id -u)" -ne 0 ] || root=
status=0
unshare $root -m sh in-small-disk.sh "$fracas" > disk 2>&1 || status=$?
if ! grep -q '^mounted' disk && { [ $status -eq 77 ] || grep -q '^unshare:' disk; }; then
    echo "skipped: a small disk cannot be mounted here"
    exit 0
fi
[ $status -eq 0 ] || { cat disk >&2; fail "status $status"; }
cmp undisturbed/study.h5 resumed.h5 || fail "resumed after all of it, it differs"
