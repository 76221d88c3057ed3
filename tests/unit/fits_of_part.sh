# Fits are of realizations: those that are made while a study is partial are shown by the report of it, and by that of the complete study for
# every point that was complete by then. Bodies of one piece are left out, and said to be.
. tests/support/campaigns.sh

campaign small.yaml 12 '1e3 1/s, 6e4 1/s, 1e5 1/s'
expect 0 "$fracas" run small.yaml --study whole --jobs 2
cp -r whole part
rm part/study.h5
sqlite3 part/index.sqlite "UPDATE realization SET status = 'planned', segment = NULL, outcome = NULL, row = NULL WHERE replica >= 6 AND
    point = (SELECT max(point) FROM realization)"
expect 0 "$fracas" fit part --resamples 99
said 'point 1, .* fragments of 12 realizations'
said 'point 2, .* fragments of 6 realizations'
said 'warning: 12 of 12 realizations are of one piece: the body; left out of the fits'
[ ! -e part/study.h5 ] || fail "the study is complete already"
expect 0 "$fracas" report part
page=part/report/index.html
grep -q 'is not of these results' $page && fail "fits of what is there are called stale"
grep -q 'Fits to fragment sizes' $page || fail "there are no fits of the partial study"
grep -q 'Point 0, rate 1e3 1/s: 12 of 12 realizations are of one piece' $page || fail "the page does not speak of whole bodies"
[ -e part/report/fits-point-2.svg ] || fail "the partial point has no figure of fits"

# Complete: points 0 and 1 as they were, point 2 has other realizations.
expect 0 "$fracas" run small.yaml --study part --jobs 2
same whole part
expect 0 "$fracas" report part
said 'fits of 1 point in part/fits.csv are of other realizations and not shown'
grep -q 'kept of 1 point is not of these results' $page || fail "fits of half a point are shown as if they were of all"
[ -e part/report/fits-point-1.svg ] || fail "the fits of a point that has not changed are gone"

# Fitted alone that point joins the others, and all is what the complete study gives.
expect 0 "$fracas" fit part --point 2 --resamples 99
expect 0 "$fracas" fit whole --resamples 99
for study in part whole; do sed '$d' $study/fits.csv | sort > $study.sorted; done # without the seal of their order
diff whole.sorted part.sorted || fail "the fits of a study depend on when they were made"

# What was computed is kept though nobody reads what is printed.
rm part/fits.csv
"$fracas" fit part --resamples 99 --point 1 --json | true
[ -e part/fits.csv ] || fail "fits are lost with the reader of what is printed"
