# `fracas replay --film`: the page has what the fields for ParaView of the same instants have, and loads nothing.
. tests/support/campaigns.sh

cat > ring.yaml <<'END'
name: ring
seed: 3
model: ring
geometry: {radius: 0.5 mm, area: 0.1 mm2}
mesh: {elements: 90}
material: {young: 260 GPa, density: 3690 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: weibull, scale: 300 MPa, shape: 20}
loading: {type: initial-velocity, radial: 50 m/s}
time: {stop: time, end: 80 ns, safety: 0.25}
replicas: 2
END
cat > plate.yaml <<'END'
name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 1 mm, height: 1 mm, thickness: 0.1 mm}
mesh: {size: 0.2 mm, order: 1, amplitude: 0.2}
material: {young: 260 GPa, density: 3690 kg/m3, poisson: 0.21}
cohesive: {law: nitsche, fracture_energy: 20 J/m2, beta: 10}
strength: {distribution: weibull, scale: 300 MPa, shape: 10}
loading: {type: expansion, rate: 1e5 1/s}
time: {stop: time, end: 0.1 us}
replicas: 2
END
sed -e 's/^name: .*/name: shell/; s/^model: .*/model: shell/; s/^geometry: .*/geometry: {shape: sphere, part: octant, radius: 1 mm, thickness: 0.1 mm}/' \
    -e 's/^mesh: .*/mesh: {divisions: 5}/; s/, beta: 10//; s/end: 0.1 us/end: 80 ns/' plate.yaml > shell.yaml
for name in ring plate shell; do
    expect 0 "$fracas" run --no-report $name.yaml --study $name --jobs 1
    expect 0 "$fracas" replay $name 0/1 --fields $name.fields --film $name.html --every 8ns --at onset,end
    said '^film: up to 1[0-9] instants, '
    said "^$name.html: 1[0-9] instants\$"
    said 'computed again, the same bytes: [1-9][0-9]* fragments'
done

/usr/bin/python3 - <<'END' || fail "films are not of the fields"
import base64, hashlib, json, re
import h5py, numpy as np

