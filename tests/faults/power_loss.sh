# Disk states that a power cut may leave of a tiny run, opened in process: what was done is there. Without one fsync it is not, and
# this is seen. storm_power_loss.sh has 100 000 states.
. tests/support/campaigns.sh
. "$source/tests/support/power_loss.sh"

tiny one.yaml 4 '1e5 1/s'
expect 0 "$fracas" run one.yaml --study whole --jobs 1

# one NAME COUNT: states of a run; with DISK_SWALLOW a fault is planted.
one()
{
    tape "$1"
    expect 0 recorded "$fracas" run one.yaml --study "$1/study" --jobs 2 $segment_each
    same "$1/study" whole
    states "$1" one.yaml whole/study.h5 "$2" 1 1
}

one right 400 || fail "a power cut loses what was done"

# planted PATTERN WHAT: an fsync without effect.
planted()
{
    export DISK_SWALLOW="$1"
    ! one planted 400 > /dev/null || fail "it is not seen that $1 is never synced"
    unset DISK_SWALLOW
    grep -q "^FAULT.*$2" told || { cat told; fail "another fault than that $1 is never synced"; }
    rm -rf planted planted.log
}

planted '*/segments/.*.h5.tmp-*' 'damaged'       # the bytes of a segment
planted '*/segments' 'is missing\|promised and lost' # its name
planted '*/planted' 'promised and lost'          # the study
planted '*/.study.h5.tmp-*' 'study.h5'
