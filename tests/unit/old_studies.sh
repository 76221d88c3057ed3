# Studies of format versions 3 to 5 are read by every command that only looks at a study, with a note that names what they have not:
# all other numbers are those of the same study in this version's format. No command goes on with one.
. tests/support/campaigns.sh

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }

campaign small.yaml 3 '1e5, 2e5'
sed -i 's,end: 300 ns\, quiet: 50,end: 900 ns\, quiet: 30,; s,history: 20,history: 400,' small.yaml # the rule ends them
expect 0 "$fracas" run small.yaml --study now --jobs 2

# age STUDY VERSION [FROM]: as that format version had it, without its index and segments, and with a campaign file that this version refuses.
age()
{
    cp -r "${3:-now}" "$1"
    rm -r "$1"/segments "$1"/index.sqlite* "$1"/report
    /usr/bin/python3 - "$1/study.h5" "$2" <<'END'
import h5py, sys
study, version = h5py.File(sys.argv[1], "r+"), int(sys.argv[2])
study.attrs.modify("format_version", version)
del study["campaign"], study["point/derived.strength_deviation"]
study["point"].attrs.modify("columns", study["point"].attrs["columns"] - 1)
later = {5: ["fragment/volume", "fragment/extent", "fragment/crack_area"] + ["fragment/%s_%d" % (kind, i) for kind in ("axis", "semi_axis") for i in (1, 2, 3)],
         4: ["realization/" + key for key in "damped vibrating transits growth rest rest_variance rest_bound fragments_held".split()] + ["history/damped"]}
for since, columns in later.items():
    for column in columns if version < since else []:
        del study[column]
END
    sed -i 's/law: nitsche/law: forgotten/' "$1/campaign.yaml"
}

expect 0 "$fracas" report now --json
mv said now.json
for version in 3 4 5; do
    old=of-$version
    age $old $version
    expect 0 "$fracas" report $old --json
    mv said $old.json
    /usr/bin/python3 - now.json $old.json $version <<'END'
import json, sys
now, old, version = json.load(open(sys.argv[1])), json.load(open(sys.argv[2])), int(sys.argv[3])
lost = {3: {"aspect", "final", "heated"}, 4: {"aspect"}, 5: set()}[version]
found = set()
for a, b in zip(now["points"], old["points"], strict=True):
    assert a["parameters"].pop("derived.strength_deviation") > 0
    assert a["parameters"] == b["parameters"] and a["statistics"].keys() == b["statistics"].keys()
    for key, value in a["statistics"].items():
        if b["statistics"][key] != value:
            found.add(key.split(".")[0])
            assert b["statistics"][key] in (None, 0), (key, value, b["statistics"][key]) # never another number
    for energies in (a["energies"], b["energies"]):
        energies["end"].pop("damped")
    assert a["energies"] == b["energies"]
assert found == lost, found
quiet = [w for w in old["warnings"] if w["kind"] == "quiet"]
for w in quiet: # k and growth from the history, beside those that the study had: two digits, and times that are up to 9 % early
    words = w["text"].split(" after ")[1].split()
    final = now["points"][w["point"]]["statistics"]
    assert abs(float(words[0])/final["final.transits"] - 1) < 0.03 and words[1] == "transits", (w["text"], final["final.transits"])
    assert abs(float(words[12]) - 100*final["final.growth"]) < 1, (w["text"], final["final.growth"])
