# fracas compare on two small studies: points and their partners, numbers derived again from study.h5, pairs by common random numbers, statuses.
. tests/support/campaigns.sh

campaign a.yaml 8 "5e4 1/s, 1e5 1/s"
campaign b.yaml 10 "1e5 1/s, 2e5 1/s"
sed -i -e 's/seed: 7/seed: 8/' -e 's/299 MPa, maximum: 301/200 MPa, maximum: 400/' b.yaml
for which in a b; do expect 0 "$fracas" run $which.yaml --study $which; done

expect 0 "$fracas" compare a b
grep -q "1 in both, matched by loading.rate" said || fail "not matched by the rate: $(cat said)"
grep -q "they differ in strength.maximum 3.01e8 | 4e8, strength.minimum 2.99e8 | 2e8" said || fail "what differs: $(cat said)"
grep -q "only in A: point 0 (rate 5e4 1/s)" said && grep -q "only in B: point 1 (rate 2e5 1/s)" said || fail "points alone: $(cat said)"
expect 0 "$fracas" compare a b --json
cp said compared.json
/usr/bin/python3 - <<'PYTHON'
import json, math
import h5py, numpy as np
compared = json.load(open("compared.json"))
assert compared["a"]["unmatched"] == [0] and compared["b"]["unmatched"] == [1] and compared["matched_by"] == "loading.rate"
(point,) = compared["points"]
assert (point["point_a"], point["point_b"], point["paired"], point["exact"]) == (1, 0, False, False)
assert point["assignments"] == 10000


def read(study, p):
    with h5py.File(study + "/study.h5") as file:
        rows = np.flatnonzero(file["realization/point"][()] == p)
        offset, size = file["fragment/offset"][()], file["fragment/size"][()]
        return (file["realization/fragments"][()][rows].astype(float), file["realization/dissipated"][()][rows],
                [size[offset[i]:offset[i + 1]] for i in rows])


first, second = read("a", 1), read("b", 0)
for key, a, b in (("count", first[0], second[0]), ("dissipated", first[1], second[1])):
    value = point["values"][key]
    u, v = a.var(ddof=1) / len(a), b.var(ddof=1) / len(b)
    assert math.isclose(value["difference"], b.mean() - a.mean(), rel_tol=1e-9)
    assert math.isclose(value["relative"], b.mean() / a.mean() - 1, rel_tol=1e-9)
    assert math.isclose(value["freedom"], (u + v)**2 / (u**2 / (len(a) - 1) + v**2 / (len(b) - 1)), rel_tol=1e-9)
    # The same test with other random numbers: p to 4 standard deviations of 2000 permutations.
    both, random = np.concatenate((a, b)), np.random.default_rng(1)
    def statistic(x, y):
        return abs(x.mean() - y.mean()) / math.sqrt(x.var(ddof=1) / len(x) + y.var(ddof=1) / len(y))
    reached = 1
    for _ in range(2000):
        order = random.permutation(both)
        reached += statistic(order[:len(a)], order[len(a):]) >= statistic(a, b) * (1 - 1e-12)
    p = reached / 2001
    assert abs(p - value["p"]) < 4 * math.sqrt(max(p, 1e-3) / 2000) + 1e-3, (key, p, value["p"])
    print(key, value["difference"], value["p"], p)
sizes = [np.sort(np.concatenate(of[2])) for of in (first, second)]
cuts = np.unique(np.round(np.concatenate(sizes), 12))
share = [np.searchsorted(of, cuts * (1 + 1e-9), side="right") / len(of) for of in sizes]
assert math.isclose(point["size_distribution"]["distance"], np.abs(share[0] - share[1]).max(), rel_tol=1e-9)
assert point["size_distribution"]["p"] <= 0.05
PYTHON

# A study beside itself: the same random numbers, nothing differs.
expect 0 "$fracas" compare a a
grep -q "paired by replica" said && grep -q "count .* 0 +- 0 .* 1.0 .* 1.0" said || fail "not the same: $(cat said)"

# Common random numbers pair replicas of unlike points; without them they are independent.
sed -e 's/^seed: 7/seed: 7\nrandom_numbers: common/' -e 's/1e5 1\/s\]/1e5 1\/s]/' a.yaml > c.yaml
sed 's/beta: 4/beta: 5/' c.yaml > d.yaml
for which in c d; do expect 0 "$fracas" run $which.yaml --study $which; done
expect 0 "$fracas" compare c d
[ "$(grep -c 'paired by replica; p from all 256 assignments' said)" = 2 ] || fail "not paired: $(cat said)"
expect 0 "$fracas" compare a d
! grep -q "paired by replica" said || fail "paired though one study draws independent numbers"

# Points of one study are compared as those of two studies with one point each.
campaign low.yaml 8 "5e4 1/s"
campaign high.yaml 8 "1e5 1/s"
for which in low high; do expect 0 "$fracas" run $which.yaml --study $which; done
expect 0 "$fracas" compare low high --json --by model
cp said two.json
expect 0 "$fracas" compare a --points 0,1 --json
cp said one.json
expect 0 "$fracas" compare a --points 1,0:0,1 --json
/usr/bin/python3 - <<'PYTHON'
import json, math
two, one, both = (json.load(open(name)) for name in ("two.json", "one.json", "said"))
(expected,), (found,) = two["points"], one["points"]
assert one["listed"] == "0,1" and one["matched_by"] is None and one["a"]["name"] == one["b"]["name"] == "a" and one["a"]["unmatched"] == []
assert (found["point_a"], found["point_b"], found["paired"]) == (0, 1, False) and found["differs"] == "loading.rate 5e4 | 1e5"
assert found["values"] == expected["values"] and found["size_distribution"] == expected["size_distribution"]
assert [(point["point_a"], point["point_b"]) for point in both["points"]] == [(1, 0), (0, 1)]
back, there = (point["values"]["count"] for point in both["points"])
assert math.isclose(back["difference"], -there["difference"]) and there["difference"] == found["values"]["count"]["difference"]
assert there["p_holm"] >= there["p"]
PYTHON
expect 0 "$fracas" compare c --points 0,1
said "A and B: points 0,1 of c"
said "rate 5e4 1/s: point 0 of A and 1 of B, 8 and 8 realizations, paired by replica"
said "they differ in loading.rate 5e4 | 1e5"

# Statuses.
expect 5 "$fracas" compare a nowhere
expect 5 "$fracas" compare nowhere a
expect 2 "$fracas" compare a
expect 2 "$fracas" compare a b --points 0,1
said "one argument too many"
expect 2 "$fracas" compare a --points 0,1 --by model
expect 2 "$fracas" compare a --points 0
said "give two points or ranges as 3,17"
expect 2 "$fracas" compare a --points 0,1,0
expect 2 "$fracas" compare a --points 0,2
said "there is no point 2: the study has points 0 to 1"
expect 2 "$fracas" compare a --points 0-1,0
said "2 on one side and 1 on the other"
expect 2 "$fracas" compare a --points 0-1:0,0
said "point 0 would be compared with itself"
expect 2 "$fracas" compare a b --by loading.speed
grep -q "loading.speed: the first study has no such column" said || fail "$(cat said)"
expect 2 "$fracas" compare a b --by model
grep -q "are alike in model" said || fail "$(cat said)"
