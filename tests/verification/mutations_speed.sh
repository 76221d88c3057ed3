#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Drawing over lanes and the streams, broken on purpose by tools/mutations/speed.list, must make a test fail.
set -eu
exec tools/mutate-kernels speed "$1/mutate-speed"