assert len(quiet) == (len(old["points"]) if version == 3 else 0) and not any(w["kind"] == "quiet" for w in now["warnings"]), quiet
notes = [w["text"] for w in old["warnings"] if "format version %d" % version in w["text"]]
lacking = {3: "fragments_held, damped, ", 4: "volume, ", 5: "strength_deviation, campaign: "}[version]
assert len(notes) == 1 and "which had no " + lacking in notes[0], old["warnings"]
END
    expect 0 "$fracas" report $old
    said "format version $version, which had no"
    expect 0 "$fracas" report $old --y dissipated,aspect --quiet
    expect 0 "$fracas" export $old
    cut -d, -f1-9 $old/export/realizations.csv > columns
    expect 0 "$fracas" export now
    cut -d, -f1-9 now/export/realizations.csv | cmp - columns || fail "a realization is another in $old"
    expect 0 "$fracas" picture $old
    expect 0 "$fracas" compare now $old
    said 'count .* 0 +- 0'
    expect 0 "$fracas" verify $old
    said "$old is sound"
    said "format version $version: index and segments are not looked at"
    cp $old/study.h5 kept.h5
    for command in "run $old/campaign.yaml --study $old" "retry $old --failed" "merge $old" "reindex $old" "replay $old 0/0" "status $old"; do
        status=0
        # shellcheck disable=SC2086
        "$fracas" $command > said 2>&1 || status=$?
        case $status in 2 | 5) ;; *) cat said >&2; fail "status $status: $command" ;; esac
    done
    cmp kept.h5 $old/study.h5 || fail "$old was changed"
done

# A history of three rows does not tell how much came in the last half of the time.
sed 's/history: 400/history: 0/' small.yaml > coarse.yaml
expect 0 "$fracas" run coarse.yaml --study coarse --jobs 2
age of-3-coarse 3 coarse
expect 0 "$fracas" report of-3-coarse
said 'ended realizations after 2[67] transits of a mean fragment, and the study'

# A damaged one is found, one too old or too new is refused.
/usr/bin/python3 - of-4/study.h5 <<'END'
import h5py, sys
with h5py.File(sys.argv[1], "r") as study:
    at = study["fragment/mass"].id.get_chunk_info(0).byte_offset
with open(sys.argv[1], "r+b") as file:
    file.seek(at + 5)
    byte = file.read(1)
    file.seek(at + 5)
    file.write(bytes([byte[0] ^ 1]))
END
expect 5 "$fracas" verify of-4
said '/fragment/mass'
for version in 2 7; do
    /usr/bin/python3 -c 'import h5py, sys; h5py.File(sys.argv[1], "r+").attrs.modify("format_version", int(sys.argv[2]))' of-3/study.h5 $version
    rm -rf of-3/report
    expect 5 "$fracas" report of-3
done
# A study.h5 alone is looked at like a study, by its folder or by its name; nothing goes on with it.
mkdir alone
cp now/study.h5 alone
for name in alone alone/study.h5; do
    expect 0 "$fracas" report $name --json
    grep -v '^  "name":' said > alone.json
    grep -v '^  "name":' now.json | cmp - alone.json || fail "the numbers of $name differ"
    expect 0 "$fracas" verify $name
    said 'there is no campaign.yaml: study.h5 is read as it is'
    expect 0 "$fracas" export $name --to tables
    cmp tables/fragments.csv now/export/fragments.csv
    expect 0 "$fracas" picture $name
    expect 0 "$fracas" compare now $name
    said 'count .* 0 +- 0'
    expect 0 "$fracas" compare $name now
done
# Files beside it that no fracas wrote are the user's.
for file in report/points.csv export/points.csv fits.csv; do
    mkdir -p mine/report mine/export
    cp now/study.h5 mine
    echo mine > mine/$file
    case $file in
    report/*) command='report mine' ;;
    export/*) command='export mine' ;;
    *) command='fit mine --point 0 --resamples 99' ;;
    esac
    # shellcheck disable=SC2086
    expect 2 "$fracas" $command
    [ "$(cat mine/$file)" = mine ] || fail "$file of a user was replaced"
    rm -r mine
done
(cd alone && expect 0 "$fracas" report study.h5 --quiet)
expect 5 "$fracas" status alone
said 'alone has study.h5 alone, to look at by report'
cp now/study.h5 other.h5
expect 5 "$fracas" report other.h5
said 'other.h5 is no study: name .* its file study.h5, which must have that name'
echo "versions 3 to 5 read, damage found"
