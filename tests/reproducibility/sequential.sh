# ctest-labels: ci
# Replicas decided while the campaign runs: study.h5 is the same, byte for byte, whatever computes it, however often it is killed,
# and when a weaker rule came first; every decision is what a script of its own makes of study.h5.
. tests/support/campaigns.sh

# rule FILE RULE...: the small campaign with three points and other replicas, quick enough to be run many times.
rule()
{
    campaign "$1" 8 '3e4 1/s, 6e4 1/s, 1e5 1/s'
    sed -i -e "s/^replicas: .*/replicas: $2/" -e 's/elements: 500/elements: 200/; s/^seed: 7/seed: 1/' "$1"
}
until_narrow() { echo "{minimum: $1, maximum: $2, until: {quantity: $3, relative-half-width: $4, confidence: $5}}"; }
decisions() { /usr/bin/python3 "$source/docs/examples/decisions_from_study.py" "$1/study.h5"; }

rule one.yaml "$(until_narrow 8 48 mean-count 0.015 0.95)"
expect 0 "$fracas" plan one.yaml
said '3 points, 24 to 144 realizations'
said ' 8-48 '
expect 0 "$fracas" run one.yaml --study one --jobs 1
said '24 of 24 realizations of 3 points to do, and more as rules ask for them'
said 'warning: .* at the maximum of 48 replicas mean-count is known to 1.6 %, not to the 1.5 % asked for'
grep -q 'id="decisions"' one/report/index.html || fail "the report does not say how replicas were decided"
said 'decided: .*1.5 % asked for'
expect 0 decisions one
said 'goes on' # or nothing is tested
said 'precise'
said 'maximum'
expect 0 "$fracas" run --no-report one.yaml --study one
said 'nothing to compute'
expect 0 "$fracas" verify --full one
expect 0 "$fracas" status one
said 'decisions on replicas'

compare one.yaml --jobs 2
compare one.yaml --jobs 3 --segment-age 0.05
compare one.yaml --jobs 2 --shuffle --lanes 1 --lease-time 0 --segment-size 1e-6
compare one.yaml --jobs 3 --shuffle --lanes 8
compare one.yaml --jobs 1 --lanes 1

# Killed: everything at random times, in the first round and behind it.
for kill in 0 1; do
    hold
    start --no-report one.yaml --study killed --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
    wait_segments killed $((kill * 20 + 1))
    sleep "0.0$(random 10 49)"
    kill_session
    release
    [ ! -e killed/study.h5 ] || fail "it was over before it was killed"
done
expect 0 "$fracas" run --no-report one.yaml --study killed --jobs 2
same one killed
expect 0 "$fracas" verify --full killed

# One of three servers killed: its rounds are taken up.
hold
start --no-report one.yaml --study lost --jobs 3 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments lost 10
has_three_servers() { [ "$(named fracas-server | wc -l)" -eq 3 ]; }
await 'three servers' has_three_servers
kill -9 "$(named fracas-server | head -n 1)"
finish
[ $status -eq 0 ] || fail "status $status of a run that lost a server"
grep -q 'died of signal 9.*; a new one goes on' background || { cat background >&2; fail "it did not say that a server died"; }
same one lost

# Killed in the middle, and the index lost: segments of later rounds are kept.
hold
start --no-report one.yaml --study drained --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments drained 40
kill_session
release
rm drained/index.sqlite*
expect 0 "$fracas" run --no-report one.yaml --study drained --jobs 2
same one drained
expect 0 "$fracas" verify --full drained
rm one/index.sqlite* one/study.h5
expect 0 "$fracas" run --no-report one.yaml --study one
said '0 of .* realizations of 3 points to do'
same one drained

# A segment of a first round is lost after the last: its realizations come back, and the decisions stand.
rm "$(ls killed/segments/*.h5 | head -n 1)" killed/study.h5
expect 0 "$fracas" run --no-report one.yaml --study killed --jobs 2
same one killed

