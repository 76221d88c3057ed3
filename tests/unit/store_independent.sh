# A segment as readers without code of ours see it (h5py, h5dump), and the same bytes from processes whose memory
# starts with other contents.
set -eu
writer="$1/tests/test_unit_store store_file"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

$writer "$folder/a.h5" > "$folder/wanted"
for byte in 1 85 170 255; do
    MALLOC_PERTURB_=$byte $writer "$folder/b.h5" > /dev/null
    cmp "$folder/a.h5" "$folder/b.h5"
done

h5dump -H "$folder/a.h5" > "$folder/dump"
grep -q 'DATASET "spin"' "$folder/dump"
/usr/bin/python3 - "$folder/a.h5" docs/formats/study.md > "$folder/found" <<'EOF'
import re, sys
import h5py, numpy as np

study, page = h5py.File(sys.argv[1], "r"), open(sys.argv[2]).read()
assert study.attrs["format_version"] == 6 and study.attrs["seed"] == 2**64 - 5 and study.attrs["complete"] == 1
assert study["point"].attrs["columns"] == 3
assert len(study.attrs["campaign"]) == 32 and study.attrs["program_version"] == b"0.1.0"
assert study.attrs["history"] == 100 and study.attrs["interfaces"] == 1

# Every dataset is as the page says, and the page says every dataset.
rows = {r[0]: r[1:] for r in re.findall(r"^\| `(/[^`]+)` \| (\S+) \| (\S.*?) \| (\d+) \| (\S.*?) \| (.*) \|$", page, re.M)}
seen = []
def check(name, dataset):
    if not isinstance(dataset, h5py.Dataset):
        return
    unit, text = dataset.attrs["unit"].decode(), dataset.attrs["description"].decode()
    assert text and dataset.chunks and dataset.shuffle and dataset.fletcher32 and dataset.maxshape[0] is None, name
    if "/" + name in rows:
        kind, shape, chunk, page_unit, page_text = rows["/" + name]
        stored = "text%d" % dataset.dtype.itemsize if dataset.dtype.kind == "S" else str(dataset.dtype)
        assert (stored, text, unit or "-") == (kind, page_text, page_unit), (name, stored, unit, text)
        assert dataset.shape[1:] == tuple(int(n) for n in re.findall(r"\d+", shape)) and dataset.chunks[0] == int(chunk), name
        seen.append("/" + name)
    else:
        assert name.startswith("point/"), name
study.visititems(check)
assert sorted(seen) == sorted(rows), set(rows) - set(seen)

point = study["point"]
assert list(point["cohesive.law"]) == [b"nitsche", b"linear", b""]
assert point["material.young"].attrs["unit"] == b"Pa" and point["material.young"][0] == 275e9
assert np.isnan(point["strength.shape"][1]) and list(point["replicas"]) == [5, 5, 5]

bits = lambda value: "%016x" % int(np.float64(value).view(np.uint64))
z, f, h, k = study["realization"], study["fragment"], study["history"], study["interface"]
for i in range(len(z["point"])):
    line = [str(z[c][i]) for c in ("point", "replica", "outcome", "fragments", "steps")] + [bits(z["end_time"][i])]
    for j in range(f["offset"][i], f["offset"][i + 1]):
        line += ["f", str(f["elements"][j]), str(f["dust"][j]), bits(f["velocity"][j, 2]), bits(f["spin"][j, 1]), bits(f["axis_2"][j, 1]), bits(f["crack_area"][j])]
    for j in range(h["offset"][i], h["offset"][i + 1]):
        line += ["h", str(h["broken"][j]), bits(h["residual"][j])]
    for j in range(k["offset"][i], k["offset"][i + 1]):
        line += ["i", bits(k["damage"][j])]
    print(" ".join(line))

m = study["mesh"] # of point 1 alone
for what in ("node", "element", "interface", "border"):
    offset = list(m[what + "_offset"])
    assert len(offset) == 4 and offset[:2] == [0, 0] and offset[2] == offset[3] > 0, (what, offset)
for row in m["element_node"]:
    print("element", *row)
for element, node in zip(m["interface_element"], m["interface_node"]):
    print("interface", *element, *node)
for element, node, tag in zip(m["border_element"], m["border_node"], m["border_tag"]):
    print("border", element, *node, tag)
for position in m["node_position"]:
    print("node", *(bits(x) for x in position))
EOF
diff "$folder/wanted" "$folder/found"
echo "$(wc -l < "$folder/found") realizations and parts of a mesh read alike"
