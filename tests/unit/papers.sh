#!/bin/sh
# tools/papers: the page of the papers is its table's, and each kind of fault of the table is found where it is planted.
set -eu

tools/papers --check --build "$1"

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
table=docs/results/data/papers.txt

# A small tree that is in order, with every form that the table has.
fresh() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/docs/results/data" "$tree/docs/theory" "$tree/campaigns/examples" "$tree/tests/unit" "$tree/tests/physics" "$tree/build"
    cat >"$tree/$table" <<'TABLE'
# A comment
source: 007
title: A paper
reference: A. Author: a paper
  about rings
setup: A: small
setup: B: large
note: Empty.

row: 007-01
place: 1 (1)
claim: A length, a*b | c
published: 1 m
tolerance: 1 %
state: reproduced
ours: 1.0 m
  by `a*b`
page: docs/results/ring.md#the-rings-own-size-vr; docs/theory/ring.md
by: unit/one: a_length, a_time; physics/two; fracas run campaigns/examples/small.yaml; commands of
  docs/results/ring.md#the-rings-own-size-vr

row: 007-02
place: 1 (2)
claim: A time
tolerance: -
state: differs
ours: 2 s
page: docs/theory/ring.md
by: physics/two
cause: Friction is missing.

row: 007-03
place: 2
claim: Another time
tolerance: -
state: not shown
cause: Nobody has run it.

row: 007-04
place: 3
claim: A solid
published: 3 m
tolerance: -
state: not possible
cause: solid bodies

row: 007-05
place: 4
claim: The length again
repeats: 007-01, 007-02

row: 007-06
place: 4
claim: The solid again
repeats: 007-04

misprint: 007, (1)
printed: 1 s
meant: 1 m
page: docs/theory/ring.md
TABLE
    printf "# Ring\n\nNone.\n\n## The ring's own \`size\`: v/R\n\n    fracas run small.yaml\n\n## Other\n\nText.\n" >"$tree/docs/results/ring.md"
    echo '# Ring' >"$tree/docs/theory/ring.md"
    : >"$tree/campaigns/examples/small.yaml"
    printf '/* ctest-labels: ci slow-sanitize */\nstatic void unused(void)\nTESTS(a_length,\n      a_time)\n' >"$tree/tests/unit/test_one.c"
    printf '# Two.\n# ctest-labels: storm\n' >"$tree/tests/physics/two.sh"
    printf 'add_test(unit/one "true")\nadd_test(physics/two "true")\n' >"$tree/build/CTestTestfile.cmake"
    tools/papers "$tree"
}

# After the edit $1 (a sed script) of file $2, "$3" is among the faults.
plant() {
    fresh
    sed -i "$1" "$tree/$2"
    if found=$(tools/papers --check --build "$tree/build" "$tree"); then
        echo "not found: $3, after $1 in $2"
        exit 1
    fi
    printf '%s\n' "$found" | grep -qF -e "$3" || {
        echo "expected: $3, after $1 in $2; found: $found"
        exit 1
    }
}

fresh
tools/papers --check "$tree"
tools/papers --check --build "$tree/build" "$tree"
while read -r line; do
    grep -qxF -e "$line" "$tree/docs/results/papers.md" || {
        echo "not found: $line"
        cat "$tree/docs/results/papers.md"
        exit 1
    }
done <<'LINES'
| [007 A paper](#007-a-paper) | 6 (2) | 1 | 2 | 1 | 2 |
| all | 6 (2) | 1 | 2 | 1 | 2 |
A. Author: a paper about rings. Empty.
- A: small.
| 007-01: 1 (1) | A length, a\*b \| c | 1 m; 1 % | **reproduced**: 1.0 m by `a*b` | [ring](ring.md#the-rings-own-size-vr), [ring](../theory/ring.md), `unit/one` (ci), `physics/two` (storm), `fracas run campaigns/examples/small.yaml`, commands of [ring](ring.md#the-rings-own-size-vr) |
| 007-02: 1 (2) | A time |  | **differs**: 2 s. Friction is missing. | [ring](../theory/ring.md), `physics/two` (storm) |
| 007-03: 2 | Another time |  | **not shown**: Nobody has run it. |  |
| 007-05: 4 | The length again |  | **differs**: as 007-01, 007-02 |  |
| solid bodies | 007-04 A solid (3 m); 007-06 The solid again (as 007-04) |
| 007, (1) | 1 s | 1 m | [ring](../theory/ring.md) |
LINES

plant 's/1\.0 m/1.1 m/' $table 'docs/results/papers.md:1: not the page of docs/results/data/papers.txt'
plant 's/1\.0 m/1.1 m/' docs/results/papers.md 'docs/results/papers.md:1: not the page'
plant 's|unit/one:|unit/noe:|' $table "$table:10: 007-01: no test unit/noe"
plant 's|, a_time|, a_tiem|' $table "$table:10: 007-01: unit/one has no function a_tiem"
plant 's|, a_time|, unused|' $table "$table:10: 007-01: unit/one has no function unused"
plant '/unit.one/d' build/CTestTestfile.cmake "$table:10: 007-01: no test unit/one"
plant '/^by: unit/d; /^  docs/d' $table "$table:10: 007-01: reproduced without by"
plant '/^page: docs.results/d' $table "$table:10: 007-01: reproduced without page"
plant 's/small.yaml;/smal.yaml;/' $table "$table:10: 007-01: no file campaigns/examples/smal.yaml"
plant 's/^    fracas.*/Nothing./' docs/results/ring.md "$table:10: 007-01: no command in docs/results/ring.md#the-rings-own-size-vr"
plant "s/own .size./size/" docs/results/ring.md "$table:10: 007-01: docs/results/ring.md has no section the-rings-own-size-vr"
plant 's|^page: docs/theory/ring.md|page: docs/theory/rings.md|' $table "$table:22: 007-02: no page docs/theory/rings.md"
plant 's/^state: differs/state: differ/' $table "$table:22: 007-02: unknown state differ"
plant '/^cause: Friction/d' $table "$table:22: 007-02: differs without cause"
plant '/^cause: Nobody/d' $table "$table:32: 007-03: not shown without cause"
plant '/^cause: solid/d' $table "$table:39: 007-04: not possible without cause"
plant 's/^state: differs/state: reproduced/' $table "$table:22: 007-02: reproduced, with a cause"
plant '/^claim: A time/d' $table "$table:22: 007-02: no claim"
plant 's/^cause: Friction/couse: Friction/' $table "$table:30: unknown field couse"
plant 's/^state: differs/&\n&/' $table "$table:27: a second state"
plant 's/^ours: 2 s/ours:/' $table "$table:27: ours is empty"
plant 's/^ours: 2 s/ours/' $table "$table:27: no field: ours"
plant 's/^row: 007-02/row: 007-01/' $table "$table:22: a second row 007-01"
plant 's/^row: 007-02/row: 008-02/' $table "$table:22: 008-02: of no source"
plant 's/^repeats: 007-04/repeats: 007-14/' $table "$table:52: 007-06: repeats 007-14, no row of its own"
plant 's/^repeats: 007-04/repeats: 007-05/' $table "$table:52: 007-06: repeats 007-05, no row of its own"
plant 's/^repeats: 007-04/&\nstate: differs/' $table "$table:52: 007-06: a repeat has a field of its own"
plant '/^meant/d' $table "$table:57: 007, (1): no meant"
plant '/^reference/d; /^  about/d' $table "$table:2: 007: no reference"
plant 's/^misprint/misprnit/' $table "$table:57: unknown record misprnit"
