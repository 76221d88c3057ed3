#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 5400
# Every line of strengths at Gauss points and of graded material in tools/mutations/points.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels points "$1/mutate-points"
