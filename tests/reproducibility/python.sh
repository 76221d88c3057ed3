# Python, C and the command line give the same numbers to the last digit, on five campaigns.
. tests/support/campaigns.sh

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }
export FRACAS="$fracas" PYTHONPATH="$source/python" PYTHONDONTWRITEBYTECODE=1
build=$(dirname "$fracas")
expect 0 cc -o realize -I"$source/library" "$source/docs/examples/realize.c" -L"$build" -lfracas -Wl,-rpath,"$build"

campaign bar.yaml 9 '1e5, 2e5'
cp "$source"/tests/data/campaigns/chain-variants.yaml "$source"/tests/data/campaigns/membrane.yaml "$source"/tests/data/campaigns/surface-variants.yaml .
cat > shell.yaml <<'YAML'
name: shell
seed: 5
model: shell
geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.2 mm}
mesh: {divisions: 8, amplitude: 0.1}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 100 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 1e4 1/s}
time: {end: 0.3 us}
replicas: 2
output: {history: 20, interfaces: true}
YAML
for name in bar chain-variants membrane surface-variants shell; do
    expect 0 "$fracas" run --no-report $name.yaml --study $name --jobs 2 --replicas 2
    expect 0 /usr/bin/python3 "$source/tests/support/check_python_kernel.py" $name
    cat said
done
