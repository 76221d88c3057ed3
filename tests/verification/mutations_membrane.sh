#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 5400
# Every term of the uncracked membrane in tools/mutations/membrane.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels membrane "$1/mutate-membrane"
