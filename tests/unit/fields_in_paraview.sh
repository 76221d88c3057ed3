# ctest-labels: storm
# ParaView (5.11, Debian's) opens, by their names alone, the series of a replay and of `fracas export --vtk`: times, cells and arrays of
# every model.
. tests/support/campaigns.sh

command -v pvpython > /dev/null || { echo "skipped: not installed: paraview"; exit 0; }
for model in bar ring membrane shell; do
    "$fracas" init $model > $model.yaml
    expect 0 "$fracas" run --no-report $model.yaml --study $model --quiet
    expect 0 "$fracas" replay $model 0/1 --fields fields-$model --every 500ns
    case $model in membrane | shell) expect 0 "$fracas" export $model --vtk --times 3 --to fields-flights-of-$model ;; esac
done

cat > look.py <<'END'
import glob, json, os
import h5py
from paraview.simple import OpenDataFile

looked = 0
for path in sorted(glob.glob("fields-*/*.series")):
    reader = OpenDataFile(path)
    reader.UpdatePipelineInformation()
    files = json.load(open(path))["files"]
    assert list(reader.TimestepValues) == [one["time"] for one in files], path
    for one in files:
        reader.UpdatePipeline(one["time"])
        grid = h5py.File(os.path.join(os.path.dirname(path), one["name"]))["VTKHDF"]
        seen = reader.GetDataInformation()
        assert (seen.GetNumberOfPoints(), seen.GetNumberOfCells()) == (grid["NumberOfPoints"][0], grid["NumberOfCells"][0]), one
        for data, group in (reader.PointData, "PointData"), (reader.CellData, "CellData"):
            assert set(data.keys()) == set(grid[group]), (one, data.keys())
            for name in grid[group]:
                values = grid[group][name][()]
                if values.ndim == 1 and (values == values).all() and len(values):
                    assert data[name].GetRange(0) == (values.min(), values.max()), (one, name)
                looked += 1
print(looked, "arrays")
END
PYTHONPATH=/usr/lib/python3/dist-packages pvpython look.py > said 2>&1 || { cat said >&2; fail "ParaView does not read the study's numbers"; }
said '[0-9][0-9] arrays$'
