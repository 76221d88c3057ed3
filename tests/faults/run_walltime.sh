# ctest-serial
# ctest-labels: ci
# A run with a walltime has stopped before it is over, with everything kept, and goes on from there.
. tests/support/campaigns.sh

campaign long.yaml 200 '3e4 1/s, 1e5 1/s'
sed -i 's/elements: 500/elements: 1300/' long.yaml # 4 s of one core
began=$(date +%s)
expect 3 "$fracas" run --no-report long.yaml --study timed --jobs 2 --walltime 2s
took=$(($(date +%s) - began))
cp said words
[ $took -le 2 ] || [ $took -le $((2 + $(busy 2))) ] || fail "a walltime of 2 s was not kept"
mv words said
said '[a-z ]*: [0-9]* of 400 realizations are done and kept; the same command goes on from there'
kept=$(sed -n 's/.*\(nearly over\|interrupted\): \([0-9]*\) of.*/\2/p' said)
expect 0 "$fracas" status timed
said "400: $kept done, 0 failed"
expect 0 "$fracas" run --no-report long.yaml --study timed --jobs 2 --walltime 10m
said "$((400 - kept)) of 400 realizations"
expect 0 "$fracas" run --no-report long.yaml --study straight --jobs 2
same straight timed
echo "$kept of 400 realizations in 2 s: the same bytes"
