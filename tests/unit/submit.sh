# ctest-sanitize
# `fracas submit` writes a batch script that says what was asked for, quoted for the shell, and that does the right thing with each
# end of a run. sbatch, squeue, scontrol are stand-ins here, and so are the runs (tests/faults/slurm.sh has the real ones).
. tests/support/campaigns.sh

folder="it's a \$(folder)"
mkdir "$folder"
cd "$folder"
campaign small.yaml 4 '1e5 1/s'

# ---- what is written ----

expect 0 "$fracas" submit small.yaml --nodes 2 --time 1h30m --study 'my "study"' --replicas 40 --isolation none --signal-lead 90 \
    --partition long --account "group b" --tasks-per-node 16 -- --mem=4G --comment 'for x'
said 'small.yaml.sbatch is written; submit it by: sbatch small.yaml.sbatch'
# names FILE: the printed command, pasted, names it.
names()
{
    cp small.yaml "$1"
    expect 0 "$fracas" submit "$1" --time 1h --output out
    printf '%s' "$1.sbatch" > wanted
    bash -c "sbatch() { printf %s \"\$1\"; }; $(sed 's/.*submit it by: //' said)" > got
    cmp wanted got || { cat said; fail "pasted, it is another file: $1"; }
    rm "$1" "$1.sbatch"
}
for name in 'my bar.yaml' "it's" 'a "b" $(c) `d`' '-x*?[y]' '~home' 'back\slash;&|' 'größe'; do names "./$name"; done
bash -n small.yaml.sbatch || fail "bash cannot read it"
for line in '--job-name="small"' '--nodes=2' '--ntasks-per-node=16' '--time=1:30:00' '--signal=B:USR1@90' '--requeue' '--open-mode=append' \
    '--output="small.yaml.%j.out"' '--partition="long"' '--account="group b"' '--mem=4G' '--comment "for x"'; do
    grep -qxF -- "#SBATCH $line" small.yaml.sbatch || { cat small.yaml.sbatch; fail "no line #SBATCH $line"; }
done
grep -q exclusive small.yaml.sbatch && fail "exclusive, though the processes of a node are given"
expect 0 "$fracas" submit small.yaml --time 1h --script other.sbatch
grep -qx '#SBATCH --exclusive' other.sbatch || fail "not the whole node"

# ---- what is refused, before anything is written ----

rm *.sbatch
refused()
{
    why=$1
    shift
    expect 2 "$fracas" submit "$@"
    said "$why"
    [ -z "$(ls *.sbatch 2>/dev/null)" ] || fail "it was written nevertheless: $*"
}
refused 'time is missing' small.yaml
refused 'too short' small.yaml --time 30s
refused 'longer than --signal-lead' small.yaml --time 2m --signal-lead 120
refused 'lanes is `3`' small.yaml --time 1h --lanes 3
refused 'follows from --time' small.yaml --time 1h --walltime 1h
refused 'unknown option' small.yaml --time 1h --walls 1h
refused 'options of another program follow `--`' small.yaml --time 1h --mem=16384
refused 'quotes' small.yaml --time 1h --account 'a"b'
refused 'begin with -' small.yaml --time 1h -- mem
sed 's/elements: 500/elements: -1/' small.yaml > wrong.yaml
refused 'elements' wrong.yaml --time 1h
expect 2 "$fracas" submit small.yaml --time 1h --script small.yaml
said 'is not as `fracas submit` writes it'
expect 0 "$fracas" submit small.yaml --time 1h
expect 0 "$fracas" submit small.yaml --time 2h
grep -q 'time=2:00:00' small.yaml.sbatch || fail "the script is not written again"
sed -i 's/^heard=0/module load gcc; heard=0/' small.yaml.sbatch
expect 2 "$fracas" submit small.yaml --time 1h
said 'small.yaml.sbatch is there already and is not as'
grep -q 'module load gcc' small.yaml.sbatch || fail "what a hand has changed is gone"
# edit SED: any other difference is seen, too.
edit()
{
    rm small.yaml.sbatch
    expect 0 "$fracas" submit small.yaml --time 1h
    sed -i "$1" small.yaml.sbatch
    cp small.yaml.sbatch edited.sbatch
    expect 2 "$fracas" submit small.yaml --time 2h
    said 'small.yaml.sbatch is there already and is not as'
    cmp small.yaml.sbatch edited.sbatch || fail "it was written over the edit: $1"
}
edit '$a module load openmpi'
edit '$G'
edit '$s/$/ # mine/'
edit '$s/.$//'
edit '$a # Checksum of the lines above, by which `fracas submit` knows its own script: 0'
rm small.yaml.sbatch
expect 0 "$fracas" run --no-report small.yaml --study done
expect 5 "$fracas" submit small.yaml --time 1h --study done --replicas 3
said 'replicas'
campaign other.yaml 4 '2e5 1/s'
expect 5 "$fracas" submit other.yaml --time 1h --study done
said 'loading.rate'

