# From the command to the first realization: under 100 ms on one machine, or where that is busy a third of mpirun's time, the best of
# five starts. Prints both, and the processor time of the whole campaign of two realizations.
# ctest-serial
. "$(dirname "$0")/../support/campaigns.sh"

campaign tiny.yaml 2 '1e5 1/s'
sed -i 's/elements: 500/elements: 20/; s/end: 300 ns, quiet: 50 ns/end: 30 ns, quiet: 5 ns/' tiny.yaml
mkfifo begun
/usr/bin/python3 - "$faulty" <<'END'
import os, resource, shutil, statistics, subprocess, sys, time


def start(mpirun):
    """Seconds to the first realization and to the end, and of processor time."""
    shutil.rmtree("study", ignore_errors=True)
    begun = os.open("begun", os.O_RDWR)  # a line for each batch that begins
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    run = subprocess.Popen([sys.argv[1], "run", "tiny.yaml", "--study", "study", "--jobs", "2"], stdout=subprocess.DEVNULL,
                           stderr=subprocess.PIPE, env={**os.environ, "FRACAS_MPIRUN": mpirun, "FRACAS_TEST_LOG": "begun"})
    os.read(begun, 1)
    first = time.monotonic() - began
    said = run.communicate()[1].decode()
    assert run.returncode == 0, said
    os.close(begun)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return first, time.monotonic() - began, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


local, mpirun = zip(*((start("0"), start("1")) for _ in range(5)))
for name, times in ("without mpirun", local), ("with it", mpirun):
    best, middle = ([f"{1e3 * of(t):.0f}" for t in zip(*times)] for of in (min, statistics.median))
    print(f"{name}: first realization {best[0]} ms (median {middle[0]}), all {best[1]} ({middle[1]}), processor {best[2]} ({middle[2]})")
sys.exit(min(local)[0] > max(0.1, min(mpirun)[0] / 3))
END
