# The tables that `fracas reference --study` prints are those of docs/formats/study.md, between the same markers.
set -eu
printed=$(mktemp)
trap 'rm -f "$printed"' EXIT
"$1/fracas" reference --study > "$printed"
/usr/bin/python3 - "$printed" docs/formats/study.md <<'EOF'
import re, sys
blocks = [re.findall(r"<!-- (\w+) -->\n(.*?)<!-- end of \1 -->\n", open(name).read(), re.S) for name in sys.argv[1:3]]
assert [name for name, _ in blocks[0]] == ["datasets", "index"], blocks[0]
assert [name for name, _ in blocks[1]] == ["datasets", "index"], "docs/formats/study.md lacks a table or its markers"
for (name, wanted), (_, found) in zip(*blocks):
    for says, must in zip(found.splitlines(), wanted.splitlines()):
        assert says == must, "docs/formats/study.md must say\n%s\nnot\n%s" % (must, says)
    assert found == wanted, "docs/formats/study.md: the table `%s` has another number of lines" % name
EOF
