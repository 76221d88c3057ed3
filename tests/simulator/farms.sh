#!/bin/sh
# Farms of 2 to 16 workers, each from its seed, and one of a thousand; the same seed gives the same trace.
set -eu
simulate=$1/tests/simulate
"$simulate" 1 60
"$simulate" 1 1 --workers 1000
"$simulate" 8 --trace >"${TMPDIR:-/tmp}/farm.$$"
"$simulate" 8 --trace | cmp - "${TMPDIR:-/tmp}/farm.$$" || { echo "FAILED: seed 8 gives two traces"; exit 1; }
rm -f "${TMPDIR:-/tmp}/farm.$$"
