"""Speed of sweeps, program beside program: ratios of processor time to the first, of blocks in turn, and whether the bits agree.

    /usr/bin/python3 bench/compare_sweeps.py [--rounds 9] [--steps N] PROGRAM PROGRAM... -- OPTIONS...

PROGRAM is a bench_sweep, OPTIONS are its own. Each program runs a block of N steps when its turn comes; rounds begin with another one each.
"""
import argparse
import os
import statistics
import subprocess
import sys

cut = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
parser = argparse.ArgumentParser()
parser.add_argument("--rounds", type=int, default=9)
parser.add_argument("--steps", default="16")
parser.add_argument("programs", nargs="+")
told = parser.parse_args(sys.argv[1:cut])

runs = [subprocess.Popen([p, *sys.argv[cut + 1:], "--turns", told.steps], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        for p in told.programs]
for run in runs:
    if run.stdout.readline() != "ready\n":
        sys.exit("compare_sweeps: a program did not begin")
rates = [[] for run in runs]
for turn in range(told.rounds + 1):
    for k in range(len(runs)):
        i = (turn + k) % len(runs)
        runs[i].stdin.write("\n")
        runs[i].stdin.flush()
        rate = float(runs[i].stdout.readline())
        if turn:  # the first round warms caches
            rates[i].append(rate)
ends = [run.communicate()[0].strip() for run in runs]
print(*sys.argv[cut + 1:])
for program, rate, end in zip(told.programs, rates, ends):
    ratio = sorted(a / b for a, b in zip(rate, rates[0]))
    print(f"{os.path.relpath(program):40} {statistics.median(rate):9.3g}/s  ratio {statistics.median(ratio):.3f} "
          f"({ratio[len(ratio) // 4]:.3f} to {ratio[-1 - len(ratio) // 4]:.3f})  {end}{'' if end == ends[0] else '  OTHER BITS'}")
sys.exit(any(end != ends[0] for end in ends))
