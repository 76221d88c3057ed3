# A minute of libFuzzer on the campaign file and one on segments, and planted bugs that it must find. Longer: tools/fuzz.
# ctest-labels: storm
# ctest-timeout: 3600
set -eu
if ! tools/fuzz "${FRACAS_FUZZ_SECONDS:-60}"; then
    echo "FAILED: an input that crashes, leaks, hangs or is not told" >&2
    exit 1
fi
tools/fuzz-planted
