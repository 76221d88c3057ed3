# `fracas export --vtk`: realizations as they move, from what a study keeps, against the fields of the same realizations computed again.
. tests/support/campaigns.sh

cat > bodies.yaml <<'YAML'
name: bodies
seed: 5
model: membrane
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {law: nitsche, fracture_energy: 50 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 3e4 1/s}
time: {stop: time, end: 1.5 us}
replicas: 2
output: {interfaces: true}
sweep:
  - cases:
      - {name: bar, model: bar, geometry: {shape: bar, length: 5 mm, area: 1 mm2}, mesh: {elements: 80}, material: {young: 370 GPa, density: 3900 kg/m3}, loading: {type: imposed-rate, rate: 5e3 1/s}}
      - {name: ring, model: ring, geometry: {shape: ring, radius: 2 mm, area: 0.1 mm2}, mesh: {elements: 160}, material: {young: 370 GPa, density: 3900 kg/m3}, loading: {type: initial-velocity, radial: 20 m/s}}
      - {name: plate, geometry: {shape: plate, width: 4 mm, height: 2 mm, thickness: 0.1 mm}, mesh: {divisions: 8, amplitude: 0.2}}
      - {name: annulus, geometry: {shape: annulus, inner: 1 mm, outer: 2 mm, thickness: 0.1 mm}, mesh: {divisions: 4, order: 2}}
      - {name: sphere, model: shell, geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.1 mm}, mesh: {divisions: 6}}
YAML
expect 0 "$fracas" run --no-report bodies.yaml --study bodies
for point in 0 1 2 3 4; do
    expect 0 "$fracas" replay bodies $point/1 --fields fields-$point --every 150ns --at end --json
    times=$(sed 's/.*"time" *: *\([^}]*\)}.*/\1s,/;/^[0-9]/!d' fields-$point/body.hdf.series | tr -d '\n ')
    expect 0 "$fracas" export bodies --vtk --point $point --replica 1 --times "${times%,}" --to grids
    said "^grids/point-$point-replica-1-body.hdf.series: [1-9][0-9]* times, "
    said "^grids/point-$point-replica-1-interfaces.hdf.series: [1-9][0-9]* times, "
done

/usr/bin/python3 - <<'END' || fail "the motion of a study is not that of its replay"
import json
import h5py, numpy as np

study = h5py.File("bodies/study.h5")
calm = 0
# [element][1][corner]: integrals of the shape functions over elements, by a rule of degree 5; of a shell, lumped: those of their
# squares, with the sum of the former.
def areas(x):
    if x.shape[1] == 2:
        return np.linalg.norm(x[:, 1] - x[:, 0], axis=1)[:, None, None] * np.full((1, 1, 2), 0.5)
    root, spots, total, own = np.sqrt(15), [((1 / 3,) * 3, 9 / 40)], 0, 0
    for a, w in ((6 - root) / 21, (155 - root) / 1200), ((6 + root) / 21, (155 + root) / 1200):
        spots += [(tuple(np.roll((1 - 2 * a, a, a), k)), w) for k in range(3)]
    for l, w in spots:
        d = np.array([[-1, 1, 0], [-1, 0, 1]])
        n, slope = np.array(l), d
        if x.shape[1] == 6:
            l, next = np.array(l), [1, 2, 0]
            n = np.concatenate([l * (2 * l - 1), 4 * l * l[next]])
            slope = np.concatenate([(4 * l - 1) * d, 4 * (d * l[next] + l * d[:, next])], axis=1)
        t = slope @ x
        area = (w * np.linalg.norm(np.cross(t[:, 0], t[:, 1]), axis=1) / 2)[:, None, None]
        total, own = total + area * n, own + area * n * n
    return total if np.ptp(x[:, :, 2]) == 0 else own * total.sum(axis=2, keepdims=True) / own.sum(axis=2, keepdims=True)

