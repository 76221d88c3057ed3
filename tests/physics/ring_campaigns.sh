# ctest-labels: storm
# ctest-serial
# The other shipped ring campaigns with 8 replicas a point: distributions, zone; counts are final, no energy drifts.
. tests/support/campaigns.sh

for name in ring-distributions ring-zoning; do
    sed 's/^replicas: .*/replicas: 8/' "$source/campaigns/examples/$name.yaml" > "$name.yaml"
    expect 0 "$fracas" run "$name.yaml" --study "$name"
    "$fracas" report "$name" --json > "$name.json"
done
PYTHONPATH=$source/tests/support PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - <<'END'
from ring_campaigns import final, read

# Intervals are 2 to 3 %; the order is that of the weak tails.
counts = {}
distributions = final(read("ring-distributions", lambda p: 1e-3))
for p in distributions["points"]:
    counts[p["parameters"]["strength.distribution"], p["parameters"]["loading.radial"]] = p["statistics"]["count.mean"]
print(counts)
for radial in (80, 800):
    of = {d: counts[d, radial] for d in ("weibull", "normal", "gamma", "lognormal", "flaws", "uniform")}
    assert of["weibull"] < 0.97 * of["normal"] and of["normal"] < of["uniform"] and 1.05 * of["flaws"] < of["uniform"]
    assert 1.12 < of["uniform"] / of["weibull"] < 1.50

# Without a zone the residual is 1 %, with 100 um 2e-5.
zoned = {}
zoning = read("ring-zoning", lambda p: 1e-3 if p["cohesive.zone"] > 6e-5 else 5e-2)
for p in zoning["points"]:
    if p["parameters"]["strength.distribution"] == "uniform":
        zoned[round(1e6 * p["parameters"]["cohesive.zone"])] = p["statistics"]
print({z: (s["count.mean"], s["residual"]) for z, s in zoned.items()})
assert abs(zoned[100]["count.mean"] / zoned[0]["count.mean"] - 1) < 0.06 and zoned[100]["residual"] < 1e-4
assert zoned[800]["count.mean"] < 0.5 * zoned[0]["count.mean"] and zoned[800]["dissipated.mean"] < 0.65 * zoned[0]["dissipated.mean"]

# Points are called by the names of their cases, else by the swept parameters.
assert zoning["varying"] == ["case"]
assert distributions["varying"] == ["case", "loading.radial"]
END
