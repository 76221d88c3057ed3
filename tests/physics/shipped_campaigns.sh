# ctest-labels: storm
# ctest-serial
# ctest-timeout: 7200
# Every shipped campaign as it is, but for sphere-paper.yaml, which takes an hour of a core: each realization ends well, and none has
# lost its energy balance.
. tests/support/campaigns.sh

for file in "$source"/campaigns/examples/*.yaml; do
    name=$(basename "$file" .yaml)
    [ "$name" = sphere-paper ] && continue
    expect 0 "$fracas" run "$file" --study "$name"
    "$fracas" report "$name" --json > report.json
    /usr/bin/python3 - "$name" <<'END'
import json, sys
study = json.load(open("report.json"))
for p in study["points"]:
    assert p["statistics"]["usable"] == p["statistics"]["realizations"] > 0, p
assert not any("drift" in w for w in study["warnings"]), study["warnings"]
print(sys.argv[1], "residual up to", max(p["statistics"]["residual"] for p in study["points"]), "of the dissipated energy")
END
done
