#!/bin/sh
# The README keeps its word: its campaign file is one, its commands exist. Every page and heading that a page links to is there.
set -eu

fracas=$1/fracas
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

sed -n '/^```yaml$/,/^```$/p' README.md | sed '/^```/d' >"$folder/my-bar.yaml"
"$fracas" plan --json "$folder/my-bar.yaml" >"$folder/plan"
[ "$(grep -c '"replicas": 16' "$folder/plan")" = 12 ] || { cat "$folder/plan"; exit 1; }
/usr/bin/python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["warnings"] == []' "$folder/plan" ||
    { "$fracas" plan "$folder/my-bar.yaml" | grep ^warning; exit 1; }

commands=$(sed -n 's/^    tools\/fracas \([a-z]*\) .*/\1/p' README.md | sort -u | grep -vx -e test -e help)
for command in $commands; do
    "$fracas" help "$command" >/dev/null
done
[ "$(echo "$commands" | wc -l)" -ge 5 ]

# The anchors of page $1, one for each heading.
anchors() { sed -n 's/^##* //p' "$1" | tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9_ -]//g; s/ /-/g'; }

# page: link
find . \( -name build -o -name .git -o -name studies \) -prune -o -name '*.md' -print | while read -r page; do
    { grep -o '](\([^)#:]*\)[)#]' "$page" || :; } | sed 's/^](//; s/[)#]$//' | while read -r link; do
        [ -z "$link" ] || [ -e "$(dirname "$page")/$link" ] || echo "$page: no $link"
    done
    { grep -o ']([^):]*#[^)]*)' "$page" || :; } | sed 's/^](//; s/)$//' | while IFS='#' read -r link anchor; do
        target=$page
        [ -z "$link" ] || target=$(dirname "$page")/$link
        anchors "$target" | grep -qx -- "$anchor" || echo "$page: no $link#$anchor"
    done
done >"$folder/dead"
if [ -s "$folder/dead" ]; then
    cat "$folder/dead"
    exit 1
fi