for point, (corners, ends) in enumerate([(2, 1), (2, 1), (3, 2), (6, 3), (6, 3)]):
    row = 2 * point + 1
    of = lambda what: json.load(open(what + ".hdf.series"))["files"]
    computed, flown = of(f"fields-{point}/body"), of(f"grids/point-{point}-replica-1-body")
    faces = of(f"grids/point-{point}-replica-1-interfaces")
    replayed = of(f"fields-{point}/interfaces")
    assert all(np.allclose([f["time"] for f in one], [f["time"] for f in computed], rtol=1e-14) for one in (flown, faces, replayed))
    assert len(computed) > 8
    at = slice(*study["fragment/offset"][row:row + 2])
    mass = study["fragment/mass"][at]
    rows = slice(*study["interface/offset"][row:row + 2])
    broke = study["interface/break_time"][rows]
    assert len(mass) > 3, (point, len(mass))
    last = h5py.File(f"fields-{point}/" + computed[-1]["name"])["VTKHDF/CellData/fragment"][()]
    still = True  # from here to the end nothing pushes the fragments of a bar
    for a, b, c, d in reversed(list(zip(computed, flown, faces, replayed))):
        was, now, crack = (h5py.File(name)["VTKHDF"] for name in (f"fields-{point}/" + a["name"], "grids/" + b["name"], "grids/" + c["name"]))
        true = h5py.File(f"fields-{point}/" + d["name"])["VTKHDF"]
        point_of = lambda grid, name: grid["PointData/" + name][()].reshape(len(last), corners, 3)
        # The mesh before any motion, the same fragments with their masses, the same interfaces.
        start = was["Points"][()] - was["PointData/displacement"][()]
        assert (abs(now["Points"][()] - now["PointData/displacement"][()] - start) <= 1e-14 * abs(start).max() * 100).all()
        assert (now["CellData/fragment"][()] == was["CellData/fragment"][()]).all()
        assert np.allclose(now["CellData/fragment_mass"][()], was["CellData/fragment_mass"][()], rtol=1e-12)
        assert (np.bincount(now["CellData/fragment"][()])[now["CellData/fragment"][()]] == now["CellData/elements"][()]).all()
        assert ((crack["CellData/state"][()] == 2) == (broke <= a["time"])).all() and np.array_equal(crack["CellData/break_time"][()], broke, equal_nan=True)
        # Interfaces are half-way between their sides: where the replay has them, but for how far its elements have moved otherwise.
        off = abs(now["Points"][()] - was["Points"][()]).max() + 1e-12
        assert crack["Points"].shape == true["Points"].shape and (abs(crack["Points"][()] - true["Points"][()]) <= off).all()
        # Centres of the fragments of the end: exact there, and as long as nothing pushes them.
        weight = was["PointData/mass"][()].reshape(len(last), corners)
        mean = lambda x: np.stack([np.bincount(last, (weight * x[:, :, k]).sum(axis=1)) for k in range(3)], axis=1) / np.bincount(last, weight.sum(axis=1))[:, None]
        moved = mean(point_of(was, "displacement"))
        miss = np.sqrt((mass[:, None] * (mean(point_of(now, "displacement")) - moved) ** 2).sum() / (mass[:, None] * moved ** 2).sum()) if a["time"] else 0
        speed, wanted = mean(point_of(now, "velocity")), mean(point_of(was, "velocity"))
        still = still and (abs(wanted - speed) <= 1e-9 * abs(speed).max()).all()
        if a["time"] == computed[-1]["time"]:
            exact = 1e-2 if point == 3 else 1e-3 if point == 4 else 1e-10  # masses of an annulus are coupled; rules on a sphere differ
            wide = areas(start.reshape(len(last), corners, 3))
            for f in range(len(mass)):
                if point or f:  # the first one of the bar goes through its seam
                    x = (wide @ now["Points"][()].reshape(len(last), corners, 3))[last == f, 0].sum(axis=0) / wide[last == f].sum()
                    assert (abs(x - study["fragment/position"][at][f]) < (1e-12 if corners < 6 else 1e-8)).all(), (point, f, x - study["fragment/position"][at][f])  # two rules on a sphere
            assert miss < exact and (abs(wanted - speed) <= exact * abs(speed).max()).all(), (point, miss)
        elif point == 0 and still:
            assert miss < 1e-9, (a["time"], miss)
            calm += 1
        assert miss < 0.1 or a["time"] < 7e-7, (point, a["time"], miss)
        assert not now["PointData/displacement"][()].any() or a["time"]
