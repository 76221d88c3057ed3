#!/bin/sh
# ctest-labels: storm
# Every term of kernels, laws and ledger, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels "$1/mutate"
