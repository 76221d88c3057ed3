# Every number of a report is what docs/examples/table_from_study.py has from study.h5 alone: bars, a ring, flat and curved surfaces, computed;
# tests/unit/test_analysis_study.c and _ring.c have those that failed. A number that is wrong, or that the script does not know, is found.
. tests/support/campaigns.sh

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }

cat > all.yaml <<'END'
name: all
seed: 5
model: membrane
geometry: {width: 10 mm, height: 5 mm, thickness: 0.1 mm}
mesh: {divisions: 6, amplitude: 0.2}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 50 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 1e4 1/s}
time: {end: 0.6 us}
replicas: 5
sweep:
  - cases:
      - {name: bar, model: bar, geometry: {shape: bar, length: 5 mm, area: 1 mm2}, mesh: {elements: 50}, material: {young: 370 GPa, density: 3900 kg/m3}, cohesive: {law: nitsche, fracture_energy: 50 J/m2}, loading: {type: imposed-rate, rate: 1e5 1/s}}
      - {name: ring, model: ring, geometry: {shape: ring, radius: 1 mm, area: 1 mm2}, mesh: {elements: 200}, material: {young: 275 GPa, density: 2750 kg/m3}, strength: {distribution: uniform, minimum: 290 MPa, maximum: 310 MPa}, cohesive: {law: stershic, fracture_energy: 100 J/m2}, loading: {type: initial-velocity, radial: 100 m/s}, time: {end: 150 ns, safety: 0.5}}
      - {name: plate, replicas: 9}
      - {name: slow, loading: {rate: 1e2 1/s}}
      - {name: annulus, geometry: {shape: annulus, inner: 2 mm, outer: 4 mm, thickness: 0.1 mm}, mesh: {divisions: 4, order: 2}}
      - {name: octant, model: shell, geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.2 mm}, mesh: {divisions: 8, amplitude: 0.1}, cohesive: {fracture_energy: 100 J/m2}, time: {end: 0.3 us, integrator: hulbert-chung}}
END

check()
{
    /usr/bin/python3 "$source/tests/support/check_numbers.py" "$1" "${2-$source}"
}

expect 0 "$fracas" run all.yaml --study all --jobs 2
check all
expect 0 "$fracas" export all --histories
/usr/bin/python3 "$source/tests/support/check_export.py" all
/usr/bin/python3 - <<'END' || fail "the campaign does not have what is to be compared"
import json
bar, ring, plate, slow, annulus, octant = (point["statistics"] for point in json.load(open("all/report/summary.json"))["points"])
assert ring["radial_velocity.mean"] > 0 and ring["angular_velocity.n"] == 5 and plate["rotation.mean"] > 0
assert octant["dissipated_bending.mean"] > 0 and bar["law.zmr"] > 0 and plate["law.zmr"] is None and slow["count.mean"] == 1
END

# Each number in turn is off, in points.csv and summary.json alike: by 1e-9 of it (motions of rings, which may be a little off, by 1e-8 and
# 2e-9 m/s; variances by 1e-9; ends by 1e-9 of value and length; an end of a bootstrap
# interval, of the plate, is missing: that of few realizations is as exact as a mean), or it is there where none is.
/usr/bin/python3 - "$source" <<'END' || fail "a wrong number went unnoticed"
import copy, csv, json, os, sys
sys.path[:0] = [os.path.join(sys.argv[1], "tests/support")]
from check_numbers import NEAR, check_point, read
import numpy as np
summary, lines = json.load(open("all/report/summary.json")), list(csv.DictReader(open("all/report/points.csv")))
rows = read("all", sys.argv[1])

def found(row, point, line):
    try:
        check_point(row, point, line)
    except AssertionError:
        return True
    return False

def off(key, value, resamples, row):
    name, _, part = key.rpartition(".")
    spread = np.nanstd(resamples[name][0]) if part in ("low", "high") and name in resamples else 0
    if spread > 1e-9 * abs(value):
        return None
    if key.startswith("variance."): # differences of larger numbers
        return value * (1 + 1e-8) + np.copysign(1e-7 if "design_effect" in key else 1e-9, value)
    if part in ("low", "high"): # the least of them are a small difference of two numbers
        size = abs(row[name + ".value"]) + row[name + ".high"] - row[name + ".low"]
        return value + (1e-9 * size if size > 1e-12 else 1)
    relative, absolute = (1e-8, 2e-9) if key.partition(".")[0] in NEAR else (1e-9, 0)
    return value * (1 + relative) + absolute + (value == 0)

planted = 0
for row, point, line in zip(rows, summary["points"], lines, strict=True):
    assert not found(row, point, line)
    for key, value in point["statistics"].items():
        if key in row[2] or key == "unconverged" and row[2]:
            continue # noise of the resamples decides
        wrong, cells = copy.deepcopy(point), dict(line)
        wrong["statistics"][key] = 1 if value is None else off(key, value, row[1], row[0])
        cells[key] = "" if wrong["statistics"][key] is None else repr(float(wrong["statistics"][key]))
        assert found(row, wrong, cells), key
        assert found(row, point, cells), key
        planted += 1
    for key in ("outcomes", "parameters"):
        wrong = copy.deepcopy(point)
        name = next(name for name in wrong[key] if isinstance(wrong[key][name], (int, float)))
        wrong[key][name] += 1
        assert found(row, wrong, line), name
    new = copy.deepcopy(point)
    new["statistics"]["new"] = 1
    assert found(row, new, dict(line, new="1"))
print(planted, "wrong numbers found")
END
