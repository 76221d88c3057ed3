#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Every term of the kernels, laws and ledger in tools/mutations/stershic.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels stershic "$1/mutate-stershic"
