# study.h5 is the same, byte for byte, whatever computes it: workers, lanes, instruction sets, order, compiler,
# launcher, and whether the campaign was extended on the way.
. tests/support/campaigns.sh

campaign small.yaml 18 '3e4 1/s, 1e5 1/s' # batches of 8, 8 and 2
expect 0 "$fracas" run small.yaml --study one --jobs 1
[ "$(segments one)" -ge 1 ] || fail "no segments"

n=0
compare()
{
    n=$((n + 1))
    expect 0 "$fracas" run small.yaml --study "other$n" "$@"
    same one "other$n"
}
compare --jobs 2 --segment-age 0.1
compare --jobs 4 --lanes 1 --shuffle --segment-size 1e-6 # a segment for each lease
[ "$(segments "other$n")" -eq 36 ] || fail "$(segments "other$n") segments instead of 36"
compare --jobs 2 --lanes 4 --shuffle
compare --jobs 2 --lanes 8 --isa baseline
compare --jobs 2 --lanes 1 --isa baseline
for isa in avx2 avx512; do
    case $isa in avx2) flag=avx2 ;; *) flag=avx512f ;; esac
    if grep -qw $flag /proc/cpuinfo; then
        compare --jobs 2 --isa $isa
    else
        echo "skipped: this CPU has no $isa"
    fi
done

gcc_fracas=$fracas
for compiler in clang release; do
    fracas=$source/build/$compiler/fracas
    [ "$fracas" = "$gcc_fracas" ] && continue
    if [ -x "$fracas" ]; then
        compare --jobs 2
    else
        echo "skipped: there is no build/$compiler/fracas"
    fi
done
fracas=$gcc_fracas

# Started by mpirun itself: rank 0 speaks, and its status is mpirun's.
expect 0 launch -n 2 "$fracas" run small.yaml --study direct
same one direct
export FRACAS_TEST_CRASH=0:1
expect 1 launch -n 1 "$fracas" run small.yaml --study direct-crash
said 'FAILED'
unset FRACAS_TEST_CRASH

# More replicas, then one more point between the others: as if run at once.
campaign part.yaml 5 '1e5 1/s'
expect 0 "$fracas" run part.yaml --study extended
campaign part.yaml 18 '1e5 1/s'
expect 0 "$fracas" run part.yaml --study extended
expect 0 "$fracas" run small.yaml --study extended
same one extended
echo "$n other ways, mpirun and an extension: the same bytes"
