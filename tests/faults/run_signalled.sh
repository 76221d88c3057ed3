# ctest-labels: storm
# ctest-mpirun
# ctest-timeout: 1800
# Every signal that asks for an end, once and twice, from the first instant of a run to its last: status 3, or 0 where it was done
# anyway, or the signal's own at the very end; nothing is left running, and the same command goes on to the bytes of an undisturbed run. And MPI that hangs at its end.
. tests/support/campaigns.sh

campaign small.yaml 20 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2

# reached STAGE: whether the run in the background is so far: its study is there, its starter, servers, so many segments, all segments, or
# the ranks are started again.
reached()
{
    case $1 in
    study) [ -e study ] ;;
    starter) [ -n "$(named $starter)" ] ;;
    servers) [ -n "$(named fracas-server)" ] ;;
    again) grep -q 'the ranks are started again' background ;;
    end) [ -e study/study.h5 ] ;;
    *) [ "$(segments study)" -ge "$1" ] ;;
    esac
}

# until_reached STAGE: or the run is over.
until_reached()
{
    until reached "$1" || ! grep -q '^State:.[^Z]' "/proc/$session/status" 2>/dev/null; do :; done
}

# one SIGNALS STAGE KILL: signals at that stage; KILL: a rank is killed there, and the signals meet the next start.
interrupted=0 over=0 again=0
one()
{
    rm -rf study
    start --no-report small.yaml --study study --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    until_reached "$2"
    if [ -n "$3" ]; then
        kill -9 "$(ranks | head -n 1)" 2>/dev/null || true
        until_reached again
        ! reached again || again=$((again + 1))
    fi
    for signal in $1; do
        kill -"$signal" "$session" 2>/dev/null || true
    done
    status=0
    wait "$session" || status=$?
    left=$(processes)
    session=
    [ -z "$left" ] || fail "signals $1 at $2: processes outlive the run: $left"
    case $status in
    3) interrupted=$((interrupted + 1)) ;;
    0) over=$((over + 1)); same undisturbed study ;;
    129 | 130 | 138 | 140 | 143) # at the very end, after the launcher has put the signals back
        case $2 in 39 | 40 | end) ;; *) fail "signals $1 at $2: status $status" ;; esac
        over=$((over + 1))
        same undisturbed study
        ;;
    *) cat background >&2; fail "signals $1 at $2: status $status" ;;
    esac
}

resumed()
{
    expect 0 "$fracas" run --no-report small.yaml --study study --jobs 2
    same undisturbed study
}

for signals in INT TERM HUP USR1 USR2 'INT INT' 'TERM TERM' 'HUP TERM' 'USR1 USR1' 'USR2 USR1' 'USR1 INT'; do
    for stage in study starter servers 1 10 25 39 40 end; do
        one "$signals" $stage ''
        resumed
    done
    for stage in servers 2; do
        one "$signals" $stage kill
        resumed
    done
done
echo "$interrupted interrupted, $over done anyway"
[ $interrupted -ge 20 ] || fail "too few were interrupted"

# SIGUSR1 and SIGUSR2, however often, drain and do not stop at once.
hold
start --no-report small.yaml --study patient --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments patient 2
for signal in USR1 USR2 USR1 USR2; do kill -$signal "$session"; done
drain
grep -q 'interrupted: [0-9]* of 40 realizations are done' background || { cat background >&2; fail "it did not drain"; }

# Under the user's own mpirun: the ranks take USR1 and USR2.
for signal in USR1 USR2; do
    rm -rf direct
    hold
    launch -n 2 "$faulty" run --no-report small.yaml --study direct --lanes 1 --lease-time 0 --segment-size 1e-6 > background 2>&1 &
    session=$!
    wait_segments direct 2
    kill -$signal "$session"
    drain
    [ $status -eq 3 ] || { cat background >&2; fail "$signal under mpirun: status $status"; }
    expect 0 "$fracas" run --no-report small.yaml --study direct --jobs 2
    same undisturbed direct
done

# Rank 0 has said its last word, and MPI hangs: the verdict stands.
mkdir hang
printf '#!/bin/sh\n"%s" "$@"\nexec sleep 1000\n' "$(command -v mpirun)" > hang/mpirun
chmod +x hang/mpirun
began=$(date +%s)
expect 0 env FRACAS_MPIRUN=1 PATH="$PWD/hang:$PATH" "$fracas" run --no-report small.yaml --study hung --jobs 2
[ $(($(date +%s) - began)) -lt 500 ] || fail "it waited for MPI"
same undisturbed hung
