# Bodies that `stop: time` ends while they break are warned of, with the share of the energy that the last tenth of the time dissipated; those
# that had ended breaking are not.
. tests/support/campaigns.sh

campaign end.yaml 4 '1e5 1/s'
sed -i 's/^time:.*//; s/history: 20/history: 100/
    s/^  - loading.rate:.*/  - time: [{stop: time, end: 70 ns}, {stop: time, end: 300 ns}, {stop: quiet, end: 70 ns, quiet: 50 ns}]/' end.yaml
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

# Where histories have no tenth of the time nothing is said: of a quarter, a third, the whole, a settled body has dissipated more than 1 % as well.
for intervals in 0 1 4 9; do
    sed "s/history: 100/history: $intervals/" end.yaml > coarse.yaml
    expect 0 "$fracas" run coarse.yaml --study coarse$intervals --jobs 2
    expect 0 "$fracas" report coarse$intervals
    grep -q 'still breaking' said && fail "a tenth of the time is told from $intervals intervals"
done
exit 0
