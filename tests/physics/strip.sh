# ctest-labels: ci
# A notched strip of height 2H, its long edges displaced by u0 outward: far ahead of the crack it holds E u0^2/((1 - nu^2) H) more per area
# than behind it, the energy release rate of a crack in motion. So a crack stays at 0.95 of Griffith's u0 = sqrt(G_c H (1 - nu^2)/E) =
# 1.356 um and runs through at 1.05 of it (10 % of G_c up and down), on a regular mesh without side cracks, and on an irregular one.
. tests/support/campaigns.sh

sed '/divisions-/d' "$source/docs/examples/strip-half.yaml" > strip.yaml
expect 0 "$fracas" run --no-report strip.yaml --study strip
/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }
/usr/bin/python3 - <<'END' || fail "the crack of a notched strip"
import h5py
import numpy as np

H, h, G_c, E, nu, rho, width, cells = 5e-3, 1e-3, 100, 260e9, 0.21, 3690, 16e-3, 58
griffith = np.sqrt(G_c * H * (1 - nu**2) / E)
rayleigh = (0.862 + 1.14 * nu) / (1 + nu) * np.sqrt(E / (2 * (1 + nu) * rho))
with h5py.File("strip/study.h5") as study:
    mesh, every, one, point = study["mesh"], study["interface"], study["realization"], study["point"]
    assert len(one["point"]) == 4
    for i in range(4):
        u0, irregular = point["loading.displacement"][i], point["mesh.amplitude"][i] > 0
        runs = u0 > griffith
        assert 0.04 < abs(u0 / griffith - 1) < 0.06
        rows = slice(*every["offset"][i : i + 2])
        place = mesh["node_position"][slice(*mesh["node_offset"][i : i + 2])]
        node = mesh["interface_node"][slice(*mesh["interface_offset"][i : i + 2])]
        a, b = place[node[:, 0]], place[node[:, 1]]
        size = np.linalg.norm(b - a, axis=1)
        damage, time = every["damage"][rows], every["break_time"][rows]
        notch, broken = time == 0, time > 0
        path = (size[notch].sum() + size[broken].sum()) / width
        dissipated = one["dissipated"][i]
        print(f"{u0 / griffith:.3f}, irregular {irregular}: broken {size[broken].sum():g} m, path {path:.3f} widths, {dissipated:g} J")
        assert irregular or abs(size[notch].sum() - 7e-3) < 0.5 * width / cells # to the nearest vertex
        # nitsche's line: damage times h G_c, whatever the path; sums of some 100 terms.
        assert abs(dissipated / (h * G_c * (size * damage)[~notch].sum()) - 1) < 1e-6
        assert one["residual"][i] < 1e-4 * dissipated
        if not runs:
            assert not broken.any()
            continue
        assert one["fragments"][i] == 2
        # Vertices move by 0.2 of a cell at most along and across: an edge along the row is sqrt(1 + (0.4/0.6)^2) = 1.2 times its length along.
        assert abs(path - 1) < 1e-6 or irregular and 1 < path < 1.2
        middle = 0.5 * (a + b)[broken]
        assert irregular or (abs(middle[:, 1]) < 1e-9).all() # no side cracks
        later = np.argsort(middle[:, 0])[broken.sum() // 2 :]
        speed = np.polyfit(time[broken][later], middle[later, 0], 1)[0]
        print(f"speed {speed:g} m/s, of Rayleigh waves {rayleigh:g} m/s")
        assert 0.2 * rayleigh < speed < rayleigh
END
