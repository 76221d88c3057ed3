"""A long run in short: leases of one realization that take a millisecond, one process killed every second. What lasts must not grow.

    soak.py FRACAS FOLDER [LEASES]

Every second a child (`fracas-lease`) is killed, every tenth time a compute server, and once, after a tenth of the leases, the starter: from then on
launcher, ranks and supervisors live on. storm_kills.py looks at what is computed; this looks at what it costs. By the kind of process, with
the median of a quarter of the time (the second, when all caches are full, and the last):
  - memory of its own (RssAnon) may be a tenth greater, and 2 MB: a rank 0 that lost 20 bytes a lease would be seen;
  - open files at most are two more: the pipes of a child;
  - index.sqlite with its log has at most 100 bytes a realization (57 and 32 measured), and some for each segment and kill.
"""
import collections
import glob
import os
import random
import re
import signal
import statistics
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from process_tree import STARTERS  # noqa: E402

CAMPAIGN = """\
name: soak
seed: 7
model: bar
geometry: {{ends: periodic, length: 10 mm, area: 1 mm2}}
mesh: {{elements: 10}}
material: {{young: 275 GPa, density: 2750 kg/m3}}
cohesive: {{law: nitsche, fracture_energy: 100 J/m2, beta: 4}}
strength: {{distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}}
loading: {{type: imposed-rate, rate: 1e5 1/s}}
time: {{stop: time, end: 20 ns, safety: 0.125}}
replicas: {leases}
output: {{history: 0, interfaces: false}}
"""
SLACK = 2 << 20  # bytes of memory
REALIZATION, ROW, LOG = 100, 1500, 8 << 20  # bytes of the index for a realization, for a segment or a kill, and in any case

fracas, folder = sys.argv[1:3]
leases = int(sys.argv[3]) if len(sys.argv) > 3 else 1000000
study = f"{folder}/soak"


def end(text):
    print(f"FAILED: {text}", flush=True)
    sys.exit(1)


def words(path):
    with open(path, "rb") as file:
        return file.read().decode(errors="replace")


def processes(session):
    """(pid, kind) of each process of the session."""
    found = []
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            head, _, tail = words(path).rpartition(")")
            pid, name, state = int(head.split()[0]), head.split("(", 1)[1], tail.split()
            if int(state[3]) != session or state[0] == "Z":
                continue
            if name in STARTERS:
                name = "starter"
            elif name.startswith("fracas-rank-"):
                name = "rank " + name[12:]
            elif name == "fracas":
                rank = [word for word in words(f"/proc/{pid}/environ").split("\0") if word.startswith("OMPI_COMM_WORLD_RANK=")]
                name = "launcher" if pid == session else "rank " + rank[0][21:] if rank else "starting"
            found.append((pid, name))
        except (OSError, IndexError):
            pass  # it ended
    return found


def cost(pid):
    """Open files, and memory of its own [bytes]."""
    status = dict(line.split(":", 1) for line in words(f"/proc/{pid}/status").splitlines() if ":" in line)
    return len(os.listdir(f"/proc/{pid}/fd")), int(status["RssAnon"].split()[0]) << 10


def size(name):
    try:
        return os.path.getsize(f"{study}/{name}")
    except OSError:
        return 0


def kill(kind, now):
    """One of the kind, if there is any. A child of a server is another one a millisecond later."""
    for _ in range(1000):
        victim = random.choice([pid for pid, name in now if name == ("fracas-server" if kind == "fracas-lease" else kind)] or [0])
        try:
            if kind == "fracas-lease":
                victim = int(words(f"/proc/{victim}/task/{victim}/children").split()[0])
            os.kill(victim, signal.SIGKILL)
        except (IndexError, OSError):
            continue
        killed[kind] += 1
        return


with open(f"{folder}/soak.yaml", "w") as file:
    file.write(CAMPAIGN.format(leases=leases))
said = open(f"{folder}/said", "w")
options = ["--jobs", "2", "--lanes", "1", "--lease-time", "0", "--segment-age", "0.5", "--ignore-space"]
run = subprocess.Popen([fracas, "run", f"{folder}/soak.yaml", "--study", study, *options], stdin=subprocess.DEVNULL, stdout=said,
                       stderr=subprocess.STDOUT, start_new_session=True)
killed, samples, index = collections.Counter(), [], []
turn = 0
while run.poll() is None:
    time.sleep(1)
    now = processes(run.pid)
    if not any(name == "fracas-lease" for _, name in now) and not any(name == "fracas-server" for _, name in now):
        continue  # it plans, merges or starts again
    sample = []
    for pid, name in now:
        if name in ("fracas-lease", "starting"):
            continue
        try:
            sample.append((name, *cost(pid)))
        except (OSError, KeyError):
            pass
    samples.append(sample)
    index.append(size("index.sqlite") + size("index.sqlite-wal"))
    turn += 1
    done = re.findall(r"(\d+) of \d+ realizations done", words(f"{folder}/said"))
    if not killed["starter"] and done and int(done[-1]) >= leases / 10:
        kill("starter", now)
    else:
        kill("fracas-server" if turn % 10 == 0 else "fracas-lease", now)
if run.returncode:
    end(f"status {run.returncode}\n{words(said.name)[-2000:]}")
segments = len(glob.glob(f"{study}/segments/*.h5"))
print(f"{leases} leases, {len(samples)} s of computing, killed: {dict(killed)}, {segments} segments", flush=True)
if not killed["starter"] or len(samples) < 40:
    end("too short to see anything: more leases")

wrong = []
quarter = len(samples) // 4
for kind in sorted({name for sample in samples for name, _, _ in sample}):
    files, memory = ([[row[i] for sample in part for row in sample if row[0] == kind] for part in (samples[quarter:2 * quarter], samples[-quarter:])]
                     for i in (1, 2))
    if not (files[0] and files[1]):
        wrong.append(f"{kind} does not live long enough")
        continue
    before, after = map(statistics.median, memory)
    print(f"{kind}: {max(files[0])} and {max(files[1])} open files at most, {before / 1e6:.2f} and {after / 1e6:.2f} MB", flush=True)
    if after > 1.1 * before + SLACK:
        wrong.append(f"memory of {kind} grows from {before / 1e6:.2f} to {after / 1e6:.2f} MB")
    if max(files[1]) > max(files[0]) + 2:
        wrong.append(f"open files of {kind} grow from {max(files[0])} to {max(files[1])}")
room = REALIZATION * leases + ROW * (segments + sum(killed.values())) + LOG
print(f"index: {max(index) / leases:.1f} bytes a realization", flush=True)
if max(index) > room:
    wrong.append(f"the index grows to {max(index)} bytes, more than {room}")
if wrong:
    end("; ".join(wrong))
