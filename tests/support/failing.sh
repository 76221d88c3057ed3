# For shell tests that let calls fail; sourced after campaigns.sh, with the build folder in $1.
library=$(dirname "$fracas")/tests/failing_calls.so

# failing WHAT...: as tests/support/failing_calls.py takes it. In memory where there is room: what a disk forgets is not the question.
failing()
{
    folder=$work
    if [ -w /dev/shm ] && [ "$(df -Pk /dev/shm | awk 'NR == 2 {print $4}')" -gt 200000 ]; then
        folder=$(mktemp -d /dev/shm/fracas-failing.XXXXXX)
        trap 'status=$?; rm -rf "$folder" "$work"; exit $status' EXIT
    fi
    /usr/bin/python3 "$source/tests/support/failing_calls.py" "$fracas" "$library" "$folder" "$@"
}
