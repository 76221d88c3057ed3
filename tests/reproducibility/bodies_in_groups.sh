# One body on several hosts, which are processes of this machine that say so: study.h5 is the same, byte for byte, for groups of one, two
# and three, after the death of a helper, of the process that leads, or of all, and a resume by others.
# ctest-labels: ci
. tests/support/campaigns.sh
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

cat > body.yaml <<END
name: body
seed: 5
model: shell
geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.2 mm}
mesh: {divisions: 24, amplitude: 0.1}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 100 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 3e4 1/s}
time: {end: 0.6 us}
replicas: 1
output: {history: 20, interfaces: true}
END

# begin HOSTS STUDY OPTIONS...: one worker on each host, in the background.
begin()
{
    hosts=$1 study=$2 all=
    shift 2
    for host in $(seq "$hosts"); do
        all="$all : -n 1 --bind-to none env FRACAS_TEST_HOST=host-$host $faulty run body.yaml --study $study $*"
    done
    # shellcheck disable=SC2086 # words
    ASAN_OPTIONS=detect_leaks=0 setsid mpirun --oversubscribe ${all#" :"} > "$study.said" 2>&1 &
    session=$!
}

# end_well STUDY HELPED: it ends with the bytes of the study `one`, after so many helpers at least went on to the end.
end_well()
{
    finish
    [ $status -eq 0 ] || fail "$(cat "$1.said")"
    same one "$1"
    [ "$(helped "$1" 'to the end')" -ge "$2" ] || fail "$1: not $2 helpers: $(helped "$1" '')"
}

# helped STUDY HOW
helped()
{
    /usr/bin/python3 - "$1/index.sqlite" "$2" <<'END'
import sqlite3, sys
rows = sqlite3.connect(sys.argv[1]).execute("SELECT text FROM event WHERE kind = 'helped'").fetchall()
print(sum(sys.argv[2] in text for text, in rows))
END
}

# wait_group COUNT STUDY: its processes compute together: their start left a checkpoint. Sets first and last, the numbers of two.
wait_group()
{
    wait_checkpoints "$2" 1
    await "$1 processes that compute $2" has_processes "$1"
    group=$(named fracas-lease | sort -n)
    first=$(echo "$group" | head -n 1) last=$(echo "$group" | tail -n 1)
}

has_processes() { [ "$(named fracas-lease | wc -l)" -ge "$1" ]; }

expect 0 "$fracas" run body.yaml --study one --jobs 1
h5dump -d /realization/broken one/study.h5 | grep -q '(0): [1-9][0-9]*$' || fail "nothing broke"
begin 3 three
end_well three 1 # the third may be late on a busy machine

# The first of its processes leads.
begin 2 helper-killed
wait_group 2 helper-killed
kill -9 "$last"
end_well helper-killed 0
[ "$(helped helper-killed 'its process died')" -eq 1 ] || fail "no helper died"
begin 2 leader-killed
wait_group 2 leader-killed
kill -9 "$first"
end_well leader-killed 0
[ "$(helped leader-killed 'is gone')" -eq 1 ] || fail "the helper did not notice"

begin 2 killed
wait_group 2 killed
kill_session
[ ! -e killed/study.h5 ] || fail "it was over before it was killed"
expect 0 env FRACAS_TEST_HOST=host-1 "$faulty" run body.yaml --study killed --jobs 1
same one killed
echo "groups of one, two and three, deaths of helpers and leaders, and a resume alone: the same bytes"
