#!/bin/sh
# ctest-labels: ci slow-sanitize
# 500 farms more.
set -eu
"$1/tests/simulate" 1000 500 --jobs 2
