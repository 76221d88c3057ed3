#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 5400
# Every term of a membrane's cracks in tools/mutations/cracks.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels cracks "$1/mutate-cracks"
