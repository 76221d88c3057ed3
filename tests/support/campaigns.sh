# For shell tests that run campaigns; sourced with the build folder in $1, and yes in $2 to compare compilers.
# Works in a folder of its own, $work.
set -eu
for_compilers=${2-}
fracas=$(cd "$1" && pwd)/fracas
# shellcheck disable=SC2034 # used by the scripts that source this
faulty=$(dirname "$fracas")/faulty/fracas # with faults on request (faulty_solve.c)
source=$(pwd)
work=$(mktemp -d)
trap 'status=$?; kill_session; rm -rf "$work"; exit $status' EXIT
cd "$work"
session= # of the run in the background, if there is one
case ${FRACAS_MPIRUN:-0} in # by what this test's runs start their ranks
0) starter=fracas-starter ;;
*) starter=mpirun ;;
esac

fail()
{
    echo "FAILED: $*" >&2
    exit 1
}

# campaign FILE REPLICAS RATES: two or three seconds of one core at most; several fragments in each realization.
campaign()
{
    cat > "$1" <<END
name: small
seed: 7
model: bar
geometry: {ends: periodic, length: 10 mm, area: 1 mm2}
mesh: {elements: 500}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: quiet, end: 300 ns, quiet: 50 ns, safety: 0.25}
sweep:
  - loading.rate: [$3]
replicas: $2
output: {history: 20, interfaces: true}
END
}

# expect STATUS COMMAND...: what the command says goes to $work/said.
expect()
{
    expected=$1
    shift
    status=0
    ("$@") > said 2>&1 || status=$?
    [ $status -eq "$expected" ] || { cat said >&2; fail "status $status instead of $expected: $*"; }
}

said()
{
    grep -q "$1" said || { cat said >&2; fail "it should have said: $1"; }
}

same()
{
    cmp "$1/study.h5" "$2/study.h5" || fail "$1 and $2 differ"
}

segments()
{
    ls "$1/segments" 2>/dev/null | grep -c '\.h5$' || true
}

# start ARGUMENTS...: fracas run in the background, in a session of its own.
start()
{
    : > background
    setsid "${program:-$fracas}" run "$@" > background 2>&1 &
    session=$!
}

# hold: from now on runs of `start` and of $faulty compute only while a wait below lets them. Whatever is signalled, killed or read behind
# the wait finds the run in the middle, on a machine of any speed. `release` lets it go on.
hold()
{
    release
    : > "$work/gate.arrived"
    : > "$work/gate"
    export FRACAS_TEST_GATE="$work/gate"
    program=$faulty
}

release()
{
    rm -f "$work/gate"
    program=
}

# finish: the status of the run in the background, let go on to its end, in $status.
finish()
{
    release
    status=0
    wait "$session" || status=$?
    session=
}

# drain: finish of a held run that has got a signal. What it computes goes on every half second, so that the signal has many of them to
# pass from process to process before all is computed.
drain()
{
    until is_over; do
        cat "$work/gate.arrived" > "$work/gate"
        sleep 0.5
    done
    finish
}

# is_over: there is a run in the background, and it has ended.
is_over()
{
    [ -n "$session" ] && [ -z "$(processes)" ] && ! grep -q '^State:.[^Z]' "/proc/$session/status" 2>/dev/null
}

# await WHAT COMMAND...: until the command succeeds; the batches that wait at the gate then may go on, if there is one. WHAT could not be
# had where the run in the background is over or five minutes have passed.
await()
{
    awaited=$1
    shift
    since=$(date +%s) polls=0
    until "$@"; do
        polls=$((polls + 1))
        if [ $((polls % 100)) -eq 0 ]; then
            ! is_over || "$@" || { cat background >&2; fail "the run is over; there was no $awaited"; }
            [ $(($(date +%s) - since)) -lt 300 ] || { cat background >&2; fail "no $awaited within 300 s"; }
        fi
        [ ! -e "$work/gate" ] || cat "$work/gate.arrived" > "$work/gate"
        sleep 0.01
    done
}

# busy TIME: how many seconds later than TIME, that of a free machine, a small run ends: the pace of this machine, now.
busy()
{
    campaign pace.yaml 8 '1e5 1/s'
    rm -rf pace
    before=$(date +%s)
    expect 0 "$fracas" run pace.yaml --study pace --jobs 2
    echo $(($(date +%s) - before)) | awk -v free="$1" '{print $1 > free ? $1 - free : 0}'
}

