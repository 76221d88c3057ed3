# Two workers on 2 cores take at most 0.53 of one worker's time for a campaign of about 40 s of computing: the whole command, mpirun,
# merge and report included. Median of 5 pairs of runs, one after the other, so that a machine that changes its pace changes both.
# ctest-labels: storm slow-sanitize
# ctest-serial
# ctest-timeout: 3600
. "$(dirname "$0")/../support/campaigns.sh"

[ "$(nproc)" -ge 2 ] || { echo "skipped: one core"; exit 0; }
cat > two.yaml <<END
name: two
seed: 7
model: bar
geometry: {ends: periodic, length: 10 mm, area: 1 mm2}
mesh: {elements: 1000}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: settled, end: 300 ns, quiet: 50 ns, safety: 0.25}
sweep:
  - loading.rate: [5e4 1/s, 1e5 1/s, 2e5 1/s]
replicas: ${FRACAS_TWO_REPLICAS:-2400}
output: {history: 20}
END

# seconds JOBS
seconds()
{
    rm -rf study
    began=$(date +%s.%N)
    expect 0 "$fracas" run two.yaml --study study --jobs "$1" --lease-time 1
    awk -v a="$began" -v b="$(date +%s.%N)" 'BEGIN {print b - a}'
}

: > ratios
for pair in 1 2 3 4 5; do
    one=$(seconds 1)
    two=$(seconds 2)
    echo "$one $two" | awk '{printf "one %.2f s, two %.2f s, ratio %.4f\n", $1, $2, $2 / $1}'
    echo "$one $two" | awk '{print $2 / $1}' >> ratios
done
median=$(sort -g ratios | sed -n 3p)
echo "median of two workers' time over one's: $median"
awk -v m="$median" 'BEGIN {exit !(m > 0.4 && m <= 0.53)}' || fail "two workers take $median of one's time, not 0.53 at most"
