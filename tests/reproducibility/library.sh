# libfracas, called from Python, gives every byte that `fracas run` stores: bars with a rule for replicas, rings with strengths of a
# file and a perturbed bar, plates of Gauss points in graded material, shells. It exports nothing but its own functions.
. tests/support/campaigns.sh
library=$(dirname "$fracas")/libfracas.so

nm -D --defined-only "$library" | awk '{sub(/@.*/, "", $3); print $3}' | grep -v '^FRACAS_0$' | sort > exported
sed -n 's/^FRACAS_API .*[ *]\(fracas_[a-z_]*\)(.*/\1/p' "$source/library/fracas.h" | sort > declared
[ -s declared ] || fail "no function in fracas.h"
diff declared exported || fail "libfracas exports other functions than fracas.h declares"
readelf -d "$library" | grep NEEDED | grep -E 'mpi|hdf5|sqlite' && fail "libfracas needs a library of runs"

# study FILE [all]: runs the campaign, and computes the first and last realization of each point, or all, with the library.
study()
{
    expect 0 "$fracas" run --no-report "$1" --study "${1%.yaml}"
    expect 0 /usr/bin/python3 "$source/tests/support/library_study.py" "$library" "$1" "${1%.yaml}/study.h5" ${2-}
    cat said
}

campaign bar.yaml 19 1e5 # two batches of eight, and one of three
study bar.yaml all

campaign rule.yaml 8 '3e4 1/s, 1e5 1/s'
sed -i -e 's/^replicas: .*/replicas: {minimum: 8, maximum: 24, until: {quantity: mean-count, relative-half-width: 0.015}}/' rule.yaml
study rule.yaml

awk 'BEGIN {x = 5; for (i = 0; i < 200; i++) {x = (x*75 + 74) % 65537; printf "%d, %.9e\n", i, 290e6 + 2e7*x/65537}}' > given.csv
cat > rings.yaml <<'YAML'
name: rings
seed: 11
model: ring
random_numbers: common
geometry: {radius: 1 mm, area: 1 mm2}
mesh: {elements: 200}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: stershic, fracture_energy: 100 J/m2}
strength: {distribution: uniform, minimum: 290 MPa, maximum: 310 MPa}
loading: {type: initial-velocity, radial: 100 m/s}
time: {stop: time, end: 150 ns, safety: 0.5}
replicas: 3
output: {history: 20, interfaces: true}
sweep:
  - cases:
      - {name: stershic}
      - {name: given, strength: {distribution: file, file: given.csv}, replicas: 1}
      - {name: perturbed, model: bar, geometry: {shape: bar, length: 6.3 mm}, mesh: {spacing: perturbed, amplitude: 0.3}, cohesive: {law: nitsche, fracture_energy: 100 J/m2}, loading: {type: imposed-rate, rate: 1e5 1/s}}
YAML
study rings.yaml
study rings/campaign.yaml

cat > factor.csv <<'CSV'
x [m], factor
-1e-3, 0.9
0, 1.2
0, 0.8
1e-3, 1
CSV
cat > plates.yaml <<'YAML'
name: plates
seed: 5
model: membrane
geometry: {width: 4 mm, height: 2 mm, thickness: 0.1 mm}
mesh: {divisions: 4, amplitude: 0.2}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 100 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2, per: gauss-point, factor: factor.csv, factor_along: x}
loading: {rate: 2e4 1/s}
time: {end: 0.2 us}
replicas: 3
output: {interfaces: true}
sweep:
  - cases:
      - {name: plate}
      - {name: annulus, geometry: {shape: annulus, inner: 1 mm, outer: 2 mm, thickness: 0.1 mm}, mesh: {divisions: 3, order: 2}}
YAML
study plates.yaml

cat > shells.yaml <<'YAML'
name: shells
seed: 5
model: shell
geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.2 mm}
mesh: {divisions: 8, amplitude: 0.1}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 100 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 1e4 1/s}
time: {end: 0.3 us, integrator: hulbert-chung}
replicas: 2
output: {history: 20}
YAML
study shells.yaml
