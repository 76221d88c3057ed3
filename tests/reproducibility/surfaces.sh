# A plate, an annulus of curved elements and a bar in one study: study.h5 with its meshes is the same, byte for byte, whatever
# computes it; the report and `fracas picture` draw what they are told to.
. tests/support/campaigns.sh

annulus='{name: annulus, geometry: {shape: annulus, inner: 2 mm, outer: 4 mm, thickness: 0.1 mm}, mesh: {divisions: 4, order: 2}}'
bar='{name: bar, model: bar, geometry: {shape: bar, length: 5 mm, area: 1 mm2}, mesh: {elements: 50}, material: {young: 370 GPa, density: 3900 kg/m3}, cohesive: {law: nitsche, fracture_energy: 50 J/m2}, loading: {type: imposed-rate, rate: 1e4 1/s}}'
# surfaces FILE REPLICAS: a second of one core.
surfaces()
{
    cat > "$1" <<END
name: surfaces
seed: 5
model: membrane
geometry: {width: 10 mm, height: 5 mm, thickness: 0.1 mm}
mesh: {divisions: 6, amplitude: 0.2}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 50 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 1e4 1/s}
time: {end: 0.6 us}
replicas: $2
output: {interfaces: true}
sweep:
  - cases:
      - $bar
      - {name: plate}
      - $annulus
END
}

surfaces all.yaml 3
expect 0 "$fracas" run all.yaml --study one --jobs 1
said 'no dust'
[ "$(h5dump -d /mesh/node_offset one/study.h5 | grep -c '(0): 0, 0, 91, ')" = 1 ] || fail "the plate's mesh has not 13 x 7 nodes"
h5dump -d /realization/outcome one/study.h5 | grep -q '^ *(0): [02], [02], [02], 0, 0, 0, 0, 0, 0$' || fail "not every surface broke"
compare all.yaml --jobs 2 --shuffle
compare all.yaml --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6 # a segment for each realization
for isa in baseline $(instruction_sets); do
    compare all.yaml --jobs 2 --isa "$isa" --lanes 8
done
expect 0 "$fracas" verify --full one

# The spin of a plate's fragments is upright, and half of L . spin, by another reader, is what the report says.
expect 0 "$fracas" report one --json
/usr/bin/python3 - <<'END' || fail "the spins in study.h5 are not those of the report"
import json
import h5py, numpy as np

study, points = h5py.File("one/study.h5"), json.load(open("said"))["points"]
of = {name: study["fragment/" + name][()] for name in ("offset", "mass", "velocity", "angular_momentum", "spin")}
assert study["fragment/spin"].attrs["unit"] == b"rad/s"
moment, spin = of["angular_momentum"], of["spin"]
flat = of["offset"][3]  # after the bars
assert not spin[:flat].any() and not spin[:, :2].any() and (spin[flat:, 2] * moment[flat:, 2] > 0).all()
for p, point in enumerate(points):
    energies = []
    for i in np.flatnonzero((study["realization/point"][()] == p) & (study["realization/fragments"][()] > 1)):
        rows = slice(*of["offset"][i:i + 2])
        energies.append([(of["mass"][rows] * (of["velocity"][rows]**2).sum(axis=1)).sum() / 2, (moment[rows] * spin[rows]).sum() / 2])
    for key, value in zip(("translation", "rotation"), np.mean(energies, axis=0)):
        said = point["statistics"][key + ".mean"]
        assert said is None if p == 0 else abs(said / value - 1) < 1e-12 and value > 0, (key, said, value)  # sums of one sign
END

# Shapes, by another reader: volumes are masses by the density, crack areas twice the broken interfaces', a plate's smallest
# semi-axis is that of its thickness along z, axes are a rotation.
/usr/bin/python3 - <<'END' || fail "the shapes in study.h5 contradict its other numbers"
import h5py, numpy as np

