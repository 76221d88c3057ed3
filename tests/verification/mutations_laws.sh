#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Laws of strengths and the size effect, broken on purpose by tools/mutations/laws.list, must make a test fail.
set -eu
exec tools/mutate-kernels laws "$1/mutate-laws"
