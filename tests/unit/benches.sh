# Benchmarks, whose figures the results pages give, still run: each of them, for as short as it can, gives numbers greater than 0.
set -eu
build=$1

# gives NUMBERS COMMAND...: ends well, and prints a line with so many positive numbers after its first word.
gives()
{
    numbers=$1
    shift
    said=$("$@") || { echo "failed: $*"; exit 1; }
    echo "$said" | awk -v want="$numbers" '{n = 0; for (i = 2; i <= NF; i++) if ($i + 0 > 0) n++; if (n >= want) good = 1} END {exit !good}' ||
        { echo "no $numbers numbers from $*: $said"; exit 1; }
}

for distribution in constant uniform normal lognormal gamma weibull flaws; do
    gives 3 "$build/bench_sampler" --distribution $distribution --seconds 0.001
done
for model in bar ring stershic linear quadratic shell; do
    gives 3 "$build/bench_sweep" --model $model --elements 200 --seconds 0.001
done
[ "$(printf '\n\n' | "$build/bench_sweep" --elements 200 --turns 2 | wc -l)" = 4 ] || { echo "bench_sweep takes no turns"; exit 1; }
gives 4 "$build/bench_field" 60 2
gives 8 "$build/bench_cluster" workers=2 work=10 task=0.1
[ "$("$build/bench_stream" neighbours | head -c 4096 | wc -c)" = 4096 ] || { echo "bench_stream gives no bits"; exit 1; }
# `fracas bench`: each body, with its operations, bytes and shares; a case that is measured beside its own speed has lost nothing.
"$build/fracas" bench kernels --only /400/baseline-1/ --repeats 1 --json > "${TMPDIR:-/tmp}/kernels.$$"
python3 - "${TMPDIR:-/tmp}/kernels.$$" <<'END' || { echo "fracas bench kernels gives no figures"; exit 1; }
import json, sys
cases = json.load(open(sys.argv[1]))["cases"]
assert len(cases) == 12, len(cases)
for case in cases:
    spread = case["element_steps_per_second"]
    assert 0 < spread["low"] <= spread["median"] <= spread["high"], case
    assert case["bytes"] > 0 and 0 < case["share_of_multiply_add"] < 1 and 0 <= case["share_of_divider"] < 1.1, case
END
rm "${TMPDIR:-/tmp}/kernels.$$"
