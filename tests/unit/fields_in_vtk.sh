# ctest-labels: ci
# The fields of a replayed realization of every model, read back by VTK: they are those of the study, and of mechanics.
. tests/support/campaigns.sh

common()
{
    cat <<END
name: $1
seed: 3
model: $1
material: {young: 260 GPa, density: 3690 kg/m3$2}
replicas: 2
output: {interfaces: $3}
END
}

{ common bar '' false; cat <<'END'; } > bar.yaml
geometry: {ends: periodic, length: 3 mm, area: 0.1 mm2}
mesh: {elements: 90}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: weibull, scale: 300 MPa, shape: 20}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: time, end: 80 ns, safety: 0.25}
END
{ common ring '' true; cat <<'END'; } > ring.yaml
geometry: {radius: 0.5 mm, area: 0.1 mm2}
mesh: {elements: 90}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: weibull, scale: 300 MPa, shape: 20}
loading: {type: initial-velocity, radial: 50}
time: {stop: time, end: 80 ns, safety: 0.25}
END
{ common membrane ', poisson: 0.21' true; cat <<'END'; } > membrane.yaml
geometry: {shape: plate, width: 1 mm, height: 1 mm, thickness: 0.1 mm}
mesh: {size: 0.12 mm, amplitude: 0.2}
cohesive: {law: nitsche, fracture_energy: 20 J/m2}
strength: {distribution: weibull, scale: 300 MPa, shape: 10}
loading: {type: expansion, rate: 1e5 1/s}
time: {stop: time, end: 80 ns}
sweep:
  - mesh.order: [1, 2]
END
{ common shell ', poisson: 0.21' true; cat <<'END'; } > shell.yaml
geometry: {shape: sphere, part: octant, radius: 1 mm, thickness: 0.1 mm}
mesh: {divisions: 6, amplitude: 0.1}
cohesive: {law: nitsche, fracture_energy: 20 J/m2}
strength: {distribution: weibull, scale: 300 MPa, shape: 10}
loading: {type: expansion, rate: 1e5 1/s}
time: {stop: time, end: 80 ns}
END
for model in bar ring membrane shell; do
    expect 0 "$fracas" run --no-report $model.yaml --study $model --jobs 1
    expect 0 "$fracas" sample $model.yaml --replica 1 --csv $model.csv
    expect 0 "$fracas" replay $model 0/1 --fields $model.events
    said '^fields: [123] instants of '
    said 'computed again, the same bytes: [1-9][0-9]* fragments'
done
expect 0 "$fracas" sample membrane.yaml --point 1 --replica 1 --csv membrane1.csv
expect 0 "$fracas" replay membrane 1/1 --fields membrane1.events
# Every step of a run: a little less than its time step, of which 15 digits are read.
for at in bar/0 ring/0 membrane/0 membrane/1 shell/0; do
    model=${at%/*} point=${at#*/}
    step=$(/usr/bin/python3 -c "import h5py; print('%.15g' % (h5py.File('$model/study.h5')['realization/time_step'][2 * $point + 1] * (1 - 1e-9)))")
    [ "$point" = 0 ] && point=
    expect 0 "$fracas" replay $model "${at#*/}/1" --fields "$model$point.steps" --every "${step}s"
done

/usr/bin/python3 - <<'END' || fail "the fields are not those of the study"
import csv, json
import h5py, numpy as np, vtk
from vtk.util.numpy_support import vtk_to_numpy

def read(name):
    reader = vtk.vtkHDFReader()
    assert reader.CanReadFile(name)
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    arrays = lambda of: {of.GetArrayName(a): vtk_to_numpy(of.GetArray(a)) for a in range(of.GetNumberOfArrays())}
    n = grid.GetNumberOfCells()
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(n, -1)
    assert (corners.ravel() == np.arange(corners.size)).all() # no common node
    shape = lambda a: a.reshape(corners.shape + a.shape[1:])
    found = {name: shape(a) for name, a in arrays(grid.GetPointData()).items()}
    return dict(found, **arrays(grid.GetCellData()), at=shape(vtk_to_numpy(grid.GetPoints().GetData())), kind=grid.GetCellType(0))

def series(folder, part):
    for one in json.load(open(f"{folder}/{part}.hdf.series"))["files"]:
        yield one["time"], f"{folder}/{one['name']}"

same = lambda a, b: np.array_equal(a, b, equal_nan=True)
close = lambda a, b, scale: np.abs(np.asarray(a) - b).max() <= 1e-12 * scale
young, density, nu = 260e9, 3690, 0.21
kinds = {"bar": (3, 1), "ring": (3, 1), "membrane": (5, 3), "membrane1": (22, 21), "shell": (22, 21)}

