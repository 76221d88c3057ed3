#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Every term of correlated fields in tools/mutations/correlated.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels correlated "$1/mutate-correlated"