# A record of a decision that the realizations do not give is found, at the start and by verify.
cp -r killed wrong
sqlite3 wrong/index.sqlite "UPDATE decision SET mean = mean + 1e-9 WHERE round = 1"
expect 5 "$fracas" verify wrong
said 'decisions on the replicas of point'
rm wrong/study.h5
expect 5 "$fracas" run one.yaml --study wrong
said 'round 1 of point .* that its realizations do not give'

# A weaker rule first, then the stronger one; a fixed number first; from the rule to a fixed number.
rule weak.yaml "$(until_narrow 8 30 mean-count 0.03 0.9)"
expect 0 "$fracas" run --no-report weak.yaml --study weak

# Killed while it is extended: what is merged is sound, it is older than the campaign.
cp -r weak longer
rule longer.yaml "$(until_narrow 8 1000 mean-count 0.003 0.95)"
hold
start --no-report longer.yaml --study longer --jobs 1 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments longer $(($(segments weak) + 20))
kill_session
release
[ "$(sqlite3 longer/index.sqlite 'SELECT count(*) FROM decision WHERE maximum = 1000')" -gt 0 ] || fail "killed too early"
cmp weak/study.h5 longer/study.h5 || fail "killed too late"
expect 0 "$fracas" verify longer
said "note: study.h5 is older than campaign.yaml, which asks for more"
expect 0 "$fracas" run --no-report one.yaml --study weak
same one weak
expect 5 "$fracas" run weak.yaml --study weak
said 'replicas.maximum is 48 in the study .* it can only grow'
rule fixed.yaml 7
expect 0 "$fracas" run --no-report fixed.yaml --study fixed
expect 0 "$fracas" run --no-report one.yaml --study fixed
same one fixed
rule most.yaml 48
expect 0 "$fracas" run --no-report most.yaml --study most
expect 0 "$fracas" run --no-report most.yaml --study fixed
same most fixed
expect 0 "$fracas" verify --full fixed

# The other quantities.
for quantity in mean-size dissipated; do
    rule other.yaml "$(until_narrow 16 48 $quantity 0.02 0.95)"
    expect 0 "$fracas" run --no-report other.yaml --study "$quantity" --jobs 2
    expect 0 decisions "$quantity"
    expect 0 "$fracas" run --no-report other.yaml --study "$quantity-1" --jobs 1 --lanes 1 --shuffle
    same "$quantity" "$quantity-1"
done

# A quantity is that of the report.
for quantity in mean-count:count:one mean-size:size:mean-size dissipated:dissipated:dissipated; do
    "$fracas" report "${quantity##*:}" --json > report.json
    /usr/bin/python3 - "$quantity" <<'END'
import json, sys
quantity, key, _ = sys.argv[1].split(":")
for point in json.load(open("report.json"))["points"]:
    decision, mean = point["decision"], point["statistics"][key + ".mean"]
    half_width = point["statistics"][key + ".half_width"]
    assert decision["quantity"] == quantity and decision["used"] == point["statistics"][key + ".n"] > 0
    # The same sums in another way: some tens of roundings; of Student's t 1e-12.
    assert abs(decision["mean"] / mean - 1) < 1e-13 and abs(decision["half_width"] / half_width - 1) < 1e-10, (decision, mean)
END
done

# A realization that crashes for good counts for the round, not for the mean.
export FRACAS_TEST_FAULT=crash:0:9
expect 1 "$faulty" run --no-report one.yaml --study crashed --jobs 2
expect 0 decisions crashed
expect 1 "$faulty" run --no-report one.yaml --study crashed-1 --jobs 1 --lanes 1
same crashed crashed-1
unset FRACAS_TEST_FAULT
[ "$(sqlite3 crashed/index.sqlite 'SELECT sum(failed) > 0, max(failed) FROM decision')" = '1|1' ] || fail "the failed one is not counted"
expect 0 "$fracas" verify --full crashed
echo "$others other ways, $kill kills, extensions, a crash: the same bytes and decisions"
