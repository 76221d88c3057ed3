# Bodies that `stop: time` ends while they break are warned of, with the share of the energy that the last tenth of the time dissipated; those
# that had ended breaking are not.
. tests/support/campaigns.sh

cat > end.yaml <<'YAML'
name: end
seed: 3
model: bar
geometry: {ends: periodic, length: 10 mm, area: 1 mm2}
mesh: {elements: 1000}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: imposed-rate, rate: 1e5 1/s}
sweep:
  - time: [{stop: time, end: 70 ns}, {stop: time, end: 300 ns}, {stop: settled, end: 70 ns, quiet: 50 ns}]
replicas: 4
output: {history: 100, interfaces: false}
YAML
expect 0 "$fracas" run end.yaml --study end --jobs 2
expect 0 "$fracas" report end
grep -F 'bodies were still breaking at time.end' said > warnings || fail "no warning of bodies that still break"
[ "$(wc -l < warnings)" = 1 ] || fail "one point of three breaks until its end without an outcome that says so"
# two digits: the share is rounded by less than 5 %
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
    $column["point"] == 0 { if ($column["time"] < 63.01e-9) early = $column["dissipated.mean"]; late = $column["dissipated.mean"] }
    END { print 100 * (1 - early/late) }' end/report/energies.csv > share
said_share=$(sed 's/.*time.end: \([0-9.]*\) %.*/\1/' warnings)
awk -v said="$said_share" '{ exit !($1 > 1 && said > 0.95 * $1 && said < 1.05 * $1) }' share || fail "$said_share % said, $(cat share) % in energies.csv"
