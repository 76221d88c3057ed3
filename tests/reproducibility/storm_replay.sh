# ctest-labels: storm
# ctest-timeout: 7200
# Twenty realizations of a small version of every example campaign, computed again, have the bytes of the study.
. tests/support/campaigns.sh
. "$source/tests/support/replayed.sh"

for file in "$small"/*.yaml; do
    name=$(basename "$file" .yaml)
    [ -f "$source/campaigns/examples/$name.yaml" ] || continue
    expect 0 "$fracas" run "$file" --study "$name" --jobs 2
    replayed "$name" 20
done