study = h5py.File("one/study.h5")
of = {name: column[()] for name, column in study["fragment"].items()}
point, broken = study["realization/point"][()], study["realization/broken"][()]
axes = np.stack([of[f"axis_{k}"] for k in (1, 2, 3)], axis=1)
semi = np.stack([of[f"semi_axis_{k}"] for k in (1, 2, 3)], axis=1)
assert np.allclose(axes @ axes.transpose(0, 2, 1), np.eye(3), atol=1e-14) and (np.linalg.det(axes) > 0).all()
assert (np.diff(semi) <= 0).all()
assert np.allclose(of["volume"] * 3900, of["mass"], rtol=1e-14)
flat = of["offset"][3]  # after the bars
assert (of["extent"][flat:] > semi[flat:, 0]).all() and (of["extent"][flat:] < 4 * semi[flat:, 0]).all()
thin = np.abs(axes[flat:, :, 2]).argmax(axis=1)
assert np.allclose(semi[flat:][np.arange(len(thin)), thin], np.sqrt(5 / 12) * 1e-4, rtol=1e-12)
mesh, damage = study["mesh"], study["interface/damage"][()]
for i in range(len(point)):
    rows, faces = slice(*of["offset"][i:i + 2]), slice(*study["interface/offset"][i:i + 2])
    area = np.full(broken[i], 1e-6)
    if point[i] == 1:  # straight edges
        nodes = mesh["node_position"][slice(*mesh["node_offset"][1:3])]
        ends = nodes[mesh["interface_node"][slice(*mesh["interface_offset"][1:3])][:, :2][damage[faces] == 1]]
        area = 1e-4 * np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    if point[i] < 2:
        assert abs(of["crack_area"][rows].sum() - 2 * area.sum()) < 1e-12 * area.sum() > 0, i
END

# Extended: merged again, with the meshes of all points.
surfaces part.yaml 2
sed -i '/name: annulus/d' part.yaml
expect 0 "$fracas" run part.yaml --study extended
expect 0 "$fracas" run all.yaml --study extended
same one extended

# The first times are those of the interfaces, by another reader; fragments at the end are those of the run.
expect 0 "$fracas" picture one --point 1 --replica 1 --table -o drawn
said '^drawn/surface-point-1-replica-1-6.svg: '
said '^first crack through: [0-9.]* ns$'
onset=$(awk -F, '$1 == 1 {print $3}' drawn/times-point-1.csv)
awk -v onset="$onset" 'BEGIN {exit !(onset > 0 && onset < 6e-7)}' || fail "onset $onset"
fragments=$(awk -F, '$1 == 1 {print $9}' drawn/times-point-1.csv)
grep -q ": $fragments fragments" drawn/surface-point-1-replica-1-6.svg || fail "the picture at the end has not $fragments fragments"
[ "$(ls drawn | wc -l)" = 7 ] || fail "six pictures and a table were expected"

expect 0 "$fracas" picture one --point 2 --times "0.2us,3e-7, 600 ns" --show mesh
[ "$(ls one/pictures | wc -l)" = 3 ] || fail "three pictures were expected"
grep -q 'class="mesh"' one/pictures/surface-point-2-replica-0-1.svg || fail "no mesh was drawn"
expect 0 "$fracas" picture one --point 2 --times 2 --show cracks -o cracks
! grep -q 'class="t0"' cracks/surface-point-2-replica-0-2.svg || fail "fragments were drawn"

# From another side, and with gaps: still only what is there.
expect 0 "$fracas" picture one --point 2 --times 600ns --view -30,45 --explode 0.2 -o seen
grep -q ', fragments apart: 0.2</text>' seen/surface-point-2-replica-0-1.svg || fail "the fragments are not apart"
grep -q '>z</text>' seen/surface-point-2-replica-0-1.svg || fail "no axes were drawn"

# The report has the pictures of both surfaces.
expect 0 "$fracas" report one
for point in 1 2; do
    for k in 1 2 3 4 5 6; do
        grep -q "<figure id=\"surface-point-$point-$k\">" one/report/index.html || fail "the page lacks picture $k of point $point"
        [ -s "one/report/surface-point-$point-$k.svg" ] || fail "picture $k of point $point is no file"
    done
