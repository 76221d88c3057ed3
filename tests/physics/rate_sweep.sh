# ctest-labels: slow-sanitize
# The shipped campaign bar-rate-sweep.yaml: counts, sizes, ledger, elements a fragment, and its time on this machine.
. tests/support/campaigns.sh

began=$(date +%s)
expect 0 "$fracas" run "$source/campaigns/examples/bar-rate-sweep.yaml" --study sweep
took=$(($(date +%s) - began))
"$fracas" report sweep --json > sweep.json
/usr/bin/python3 - "$took" <<'END'
import json, sys
points = json.load(open("sweep.json"))["points"]
bounds = {1e3: (55, 63, 0.25), 1e4: (105, 120, 0.15), 1e5: (360, 390, 0.15), 1e6: (1500, 1680, 0.15)}
assert len(points) == 4, points
for p in points:
    rate = p["parameters"]["loading.rate"]
    low, high, zmr = bounds.pop(rate)
    s = p["statistics"]
    zmr_size = s["size.mean"] / s["law.zmr"]
    print(rate, s["count.mean"], zmr_size, s["residual"], s["created"], s["elements"])
    assert s["realizations"] == s["usable"] >= 32
    assert low <= s["count.mean"] <= high
    assert abs(zmr_size - 1) < zmr
    assert s["residual"] < 1e-3 and 0 < s["created"] < 1e-2
    assert s["elements"] >= 20
assert not bounds
print("took", sys.argv[1], "s")
assert int(sys.argv[1]) < 60, "more than 60 s (asked on 2 free cores)"
END
