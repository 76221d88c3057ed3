"""Summaries of the shipped ring campaigns, and their common properties."""
import json

def read(name, residual):
    study = json.load(open(name + ".json"))
    for p in study["points"]:
        s = p["statistics"]
        assert s["usable"] == s["realizations"], (name, p)       # no ENERGY_DRIFT, nothing failed
        assert s["residual"] < residual(p["parameters"]), (name, p)
    assert not any("drift" in w for w in study["warnings"]), study["warnings"]
    return study

# Ends are onset + 40 transits, estimated from other replicas and bodies; 4 mm at 5e3 /s, with the fewest fragments, has 36 of them.
def final(study):
    for p in study["points"]:
        s = p["statistics"]
        assert 30 < s["final.transits"] < 60 and s["final.growth"] < 0.03 and s["final.rest"] < 0.03 * s["count.mean"], p
    assert not any(w["kind"] in ("final", "creep") for w in study["warnings"]), study["warnings"]
    return study