assert calm > 0
END

# Fragments fly on after the end: by their velocity, and turned about their centres.
expect 0 "$fracas" export bodies --vtk --point 2 --replica 1 --times 1.5us,2us,4us --to later
/usr/bin/python3 - <<'END' || fail "fragments do not fly on as rigid bodies"
import h5py, numpy as np

study = h5py.File("bodies/study.h5")
of = lambda name: study["fragment/" + name][slice(*study["fragment/offset"][5:7])]
end = study["realization/end_time"][5]
for k, time in enumerate((2e-6, 4e-6), 2):
    now, before = (h5py.File(f"later/point-2-replica-1-body-{n}.hdf")["VTKHDF"] for n in (k, 1))
    fragment = now["CellData/fragment"][()]
    x, old = now["Points"][()].reshape(-1, 3, 3), before["Points"][()].reshape(-1, 3, 3)
    v = now["PointData/velocity"][()].reshape(-1, 3, 3)
    for f in range(len(of("mass"))):
        centre = of("position")[f] + of("velocity")[f] * (time - end)
        arm = x[fragment == f].reshape(-1, 3) - centre
        spin = of("spin")[f]
        assert (abs(v[fragment == f].reshape(-1, 3) - of("velocity")[f] - np.cross(spin, arm)) < 1e-9 * abs(of("velocity")).max()).all()
        turn = spin[2] * (time - 1.5e-6)
        rotation = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
        first = old[fragment == f].reshape(-1, 3) - of("position")[f] - of("velocity")[f] * (1.5e-6 - end)
        assert (abs(arm - first @ rotation.T) < 1e-12).all()
    size = lambda p: np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2)
    assert (abs(size(x) - size(old)) < 1e-12).all()  # rigid
END

# Elements of a bar with periodic ends that differ in length: only the fragment through the seam does not know its own.
sed -e 's/^name:.*/name: uneven/; /^sweep/,$d; s/^model:.*/model: bar/; s/poisson: 0.25, //' bodies.yaml > uneven.yaml
cat >> uneven.yaml <<'END'
sweep:
  - cases:
      - {name: graded, model: bar, geometry: {shape: bar, length: 5 mm, area: 1 mm2}, mesh: {elements: 80, spacing: graded, ratio: 4}, material: {young: 370 GPa, density: 3900 kg/m3}, loading: {type: imposed-rate, rate: 5e3 1/s}}
      - {name: perturbed, model: bar, geometry: {shape: bar, length: 5 mm, area: 1 mm2}, mesh: {elements: 80, spacing: perturbed, amplitude: 0.4}, material: {young: 370 GPa, density: 3900 kg/m3}, loading: {type: imposed-rate, rate: 5e3 1/s}}
END
expect 0 "$fracas" run --no-report uneven.yaml --study uneven
for point in 0 1; do
    expect 0 "$fracas" replay uneven $point/0 --fields uneven-$point --at end
    expect 0 "$fracas" export uneven --vtk --point $point --replica 0 --times 1 --to even
done
/usr/bin/python3 - <<'END' || fail "fragments of uneven bars are elsewhere"
import h5py, numpy as np

