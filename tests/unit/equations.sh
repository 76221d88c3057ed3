#!/bin/sh
# tools/check-equations: the tree is tied, and each kind of broken tie is found where it is planted.
set -eu

tools/check-equations

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

# A small tree that is in order: every form that a page and a source may have.
fresh() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/docs/theory" "$tree/engine" "$tree/tests/unit"
    cat >"$tree/docs/theory/bar.md" <<'PAGE'
# The bar
$$ s = 2 $$ **(bar.2)**
code: `long_name_of_three`, `FOUR`
$$ s = 1 $$ **(bar.1)** code: `fracas_one`, `two`
In words.
As (bar.1) says.
PAGE
    cat >"$tree/docs/theory/scaling-laws.md" <<'PAGE'
**(scaling-laws.1)** code: `two`
PAGE
    cat >"$tree/engine/one.h" <<'SOURCE'
/* (bar.2), and (scaling-laws.1) over
 * lines: also (bar.1). */
#define FOUR(x) do { \
        (x);
fracas_err fracas_one(int argument);
static inline __attribute__((always_inline)) void two(const char *text, char c)
{
    if (c == '"') call("{ // no comment (bar.9)");
}
SOURCE
    cat >"$tree/engine/one.c" <<'SOURCE'
static const int table[] = {1, 2};
fracas_err fracas_one(int argument)
{
    return OK; // (bar.1)
}
static double long_name_of_three(double first,
                                 double (*second)(double)) /* (bar.2) */ {
    while (first) { first = second(first); }
}
SOURCE
    echo '/* (bar.2) */' >"$tree/tests/unit/test_one.c"
}

# After the edit $1 of file $2 (a sed script), "$3" must be the first thing found.
plant() {
    fresh
    sed -i "$1" "$tree/$2"
    if found=$(tools/check-equations "$tree"); then
        echo "not found: $3, after $1 in $2"
        exit 1
    fi
    case $found in
    "$3"*) ;;
    *)
        echo "expected: $3, after $1 in $2; found: $found"
        exit 1
        ;;
    esac
}

fresh
tools/check-equations "$tree"

plant 's/code: `fracas_one`, `two`//' docs/theory/bar.md 'docs/theory/bar.md:4: (bar.1) names no function'
plant 's/`fracas_one`/`fracas_oen`/' docs/theory/bar.md 'docs/theory/bar.md:4: (bar.1) names fracas_oen, which no source defines'
plant 's/^fracas_err fracas_one(int argument)$/&;/' engine/one.c 'docs/theory/bar.md:4: (bar.1) names fracas_one, which no source'
plant 's/(bar.1)/(bar.2)/' engine/one.c 'engine/one.c:3: defines fracas_one but its file does not cite (bar.1)'
plant 's/(scaling-laws.1)/scaling-laws.1/' engine/one.h 'engine/one.h:7: defines two but its file does not cite (scaling-laws.1)'
plant 's/(bar.2)/(bar.2) (bar.3)/' engine/one.c 'engine/one.c:7: cites (bar.3), which no page defines'
plant 's/(bar.2)/(baz.1)/' tests/unit/test_one.c 'tests/unit/test_one.c:1: cites (baz.1), which no page defines'
plant 's/scaling-laws.1/scaling-laws.2/' docs/theory/scaling-laws.md 'docs/theory/scaling-laws.md:1: (scaling-laws.2) is above the 1 labels of its page'
plant 's/scaling-laws.1/bar.3/' docs/theory/scaling-laws.md 'docs/theory/scaling-laws.md:1: (bar.3) should begin with scaling-laws'
plant 's/^As.*/**(bar.1)** code: `two`/' docs/theory/bar.md 'docs/theory/bar.md:6: (bar.1) is at docs/theory/bar.md:4 already'
plant 's/^As.*/code: `two`/' docs/theory/bar.md 'docs/theory/bar.md:6: names code, but neither'
plant 's/^\*\*.*//' docs/theory/scaling-laws.md 'engine/one.h:1: cites (scaling-laws.1), which no page defines'
