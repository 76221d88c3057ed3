"""`fracas plan` of files that a fuzzer made of campaign files: each ends with a documented status, and lines with a place.

    plan_mutants.py FRACAS MUTANTS MOST

MUTANTS: a folder; of its files a sample of MOST, always the same. A plan has a line for each point; each line of a refusal names the
place in the file, or the point; what is too large for the LIMIT of memory or seconds may say so, or is left after these seconds.
"""
import collections
import os
import random
import re
import resource
import subprocess
import sys
import tempfile

LIMIT = 60  # s
MEMORY = 2 << 30  # bytes


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def judge(done):
    """How it went; None where it went wrong."""
    text, error = done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")
    lines = [line for line in error.splitlines() if not re.match(r"warning: |fracas: point \d+ of \d+ is looked at(;.*)?$", line)]
    if done.returncode == 0:
        return "planned" if re.search(r"^Campaign .*: \d+ points?", text, re.M) and not lines else None
    if done.returncode == 2:
        placed = [re.match(r"fracas: (c\.yaml:\d+:\d+: |point \d+: |c\.yaml: )", line) for line in lines]
        return "refused" if placed and all(placed) else None
    return "too large" if done.returncode == 6 and len(lines) == 1 and "memory" in error else None


def main():
    fracas, mutants, most = sys.argv[1], sys.argv[2], int(sys.argv[3])
    names = sorted(os.listdir(mutants))
    random.Random(1).shuffle(names)
    count = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for name in names[:most]:
            with open(f"{mutants}/{name}", "rb") as file, open(f"{folder}/c.yaml", "wb") as out:
                out.write(file.read().split(b"\n%%% ")[0])
            try:
                done = subprocess.run([fracas, "plan", "c.yaml"], cwd=folder, capture_output=True, timeout=LIMIT, preexec_fn=limited)
                how = judge(done)
            except subprocess.TimeoutExpired:
                how = "too large"
            if how is None:
                count["WRONG"] += 1
                print(f"WRONG: {name}: status {done.returncode}\n{done.stdout.decode(errors='replace')}{done.stderr.decode(errors='replace')}")
            else:
                count[how] += 1
    print(f"plan of {sum(count.values())} mutants: {dict(count)}")
    return 1 if count["WRONG"] else 0


sys.exit(main())
