# For shell tests of power cuts (docs/decisions/power-loss.md); sourced after campaigns.sh, with the build folder in $1.
# Works in memory where there is room.
recorder=$(dirname "$fracas")/tests/disk_recorder.so
power_loss=$(dirname "$fracas")/tests/power_loss
if [ -w /dev/shm ] && [ "$(df -Pk /dev/shm | awk 'NR == 2 {print $4}')" -gt 1000000 ]; then
    memory=$(mktemp -d /dev/shm/fracas-power.XXXXXX)
    trap 'status=$?; kill_session; rm -rf "$memory" "$work"; exit $status' EXIT
    cd "$memory"
fi
segment_each="--lanes 1 --lease-time 0 --segment-size 1e-6"

# tiny FILE REPLICAS RATES: milliseconds for each realization.
tiny()
{
    campaign "$1" "$2" "$3"
    sed -i -e 's/elements: 500/elements: 20/' -e 's/time: .*/time: {stop: quiet, end: 30 ns, quiet: 5 ns, safety: 0.25}/' \
        -e 's/history: 20/history: 2/' "$1"
}

# tape NAME: begins the log NAME.log of the folder NAME, where the commands of `recorded` have their studies.
tape()
{
    log=$(pwd -P)/$1.log
    tape=$(pwd -P)/$1
    mkdir -p "$tape"
    "$power_loss" begin "$log" "$tape"
}

# recorded COMMAND...
recorded()
{
    (
        export DISK_LOG="$log" DISK_ROOT="$tape" LD_PRELOAD="$recorder"
        exec "$@"
    )
}

# recorded_until SEGMENTS STUDY COMMAND...: ends all processes by kill -9 when the study has so many segments.
recorded_until()
{
    wanted=$1
    study=$2
    shift 2
    DISK_LOG="$log" DISK_ROOT="$tape" LD_PRELOAD="$recorder" setsid "$@" > background 2>&1 &
    session=$!
    wait_segments "$study" "$wanted"
    while pids=$(processes) && [ -n "$pids" ]; do "$power_loss" kill "$log" $pids; done
    wait "$session" 2>/dev/null || true
    session=
}

# states NAME CAMPAIGN REFERENCE COUNT SEED JOBS [COMMAND]: states of NAME/study by its log, opened; or ended by the command.
states()
{
    name=$1 judge=$2 reference=$3 count=$4 seed=$5 jobs=$6
    shift 6
    way=storm
    [ $# -eq 0 ] || way=resume
    mkdir -p states
    status=0
    "$power_loss" $way "$name.log" study "$(pwd)/$judge" "$(pwd)/$reference" "$(pwd)/states" "$count" "$seed" "$jobs" "$@" > told || status=$?
    rm -rf states
    sed "s/^/$name: /" told
    return $status
}

# ---- campaigns ----

# A bar: killed twice, resumed and extended. To be judged by bar-long.yaml.
record_bar()
{
    tiny bar.yaml 8 '1e5 1/s'
    tiny bar-long.yaml 14 '1e5 1/s'
    expect 0 "$fracas" run bar-long.yaml --study whole-bar --jobs 2
    tape bar
    recorded_until 2 bar/study "$fracas" run bar.yaml --study bar/study --jobs 2 $segment_each
    recorded_until 5 bar/study "$fracas" run bar.yaml --study bar/study --jobs 3 $segment_each
    expect 0 recorded "$fracas" run bar.yaml --study bar/study --jobs 2 $segment_each
    expect 0 recorded "$fracas" extend bar/study --replicas 14 --jobs 2 $segment_each
    same bar/study whole-bar
}

# A rule for replicas, and a FAILED realization.
record_rule()
{
    tiny rule.yaml 8 '3e4 1/s, 1e5 1/s'
    sed -i 's/^replicas: .*/replicas: {minimum: 8, maximum: 24, until: {quantity: mean-count, relative-half-width: 0.015, confidence: 0.95}}/' rule.yaml
    expect 1 env FRACAS_TEST_FAULT=crash:0:1 "$faulty" run rule.yaml --study whole-rule --jobs 2
    tape rule
    expect 1 recorded env FRACAS_TEST_FAULT=crash:0:1 "$faulty" run rule.yaml --study rule/study --jobs 2 $segment_each
    same rule/study whole-rule
}

# Surfaces and strengths from a file, on a filesystem of the network; killed once.
record_surfaces()
{
    {
        cat "$source/tests/data/campaigns/membrane.yaml"
        echo 'output: {interfaces: true}'
    } > surfaces.yaml
    awk 'BEGIN {for (i = 0; i < 84; i++) print 2.9e8 + 1e6 * i}' > strengths.csv
    sed -i -e 's/^strength: .*/strength: {distribution: file, file: strengths.csv}/' -e 's/^replicas: .*/replicas: 8/' surfaces.yaml
    expect 0 "$fracas" run surfaces.yaml --study whole-surfaces --jobs 2
    tape surfaces
    export DISK_NETWORK=1
    recorded_until 3 surfaces/study "$fracas" run surfaces.yaml --study surfaces/study --jobs 2 $segment_each
    expect 0 recorded "$fracas" run surfaces.yaml --study surfaces/study --jobs 2 $segment_each
    unset DISK_NETWORK
    same surfaces/study whole-surfaces
}

# A bar with an index of many pages, and one command after the other: half of it from another study, some rows more, the index
# made anew, rows again, tidied up. To be judged by upkeep-long.yaml.
record_upkeep()
{
    tiny upkeep.yaml 300 '1e5 1/s'
    tiny upkeep-long.yaml 304 '1e5 1/s'
    expect 0 "$fracas" run upkeep-long.yaml --study whole-upkeep --jobs 2
    expect 3 "$fracas" run upkeep.yaml --study upkeep/study --part 1/2 --jobs 2
    expect 3 "$fracas" run upkeep.yaml --study upkeep/other --part 2/2 --jobs 2
    tape upkeep
    expect 0 recorded "$fracas" merge-studies upkeep/study upkeep/other
    expect 0 recorded "$fracas" merge upkeep/study
    expect 0 recorded "$fracas" extend upkeep/study --replicas 302 --jobs 1 $segment_each
    expect 0 recorded "$fracas" reindex upkeep/study
    expect 0 recorded "$fracas" extend upkeep/study --replicas 304 --jobs 1 $segment_each
    expect 0 recorded "$fracas" merge upkeep/study
    expect 0 recorded "$fracas" gc upkeep/study
    same upkeep/study whole-upkeep
}

# Checkpoints of a bar, which is killed once and goes on from them.
record_long()
{
    tiny long.yaml 6 '1e5 1/s'
    sed -i -e 's/elements: 20/elements: 200/' -e 's/time: .*/time: {stop: time, end: 20 us, safety: 0.25}/' long.yaml
    expect 0 "$fracas" run long.yaml --study whole-long --jobs 2
    tape long
    recorded_until 2 long/study "$fracas" run long.yaml --study long/study --jobs 2 $segment_each --checkpoint-time 0
    expect 0 recorded "$fracas" run long.yaml --study long/study --jobs 2 $segment_each --checkpoint-time 0
    same long/study whole-long
    "$power_loss" list long.log | grep -q " mkdir .* checkpoints" || fail "no checkpoint was written"
}

# A second cut: the run that follows a state of the bar at POINT with SEED. To be judged as the bar.
record_twice()
{
    rm -rf twice
    "$power_loss" build bar.log "$1" "$2" twice
    tape twice
    expect 0 recorded "$fracas" run bar-long.yaml --study twice/study --jobs 2 $segment_each
    same twice/study whole-bar
}