for point in 0, 1:
    was, now = (h5py.File(name)["VTKHDF"] for name in (f"uneven-{point}/body-1.hdf", f"even/point-{point}-replica-0-body-1.hdf"))
    label = was["CellData/fragment"][()]
    assert (label == now["CellData/fragment"][()]).all() and label[0] == label[-1] and label.max() > 3  # one goes through the seam
    mass = was["PointData/mass"][()].reshape(-1, 2)
    x = was["Points"][()].reshape(-1, 2, 3)[:, :, 0]
    u = [one["PointData/displacement"][()].reshape(-1, 2, 3)[:, :, 0] for one in (was, now)]
    for f in range(1, label.max() + 1):
        mean = [np.average(one[label == f].mean(axis=1), weights=mass[label == f].sum(axis=1)) for one in u]
        assert abs(mean[0] - mean[1]) < 1e-10, (point, f, mean)
END

# A body that turned before it broke.
sed -e 's/^name:.*/name: turning/; /^sweep/,$d; s/^model:.*/model: ring/; s/poisson: 0.25, //; s/^loading:.*/loading: {type: initial-velocity, radial: 20 m\/s, circumferential: 200 m\/s}/' \
    -e 's/^time:.*/time: {stop: time, end: 4 us}/' bodies.yaml > turning.yaml
echo 'geometry: {shape: ring, radius: 2 mm, area: 0.1 mm2}
mesh: {elements: 160}' >> turning.yaml
expect 0 "$fracas" run --no-report turning.yaml --study turning
expect 0 "$fracas" replay turning 0/0 --fields turned --every 1us --at end
expect 0 "$fracas" export turning --vtk --point 0 --replica 0 --times 0s,1us,2us,3us,4.1us --to turns
/usr/bin/python3 - <<'END' || fail "fragments have turned by other angles"
import json
import h5py, numpy as np

times = [f["time"] for f in json.load(open("turned/body.hdf.series"))["files"]]
last = h5py.File(f"turned/body-{len(times)}.hdf")["VTKHDF/CellData/fragment"][()]
def angles(name):
    grid = h5py.File(name)["VTKHDF"]
    x, u = (grid[key][()].reshape(-1, 2, 3)[:, :, :2] for key in ("Points", "PointData/displacement"))
    old, now = (end[:, 1] - end[:, 0] for end in (x - u, x))
    cross, dot = old[:, 0] * now[:, 1] - old[:, 1] * now[:, 0], (old * now).sum(axis=1)
    return np.array([np.arctan2(cross[last == f].sum(), dot[last == f].sum()) for f in range(last.max() + 1)])
for k in range(1, 4):
    wanted, got = angles(f"turned/body-{k + 1}.hdf"), angles(f"turns/point-0-replica-0-body-{k + 1}.hdf")
    rms = lambda x: np.sqrt((x * x).mean())
    assert rms(wanted) > 0.09 * k and rms(got - wanted) < 0.1 * rms(wanted), (k, rms(wanted), rms(got - wanted))
END

# All points, the realizations of the report.
expect 0 "$fracas" export bodies --vtk --times 2
[ "$(ls bodies/vtk/*.series | wc -l)" = 10 ] || fail "two series a point were expected"

# A film of the same motion.
expect 0 "$fracas" picture bodies --point 1 --replica 1 --film -o films
said '^films/surface-point-1-replica-1.html: 24 times$'
/usr/bin/python3 - <<'END' || fail "the film is not of the motion"
import base64, json, re
import h5py, numpy as np

