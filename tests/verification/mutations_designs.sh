#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Every term of designs, of their laws and of how a campaign file has them in tools/mutations/designs.list, broken on purpose, must make a
# test fail.
set -eu
exec tools/mutate-kernels designs "$1/mutate-designs"