for name, corners, ends, dimension in ("ring", 2, 1, 2), ("plate", 3, 2, 2), ("shell", 6, 3, 3):
    page = open(name + ".html", encoding="utf-8").read()
    block = {id: text for id, text in re.findall(r'<script type="[a-z/]+" id="([a-z0-9]+)">([^<]*)</script>', page)}
    film = json.loads(block["film"])
    bytes_of = lambda id: base64.b64decode(block[id], validate=True)
    # One script runs, and it is the one that the page allows.
    (script,) = re.findall(r"<script>(.*?)</script>", page, re.S)
    assert base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() in page and "script-src 'sha256-" in page
    assert not re.search(r"https?://(?!www.w3.org)", page) and "<link" not in page.replace('<link rel="icon" href="data:,"/>', "")
    files = json.load(open(f"{name}.fields/body.hdf.series"))["files"]
    assert len(files) == len(film["instants"]) and film["corners"] == corners and film["dimension"] == dimension and film["ends"] == ends
    nodes, side = film["elements"] * corners, np.frombuffer(bytes_of("side"), "<u4").reshape(-1, 2, ends)
    start = np.frombuffer(bytes_of("place"), "<f4").reshape(nodes, 3)
    moved = np.array(film["moved"]).reshape(dimension, 2)
    broke = 0
    for k, one in enumerate(files):
        body, cracks = (h5py.File(f"{name}.fields/{one['name'].replace('body', part)}")["VTKHDF"] for part in ("body", "interfaces"))
        instant = film["instants"][k]
        assert instant["time"] == one["time"]
        data, at = bytes_of(f"instant{k}"), 0

        def take(kind, count):
            global at
            found = np.frombuffer(data, kind, count, at)
            at += found.nbytes
            return found

        label = take("<u4", film["elements"])
        u = moved[:, 0] + (moved[:, 1] - moved[:, 0]) * take("<u2", nodes * dimension).reshape(nodes, dimension) / 65535
        damage, values = take("u1", film["interfaces"]), [take("u1", film["elements"]).astype(float) for _ in film["values"]]
        assert at == len(data)
        wanted = body["PointData/displacement"][()]
        assert (abs(u - wanted[:, :dimension]) <= (moved[:, 1] - moved[:, 0]) / 131070 + 2e-7 * abs(wanted).max()).all()
        assert (abs(start + film["middle"] - (body["Points"][()] - wanted)) <= 1e-7 * abs(start).max()).all()
        assert not wanted[:, dimension:].any()
        fragment = body["CellData/fragment"][()]
        assert instant["fragments"] == len(set(fragment)) and all(label[e] == np.flatnonzero(fragment == fragment[e])[0] for e in range(len(fragment)))
        found = cracks["CellData/damage"][()]
        assert ((damage == 255) == (found >= 1)).all() and ((damage > 0) == (found > 0)).all() and (abs(damage / 254.5 - found) < 1 / 200).all()
        broke = max(broke, (damage == 255).sum())
        # Both sides of an interface are its elements', at one place before any motion.
        between = cracks["CellData/elements"][()]
        assert (side[:, :, 0] // corners == between).all() and (start[side[:, 0]] == start[side[:, 1]]).all()
        speed = np.linalg.norm(body["PointData/velocity"][()].reshape(-1, corners, 3).mean(axis=1), axis=1)
        wanted = [speed]
        for of in ("N", "M") if name == "shell" else ("stress",):
            stress = body["CellData/" + of][()]
            if stress.ndim > 1:
                xx, yy, zz, xy, yz, xz = stress.T
                stress = np.linalg.eigvalsh(np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=1).reshape(-1, 3, 3))
                stress = np.where(-stress[:, 0] > stress[:, 2], stress[:, 0], stress[:, 2])
            wanted.append(stress)
        assert len(values) == len(wanted)
        for value, said, wanted in zip(values, film["values"], wanted):
            span = said["largest"] - said["least"]
            assert span > 0 and (abs(said["least"] + span * value / 255 - wanted) <= span / 509).all(), (name, k, said["key"])
    assert broke > 0 and film["instants"][-1]["fragments"] > 1
END

# The script of docs/how-to/look-at-a-fragment.md sums the fields of a fragment to what study.h5 has.
for name in ring plate shell; do
    for fragment in '' 0 1; do
        expect 0 /usr/bin/python3 "$source/docs/examples/look_at_fragment.py" $name/study.h5 0/1 $name.fields $fragment
        [ "$(awk -F '\t' '/^(elements|mass)/ && $2 == $4' said | wc -l)" = 2 ] || { cat said; fail "fragment '$fragment' of $name"; }
    done
done

# Instants of its own: 49, evenly; a film alone makes no other file.
expect 0 "$fracas" replay ring 0/0 --film alone.html --json
said '"same": true'
[ "$(grep -o 'id="instant[0-9]*"' alone.html | sort -u | wc -l)" = 49 ] || fail "not 49 instants"
[ "$(ls -d alone*)" = alone.html ] || fail "more than a film"

# No more instants than steps, however many are asked for.
steps=$(h5dump -d /realization/steps ring/study.h5 | sed -n 's/^ *(0): \([0-9]*\),.*/\1/p')
expect 0 "$fracas" replay ring 0/0 --film often.html --every 0.01ns
said "^film: up to $((steps + 1)) instants, "

# Refused before anything is computed.
expect 2 "$fracas" replay ring 0/0 --film alone.html
said 'alone.html is there already: name another, or remove it'
expect 2 "$fracas" replay ring 0/0 --film film.mp4
said '`film.mp4`; it must be a file, as film.html'
expect 2 "$fracas" replay ring 0/0 --film other.html --one-file
said 'one-file is for fields'
expect 2 "$fracas" replay ring 0/0 --every 1ns
said 'say --fields DIR or --film FILE'
expect 6 "$fracas" replay ring 0/0 --film none/film.html
said 'cannot write a film into the folder none'
