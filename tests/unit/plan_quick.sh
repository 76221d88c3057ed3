#!/bin/sh
# What `plan` says of a large mesh before it is done with it, and how it estimates one.
. tests/support/campaigns.sh

paper=$source/campaigns/examples/sphere-paper.yaml # its critical steps take minutes
status=0
timeout 2 "$fracas" plan "$paper" > out 2> said || status=$?
[ $status -eq 124 ] || fail "status $status: it was to be stopped"
said '^fracas: point 0 of 5 is looked at; .*--quick'

expect 0 "$fracas" plan "$paper" --quick
said '^ *0  *1e4 .* 145161 '
said '^Estimated (--quick) from meshes of 64 divisions: .* of 5 points'

# An estimate beside the figures themselves: as many elements, and steps to a tenth, of thick shells on meshes 2.5 times as fine to a
# third.
for mesh in '66 0.01 0.9' '160 0.1 0.75'; do
    # shellcheck disable=SC2086 # three words
    set -- $mesh
    sed "/^sweep/,/^ .*peak-1e4/d; s/expansion/&, rate: 1e4/; s/safety/stop: time, end: 9 ns, &/; s/divisions: 381/divisions: $1/; s/0.1 mm/$2 mm/" \
        "$paper" > smaller.yaml
    "$fracas" plan smaller.yaml --quick --json > quick.json
    "$fracas" plan smaller.yaml --json > whole.json
    python3 - "$3" <<'END' || fail "the estimate is far off"
import json, sys
quick, whole = (json.load(open(name)) for name in ("quick.json", "whole.json"))
(a,), (b,) = quick["point"], whole["point"]
assert a["estimated"] and not b["estimated"] and not quick["warnings"] and abs(a["elements"] - b["elements"]) <= 1, (a, b)
assert float(sys.argv[1]) < a["time_step"] / b["time_step"] < 1 / float(sys.argv[1]), (a, b)
END
done

# Where cases stand for many parameters the table has the cases; one of law alone keeps its column.
expect 0 "$fracas" plan "$source/docs/examples/softening.yaml" --quick
said '^point  *case  *cohesive.cut  *cohesive.law  *replicas'
said '^ *11  *ring-fine  *0.01  *exponential  *8 '
said '^Cases stand for 42 more of the parameters'
expect 0 "$fracas" plan "$source/docs/examples/mott.yaml" --quick
said '^point  *case  *loading.rate  *time.end  *replicas'
