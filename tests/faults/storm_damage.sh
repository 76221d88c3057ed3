# 1000 damages (flipped bits, bytes, cuts, zeros, bytes more, no file) of every kind of file of a study folder: finished, with fits,
# report and export; with a rule for replicas; with strengths and a mesh from files; interrupted; killed; without its index.
# tests/support/damage.py has the demands on each.
# ctest-labels: storm
# ctest-timeout: 14400
. tests/support/campaigns.sh

campaign small.yaml 40 '3e4 1/s, 1e5 1/s'
sed -i 's/elements: 500/elements: 100/' small.yaml
sed "s|^replicas: .*|replicas: {minimum: 8, maximum: 30, until: {quantity: mean-count, relative-half-width: 3 %, confidence: 0.95}}|" small.yaml > rule.yaml
seq 0 99 | awk '{printf "%d, %d\n", $1, 299e6 + $1 * 37 % 100 * 2e4}' > strengths.csv
cp "$source/tests/data/gmsh/plate-order1-msh41-text.msh" mesh.msh
sed '/^sweep/,$d' small.yaml > files.yaml
cat >> files.yaml <<END
sweep:
  - cases:
      - {name: given, strength: {distribution: file, file: strengths.csv}}
      - name: plate
        model: membrane
        geometry: {shape: file, file: mesh.msh, thickness: 0.1 mm}
        mesh: {spacing: given}
        material: {poisson: 0.25}
        cohesive: {law: camacho-ortiz, fracture_energy: 50 J/m2}
        loading: {type: expansion, rate: 1e3 1/s}
        time: {stop: time, end: 100 us, safety: 0.1}
replicas: 6
output: {history: 20, interfaces: true}
END
options='--jobs 1 --segment-size 1e-6 --lease-time 0.02'

# interrupt STUDY COMMAND...: a run that has three segments, or more, and is not done, after the command.
interrupt()
{
    study=$1
    shift
    tries=0
    while :; do
        rm -rf "$study"
        start small.yaml --study "$study" $options
        wait_segments "$study" 3
        "$@"
        status=0
        wait "$session" || status=$?
        session=
        [ ! -e "$study/study.h5" ] && [ "$status" -ne 0 ] && return
        tries=$((tries + 1))
        [ $tries -lt 20 ] || fail "not interrupted, $tries times"
    done
}

stop()
{
    kill -TERM "$session" 2>/dev/null || true
}

# All at once, so that index.sqlite-wal, index.sqlite-shm and the holder of the lock stay.
kill_all()
{
    kill -9 $(processes) 2>/dev/null || true
}

for study in finished:small ruled:rule files:files; do
    expect 0 "$fracas" run "${study#*:}.yaml" --study "${study%:*}" $options
done
cp -r finished lost
rm -r lost/index.sqlite* lost/study.h5 lost/report # in the middle of nowhere: all segments are orphans
cp -r finished plain
interrupt interrupted stop
options="$options --checkpoint-time 0" # of the leases that were computing: at most every 64 steps
tries=0
while [ -z "$(ls killed/checkpoints 2>/dev/null)" ]; do
    interrupt killed kill_all
    tries=$((tries + 1))
    [ $tries -lt 50 ] || fail "no checkpoint in killed"
done
[ -s killed/index.sqlite-wal ] && [ -s killed/lock ] || fail "nothing to recover in killed"
for study in finished files; do
    expect 0 "$fracas" fit $study --resamples 99
    expect 0 "$fracas" export $study
    expect 0 "$fracas" report $study
done
/usr/bin/python3 "$source/tests/support/damage.py" "$fracas" "${FRACAS_DAMAGE_SEED:-20261121}" "${FRACAS_DAMAGES:-1000}" \
    finished=small.yaml=finished=finished ruled=rule.yaml=ruled=ruled files=files.yaml=files=files lost=small.yaml=lost=plain \
    interrupted=small.yaml=interrupted=plain killed=small.yaml=killed=plain > told || {
    cat told
    cp -r kept-* "${FRACAS_DAMAGE_KEEP:-/nowhere}" 2>/dev/null || true
    fail "damage was not told, or not put right"
}
cat told
