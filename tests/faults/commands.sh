# ctest-sanitize
# ctest-labels: ci
# The commands for studies: reindex, merge, gc, extend, retry, merge-studies. Whatever they do, the study ends as the bytes of an
# undisturbed run.
# ctest-timeout: 1800
. tests/support/campaigns.sh

campaign small.yaml 6 '3e4 1/s, 1e5 1/s'
campaign more.yaml 9 '3e4 1/s, 1e5 1/s'
pieces='--jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6' # a segment for each realization, or two
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2
expect 0 "$fracas" run --no-report more.yaml --study longer --jobs 2

# Every command refuses a study in use, as host and pid say, and what is none.
cp -r undisturbed used
/usr/bin/python3 -c '
import fcntl, os, socket, time
lock = open("used/lock", "r+")
fcntl.lockf(lock, fcntl.LOCK_EX)
lock.write(f"{socket.gethostname()} {os.getpid()}\n")
lock.flush()
open("locked", "w").close()
time.sleep(600)' &
holder=$!
while [ ! -e locked ]; do sleep 0.01; done
for command in 'reindex used' 'merge used' 'gc used' 'gc used --dry-run' 'retry used --failed' 'extend used --replicas 9' \
    'merge-studies used undisturbed' 'merge-studies undisturbed used'; do
    expect 4 "$fracas" $command
    said 'used/lock'
done
kill $holder
wait $holder 2>/dev/null || true
same undisturbed used
for command in 'reindex none' 'merge none' 'gc none' 'retry none --failed' 'extend none --replicas 9' 'merge-studies none used' \
    'merge-studies used none'; do
    expect 5 "$fracas" $command
    said 'none is no study'
done
expect 2 "$fracas" merge-studies used
said 'B is missing: fracas merge-studies A B'
expect 2 "$fracas" merge-studies used used
said 'are one study'
expect 2 "$fracas" merge-studies used used used
said 'one argument too many'

# merge: nothing to do, something to do, realizations missing.
expect 0 "$fracas" merge used
said 'study.h5 is there already'
rm used/study.h5
expect 0 "$fracas" merge used
said 'study.h5 is written'
same undisturbed used
expect 0 "$fracas" run --no-report small.yaml --study pieces $pieces
set -- pieces/segments/*.h5
rm "$1" "$2"
expect 3 "$fracas" merge pieces
said '[23] of 12 realizations of pieces are not computed yet; `fracas run pieces/campaign.yaml --study pieces`'
expect 3 "$fracas" merge pieces --json
said '"missing": [23]'

# reindex: after which a run computes what is missing and nothing else. A failure is remembered.
cp -r pieces lost
rm lost/index.sqlite*
expect 0 "$fracas" reindex lost
said '12 realizations, [0-9]* done in [0-9]* segments, 0 failed, [23] missing'
said 'fracas run lost/campaign.yaml --study lost'
expect 0 "$fracas" run --no-report lost/campaign.yaml --study lost
same undisturbed lost
expect 1 env FRACAS_TEST_FAULT=crash:1:5 "$faulty" run --no-report small.yaml --study failed $pieces
cp failed/study.h5 failed.h5
expect 0 "$fracas" reindex failed --json
said '"failed": 1'
expect 0 "$fracas" status failed
said 'point 1 replica 5, 3 attempts'
expect 1 "$fracas" merge failed
cmp failed.h5 failed/study.h5 || fail "made anew, study.h5 differs"
expect 1 "$fracas" export failed/study.h5 --study handed
cmp failed.h5 handed/study.h5 || fail "handed on, study.h5 differs"
expect 0 "$fracas" verify failed --full
printf 'no index' > failed/index.sqlite
expect 0 "$fracas" reindex failed
said 'cannot be used'
said '0 failed, 1 missing'
ls failed/index.sqlite.before-* > /dev/null || fail "the damaged index is gone"

# gc frees what a dry run says, byte for byte, and leaves the rest.
kept=$(segments failed)
echo mine > failed/notes.txt
mkdir -p failed/pictures failed/export
echo fitted > failed/fits.csv
echo half > failed/segments/.x.h5.tmp-1
expect 0 "$fracas" gc failed --dry-run
said 'would free failed/index.sqlite.before-'
ls failed/index.sqlite.before-* > /dev/null || fail "a dry run removed something"
expect 0 "$fracas" gc failed
said 'freed failed/index.sqlite.before-'
said 'freed failed/segments/.x.h5.tmp-1 (5 bytes)'
said 'left failed/notes.txt'
! grep -q 'left failed/\(fits\|pictures\|export\)' said || fail "gc does not know what fracas writes"
rm -r failed/pictures failed/export failed/fits.csv
[ -e failed/notes.txt ] || fail "gc removed what it does not know"
[ "$(segments failed)" -eq "$kept" ] || fail "gc removed a segment"
expect 0 "$fracas" gc failed --json
said '"path": "failed/notes.txt"'
expect 1 env FRACAS_TEST_FAULT=crash:1:5 "$faulty" run --no-report small.yaml --study failed $pieces
cmp failed.h5 failed/study.h5 || fail "after gc, it differs"

# retry: what failed is computed again. A run has nothing to do.
expect 2 "$fracas" retry failed
said 'retry: --failed is missing'
expect 2 "$fracas" retry failed --failed --point 2
said 'points 0 to 1'
expect 1 "$fracas" retry failed --failed --point 0
said '0 failed realizations of failed are planned again'
expect 1 env FRACAS_TEST_FAULT=crash:1:5 "$faulty" retry failed --failed --no-report --jobs 2
said '1 failed realizations of failed are planned again'
cmp failed.h5 failed/study.h5 || fail "failed again, it differs"
expect 0 "$fracas" retry failed --failed --no-report --point 1 --jobs 2 --lanes 1
same undisturbed failed
expect 0 "$fracas" verify failed --full

# extend: the bytes of a fresh run of the longer campaign.
cp -r undisturbed extended
expect 2 "$fracas" extend extended
said 'extend: --replicas N is missing'
expect 2 "$fracas" extend extended --replicas 5
said 'has 6 already'
expect 0 "$fracas" extend extended --replicas 6
said 'complete, nothing to compute'
expect 0 "$fracas" extend extended --no-report --replicas 9 --jobs 2 --lanes 4
said 'is to grow from 12 realizations to 18'
same longer extended
expect 5 "$fracas" run small.yaml --study extended
said 'extended has been extended since: `fracas run extended/campaign.yaml --study extended` goes on with it'
cmp longer/campaign.yaml extended/campaign.yaml || fail "campaign.yaml is not that of the longer campaign"
expect 0 "$fracas" verify extended --full
sed 's/^replicas:.*/replicas: {minimum: 8, maximum: 9, until: {quantity: mean-count, relative-half-width: 0.5}}/' small.yaml > rule.yaml
expect 0 "$fracas" run --no-report rule.yaml --study rule --jobs 2
expect 2 "$fracas" extend rule --replicas 20
said 'a rule decides the replicas of point 0'
cp rule/study.h5 rule.h5
rm rule/index.sqlite*
expect 0 "$fracas" reindex rule
expect 0 "$fracas" merge rule
cmp rule.h5 rule/study.h5 || fail "decided again, it differs"

