# The lock of a study, as a person meets it: another run, a killed one, one on another host.
. tests/support/campaigns.sh

campaign small.yaml 30 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 2
[ ! -s undisturbed/lock ] || fail "the lock was not left empty"
expect 0 "$fracas" status undisturbed
! grep -q '^lock' said || fail "a study that is free shows a lock"

# Another host, which is killed: refused with its name until --force; nothing is changed before.
export FRACAS_TEST_HOST=node7 # which $faulty takes for the name of its host
hold
start --no-report small.yaml --study study --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments study 3
unset FRACAS_TEST_HOST
expect 4 "$fracas" run small.yaml --study study
said 'another run uses this study: host node7, pid [0-9]*, since 20'
expect 4 "$fracas" run small.yaml --study study --force
said 'wait for it or stop it'
expect 0 "$fracas" status study
said '^lock  *held: host node7'
kill_session
release
cp study/lock before
expect 4 "$fracas" run small.yaml --study study
said 'host node7, pid .*look on that host.*--force'
expect 0 "$fracas" status study
said '^lock .*--force.*host node7'
expect 0 "$fracas" verify study
said 'note: .*host node7'
cmp before study/lock || fail "a refused run changed the lock"
expect 0 "$fracas" run --no-report small.yaml --study study --force --jobs 2
same undisturbed study
[ ! -s study/lock ] || fail "the lock was not left empty"
sqlite3 study/index.sqlite 'SELECT kind, text FROM event' > said
said 'took over|the lock.*host node7'

# This host: taken over without a word.
hold
start --no-report small.yaml --study own --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments own 3
kill_session
release
expect 0 "$fracas" status own
said '^lock  *left by a run that died'
expect 0 "$fracas" run --no-report small.yaml --study own --jobs 2
! grep -q 'lock' said || { cat said >&2; fail "it spoke of a lock of its own host"; }
same undisturbed own
sqlite3 own/index.sqlite 'SELECT kind FROM event' > said
said '^took over$'

# A job of Slurm that was requeued to another node.
export FRACAS_TEST_HOST=node8 SLURM_JOB_ID=77
hold
start --no-report small.yaml --study job --jobs 2 --lanes 1 --lease-time 0 --segment-size 1e-6
wait_segments job 3
kill_session
release
export FRACAS_TEST_HOST=node9
expect 4 "$faulty" run small.yaml --study job --jobs 2
SLURM_RESTART_COUNT=1
export SLURM_RESTART_COUNT
expect 0 "$faulty" run --no-report small.yaml --study job --jobs 2
same undisturbed job
