# ctest-sanitize
# What summary.json has of fits, convergence and energies is what fits.csv, convergence.csv and energies.csv have: every number, none that is
# not there, and a wrong one is found. Fits of other realizations are left out and counted, those of the same are found though their point has another number.
. tests/support/campaigns.sh

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }

campaign one.yaml 22 '1e5, 2e5'
expect 0 "$fracas" run one.yaml --study one --jobs 2
expect 0 "$fracas" fit one --resamples 99 --point 1
"$fracas" report one > one/table.txt
"$fracas" report one --json > one/summary.json
cmp one/summary.json one/report/summary.json
/usr/bin/python3 "$source/tests/support/check_report.py" one "$source"
[ "$(wc -c < one/summary.json)" -lt 120000 ] || fail "a summary of $(wc -c < one/summary.json) bytes"

# Keys of `report:` that the report would refuse are refused before anything is computed.
for keys in 'y: [aspect, aspct]' 'x: aspct' 'x: loading.rate, series: loading.rate' \
    'series: loading.rate, panels: loading.rate'; do
    { cat one.yaml; echo "report: {$keys}"; } > keys.yaml
    for command in 'plan keys.yaml' 'run keys.yaml --study keys'; do
        # shellcheck disable=SC2086
        expect 2 "$fracas" $command
        said 'keys.yaml: `report`: .*\(aspct\|both x and series\|both series and panels\)'
        [ ! -e keys ] || fail "a study was begun"
    done
done

# Keys that it takes are the report's of a complete study, too, in which nothing else changes.
{ cat one.yaml; echo "report: {y: [aspect]}"; } > keys.yaml
cp -r one keyed
cp keyed/study.h5 before.h5
[ ! -e keyed/report/aspect-against-rate.svg ]
expect 0 "$fracas" run keys.yaml --study keyed --jobs 2
said 'keyed is complete, nothing to compute'
grep -q '^report: .*aspect' keyed/campaign.yaml || fail "the study has the old keys"
[ -s keyed/report/aspect-against-rate.svg ] || fail "the report has the old keys"
cmp keyed/study.h5 before.h5
cp keyed/campaign.yaml before.yaml
expect 0 "$fracas" run keys.yaml --study keyed --jobs 2
cmp keyed/campaign.yaml before.yaml

# An old report left behind is told, and no other.
expect 0 "$fracas" run keys.yaml --study keyed --jobs 2 --no-report
! grep -q 'of earlier results' said || fail "a report of these results is called old"
expect 0 "$fracas" extend keyed --replicas 23 --jobs 2 --no-report
said 'keyed/report/index.html is of earlier results: `fracas report keyed`'
expect 0 "$fracas" run one.yaml --study bare --jobs 2 --no-report
! grep -q 'of earlier results' said || fail "a report that is not there is called old"

# No report loses a file of somebody's own: in the place of one of the report's it gets another name, any other stays.
cp -r one own
rm -r own/report
mkdir own/report
for name in sizes.csv mine-point-3.csv notes.txt; do echo mine > own/report/$name; done
expect 0 "$fracas" report own --quiet
said 'own/report/sizes.csv was of no report; it is own/report/sizes.csv.before-'
[ "$(wc -l < said)" -eq 1 ] || fail "other files were moved"
for name in sizes.csv.before-* mine-point-3.csv notes.txt; do
    # shellcheck disable=SC2086
    [ "$(cat own/report/$name)" = mine ] || fail "$name is lost"
done
echo yours > own/report/yours-point-3.csv
expect 0 "$fracas" report own --quiet --points 0
[ ! -s said ] || fail "a report takes its own files for somebody else's"
[ ! -e own/report/sizes-point-1.csv ] || fail "a figure of the report before is left"
expect 0 "$fracas" report own --quiet --points all
[ ! -s said ] || fail "a report takes its own files for somebody else's"
[ "$(cat own/report/yours-point-3.csv)" = yours ] || fail "a file of no report is lost"

cat > planted.py <<'END'
import copy, json, os, sys
sys.path[:0] = [os.path.join(sys.argv[1], "tests/support")]
from check_summary import check_fits, check_series
points = json.load(open("one/summary.json"))["points"]

def found(p, point):
    try:
        check_series(p, point, "one/report")
        check_fits(p, point, "one")
    except (AssertionError, KeyError):
        return True
    return False

def places(of, path=()):
    """Where numbers, texts and nulls are."""
    for key in of if isinstance(of, dict) else range(len(of)):
        if isinstance(of[key], (dict, list)):
            yield from places(of[key], (*path, key))
        else:
            yield (*path, key)

planted = 0
for p, point in enumerate(points):
    assert not found(p, point)
    for part in ("convergence", "energies", "fits"):
        for *path, last in places(point[part]) if point[part] else ():
            wrong = copy.deepcopy(point)
            of = wrong[part]
            for key in path:
                of = of[key]
            value = of[last]
            of[last] = not value if isinstance(value, bool) else "x" if isinstance(value, str) else 1 if value is None else value * (1 + 1e-12) + (value == 0)
            if isinstance(value, int) and not isinstance(value, bool):
                of[last] = value + 1
            assert found(p, wrong), (part, path, last)
            del of[last]
            assert found(p, wrong), (part, path, last)
            planted += 1
