# Correlated strength fields of a bar with held ends, one that is closed, one on a perturbed mesh, a ring and a plate: study.h5 is the
# same, byte for byte, whatever computes it.
. tests/support/campaigns.sh

# fields FILE REPLICAS: a second of one core.
fields()
{
    cat > "$1" <<END
name: fields
seed: 3
model: bar
geometry: {length: 10 mm, area: 1 mm2}
mesh: {elements: 150}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: uniform, minimum: 290 MPa, maximum: 310 MPa, covariance: exponential, correlation_length: 0.5 mm}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: time, end: 150 ns}
replicas: $2
output: {interfaces: true}
sweep:
  - cases:
      - {name: closed}
      - {name: held, geometry: {ends: held, length: 10 mm, area: 1 mm2}, strength.covariance: matern}
      - {name: perturbed, mesh: {elements: 150, spacing: perturbed, amplitude: 0.3}}
      - {name: ring, model: ring, geometry: {radius: 1 mm, area: 1 mm2}, loading: {type: initial-velocity, radial: 100 m/s}, strength: {covariance: matern, smoothness: 0.8}}
      - {name: plate, model: membrane, geometry: {shape: plate, width: 10 mm, height: 5 mm, thickness: 0.1 mm}, mesh: {divisions: 12, amplitude: 0.2}, material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}, loading: {type: expansion, rate: 1e5 1/s}}
END
}

fields all.yaml 3
expect 0 "$fracas" run --no-report all.yaml --study one --jobs 1
compare_compilers all.yaml
compare all.yaml --jobs 2 --shuffle --lanes 1 --lease-time 0 --segment-size 1e-6
for isa in baseline $(instruction_sets); do
    compare all.yaml --jobs 2 --isa "$isa" --lanes 8
done

# Strengths in study.h5 are alike near to each other. Next interfaces of a chain are l/7.5 apart: exp(-1/7.5) = 0.88, more with matern;
# every 40th is 5 l away. Of three times 150 strengths, some 30 of which are independent: +- 0.2.
/usr/bin/python3 - <<'END' || fail "strengths in study.h5 are not alike where they are near"
import h5py, numpy as np

study = h5py.File("one/study.h5")
offset, strength = study["interface/offset"][()], study["interface/strength"][()]
point = study["realization/point"][()]
for p in range(4):
    rows = np.array([strength[offset[i]:offset[i + 1]] for i in np.flatnonzero(point == p)])
    rows = (rows - 300e6) / rows.std()
    near, far = (rows[:, 1:] * rows[:, :-1]).mean(), (rows[:, 40:] * rows[:, :-40]).mean()
    assert near > 0.75 and far < 0.5, (p, near, far)
END

# More replicas change nothing that was there.
fields part.yaml 1
expect 0 "$fracas" run --no-report part.yaml --study extended
expect 0 "$fracas" run --no-report all.yaml --study extended
same one extended
echo "$others other ways and an extension: the same bytes"
