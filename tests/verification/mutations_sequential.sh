#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Every term of the rounds and decisions in tools/mutations/sequential.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels sequential "$1/mutate-sequential"
