#!/bin/sh
# ctest-labels: storm
# ctest-timeout: 3600
# The coverage of intervals that docs/theory/estimators.md states, from as many repetitions.
set -eu
FRACAS_REPETITIONS=1000 exec "$1/tests/test_statistical" estimators
