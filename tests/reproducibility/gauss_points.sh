# Strengths of Gauss points in graded material, on triangles, curved ones and a shell: study.h5 is the same, byte for byte, whatever
# computes it, and the strength of an interface is the least of those that `fracas sample` draws at its Gauss points.
. tests/support/campaigns.sh

cat > factor.csv <<'END'
x [m], factor
-1e-3, 0.9
0, 1.2
0, 0.8
1e-3, 1
END
cat > all.yaml <<'END'
name: gauss-points
seed: 5
model: membrane
geometry: {width: 4 mm, height: 2 mm, thickness: 0.1 mm}
mesh: {divisions: 4, amplitude: 0.2}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 100 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2, per: gauss-point, factor: factor.csv, factor_along: x}
loading: {rate: 2e4 1/s}
time: {end: 0.2 us}
replicas: 3
output: {interfaces: true}
sweep:
  - cases:
      - {name: plate}
      - {name: annulus, geometry: {shape: annulus, inner: 1 mm, outer: 2 mm, thickness: 0.1 mm}, mesh: {divisions: 3, order: 2}}
      - {name: shell, model: shell, geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.2 mm}, mesh: {divisions: 5}}
END
expect 0 "$fracas" run all.yaml --study one --jobs 1
said 'no dust'
compare all.yaml --jobs 2 --lanes 1 --shuffle
for isa in baseline $(instruction_sets); do
    compare all.yaml --jobs 2 --isa "$isa" --lanes 4
    compare all.yaml --jobs 2 --isa "$isa" --lanes 8
done
expect 0 "$fracas" verify --full one

for point in 0 1 2; do
    expect 0 "$fracas" sample one/campaign.yaml --point $point --replica 1 --csv $point.csv
done
/usr/bin/python3 - <<'END' || fail "the strengths of the study are not those of the sample"
import csv, h5py, numpy as np

study = h5py.File("one/study.h5")
offset, strength, onset = (study["interface/" + name][()] for name in ("offset", "strength", "onset_time"))
for point, points in enumerate((2, 3, 3)):
    rows = list(csv.DictReader(open(f"{point}.csv")))
    drawn = np.array([float(row["strength_Pa"]) for row in rows]).reshape(-1, points)
    i, = np.flatnonzero((study["realization/point"][()] == point) & (study["realization/replica"][()] == 1))
    kept = slice(*offset[i:i + 2])
    assert len(set(drawn[0])) == points
    assert (drawn.min(axis=1) == strength[kept]).all()
    assert np.isfinite(onset[kept]).sum() > 10
    assert {int(row["interface"]) * points + int(row["gauss_point"]) for row in rows} == set(range(drawn.size))
END

# Where strengths are given, each interface has one.
echo 3e8 > given.csv
sed 's/strength: {.*/strength: {distribution: file, file: given.csv, per: gauss-point}/' all.yaml > given.yaml
expect 2 "$fracas" plan given.yaml
said 'strength.per is gauss-point, but the distribution `file` gives one strength to each interface'
