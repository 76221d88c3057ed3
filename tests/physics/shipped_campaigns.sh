# ctest-labels: storm
# ctest-serial
# ctest-timeout: 7200
# Every shipped campaign as it is, but for sphere-paper.yaml, which takes an hour of a core: each realization ends well, and none has
# lost its energy balance but where the campaign is there to show it.
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
    s, drifts = p["statistics"], 0
    # Stershic's step of 0.8 h/c loses its balance in one realization of seven: docs/results/ring.md
    if sys.argv[1] == "ring-variants" and p["label"].startswith(("case stershic,", "case stershic-xi-0.1,")):
        drifts = p["outcomes"]["ENERGY_DRIFT"]
    assert s["usable"] + drifts == s["realizations"] > 2 * drifts, p
print(sys.argv[1], "residual up to", max(p["statistics"]["residual"] for p in study["points"]), "of the dissipated energy")
END
done
