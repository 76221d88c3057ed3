#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Every rule of the leases in tools/mutations/scheduling.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels scheduling "$1/mutate-scheduling"
