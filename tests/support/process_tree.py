"""The processes of a run, by their place: parent, its starter, the starter's ranks, and below a rank, where there is one, the supervisor, then
the compute server, then the child."""
import glob

STARTERS = ("mpirun", "fracas-starter")


def read(path):
    try:
        with open(path, "rb") as file:
            return file.read().decode(errors="replace")
    except (FileNotFoundError, ProcessLookupError):
        return ""


class Tree:
    """The processes of a session."""

    supervisor = False  # there are supervisors: some process was four below a rank's starter

    def __init__(self, session, program):
        self.program = program[:15]  # as much as the kernel keeps of its name
        self.name, self.above, self.rank = {}, {}, {}
        for path in glob.glob("/proc/[0-9]*/stat"):
            text = read(path)
            head, _, tail = text.rpartition(")")
            words = tail.split()
            # zombies have nothing left, but for one whose other threads still die: it holds files, and so the lock
            if not words or int(words[3]) != session or (words[0] == "Z" and int(words[17]) <= 1):
                continue
            pid = int(head.split()[0])
            self.name[pid], self.above[pid] = head.split("(", 1)[1], int(words[1])

    def below(self, pid):
        found = {pid}
        while True:
            more = {p for p, above in self.above.items() if above in found} - found
            if not more:
                return found
            found |= more

    def depth(self, pid):
        """Steps from a rank down to this process; -1 if it is below none."""
        steps = 0
        while pid in self.name:
            if self.name.get(self.above[pid]) in STARTERS:
                return steps if self.name[pid] == self.program or self.name[pid].startswith("fracas-rank-") else -1
            pid, steps = self.above[pid], steps + 1
        return -1

    def kinds(self, session):
        found = {}
        for pid in self.name:
            depth = self.depth(pid)
            Tree.supervisor |= depth >= 3
            if pid == session:
                kind = "parent"
            elif self.name[pid] in STARTERS:
                kind = "starter"
            elif depth == 0:
                number = [w[21:] for w in read(f"/proc/{pid}/environ").split("\0") if w.startswith("OMPI_COMM_WORLD_RANK=")]
                if self.name[pid].startswith("fracas-rank-"):
                    number = [self.name[pid][12:]]
                kind = "other rank" if number and number[0] != "0" else "rank 0"
            elif depth > 0:
                kind = ([] if not Tree.supervisor else ["supervisor"] * (depth > 0)) + ["server", "child"]
                kind = kind[min(depth, len(kind)) - 1]
            else:
                continue
            found.setdefault(kind, []).append(pid)
        return found
