# ctest-labels: ci slow-sanitize
# The shipped campaign bar-rate-sweep.yaml: counts, sizes, ledger, elements a fragment, and its processor time.
. tests/support/campaigns.sh

/usr/bin/python3 - "$fracas" "$source/campaigns/examples/bar-rate-sweep.yaml" > took <<'END' || fail "it does not run"
import resource, subprocess, sys
subprocess.run([sys.argv[1], "run", sys.argv[2], "--study", "sweep"], check=True, stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime)
END
took=$(cat took)
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
print("took", sys.argv[1], "s of processor time")
assert 1 < float(sys.argv[1]) < 120, "not within 60 s on 2 free cores"
END
