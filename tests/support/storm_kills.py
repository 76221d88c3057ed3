"""kill -9 of processes of a run, chosen at random, until the campaign is done; each time looks at what is left, and resumes.

    storm_kills.py FRACAS FOLDER [KILLS [REPLICAS]]

Kinds of processes are known by their place: parent, its starter, the starter's ranks, and below a rank, where there is one, the supervisor, then
the compute server, then the child. FRACAS_STORM_SEED repeats the choices of a run, though not the moments at which they meet it.

What must hold:
  - a run whose parent was not killed ends by itself with status 0, 3 or 6, and nobody outlives it;
  - after each end, no row is done without its bytes, and what was done before is done still, in the same place;
  - what is computed a second time was in flight at a kill in between. Precisely: of two batches that begin the same realization one after
    the other (the program writes a line for each batch that begins, FRACAS_TEST_LOG) there is a kill in between; at it, the realization
    was not done in the index; and the process that had begun it was the victim or below it, or the victim was one that ends the run:
    parent, starter, a rank. So
        begun - realizations <= sum over kills of |begun before, not done, of the victim|,
    each realization counting once a kill. The lines come before the computing, and the index is read before the kill, so the bound is
    one in the safe direction by what happens in the milliseconds between;
  - at the end study.h5 is that of an undisturbed run, and `fracas verify` finds the study sound.
"""
import collections
import glob
import os
import random
import re
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import study_rows  # noqa: E402
from process_tree import Tree, read  # noqa: E402
from study_rows import done_rows  # noqa: E402

CAMPAIGN = """\
name: storm
seed: 7
model: bar
geometry: {{ends: periodic, length: 10 mm, area: 1 mm2}}
mesh: {{elements: {elements}}}
material: {{young: 275 GPa, density: 2750 kg/m3}}
cohesive: {{law: nitsche, fracture_energy: 100 J/m2, beta: 4}}
strength: {{distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}}
loading: {{type: imposed-rate, rate: 1e5 1/s}}
time: {{stop: quiet, end: 300 ns, quiet: 50 ns, safety: 0.25}}
sweep:
  - loading.rate: [3e4 1/s, 1e5 1/s]
replicas: {replicas}
output: {{history: 100, interfaces: false}}
"""
KINDS = ["parent", "starter", "rank 0", "other rank", "supervisor", "server", "child"]
ENDS_THE_RUN = {"parent", "starter", "rank 0", "other rank"}
RATE = 25  # realizations a second that this machine shall compute: then 200 kills, each with a new start, come to 2000 of them
MERGES = 0.07  # of the kills are left for when only study.h5 is to be written


def end(text):
    print(f"FAILED: {text}", flush=True)
    sys.exit(1)


