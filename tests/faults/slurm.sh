# ctest-labels: storm
# ctest-timeout: 1200
# A cluster of Slurm in this test: munged, slurmctld, two slurmd. A job of `fracas submit` runs over both nodes, is preempted twice (as
# Slurm does by itself: SIGTERM to the ranks; and with the job's own signal sent), ends for lack of time, and goes on each time when it is
# queued again, to the bytes of an undisturbed run on this machine alone.
. tests/support/campaigns.sh

PATH=$PATH:/usr/sbin:/sbin
for program in munged slurmctld slurmd sbatch squeue scontrol setpriv bash; do
    command -v $program > /dev/null || { echo "skipped: there is no $program (packages slurm-wlm, munge)"; exit 0; }
done

# ---- the cluster ----

export SLURM_CONF="$work/slurm.conf"
daemons=

# Whatever was started with this cluster's configuration: daemons, steps, jobs.
of_cluster()
{
    env -u SLURM_CONF grep -lsazF "SLURM_CONF=$SLURM_CONF" /proc/[0-9]*/environ 2>/dev/null | env -u SLURM_CONF sed 's|/proc/\([0-9]*\)/.*|\1|' || true
}

end_cluster()
{
    tries=0
    while pids=$(of_cluster) && [ -n "$pids" ] && [ $tries -lt 100 ]; do
        kill -9 $pids 2>/dev/null || true
        tries=$((tries + 1))
        sleep 0.05
    done
    [ -z "$pids" ] || echo "still there: $pids" >&2
}
trap 'status=$?; end_cluster; rm -rf "$work"; exit $status' EXIT
trap 'exit 1' INT TERM HUP

# daemon COMMAND...: in the background; it dies with this script.
daemon()
{
    setpriv --pdeathsig KILL "$@" > "log/$1.$daemons" 2>&1 &
    daemons="$daemons.$!"
}

cannot()
{
    grep -hiE 'error|fatal' log/* munge/log 2>/dev/null | tail -n 5
    echo "skipped: Slurm does not run here (above: why): $1"
    exit 0
}

chmod 755 "$work"
mkdir -p log munge state spool-node1 spool-node2 tmp-node1 tmp-node2
port=$(random 12000 30000)
user=$(id -un)
head -c 1024 /dev/urandom > munge/key
chmod 600 munge/key
cat > slurm.conf <<END
ClusterName=fracas
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
TmpFS=$work/tmp-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/log/slurmctld
SlurmdLogFile=$work/log/slurmd-%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,bf_interval=2
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
JobRequeue=1
KillWait=5
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=node[1-2] NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=2 RealMemory=1000
PartitionName=low Nodes=node[1-2] Default=YES MaxTime=INFINITE State=UP PriorityTier=1 GraceTime=15
PartitionName=high Nodes=node[1-2] MaxTime=INFINITE State=UP PriorityTier=10
END
daemon munged --foreground --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
    --log-file="$work/munge/log" --seed-file="$work/munge/seed"
tries=0
until [ -S munge/socket ]; do
    tries=$((tries + 1))
    [ $tries -lt 100 ] || cannot munged
    sleep 0.1
done
daemon slurmctld -D -i
daemon slurmd -D -N node1
daemon slurmd -D -N node2
tries=0
until [ "$(sinfo -h -N -p low -o %T 2>/dev/null | grep -c idle)" -eq 2 ]; do
    tries=$((tries + 1))
    [ $tries -lt 300 ] || cannot "the nodes do not come up: $(sinfo -h -N 2>&1 | tr '\n' ' ')"
    sleep 0.1
done

# ---- the job ----

# Both nodes are this machine, and Open MPI names the memory that ranks of a node share after the machine.
export OMPI_MCA_btl=self,tcp

state() { squeue -h -j "$job" -o %T 2>/dev/null || true; }
starts() { grep -c "^fracas: job $job on" long.out || true; }

# until WHAT COMMAND...: the command is true, within some minutes.
until_true()
{
    what=$1
    shift
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ $tries -lt 1200 ] || { cat long.out; squeue; tail -n 20 log/slurmctld; fail "never: $what"; }
        sleep 0.1
    done
}
more_segments() { [ "$(segments study)" -ge "$1" ]; }
in_state() { [ "$(state)" = "$1" ]; }

# Nodes of the job's ranks, each "RANK NODE".
ranks()
{
    for environment in /proc/[0-9]*/environ; do
        tr '\0' '\n' < "$environment" 2>/dev/null | awk -F= -v study=1 '
            $1 == "OMPI_COMM_WORLD_RANK" {rank = $2} $1 == "SLURMD_NODENAME" {node = $2} $1 == "SLURM_JOB_ID" {job = $2}
            END {if (rank != "" && job == "'"$job"'") print rank, node}' || true
    done 2>/dev/null | sort -u
}
four_ranks() { [ "$(ranks | wc -l)" -eq 4 ]; }

# preempted: by a short job of the other partition; until this one is queued again.
preempted()
{
    sbatch -p high -N2 --exclusive -o high.out --wrap 'sleep 1' > /dev/null
    until_true "queued again" in_state PENDING
    echo "start $(starts): $(date +%T) queued again, $(squeue -h -j "$job" -o '%r until %S'); $(segments study) segments"
}

# Slurm waits two minutes before it starts a job again; nobody needs to wait for that here, only for its nodes to have forgotten the job.
at_once()
{
    sleep 5
    now=$(starts)
    until_true "the other job over" sh -c '[ -z "$(squeue -h -p high)" ]'
    scontrol update "jobid=$job" StartTime=now || true # it may have started
    until_true "started again" sh -c '[ "$(grep -c "^fracas: job '"$job"' on" long.out)" -gt '"$now"' ]'
}

campaign long.yaml 3000 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run long.yaml --study undisturbed --jobs 2
expect 0 "$fracas" submit long.yaml --nodes 2 --time 1m --signal-lead 5 --output long.out --study study --lanes 1 --lease-time 0.1 \
    --segment-age 0.5 --submit
job=$(cat said)
until_true "a first segment" more_segments 1
until_true "four ranks" four_ranks
[ "$(ranks | tr '\n' ' ')" = '0 node1 1 node1 2 node2 3 node2 ' ] || fail "ranks: $(ranks)"
echo "ranks: $(ranks | tr '\n' ';')"
until_true "segments" more_segments 10
preempted
at_once

# With the job's own signal sent when it is preempted (a setting of the cluster), it drains, and queues itself.
sed -i 's/^JobRequeue.*/&\nSlurmctldParameters=preempt_send_user_signal/' slurm.conf
scontrol reconfigure
until_true "segments" more_segments $(($(segments study) + 20))
drained=$(grep -c '^fracas: interrupted: .* are done and kept' long.out || true)
preempted
[ "$(grep -c '^fracas: interrupted: .* are done and kept' long.out)" -gt "$drained" ] || { cat long.out; fail "it did not drain"; }
! grep -q 'cannot be\|could not be queued' long.out || fail "it did not queue itself"
at_once

# To the end, through the minute that it has each time.
over() { [ -z "$(squeue -h)" ]; }
tries=0
until over; do
    tries=$((tries + 1))
    [ $tries -lt 5000 ] || { cat long.out; fail "it does not end"; }
    [ "$(state)" != PENDING ] || at_once
    sleep 0.2
done
grep -vE '^(warning|[ 0-9]* of .* realizations done)' long.out
echo "$(starts) starts"
[ "$(starts)" -ge 3 ] || fail "it was not queued again"
same undisturbed study
expect 0 "$fracas" verify study
scontrol show job "$job" 2>/dev/null | grep -E 'JobState|Restarts' || true
