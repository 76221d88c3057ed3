#!/usr/bin/python3
"""What a process for each lease costs: campaigns run with `--isolation lease` and `--isolation none` in turn, processor time (user and
system, of all processes of the run) and page faults of the best of ROUNDS runs each.

    python3 bench/isolation.py build/release [ROUNDS]
"""
import os
import resource
import subprocess
import sys
import tempfile
import threading

BAR = """name: bar
seed: 7
model: bar
geometry: {ends: periodic, length: 10 mm, area: 1 mm2}
mesh: {elements: 500}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: quiet, end: 300 ns, quiet: 50 ns, safety: 0.25}
replicas: 1600
"""
PLATE = """name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 5 mm, height: 5 mm, thickness: 0.1 mm}
mesh: {size: 0.0225 mm, amplitude: 0.2}
material: {young: 370 GPa, density: 3900 kg/m3, poisson: 0.22}
cohesive: {law: nitsche, fracture_energy: 50 J/m2, beta: 5}
strength: {distribution: weibull, minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {type: expansion, rate: 1e4 1/s}
time: {stop: time, end: %s ns, safety: 0.5}
replicas: %d
"""
CASES = [  # name, campaign, options, leases if they are known
    ("bar, one batch of 8", BAR, ["--lease-time", "0"], 200),
    ("bar, 0.1 s", BAR, ["--lease-time", "0.1"], None),
    ("bar, 1 s", BAR, [], None),
    ("plate, one realization of 2 steps", PLATE % ("0.15", 60), ["--lease-time", "0", "--lanes", "1"], 60),
    ("plate, one batch of 8 of 10 steps", PLATE % ("1", 24), ["--lease-time", "0"], 3),
]
fracas = os.path.abspath(sys.argv[1]) + "/fracas"
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
largest = {}


def watch(over, name):
    """Largest resident memory of a server, while the run lasts."""
    while not over.wait(0.05):
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                status = open(f"/proc/{pid}/status").read()
            except OSError:
                continue
            if "Name:\tfracas-server" in status and "VmRSS" in status:
                largest[name] = max(largest.get(name, 0), int(status.split("VmRSS:")[1].split()[0]))


def run(name, isolation, options):
    over = threading.Event()
    watcher = threading.Thread(target=watch, args=(over, name)) if isolation == "lease" else None
    if watcher:
        watcher.start()
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([fracas, "run", "c.yaml", "--study", "study", "--jobs", "1", "--isolation", isolation] + options, check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    over.set()
    if watcher:
        watcher.join()
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, after.ru_minflt - before.ru_minflt


print("| leases | server, MB | CPU s with `lease` | with `none` | ratio | ms a lease | page faults a lease |\n|---|---|---|---|---|---|---|")
for name, campaign, options, leases in CASES:
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        open("c.yaml", "w").write(campaign)
        best = {}
        for _ in range(rounds):
            for isolation in ("lease", "none"):
                seconds, faults = run(name, isolation, options)
                old = best.get(isolation, (1e9, 1e18))
                best[isolation] = min(old[0], seconds), min(old[1], faults)
                subprocess.run(["rm", "-r", "study"], check=True)
        os.chdir("/")
    (lease, lease_faults), (none, none_faults) = best["lease"], best["none"]
    each = f"{(lease - none) / leases * 1e3:.2f} | {(lease_faults - none_faults) / leases:.0f}" if leases else " | "
    print(f"| {name} | {largest[name] / 1024:.0f} | {lease:.2f} | {none:.2f} | {lease / none:.3f} | {each} |", flush=True)
