# ctest-labels: ci
# `fracas init` writes a campaign file for each model that runs in seconds and breaks; the keys that it leaves as comments are keys, too.
. tests/support/campaigns.sh

expect 2 "$fracas" init rim
said 'did you mean `ring`'
for model in bar ring membrane shell; do
    "$fracas" init $model > $model.yaml
    expect 0 timeout 120 "$fracas" run --no-report $model.yaml --study $model
    /usr/bin/python3 - $model <<'PYTHON' || fail "$model does not break in pieces"
import sys
import h5py
counts = h5py.File(sys.argv[1] + "/study.h5")["realization/fragments"][()]
print(sys.argv[1], counts)
assert len(counts) == 4 and (counts > 3).all()
PYTHON
    case $model in
    membrane | shell) expect 0 "$fracas" picture $model ;;
    esac
    # Keys that it leaves as comments are keys: given their defaults, the campaign is read.
    # The sections notch and initial have no defaults, and stay comments.
    sed '/^# notch:$/d; /^# initial:$/d; s/^  # \([a-z_0-9]*: [^. ]\)/  \1/; /^# sweep/d; s/^# \([a-z]*:\)$/\1/; /^ *# /d; s/ size: 0 / size: 1e-3 /' $model.yaml |
        grep -vE '^  (size|critical_opening): ' > spelled.yaml
    grep -c ':' spelled.yaml > many
    [ "$(cat many)" -gt 30 ] || fail "few keys"
    expect 0 "$fracas" plan --quick spelled.yaml
done
