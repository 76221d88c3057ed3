# The package of python/ on studies of a bar and of surfaces, complete and partial: every array is that of study.h5, every statistic that
# of the summary, every message and status those of the program.
. tests/support/campaigns.sh

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }
export FRACAS="$fracas" PYTHONPATH="$source/python" PYTHONDONTWRITEBYTECODE=1

campaign one.yaml 6 '1e5, 2e5, 3e5'
expect 0 "$fracas" run --no-report one.yaml --study whole --jobs 2
# Half of it, after a shorter campaign that was complete: an old study.h5, and segments of two point tables.
campaign short.yaml 2 '1e5, 3e5'
expect 0 "$fracas" run --no-report short.yaml --study half --jobs 2
expect 3 "$fracas" run --no-report one.yaml --study half --jobs 2 --part 1/2 --lease-time 0 --segment-size 1e-6
sed 's/model: bar/model: membrane/; s/^geometry.*/geometry: {width: 10 mm, height: 5 mm, thickness: 0.1 mm}/; s/^mesh.*/mesh: {divisions: 4}/
    s/density/poisson: 0.25, density/; s/, beta: 4//; s/law: nitsche, //; s/^loading.*/loading: {rate: 1e5 1\/s}/; s/stop: quiet, end: 300 ns, quiet: 50 ns/end: 100 ns/
    s/history: 20/history: 0/' one.yaml > plates.yaml
expect 0 "$fracas" run --no-report plates.yaml --study plates --jobs 2 --replicas 1
sed 's/model: bar/model: ring/; s/^geometry.*/geometry: {radius: 2 mm, area: 1 mm2}/; s/^loading: .*/loading: {type: initial-velocity, radial: 200 m\/s}/
    s/  - loading.rate.*/  - loading.radial: [200, 400]/' short.yaml > rings.yaml
expect 0 "$fracas" run --no-report rings.yaml --study rings --jobs 2
mkdir planned
expect 0 /usr/bin/python3 "$source/tests/support/check_python.py"
cat said