assert points[0]["fits"] is None and points[1]["fits"]["families"] and points[0]["convergence"] and points[0]["energies"]
assert sum(family["fitted"] for family in points[1]["fits"]["families"]) > 3 and any(family["reason"] for family in points[1]["fits"]["families"])
print(planted, "wrong numbers found")
END
/usr/bin/python3 planted.py "$source" || fail "a wrong number went unnoticed"

# The point of 2e5 alone, with the same realizations under another number: it keeps its fits, until it has more realizations.
campaign other.yaml 22 '2e5'
expect 0 "$fracas" run other.yaml --study other --jobs 2
cp one/fits.csv other
expect 0 "$fracas" report other
/usr/bin/python3 - "$source" <<'END' || fail "the fits of a point that has another number"
import json, os, sys
sys.path[:0] = [os.path.join(sys.argv[1], "tests/support")]
from check_summary import check_fits
summary = json.load(open("other/report/summary.json"))
point, = summary["points"]
assert point["fits"]["families"] and summary["stale_fits"] == 0
check_fits(0, point, "other", moved=True)
END
expect 0 "$fracas" extend other --replicas 23 --jobs 2
/usr/bin/python3 - <<'END' || fail "stale fits"
import json
summary = json.load(open("other/report/summary.json"))
assert summary["points"][0]["fits"] is None and summary["stale_fits"] == 1
END

# A false file of fits is left out, with the reason.
echo nonsense > other/fits.csv
"$fracas" report other --json > json
/usr/bin/python3 -c 'import json
summary = json.load(open("json"))
assert summary["points"][0]["fits"] is None and "damaged" in summary["fits_left_out"]' || fail "fits that are damaged"

# A report elsewhere has the same files, but for its own figures, and leaves that of the study alone.
expect 0 "$fracas" report one
expect 0 "$fracas" report one -o elsewhere --quiet
diff -r one/report elsewhere || fail "a report elsewhere is another one"
expect 0 "$fracas" report one --x size.mean --output elsewhere
said '^report: elsewhere/index.html$'
[ -f elsewhere/count-against-size-mean.svg ] && [ ! -e one/report/count-against-size-mean.svg ] || fail "not there, or in the study's report"
expect 2 "$fracas" report one -o one/campaign.yaml
expect 0 "$fracas" report one --x size.mean --panels loading.rate -o parted --quiet
[ "$(sed 's|"[^"]*"||' parted/count-against-size-mean.csv | cut -d, -f1,8 | uniq | tr '\n' ' ')" = "panel,title 1,rate 1e5 1/s 2,rate 2e5 1/s " ] || fail "no panels"
grep -A1 '"panels": \[' parted/summary.json | grep -q '"loading.rate"' || fail "the summary does not say by what panels are"
expect 2 "$fracas" report one --panels geometry.length
said 'panels of the figures, `geometry.length`: it is the same at all points'

# What docs/how-to/open-results-with-python.md shows first prints as it says: a number with its unit, and the point's rate.
sed -n '/^    import h5py$/,/^$/s/^    //p' "$source/docs/how-to/open-results-with-python.md" | sed 's|STUDY/|one/|' > example.py
[ "$(wc -l < example.py)" -eq 6 ] || fail "the page's first example has changed"
/usr/bin/python3 example.py > said
said '^[0-9.e+-]* m$'
said '^100000.0$'

# A mean strength that moves with the mesh is said, and one that does not is not.
campaign meshes.yaml 2 '1e5'
sed -i -e 's/^strength: .*/strength: {distribution: normal, mean: 300 MPa, deviation: 30 MPa, reference_volume: 0.02 mm3}/' \
    -e 's/^  - loading.rate: .*/  - mesh.elements: [500, 1000]/' meshes.yaml
expect 0 "$fracas" run meshes.yaml --study meshes
expect 0 "$fracas" report meshes
tr -s ' \n' ' ' < said | grep -q 'mean strength is that of an interface, .* 300.0 MPa here, 300.0 to 321.1 MPa over points of the same strengths' ||
    { cat said; fail "nothing says that the mean strength moves with the mesh"; }
sed 's/^strength: .*/strength: {distribution: flaws, flaw_density: 5e11 1\/m3, minimum: 200 MPa, maximum: 600 MPa, exponent: 2}/' meshes.yaml > flaws.yaml
expect 0 "$fracas" run flaws.yaml --study flaws
expect 0 "$fracas" report flaws
tr -s ' \n' ' ' < said | grep -q 'mean strength is that of an interface' || { cat said; fail "nothing says it of flaws"; }
sed -i 's/ 0.02 mm3/ 0.02 mm3}/; s/, reference_volume: 0.02 mm3}}/}/' meshes.yaml
sed 's/^strength: .*/strength: {distribution: weibull, scale: 300 MPa, shape: 10, reference_volume: 0.02 mm3}/' meshes.yaml > pieces.yaml
expect 0 "$fracas" run pieces.yaml --study pieces
expect 0 "$fracas" report pieces
grep -q 'mean strength is that' said && fail "a strength of pieces is warned of, which no mesh moves"
expect 0 "$fracas" run meshes.yaml --study meshes-without
expect 0 "$fracas" report meshes-without
grep -q 'mean strength is that' said && fail "a mean strength that stays is warned of"
exit 0