for name, kind in kinds.items():
    model, row = name.rstrip("1"), 3 if name.endswith("1") else 1
    study = h5py.File(f"{model}/study.h5")
    rows = lambda what, n: slice(study[what + "offset"][n], study[what + "offset"][n + 1])
    of = {key: study["realization/" + key][row] for key in ("onset_time", "end_time", "mass", "time_step")}
    history = {key: study["history/" + key][rows("history/", row)] for key in ("time", "kinetic", "elastic", "cohesive")}
    fragments = {key: study["fragment/" + key][rows("fragment/", row)] for key in ("mass", "position", "velocity", "elements")}
    strength = np.array([float(line["strength_Pa"]) for line in csv.DictReader(open(name + ".csv"))])
    elastic = history["elastic"] + history["cohesive"]
    instants = sorted({history["time"][history["time"] >= of["onset_time"]][0], history["time"][elastic.argmax()], of["end_time"]})
    bodies, cracks = list(series(name + ".events", "body")), list(series(name + ".events", "interfaces"))
    assert [t for t, _ in bodies] == instants == [t for t, _ in cracks], (name, instants, bodies)

    for (time, body), (_, crack) in zip(bodies, cracks):
        b, c = read(body), read(crack)
        assert (b["kind"], c["kind"]) == kind
        start = b["at"] - b["displacement"]
        size = np.ptp(start)
        if model in ("membrane", "shell"): # where the mesh has its nodes
            node = study["mesh/node_position"][rows("mesh/node_", row // 2)]
            corner = study["mesh/element_node"][rows("mesh/element_", row // 2)][:, :b["at"].shape[1]]
            assert close(start, node[corner], size)
            joined = study["mesh/interface_node"][rows("mesh/interface_", row // 2)]
        else:
            joined = None
        assert same(c["strength"], strength) or close(c["strength"], strength, 1e9)
        cracked = c["onset_time"] <= time
        assert same(cracked, ~np.isnan(c["onset_time"])) and cracked.any() and np.nanmin(c["onset_time"]) == of["onset_time"]
        assert (c["damage"][~cracked] == 0).all() and (c["damage"] <= 1).all()
        assert time < of["end_time"] or (c["opening"][c["damage"] == 1] > 0).any()

        # What an interface opens is what its elements' nodes do: along the normal before any motion, where edges are straight.
        first, second = c["elements"].T
        if model == "bar":
            jump = b["displacement"][second, 0, 0] - b["displacement"][first, 1, 0]
            jump[-1] += 1e5 * time * 3e-3 # the background's: the bar is closed
            assert close(jump, c["opening"], size)
        elif model == "ring":
            jump = b["at"][second, 0] - b["at"][first, 1]
            chord = lambda e: b["at"][e, 1] - b["at"][e, 0]
            along = chord(first) + chord(second)
            tangent = np.roll(start[:, 0], -1, 0)[:, [1, 0, 2]] * [-1, 1, 0]
            projected = [(jump * n).sum(1) / np.linalg.norm(n, axis=1) for n in (along, tangent)]
            assert min(np.abs(p - c["opening"]).max() for p in projected) < 1e-12 * size
        else:
            here = np.array([[[np.flatnonzero(corner[e] == n)[0] for n in ends[:c["at"].shape[1]]] for e in pair]
                             for ends, pair in zip(joined, c["elements"])])
            at = [b["at"][side][np.arange(len(side))[:, None], here[:, s]] for s, side in enumerate((first, second))]
            middle, jump = (at[0] + at[1]) / 2, at[1] - at[0]
            assert close(middle, c["at"], size)
            mean = jump.mean(1) if kind[1] == 3 else (jump[:, 0] + jump[:, 1]) / 6 + jump[:, 2] * 2 / 3
            if model == "membrane":
                edge = np.diff(node[joined[:, :2]], axis=1)[:, 0]
                normal = edge[:, [1, 0, 2]] * [1, -1, 0] / np.linalg.norm(edge, axis=1)[:, None]
                assert close((mean * normal).sum(1), c["opening"], size)
            else:
                assert (np.abs(c["opening"]) <= np.abs(np.linalg.norm(jump, axis=2)).max(1) * (1 + 1e-9)).all()
        # Fragments hang together by interfaces that are not broken, and by nothing else.
        held = c["damage"] < 1
        assert same(b["fragment"][first[held]], b["fragment"][second[held]])

    # At the end all is that of the record.
    sums = lambda x: np.array([np.bincount(b["fragment"], x[..., i].sum(1)) for i in range(x.shape[-1])]).T
    mass = sums(b["mass"][..., None])[:, 0]
    assert close(mass / fragments["mass"], 1, 1) and same(np.bincount(b["fragment"]), fragments["elements"]) and len(mass) > 2
    assert close(mass[b["fragment"]] / b["fragment_mass"], 1, 1) and abs(b["mass"].sum() / of["mass"] - 1) < 1e-12
    free = slice(1 if model == "bar" and b["fragment"][0] == b["fragment"][-1] else 0, None) # the other one lies across the end
    assert close((sums(b["mass"][..., None] * b["at"]) / mass[:, None])[free], fragments["position"][free], size)
    assert close((sums(b["mass"][..., None] * b["velocity"]) / mass[:, None])[free], fragments["velocity"][free], 1e3)
    if "interface" in study:
        for key in "strength", "damage", "onset_time":
            assert same(c[key], study["interface/" + key][rows("interface/", row)]), key

    # Every step: kinetic energy is v-.M v+/2 with the velocities before and after, and is that of the history; so is, in a bar
    # without a crack, the elastic energy.
    files = list(series(name + ".steps", "body"))
    steps = [read(file) for _, file in files]
    times = np.array([t for t, _ in files])
    assert len(times) == study["realization/steps"][row] + 1 and times[0] == 0
    background = 1e5 * start if model == "bar" else 0
    checked = 0
    for time, kinetic, elastic in zip(history["time"], history["kinetic"], history["elastic"]):
        k = int(np.flatnonzero(times == time)[0])
        if k == 0: continue
        product = (steps[k - 1]["velocity"] - background) * (steps[k]["velocity"] - background)
        assert abs((steps[k]["mass"][..., None] * product).sum() / 2 - kinetic) <= 1e-12 * history["kinetic"].max(), (name, k)
        if model == "bar" and time < of["onset_time"]: # no jumps: nothing is in the flux
            stress = steps[k]["stress"]
            assert abs((steps[k]["mass"].sum(1) / density * stress ** 2).sum() / (2 * young) - elastic) <= 1e-12 * history["elastic"].max()
        checked += 1
    assert checked > 20
    print(name, len(times), "steps,", checked, "rows,", len(mass), "fragments")
END
