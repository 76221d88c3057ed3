# Warnings and captions of a report say what is so: no remedy that cannot help, and no point that is left out in silence.
. tests/support/campaigns.sh

# quiet STUDY WORDS WHY: no warning of the report has the words.
quiet()
{
    expect 0 "$fracas" report "$1"
    grep '^warning' said > warnings || true
    grep -qF -- "$2" warnings && fail "$3: $(cat warnings)"
    return 0
}

# says STUDY WORDS
says()
{
    expect 0 "$fracas" report "$1"
    grep '^warning' said > warnings || true
    grep -qF -- "$2" warnings || fail "no warning of $1 says \"$2\": $(cat warnings)"
}

ring='name: ring
seed: 1
model: ring
geometry: {radius: 2 mm, area: 1 mm2}
mesh: {elements: 100}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
time: {stop: time, end: 300 ns, safety: 0.25}
loading: {type: imposed-rate, rate: 1e5 1/s}'
one='strength: {distribution: constant, value: 300 MPa}'
many='strength: {distribution: uniform, minimum: 200 MPa, maximum: 400 MPa}'

# One strength: all replicas are equal, and no more of them help; where chance acts, they do.
printf '%s\n' "$ring" "$one" 'replicas: 2' > one.yaml
printf '%s\n' "$ring" "$many" 'replicas: 2' > many.yaml
printf '%s\n' "$ring" "$one" 'replicas: 1' > single.yaml
for study in one many single; do expect 0 "$fracas" run $study.yaml --study $study --jobs 1; done
quiet one 'raise replicas' 'equal replicas are to be more'
quiet single 'raise replicas' 'one replica of one strength is not enough'
says many 'raise replicas'

seq 100 | awk '{print 200e6 + 2e6*$1}' > strengths.txt
printf '%s\n' "$ring" 'strength: {distribution: file, file: strengths.txt}' 'replicas: 1' > file.yaml
printf '%s\n' "$ring" 'strength: {distribution: empirical, file: strengths.txt}' 'replicas: 1' > measured.yaml
for study in file measured; do expect 0 "$fracas" run $study.yaml --study $study --jobs 1; done
quiet file 'raise replicas' 'one replica of given strengths is not enough'
says measured 'raise replicas'

# Each of its elements is a fragment: the report says so, and nothing of more to come.
says one 'each element is a fragment, so that the mesh decides the count'
quiet one 'count not final' 'more than all elements are to come'
quiet one 'dust' 'dust beside elements that are all apart'
quiet many 'each element is a fragment' 'it is not so'
# On a plate only growth tells, and it said so of more fragments than there are elements.
printf '%s\n' 'name: plate' 'seed: 1' 'model: membrane' 'geometry: {shape: plate, width: 1 mm, height: 1 mm, thickness: 0.015 mm}' \
    'mesh: {order: 1, size: 0.2 mm}' 'material: {young: 260 GPa, density: 3690 kg/m3, poisson: 0.21}' \
    'cohesive: {law: nitsche, fracture_energy: 100 J/m2}' "$one" 'loading: {type: expansion, rate: 1e6 1/s}' \
    'time: {stop: time, end: 300 ns}' 'replicas: 1' > plate.yaml
expect 0 "$fracas" run plate.yaml --study plate --jobs 1
says plate 'each element is a fragment'
quiet plate 'count not final' 'more than all elements are to come'
quiet plate 'still breaking' 'a longer run is to break what is broken'

# A load without a strain rate among others: the figures against the rate say that its point is not there.
printf '%s\n' "$ring" "$one" 'sweep:' '  - cases:' '      - {name: slow, loading.rate: 3e4 1/s}' '      - {name: fast, loading.rate: 1e5 1/s}' \
    '      - {name: pushed, loading: {type: force, force: 1e7}}' 'replicas: 1' > mixed.yaml
expect 0 "$fracas" run mixed.yaml --study mixed --jobs 1
grep -q '1 point has no strain rate and is not drawn\.' mixed/report/index.html || fail "a point is left out in silence"
grep -q 'no strain rate and' one/report/index.html && fail "a point is said to be left out, and is not"

# An acceleration has no prefix.
printf '%s\n' 'name: pushed' 'seed: 1' 'model: membrane' 'geometry: {shape: plate, width: 2 mm, height: 2 mm, thickness: 0.1 mm, left: held}' \
    'mesh: {size: 0.5 mm}' 'material: {young: 260 GPa, density: 3690 kg/m3, poisson: 0.21}' \
    'cohesive: {law: nitsche, fracture_energy: 100 J/m2}' "$many" 'loading: {type: body-force}' 'time: {stop: time, end: 400 ns}' \
    'sweep:' '  - loading.x: [1e7, 5e7]' 'replicas: 2' > pushed.yaml
expect 0 "$fracas" run pushed.yaml --study pushed --jobs 1
grep -q 'force along x \[m/s2\]' pushed/report/index.html || fail "no axis of the acceleration in m/s2"
grep -q 'Mm/s2' pushed/report/index.html && fail "an axis in Mm/s2"
exit 0
