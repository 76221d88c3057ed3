#!/bin/sh
# ctest-labels: ci
# tools/check-format: the tree obeys, and a line that is too long or a missing licence is found.
# tools/mutate-kernels --check, tools/fuzz-planted --check: every mutation and planted bug finds its place in the sources.
set -eu

tools/check-format
tools/mutate-kernels --check
tools/fuzz-planted --check

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
for room in base engine sampler campaigns analysis cli library tests bench; do mkdir "$tree/$room"; done
mkdir "$tree/tools"
cp tools/check-format "$tree/tools"
cp .clang-format "$tree"

printf '/* SPDX-License-Identifier: GPL-3.0-or-later */\nint  one;\n' >"$tree/base/one.c"
! "$tree/tools/check-format" >"$tree/found" 2>&1
grep -q 'one.c:2:4: error: code should be clang-formatted' "$tree/found"
"$tree/tools/check-format" --fix
"$tree/tools/check-format"
printf 'int two;\n' >"$tree/base/two.c"
! "$tree/tools/check-format" >"$tree/found" 2>&1
grep -q 'two.c:1: begins without' "$tree/found"
