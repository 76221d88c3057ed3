# A campaign with a design runs as any other: the same bytes whatever computes it, from the file or from its resolved copy, extended by
# points. With common random numbers all points have the same strengths and mesh, replica by replica; else every point its own.
. tests/support/campaigns.sh

# bars FILE RANDOM_NUMBERS TYPE POINTS REPLICAS: a second of one core at most.
bars()
{
    cat > "$1" <<END_OF_CAMPAIGN
name: bars
seed: 7
random_numbers: $2
model: bar
geometry: {ends: periodic, length: 2 mm, area: 1 mm2}
mesh: {elements: 100, spacing: perturbed, amplitude: 0.2}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: weibull, scale: 300 MPa, shape: 10}
loading: {rate: 1e5 1/s}
time: {stop: time, end: 50 ns}
replicas: $5
output: {history: 0, interfaces: true}
sweep:
  - design:
      type: $3
      points: $4
      parameters:
        material.young: {distribution: normal, mean: 275 GPa, deviation: 20 GPa}
        loading.rate: {distribution: log-uniform, minimum: 5e4 1/s, maximum: 2e5 1/s}
      correlation: [{between: [material.young, loading.rate], coefficient: -0.4}]
END_OF_CAMPAIGN
}

# The report, the resolved file, and other ways to compute it.
bars hypercube.yaml independent latin-hypercube 5 3
expect 0 "$fracas" plan hypercube.yaml
said '5 points, 15 realizations'
expect 0 "$fracas" run hypercube.yaml --study one --jobs 1
[ -s one/report/index.html ] || fail "no report"
expect 0 "$fracas" run --no-report one/campaign.yaml --study resolved --jobs 2
same one resolved
cmp one/campaign.yaml resolved/campaign.yaml || fail "the resolved file of a resolved file is another"

/usr/bin/python3 "$source/docs/examples/influence_from_study.py" one/study.h5 > influence
[ "$(cut -f1 influence | tr '\n' ' ')" = 'parameter loading.rate material.young ' ] || fail "influence: $(cat influence)"

# More points: of a Sobol sequence, the same study as computed at once; a Latin hypercube is another one.
bars few.yaml independent sobol 4 2
bars more.yaml independent sobol 7 2
expect 0 "$fracas" run --no-report few.yaml --study grown --jobs 1
expect 0 "$fracas" run --no-report more.yaml --study grown --jobs 1
expect 0 "$fracas" run --no-report more.yaml --study whole --jobs 1
same grown whole
bars larger.yaml independent latin-hypercube 6 3
expect 5 "$fracas" run larger.yaml --study one --jobs 1
said 'in the study (its point 0), but'

# Common random numbers.
bars common.yaml common random 3 2
bars own.yaml independent random 3 2
expect 0 "$fracas" run --no-report common.yaml --study common --jobs 1
expect 0 "$fracas" run --no-report own.yaml --study own --jobs 1
grep -q '^random_numbers: common$' common/campaign.yaml || fail "the resolved file does not say common"
expect 5 "$fracas" run own.yaml --study common --jobs 1
said 'random_numbers is common in the study, but independent'
/usr/bin/python3 - <<'END_OF_CHECK' || fail "common random numbers"
import h5py
import numpy as np

def strengths(path):
    """[point][replica] of the strengths, and the loads that differ from point to point."""
    with h5py.File(path) as study:
        strength = study["interface/strength"][()].reshape(6, 100)
        point, replica = study["realization/point"][()], study["realization/replica"][()]
        assert len(set(study["point/material.young"][()])) == 3
        return {(p, r): s for p, r, s in zip(point, replica, strength)}

common, own = strengths("common/study.h5"), strengths("own/study.h5")
for r in range(2):
    for p in (1, 2):
        assert np.array_equal(common[p, r], common[0, r])
        assert not np.any(own[p, r] == own[0, r])
assert not np.any(common[0, 0] == common[0, 1])
END_OF_CHECK
