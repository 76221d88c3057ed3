#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Every term of the laws in tools/mutations/plane.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels plane "$1/mutate-plane"
