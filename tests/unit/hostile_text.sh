#!/bin/sh
# Control characters, and bytes outside UTF-8, of files and folder names: escaped wherever it is printed, and JSON stays JSON.
. tests/support/campaigns.sh

awkward=$(printf '\342\200\256') folder=$(printf 'st\377udy')

# clean FILE: neither ESC nor C1 nor a direction nor a byte outside UTF-8.
clean()
{
    python3 - "$1" <<'END_OF_PYTHON' || fail "$1 drives a terminal"
import sys
text = open(sys.argv[1], "rb").read().decode()
assert not [c for c in text if (c < " " and c != "\n") or "\x7f" <= c < "\xa0" or "\u202a" <= c <= "\u202e"], text
END_OF_PYTHON
}

campaign small.yaml 2 '1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study "$folder"
sqlite3 "$folder/index.sqlite" "UPDATE realization SET status = 'failed', attempts = 3, segment = NULL, row = NULL,
    reason = char(27) || '[2J' || char(0x9b) || char(0x202e) || 'because' WHERE replica = 1"

"$fracas" status "$folder" > status.txt
clean status.txt
grep -qF '\x1b[2J\xc2\x9b\xe2\x80\xaebecause' status.txt || fail "the reason is not there: $(cat status.txt)"
grep -qF 'study         st\xffudy of campaign small' status.txt || fail "the study is not there: $(cat status.txt)"
for command in status report; do
    "$fracas" $command "$folder" --json > $command.json 2>said || fail "$command: $(cat said)"
    clean $command.json
    clean said
    python3 -c 'import json, sys; assert json.load(open(sys.argv[1], encoding="utf-8"))["study" if sys.argv[1] == "status.json" else "name"] == r"st\xffudy"' $command.json ||
        fail "$command --json"
done
python3 -c 'import json; assert json.load(open("status.json"))["failures"][0]["reason"] == "\x1b[2J\x9b\u202ebecause"' ||
    fail "JSON does not keep the reason"

sed "s/^model: bar/model: b$awkward/" small.yaml > escapes.yaml
expect 2 "$fracas" plan escapes.yaml
clean said
said 'b.xe2.x80.xae'
