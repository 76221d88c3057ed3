# A study keeps the files that its campaign names: it goes on, grows and is verified when the originals are gone or changed.
. tests/support/campaigns.sh

# strengths SEED: 500 of them, as another program would write them.
strengths()
{
    echo '# interface, strength (Pa)'
    echo 'interface, strength'
    awk -v x="$1" 'BEGIN {for (i = 0; i < 500; i++) {x = (x*75 + 74) % 65537; printf "%d, %.9e\n", i, 299e6 + 2e6*x/65537}}'
}

# attached FILE STRENGTHS REPLICAS RATES
attached()
{
    campaign "$1" "$3" "$4"
    sed "s|^strength: .*|strength: {distribution: file, file: $2}|" "$1" > "$1.new"
    mv "$1.new" "$1"
}

mkdir given
strengths 1 > given/one.csv
strengths 2 > given/two.csv
attached first.yaml given/one.csv 1 '1e5 1/s'
expect 0 "$fracas" run --no-report first.yaml --study study
digest=$(ls study/attachments)
cmp given/one.csv "study/attachments/$digest" || fail "the copy is not the file"
grep -q "file: attachments/$digest\$" study/campaign.yaml || fail "campaign.yaml does not name the copy"
expect 0 "$fracas" verify --full study

# Every interface has the strength of its line.
h5dump -d /interface/strength -y -w 1 -m %.9e study/study.h5 | sed -n 's/^ *\([0-9][0-9.e+]*\),*$/\1/p' > used
tail -n +3 given/one.csv | sed 's/.*, //' | cmp - used || fail "the strengths are not those of the file"

# Moved and renamed, with the same content: the same points.
mv given moved
mv moved/one.csv moved/uno.csv
attached renamed.yaml moved/uno.csv 1 '1e5 1/s'
expect 0 "$fracas" run --no-report renamed.yaml --study study
said 'complete'

# Gone: another file of its name is another point; the study's own campaign file makes it whole, and extends it.
mkdir given
cp moved/two.csv given/one.csv
expect 5 "$fracas" run first.yaml --study study
said "strength.file is $digest in the study"
rm given/one.csv
expect 2 "$fracas" run first.yaml --study study
said 'first.yaml:.*`file`: cannot open given/one.csv: No such file'
cp study/study.h5 kept.h5
rm study/segments/*.h5
expect 0 "$fracas" run --no-report study/campaign.yaml --study study
cmp kept.h5 study/study.h5 || fail "computed again, it differs"
sed 's/rate: 1.*/rate: 50000/' study/campaign.yaml > study/extended.yaml
cmp -s study/extended.yaml study/campaign.yaml && fail "nothing was changed"
expect 5 "$fracas" run study/extended.yaml --study study
{ sed '/^  rate:/d' study/campaign.yaml; echo 'sweep:'; echo '  - loading.rate: [1e5, 2e5]'; } > study/extended.yaml
expect 0 "$fracas" run --no-report study/extended.yaml --study study
expect 0 "$fracas" verify --full study
attached both.yaml moved/uno.csv 1 '1e5 1/s, 2e5 1/s'
mkdir -p fresh/attachments # another file is in the place of the copy
tr 0 1 < moved/uno.csv > "fresh/attachments/$digest"
expect 0 "$fracas" run --no-report both.yaml --study fresh
same study fresh
cmp moved/uno.csv "fresh/attachments/$digest" || fail "another file was taken for the copy"
mkdir -p piped/attachments # pipes: whoever opens one waits
mkfifo "piped/attachments/$digest" "piped/attachments/$digest.tmp" piped/campaign.yaml.tmp
expect 0 timeout 300 "$fracas" run --no-report both.yaml --study piped
same study piped
cmp moved/uno.csv "piped/attachments/$digest" || fail "a pipe was left in the place of the copy"

# Two files, as a sweep.
attached sweep.yaml moved/uno.csv 1 '1e5 1/s'
sed 's|loading.rate: .*|strength.file: [moved/uno.csv, moved/two.csv, "'"$work"'/moved/uno.csv"]|' sweep.yaml > thrice.yaml
expect 2 "$fracas" plan thrice.yaml
said 'points 1 and 3 of the sweep have the same values'
sed 's|loading.rate: .*|strength.file: [moved/uno.csv, moved/two.csv]|' sweep.yaml > twice.yaml
expect 0 "$fracas" run --no-report twice.yaml --study two
[ "$(ls two/attachments | wc -l)" -eq 2 ] || fail "not two copies"
rm moved/two.csv
expect 0 "$fracas" run --no-report two/campaign.yaml --study two
said 'complete'

# A copy that is damaged or lost is named; put back, all is well.
cp "study/attachments/$digest" copy
sed '$s/..$/00/' copy > "study/attachments/$digest"
expect 5 "$fracas" verify study
said "attachments/$digest is damaged"
expect 5 "$fracas" run both.yaml --study study
rm "study/attachments/$digest"
expect 5 "$fracas" verify study
said "cannot open study/attachments/$digest"
cp copy "study/attachments/$digest"
expect 0 "$fracas" gc study # which leaves what the campaign names
expect 0 "$fracas" verify --full study

# Too few strengths: told by plan and by run, before anything is written. Several replicas: told to be equal.
sed '$d' copy > moved/uno.csv
expect 2 "$fracas" plan both.yaml
said 'moved/uno.csv has 499 strengths, but the mesh has 500 interfaces'
expect 2 "$fracas" run both.yaml --study short
said 'moved/uno.csv has 499 strengths, but the mesh has 500 interfaces'
[ ! -e short ] || fail "a wrong campaign left something behind"
cp copy moved/uno.csv
attached many.yaml moved/uno.csv 3 '1e5 1/s'
expect 0 "$fracas" plan many.yaml
said 'point 0: its strengths are those of a file, so all its 3 replicas are equal'
expect 0 "$fracas" plan both.yaml
! grep -q 'warning' said || { cat said >&2; fail "a warning for nothing"; }
