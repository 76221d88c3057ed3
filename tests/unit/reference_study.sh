# The tables that `fracas reference --study` prints are those of docs/formats/study.md, between the same markers.
set -eu
printed=$(mktemp)
trap 'rm -f "$printed"' EXIT
"$1/fracas" reference --study > "$printed"
/usr/bin/python3 - "$printed" docs/formats/study.md <<'EOF'
import re, sys
blocks = [re.findall(r"<!-- generated: (\w+) -->\n(.*?)<!-- end of generated -->\n", open(name).read(), re.S) for name in sys.argv[1:3]]
printed, page = map(dict, blocks)
assert sorted(printed) == ["datasets", "derived", "index"], printed
assert sorted(page) == sorted(printed), "docs/formats/study.md lacks a table or its markers"
for name, wanted in printed.items():
    found = page[name]
    for says, must in zip(found.splitlines(), wanted.splitlines()):
        assert says == must, "docs/formats/study.md must say\n%s\nnot\n%s" % (must, says)
    assert found == wanted, "docs/formats/study.md: the table `%s` has another number of lines" % name
EOF