done
fragments=$(h5dump -d /realization/fragments one/study.h5 | sed -n 's/^ *(0): \([0-9]*\),.*/\1/p')
grep -q "s: $fragments fragments\{0,1\}[ <]" one/report/surface-point-0-6.svg || fail "the bar is not drawn with $fragments fragments"

# A film: one page of 24 times; the report has one of each point beside it.
expect 0 "$fracas" picture one --point 2 --film -o film
said '^film/surface-point-2-replica-0.html: 24 times$'
[ "$(ls film)" = surface-point-2-replica-0.html ] || fail "a film is one file"
! grep -q '<script src\|https\{0,1\}://[^w]' film/surface-point-2-replica-0.html || fail "the film needs other files"
for point in 0 1 2; do
    grep -q "<a href=\"film-point-$point.html\">" one/report/index.html || fail "the page lacks the film of point $point"
    grep -q ' id="instant23"' one/report/film-point-$point.html || fail "24 instants were expected"
done
expect 0 "$fracas" picture one --point 0 --times 2 --png -o dots
[ "$(head -c 8 dots/surface-point-0-replica-0-2.png | od -An -tx1)" = ' 89 50 4e 47 0d 0a 1a 0a' ] || fail "no PNG"
[ "$(ls dots | wc -l)" = 4 ] || fail "two pictures in both forms were expected"
expect 0 "$fracas" picture one --point 0 --table -o bars
[ "$(wc -l < bars/times-point-0.csv)" = 4 ] || fail "the table of the bar has not 3 replicas"

# The meshes are in study.h5 alone: without it the page says when pictures come.
cp -r one partial
rm partial/study.h5
expect 0 "$fracas" report partial
grep -q 'Crack pictures come with the complete study' partial/report/index.html || fail "the page does not say where its pictures are"
! grep -q '<figure id="surface-point-[12]' partial/report/index.html || fail "a surface was drawn without its mesh"
cmp one/report/points.csv partial/report/points.csv || fail "from segments a surface has other numbers"
expect 5 "$fracas" picture partial
said 'pictures come with the complete study: .*partial/study.h5 is not there'

# refuses TEXT ARGUMENTS...
refuses()
{
    text=$1
    shift
    expect 2 "$fracas" picture "$@" -o nowhere
    said "$text"
    [ ! -e nowhere ] || fail "a folder was made for nothing"
}
refuses 'there is no point 3: one has 3 of them' one --point 3
refuses 'there is no replica 3: point 1 has 3 of them' one --point 1 --replica 3
refuses 'time 1.000 us is outside of the realization, which goes from 0 to 60' one --point 1 --times 1us
refuses '`5 mm` is a length; expected a time' one --point 1 --times 5mm
refuses '`x` is not a number' one --point 1 --times 100ns,x
refuses 'it must be a whole number from 1 to 1000' one --point 1 --times 0
refuses 'it can be: cracks, fragments, mesh' one --point 1 --show fragment
refuses 'picture: --view is `45`; it must be two numbers, as 45,30: an azimuth from -360 to 360' one --point 1 --view 45
refuses 'picture: --view is `45,95`; it must be two numbers' one --point 1 --view 45,95
refuses 'picture: --view is `nan,5`; it must be two numbers' one --point 1 --view nan,5
refuses 'picture: --view is `45,5deg`; it must be two numbers' one --point 1 --view 45,5deg
refuses 'picture: --explode is `11`; it must be a number from 0 to 10, such as 0.15' one --point 1 --explode 11
refuses 'picture: --explode is `-1`; it must be a number, 0 or more' one --point 1 --explode -1
sed '/^output/d' part.yaml > without.yaml
expect 0 "$fracas" run without.yaml --study without
! h5ls without/study.h5 | grep -q mesh || fail "meshes are kept without interfaces"
refuses 'keeps no interfaces' without --point 1
