# ctest-labels: ci
# A small sphere that bursts at 1e5 /s, over time: counts at set times, dissipated energy, transits and growth anew from break times, and
# the rule `settled` at a growth of 6 % and 20 transits.
. tests/support/campaigns.sh

cat > sphere.yaml <<'END'
name: sphere
seed: 1
model: shell
geometry: {shape: sphere, radius: 1 mm, thickness: 0.1 mm, part: octant}
mesh: {divisions: 32, amplitude: 0.1}
material: {young: 370 GPa, density: 3900 kg/m3, poisson: 0.22}
cohesive: {law: nitsche, fracture_energy: 50 J/m2}
strength: {distribution: weibull, minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {type: expansion, rate: 1e5 1/s}
time: {end: 800 ns, safety: 0.5, rotary_inertia: 1}
sweep:
  - time: [{stop: time}, {stop: settled, growth: 0.06, transits: 20}]
replicas: 8
output: {history: 20, interfaces: true}
END
expect 0 "$fracas" run --no-report sphere.yaml --study sphere

/usr/bin/python3 - <<'END' || fail "the sphere's numbers over time"
import h5py, numpy as np

study = h5py.File("sphere/study.h5")
r = {name: values[:] for name, values in study["realization"].items()}
radius, speed = 1e-3, np.sqrt(370e9 / (3900 * (1 - 0.22**2)))

def splits(i, point):
    """Times at which the fragments of realization i became one more: joined again from the last break to the first."""
    rows = lambda what, n: slice(*study[f"mesh/{what}_offset"][n:n + 2])
    parent = list(range(rows("element", point).stop - rows("element", point).start))
    def root(e):
        while parent[e] != e:
            parent[e] = e = parent[parent[e]]
        return e
    broke = np.nan_to_num(study["interface/break_time"][slice(*study["interface/offset"][i:i + 2])], nan=np.inf)
    pairs, times = study["mesh/interface_element"][rows("interface", point)], []
    for j in np.argsort(-broke, kind="stable"):
        a, b = root(pairs[j, 0]), root(pairs[j, 1])
        if a != b:
            parent[a] = b
            times.append(broke[j])
    return np.array(times)

split = [splits(i, p) for i, p in enumerate(r["point"])]
count = lambda i, time: 1 + (split[i] <= time).sum()
at = {1e-7: [], 2e-7: [], 4e-7: [], 8e-7: []}
for i, point in enumerate(r["point"]):
    onset, end, n = r["onset_time"][i], r["end_time"][i], count(i, 1)
    assert n == r["fragments"][i] and r["residual"][i] < 1e-3 * r["dissipated"][i] and r["residual"][i] < 0.02 * r["vibrating"][i], i
    # The octant's area is that of curved triangles, right to (edge/R)^4 = 3e-6; L goes as its root.
    transits = (end - onset) * speed / np.sqrt(np.pi * radius**2 / 2 / n)
    assert abs(r["transits"][i] / transits - 1) < 1e-5, (i, r["transits"][i], transits)
    # Half of the time is taken up to an eighth of a doubling early, 2^(-1/8), and a step late.
    early, late = (count(i, onset + (end - onset) / 2 * part) for part in (0.917, 1.01))
    assert 1 - late / n <= r["growth"][i] + 1e-12 and r["growth"][i] <= 1 - early / n + 1e-12, (i, r["growth"][i], early, late, n)
    if point == 1: # has settled, or the cap says that it has not
        assert (r["outcome"][i] == 0) == (r["transits"][i] >= 20 and r["growth"][i] <= 0.06) and (r["outcome"][i] == 0 or end > 0.99 * 8e-7), i
    for time in at:
        if time <= 1.001 * end:
            at[time].append(count(i, time))

# 56 other replicas, at 0.4 to 0.5 of the critical step, have these means and deviations. (The same strengths at another step give other
# counts, as far apart as other strengths.) So 4.5 standard errors of the difference of 56 and n: 7e-6 of a normal.
for (time, counts), (mean, deviation) in zip(at.items(), ((60.7, 5.9), (86.6, 6.2), (100.1, 4.9), (106.0, 4.9))):
    tolerance = 4.5 * deviation * np.sqrt(1 / len(counts) + 1 / 56)
    print(f"{1e9 * time:.0f} ns: {np.mean(counts):.1f} fragments of {len(counts)} replicas, {mean} +- {tolerance:.1f}")
    assert len(counts) >= 8 and abs(np.mean(counts) - mean) < tolerance, (time, counts)
dissipated = r["dissipated"][r["point"] == 0]
print("dissipated", dissipated.mean(), "J")
assert abs(dissipated.mean() - 214.2e-6) < 4.5 * 2.0e-6 * np.sqrt(1 / 8 + 1 / 56), dissipated

# The rule ended six of eight others before 800 ns, after 46 to 62 transits, and none by the growth of a fifth that they have after 20.
ended = (r["outcome"] == 0) & (r["point"] == 1)
print("settled:", ended.sum(), "after", r["transits"][ended].mean(), "transits")
assert ended.sum() >= 4 and 40 < r["transits"][ended].mean() < 70
END
