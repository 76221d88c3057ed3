# ctest-labels: ci
# docs/tutorial.md keeps its word: its commands, typed one by one, say what it shows, and its pictures are those of its studies.
. tests/support/campaigns.sh

mkdir bin
ln -s "$fracas" bin/fracas
PATH=$work/bin:$PATH
/usr/bin/python3 "$source/tests/support/check_tutorial.py" "$source/docs/tutorial.md" || fail "the tutorial"

# The marks of a figure, with their numbers; and the lines of a picture.
titles()
{
    grep -o '<title>[^<]*' "$1" || fail "$1 has no marks"
}
report=studies/sizes/report
expect 0 "$fracas" report studies/sizes # the page's last report was drawn against the modulus
plate=studies/my-membrane/pictures/surface-point-0-replica-0-6.svg
[ "$(titles $report/size-against-rate.svg)" = "$(titles "$source/docs/tutorial-sizes.svg")" ] ||
    fail "$report/size-against-rate.svg is not docs/tutorial-sizes.svg"
cmp $plate "$source/docs/tutorial-plate.svg" || fail "$plate is not docs/tutorial-plate.svg"

# A page that shows another number, a line too many or too few is found.
wrong()
{
    sed "$1" "$source/docs/tutorial.md" | sed '/^## A first run/,/^## Your/d; /^## Run and read/,$d' > wrong.md
    rm -rf studies
    ! /usr/bin/python3 "$source/tests/support/check_tutorial.py" wrong.md > said 2>&1 || fail "it believes $1"
    grep -q "it did not say: $2" said || { cat said; fail "it does not see $1"; }
}
wrong 's/6 points, 48 real/6 points, 49 real/' 'Campaign sizes: 6 points, 49'
wrong '/^point  loading.rate/d' '1\/s s at most'
