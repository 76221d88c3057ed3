# Two workers on 2 cores take at most 0.53 of one worker's time for a campaign of about 40 s of computing, mpirun and merge included.
# Median of 5 pairs of runs, one after the other, so that a machine that changes its pace changes both. The command writes the report
# as well, by one process: what that takes is measured by writing it again, and taken off; the ratio with it is printed beside.
# ctest-labels: storm
# ctest-serial
# ctest-timeout: 3600
. "$(dirname "$0")/../support/campaigns.sh"

[ "$(nproc)" -ge 2 ] || { echo "skipped: one core"; exit 0; }
campaign two.yaml "${FRACAS_TWO_REPLICAS:-2400}" '5e4 1/s, 1e5 1/s, 2e5 1/s'
sed -i 's/elements: 500/elements: 1000/; s/, interfaces: true//' two.yaml

# seconds JOBS: of the command, and without its report.
seconds()
{
    rm -rf study
    began=$(date +%s.%N)
    expect 0 "$fracas" run two.yaml --study study --jobs "$1" --lease-time 1
    ended=$(date +%s.%N)
    expect 0 "$fracas" report study
    awk -v a="$began" -v b="$ended" -v c="$(date +%s.%N)" 'BEGIN {print b - a, b - a - (c - b)}'
}

: > ratios
for pair in 1 2 3 4 5; do
    one=$(seconds 1)
    two=$(seconds 2)
    echo "$one $two" | awk '{printf "one %.2f s, two %.2f s: %.4f; with the report %.2f s, %.2f s: %.4f\n", $2, $4, $4 / $2, $1, $3, $3 / $1}'
    echo "$one $two" | awk '{print $4 / $2, $3 / $1}' >> ratios
done
median=$(sort -g ratios | sed -n 3p | cut -d' ' -f1)
echo "median of two workers' time over one's: $median, with the report $(cut -d' ' -f2 ratios | sort -g | sed -n 3p)"
awk -v m="$median" 'BEGIN {exit !(m > 0.4 && m <= 0.53)}' || fail "two workers take $median of one's time, not 0.53 at most"
