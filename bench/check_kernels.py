#!/usr/bin/python3
"""Speed of the kernels beside bench/kernel-ratios.json: has one lost more than 10 % against the multiply-add loop?

    bench/check_kernels.py PROGRAM           status 1, with a line for each, where one has; 0 for a CPU without figures
    bench/check_kernels.py PROGRAM --write   makes this machine's figures those to hold

PROGRAM is a fracas. Medians of 9; what has lost is measured again, since other work on the machine can look like a loss.
"""
import json
import os
import subprocess
import sys

LOSS = 0.1
FILE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "kernel-ratios.json")


def measure(program, *options):
    """The CPU, and the ratio of each case."""
    said = json.loads(subprocess.run([program, "bench", "kernels", "--json", *options], check=True, stdout=subprocess.PIPE).stdout)
    return said["cpu"], {case["name"]: case["per_multiply_add"]["median"] for case in said["cases"]}


def main():
    program = sys.argv[1]
    with open(FILE, encoding="utf-8") as file:
        known = json.load(file)
    cpu, ratios = measure(program)
    if "--write" in sys.argv[2:]:
        known[cpu] = {name: float(f"{ratio:.3g}") for name, ratio in ratios.items()}
        with open(FILE, "w", encoding="utf-8") as file:
            json.dump(known, file, indent=1)
            file.write("\n")
        return 0
    if cpu not in known:
        print(f"check_kernels: no figures of {cpu}; make them with --write")
        return 0
    lost = 0
    for name, then in known[cpu].items():
        now = ratios.get(name, 0)
        for _ in range(2):
            if now < (1 - LOSS) * then:
                now = max(now, measure(program, "--only", name)[1].get(name, 0))
        if now < (1 - LOSS) * then:
            lost += 1
            print(f"check_kernels: {name} has {now / then:.2f} of its speed beside the multiply-add loop; "
                  "find the cause, or make the new figures those to hold with --write")
    print(f"check_kernels: {len(known[cpu])} cases, {lost} slower by more than {LOSS:.0%}")
    return int(lost > 0)


sys.exit(main())
