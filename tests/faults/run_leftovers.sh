# ctest-mpirun: storm
# No run leaves anything in /dev/shm or TMPDIR, however it ended. Open MPI's files there lose their names once the ranks have
# opened them; those of a run killed before that go with the next run of this user.
root=-r
[ "$(id -u)" -ne 0 ] || root=
if [ -z "${FRACAS_OWN_MOUNTS-}" ]; then
    if ! unshare $root -m mount -t tmpfs tmpfs /dev/shm 2>/dev/null; then
        echo "skipped: there is no /dev/shm for this test alone here"
        exit 0
    fi
    FRACAS_OWN_MOUNTS=1 exec unshare $root -m sh "$0" "$@"
fi
. tests/support/campaigns.sh
mount -t tmpfs tmpfs /dev/shm
mkdir tmp
export TMPDIR="$work/tmp"

left()
{
    find /dev/shm "$work/tmp" -mindepth 1 2>/dev/null
}

nothing_left()
{
    [ -z "$(left)" ] || fail "$1 leaves $(left)"
}

# begin: a run, computing.
begin()
{
    rm -rf study
    hold
    start --no-report small.yaml --study study --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    wait_segments study 1
}

# end WHAT [SIGNAL]: waits for the end of the run, after a signal to its parent.
end()
{
    [ $# -lt 2 ] || kill "-$2" "$session" 2>/dev/null || true
    release
    wait_gone "$1"
    wait "$session" 2>/dev/null || true
    session=
    nothing_left "$1"
}

campaign small.yaml 60 '3e4 1/s, 1e5 1/s'
begin
nothing_left "a run that computes"
end "the kill of the parent" KILL
begin
kill -9 "$(named $starter)"
end "the kill of the starter" TERM
begin
pids=$(ranks)
[ -n "$pids" ] || fail "there are no ranks to kill"
kill -9 $pids 2>/dev/null || true # the starter may be faster with the others
end "the kill of all ranks" TERM
begin
kill_session
release
nothing_left "the kill of everything"

# Before the ranks have started: within the first moments, which the number of files tells.
campaign small.yaml 1 '1e5 1/s'
held=0
for files in 1 9 18; do
    rm -rf study
    start --no-report small.yaml --study study --jobs 2
    while [ -n "$(processes)" ] && [ ! -e study/study.h5 ] && [ "$(left | wc -l)" -lt $files ] &&
        { [ $starter = mpirun ] || [ -z "$(named $starter)" ]; }; do :; done
    kill_session
    held=$((held + $(left | wc -l)))
done
echo "$held files of runs killed as they started"
case $starter in
mpirun) [ $held -gt 0 ] || fail "no run was killed as it started" ;;
*) [ $held -eq 0 ] || fail "without mpirun a run needs no files there" ;;
esac
if [ $starter = mpirun ]; then # which sweeps
    mkdir tmp/.fracas-mpi-of-others tmp/fracas-mine
    chown 1 tmp/.fracas-mpi-of-others 2>/dev/null || rmdir tmp/.fracas-mpi-of-others
    expect 0 "$fracas" run --no-report small.yaml --study study
    others=$(find tmp -mindepth 1 ! -name fracas-mine ! -name .fracas-mpi-of-others)
    [ -z "$others" ] && [ -d tmp/fracas-mine ] || fail "the next run leaves $(left)"
    rm -r tmp/.f* tmp/f* 2>/dev/null || true
    nothing_left "the next run"
fi

# Folders missing, or too small.
expect 0 env TMPDIR="$work/none" "$fracas" run --no-report small.yaml --study elsewhere
[ ! -e none ] || fail "$(find none) is left"
mount -t tmpfs -o size=1m tmpfs /dev/shm
rm -rf study
start --no-report small.yaml --study study
end "a run with a full /dev/shm"
