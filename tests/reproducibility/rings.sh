# Rings of both laws, with a zone and without, strengths of a file, and a bar on a perturbed mesh: study.h5 is the same, byte for
# byte, whatever computes it. Here every realization has a time step of its own, so lanes of one batch end far apart.
. tests/support/campaigns.sh

awk 'BEGIN {x = 5; for (i = 0; i < 200; i++) {x = (x*75 + 74) % 65537; printf "%d, %.9e\n", i, 290e6 + 2e7*x/65537}}' > given.csv

# rings FILE REPLICAS: half a second of one core; six elements a fragment, and dust. A point for each further argument.
zone='{name: zone, cohesive: {law: stershic, fracture_energy: 100 J/m2, zone: 100 um}}'
perturbed='{name: perturbed, model: bar, geometry: {shape: bar, length: 6.3 mm}, mesh: {spacing: perturbed, amplitude: 0.3}, cohesive: {law: nitsche, fracture_energy: 100 J/m2}, loading: {type: imposed-rate, rate: 1e5 1/s}}'
rings()
{
    cat > "$1" <<END
name: rings
seed: 11
model: ring
geometry: {radius: 1 mm, area: 1 mm2}
mesh: {elements: 200}
material: {young: 275 GPa, density: 2750 kg/m3}
strength: {distribution: uniform, minimum: 290 MPa, maximum: 310 MPa}
loading: {type: initial-velocity, radial: 100 m/s}
time: {stop: time, end: 150 ns, safety: 0.5}
replicas: $2
output: {history: 20, interfaces: true}
sweep:
  - cases:
      - {name: nitsche, cohesive: {law: nitsche, fracture_energy: 100 J/m2}}
      - {name: stershic, cohesive: {law: stershic, fracture_energy: 100 J/m2}}
      - {name: steep, cohesive: {law: stershic, critical_opening: 0.6 um, critical_zone: steep, refinement: 0.1}}
      - {name: given, cohesive: {law: stershic, fracture_energy: 100 J/m2}, strength: {distribution: file, file: given.csv}, replicas: 1}
END
    file=$1
    shift 2
    for point in "$@"; do
        echo "      - $point" >> "$file"
    done
}

rings all.yaml 11 "$zone" "$perturbed" # batches of 8 and 3
expect 0 "$fracas" run --no-report all.yaml --study one --jobs 1
h5dump -d /realization/outcome one/study.h5 | grep -q '^ *(0): 0, 0' || fail "nothing broke"

compare_compilers all.yaml
for isa in baseline $(instruction_sets); do
    compare all.yaml --jobs 2 --isa "$isa" --lanes 8 --shuffle
    compare all.yaml --jobs 2 --isa "$isa" --lanes 4
done
compare all.yaml --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6 # a segment for each realization

# Killed in the middle, each realization a segment, and resumed.
hold
start --no-report all.yaml --study killed --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments killed "$(random 1 20)"
kill_session
release
expect 0 "$fracas" run --no-report all.yaml --study killed
same one killed

# More replicas, then points among the others: as if run at once. The mesh of the perturbed bar is that of its point.
rings part.yaml 4
sed -i '/name: stershic,/d' part.yaml
expect 0 "$fracas" run --no-report part.yaml --study extended --lanes 4
rings part.yaml 11 "$perturbed"
expect 0 "$fracas" run --no-report part.yaml --study extended
expect 0 "$fracas" run --no-report all.yaml --study extended
same one extended
echo "$others other ways, a kill and an extension: the same bytes"
