#!/bin/sh
# ctest-labels: ci
# tools/site: the pages become a site without a dead link, with their code, tables, lists and search; a planted fault ends it.
set -eu

if ! command -v mkdocs > /dev/null || [ ! -d /usr/share/mkdocs/themes/material ]; then
    echo "skipped: not installed: mkdocs or mkdocs-material"
    exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail()
{
    cat "$work/said"
    echo "FAILED: $*"
    exit 1
}

tools/site "$work/site" > "$work/said" 2>&1 || fail "tools/site"
/usr/bin/python3 - "$work/site/html" <<'PYTHON' || fail "the site"
import json
import os
import re
import sys

top = sys.argv[1]
read = lambda path: open(os.path.join(top, path), encoding="utf-8").read()
index = json.loads(read("search/search_index.json"))["docs"]
assert any("Mott" in page["text"] for page in index) and len(index) > 300
assert re.search(r"<code>(<a[^>]*></a>|<span></span>)*U = A \[ sum over elements", read("docs/theory/bar.html"))  # an equation
assert re.search(r'<td[^>]*><code>weibull</code>, by <code>mean</code>', read("docs/how-to/choose-a-strength.html"))  # a table
assert '<span class="nt">geometry</span>' in read("docs/formats/campaign-file.html")  # YAML in colours
assert read("docs/formats/study.html").count("<ol ") == 2  # a list with a list in it is one; the other is the search's
for folder, _, files in os.walk(top):
    for file in (os.path.join(folder, name) for name in files if name.endswith(".html")):
        text = re.sub(r"<(pre|code)\b.*?</\1>", "", read(file), flags=re.S)
        for mark in ("|---", "```", "<p>|", "<p>- ", "\n- "):  # as in the pages
            assert mark not in text, (file, mark)
        assert not re.search(r"\n\d\. ", text), file
        for source in re.findall(r'<(?:script|img|link)[^>]* (?:src|href)="(https?:[^"]*)', text):
            assert "rel=\"canonical\"" in text, (file, source)  # opens without a network
PYTHON

# A small tree: fine, then with each fault.
plant()
{
    rm -rf "$work/tree"
    mkdir -p "$work/tree/tools" "$work/tree/docs/how-to"
    cp tools/site tools/mkdocs.yml "$work/tree/tools"
    echo '# fracas' > "$work/tree/README.md"
    printf '# Pages\n\n| you want to | read |\n|---|---|\n| go | [there](how-to/go.md) |\n' > "$work/tree/docs/README.md"
    printf '# Go\n\n[Home](../../README.md), [below](#last)\n\n## Last\n' > "$work/tree/docs/how-to/go.md"
    eval "$1"
    status=0
    "$work/tree/tools/site" > "$work/said" 2>&1 || status=$?
    if [ -z "$2" ]; then
        [ $status = 0 ] && [ -s "$work/tree/build/site/html/docs/how-to/go.html" ] || fail "a small tree"
    else
        [ $status = 1 ] && grep -q "$2" "$work/said" || fail "status $status; it should have said $2"
    fi
}
plant : ''
plant 'echo "[a](b.md)" >> "$work/tree/docs/how-to/go.md"' 'b.md'
plant 'echo "[a](#nowhere)" >> "$work/tree/docs/how-to/go.md"' 'no place #nowhere'
plant 'echo "[a](go.csv)" >> "$work/tree/docs/how-to/go.md"' 'go.csv'
plant 'echo "[a](../how-to/)" >> "$work/tree/docs/how-to/go.md"' 'no ../how-to/'
plant 'echo "# Lost" > "$work/tree/docs/how-to/lost.md"' 'not in the table of docs/README.md: docs/how-to/lost.md'
