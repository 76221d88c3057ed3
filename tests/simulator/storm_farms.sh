#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 7200
# 10 000 farms, and 100 of a thousand workers.
set -eu
"$1/tests/simulate" 10000 10000 --jobs 2
"$1/tests/simulate" 1 100 --workers 1000 --jobs 2
