# Scaling laws of strengths with a size effect take the strength of a piece s0 long (docs/theory/scaling-laws.md): their lines stay on every mesh.
# Without a size effect by volume they take an interface's, and a caption says what they take, or that there is none.
. tests/support/campaigns.sh

cat > meshes.yaml <<'END'
name: meshes
seed: 1
model: bar
geometry: {ends: periodic, length: 5 mm, area: 1 mm2}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: time, end: 20 ns}
sweep:
  - cases:
      - {name: weibull, strength: {distribution: weibull, scale: 300 MPa, shape: 10, reference_volume: 0.02 mm3}}
      - {name: least, strength: {distribution: weibull, scale: 200 MPa, shape: 3, minimum: 100 MPa, reference_volume: 0.02 mm3}}
      - {name: uniform, strength: {distribution: uniform, minimum: 200 MPa, maximum: 400 MPa, reference_volume: 0.02 mm3}}
      - {name: flaws, strength: {distribution: flaws, flaw_density: 4e11 1/m3, minimum: 100 MPa, maximum: 400 MPa, exponent: 4}}
      - {name: drawn, strength: {distribution: weibull, scale: 300 MPa, shape: 10}}
      - {name: area, strength: {distribution: weibull, scale: 300 MPa, shape: 10, reference_area: 2 mm2}}
      - {name: normal, strength: {distribution: normal, mean: 300 MPa, deviation: 30 MPa, reference_volume: 0.02 mm3}}
      - {name: scattered, strength: {distribution: weibull, scale: 300 MPa, shape: 2, reference_volume: 0.02 mm3}}
  - mesh.elements: [250, 500, 1000]
replicas: 1
output: {history: 0}
END
expect 0 "$fracas" run meshes.yaml --study meshes --jobs 1
/usr/bin/python3 - <<'END' || fail "scales of points"
import csv, math
rows = list(csv.DictReader(open("meshes/report/points.csv")))
by = {(row["case"], int(row["mesh.elements"])): row for row in rows}
E, G, rho = 275e9, 100.0, 2750.0
for case in {row["case"] for row in rows}:
    for key in "scale.size", "scale.rate", "law.zmr", "law.zmr2", "law.glenn_chudnovsky", "law.mott":
        values = [by[case, n][key] for n in (250, 500, 1000)]
        if not values[0]:
            assert key == "law.mott" and case in ("uniform", "normal"), (case, key)
            continue
        spread = max(map(float, values)) / min(map(float, values)) - 1
        if case in ("normal", "scattered"):
            assert spread > (0.01 if key.startswith("scale") else 0), (case, key, spread)
        else: # the exact powers of a Weibull's mean, and halving to 1e-14 of log(s): 1e-12 has room
            assert spread < 1e-12, (case, key, spread)
    for n in 250, 500, 1000: # where pieces say nothing, the scales are of an interface's strength, to the digits of the file
        mean, size = (float(by[case, n][key]) for key in ("derived.strength_mean", "scale.size"))
        assert math.isclose(size, E * G / (mean * mean), rel_tol=1e-13) == (case in ("drawn", "area", "normal", "scattered")), (case, n)
# Weibull: sigma^(1 - 2/m) = mean (h/(E G))^(1/m); five powers
h, m = 5e-3 / 500, 10
sigma = (float(by["weibull", 500]["derived.strength_mean"]) * (h / (E * G)) ** (1 / m)) ** (m / (m - 2))
assert abs(float(by["weibull", 500]["scale.size"]) * sigma**2 / (E * G) - 1) < 1e-12
END

# Rates by meshes, as a sweep of both: one line serves them, as its caption says; of a normal distribution none does.
sed '/^sweep/,$d; /^strength/d' meshes.yaml > head
rates()
{
    { cat head
      printf '%s\n' "strength: $1" 'sweep:' '  - zip:' '      loading.rate: [5e4, 1e5]' '      mesh.elements: [250, 500]' 'replicas: 1' 'output: {history: 0}'
    } > rates.yaml
    rm -rf rates
    expect 0 "$fracas" run rates.yaml --study rates --jobs 1
}
page=rates/report/index.html
rates '{distribution: weibull, scale: 300 MPa, shape: 10, reference_volume: 0.02 mm3}'
grep -q 'laws take the mean strength of a piece s₀ long' $page || fail "the caption does not say whose strength laws take"
grep -q '>ZMR<' $page || fail "no line of a law on two meshes"
grep -q 'No line of a law' $page && fail "it says that there is no line, and there is"
rates '{distribution: normal, mean: 300 MPa, deviation: 30 MPa, reference_volume: 0.02 mm3}'
grep -q 'Of 2 points they take an interface’s, which a finer mesh makes stronger' $page || fail "the caption does not say that laws move"
grep -q 'No line of a law for 1 series' $page || fail "a line vanishes without a word"
exit 0
