# One body in two parts on 2 cores takes at most 0.556 of its time in one, an efficiency of 0.9: the sphere of Becker and Noels in an
# octant of 20 164 elements, model and merge included. Median of 3 pairs of runs, one after the other, so that a machine that changes
# its pace changes both.
# ctest-labels: storm
# ctest-serial
# ctest-timeout: 3600
. "$(dirname "$0")/../support/campaigns.sh"

[ "$(nproc)" -ge 2 ] || { echo "skipped: one core"; exit 0; }
cat > sphere.yaml <<'END_OF_FILE'
name: sphere
seed: 5
model: shell
geometry: {shape: sphere, part: octant, radius: 9.5 mm, thickness: 0.1 mm}
mesh: {divisions: 142}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {law: nitsche, fracture_energy: 50 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 1e5 1/s}
time: {stop: time, end: 500 ns, rotary_inertia: 1}
parallel: {parts: 1}
replicas: 1
END_OF_FILE

# seconds PARTS: of the run.
seconds()
{
    sed "s/parts: 1/parts: $1/" sphere.yaml > parts.yaml
    rm -rf "study-$1"
    began=$(date +%s.%N)
    expect 0 "$fracas" run --no-report parts.yaml --study "study-$1"
    awk -v a="$began" -v b="$(date +%s.%N)" 'BEGIN {print b - a}'
}

: > ratios
for pair in 1 2 3; do
    one=$(seconds 1)
    two=$(seconds 2)
    echo "$one $two" | awk '{printf "one part %.2f s, two %.2f s: %.3f\n", $1, $2, $2 / $1}'
    echo "$one $two" | awk '{print $2 / $1}' >> ratios
done
same study-1 study-2
median=$(sort -g ratios | sed -n 2p)
echo "median of the time in two parts over that in one: $median"
awk -v m="$median" 'BEGIN {exit !(m > 0.4 && m <= 0.556)}' || fail "two parts take $median of one's time, not 0.556 at most"
