#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# Every term of the kernels, laws and ledger in tools/mutations/ring.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels ring "$1/mutate-ring"
