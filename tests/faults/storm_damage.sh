# 500 flipped bytes and 100 truncations at sampled places of segments, index and study.h5: of a finished study, an interrupted
# one, one with a rule for replicas, and one without its index. verify finds and names them; run, or what its message says to do,
# gives the undisturbed study.h5. Half of the flips are of one bit.
# ctest-labels: storm
# ctest-timeout: 3600
. tests/support/campaigns.sh

campaign small.yaml 100 '3e4 1/s, 1e5 1/s'
sed -i 's/elements: 500/elements: 100/' small.yaml
sed "s|^replicas: .*|replicas: {minimum: 8, maximum: 60, until: {quantity: mean-count, relative-half-width: 3 %, confidence: 0.95}}|" small.yaml > rule.yaml
expect 0 "$fracas" run small.yaml --study finished --jobs 1 --segment-size 1e-6 --lease-time 0.02
expect 0 "$fracas" run rule.yaml --study ruled --jobs 1 --segment-size 1e-6 --lease-time 0.02
cp -r finished lost
rm -r lost/index.sqlite* lost/study.h5 # in the middle of nowhere: all segments are orphans
tries=0
while :; do
    rm -rf interrupted
    start small.yaml --study interrupted --jobs 1 --segment-size 1e-6 --lease-time 0.02
    wait_segments interrupted 3
    kill -TERM "$session" 2>/dev/null || true
    status=0
    wait "$session" || status=$?
    session=
    [ $status -ne 3 ] || break
    tries=$((tries + 1))
    [ $tries -lt 20 ] || fail "not interrupted, $tries times"
done
for study in finished ruled lost interrupted; do echo "$study: $(segments $study) segments"; done
/usr/bin/python3 "$source/tests/support/damage.py" "$fracas" "${FRACAS_DAMAGE_SEED:-20261121}" "${FRACAS_DAMAGE_FLIPS:-500}" \
    "${FRACAS_DAMAGE_CUTS:-100}" finished=small.yaml=finished=finished/study.h5 ruled=rule.yaml=ruled=ruled/study.h5 \
    lost=small.yaml=lost=finished/study.h5 interrupted=small.yaml=interrupted=finished/study.h5 > told || {
    cat told
    cp -r kept-* "${FRACAS_DAMAGE_KEEP:-/nowhere}" 2>/dev/null || true
    fail "damage was not told, or not put right"
}
cat told
