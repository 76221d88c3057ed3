# The launcher with a script in the place of mpirun: noise, ends of every kind, lines that nobody would send, signals.
. tests/support/campaigns.sh
. "$source/tests/support/launched.sh"

# More noise than is kept, a line longer than any, and no reason in it.
fake noise <<'END2'
printf '%040000d\n   \n' 0
printf '%040000d\n' 0 >&2
exit 1
END2
# Realizations that became durable count as a success: the next starts are not in vain. A study in use is waited for only after a start.
fake again <<'END2'
case $start in
1) printf '@fracas progress 4 1 0 0 0.5\n@fracas nonsense\na line of MPI\n'; kill -9 $$ ;;
2) printf '@fracas progress 4 2 0 0 0.5\n'; exit 127 ;;
3) printf '@fracas progress 4 3 0 0 0.5\n@fracas end 4 1 0 in use\n' ;;
4) printf '@fracas say two\vlines\n@fracas end 6 0 0 enough\n@fracas end 6 0 0 enough\n' ;;
esac
END2
fake in-use <<'END2'
echo '@fracas end 4 1 0 in use'
END2
# A message of Open MPI that is only half the known one.
fake hopeless <<'END2'
echo 'A requested component was not found'
[ $start -eq 1 ] || echo 'Framework: btl'
[ $start -lt 3 ] || echo 'Component: nonexist'
exit 1
END2
fake missing <<'END2'
exit 127
END2
# Children that are not of the run, of which some end meanwhile: none is waited for.
fake beside sh -c 'n=0; while [ $n -lt 70 ]; do sleep 0.$((n % 9)) & n=$((n + 1)); done; exec "$@"' sh <<'END2'
sleep 0.5
echo '@fracas end 6 1 0 enough'
END2
# SIGPIPE, which the launcher ignores, ends what mpirun starts.
fake pipe <<'END2'
case $(sed -n 's/^SigIgn:[[:space:]]*//p' /proc/$$/status) in
*[13579bdf]???) echo '@fracas end 6 1 0 ignored' ;;
*) echo '@fracas end 6 1 0 heard' ;;
esac
END2
# Nobody gets the status of a child.
fake ignoring env --ignore-signal=CHLD <<'END2'
echo '@fracas end 6 1 0 enough'
END2
# As another user, where this is the superuser and others may run the program.
if [ "$(id -u)" -eq 0 ] && setpriv --reuid 65534 --clear-groups sh -c '"$1" --version' sh "$fracas" > /dev/null 2>&1; then
    chmod 755 .
    mkdir other && chmod 777 other
    fake other setpriv --reuid 65534 --clear-groups sh -c 'OMPI_ALLOW_RUN_AS_ROOT= exec "$@"' sh <<'END2'
echo "@fracas end 6 1 0 root:$OMPI_ALLOW_RUN_AS_ROOT"
END2
    touch other/count && chmod 666 other/count
    ended other 6 1 '^fracas: root:$'
fi
# Two signals end what the run has left behind.
fake orphan <<'END2'
echo '@fracas progress 4 1 0 0 0.5'
sleep 1000 > /dev/null 2>&1 &
echo $! > orphan
END2
has_started() { [ -s orphan/orphan ] && grep -q . orphan/count; }
has_taken_it() { ! grep -q '^ShdPnd:.*[4-7c-f]...$' "/proc/$run/status"; } # SIGTERM pends no more
await 'start of orphan' has_started
run=$(pgrep -P "$(cat orphan/pid)" -f -- '--study study')
kill -TERM "$run"
await 'end of the first signal' has_taken_it
kill -TERM "$run"
ended orphan 3 1 'stopped at once: what was done is kept'
kill -0 "$(cat orphan/orphan)" 2> /dev/null && fail "orphan: a process of the run is left"

ended noise 6 3 '^fracas: mpirun ended with status 1 before the run was over; the ranks were started 3 times, the last 3 in vain' '^0\{9000\}'
ended again 6 4 'mpirun died of signal 9 (Killed); the ranks are started again' 'in use; the ranks are started again' '^two$' '^fracas: enough'
ended in-use 4 1 '^fracas: in use'
ended hopeless 6 3 '^fracas: Open MPI has no component `nonexist` of `btl`'
ended missing 6 1 '^fracas: there is no mpirun; install Open MPI'
ended beside 6 1 '^fracas: enough'
ended pipe 6 1 '^fracas: heard'
ended ignoring 6 1 '^fracas: enough'