# merge-studies: two parts, in either order; a part of a longer campaign; what both have is compared.
expect 3 "$fracas" run --no-report small.yaml --study odd --part 1/2 $pieces
expect 3 "$fracas" run --no-report small.yaml --study even --part 2/2 --jobs 2
cp -r odd odd-too
cp -r even even-too
expect 0 "$fracas" merge-studies odd even
said '`fracas merge odd` writes study.h5'
expect 0 "$fracas" merge odd
same undisturbed odd
expect 0 "$fracas" verify odd --full
expect 0 "$fracas" merge-studies even-too odd-too --json
said '"missing": 0'
expect 0 "$fracas" run --no-report small.yaml --study even-too
same undisturbed even-too
expect 0 "$fracas" merge-studies odd even # again: all there
said '6 realizations are in both, and the same'
expect 0 "$fracas" merge-studies odd extended
said '6 realizations in .* 12 realizations are in both'
expect 0 "$fracas" merge odd
same longer odd
expect 0 "$fracas" merge-studies odd undisturbed # of a shorter campaign
said 'from undisturbed: 0 realizations'

campaign other.yaml 6 '3e4 1/s, 2e5 1/s'
sed 's/^seed:.*/seed: 8/' small.yaml > seed.yaml
expect 0 "$fracas" run --no-report other.yaml --study other --jobs 2
expect 0 "$fracas" run --no-report seed.yaml --study seed --jobs 2
expect 5 "$fracas" merge-studies used other
said 'loading.rate'
expect 5 "$fracas" merge-studies used seed
said 'seed is 7 .*8'
same undisturbed used

# A realization that is not the same: nothing is changed.
cp -r pieces strange
/usr/bin/python3 - <<'END'
import glob, h5py
with h5py.File(sorted(glob.glob("strange/segments/*.h5"))[0], "r+") as f:
    f["realization/momentum"][0] += 1
    print(f["realization/replica"][0], f["realization/point"][0])
END
rm strange/index.sqlite*
expect 0 "$fracas" reindex strange
rm used/study.h5
before=$(ls -l used/segments)
expect 5 "$fracas" merge-studies used strange
said 'replica [0-9]* of point [01] (.*) is not the same in used and strange'
[ "$before" = "$(ls -l used/segments)" ] || fail "something was copied"
expect 0 "$fracas" merge used
same undisturbed used

# Older formats are refused by name, by every command.
cp -r undisturbed aged
for file in aged/study.h5 aged/segments/*.h5; do
    /usr/bin/python3 -c 'import h5py, sys; h5py.File(sys.argv[1], "r+").attrs.modify("format_version", 1)' "$file"
done
sqlite3 aged/index.sqlite "UPDATE meta SET value = '1' WHERE key = 'format_version'"
for command in 'verify aged' 'status aged' 'report aged' 'reindex aged' 'merge aged' 'gc aged' 'retry aged --failed' \
    'extend aged --replicas 7' 'merge-studies aged undisturbed' 'merge-studies used aged'; do
    expect 5 "$fracas" $command
    said 'aged/.* has format version 1; this program reads \(3 to \)\{0,1\}6: use the program version that wrote it, or compute the study again'
done
