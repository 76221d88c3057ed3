# ctest-mpirun: storm
# What the caller brings along: children of the shell that became fracas, closed streams, a study whose own campaign file is gone.
. tests/support/campaigns.sh

campaign small.yaml 8 '1e5 1/s'
began=$(date +%s)
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 1
took=$(($(date +%s) - began))

# A child that the shell started before: it is neither waited for nor killed.
began=$(date +%s)
sh -c 'sleep 1000 & echo $! > child; exec "$@"' sh "$fracas" run --no-report small.yaml --study with-child --jobs 1 > said 2>&1 &
run=$!
is_done() { ! kill -0 $run 2>/dev/null; }
await 'end of the run' is_done
waited=$(($(date +%s) - began)) # 10 s of patience would be the sign
[ $waited -le $((2 * took + 6)) ] || [ $waited -le $((took + 6 + $(busy 1))) ] ||
    { kill $(cat child); fail "the run waits for a process that is not its own"; }
wait $run || fail "status $? beside a child of the shell"
kill "$(cat child)" || fail "it killed a process that is not its own"
same undisturbed with-child

expect 0 sh -c 'exec "$@" <&- >&-' sh "$fracas" run --no-report small.yaml --study closed --jobs 1
expect 0 sh -c 'exec "$@" <&- >&- 2>&-' sh "$fracas" run --no-report small.yaml --study all-closed --jobs 1
same undisturbed closed
same undisturbed all-closed
grep -q fracas: all-closed/lock && fail "a message went into the lock"

# Children that end unheard, unless somebody asks for their ends.
expect 0 env --ignore-signal=CHLD "$fracas" run --no-report small.yaml --study unheard --jobs 2
same undisturbed unheard

# An environment without anything; a campaign file whose name mpirun would take for a separator of programs.
cp small.yaml :
expect 0 env -i FRACAS_MPIRUN="${FRACAS_MPIRUN-}" "$fracas" run --no-report : --study bare --jobs 1
same undisturbed bare
# A setting of Open MPI without effect. (A busy machine may lose its words, and the ranks are started again.)
expect 6 env FRACAS_MPIRUN=1 OMPI_MCA_btl=nonexist "$fracas" run small.yaml --study setting --jobs 1
said '^fracas: Open MPI has no component `nonexist` of `btl`: correct OMPI_MCA_btl'
expect 6 env FRACAS_MPIRUN=1 TMPDIR="$PWD/small.yaml" "$fracas" run small.yaml --study setting --jobs 1
said "^fracas: MPI cannot make a folder for its own files in .*/small.yaml (TMPDIR): Not a directory; set TMPDIR"
grep 'started' said && fail "the ranks were started again"

# The study's own campaign file: lost, or damaged and removed as the message says.
cp closed/campaign.yaml kept.yaml
rm closed/campaign.yaml
expect 0 "$fracas" run --no-report small.yaml --study closed
cmp kept.yaml closed/campaign.yaml || fail "campaign.yaml is not written again"
echo 'x: [' >> closed/campaign.yaml
expect 5 "$fracas" run small.yaml --study closed
said 'remove it and run again'
rm closed/campaign.yaml
expect 0 "$fracas" run --no-report small.yaml --study closed
expect 0 "$fracas" verify --full closed
same undisturbed closed

# Each part of a campaign has a job of its own.
for part in 1 2; do expect 0 "$fracas" submit small.yaml --part $part/2 --study part$part --time 1h; done
grep -q -- '1/2' small.yaml.part1.sbatch && grep -q -- '2/2' small.yaml.part2.sbatch || fail "the job of one part is that of the other"
