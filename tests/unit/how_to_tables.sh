# ctest-labels: ci
# docs/examples/tables_with_pandas.py and tables_with_R.R run, and what they find is what the report says.
. tests/support/campaigns.sh

cat > plus.py <<'END'

# Behind the script's own code: the study that a test knows.
import math
import h5py
study = h5py.File("STUDY/study.h5")
assert package["campaign"] == study.attrs["campaign"].decode() and unit["fragments"]["size"] == "m" and unit["realizations"]["work"] == "J"
assert len(points) == 3 and len(realizations) == 9 and len(fragments) == len(study["fragment/size"])
assert list(by_rate[rate]) == [1e3, 3e4, 1e5] and list(by_rate["size.n"]) == [3, 3, 3]
t = 0.95 / math.sqrt(2 * 0.975 * 0.025)  # Student's quantile of 2 degrees of freedom, in closed form
for ours, (_, theirs) in zip(by_rate.itertuples(index=False), mean.iterrows()):
    assert theirs["count"] == 3 and math.isclose(ours[2], theirs["mean"], rel_tol=1e-12)
    assert math.isclose(ours[3], t * theirs["sem"], rel_tol=1e-12, abs_tol=1e-15)  # 0 is 1e-18 m of rounding
of = study["realization/point"][()].repeat(study["fragment/offset"][1:] - study["fragment/offset"][:-1])
large = study["fragment/size"][()][(of == 1) & (study["fragment/dust"][()] == 0)]
assert len(large) == len(fastest) > 30
for s, share in survival.items():
    assert math.isclose(share, (large > s * (1 - 1e-12)).mean(), rel_tol=1e-12)
assert wide["count.mean"].to_list() == points["count.mean"].to_list() and math.isclose(wide["law.zmr"][1], points["law.zmr"][1])
assert len(wide.columns) * 3 == len(statistics) and points["onset_time.mean"].isna().tolist() == [True, False, False]
assert sizes["normalised"].notna().all() and len(sizes) == len(fragments)
END
cat > plus.R <<'END'

# Behind the script's own code: the same numbers two ways.
stopifnot(nrow(points) == 3, nrow(realizations) == 9, unit_of("fragments", "size") == "m", unit_of("realizations", "work") == "J",
          is.character(points$hash), is.integer(fragments$fragment), is.na(points$onset_time.mean) == c(TRUE, FALSE, FALSE))
stopifnot(by_rate[[rate]] == c(1e3, 3e4, 1e5), all.equal(by_rate$size.mean, unname(again[, "mean"]), tolerance = 1e-12),
          all.equal(by_rate$size.half_width, unname(again[, "half_width"]), tolerance = 1e-12), again[, "n"] == 3)
large <- fragments$size[fragments$point == 1 & fragments$dust == 0]
stopifnot(length(large) == nrow(fastest), length(large) > 30, nrow(sizes) == nrow(fragments), file.size("survival.pdf") > 1000,
          all.equal(survival, vapply(size, function(s) mean(large >= s), 0), tolerance = 1e-12))
END

campaign one.yaml 3 '1e3, 1e5, 3e4' # nothing breaks at the first
expect 0 "$fracas" run one.yaml --study STUDY --jobs 2
expect 0 "$fracas" export STUDY --histories

if /usr/bin/python3 -c 'import pandas, h5py' 2>/dev/null; then
    cp "$source/docs/examples/tables_with_pandas.py" page.py
    cat page.py plus.py > all.py
    /usr/bin/python3 -W error all.py || fail "the script for pandas"
else
    echo "skipped: python3-pandas or python3-h5py is not installed"
fi

if Rscript -e 'library(jsonlite)' >/dev/null 2>&1; then
    cp "$source/docs/examples/tables_with_R.R" page.R
    { echo 'options(warn = 2)'; cat page.R plus.R; } > all.R
    Rscript --vanilla all.R || fail "the script for R"
else
    echo "skipped: r-base-core or r-cran-jsonlite is not installed"
fi

# A ring has no geometry.length: the scripts are not for bars alone.
mv STUDY bars
cat > ring.yaml <<'END'
name: ring
seed: 7
model: ring
geometry: {radius: 2 mm, area: 1 mm2}
mesh: {elements: 500}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: initial-velocity, radial: 100 m/s}
time: {stop: time, end: 200 ns, safety: 0.25}
sweep:
  - loading.radial: [100 m/s, 200 m/s]
replicas: 3
output: {history: 20, interfaces: false}
END
expect 0 "$fracas" run ring.yaml --study STUDY --jobs 2
expect 0 "$fracas" export STUDY --histories
[ ! -e page.py ] || /usr/bin/python3 -W error page.py || fail "the script for pandas, of rings"
[ ! -e page.R ] || Rscript --vanilla -e 'options(warn = 2); source("page.R")' || fail "the script for R, of rings"
