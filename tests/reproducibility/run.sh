# ctest-sanitize
# study.h5 is the same, byte for byte, whatever computes it: workers, lanes, instruction sets, order, compiler,
# launcher, and whether the campaign was extended on the way.
. tests/support/campaigns.sh

campaign small.yaml 18 '3e4 1/s, 1e5 1/s' # batches of 8, 8 and 2
expect 0 "$fracas" run --no-report small.yaml --study one --jobs 1
[ "$(segments one)" -ge 1 ] || fail "no segments"

compare_compilers small.yaml
compare small.yaml --jobs 2 --segment-age 0.1
compare small.yaml --jobs 4 --lanes 1 --lease-time 0 --shuffle --segment-size 1e-6 # a segment for each lease
[ "$(segments "other$others")" -eq 36 ] || fail "$(segments "other$others") segments instead of 36"
compare small.yaml --jobs 2 --lanes 4 --shuffle
compare small.yaml --jobs 2 --lanes 8 --isa baseline
compare small.yaml --jobs 2 --lanes 1 --isa baseline
for isa in $(instruction_sets); do
    compare small.yaml --jobs 2 --isa "$isa"
done

# Started by mpirun itself: rank 0 speaks, and its status is mpirun's.
expect 0 launch -n 2 "$fracas" run --no-report small.yaml --study direct
same one direct
export FRACAS_TEST_FAULT=crash:0:1
expect 1 launch -n 1 "$faulty" run --no-report small.yaml --study direct-crash
said 'FAILED'
unset FRACAS_TEST_FAULT

# More replicas, then one more point between the others: as if run at once.
campaign part.yaml 5 '1e5 1/s'
expect 0 "$fracas" run --no-report part.yaml --study extended
campaign part.yaml 18 '1e5 1/s'
expect 0 "$fracas" run --no-report part.yaml --study extended
expect 0 "$fracas" run --no-report small.yaml --study extended
same one extended
echo "$others other ways, mpirun and an extension: the same bytes"
