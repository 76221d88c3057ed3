# ctest-sanitize
# `fracas export`: a package that code without ours finds to be what the standard and study.h5 say; its bytes; its folders; what is planted.
. tests/support/campaigns.sh

/usr/bin/python3 -c 'import h5py' 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 0; }

check()
{
    /usr/bin/python3 "$source/tests/support/check_export.py" "$@"
}

campaign one.yaml 3 '2e4, 1e5'
expect 0 "$fracas" run one.yaml --study one --jobs 2

expect 0 "$fracas" export one --histories
said 'export: one/export/datapackage.json'
check one
cp -r one/export first

# Equal bytes of an equal study.h5, whatever its folder is called; nothing of the package of before stays.
mkdir other
cp one/study.h5 one/campaign.yaml other
expect 0 "$fracas" export other --histories
diff -r one/export other/export
expect 0 "$fracas" export other
[ ! -e other/export/histories.csv ] || fail "the histories of the package of before"
check other
for name in points realizations fragments statistics energies convergence; do cmp one/export/$name.csv other/export/$name.csv; done
for name in points fragments energies convergence; do cmp one/export/$name.csv one/report/$name.csv; done
"$fracas" report one --json > summary.json
cmp summary.json one/report/summary.json

# Folders.
expect 0 "$fracas" export one --to elsewhere
check one elsewhere
touch file
expect 2 "$fracas" export one --to file
said 'file is no folder; move it away or name another'
expect 6 "$fracas" export one --to none/there
said 'cannot make the folder none/there'
mkdir others others/points.csv
expect 2 "$fracas" export one --to others
said 'others/points.csv is there already, and is of no report or export of fracas'
expect 0 "$fracas" export one --to taken
rm taken/points.csv
mkdir taken/points.csv
expect 6 "$fracas" export one --to taken
said 'cannot rename .* to taken/points.csv'
[ ! -e taken/datapackage.json ] || fail "a package that is not whole"
[ -z "$(ls -A taken | grep '^\.')" ] || fail "temporary files are left"
limited()
{
    trap '' XFSZ
    ulimit -f $1 # of 512 bytes
    "$fracas" export $2 --to "${3:-small}"
}
campaign few.yaml 1 1e4
expect 0 "$fracas" run few.yaml --study few
expect 6 limited 160 few # all tables fit, the package has 90 kB
said 'cannot write small/datapackage.json'
[ -z "$(ls -A small)" ] || fail "tables without a package, which the next export takes for somebody's"
cp -r few/report paged # a page tells that tables are ours: they stay
expect 6 limited 160 few paged
[ -e paged/points.csv ] || fail "a table of the report is gone"
expect 0 "$fracas" export few --to paged
expect 6 limited 80 one # as little as SQLite needs beside the index; fragments.csv does not fit
said 'cannot write small/fragments.csv'
[ ! -e small/datapackage.json ] || fail "a package that is not whole"
[ -z "$(ls -A small | grep '^\.')" ] || fail "temporary files are left"
expect 0 "$fracas" export one --to small # as after a fault, so after a cut: no table is in the way
check one small
for command in "export one --histories" "report one --quiet"; do
    case $command in
    export*) to=--to first=.datapackage.json.4194305 ;;
    *) to=-o first=summary.json ;;
    esac
    rm -rf whole cut
    # shellcheck disable=SC2086
    expect 0 "$fracas" $command $to whole
    mkdir cut
    [ $to = --to ] && : > cut/$first || cp whole/$first cut
    cp whole/points.csv cut
    [ $to = -o ] || cp whole/histories.csv cut
    # shellcheck disable=SC2086
    expect 0 "$fracas" ${command%--histories} $to cut
    [ ! -e cut/histories.csv ] || fail "a table of the export that was cut off"
done
mkdir mine
echo mine > mine/points.csv
: > mine/.datapackage.json.swp
expect 2 "$fracas" export one --to mine
said 'mine/points.csv is there already'
mkdir own
touch own/histories.csv # somebody else's: there was no package
expect 0 "$fracas" export one --to own
[ -e own/histories.csv ] || fail "a file that was not of a package was removed"
cp -r other/export beside # a package without histories
echo mine > beside/histories.csv
expect 2 "$fracas" export other --to beside --histories
said 'beside/histories.csv is there already'
expect 0 "$fracas" export other --to beside
[ "$(cat beside/histories.csv)" = mine ] || fail "a file that the package does not name was removed"
expect 5 "$fracas" export file
said 'is no study'

# Faults that a package may not have, each found. seal: the package says that the files are as they are now.
seal()
{
    /usr/bin/python3 - planted <<'END'
import hashlib, json, os, sys
path = os.path.join(sys.argv[1], "datapackage.json")
package = json.load(open(path))
for resource in package["resources"]:
    content = open(os.path.join(sys.argv[1], resource["path"]), "rb").read()
    resource["bytes"], resource["hash"] = len(content), "sha256:" + hashlib.sha256(content).hexdigest()
json.dump(package, open(path, "w"))
END
}

# planted WORDS FILE SED: the edit is found, in these words.
planted()
{
    rm -rf planted
    cp -r first planted
    sed -i "$3" "planted/$2"
    ! cmp -s "first/$2" "planted/$2" || fail "no fault was planted in $2 by $3"
    if check one planted > said 2>&1; then fail "unnoticed, without a new digest: $2 $3"; fi
    seal
    if check one planted > said 2>&1; then fail "unnoticed: $2 $3"; fi
    said "$1"
}

planted 'column dissipated is' realizations.csv '2s/\(\([^,]*,\)\{16\}\)\([^,]*\)/\11\3/'
planted 'column size is' fragments.csv '3s/\(\([^,]*,\)\{5\}\)[^,]*/\10.001/'
planted 'is no number' histories.csv '4s/\(\([^,]*,\)\{4\}\)[^,]*/\1early/'
planted 'is none of' realizations.csv '2s/FRAGMENTED/BROKEN/'
planted 'a primary key twice' realizations.csv '3s/^0,1/0,0/'
planted 'points at no line of realizations' fragments.csv '2s/^0,0/0,9/'
planted 'has .* columns and not' fragments.csv '2s/$/,1/'
planted 'has the head' points.csv '1s/count.mean/count_mean/'
planted 'statistics line 2 is' statistics.csv '2s/,3,/,4,/'
planted 'statistics line' statistics.csv 's/,J$/,kJ/'
planted 'energies is not that of the report' energies.csv '3s/\(\([^,]*,\)\{4\}\)[^,]*/\10.001/'
planted 'points at no line of points' convergence.csv '2s/^0/9/'
planted 'lines and not' fragments.csv '$d'
planted 'a wrong unit' datapackage.json 's/kg m\/s/kg/'
planted 'foreign keys' datapackage.json 's/foreignKeys/foreignkeys/'
planted 'other missing values' datapackage.json 's/"missingValues"/"missingValues": ["NA"], "other"/'
planted 'comes from another study' datapackage.json 's/"seed": "7"/"seed": "8"/'
planted 'lacks name, type or description' datapackage.json 's/"type": "number"/"type": "real"/'
rm one/report/summary.json # so that what is planted is not found there
planted 'statistics line' points.csv '2s/,0,0,0$/,1,0,0/'
