# ctest-labels: ci
# Slopes and the crossover of a report are what tests/support/check_report.py has from the replicas, written anew from docs/theory: with three
# replicas, which share their scatter, with eight, which have their own, and with both in one study; a rate where no bar breaks takes no
# part, one where all are alike does where scatter is shared.
. tests/support/campaigns.sh

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }

for replicas in 3 8 mixed; do
    campaign few.yaml "${replicas%mixed}" '1e1 1/s, 3e2 1/s, 1e3 1/s, 3e3 1/s, 1e4 1/s, 3e4 1/s, 1e5 1/s'
    sed -i 's/length: 10 mm/length: 4 mm/; s/elements: 500/elements: 600/; s/^seed: 7/seed: 4/; s/end: 300 ns, quiet: 50 ns/end: 8 us, quiet: 100 ns/' few.yaml
    if [ $replicas = mixed ]; then # three and nine in turn
        sed -i '/^replicas:/d; /loading.rate:/d; s/^sweep:/replicas: 3\nsweep:\n  - cases:/' few.yaml
        for rate in 1e1 3e2 1e3 3e3 1e4 3e4 1e5; do
            case $rate in 3e*) n=9 ;; *) n=3 ;; esac
            sed -i "s|^  - cases:|&\n      - {replicas: $n, loading.rate: $rate 1/s}|" few.yaml
        done
    fi
    expect 0 "$fracas" run few.yaml --study $replicas --jobs 2
    expect 0 "$fracas" report $replicas --json
    cp said $replicas/summary.json
    expect 0 "$fracas" report $replicas
    cp said $replicas/table.txt
    /usr/bin/python3 "$source/tests/support/check_report.py" $replicas "$source" || fail "the report of $replicas replicas"
done
/usr/bin/python3 - <<'END' || fail "the studies do not have what is to be compared"
import json
few, many, mixed = (json.load(open(f"{replicas}/summary.json")) for replicas in (3, 8, "mixed"))
deviation = [point["statistics"]["size.deviation"] for point in few["points"]]
assert deviation[0] == 0 and 0 in deviation[1:] and few["points"][0]["statistics"]["count.mean"] == 1
assert few["slopes"][0]["points"] == few["crossovers"][0]["points"] == 6 and few["slopes"][0]["pooled_freedom"] == 12
assert few["crossovers"][0]["reason"] is None and many["crossovers"][0]["reason"] is None
assert many["slopes"][0]["points"] == 6 and many["slopes"][0]["pooled_freedom"] is None
assert mixed["slopes"][0]["points"] == 6 and mixed["slopes"][0]["pooled_freedom"] == mixed["crossovers"][0]["pooled_freedom"] == 6
assert mixed["crossovers"][0]["reason"] is None
for replicas, study in ((3, few), (8, many), ("mixed", mixed)):
    off = study["slopes"][0]["misfit"] < 0.01
    assert off == ("they are not on one line" in open(f"{replicas}/report/index.html", encoding="utf-8").read())
    assert off  # one line through sizes that bend
END
