# By how much fragments lie over each other, as `fracas replay` says it: of two squares side by side one flies into the other.
. tests/support/campaigns.sh

# Sides of 1 mm, 4 x 4 cells, 0.1 mm apart.
/usr/bin/python3 - > squares.msh <<'END'
nodes = [(1.1 * s + 0.25 * i - 1, 0.25 * j - 0.5) for s in range(2) for i in range(5) for j in range(5)]
cells = [(25 * s + 5 * i + j + 1) for s in range(2) for i in range(4) for j in range(4)]
print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes", len(nodes), sep="\n")
for k, (x, y) in enumerate(nodes):
    print(k + 1, f"{1e-3 * x:.17g} {1e-3 * y:.17g} 0")
print("$EndNodes\n$Elements", 2 * len(cells), sep="\n")
for k, a in enumerate(cells):
    print(f"{2 * k + 1} 2 2 1 1 {a} {a + 5} {a + 6}\n{2 * k + 2} 2 2 1 1 {a} {a + 6} {a + 1}")
print("$EndElements")
END
cat > squares.yaml <<END
name: squares
seed: 1
model: membrane
geometry: {shape: file, file: squares.msh, thickness: 1 mm}
mesh: {spacing: given}
material: {young: 70 GPa, density: 2700 kg/m3, poisson: 0.3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
initial: {velocity_x: -50 m/s, from_x: 0.05 mm}
loading: {type: none}
time: {stop: time, end: 10 us}
replicas: 1
output: {history: 4}
END
expect 0 "$fracas" run --no-report squares.yaml --study squares
expect 0 "$fracas" replay squares 0/0 --fields film --at end --json
/usr/bin/python3 - <<'END' || fail "the overlap of two squares"
import json

said = open("said").read()
number = json.loads(said[said.index("{"):])["overlap"]
time = float(said.split("overlap: ")[1].split(" at ")[1].split(" s ")[0])
print(f"{100 * number:g} % at {time:g} s")
assert 1 <= time / 10e-6 < 1.02, time
assert abs(number / ((50e3 * time - 0.1) / 2) - 1) < 1e-5, (number, time)  # the time has six digits
END
said '^overlap: fragments lie over each other on 20 % of the body at '
expect 0 "$fracas" replay squares 0/0 --json
! grep -q overlap said || fail "there are no fields that overlap"
