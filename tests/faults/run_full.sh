# A disk that fills up while segments are written: the message says so, status 6, and with more room the same command
# goes on to what an undisturbed run gives.
. tests/support/campaigns.sh

campaign small.yaml 40 '3e4 1/s, 1e5 1/s' # more than 1 MB of results
expect 0 "$fracas" run small.yaml --study undisturbed --jobs 2
mkdir small
cat > in-small-disk.sh <<'EOF2'
mount -t tmpfs -o size=1m tmpfs small || exit 77
status=0
"$1" run small.yaml --study small/study --jobs 2 --lanes 8 --ignore-space || status=$?
[ $status -eq 6 ] || exit 1
echo "refused"
mount -o remount,size=64m small && "$1" run small.yaml --study small/study --jobs 2 && cp small/study/study.h5 resumed.h5
EOF2
root=-r
[ "$(id -u)" -ne 0 ] || root=
status=0
unshare $root -m sh in-small-disk.sh "$fracas" > said 2>&1 || status=$?
if ! grep -q '^refused' said && { [ $status -eq 77 ] || grep -q '^unshare:' said; }; then
    echo "skipped: a small disk cannot be mounted here"
    exit 0
fi
[ $status -eq 0 ] || { cat said >&2; fail "status $status"; }
said 'No space left\|disk is full\|disk full'
said 'same command goes on'
cmp undisturbed/study.h5 resumed.h5 || fail "resumed after a full disk, it differs"
