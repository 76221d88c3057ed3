# 5000 mutants of campaign files and 2000 of meshes and strengths, the same every time, and what `fracas plan` says to 300 of them; a
# minute of libFuzzer on each target, and planted bugs that it must find. Longer: tools/fuzz.
# ctest-labels: storm
# ctest-timeout: 7200
set -eu
seed=${FRACAS_FUZZ_SEED:-1}
if ! tools/fuzz --runs "${FRACAS_FUZZ_MUTANTS:-5000},$seed" campaign_file || ! tools/fuzz --runs "${FRACAS_FUZZ_FILES:-2000},$seed" attached ||
    ! /usr/bin/python3 tests/support/plan_mutants.py "$(cd "$1" && pwd)/fracas" build/fuzz/mutants-campaign_file 300 ||
    ! tools/fuzz "${FRACAS_FUZZ_SECONDS:-60}"; then
    echo "FAILED: an input that crashes, leaks, hangs or is not told" >&2
    exit 1
fi
tools/fuzz-planted
