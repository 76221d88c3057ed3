#!/bin/sh
# ctest-labels: storm
# 500 farms more.
set -eu
"$1/tests/simulate" 1000 500 --jobs 2
