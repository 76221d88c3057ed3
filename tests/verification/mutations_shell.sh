#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 5400
# Every term of the uncracked shell in tools/mutations/shell.list, broken on purpose, must make a test fail.
set -eu
exec tools/mutate-kernels shell "$1/mutate-shell"