page = open("films/surface-point-1-replica-1.html", encoding="utf-8").read()
film = json.loads(re.search(r'id="film">(.*?)</script>', page, re.S).group(1))
bytes_of = lambda name: base64.b64decode(re.search(f'id="{name}">(.*?)</script>', page, re.S).group(1))
study = h5py.File("bodies/study.h5")
times = np.array([i["time"] for i in film["instants"]])
assert len(times) == 24 and (np.diff(times) >= 0).all() and times[0] == 0 and times[-1] == study["realization/end_time"][3]
assert film["instants"][-1]["fragments"] == study["realization/fragments"][3] and film["instants"][0]["fragments"] == 1
data, n = bytes_of("instant23"), film["elements"]
label, step = np.frombuffer(data, "<u4", n), np.frombuffer(data, "<u2", 4 * n, 4 * n).reshape(-1, 2)
low, high = np.array(film["moved"]).reshape(2, 2).T
moved = (low + (high - low) * step / 65535).reshape(-1, 2, 2).mean(axis=1)
start = np.frombuffer(bytes_of("place"), "<f4").reshape(-1, 2, 3).mean(axis=1)[:, :2] + film["middle"][:2]
_, fragment = np.unique(label, return_inverse=True)
wanted = study["fragment/position"][slice(*study["fragment/offset"][3:5])][:, :2]
for f in range(len(wanted)):
    assert (abs((start + moved)[fragment == f].mean(axis=0) - wanted[f]) < (high - low) / 65535 + 1e-9).all(), f
END

# The report leaves somebody's own file, however long its name is.
long=bodies/report/film-point-$(printf 'x%.0s' $(seq 90)).html
expect 0 "$fracas" report bodies
touch "$long"
expect 0 "$fracas" report bodies
[ -e "$long" ] && [ -e bodies/report/film-point-4.html ] || fail "a film is gone"

# Times that no browser likes to hold; one step of a larger body is enough.
cat > large.yaml <<'END'
name: large
seed: 5
model: shell
geometry: {shape: sphere, part: octant, radius: 2 mm, thickness: 0.1 mm}
mesh: {divisions: 60}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {law: nitsche, fracture_energy: 50 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 1e4 1/s}
time: {stop: time, end: 0.1 ns}
replicas: 1
output: {interfaces: true}
END
expect 0 "$fracas" run --no-report large.yaml --study large
expect 2 "$fracas" picture large --film --times 1000 -o none
said 'a film of 1000 times would have more than browsers like to hold: say --times [1-9][0-9]*, or see `fracas export --vtk`'

# Refused.
expect 2 "$fracas" export bodies --vtk --point 5
said 'there is no point 5: the study has 5 of them'
expect 2 "$fracas" export bodies --vtk --point 1 --replica 2
said 'there is no replica 2: point 1 has 2 of them'
said 'nothing was exported: choose another point or replica'
expect 2 "$fracas" export bodies --vtk --times 1us,-1us
said 'no time is below 0'
# Somebody's files stay; of an older export in STUDY/vtk none does.
expect 2 "$fracas" export bodies --vtk --point 2 --replica 1 --times 1 --to grids
said 'grids/point-2-replica-1-body.hdf.series is there already: name another folder, or remove it'
touch later/point-3-replica-1-interfaces-2.hdf
expect 2 "$fracas" export bodies --vtk --point 3 --replica 1 --times 2 --to later
said 'later/point-3-replica-1-interfaces-2.hdf is there already'
expect 0 "$fracas" export bodies --vtk --times 5us,0us,5us --point 1
[ "$(ls bodies/vtk/point-1-*-body-* | wc -l)" = 2 ] || fail "not two times"
expect 0 "$fracas" gc bodies
! grep -q vtk said || fail "gc does not know the folder"
expect 2 "$fracas" export bodies --point 1
said 'export: --point is for --vtk'
expect 2 "$fracas" export bodies --vtk --cracks
said 'export: --vtk is in the place of tables: call it without --cracks'
expect 2 "$fracas" export bodies --vtk --study other
said 'export: --vtk and --study are two ways: choose one'
expect 2 "$fracas" export bodies --vtk --times x
said 'export: --times is `x`'
expect 2 "$fracas" picture bodies --film --view 45,30
said 'a film has controls of its own'
sed 's/^output:.*//; s/^name:.*/name: without/' bodies.yaml > without.yaml
expect 0 "$fracas" run --no-report without.yaml --study without --jobs 2
expect 2 "$fracas" export without --vtk
said 'the study keeps no interfaces'