# ---- sbatch ----

expect 6 env PATH=/nowhere "$fracas" submit small.yaml --time 1h --submit
said 'there is no sbatch here; the script is written'
mkdir bin
PATH=$PWD/bin:$PATH
cat > bin/sbatch <<'END'
#!/bin/sh
[ "$1" = --parsable ] && [ -e "$2" ] && echo 4711
END
chmod +x bin/sbatch
expect 0 "$fracas" submit small.yaml --time 1h --submit
[ "$(cat said)" = 4711 ] || fail "the job's number: $(cat said)"

# ---- the script at work ----

cat > bin/squeue <<'END'
#!/bin/sh
case "$*" in
*%L*) echo "${LEFT-1-02:00:00}" ;;
*) echo "${STATE-RUNNING}" ;;
esac
END
printf '#!/bin/sh\necho "$@" >> requeued\n' > bin/scontrol
printf '#!/bin/sh\n:\n' > bin/sleep
# A run that says how it was called, and ends with the statuses of the file `ends`, one after the other; on SIGUSR1 with 3.
cat > stand-in <<'END'
#!/bin/bash
[ "$1" = status ] && { echo '  "done": 5,'; exit 0; }
trap 'echo drained >> called; exit 3' USR1
for word; do printf '<%s>' "$word"; done >> called
echo >> called
read -r status < ends
sed -i 1d ends
[ "$status" != wait ] || for ((i = 0; i < 600; i++)); do /bin/sleep 0.05; done
exit "$status"
END
chmod +x bin/* stand-in
expect 0 "$fracas" submit small.yaml --time 1h --study 'my "study"'
sed "s|^program=.*|program='./stand-in'|" small.yaml.sbatch > job.sh

# ends STATUS ENDS...: the job ends so when its runs end so.
ends()
{
    status=$1
    shift
    rm -f called requeued
    printf '%s\n' "$@" > ends
    expect "$status" env SLURM_JOB_ID=7 SLURM_JOB_NODELIST=n bash job.sh
}
called() { [ "$(wc -l < called)" -eq "$1" ] || { cat called; fail "$(wc -l < called) runs instead of $1"; }; }

expect 2 env -u SLURM_JOB_ID bash job.sh
ends 0 0
grep -qxF '<run><small.yaml><--study><my "study"><--walltime><93570s>' called || { cat called; fail "the run's command line"; }
[ ! -e requeued ] || fail "queued again though it is done"
for status in 1 2 5 6 70; do
    ends $status $status
    called 1
    [ ! -e requeued ] || fail "queued again after status $status"
done
ends 3 3
[ "$(cat requeued)" = 'requeue 7' ] || fail "not queued again after an interruption"
ends 0 4 4 0 # a lock that is freed
called 3
ends 4 4 4 4 4 4 4
called 6
LEFT=59:50 ends 0 0
grep -q '<3560s>' called || { cat called; fail "minutes and seconds"; }
LEFT=INVALID ends 0 0
grep -q '<35[0-9]*s>' called || { cat called; fail "the time asked for"; }
for state in COMPLETING CANCELLED ''; do # ended from outside: scancel, or a preemption that is over
    export STATE=$state
    ends 3 3
    [ ! -e requeued ] || fail "queued again though Slurm ended it: $state"
done
unset STATE

# Signals of Slurm reach the run; one that comes often is one.
for signals in USR1 TERM 'USR1 USR1 TERM'; do
    rm -f called requeued
    echo wait > ends
    SLURM_JOB_ID=7 SLURM_JOB_NODELIST=n bash job.sh > said 2>&1 &
    job=$!
    until [ "$(wc -l 2> /dev/null < called)" -gt 0 ] 2> /dev/null; do /bin/sleep 0.01; done
    for signal in $signals; do kill -$signal $job; done
    status=0
    wait $job || status=$?
    [ $status -eq 3 ] || { cat said; fail "status $status after $signals"; }
    grep -q drained called || fail "$signals did not reach the run"
    [ "$(cat requeued)" = 'requeue 7' ] || fail "not queued again after $signals"
done
