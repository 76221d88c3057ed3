# ctest-labels: ci
# `plan` predicts the bytes of study.h5, of the segments, and of the study while it is merged, to 20 %: of every model, with and
# without histories and interfaces. Whole chunks of datasets are known to 1 %. Fragments are those of the first eight replicas, whose
# mean count has a deviation of 5 % at most here: `plan` computes them, since they are cheap (FRACAS_ROWS_BUDGET).
. tests/support/campaigns.sh

# small NAME MODEL GEOMETRY MESH LOADING END HISTORY INTERFACES REPLICAS
small()
{
    poisson=
    case $2 in membrane | shell) poisson='poisson: 0.22, ' ;; esac
    cat > "$1.yaml" <<END
name: $1
seed: 1
model: $2
geometry: {$3}
mesh: {$4}
material: {young: 370 GPa, ${poisson}density: 3900 kg/m3}
cohesive: {fracture_energy: 50 J/m2}
strength: {scale: 300 MPa, shape: 10}
loading: {$5}
time: {stop: time, end: $6}
replicas: $9
output: {history: $7, interfaces: $8}
END
    "$fracas" plan "$1.yaml" --jobs 1 --json > "$1.json"
    "$fracas" run --no-report "$1.yaml" --study "$1" --jobs 1 --segment-age 1000 > out 2> said || fail "$1: $(cat said)"
    python3 - "$1" <<'END' || fail "$1: the prediction is more than 20 % off"
import glob, json, os, sys
name = sys.argv[1]
plan = json.load(open(name + ".json"))
study = os.path.getsize(name + "/study.h5")
segments = sum(map(os.path.getsize, glob.glob(name + "/segments/*.h5")))
for key, actual in ("bytes", study), ("bytes_segments", segments), ("bytes_peak", study + segments):
    print(name, key, plan[key], actual, f"{plan[key] / actual - 1:+.1%}")
    assert abs(plan[key] / actual - 1) < 0.2, key
END
}

small bar bar 'length: 10 mm, area: 1 mm2' 'elements: 500' 'rate: 1e5 1/s' '1 us' 0 false 8
small bars bar 'length: 2 mm, area: 1 mm2' 'elements: 100' 'rate: 1e5 1/s' '0.3 us' 20 true 400
small ring ring 'shape: ring, radius: 2 mm, area: 1 mm2' 'elements: 400' 'type: initial-velocity, radial: 60 m/s' '1 us' 200 true 8
small plate membrane 'width: 2 mm, height: 1 mm, thickness: 0.1 mm' 'divisions: 8' 'rate: 1e5 1/s' '0.5 us' 10 true 8
small plates membrane 'width: 2 mm, height: 1 mm, thickness: 0.1 mm' 'divisions: 6' 'rate: 1e5 1/s' '0.25 us' 0 false 100
small octant shell 'part: octant, radius: 2 mm, thickness: 0.1 mm' 'divisions: 6' 'rate: 1e5 1/s' '0.2 us' 10 true 8
