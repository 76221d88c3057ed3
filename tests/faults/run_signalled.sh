# ctest-labels: storm
# ctest-timeout: 1800
# Every signal that asks for an end, once and twice, from the first instant of a run to its last: status 3, or 0 where it was done
# anyway; nothing is left running, and the same command goes on to the bytes of an undisturbed run. And MPI that hangs at its end.
. tests/support/campaigns.sh

campaign small.yaml 20 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run small.yaml --study undisturbed --jobs 2

# What the whole takes, s: its last tenth is the merge and the end.
began=$(date +%s.%N)
expect 0 "$fracas" run small.yaml --study study --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
whole=$(echo "$began $(date +%s.%N)" | awk '{print $2 - $1}')

# one SIGNALS SECONDS KILL: signals after that time; KILL: a rank is killed just before, so that MPI is being started again.
interrupted=0 over=0
one()
{
    rm -rf study
    start small.yaml --study study --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    sleep "$2"
    if [ -n "$3" ]; then
        kill -9 $(cat /proc/[0-9]*/stat 2>/dev/null | awk -v session="$session" '
            {name[$1] = $2; parent[$1] = $4; of[$1] = $6}
            END {for (p in name) if (of[p] == session && name[p] ~ /^\(fracas/ && name[parent[p]] == "(mpirun)") {print p; exit}}') \
            2>/dev/null || true
        sleep "0.$(random 0 6)$(random 0 9)"
    fi
    for signal in $1; do
        kill -"$signal" "$session" 2>/dev/null || true
    done
    status=0
    wait "$session" || status=$?
    left=$(processes)
    session=
    [ -z "$left" ] || fail "signals $1 after $2 s: processes outlive the run: $left"
    case $status in
    3) interrupted=$((interrupted + 1)) ;;
    0) over=$((over + 1)); same undisturbed study ;;
    *) cat background >&2; fail "signals $1 after $2 s: status $status" ;;
    esac
}

resumed()
{
    expect 0 "$fracas" run small.yaml --study study --jobs 2
    same undisturbed study
}

# The program itself has come up after some hundredths of a second; a signal before that ends it as any program.
for signals in INT TERM HUP USR1 USR2 'INT INT' 'TERM TERM' 'HUP TERM' 'USR1 USR1' 'USR2 USR1' 'USR1 INT'; do
    for instant in 0.1 0.2 0.35 0.5 0.8 1.2; do
        one "$signals" $instant ''
        resumed
    done
    for part in 0.85 0.9 0.95 1; do
        one "$signals" "$(echo "$whole $part" | awk '{print $1*$2}')" ''
        resumed
    done
    for instant in 0.4 0.7; do
        one "$signals" $instant kill
        resumed
    done
done
echo "$interrupted interrupted, $over done anyway"
[ $interrupted -ge 20 ] || fail "too few were interrupted"

# SIGUSR1 and SIGUSR2, however often, drain and do not stop at once.
start small.yaml --study patient --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments patient 2
for signal in USR1 USR2 USR1 USR2; do kill -$signal "$session" 2>/dev/null || true; done
status=0
wait "$session" || status=$?
session=
grep -q 'interrupted: [0-9]* of 40 realizations are done' background || { cat background >&2; fail "it did not drain"; }

# Under the user's own mpirun: the ranks take USR1 and USR2.
for signal in USR1 USR2; do
    tries=0
    while :; do
        rm -rf direct
        launch -n 2 "$fracas" run small.yaml --study direct --lanes 1 --lease-time 0 --segment-size 1e-6 > background 2>&1 &
        session=$!
        wait_segments direct 2
        kill -$signal "$session" 2>/dev/null || true
        status=0
        wait "$session" || status=$?
        session=
        [ $status -ne 3 ] || break
        tries=$((tries + 1))
        [ $tries -lt 20 ] || { cat background >&2; fail "$signal under mpirun: status $status"; }
    done
    expect 0 "$fracas" run small.yaml --study direct --jobs 2
    same undisturbed direct
done

# Rank 0 has said its last word, and MPI hangs: the verdict stands.
mkdir hang
printf '#!/bin/sh\n"%s" "$@"\nexec sleep 1000\n' "$(command -v mpirun)" > hang/mpirun
chmod +x hang/mpirun
began=$(date +%s)
expect 0 env PATH="$PWD/hang:$PATH" "$fracas" run small.yaml --study hung --jobs 2
[ $(($(date +%s) - began)) -lt 500 ] || fail "it waited for MPI"
same undisturbed hung
