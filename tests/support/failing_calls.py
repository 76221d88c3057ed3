"""Runs a tiny campaign again and again, each time with another call that fails (failing_calls.c), and looks at what is left.

    failing_calls.py FRACAS FAILING_CALLS.SO FOLDER [WHAT ...]

WHAT is CLASS:WHERE:HOW[:SAMPLES], or CLASS:WHERE:HOW:sites[SAMPLES]: the first call from each place in the program. WHERE may be
`launcher`: the parent when it starts MPI; `starter`; or, of ranks without MPI, `local.RANK.DEPTH`. After each failure:
  - the program has ended by itself with status 0, 3 or 6, or died of the kill; never with 70, never by a signal of its own;
  - a status that is not 0 has a message, and that names the study or what failed;
  - status 0 means the bytes of an undisturbed run;
  - no row is done without its bytes;
and then the same command, undisturbed, ends with 0 and gives these bytes, every row that was done is where it was (nothing durable is
computed again), nothing half written is left, and `fracas verify` finds it sound.
"""
import collections
import concurrent.futures
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from study_rows import done_rows  # noqa: E402

CLASSES = ["disk", "read", "sqlite", "hdf5", "mpi", "memory", "process", "wait", "system"]
SITES = 4096
RANKS = DEPTHS = 4
NWHERES = 1 + RANKS * DEPTHS + 1
SEED = int(os.environ.get("FRACAS_STORM_SEED", "1"))
LIMIT = 200  # s that a run may take: a fault must not make it wait for ever

# One rank without mpirun, and without the parts of Open MPI that look for networks: a tenth of a second.
ALONE = {"OMPI_COMM_WORLD_RANK": "0", "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self",
         "OMPI_MCA_osc": "^ucx", "OMPI_MCA_mtl": "^psm2,ofi"}
ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

CAMPAIGN = """\
name: tiny
seed: 7
model: bar
geometry: {ends: periodic, length: 10 mm, area: 1 mm2}
mesh: {elements: 20}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: quiet, end: 30 ns, quiet: 5 ns, safety: 0.25}
replicas: 2
output: {history: 2, interfaces: true}
"""
# For the failures of each place: a file, two designs, and a rule for the replicas, so that most places are passed.
FULL = CAMPAIGN.replace("{distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}", "{distribution: file, file: strengths.txt}").replace(
    "replicas: 2\n", "replicas: {minimum: 8, maximum: 9, until: {quantity: dissipated, relative-half-width: 1e-6}}\n") + """\
sweep:
  - cases: [{name: slow}, {name: fast, loading.rate: 2e5 1/s}]
"""
# A segment for each realization; hdf5 calls are so many that one segment must do.
SMALL = ["--lanes", "1", "--lease-time", "0", "--segment-size", "1e-6"]
WHOLE = ["--segment-age", "100"]


def end(text):
    sys.exit(f"FAILED: {text}")


class State:
    """failing_state of failing_calls.h."""

    COUNTS = 8 * NWHERES * len(CLASSES)
    SIZE = COUNTS + 16 * SITES + 8 + 232

    def __init__(self, path):
        self.path = path
        with open(path, "wb") as file:
            file.write(bytes(self.SIZE))

    def read(self):
        with open(self.path, "rb") as file:
            data = file.read()
        numbers = struct.unpack_from(f"<{NWHERES * len(CLASSES)}Q", data)
        self.sites = {key: count for key, count in struct.iter_unpack("<QQ", data[self.COUNTS:self.COUNTS + 16 * SITES]) if key}
        self.failed = data[-232:].split(b"\0")[0].decode(errors="replace")
        self.count = {}
        for w in range(NWHERES):
            name = "parent" if w == 0 else "starter" if w == NWHERES - 1 else f"{(w - 1) // DEPTHS}.{(w - 1) % DEPTHS}"
            self.count[name] = dict(zip(CLASSES, numbers[w * len(CLASSES):]))
        return self


