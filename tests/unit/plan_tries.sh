# Campaigns that cannot do what they are for, by what plan computes in a second; edges of a mesh file that the key `edges` does not hold.
. tests/support/campaigns.sh

cat > plate.yaml <<'YAML'
name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 10 mm, height: 5 mm, thickness: 0.1 mm, left: fixed}
mesh: {divisions: 6}
material: {young: 70 GPa, poisson: 0.25, density: 2700 kg/m3}
cohesive: {fracture_energy: 50 J/m2}
strength: {minimum: 50 MPa, scale: 10 MPa, shape: 2}
loading: {type: traction, edge: right, normal: 5 MPa, rise: 1 us}
time: {stop: time, end: 4 us}
replicas: 2
YAML

# with LOADING: a plan of the plate under it.
with()
{
    sed "s/^loading: .*/loading: $1/" plate.yaml > tried.yaml
    expect 0 "$fracas" plan tried.yaml
}

with '{type: traction, edge: right, normal: 5 MPa, rise: 1 us}'
said 'nothing breaks in 2 realizations computed just now: .*: is loading.normal in its unit?'
with '{type: traction, edge: right, normal: 500 MPa, rise: 1 us}'
! grep -q 'computed just now: load\|without a result' said || { cat said >&2; fail "a plate that breaks is warned of"; }
with '{type: edge-motion, edge: right, displacement: 2, rise: 1 us}'
said '2 realizations computed just now end without a result: is loading.displacement in its unit?'

# A load below the strengths.
sed 's/^loading: .*/loading: {rate: 1e3 1\/s}/; s/, left: fixed//; s/end: 4 us/end: 0.3 us/' plate.yaml > weak.yaml
expect 0 "$fracas" plan weak.yaml
said 'warning: point 0: until time.end the stress stays below'
! grep -q 'computed just now: load' said || { cat said >&2; fail "one cause is said twice"; }

# Headings of other units, and interfaces out of order, are doubted, and read as ever.
sed 's/^strength: .*/strength: {minimum: 50 MPa, scale: 10 MPa, shape: 2, factor: factor.csv, factor_along: x}/' plate.yaml > headed.yaml
printf 'x (mm),factor\n-0.005,1\n0,0.8\n0.005,1\n' > factor.csv
expect 0 "$fracas" plan headed.yaml
said 'factor.csv: a heading has the unit .mm., but the numbers are taken as SI, in m, s or Pa'
printf 'x [m],factor (rel)\n-0.005,1\n0,0.8\n0.005,1\n' > factor.csv
expect 0 "$fracas" plan headed.yaml
! grep -q 'a heading has' said || { cat said >&2; fail "a right heading is doubted"; }
cat > bar.yaml <<'YAML'
name: bar
seed: 3
model: bar
geometry: {ends: periodic, length: 1 mm, area: 1 mm2}
mesh: {elements: 40}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {fracture_energy: 100 J/m2}
strength: {distribution: file, file: strengths.csv}
loading: {rate: 1e5 1/s}
time: {stop: time, end: 300 ns}
replicas: 1
YAML
{ echo 'interface,x (mm),strength [Pa]'; seq 0 39 | sed 's/.*/&,1,3e8/'; } > strengths.csv
expect 0 "$fracas" plan bar.yaml
! grep -q 'a heading has\|is not in order' said || { cat said >&2; fail "a column that is not read is doubted"; }
sed -i '5{h;d};6{G}' strengths.csv
expect 0 "$fracas" plan bar.yaml
said 'strengths.csv:5: the column .interface. is not in order, and is not read'

# Groups 1 to 8 of a mesh file have keys of their own: `edges` is for others.
sed 's/^1 11 "left"/1 1 "left"/; s/^\([0-9]* 1 2\) 11 /\1 1 /' "$source/tests/data/gmsh/plate-order1-msh22-text.msh" > plate.msh
sed 's/^geometry: .*/geometry: {shape: file, file: plate.msh, unit: mm, thickness: 0.1 mm, edges: held}/; s/^mesh: .*/mesh: {spacing: given}/
    s/^loading: .*/loading: {rate: 1e4 1\/s}/' plate.yaml > groups.yaml
expect 0 "$fracas" plan groups.yaml
! grep -q 'holds no edge' said || { cat said >&2; fail "edges without a key are held"; }
cat > keyed.msh <<'MSH'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 2 0 0
3 2 1 0
4 0 1 0
$EndNodes
$Elements
6
1 1 2 1 1 1 2
2 1 2 2 2 2 3
3 1 2 3 3 3 4
4 1 2 4 4 4 1
5 2 2 9 1 1 2 3
6 2 2 9 1 1 3 4
$EndElements
MSH
sed 's/plate.msh/keyed.msh/' groups.yaml > keyed.yaml
expect 0 "$fracas" plan keyed.yaml
said "geometry.edges, .held., holds no edge: all are of the mesh file's physical groups 1 to 8"
sed 's/edges: held/edges: held, edge_2: held/' keyed.yaml > some.yaml
expect 0 "$fracas" plan some.yaml
! grep -q 'holds no edge' said || { cat said >&2; fail "an edge is held"; }

# A triangle split without its neighbour: its new node hangs on the neighbour's edge.
cat > hanging.msh <<'MSH'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0.5 0.5 0
$EndNodes
$Elements
3
1 2 0 1 2 3
2 2 0 1 5 4
3 2 0 5 3 4
$EndElements
MSH
sed 's/plate.msh/hanging.msh/; s/edges: held/edges: free/' groups.yaml > slit.yaml
expect 0 "$fracas" plan slit.yaml
said '1 node of the mesh file hangs on edges of elements that do not have it: the body is slit there'

# Numbers of micrometres make a body of kilometres.
awk 'NR > 5 && NR < 11 {$2 *= 2000; $3 *= 2000} {print}' hanging.msh > wide.msh
sed 's/hanging.msh, unit: mm/wide.msh/' slit.yaml > wide.yaml
"$fracas" plan wide.yaml > said 2>&1 || true
said 'a body of 2e+03 by 2e+03 by 0 m: i[fs] it is in um, give geometry.unit: um\|is it in um? Then give geometry.unit: um'
