# `fracas replay --one-file`: read step by step as the format VTKHDF 2.0 says, the file has what one file an instant has.
. tests/support/campaigns.sh

campaign chain.yaml 2 '1e5 1/s'
cat > surface.yaml <<'END'
name: surface
seed: 3
model: membrane
geometry: {shape: plate, width: 1 mm, height: 1 mm, thickness: 0.1 mm}
mesh: {size: 0.2 mm, order: 2, amplitude: 0.2}
material: {young: 260 GPa, density: 3690 kg/m3, poisson: 0.21}
cohesive: {law: nitsche, fracture_energy: 20 J/m2, beta: 10}
strength: {distribution: weibull, scale: 300 MPa, shape: 10}
loading: {type: expansion, rate: 1e5 1/s}
time: {stop: time, end: 0.1 us}
replicas: 2
END
for name in chain surface; do
    expect 0 "$fracas" run --no-report $name.yaml --study $name --jobs 1
    expect 0 "$fracas" replay $name 0/1 --fields $name.many --every 15ns --at onset,peak,end
    expect 0 "$fracas" replay $name 0/1 --fields $name.one --every 15ns --at onset,peak,end --one-file
    said 'computed again, the same bytes: [1-9][0-9]* fragments'
    [ "$(ls -A $name.one)" = "$(printf 'body.vtkhdf\ninterfaces.vtkhdf')" ] || fail "$(ls -A $name.one)"
done

/usr/bin/python3 - <<'END' || fail "one file differs from many"
import json, os
import h5py

# What VTK 9.3's reader of unstructured grids reads at a step: rows from the step's offsets on; cells of a part begin one row
# later in Offsets for every part before it.
def read_step(root, k):
    steps = root["Steps"]
    part = steps["PartOffsets"][k]
    assert steps["NumberOfParts"][k] == 1
    points, cells, corners = (root[name][part] for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
    first_point, first_cell = steps["PointOffsets"][k], steps["CellOffsets"][k]
    rows = lambda data, first, count: data[first:first + count]
    found = {"Points": rows(root["Points"], first_point, points),
             "Offsets": rows(root["Offsets"], first_cell + part, cells + 1),
             "Connectivity": rows(root["Connectivity"], steps["ConnectivityIdOffsets"][k], corners),
             "Types": rows(root["Types"], first_cell, cells)}
    for group, count in ("PointData", points), ("CellData", cells):
        assert set(steps[group + "Offsets"]) == set(root[group])
        for name in root[group]:
            found[group + "/" + name] = rows(root[group][name], steps[group + "Offsets"][name][k], count)
    return found

for name in "chain", "surface":
    for part in "body", "interfaces":
        files = json.load(open(f"{name}.many/{part}.hdf.series"))["files"]
        root = h5py.File(f"{name}.one/{part}.vtkhdf")["VTKHDF"]
        steps = root["Steps"]
        assert list(root.attrs["Version"]) == [2, 0] and bytes(root.attrs["Type"]) == b"UnstructuredGrid"
        assert steps.attrs["NSteps"] == len(files) > 5 and list(steps["Values"]) == [one["time"] for one in files]
        for offsets in "PartOffsets", "NumberOfParts", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets":
            assert steps[offsets].shape == (len(files),) and steps[offsets].dtype == "i8"
        for k, one in enumerate(files):
            many = h5py.File(f"{name}.many/{one['name']}")["VTKHDF"]
            wanted = {key: many[key] for key in ("Points", "Offsets", "Connectivity", "Types")}
            wanted.update({f"{group}/{key}": many[group][key] for group in ("PointData", "CellData") for key in many[group]})
            found = read_step(root, k)
            assert found.keys() == wanted.keys()
            for key, values in wanted.items():
                assert found[key].dtype == values.dtype and found[key].shape == values.shape
                assert found[key].tobytes() == values[:].tobytes(), (name, part, k, key)
    sizes = [sum(os.path.getsize(f"{folder}/{file}") for file in os.listdir(folder)) for folder in (name + ".one", name + ".many")]
    assert sizes[0] < 0.85 * sizes[1], sizes
END
