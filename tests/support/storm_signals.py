"""Signals of every kind to processes of runs, chosen at random, over campaigns that are resumed with other options each time.

    storm_signals.py FRACAS FOLDER SIGNALS bars|shells

A study that is done is looked at, and a new one begun. A signal goes to one process, its kind chosen by chance (tests/support/process_tree.py), or to all at once:

  KILL; STOP, and CONT up to four seconds later; TERM, HUP, USR1, USR2, INT, QUIT, BUS, FPE, ABRT, XCPU; Ctrl-C twice, to the launcher and
  its starter as a terminal sends it.

What must hold:
  - a run ends by itself with a documented status, or by a signal that its launcher got; none says or needs more than LIMIT seconds;
  - nobody outlives its launcher;
  - after each end SQLite finds its index in order, each row that is done is in its segment with the numbers of the index, and what was
    done is done still, in the same place;
  - study.h5 of each study that is done is the undisturbed one, and `fracas verify --full` finds nothing.
FRACAS_STORM_SEED repeats the choices of a run, though not the moments at which they meet it.
"""
import collections
import glob
import os
import random
import resource
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import study_rows  # noqa: E402
from process_tree import Tree, read  # noqa: E402

BARS = """\
name: bars
seed: 7
model: bar
geometry: {ends: periodic, length: 10 mm, area: 1 mm2}
mesh: {elements: 1500}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
time: {stop: quiet, end: 300 ns, quiet: 50 ns, safety: 0.25}
loading: {type: imposed-rate}
sweep:
  - loading.rate: [3e4 1/s, 1e5 1/s]
replicas: 300
output: {history: 100, interfaces: false}
"""
SHELLS = """\
name: shells
seed: 7
model: shell
geometry: {shape: sphere, radius: 1 mm, thickness: 0.05 mm, part: octant}
mesh: {divisions: 14}
material: {young: 370 GPa, poisson: 0.22, density: 3900 kg/m3}
cohesive: {fracture_energy: 50 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
time: {end: 1 us, safety: 0.5}
loading: {ratio: 1}
sweep:
  - loading.rate: [3e4 1/s, 1e5 1/s]
replicas: 60
output: {history: 20, interfaces: true}
"""
LIMIT = 600  # s in which something is done, or the run ends
LAUNCHER = ["TERM", "HUP", "USR1", "USR2", "INT"]  # it drains by these: status 3
OTHERS = ["QUIT", "BUS", "FPE", "ABRT", "XCPU"]
NUMBER = {"ctrl-C twice": signal.SIGINT, **{name: getattr(signal, f"SIG{name}") for name in ["KILL", "STOP", "CONT"] + LAUNCHER + OTHERS}}
WEIGHTS = {"KILL": 30, "STOP": 14, "ctrl-C twice": 6, **{name: 6 for name in LAUNCHER}, **{name: 4 for name in OTHERS}}


def end(text):
    print(f"FAILED: {text}", flush=True)
    sys.exit(1)


def isas():
    flags = read("/proc/cpuinfo")
    return ["baseline"] + [isa for isa, flag in (("avx2", "avx2"), ("avx512", "avx512f")) if flag in flags]


