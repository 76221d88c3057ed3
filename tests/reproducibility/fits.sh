# ctest-sanitize
# ctest-labels: ci
# fracas fit gives the same bytes with one process and with two, and across kills: what was saved of another state of the study, with other
# resamples, or damaged, is not used.
. tests/support/campaigns.sh

campaign small.yaml 12 '3e4 1/s, 6e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study study --jobs 2
expect 0 "$fracas" fit study --resamples 99 --jobs 1
mv study/fits.csv one.csv
expect 0 "$fracas" fit study --resamples 99 --jobs 2
cmp one.csv study/fits.csv || fail "fits depend on the number of processes"
[ ! -e study/fits.csv.part ] || fail "what is saved on the way stays behind"
rm study/fits.csv

saved() { { grep -c ',fits,end,' study/fits.csv.part || true; } 2> /dev/null; }

# Killed after its first point, it goes on with the second.
"$fracas" fit study --resamples 199 --jobs 1 > killed 2>&1 &
job=$!
for _ in $(seq 600); do
    [ "$(saved)" -gt 0 ] 2> /dev/null && break
    sleep 0.05
done
kill -9 $job 2> /dev/null || true
wait $job || true
before=$(saved)
[ "$before" -gt 0 ] || fail "nothing is saved: $(cat killed)"
[ ! -e study/fits.csv ] || [ "$before" -eq 3 ] || fail "fits of a part are taken for all"
cp study/fits.csv.part kept

# With other resamples all points are fitted; as asked for first, those that are there are not.
expect 0 "$fracas" fit study --resamples 99 --jobs 2
cmp one.csv study/fits.csv || fail "fits with other resamples are used"
cp kept study/fits.csv.part
sed -i 's/^\(.*,data,mean,m,\)[0-9.e-]*,/\1123,/' study/fits.csv.part # an invented number: the checksum does not fit
expect 0 "$fracas" fit study --resamples 199 --jobs 2
cp study/fits.csv other.csv
grep -q ',data,mean,m,123,' other.csv && fail "damaged fits are used"
cp kept study/fits.csv.part
printf ',,fits,begin,,,,,,0123' >> study/fits.csv.part # a block half written
expect 0 script -qec "$fracas fit study --resamples 199 --jobs 2" shown
grep -q "fitted $before of 3 points, $before of them by an earlier call" shown || fail "saved fits are not used: $(head -c 300 shown)"
cmp other.csv study/fits.csv || fail "fits depend on a kill"

# Of more realizations.
cp kept study/fits.csv.part
expect 0 "$fracas" extend study --replicas 14
expect 0 script -qec "$fracas fit study --resamples 199 --jobs 2" shown
grep -q 'by an earlier call' shown && fail "fits of other realizations are used"
cp -r study again
rm again/fits.csv
expect 0 "$fracas" fit again --resamples 199 --jobs 1
cmp again/fits.csv study/fits.csv || fail "fits after an extension are others"

# One at a time.
exec 9>> study/fits.csv.part
flock 9
expect 6 "$fracas" fit study --resamples 99
said 'another `fracas fit` of study is at work'
