#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 1800
# Every term of the rigid body in tools/mutations/fragments.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels fragments "$1/mutate-fragments"
