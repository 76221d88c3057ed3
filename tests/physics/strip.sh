# ctest-labels: ci
# A notched strip of height 2H, its long edges displaced by u0 outward: far ahead of the crack it holds E u0^2/((1 - nu^2) H) more per area
# than behind it, the energy release rate of a crack that has run. So a crack stays at 0.95 of Griffith's u0 = sqrt(G_c H (1 - nu^2)/E) =
# 1.356 um and runs through at 1.05 of it (10 % of G_c up and down). The row of edges ahead of the notch takes all of it: h G_c an area.
. tests/support/campaigns.sh

cat > strip.yaml <<'END'
name: strip
seed: 1
model: membrane
geometry: {shape: plate, width: 16 mm, height: 10 mm, thickness: 1 mm, bottom: held, top: held}
mesh: {divisions: 36, order: 1}
material: {young: 260 GPa, density: 3690 kg/m3, poisson: 0.21}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: constant, value: 113 MPa}
notch: {from_x: -8 mm, to_x: -1 mm}
loading: {type: edge-motion, edge: bottom, second_edge: top, rise: 14 us}
time: {stop: time, end: 40 us}
sweep:
  - loading.displacement: [1.29 um, 1.42 um]
replicas: 1
output: {interfaces: true, history: 100}
END
expect 0 "$fracas" run strip.yaml --study strip
/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }
/usr/bin/python3 - <<'END' || fail "the crack of a notched strip"
import h5py
import numpy as np

H, h, G_c, E, nu, rho = 5e-3, 1e-3, 100, 260e9, 0.21, 3690
griffith = np.sqrt(G_c * H * (1 - nu**2) / E)
rayleigh = (0.862 + 1.14 * nu) / (1 + nu) * np.sqrt(E / (2 * (1 + nu) * rho))
with h5py.File("strip/study.h5") as study:
    for lane, u0 in enumerate((1.29e-6, 1.42e-6)):
        assert 0.94 < u0 / griffith < 0.96 if lane == 0 else 1.04 < u0 / griffith < 1.06
        mesh, every, one = study["mesh"], study["interface"], study["realization"]
        rows = slice(*every["offset"][lane : lane + 2])
        place = mesh["node_position"][slice(*mesh["node_offset"][lane : lane + 2])]
        node = mesh["interface_node"][slice(*mesh["interface_offset"][lane : lane + 2])]
        a, b = place[node[:, 0]], place[node[:, 1]]
        size = np.linalg.norm(b - a, axis=1)
        damage, time = every["damage"][rows], every["break_time"][rows]
        notch, broken = time == 0, time > 0
        assert abs(size[notch].sum() - 7e-3) < 0.5 * 16e-3 / 58 # to the nearest vertex
        row = abs(a[:, 1]) + abs(b[:, 1]) < 1e-9
        begun = (damage > 0) & ~notch & ~broken
        dissipated = one["dissipated"][lane]
        print(f"{u0 / griffith:.3f}: broken {size[broken].sum():g} m, begun {size[begun].sum():g} m, {dissipated:g} J")
        # nitsche's line: damage times h G_c, whatever the path; sums of some 100 terms.
        assert abs(dissipated / (h * G_c * (size * damage)[~notch].sum()) - 1) < 1e-6
        assert one["residual"][lane] < 1e-4 * dissipated
        assert not (broken & ~row).any() # no side cracks
        if lane == 0:
            assert not broken.any()
            continue
        assert abs(size[notch].sum() + size[broken].sum() - 16e-3) < 1e-9 and one["fragments"][lane] == 2
        middle = (0.5 * (a + b))[broken & row, 0]
        order = np.argsort(middle)
        later = order[len(order) // 2 :]
        speed = np.polyfit(time[broken & row][later], middle[later], 1)[0]
        print(f"speed {speed:g} m/s, of Rayleigh waves {rayleigh:g} m/s")
        assert 0.2 * rayleigh < speed < rayleigh
END