class Storm:
    def __init__(self, fracas, folder, name, text, signals):
        self.fracas, self.folder, self.name, self.left = fracas, folder, name, signals
        self.campaign = f"{folder}/{name}.yaml"
        with open(self.campaign, "w") as file:
            file.write(text)
        self.table, self.statuses = collections.Counter(), collections.Counter()
        self.studies = self.runs = 0
        self.new_study()

    def new_study(self):
        self.studies += 1
        self.study, self.done = f"{self.folder}/{self.name}-{self.studies}", {}

    def call(self, *words, good=(0,)):
        said = subprocess.run([self.fracas, *words], capture_output=True, text=True, errors="replace")
        if said.returncode not in good:
            end(f"`{' '.join(words)}`: {said.returncode}\n{said.stdout}{said.stderr}")
        return said.returncode

    # ---- a run ----

    def start(self):
        options = ["--jobs", chance.choice(["1", "2", "2", "3"]), "--lanes", chance.choice(["1", "4", "8"]), "--isa", chance.choice(isas()),
                   "--isolation", chance.choice(["lease", "lease", "none"]), "--lease-time", chance.choice(["0", "0.2", "1"]),
                   "--segment-age", chance.choice(["0.05", "0.2", "2"])] + ["--shuffle"] * (chance.random() < 0.3)
        if self.left <= 0:
            options = ["--jobs", "2"]
        self.said = open(f"{self.folder}/{self.name}-said", "w")
        self.run = subprocess.Popen([self.fracas, "run", self.campaign, "--study", self.study, *options], stdin=subprocess.DEVNULL,
                                    stdout=self.said, stderr=subprocess.STDOUT, start_new_session=True)
        self.options, self.sent = " ".join(options), []
        self.runs += 1
        self.moved = time.monotonic()

    def tree(self):
        return Tree(self.run.pid, os.path.basename(self.fracas))

    def send(self, pids, name):
        for pid in pids:
            try:
                os.kill(pid, NUMBER[name])
            except ProcessLookupError:
                pass

    def tried_twice(self):
        """Some realization would be FAILED if the process that computes it died once more."""
        try:
            base = study_rows.open_index(self.study)
            most = base.execute("SELECT max(attempts) FROM realization WHERE status <> 'done'").fetchone()[0]
            base.close()
            return (most or 0) >= 2
        except Exception:
            return False

    def disturb(self):
        """One signal. False if there is nobody to get it."""
        tree = self.tree()
        kinds = tree.kinds(self.run.pid)
        if self.tried_twice():
            kinds.pop("child", None)
        if not kinds or self.run.poll() is not None:
            return False
        name = chance.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
        if name == "ctrl-C twice":
            kind, victims = "launcher, starter", kinds.get("parent", []) + kinds.get("starter", [])
            self.send(victims, "INT")
            time.sleep(chance.uniform(0, 0.3))
            self.send(victims, "INT")
        elif chance.random() < 0.1:
            kind, victims = "all at once", sorted(tree.name)
            self.stop(victims) if name == "STOP" else self.send(victims, name)
        else:
            kind = chance.choice(sorted(kinds))
            victims = [chance.choice(sorted(kinds[kind]))]
            self.stop(victims) if name == "STOP" else self.send(victims, name)
        fatal = name in ["KILL"] + OTHERS or "starter" not in kinds  # before it is ready, any signal ends it
        self.sent.append((name, kind, fatal and self.run.pid in victims))
        self.table[name, "launcher" if kind == "parent" else kind] += 1
        self.left -= 1
        if self.left % 50 == 0:
            print(f"{self.name}: {self.left} signals left, {self.runs} runs, {self.studies} studies", flush=True)
        return True

    def stop(self, victims):
        self.send(victims, "STOP")
        time.sleep(chance.uniform(0.2, 4))
        self.send(victims, "CONT")

    # ---- what is left ----

    def look(self):
        """Rows done now; what was done before must be, in the same place."""
        try:
            now = study_rows.done_rows(self.study, trusted=self.done)
        except Exception as wrong:
            if self.run.poll() is None and "no such table" in str(wrong):
                return
            end(f"{self.study}, after {self.sent}: {wrong!r}")
        lost = [key for key, place in self.done.items() if now.get(key) != place]
        if lost:
            end(f"{self.study}, after {self.sent}: {len(lost)} realizations that were done are not, or elsewhere: {lost[:5]}")
        if len(now) > len(self.done):
            self.moved = time.monotonic()
        self.done = now

    def check_index(self):
        if not os.path.exists(f"{self.study}/index.sqlite"):
            return
        base = study_rows.open_index(self.study)
        found = base.execute("PRAGMA integrity_check").fetchall()
        base.close()
        if found != [("ok",)]:
            end(f"{self.study}: SQLite finds {found}")

    def bury(self):
        """After the end of the launcher."""
        status = self.run.wait()
        late = time.monotonic() + 60
        while self.tree().name:
            if time.monotonic() > late:
                end(f"processes outlive the launcher, after {self.sent}: {self.tree().name}")
            time.sleep(0.01)
        self.statuses[status] += 1
        deadly = {-NUMBER[name] for name, _, fatal in self.sent if fatal}
        if status not in (0, 1, 3, 6) and status not in deadly:
            end(f"status {status} of `{self.options}` after {self.sent}\n{read(self.said.name)}")
        if status in (1, 3, 6) and not self.sent:
            end(f"status {status} of `{self.options}`, though nobody got a signal\n{read(self.said.name)}")
        self.look()
        self.check_index()
        if status == 1:
            self.call("retry", self.study, "--failed")
        return status

    def check_end(self):
        with open(f"{self.folder}/{self.name}-undisturbed/study.h5", "rb") as a, open(f"{self.study}/study.h5", "rb") as b:
            if a.read() != b.read():
                end(f"{self.study}/study.h5 is not that of the undisturbed run")
        self.call("verify", "--full", self.study)
        left = [name for name in glob.glob(f"{self.study}/**/.*", recursive=True) if ".tmp-" in name]
        if left or read(f"{self.study}/lock"):
            end(f"left behind: {left} {read(f'{self.study}/lock')}")

    # ---- the storm ----

    def wait(self):
        """Until the next signal is due; False if the run ended before."""
        try:
            self.run.wait(max(0.02, 2 * chance.random() ** 2))
            return False
        except subprocess.TimeoutExpired:
            return True

    def go(self):
        self.call("run", self.campaign, "--study", f"{self.folder}/{self.name}-undisturbed", "--jobs", "2")
        self.start()
        while True:
            if self.wait() and self.left > 0:
                self.disturb()
            if self.run.poll() is None:
                self.look()
                if time.monotonic() - self.moved > LIMIT:
                    end(f"`{self.options}` does nothing for {LIMIT} s, after {self.sent}\n{read(self.said.name)}")
                continue
            if self.bury() == 0:
                self.check_end()
                if self.left <= 0:
                    return
                self.new_study()
            self.start()

    def tell(self):
        print(f"{self.name}: {sum(self.table.values())} signals in {self.runs} runs of {self.studies} studies; statuses {dict(self.statuses)}")
        kinds = sorted({kind for _, kind in self.table})
        print(f"{'':14}" + "".join(f"{kind:>18}" for kind in kinds))
        for name in WEIGHTS:
            print(f"{name:14}" + "".join(f"{self.table[name, kind]:18}" for kind in kinds), flush=True)


def main():
    fracas, folder, signals, name = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4]
    seed = int(os.environ.get("FRACAS_STORM_SEED", random.randrange(1 << 30)))
    chance.seed(seed)
    print(f"{name}: seed {seed} (FRACAS_STORM_SEED)", flush=True)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    began = time.monotonic()
    storm = Storm(fracas, folder, name, {"bars": BARS, "shells": SHELLS}[name], signals)
    storm.go()
    storm.tell()
    print(f"{time.monotonic() - began:.0f} s")


chance = random.Random()
main()
