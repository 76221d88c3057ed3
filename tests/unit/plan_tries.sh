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
said '2 realizations computed just now end without a result, by the energy guard: is loading.displacement in its unit?'

# A load below the strengths is said before anything is computed, by run as by plan.
sed 's/^loading: .*/loading: {rate: 1e3 1\/s}/; s/, left: fixed//; s/end: 4 us/end: 0.3 us/' plate.yaml > weak.yaml
expect 0 "$fracas" run --no-report weak.yaml --study weak
head -n 1 said | grep -q 'warning: point 0: until time.end the stress stays below' || { cat said >&2; fail "run computes before it warns"; }

# Groups 1 to 8 of a mesh file have keys of their own: `edges` is for others.
sed 's/^1 11 "left"/1 1 "left"/; s/^\([0-9]* 1 2\) 11 /\1 1 /' "$source/tests/data/gmsh/plate-order1-msh22-text.msh" > plate.msh
sed 's/^geometry: .*/geometry: {shape: file, file: plate.msh, unit: mm, thickness: 0.1 mm, edges: held}/; s/^mesh: .*/mesh: {spacing: given}/
    s/^loading: .*/loading: {rate: 1e4 1\/s}/' plate.yaml > groups.yaml
expect 0 "$fracas" plan groups.yaml
said "edges of the mesh file's physical group 1.* are free: geometry.edges, here .held., is for edges of no group from 1 to 8"
sed 's/edges: held/edges: held, edge_1: held/' groups.yaml > all.yaml
expect 0 "$fracas" plan all.yaml
! grep -q 'are free: geometry.edges' said || { cat said >&2; fail "held groups are called free"; }

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