has_segments() { [ "$(segments "$1")" -ge "$2" ]; }
has_checkpoints() { [ "$(find "$1/checkpoints" -name '*-?' 2>/dev/null | wc -l)" -ge "$2" ]; }
has_no_processes() { [ -z "$(processes)" ]; }

# wait_segments STUDY COUNT; wait_checkpoints STUDY COUNT: as many at least.
wait_segments() { await "$2 segments in $1" has_segments "$@"; }
wait_checkpoints() { await "$2 checkpoints in $1" has_checkpoints "$@"; }

# wait_gone WHAT: no process of the session is left.
wait_gone()
{
    await "end of all processes after $1" has_no_processes
}

# Every process of the session: parent, starter, ranks, supervisors, servers, children. Words of stat: 3 state, 6 session, 20 threads
# (one that is a zombie while its other threads still die holds its files, and so the lock).
processes()
{
    cat /proc/[0-9]*/stat 2>/dev/null | sed 's/([^)]*)/x/' |
        awk -v session="$session" '$6 == session && ($3 != "Z" || $20 > 1) {print $1}'
}

# named NAME: those of them that are called so: fracas-supervis, fracas-server, fracas-lease.
named()
{
    for pid in $(processes); do
        { read -r name < "/proc/$pid/comm"; } 2>/dev/null || continue
        [ "$name" != "$1" ] || echo "$pid"
    done
}

# ranks: those of them that the starter has started, by their number (or its place in time).
ranks()
{
    for pid in $(processes); do
        sed 's/(\([^)]*\))/\1/' "/proc/$pid/stat" 2>/dev/null
    done | awk -v starter=$starter '{name[$1] = $2; parent[$1] = $4}
        END {for (p in name) if (name[p] ~ /^fracas/ && name[parent[p]] == starter) print p}' | sort -n
}

kill_session()
{
    [ -n "$session" ] || return 0
    polls=0
    while pids=$(processes) && [ -n "$pids" ]; do
        kill -9 $pids 2>/dev/null || true
        polls=$((polls + 1))
        [ $polls -lt 10000 ] || { echo "processes do not die: $pids" >&2; exit 1; }
    done
    wait "$session" 2>/dev/null || true
    session=
}

# mpirun as a person would start it. What Open MPI leaves allocated at its end is not for a sanitizer of ours.
launch()
{
    if [ "$(id -u)" -eq 0 ]; then
        export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    fi
    ASAN_OPTIONS=detect_leaks=0 exec mpirun --oversubscribe "$@"
}

# random LOW HIGH
random()
{
    echo $(($1 + $(od -An -N2 -tu2 /dev/urandom) % ($2 - $1 + 1)))
}

# compare FILE OPTIONS...: runs the campaign as the study other1, other2 ..., which must be the bytes of the study one; the report of
# these bytes is there.
others=0
compare()
{
    compared=$1
    shift
    others=$((others + 1))
    expect 0 "$fracas" run "$compared" --study "other$others" --no-report "$@"
    same one "other$others"
}

# compare_compilers FILE: where the script was called for it, compares with the program of clang, and ends the script.
compare_compilers()
{
    [ "$for_compilers" = yes ] || return 0
    version=$("$fracas" --version | sed -n 1p)
    fracas=$source/build/clang/fracas
    [ -x "$fracas" ] || { echo "skipped: there is no build/clang/fracas"; exit 77; }
    [ "$("$fracas" --version | sed -n 1p)" = "$version" ] || fail "build/clang has $("$fracas" --version), this is $version: build it again"
    compare "$1" --jobs 2
    exit 0
}

# The instruction sets above baseline of this CPU and this program; what they lack is said on standard error.
instruction_sets()
{
    best=$("$fracas" --version | sed -n 's/^kernels for \([a-z0-9]*\) .*/\1/p')
    case $best in avx512) echo avx2 avx512 ;; avx2) echo avx2 ;; esac
    [ "$best" = avx512 ] || echo "skipped: this CPU or this program has no avx512" >&2
}
