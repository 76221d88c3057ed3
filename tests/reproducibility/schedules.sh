# The same bytes whatever the number of workers, the order, the size of leases, the isolation and the width of batches; and the same rows
# FAILED where realizations crash.
. tests/support/campaigns.sh

campaign small.yaml 6 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study one --jobs 1
for jobs in 1 2 3 5; do
    for isolation in lease none; do
        compare small.yaml --jobs $jobs --isolation $isolation
        compare small.yaml --jobs $jobs --isolation $isolation --shuffle --lease-time 0 --segment-size 0.05
    done
done
for lanes in 1 4 8; do
    compare small.yaml --jobs 2 --lanes $lanes --isolation none --shuffle
    compare small.yaml --jobs 3 --lanes $lanes --lease-time 0 --segment-size 1e-6
done

# Isolation none finds which one it was: a process that computes died, and what it held is computed in processes of its own.
export FRACAS_TEST_FAULT=crash:1:4
expect 1 "$faulty" run --no-report small.yaml --study crashed --jobs 1
rows() { sqlite3 "$1/index.sqlite" "SELECT replica, status, attempts, reason FROM realization WHERE status = 'failed'"; }
rows crashed > failed
[ "$(wc -l < failed)" -eq 1 ] || fail "not one row FAILED: $(cat failed)"
for options in '--jobs 2 --shuffle' '--jobs 3 --lanes 1' '--jobs 5 --lanes 4 --lease-time 0' '--jobs 2 --lanes 8'; do
    # shellcheck disable=SC2086
    expect 1 "$faulty" run --no-report small.yaml --study again $options
    same crashed again
    rows again | cmp - failed || fail "other rows FAILED with $options"
    rm -r again
done
