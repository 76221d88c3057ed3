# An eighth of a sphere, with and without rotary inertia and behind a front, a whole one with friction, a plate and half a tube in one study: study.h5 is the same,
# byte for byte, whatever computes it, and however often it was killed on the way.
. tests/support/campaigns.sh

whole='{name: whole, geometry: {shape: sphere, part: whole, radius: 2 mm, thickness: 0.3 mm}, mesh: {divisions: 2}, cohesive: {friction: 0.3, coupling: 0.8, onset: flux}, loading: {rate: 1e4 1/s}, time: {end: 0.6 us}}'
plate='{name: plate, geometry: {shape: plate, width: 4 mm, height: 2 mm, thickness: 0.3 mm}, mesh: {divisions: 4}, cohesive: {fracture_energy: 0 J/m2, critical_opening: 0.4 um}, time: {end: 0.3 us, integrator: central-difference, safety: 0.4}}'
front='{name: front, loading: {type: pressure, pressure: 400 MPa, decay_by_travel: 2, front: 3e4 m/s, front_at: 0.5 mm, front_from: 0 mm}}'
tube='{name: tube, geometry: {shape: cylinder, part: half, radius: 2 mm, length: 3 mm, thickness: 0.2 mm, top: diaphragm}, mesh: {divisions: 5}, loading: {rate: 4e4 1/s, ratio: 0}, time: {end: 0.5 us}}'
# shells FILE REPLICAS: two seconds of one core.
shells()
{
    cat > "$1" <<END
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
replicas: $2
output: {history: 20, interfaces: true}
sweep:
  - cases:
      - {name: octant}
      - {name: turning, time.rotary_inertia: 1}
      - $whole
      - $plate
      - $front
      - $tube
END
}

shells all.yaml 5
expect 0 "$fracas" run --no-report all.yaml --study one --jobs 1
/usr/bin/python3 - <<'END' || fail "not every shell broke, or none by bending"
import h5py
r = h5py.File("one/study.h5")["realization"]
print(list(zip(r["point"][:], r["fragments"][:], r["dissipated"][:], r["dissipated_bending"][:])))
octant = r["point"][:] <= 1
assert len(octant) == 30 and (r["fragments"][:] > 1).all()
assert (r["dissipated_bending"][:][octant] > 0).all() and (r["dissipated_bending"][:] < r["dissipated"][:]).all()
END
compare_compilers all.yaml
compare all.yaml --jobs 2 --shuffle
compare all.yaml --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6 # a segment for each realization
for isa in baseline $(instruction_sets); do
    compare all.yaml --jobs 2 --isa "$isa" --lanes 8
done
compare all.yaml --jobs 1 --lanes 4

# Extended: merged again.
shells part.yaml 2
expect 0 "$fracas" run --no-report part.yaml --study extended
expect 0 "$fracas" run --no-report all.yaml --study extended
same one extended

# Killed with some segments written, twice, and resumed.
for kill in 1 2; do
    hold
    start --no-report all.yaml --study killed --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6 --shuffle
    wait_segments killed $((4 * kill))
    kill_session
    release
    [ ! -e killed/study.h5 ] || fail "it was over before it was killed"
done
expect 0 "$fracas" run --no-report all.yaml --study killed --jobs 1
same one killed
expect 0 "$fracas" verify --full one
echo "$others other ways, an extension and two kills: the same bytes"
