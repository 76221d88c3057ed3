# ctest-labels: storm
# ctest-timeout: 1800
# Plates of paper 001, coarser, beside continuous triangles with cohesive edges put in (tests/support/continuous_plate.py, nothing of
# fracas), on the same meshes and strengths.
. tests/support/campaigns.sh

sed 's/0.05 mm/0.1 mm/; s/1.2 us/200 ns/; s/^replicas.*/replicas: 1/; s/100}/400, interfaces: true}/' \
    "$source/campaigns/examples/plate-biaxial.yaml" > plate.yaml
expect 0 "$fracas" run --no-report plate.yaml --study plate
/usr/bin/python3 - "$source" <<'END'
import sys
import numpy as np
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1] + "/tests/support")
import continuous_plate as oracle

for realization, name in enumerate(("uniform", "weibull")):
    study = oracle.Study("plate", realization)
    for t, given, elastic, dissipated, fragments, error in oracle.run(study, 0.05, [3e-9, 50e-9, 100e-9, 200e-9]):
        if t < 4e-9 and name == "uniform":  # a uniform strain, E/(1 - nu) (rate t)^2 V, exact in both; between two rows of 0.5 ns
            exact = 260e9 / 0.79 * (1e5 * t) ** 2 * 1e-4 * 0.015e-3
            assert abs(elastic / exact - 1) < 1e-9 and abs(study.at(t, "elastic") / exact - 1) < 0.03, (elastic, exact)
        if t < 40e-9:
            continue
        print(name, "%.0f ns, theirs and ours:" % (1e9 * t), *("%s %.6g %.6g" % (b, a, study.at(t, b)) for a, b in (
            (given, "given"), (dissipated, "dissipated"), (fragments, "fragments"))), "error %.3g" % error, flush=True)
        # The scoreboard's 5 % of the energy that cracks take.
        assert abs(dissipated / study.at(t, "dissipated") - 1) < 0.05
        assert abs(given / study.at(t, "given") - 1) < 0.05
        assert abs(error) < 2e-3 * dissipated
        if t > 90e-9:  # single cracks decide, of 4.5 to 10 elements a fragment
            assert abs(fragments / study.at(t, "fragments") - 1) < 0.12
END
