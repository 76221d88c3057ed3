# ctest-labels: ci
# The page of a report in headless Chromium (tests/support/check_page.py): a bar at three rates, and rings with their crack patterns
# and films, and a film of a replay.
. tests/support/campaigns.sh

lacking=
for program in chromium chromedriver pdfinfo; do
    command -v $program > /dev/null || lacking="$lacking $program"
done
/usr/bin/python3 -c 'import selenium' 2>/dev/null || lacking="$lacking python3-selenium"
if [ -n "$lacking" ]; then
    echo "skipped: not installed:$lacking"
    exit 0
fi

campaign rates.yaml 6 '3e4 1/s, 1e5 1/s, 3e5 1/s'
sed -i 's/, interfaces: true//' rates.yaml # films of rings are enough
expect 0 "$fracas" run rates.yaml --study rates
expect 0 "$fracas" fit rates --resamples 99
expect 0 "$fracas" report rates
grep -q 'id="fits"' rates/report/index.html || fail "the page has no fits"

cat > rings.yaml <<END
name: rings
seed: 11
model: ring
geometry: {radius: 1 mm, area: 1 mm2}
mesh: {elements: 200}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: uniform, minimum: 290 MPa, maximum: 310 MPa}
loading: {type: initial-velocity, radial: 100 m/s}
time: {stop: time, end: 150 ns, safety: 0.5}
replicas: 4
output: {history: 20, interfaces: true}
sweep:
  - loading.radial: [50 m/s, 100 m/s]
END
expect 0 "$fracas" run rings.yaml --study rings
expect 0 "$fracas" replay rings 1/0 --film rings/film.html

# Three factors: small multiples.
sed -n '/^sweep/q;p' rates.yaml > factors.yaml
cat >> factors.yaml <<END
sweep:
  - loading.rate: [1e5 1/s, 3e5 1/s]
  - material.young: [200 GPa, 275 GPa]
  - cohesive.fracture_energy: [50 J/m2, 100 J/m2, 200 J/m2]
replicas: 4
output: {history: 20}
END
expect 0 "$fracas" run factors.yaml --study factors
[ "$(cut -d, -f1,8 factors/report/count-against-rate.csv | sort -u | grep -c 'fracture energy')" = 3 ] || fail "no panels"

# What fracas converge draws is such a page, too.
sed 's/stop: quiet, end: 300 ns, quiet: 50 ns/stop: time, end: 300 ns/' rates.yaml > converged.yaml
expect 0 "$fracas" converge converged.yaml --study converged --replicas 12

for study in rates rings factors converged; do
    /usr/bin/python3 "$source/tests/support/check_page.py" $study || fail "the page of $study"
done

"$fracas" report rates > table.txt
cp table.txt rates/table.txt
cp rates/report/summary.json rates/summary.json
/usr/bin/python3 "$source/tests/support/check_report.py" rates "$source" || fail "the numbers of the report of rates"
rm rates/table.txt rates/summary.json

# Fits of other results are not shown.
cp -r rates older
expect 0 "$fracas" extend older --replicas 8
grep -q 'is not of these results' older/report/index.html || fail "stale fits are shown"
[ -z "$(find older/report -name 'fits-point-*')" ] || fail "figures of stale fits are left in the folder"
grep -q '"stale_fits": 3' older/report/summary.json || fail "the summary does not say that fits are stale"

# Equal studies have equal reports.
cp -r rates again
expect 0 "$fracas" report again
rm -f again/report/index.html rates/report/index.html # which name the study's folder
diff -r -x summary.json rates/report again/report || fail "a report that is made again differs"
