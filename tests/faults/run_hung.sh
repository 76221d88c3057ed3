# ctest-serial
# ctest-mpirun: storm
# A walltime holds, whatever hangs: status 3 before it is over, resumable. A busy machine may be late by its pace.
. tests/support/campaigns.sh

# within SECONDS STATUS COMMAND...
within()
{
    limit=$1
    shift
    began=$(date +%s)
    expect "$@"
    took=$(($(date +%s) - began))
    [ $took -le "$limit" ] || [ $took -le $((limit + $(busy 2))) ] || fail "$took s instead of $limit: $*"
}

campaign small.yaml 20 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2
mkdir silent
printf '#!/bin/sh\nexec sleep 1000\n' > silent/mpirun
chmod +x silent/mpirun

# MPI that never comes up.
within 3 3 env FRACAS_MPIRUN=1 PATH="$PWD/silent:$PATH" "$fracas" run --no-report small.yaml --study late --walltime 3s
said 'walltime is over.*same command goes on'

# Compute servers that stand still: the run cannot drain, and is killed.
hold
start --no-report small.yaml --study still --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6 --walltime 8s
began=$(date +%s)
wait_segments still 2
servers="$(named fracas-supervis) $(named fracas-server) $(named fracas-lease)"
[ -n "$(named fracas-server)" ] || fail "there are no servers"
kill -STOP $servers 2>/dev/null || true # processes of leases come and go
finish
took=$(($(date +%s) - began))
[ $status -eq 3 ] || { cat background >&2; fail "status $status of a run that stood still"; }
[ $took -le 8 ] || [ $took -le $((8 + $(busy 2))) ] || fail "$took s with a walltime of 8 s"
[ -z "$(processes)" ] || fail "processes outlive the run: $(processes)"
session=
expect 0 "$fracas" status still
said ', 0 leased, ' # what was given out is to be computed
expect 0 "$fracas" run --no-report small.yaml --study still
same undisturbed still
