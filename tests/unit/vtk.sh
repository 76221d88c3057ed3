# ctest-labels: ci
# VTK reads what `fracas picture --vtk` writes, and finds the numbers of the study.
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
for point in 0 1; do expect 0 "$fracas" picture plate --point $point --replica 1 --times 3 --vtk -o grids; done

/usr/bin/python3 - <<'END' || fail "VTK does not read the study's numbers"
import json
import h5py, numpy as np, vtk
from vtk.util.numpy_support import vtk_to_numpy

def read(part, point, k):
    name = f"grids/surface-point-{point}-replica-1-{part}-{k}.hdf"
    reader = vtk.vtkHDFReader()
    assert reader.CanReadFile(name)
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    cells = grid.GetCellData()
    return (vtk_to_numpy(grid.GetPoints().GetData()), vtk_to_numpy(grid.GetCells().GetConnectivityArray()), grid.GetCellType(0),
            {cells.GetArrayName(a): vtk_to_numpy(cells.GetArray(a)) for a in range(cells.GetNumberOfArrays())})

same = lambda a, b: np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
study = h5py.File("plate/study.h5")
rows = lambda what, n: slice(study[what + "offset"][n], study[what + "offset"][n + 1])
for point in 0, 1:
    row, corners = 2 * point + 1, (3, 6)[point]
    series = json.load(open(f"grids/surface-point-{point}-replica-1-cracks.hdf.series"))["files"]
    interface = {name: study["interface/" + name][rows("interface/", row)] for name in ("strength", "damage", "onset_time", "break_time")}
    for k, one in enumerate(series, 1):
        nodes, corner, kind, cell = read("cracks", point, k)
        assert one["name"] == f"surface-point-{point}-replica-1-cracks-{k}.hdf"
        assert same(nodes, study["mesh/node_position"][rows("mesh/node_", point)]) and kind == (3, 21)[point]
        assert same(corner, study["mesh/interface_node"][rows("mesh/interface_", point)][:, :2 + point].ravel())
        for name, values in interface.items():
            assert same(cell["damage_at_end" if name == "damage" else name], values), name
        state = (interface["onset_time"] <= one["time"]) * 1 + (interface["break_time"] <= one["time"])
        assert same(cell["state"], state)
        nodes, corner, kind, cell = read("fragments", point, k)
        assert same(nodes, study["mesh/node_position"][rows("mesh/node_", point)]) and kind == (5, 22)[point]
        assert same(corner, study["mesh/element_node"][rows("mesh/element_", point)][:, :corners].ravel())
        assert same(np.bincount(cell["fragment"])[cell["fragment"]], cell["elements"])
    assert one["time"] == study["realization/end_time"][row] and (state == 2).any() and (state == 0).any()
    sizes = np.sort(np.bincount(cell["fragment"]))
    assert len(sizes) > 3 and same(sizes, np.sort(study["fragment/elements"][rows("fragment/", row)]))
END
