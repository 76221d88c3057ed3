#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 7200
# Every term of the laws in tools/mutations/plane.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels plane "$1/mutate-plane"
