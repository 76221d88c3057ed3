#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 5400
# Every term of a shell's cracks in tools/mutations/shell-cracks.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels shell-cracks "$1/mutate-shell-cracks"