class Storm:
    def __init__(self, fracas, folder, kills, replicas):
        self.fracas, self.folder, self.kills, self.replicas = fracas, folder, kills, replicas
        self.study, self.log = f"{folder}/storm", f"{folder}/begun"
        self.seed = int(os.environ.get("FRACAS_STORM_SEED", random.randrange(1 << 30)))
        self.random = random.Random(self.seed)
        print(f"seed {self.seed} (FRACAS_STORM_SEED)", flush=True)
        open(self.log, "w").close()
        self.campaign = f"{folder}/storm.yaml"
        elements = int(os.environ.get("FRACAS_STORM_ELEMENTS", 0)) or self.measure()
        print(f"{elements} elements (FRACAS_STORM_ELEMENTS)", flush=True)
        self.write_campaign(self.campaign, replicas, elements)
        self.environment = {**os.environ, "FRACAS_TEST_LOG": self.log}
        self.run = None
        self.done = {}     # as seen last
        self.victims = []  # (log before, log after, kind, pids, done)
        self.table = collections.Counter()
        self.statuses = collections.Counter()
        self.merges = self.runs = 0

    def write_campaign(self, path, replicas, elements):
        with open(path, "w") as file:
            file.write(CAMPAIGN.format(replicas=replicas // 2, elements=elements))

    def measure(self):
        """Elements that make for RATE: work goes with their square."""
        path, elements = f"{self.folder}/measure.yaml", 1000
        self.write_campaign(path, 64, elements)
        command = [self.fracas, "run", path, "--study", f"{self.folder}/measure", "--jobs", "2"]
        said = subprocess.run(command, capture_output=True, text=True)
        rate = re.search(r"64 of 64 realizations done, 0 failed, ([0-9.]+)/s", said.stderr)
        if not rate:
            end(f"nothing was computed: {said.stderr}")
        return max(200, min(4000, int(elements * (float(rate[1]) / RATE) ** 0.5)))

    # ---- a run ----

    def tree(self):
        return Tree(self.run.pid, os.path.basename(self.fracas))

    def start(self):
        options = ["--jobs", self.random.choice(["1", "2", "2", "3"]), "--lanes", self.random.choice(["1", "4", "4", "8"]),
                   "--isolation", self.random.choice(["lease", "lease", "lease", "none"]),
                   "--lease-time", self.random.choice(["0", "0.2"]), "--segment-age", self.random.choice(["0.05", "0.2"])]
        if self.random.random() < 0.3:
            options.append("--shuffle")
        self.stale = set(glob.glob(f"{self.study}/.study.h5.tmp-*"))  # of a run that was killed: still there until this one sweeps
        self.said = open(f"{self.folder}/said", "w+")
        self.run = subprocess.Popen([self.fracas, "run", self.campaign, "--study", self.study, *options], env=self.environment,
                                    stdin=subprocess.DEVNULL, stdout=self.said, stderr=subprocess.STDOUT, start_new_session=True)
        self.runs += 1

    def said_text(self):
        self.said.flush()
        return read(self.said.name)

    def merging(self):
        return bool(set(glob.glob(f"{self.study}/.study.h5.tmp-*")) - self.stale)

    def phase(self, kinds):
        if self.merging():
            return "merging"
        if "rank 0" not in kinds:
            return "starting"
        if os.path.getsize(self.log) > self.log_at_start:
            return "writing" if glob.glob(f"{self.study}/segments/.*.tmp-*") else "computing"
        return "recovering"

    def kill(self):
        """One process of the run. False if there is none."""
        tree = self.tree()
        kinds = tree.kinds(self.run.pid)
        if "child" in kinds and self.attempted():
            del kinds["child"]  # a realization that was alone in a child that died twice would be FAILED by a third time
        if not kinds or self.run.poll() is not None:
            return False
        fewest = min(self.killed(kind) for kind in kinds)
        kind = self.random.choice(sorted(k for k in kinds if self.killed(k) <= fewest + 4))
        victim = self.random.choice(sorted(kinds[kind]))
        phase = self.phase(kinds)
        before = os.path.getsize(self.log)
        done = self.look()
        tree = self.tree()  # looking took a while: there are other children by now
        below = tree.below(victim)
        try:
            os.kill(victim, signal.SIGKILL)
        except ProcessLookupError:
            return False
        self.wait_for_doomed(tree, kind, below, kinds)
        self.victims.append((before, os.path.getsize(self.log), kind, below, done))
        self.table[kind, phase] += 1
        return True

    def wait_for_doomed(self, tree, kind, below, kinds):
        """Those that die with the victim may begin another batch before they do: that was in flight as well."""
        doomed = set(below)
        if kind == "parent":
            doomed |= set(tree.name)
        elif kind in ENDS_THE_RUN:
            for starter in kinds.get("starter", []):
                doomed |= tree.below(starter) - {starter}
        late = time.monotonic() + 5
        while doomed & set(self.tree().name) and time.monotonic() < late:
            time.sleep(0.002)

    def killed(self, kind):
        return sum(n for (k, _), n in self.table.items() if k == kind)

    def attempted(self):
        try:
            db = study_rows.open_index(self.study)
            most = db.execute("SELECT max(attempts) FROM realization WHERE status <> 'done'").fetchone()[0]
            db.close()
            return (most or 0) >= 2
        except Exception:
            return False

    # ---- what is left ----

    def look(self):
        """Rows done now; what was done before must be, in the same place."""
        try:
            now = done_rows(self.study, trusted=self.done)
        except Exception as wrong:
            if self.run.poll() is None and "no such table" in str(wrong):
                return self.done
            end(f"after {len(self.victims)} kills: {wrong!r}")
        lost = [key for key, place in self.done.items() if now.get(key) != place]
        if lost:
            end(f"after {len(self.victims)} kills {len(lost)} realizations that were done are not, or elsewhere: {lost[:5]}")
        self.done = now
        return set(now)

    def bury(self):
        """After the end of the parent: nobody may outlive it."""
        status = self.run.wait()
        late = time.monotonic() + 30
        while self.tree().name:
            if time.monotonic() > late:
                end(f"processes outlive the parent: {self.tree().name}")
            time.sleep(0.01)
        self.statuses[status] += 1
        killed_parent = self.victims and self.victims[-1][2] == "parent"
        if status not in (0, 3, 6) and not (status == -9 and killed_parent):
            end(f"status {status} after the kill of {self.victims[-1][2] if self.victims else 'nobody'}\n{self.said_text()}")
        self.look()
        return status

    # ---- the storm ----

    def wait(self):
        """Until the next kill is due; False if the run ended before."""
        missing = self.replicas - len(self.done)
        if missing == 0:  # only study.h5 is to be written: half of the kills when its temporary is there
            due = time.monotonic() + self.random.uniform(0.05, 1.2)
            while time.monotonic() < due and self.run.poll() is None:
                if self.merging() and self.random.random() < 0.7:
                    time.sleep(self.random.uniform(0, 0.05))
                    break
                time.sleep(0.001)
            return self.run.poll() is None
        # As many kills as realizations, in proportion: a machine that is quick, or busy, makes no difference.
        planned = self.kills * (1 - MERGES) * len(self.done) / self.replicas
        ahead = len(self.victims) - planned
        longest = 0.4 if ahead < -2 else 2.0
        delay = max(0.05, longest * self.random.random() ** 2) + min(10, max(0, ahead - 4))
        try:
            self.run.wait(delay)
            return False
        except subprocess.TimeoutExpired:
            return True

    def go(self):
        self.log_at_start = 0
        self.start()
        while True:
            more = len(self.victims) < self.kills
            if more and self.wait() and self.kill():
                time.sleep(0.01)
                if self.victims[-1][2] == "parent":
                    self.run.wait()
            elif not more:
                self.run.wait()
            if self.run.poll() is None:
                if not self.done or len(self.done) < self.replicas:
                    self.look()
                continue
            if self.bury() == 0:
                self.merges += 1
                if len(self.victims) >= self.kills:
                    return
                os.remove(f"{self.study}/study.h5")
            if self.runs % 40 == 0:
                self.verify()
                print(f"{len(self.victims)} kills, {self.runs} runs, {len(self.done)} of {self.replicas} done", flush=True)
            self.log_at_start = os.path.getsize(self.log)
            self.start()

    def verify(self):
        said = subprocess.run([self.fracas, "verify", self.study], capture_output=True, text=True)
        # A study that was killed while it was written has problems that the next run mends, but no damage.
        problems = [line for line in said.stdout.splitlines() if "damaged" in line or "differs" in line]
        if problems:
            end("fracas verify: " + "\n".join(problems))

    # ---- the accounts ----

    def events(self):
        db = study_rows.open_index(self.study)
        found = db.execute("SELECT time, kind, text FROM event WHERE kind IN ('overdue', 'server replaced', 'worker lost', 'restarted', 'copy failed')").fetchall()
        db.close()
        return found

    def account(self):
        hashes = self.point_numbers()
        begun = collections.defaultdict(list)  # (point, replica): [(place in the log, pids of who began it)]
        at = 0
        with open(self.log) as file:
            for line in file:
                pid, parent, point, *replicas = map(int, line.split())
                for replica in replicas:
                    begun[point, replica].append((at, {pid, parent}))
                at += len(line)
        again = collections.Counter()
        for realization, batches in begun.items():
            key = (hashes[realization[0]], realization[1])
            for (first, who), (second, _) in zip(batches, batches[1:]):
                kinds = [kind for before, after, kind, below, done in self.victims
                         if first < after and second >= before and key not in done and (kind in ENDS_THE_RUN or who & below)]
                if not kinds:
                    near = [(kind, before, after, sorted(below)) for before, after, kind, below, _ in self.victims if before <= second + 2000 and after >= first - 2000]
                    end(f"replica {realization[1]} of point {realization[0]} was begun again though no kill met it: at {first} of the log by {who}, at "
                        f"{second}; kills near that (kind, places in the log, pids): {near}; events: {self.events()}")
                again[kinds[0]] += 1
        flight = 0
        for before, after, kind, below, done in self.victims:
            for realization, batches in begun.items():
                if (hashes[realization[0]], realization[1]) not in done:
                    flight += any(b < after and (kind in ENDS_THE_RUN or who & below) for b, who in batches)
        total = sum(map(len, begun.values()))
        if len(begun) != self.replicas:
            end(f"{len(begun)} realizations were begun, of {self.replicas}: the log is not whole")
        if total - self.replicas > flight:
            end(f"{total - self.replicas} realizations begun again, but {flight} in flight")
        return total, flight, again

    def point_numbers(self):
        import h5py
        with h5py.File(f"{self.study}/study.h5", "r") as file:
            return [h.decode() for h in file["point/hash"][:]]


def main():
    fracas, folder, *numbers = sys.argv[1:]
    kills, replicas = (list(map(int, numbers)) + [200, 2000][len(numbers):])[:2]
    storm = Storm(fracas, folder, kills, replicas)
    began = time.monotonic()
    command = [fracas, "run", storm.campaign, "--study", f"{folder}/undisturbed", "--jobs", "2"]
    said = subprocess.run(command, capture_output=True, text=True)
    if said.returncode:
        end(f"the undisturbed run: status {said.returncode}\n{said.stderr}")
    print(f"undisturbed: {time.monotonic() - began:.0f} s", flush=True)
    began = time.monotonic()
    storm.go()
    print(f"{len(storm.victims)} kills in {storm.runs} runs, {time.monotonic() - began:.0f} s; statuses {dict(storm.statuses)}")
    phases = ["starting", "recovering", "computing", "writing", "merging"]
    print(f"{'':12}" + "".join(f"{p:>12}" for p in phases))
    for kind in KINDS:
        if storm.killed(kind):
            print(f"{kind:12}" + "".join(f"{storm.table[kind, p]:12}" for p in phases))
    with open(f"{folder}/undisturbed/study.h5", "rb") as a, open(f"{storm.study}/study.h5", "rb") as b:
        if a.read() != b.read():
            end("study.h5 is not that of the undisturbed run")
    total, flight, again = storm.account()
    print(f"{total} realizations begun for {replicas}: {total - replicas} again ({dict(again)}), {flight} were in flight at the kills")
    said = subprocess.run([fracas, "verify", storm.study], capture_output=True, text=True)
    if said.returncode:
        end(f"fracas verify: {said.stdout}{said.stderr}")


main()