class Storm:
    def __init__(self, fracas, library, folder, campaign):
        self.fracas, self.library, self.folder = fracas, library, folder
        self.campaign = os.path.join(folder, "tiny.yaml")
        with open(self.campaign, "w") as file:
            file.write(campaign)
        with open(os.path.join(folder, "strengths.txt"), "w") as file:
            file.write("".join(f"{299 + k / 10}e6\n" for k in range(20)))
        self.number = 0
        self.lock = threading.Lock()
        self.failures = []
        complete = self.new_study()
        status, text = self.run(complete, alone=True, options=WHOLE)
        if status:
            end(f"the undisturbed run: status {status}\n{text}")
        self.complete = complete
        with open(f"{complete}/study.h5", "rb") as file:
            self.bytes = file.read()

    def new_study(self):
        with self.lock:
            self.number += 1
            return os.path.join(self.folder, f"storm-{self.number}-")

    def mpi_folder(self, study):  # its name is not part of the study's, whose calls fail
        return os.path.join(self.folder, "mpi" + os.path.basename(study)[5:])

    def run(self, study, alone=True, options=(), fault=None, state=None, command="run", mpirun="1"):
        environment = {**os.environ, **ROOT, **(ALONE if alone else {}), "FRACAS_MPIRUN": mpirun}
        if alone:  # every such run is job 0, and one that ends removes the folder of the others
            environment["OMPI_MCA_orte_tmpdir_base"] = mpi = self.mpi_folder(study)
            os.makedirs(mpi, exist_ok=True)
        if fault:
            environment.update(FAILING_CALLS=fault.replace("launcher", "parent").replace("local.", ""), FAILING_STATE=state.path, FAILING_UNDER=os.path.basename(study),
                               LD_PRELOAD=self.library)
            if os.path.exists(f"{study}/study.h5"):
                environment["FAILING_ALONE"] = "1"
        arguments = [self.fracas, "run", self.campaign, "--study", study, *options] if command == "run" else [self.fracas, command, study]
        if command == "run" and not alone:
            arguments += ["--jobs", "2"]
        try:
            done = subprocess.run(arguments, env=environment, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, timeout=LIMIT, errors="replace")
            return done.returncode, done.stdout
        except subprocess.TimeoutExpired as late:
            return 124, f"it did not end in {LIMIT} s\n{late.stdout or ''}"

    def same(self, study):
        try:
            with open(f"{study}/study.h5", "rb") as file:
                return file.read() == self.bytes
        except FileNotFoundError:
            return False

    def setting(self, kind, where):
        """Where the study is from, whether without mpirun, and with which options the campaign is run."""
        if where == "starter" or where.startswith("local."):
            return False, {"alone": False, "options": SMALL, "mpirun": "0"}
        if where == "launcher":
            return False, {"alone": False, "options": SMALL}
        if where == "parent" and kind != "process":
            return True, {"alone": False}  # of a settled study, so that it starts no mpirun
        if kind in ("mpi", "memory") or where == "parent" or where[0] != "0":  # under a parent, which tells of a rank that a library crashes without memory
            return False, {"alone": False, "options": SMALL}
        return False, {"alone": True, "options": WHOLE if kind == "hdf5" else SMALL}

    def begin(self, kind, where):
        settled, how = self.setting(kind, where)
        study = self.new_study()
        if settled:
            shutil.copytree(self.complete, study)
        return study, how

    def count(self, kind, where, sites):
        """The calls to fail, as FAILING_CALLS names them."""
        study, how = self.begin(kind, where)
        state = State(study + ".state")
        status, text = self.run(study, fault=f"{kind} {where} {'0@0' if sites else 0} EIO", state=state, **how)
        if status:
            end(f"a run that was only watched: status {status}\n{text}")
        state.read()
        self.clean_up(study)
        if sites:
            return [f"{key:x}@1" for key in sorted(state.sites)]
        return range(1, state.count[where.replace("local.", "")][kind] + 1)

    def clean_up(self, study):
        shutil.rmtree(study, ignore_errors=True)
        shutil.rmtree(self.mpi_folder(study), ignore_errors=True)
        if os.path.exists(study + ".state"):
            os.remove(study + ".state")

    def check_end(self, study, fault, state, status, text):
        kind, where, _, way = fault.split()
        killed = way in ("kill", "torn")
        if not state.failed:
            return "not reached" if status == 0 else f"status {status} and nothing failed"
        if kind == "wait" and way in ("EINTR", "short") and status:
            return f"status {status}"
        if status == 0:
            return "" if self.same(study) else "status 0, but study.h5 is not that of an undisturbed run"
        if killed and status in (-9, 137):
            return ""
        if kind == "read" and status == 5 and "malformed" in text:
            return ""  # SQLite's reading of an error in the first page of the index
        if status not in (3, 6):
            return f"status {status}"
        said = [line for line in text.splitlines() if line.startswith("fracas: ")]
        call = re.split(r"[ _]", state.failed)[0]
        if not said:
            return f"status {status} without a message"
        names = [os.path.basename(study), call, "memory", "MPI", "mpirun", "process", "server", "HDF5",
                 "tiny.yaml", "strengths.txt", "this program", os.strerror(11), os.strerror(24)]
        if not any(name in line for name in names for line in said):
            return f"status {status}, and the message does not name what failed"
        return ""

    def try_one(self, fault):
        kind, where = fault.split()[:2]
        study, how = self.begin(kind, where)
        state = State(study + ".state")
        status, text = self.run(study, fault=fault, state=state, **how)
        state.read()
        problem = self.check_end(study, fault, state, status, text)
        result = (status, re.sub(r"^(\S+) .*/\.?([a-z.]*).*", r"\1 \2", state.failed) if state.failed else problem)
        if problem == "not reached":
            self.clean_up(study)
            return result
        try:
            before = done_rows(study)
            if not problem:
                problem = self.go_on(study, before, how)
        except Exception as wrong:  # whatever is wrong with the study is told with the fault that made it
            problem = problem or str(wrong) or repr(wrong)
        if problem:
            with self.lock:
                self.failures.append(f"{fault} ({state.failed}): {problem}\n--- it said\n{text}---")
                print(f"FAILED: {self.failures[-1]}", flush=True)
            if len(self.failures) > 20:
                os._exit(1)
        else:
            self.clean_up(study)
        return result

    def try_often(self, fault):
        """Which rank computes is a race: a call that was not reached may be in the next run."""
        for _ in range(5):
            result = self.try_one(fault)
            if result[1] != "not reached":
                break
        return result

    def go_on(self, study, before, how):
        status, text = self.run(study, **how)
        if status:
            return f"the same command afterwards ended with {status}\n{text}"
        if not self.same(study):
            return "afterwards study.h5 is not that of an undisturbed run"
        after = done_rows(study)
        moved = [key for key in before if after.get(key) != before[key]]
        if moved:
            return f"computed again though they were done: {moved}"
        left = [name for folder, _, names in os.walk(study) for name in names if ".tmp" in name]
        if left:
            return f"left half written: {left}"
        status, text = self.run(study, command="verify")
        return "" if status == 0 else f"verify ended with {status}\n{text}"

    def sweep(self, what, jobs):
        """CLASS:WHERE:HOW[:SAMPLES]: every call, or so many of them; :sites[SAMPLES]: from each place the first."""
        kind, where, way, *samples = what.split(":")
        began = time.monotonic()
        sites = bool(samples) and samples[0].startswith("sites")
        wanted = samples[0][5 * sites:] if samples else ""
        points = self.count(kind, where, sites)
        count = len(points)
        if "-" in wanted:  # from one to another, to look at them again
            points = range(*map(int, wanted.split("-")))
        elif "@" in wanted:
            points = [wanted]
        elif wanted and int(wanted) < count:
            points = sorted(random.Random(f"{SEED} {what}").sample(points, int(wanted)))
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            results = list(pool.map(self.try_often, [f"{kind} {where} {k} {way}" for k in points]))
        statuses = collections.Counter(status for status, _ in results)
        calls = collections.Counter(call for _, call in results)
        print(f"{what}: {len(results)} of {count} calls; status " + ", ".join(f"{s}: {n}" for s, n in sorted(statuses.items())) +
              f"; {time.monotonic() - began:.0f} s\n    " + ", ".join(f"{c} {n}" for c, n in calls.most_common(12)), flush=True)
        if count == 0:
            end(f"{what}: no such call was made")
        if calls["not reached"] > len(results) / 2:
            end(f"{what}: {calls['not reached']} of {len(results)} calls were not reached")


def main():
    fracas, library, folder, *what = sys.argv[1:]
    storm = Storm(fracas, library, folder, FULL if any(":sites" in one for one in what) else CAMPAIGN)
    jobs = int(os.environ.get("FRACAS_STORM_JOBS", "2"))
    print(f"seed {SEED} (FRACAS_STORM_SEED)", flush=True)
    for one in what:
        storm.sweep(one, jobs)
    if storm.failures:
        end(f"{len(storm.failures)} failures, see above")


main()
