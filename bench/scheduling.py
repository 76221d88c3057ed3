"""Draws docs/results/scheduling.svg: efficiency of runs on many workers, as bench_cluster simulates them.

    /usr/bin/python3 bench/scheduling.py build/release/bench_cluster docs/results/scheduling.svg
"""
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "fracas"
import matplotlib.pyplot as plt

CASES = [
    ("leases of 1 s, segments of 5 s, as they are", ["task=0.1"]),
    ("the same, commits ten at a time", ["task=0.1", "commit=1e-4"]),
    ("leases of 10 s, segments of 60 s", ["task=0.1", "lease=10", "age=60"]),
    ("realizations of 1 s: leases of 8 s", ["task=1"]),
]
WORKERS = "10,30,100,300,1000,2000,3000,5000,10000"

figure, axes = plt.subplots(figsize=(7, 4.2))
for (name, settings), marker in zip(CASES, "osd^"):
    said = subprocess.run([sys.argv[1], f"workers={WORKERS}", "work=100", *settings], check=True, capture_output=True, text=True).stdout
    print(name, *settings)
    print(said, end="")
    rows = [line.split() for line in said.splitlines()[1:]]
    axes.semilogx([int(r[0]) for r in rows], [float(r[2]) for r in rows], marker=marker, label=name)
axes.set_xlabel("workers")
axes.set_ylabel("time of realizations / (workers x time)")
axes.set_ylim(0, 1.02)
axes.grid(alpha=0.3)
axes.legend(loc="lower left")
figure.tight_layout()
figure.savefig(sys.argv[2], metadata={"Date": None})
