# ctest-labels: storm
# ctest-timeout: 7200
# The rule `settled` on cases that its constants never saw, against runs of the same bodies to k of 180 to 430: one small body a model,
# three rates, narrow and scattered strengths (docs/decisions/settled-counts.md). Prints a table. SETTLED_MODELS: of these models alone,
# shell among them.
. tests/support/campaigns.sh

/usr/bin/python3 - <<'END'
HEAD = """name: judge
seed: 5
random_numbers: common
model: {model}
geometry: {geometry}
mesh: {mesh}
material: {material}
cohesive: {{law: nitsche, fracture_energy: 100 J/m2}}
strength: {{distribution: uniform, minimum: {low} MPa, maximum: {high} MPa}}
loading: {loading}
time: {{stop: settled, end: 28 us, safety: {safety}}}
output: {{history: 4000}}
replicas: {replicas}
sweep:
  - strength:
      - {{distribution: uniform, minimum: {low} MPa, maximum: {high} MPa}}
      - {{distribution: weibull, scale: 300 MPa, shape: {shape}}}
  - cases:
"""
def campaign(name, cases, spread=3, shape=10, **values): # spread: of uniform strengths [MPa]
    with open(name + ".yaml", "w") as out:
        out.write(HEAD.format(model=name, low=300 - spread, high=300 + spread, shape=shape, **values))
        for case, (settings, end) in enumerate(cases):
            for stop in ("settled", "time"):
                out.write(f"      - {{name: {name}-{case}-{stop}, {settings}, time.end: {end}, time.stop: {stop}}}\n")

METAL = "{young: 275 GPa, density: 2750 kg/m3}"
for name, body, sizes in (("bar", "geometry.length", (20, 12, 4)), ("ring", "geometry.radius", (3, 2, 0.6))):
    campaign(name, [(f"loading.rate: {rate} 1/s, {body}: {size} mm, mesh.elements: {n}", end) for rate, size, n, end in
                    zip(("2e3", "2e4", "2e5"), sizes, (800, 1000, 1600), ("28 us", "14 us", "3.6 us"))],
             mesh="{elements: 800}", material=METAL, safety=0.25, replicas=16, loading="{type: imposed-rate, rate: 1e4 1/s}",
             geometry="{ends: periodic, length: 10 mm, area: 1 mm2}" if name == "bar" else "{radius: 3 mm, area: 1 mm2}")
CERAMIC = "{young: 260 GPa, density: 3690 kg/m3, poisson: 0.21}"
campaign("membrane", [(f"loading.rate: {rate} 1/s, geometry.width: {size} mm, geometry.height: {size} mm, mesh.size: {h} mm", end)
                      for rate, size, h, end in (("1.5e4", 6.5, 0.14, "35 us"), ("3.5e4", 4.8, 0.125, "25 us"), ("1e5", 2.4, 0.06, "12 us"))],
         geometry="{shape: plate, width: 5 mm, height: 5 mm, thickness: 0.1 mm}", material=CERAMIC, safety=0.25, spread=15, shape=4,
         mesh="{spacing: triangles, size: 0.2 mm, amplitude: 0.2}", replicas=8, loading="{type: expansion, rate: 3e4 1/s}")
campaign("shell", [(f"loading.rate: {rate} 1/s, geometry.radius: {radius} mm", end)
                   for rate, radius, end in (("1.5e4", 3, "14 us"), ("3.5e4", 2, "9 us"), ("1e5", 0.85, "4 us"))],
         geometry="{shape: sphere, part: octant, radius: 2 mm, thickness: 0.1 mm}", material=CERAMIC, safety="0.25, rotary_inertia: 1", spread=15, shape=4,
         mesh="{spacing: triangles, divisions: 36, order: 2, amplitude: 0.1}", replicas=8, loading="{type: expansion, rate: 3e4 1/s}")
END
models=${SETTLED_MODELS:-bar ring membrane}
for model in $models; do expect 0 "$fracas" run "$model.yaml" --study "$model"; done

# shellcheck disable=SC2086 # a list of words
/usr/bin/python3 - $models <<'END' || fail "the rule misses its bars"
import sys
import h5py, numpy as np

print("| model | rate | strengths | N | final | missed by the stopped [%] | N_final off [%] | k | end by t99 | in the interval | never |")
stopped_all = covered_all = 0
bad = []
for model in sys.argv[1:]:
    study = h5py.File(model + "/study.h5")
    r = {k: v[:] for k, v in study["realization"].items()}
    rate, cap = study["point/derived.strain_rate"][:], study["point/time.end"][:]
    law = study["point/strength.distribution"][:]
    time, seen, offset = (study["history/" + name][:] for name in ("time", "fragments", "offset"))
    for p in range(0, len(rate), 2):
        here, there = (np.flatnonzero(r["point"] == q) for q in (p, p + 1))
        count, final = r["fragments"][here], r["fragments"][there]
        stopped = r["end_time"][here] < 0.999 * cap[p]
        grid = np.linspace(0, cap[p], 4001)
        over_time = np.mean([np.interp(grid, time[offset[i]:offset[i + 1]], seen[offset[i]:offset[i + 1]]) for i in there], axis=0)
        t99 = grid[np.argmax(over_time >= 0.99 * final.mean())]
        growth, rest, bound = (r[name][here] for name in ("growth", "rest", "rest_bound"))
        if model in ("bar", "ring"):
            high, estimate = count + np.minimum(bound, 1.5 * rest + 2 * np.sqrt(r["rest_variance"][here])), count + rest
        else:
            high, estimate = count * (1.02 + growth) + 0.5, count * (1 + growth)
        covered = ((final >= count) & (final <= high))[stopped]
        part = lambda values: values[stopped].sum() / final[stopped].sum() if stopped.any() else np.nan
        missed, off = 100 * (1 - part(count)), 100 * (part(estimate) - 1)
        mean = lambda values: values[stopped].mean() if stopped.any() else np.nan
        assert (r["outcome"][here][~stopped] == 2).all() and (r["outcome"][here][stopped] == 0).all() # none stops silently
        stopped_all, covered_all = stopped_all + stopped.sum(), covered_all + covered.sum()
        print(f"| {model} | {rate[p]:.2g} | {law[p].decode()} | {count.mean():.1f} | {final.mean():.1f} | {missed:.1f} | {off:+.1f} | "
              f"{mean(r['transits'][here]):.0f} | {mean(r['end_time'][here]) / t99:.2f} | {covered.sum()} of {stopped.sum()} | "
              f"{(~stopped).sum()} of {len(here)} |", flush=True)
        if missed >= 3:
            bad.append((model, rate[p], missed))
print(f"in the interval: {covered_all} of {stopped_all}")
assert not bad, bad
assert covered_all >= 0.9 * stopped_all
END
