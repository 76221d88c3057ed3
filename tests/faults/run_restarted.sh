# ctest-mpirun: ci
# A rank that dies takes its starter down; the parent says why, starts it again, and the run goes on to the bytes of an undisturbed one. A start
# that never makes anything durable is given up.
. tests/support/campaigns.sh

campaign small.yaml 20 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2

restarts_are() { [ "$(grep -c 'the ranks are started again' background)" -eq "$1" ]; }

# killed WHOM TIMES: kills of a run, each after two realizations more were stored. The run is held, so that none comes too late.
killed()
{
    hold
    start --no-report small.yaml --study restarted --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    kill=0
    while [ $kill -lt "$2" ]; do
        await "start after kill $kill" restarts_are $kill
        wait_segments restarted $(($(segments restarted) + 2))
        victim=$($1 | head -n 1)
        [ -n "$victim" ] || fail "there is no process of $1 to kill"
        kill -9 "$victim"
        kill=$((kill + 1))
    done
    finish
    [ $status -eq 0 ] || { cat background >&2; fail "status $status"; }
    restarts_are "$2" || { cat background >&2; fail "not started again $2 times"; }
}

# Four ranks in turn: more starts than may be in vain, and none was.
starters() { named $starter; }
for case in 'ranks 4' 'starters 1'; do
    # shellcheck disable=SC2086 # two words
    killed $case
    case "$starter $case" in
    mpirun\ ranks*) why='mpirun noticed that process rank .* exited on signal 9 (Killed)' ;;
    mpirun*) why='mpirun died of signal 9 (Killed)' ;;
    *ranks*) why='the starter noticed that rank . died of signal 9 (Killed; memory may have run out)' ;;
    *) why='the starter died of signal 9 (Killed)' ;;
    esac
    grep -q "^$why; the ranks are started again" background || { cat background >&2; fail "it did not say why"; }
    same undisturbed restarted
    expect 0 "$fracas" verify restarted
    sqlite3 restarted/index.sqlite "SELECT text FROM event WHERE kind = 'restarted'" > said
    said "$why" # in the index, too
    rm -r restarted
done

# Nothing gets done: three starts, then status 6 with the last reason. With something done in between, it is not given up.
[ $starter = mpirun ] || exit 0
mkdir bin
real=$(command -v mpirun)
cat > bin/mpirun <<END
#!/bin/sh
echo start >> "$work/starts"
[ "\$(wc -l < "$work/starts")" -gt "\${BROKEN:-99}" ] && exec "$real" "\$@"
echo '--------------------------------------------------------------------------' >&2
echo 'There are not enough slots available in the system.' >&2
exit 1
END
chmod +x bin/mpirun
expect 6 env PATH="$PWD/bin:$PATH" "$fracas" run small.yaml --study broken --jobs 2
said '^There are not enough slots available in the system; the ranks are started again'
said '^fracas: There are not enough slots .*; the ranks were started 3 times, the last 3 in vain; .*same command goes on'
[ "$(wc -l < starts)" -eq 3 ] || fail "$(wc -l < starts) starts"
rm starts
expect 0 env BROKEN=2 PATH="$PWD/bin:$PATH" "$fracas" run --no-report small.yaml --study broken --jobs 2
same undisturbed broken

# Stopped while it waits to start again: at once, resumable.
rm -r broken starts
: > background # what the run before said is none of this one's words
PATH="$PWD/bin:$PATH" setsid "$fracas" run --no-report small.yaml --study broken --jobs 2 > background 2>&1 &
session=$!
await 'second start' restarts_are 1
kill -USR1 "$session"
finish
[ $status -eq 3 ] || { cat background >&2; fail "status $status"; }
expect 0 "$fracas" run --no-report small.yaml --study broken --jobs 2
same undisturbed broken
