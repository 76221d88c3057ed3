# ctest-labels: ci
# VTK reads what `fracas export --vtk` writes, and finds the numbers of the study.
. tests/support/campaigns.sh

cat > plate.yaml <<'END'
name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 2 mm, height: 2 mm, thickness: 0.1 mm}
mesh: {size: 0.1 mm, amplitude: 0.2}
material: {young: 260 GPa, density: 3690 kg/m3, poisson: 0.21}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: weibull, scale: 300 MPa, shape: 10}
loading: {type: expansion, rate: 5e4 1/s}
time: {stop: time, end: 1 us}
sweep:
  - mesh.order: [1, 2]
replicas: 2
output: {interfaces: true}
END
expect 0 "$fracas" run --no-report plate.yaml --study plate
expect 0 "$fracas" export plate --vtk --replica 1 --times 3 --to grids

/usr/bin/python3 - <<'END' || fail "VTK does not read the study's numbers"
import json
import h5py, numpy as np, vtk
from vtk.util.numpy_support import vtk_to_numpy

def read(part, point, k):
    name = f"grids/point-{point}-replica-1-{part}-{k}.hdf"
    reader = vtk.vtkHDFReader()
    assert reader.CanReadFile(name)
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    arrays = lambda data: {data.GetArrayName(a): vtk_to_numpy(data.GetArray(a)) for a in range(data.GetNumberOfArrays())}
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    assert (corners == np.arange(grid.GetNumberOfPoints())).all()  # cells have nodes of their own
    return vtk_to_numpy(grid.GetPoints().GetData()), grid.GetCellType(0), arrays(grid.GetCellData()), arrays(grid.GetPointData())

same = lambda a, b: np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
study = h5py.File("plate/study.h5")
rows = lambda what, n: slice(study[what + "offset"][n], study[what + "offset"][n + 1])
for point in 0, 1:
    row, corners = 2 * point + 1, (3, 6)[point]
    series = json.load(open(f"grids/point-{point}-replica-1-interfaces.hdf.series"))["files"]
    interface = {name: study["interface/" + name][rows("interface/", row)] for name in ("strength", "damage", "onset_time", "break_time")}
    start = study["mesh/node_position"][rows("mesh/node_", point)]
    element, edge = (study[f"mesh/{of}_node"][rows(f"mesh/{of}_", point)] for of in ("element", "interface"))
    for k, one in enumerate(series, 1):
        nodes, kind, cell, _ = read("interfaces", point, k)
        assert one["name"] == f"point-{point}-replica-1-interfaces-{k}.hdf" and kind == (3, 21)[point]
        for name, values in interface.items():
            assert same(cell["damage_at_end" if name == "damage" else name], values), name
        state = (interface["onset_time"] <= one["time"]) * 1 + (interface["break_time"] <= one["time"])
        assert same(cell["state"], state)
        body, kind, cell, at = read("body", point, k)
        moved = at["displacement"]
        assert kind == (5, 22)[point] and abs(body - moved - start[element[:, :corners].ravel()]).max() < 1e-15
        # An interface is between where its elements have gone, which are apart by no more than they have moved.
        assert abs(nodes - start[edge[:, :2 + point].ravel()]).max() <= abs(moved).max() + 1e-15
        assert same(np.bincount(cell["fragment"])[cell["fragment"]], cell["elements"])
        weight = study["fragment/mass"][rows("fragment/", row)].sum()
        whole = np.unique(np.stack([cell["fragment"], cell["fragment_mass"]]), axis=1)[1].sum()
        assert abs(whole / weight - 1) < 1e-12 and at["velocity"].shape == moved.shape
    assert one["time"] == study["realization/end_time"][row] and (state == 2).any() and (state == 0).any()
    sizes = np.sort(np.bincount(cell["fragment"]))
    assert len(sizes) > 3 and same(sizes, np.sort(study["fragment/elements"][rows("fragment/", row)]))
END
