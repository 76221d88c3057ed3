
[ -n "$SLURM_JOB_ID" ] || { echo "fracas: this is a batch script: sbatch $0" >&2; exit 2; }
echo "fracas: job $SLURM_JOB_ID on $SLURM_JOB_NODELIST, start $((${SLURM_RESTART_COUNT:-0} + 1)), $(date)" >&2

# Seconds until Slurm ends the job.
left() {
    local text days=0 a b c
    text=$(squeue -h -j "$SLURM_JOB_ID" -o %L 2>/dev/null)
    case $text in *-*) days=${text%%-*} text=${text#*-} ;; esac
    IFS=: read -r a b c <<<"$text"
    [ -n "$c" ] || { c=$b b=$a a=0; }
    if [[ $days:$a:$b:$c =~ ^[0-9]+:[0-9]+:[0-9]+:[0-9]+$ ]]; then
        echo $((((10#$days * 24 + 10#$a) * 60 + 10#$b) * 60 + 10#$c))
    else
        echo $((time - SECONDS))
    fi
}

# Realizations that are done.
count() { "$program" status "$study" --json 2>/dev/null | sed -n 's/.*"done": *\([0-9]*\).*/\1/p' | head -n 1; }

# Slurm signals this shell, which has the run drain: USR1 before the time is over or the job preempted, TERM when it is ended.
heard=0 pid=
drain() { heard=$((heard + 1)); [ -z "$pid" ] || kill -USR1 "$pid" 2>/dev/null; }
trap drain USR1 TERM

# Another run may hold the study: one before this, whose node died or is being cleared.
before=$(count)
for try in 1 2 3 4 5 6; do
    status=3
    [ "$heard" -eq 0 ] || break
    seconds=$(left)
    margin=$((seconds / 10 < 30 ? seconds / 10 : 30))
    [ "$seconds" -gt 10 ] || break
    "$program" "${run[@]}" --walltime "$((seconds - margin))s" &
    pid=$!
    [ "$heard" -eq 0 ] || kill -USR1 "$pid"
    seen=-1 status=255
    while [ "$status" -gt 128 ] && [ "$seen" -ne "$heard" ]; do # a wait that a signal cut short
        seen=$heard
        wait "$pid"
        status=$?
    done
    pid=
    [ "$status" -le 128 ] || [ "$heard" -eq 0 ] || status=3
    [ "$status" -eq 4 ] || break
    sleep 20 &
    wait $!
done

[ "$status" -eq 3 ] || exit "$status"
state=$(squeue -h -j "$SLURM_JOB_ID" -o %T 2>/dev/null)
case $state in
COMPLETING | CANCELLED | '') echo 'fracas: Slurm has ended this job: it comes again only where Slurm queues it again' >&2; exit 3 ;;
esac
if [ "$SECONDS" -gt $((time / 2)) ] && [ "$(count)" = "$before" ]; then
    echo "fracas: nothing was finished in $SECONDS s: give the job more time; it is not queued again" >&2
    exit 3
fi
# Never status 0 here: a job that is being preempted would count as completed, and would not come again.
scontrol requeue "$SLURM_JOB_ID" || echo "fracas: the job could not be queued again; by hand: sbatch $script" >&2
exit 3
