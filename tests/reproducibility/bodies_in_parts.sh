# One body on several cores, also under three loads with moving fronts, cooled, and with moved edges: study.h5 is the same, byte for byte, for parts 1, 2, 3, 4 and 7, lanes 1 and 8, and across a kill and a
# resume from a checkpoint with other parts. Cracks run through the cuts: invariant/shell_cracks.
. tests/support/campaigns.sh

# bodies PARTS: a sphere's octant of 484 elements, and a plate of linear triangles; 0: the run chooses.
bodies()
{
    cat > "bodies-$1.yaml" <<END
name: bodies
seed: 5
model: shell
geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.2 mm}
mesh: {divisions: 22, amplitude: 0.1}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 100 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 3e4 1/s}
time: {end: 0.1 us}
replicas: 1
output: {history: 20, interfaces: true}
sweep:
  - cases:
      - {name: octant}
      - {name: plate, model: membrane, geometry: {shape: plate, width: 10 mm, height: 5 mm, thickness: 0.1 mm}, mesh: {divisions: 12}, cohesive: {fracture_energy: 50 J/m2}, time: {end: 0.4 us}}
      - {name: fronts, loading: {type: pressure, pressure: 4 GPa, decay: 0.2 us, front: 4e4 m/s, front_along: z}, loading_2: {type: pressure, pressure: -1 GPa, rise: 0.1 us, spot: 1 mm, spot_z: 2 mm}, loading_3: {type: body-force, x: 1e9 m/s2, front: 3e4 m/s, front_along: y}, time: {end: 0.15 us}}
      - {name: pulled, model: membrane, geometry: {shape: plate, width: 10 mm, height: 5 mm, thickness: 0.1 mm}, mesh: {divisions: 12, order: 2}, cohesive: {fracture_energy: 50 J/m2}, loading: {type: edge-motion, edge: top, second_edge: right, velocity: 20 m/s, rise: 0.1 us}, time: {end: 0.4 us, mass: consistent, integrator: hulbert-chung}}
      - {name: cooled, model: membrane, geometry: {shape: plate, width: 10 mm, height: 5 mm, thickness: 0.1 mm, left: held, right: held}, mesh: {divisions: 12}, cohesive: {fracture_energy: 50 J/m2}, initial: {temperature: -150 K, expansion_coefficient: 8e-6 1/K, spin: 100 rad/s, from_x: 0}, loading: {type: none}, time: {end: 0.4 us}}
      - {name: bent, geometry: {shape: plate, width: 2 mm, height: 1 mm, thickness: 0.1 mm, left: clamped}, mesh: {divisions: 6}, loading: {type: edge-motion, edge: right, direction: across, velocity: 100 m/s}, time: {end: 0.2 us, rotary_inertia: 1}}
END
    [ "$1" = 0 ] || echo "parallel: {parts: $1}" >> "bodies-$1.yaml"
}

# alone COMMAND...: fracas as one rank that a person has started: without the launcher's look at the cores.
if [ "$(id -u)" -eq 0 ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
alone=$work/alone
printf '#!/bin/sh\nASAN_OPTIONS=detect_leaks=0 exec mpirun --oversubscribe -n 1 "%s" "$@"\n' "$fracas" > "$alone"
chmod +x "$alone"

# wait_threads COUNT: until a process that computes a lease has that many.
wait_threads()
{
    await "$1 threads" has_threads "$1"
}

has_threads()
{
    [ "$(for process in $(named fracas-lease); do ls "/proc/$process/task"; done 2>/dev/null | wc -l)" -eq "$1" ]
}

bodies 1
expect 0 "$fracas" run --no-report bodies-1.yaml --study one --jobs 1
h5dump -d /realization/broken one/study.h5 | grep -q '(0): [1-9][0-9]*, [1-9][0-9]*, [1-9][0-9]*, [1-9][0-9]*, [1-9][0-9]*, [1-9][0-9]*$' || fail "not all bodies broke"
! grep -q parallel one/campaign.yaml || fail "campaign.yaml says how it was computed"
for parts in 2 3 4 7; do
    bodies $parts
    expect 0 "$alone" run bodies-$parts.yaml --study "in-$parts-parts" --lanes $((parts % 2 ? 1 : 8))
    same one "in-$parts-parts"

    # A thread a part: seen on bodies that are not over before anybody has looked.
    sed '/time:/s/end: 0.[0-9]* us/end: 1 ms/' "bodies-$parts.yaml" > long.yaml
    program=$alone
    start --no-report long.yaml --study "long-$parts"
    wait_threads $parts
    kill_session
    program=
done
# Parts that the run chooses fail no realization: here there is no memory for a thread of 1 MiB.
little='--memory-limit 1'
(ulimit -S -d 8000000; "$fracas" --version) > /dev/null 2>&1 || little= # the shadow memory of a sanitizer
bodies 0
expect 0 "$fracas" run --no-report bodies-0.yaml --study chosen
same one chosen
# shellcheck disable=SC2086 # two words
expect 0 "$fracas" run --no-report bodies-0.yaml --study hindered --jobs 8 $little
same one hindered

# The launcher keeps to the cores of this machine.
bodies 1000
expect 2 "$fracas" run bodies-1000.yaml --study many
said 'parallel.parts 1000 are 1000 threads'
[ ! -e many ] || fail "a study was begun"

# Killed, and resumed in other parts.
hold
start --no-report bodies-1.yaml --study killed --jobs 1 --checkpoint-time 0.01
wait_checkpoints killed 1
kill_session
release
[ ! -e killed/study.h5 ] || fail "it was over before it was killed"
expect 0 "$alone" run bodies-3.yaml --study killed
same one killed
echo "parts 1, 2, 3, 4, 7, chosen ones, and a resume in others: the same bytes"
