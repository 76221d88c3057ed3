# ctest-mpirun: storm
# kill -9 of a server, of its supervisor or of the process of a lease, with a process for each lease and without: nothing is lost, and a
# server is replaced.
. tests/support/campaigns.sh

campaign small.yaml 12 '3e4 1/s, 1e5 1/s'
sed 's/elements: 500/elements: 1200/' small.yaml > long.yaml # some 20 ms a realization
expect 0 "$fracas" run --no-report long.yaml --study undisturbed --jobs 2

# events STUDY KIND
events()
{
    sqlite3 "$1/index.sqlite" "SELECT count(*) FROM event WHERE kind = '$2'"
}

# A lease may end between the two calls.
is_killed() { victim=$(named "$1" | head -n 1); [ -n "$victim" ] && kill -9 "$victim" 2> kill; }

# killed STUDY ISOLATION NAME [JOBS]: kill -9 of the first process of that name while there is much to do.
killed()
{
    hold
    start --no-report long.yaml --study "$1" --jobs "${4:-2}" --isolation "$2" --lanes 1 --lease-time 0 --segment-size 0.1 # three records
    wait_segments "$1" 1
    servers=$(named fracas-server)
    await "process $3" is_killed "$3"
    finish
    [ $status -eq 0 ] || { cat background >&2; fail "status $status after kill -9 of $3"; }
    same undisturbed "$1"
}

# newcomer STUDY: a server that was not there before the kill has written a segment.
newcomer()
{
    for pid in $(sqlite3 "$1/index.sqlite" "SELECT DISTINCT json_extract(provenance, '\$.pid') FROM segment"); do
        case " $(echo $servers) " in *" $pid "*) ;; *) return ;; esac
    done
    fail "no server but $(echo $servers) has written a segment"
}

for isolation in lease none; do
    killed server-$isolation $isolation fracas-server
    grep -q 'compute server of rank . died of signal 9 (Killed; memory may have run out); a new one goes on' background ||
        fail "it did not say that a server died"
    [ "$(events server-$isolation 'server replaced')" -eq 1 ] || fail "not one event of a server replaced"
    newcomer server-$isolation
    killed supervisor-$isolation $isolation fracas-supervis
    grep -q 'compute server of rank . went with its supervisor, which died of signal 9.*; the others go on' background ||
        fail "it did not say that a supervisor died"
    [ "$(events supervisor-$isolation 'worker lost')" -eq 1 ] || fail "not one event of a worker lost"
done
killed lease-lease lease fracas-lease

# The supervisor of the only worker: the ranks are started again, as for a dead rank.
killed only-supervisor lease fracas-supervis 1
grep -q '^the compute server of rank 0 went with its supervisor, which died of signal 9.*; the ranks are started again' background ||
    { cat background >&2; fail "it did not say that the ranks are started again"; }
grep -q 'others go on' background && fail "there are no others"

zombies()
{
    cat /proc/[0-9]*/stat 2>/dev/null | sed 's/([^)]*)/x/' | awk -v session="$session" '$6 == session && $3 == "Z" {print $1}'
}

# Five in a row that have written nothing: that is enough. Meanwhile nobody is left a zombie.
campaign one.yaml 1 '1e5 1/s'
export FRACAS_TEST_FAULT=hang:0:0
program=$faulty
start --no-report one.yaml --study five --jobs 1 --isolation none
last=
is_next()
{
    server=$(named fracas-server)
    [ -n "$server" ] && [ "$server" != "$last" ] && [ -z "$(zombies)" ]
}
for death in 1 2 3 4 5; do
    await "server number $death, or there are zombies" is_next
    kill -9 "$server"
    last=$server
done
finish
unset FRACAS_TEST_FAULT
[ $status -eq 6 ] || { cat background >&2; fail "status $status after five deaths"; }
grep -q 'compute server of rank 0 died of signal 9 .*and 4 died before it with no segment in between; it is not started again' background ||
    { cat background >&2; fail "it did not say why it gave up"; }
expect 0 "$fracas" run --no-report one.yaml --study five
