# A campaign in parts, and with another number of replicas than its file says: study.h5 is the same, byte for byte.
. tests/support/campaigns.sh

campaign whole.yaml 12 '3e4 1/s, 1e5 1/s'
campaign small.yaml 8 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report whole.yaml --study whole --jobs 2

# Part after part in one study.
for again in 1 2; do
    expect 3 "$fracas" run --no-report whole.yaml --study parts --jobs 2 --part 2/2
    said 'part 2 of 2, .* of 12 realizations of 2 points to do'
    said 'part 2 of 2 is complete, 12 realizations, 0 of them FAILED; when the other parts are, `fracas merge-studies`'
done
said 'part 2 of 2, 0 of 12' # the second time
expect 0 "$fracas" status parts
said '24: 12 done, 0 failed, 0 leased, 12 planned'
said 'its part is complete: `fracas merge-studies`'
said 'part  *2 of 2: 12 realizations, 0 to be computed'
expect 0 "$fracas" reindex parts
expect 0 "$fracas" status parts --json
said '"parts": 2'

# What goes on with a study stays with its part.
cp -r parts grown
expect 3 "$fracas" extend grown --replicas 14
said 'part 2 of 2 is complete, 14 realizations'
expect 3 env FRACAS_TEST_FAULT=crash:1:5 "$faulty" run --no-report whole.yaml --study tried --jobs 2 --part 2/2
expect 0 "$fracas" status tried
said '1 failed'
expect 3 "$fracas" retry tried --failed
said 'part 2 of 2 is complete, 12 realizations, 0 of them FAILED'
expect 3 "$fracas" run --no-report whole.yaml --study first --jobs 2 --part 1/2
expect 0 "$fracas" merge-studies tried first
expect 0 "$fracas" status tried --json
said '"parts": 1'
expect 0 "$fracas" merge tried
same whole tried
expect 0 "$fracas" run --no-report whole.yaml --study parts --jobs 1 --part 1/2
same whole parts
expect 0 "$fracas" run --no-report whole.yaml --study parts --part 1/2
said 'nothing to compute'

# More replicas than the file says: what the file would say counts from then on.
expect 0 "$fracas" run --no-report small.yaml --study more --jobs 2 --replicas 12
same whole more
expect 0 "$fracas" run --no-report more/campaign.yaml --study more
said 'nothing to compute'
expect 5 "$fracas" run small.yaml --study more --replicas 10
said 'replicas is 12 in the study'
expect 5 "$fracas" run small.yaml --study more
said 'replicas is 12 in the study'
expect 0 "$fracas" run --no-report small.yaml --study less --jobs 2
expect 0 "$fracas" run --no-report small.yaml --study less --jobs 2 --replicas 12
same whole less

sed 's/^replicas: .*/replicas: {minimum: 8, maximum: 16, until: {quantity: dissipated, relative-half-width: 0.1}}/' small.yaml > rule.yaml
expect 2 "$fracas" run rule.yaml --replicas 8
said 'rule.yaml: --replicas 8: a rule decides the replicas of point 0'
expect 2 "$fracas" run rule.yaml --part 1/2
said 'part 1/2: in rule.yaml a rule decides'
echo "2 parts in one study, more replicas: the same bytes"
