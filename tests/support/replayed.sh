# For tests of `fracas replay`; sourced after campaigns.sh. $small: small versions of every example campaign.
small=$work/small
/usr/bin/python3 "$source/tools/small-campaigns" "$small"

# replayed STUDY COUNT: that many of its realizations, chosen by chance, are the same.
replayed()
{
    /usr/bin/python3 - "$1" "$2" > chosen <<'PY'
import random, sys, h5py
with h5py.File(sys.argv[1] + "/study.h5") as study:
    rows = list(zip(study["realization/point"][:], study["realization/replica"][:]))
for point, replica in random.Random(21).sample(rows, min(int(sys.argv[2]), len(rows))):
    print(f"{point}/{replica}")
PY
    [ -s chosen ] || fail "no realization in $1"
    while read -r one; do
        expect 0 "$fracas" replay "$1" "$one"
        said "$1 $one: computed again, the same bytes"
    done < chosen
}
