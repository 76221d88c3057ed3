"""Checks of tests/unit/watch.sh: what a watcher shows on a pseudo-terminal, and the numbers that it writes.

check_watch.py terminal COMMAND...          redraws in place, Ctrl-C ends it and gives the cursor back
check_watch.py colours COMMAND...           colours, none with NO_COLOR, no sequences at all with TERM=dumb
check_watch.py narrow COMMAND...            a table in parts of 80 columns, wide with --wide, and wide into a pipe
check_watch.py warned COMMAND...            the warning of a run in lines of the terminal's width, one line into a file
check_watch.py prometheus FILE COMMAND...   FILE is whole whenever it is read; the command's output goes on
check_watch.py numbers LOOKS REPORT FILE    every look is a JSON object, the last has the numbers of the report, and so has FILE
"""
import fcntl, json, math, os, pty, re, select, signal, struct, subprocess, sys, termios, time

UP, HIDE, SHOW = re.compile(rb"\x1b\[\d+A"), b"\x1b[?25l", b"\x1b[?25h"
COLOUR = re.compile(rb"\x1b\[[0-9]+m")


def on_terminal(command, environment, interrupt_after=None, columns=80):
    """Runs a command on a pseudo-terminal; Ctrl-C after so many frames. Its output and wait status."""
    pid, fd = pty.fork()
    if pid == 0:
        for name in ("NO_COLOR", "TERM"):
            os.environ.pop(name, None)
        os.environ.update(environment)
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        os.execv(command[0], command)
    out, end = b"", time.monotonic() + 60
    while time.monotonic() < end:
        if select.select([fd], [], [], 0.1)[0]:
            try:
                part = os.read(fd, 65536)
            except OSError:
                break
            if not part:
                break
            out += part
        if interrupt_after and out.count(HIDE) >= interrupt_after:
            os.write(fd, b"\x03")
            interrupt_after = None
    return out, os.waitpid(pid, 0)[1]


def plain(frame):
    return re.sub(rb"\x1b\[[?0-9]*[a-zA-Z]", b"", frame)


def check_terminal(command):
    out, status = on_terminal(command, {"TERM": "xterm"}, interrupt_after=4)
    assert os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGINT, status
    frames = out.split(HIDE)[1:]
    assert len(frames) >= 4, len(frames)
    assert out.rstrip(b"\r\n").endswith(SHOW), out[-40:]
    assert not UP.match(frames[0]) and all(UP.match(f) for f in frames[1:]), "not drawn in place"
    for before, frame in zip(frames, frames[1:]):
        assert int(UP.match(frame).group()[2:-1]) == before.count(b"\r\n"), "another number of lines"
    for line in plain(out).splitlines():
        assert len(line.split(b"\r")[-1]) < 80, line
    text = plain(frames[-1])
    assert b"being computed" in text and re.search(rb"point +fragments +\+- \[%\] +done +replicas", text), text
    assert re.search(rb"\d rate 6e4 1/s.* [#+o.!]{8}\r\n", text), text


def check_colours(command):
    seen = {}
    for name, environment in (("yes", {"TERM": "xterm"}), ("empty", {"TERM": "xterm", "NO_COLOR": ""}),
                              ("no", {"TERM": "xterm", "NO_COLOR": "1"}), ("dumb", {"TERM": "dumb"})):
        seen[name], status = on_terminal(command, environment)
        assert os.WEXITSTATUS(status) == 1, status
    assert COLOUR.search(seen["yes"]) and b"\x1b[31m!" in seen["yes"], "no colours"
    assert seen["empty"] == seen["yes"], "an empty NO_COLOR counts"
    assert not COLOUR.search(seen["no"]) and HIDE in seen["no"], "colours against NO_COLOR"
    assert plain(seen["no"]) == plain(seen["yes"]), "another text without colours"
    assert b"\x1b" not in seen["dumb"] and b"15 of 16 realizations done" in seen["dumb"], "sequences on a dumb terminal"
    narrow, _ = on_terminal(command, {"TERM": "xterm"}, columns=60)
    assert all(len(line) < 60 for line in plain(narrow).splitlines()[:-1]), "wider than the terminal"


def without_numbers(lines):
    """A plan measures its times anew."""
    return [re.sub("[0-9][0-9.e+-]*", "#", " ".join(line.split())) for line in lines]


def check_narrow(command):
    shown = {width: on_terminal(command + more, {"TERM": "xterm", "NO_COLOR": "1"}, columns=width)
             for width, more in ((80, []), (50, []), (79, ["--wide"]))}
    piped = subprocess.run(command, stdout=subprocess.PIPE).stdout
    for width, (out, status) in shown.items():
        assert os.WEXITSTATUS(status) == 0, status
        lines = plain(out).decode().splitlines()
        if width == 79:
            assert without_numbers(lines) == without_numbers(piped.decode().splitlines()), "--wide differs from a pipe"
            assert max(map(len, lines)) > 100, "no wide table"
        else:
            assert all(len(line) < width for line in lines), max(lines, key=len)
            missing = set(" ".join(without_numbers(piped.decode().splitlines())).split()) - set(" ".join(without_numbers(lines)).split())
            assert not missing, missing
    coloured, _ = on_terminal(command, {"TERM": "xterm"})
    assert (b"\x1b[33m" in coloured) == (b"warning:" in coloured), "warnings have a colour"


def check_warned(command):
    begin = "fracas: warning: "
    out, status = on_terminal(command + ["--study", "warned"], {"TERM": "xterm"}, columns=60)
    assert os.WEXITSTATUS(status) == 0, out
    lines = plain(out).decode().splitlines()
    wrapped = lines[[line.startswith(begin) for line in lines].index(True):]
    while not wrapped[-1].startswith(" " * len(begin)):
        wrapped.pop()
    assert len(wrapped) > 4 and max(map(len, wrapped)) <= 60, wrapped
    piped = subprocess.run(command + ["--study", "in-a-file"], stderr=subprocess.PIPE, check=True).stderr.decode().splitlines()
    assert " ".join(" ".join(wrapped).split()) in piped, (wrapped, piped)


SAMPLE = re.compile(r'(fracas_[a-z_]+)\{((?:[a-z_]+="(?:[^"\\\n]|\\["\\n])*",?)+)\} (-?[0-9.]+(?:e[-+][0-9]+)?)')


def samples(text):
    """The samples of a file in the text format 0.0.4: {(name, labels): value}."""
    found, family, helped = {}, None, None
    assert text.endswith("\n"), "no line break at the end"
    for line in text.splitlines():
        if line.startswith("# HELP "):
            helped = line.split(" ", 3)[2]
            assert helped != family and len(line.split(" ", 3)[3]) > 5, line
        elif line.startswith("# TYPE "):
            family = line.split(" ")[2]
            assert family == helped and line.split(" ")[3] == "gauge", line
        else:
            sample = SAMPLE.fullmatch(line)
            assert sample and sample[1] == family, line
            key = sample[1], tuple(sorted(re.findall(r'([a-z_]+)="(.*?)"', sample[2])))
            assert key not in found, line
            found[key] = float(sample[3])
    return found


def check_prometheus(path, command):
    watcher, reads = subprocess.Popen(command), 0
    while watcher.poll() is None:
        if os.path.exists(path):
            samples(open(path).read())
            reads += 1
        time.sleep(0.003)
    assert watcher.returncode == 1, watcher.returncode
    assert reads > 20, reads
    left = [name for name in os.listdir(os.path.dirname(path) or ".") if path in name and name != path]
    assert not left, left


def check_numbers(looks, report, path):
    looks = [json.loads(line) for line in open(looks)]
    report, file, last = json.load(open(report)), samples(open(path).read()), looks[-1]
    assert len(looks) >= 3 and all(a["done"] <= b["done"] for a, b in zip(looks, looks[1:]))
    assert any(look["running"] and 0 < look["done"] < 15 and look["rate"] > 0 and look["seconds_left"] > 0 for look in looks)
    assert last["complete"] and not last["running"] and (last["done"], last["failed"]) == (15, 1)
    assert last["rate"] is None and last["failures"][0]["replica"] == 5
    assert any(0 < sum(point["count"]["n"] for point in look["points"]) < 15 for look in looks), "nothing was seen on the way"
    for p, (now, then) in enumerate(zip(last["points"], report["points"])):
        for key, name in ("count", "fragments"), ("size", "fragment_size"):
            for part in "n", "mean", "deviation", "half_width":
                assert now[key][part] == then["statistics"][f"{key}.{part}"], (key, part)
            unit = "_meters" if key == "size" else ""
            for part in "mean", "half_width":
                labels = ("point", str(p)), ("study", "live")
                assert file[f"fracas_{name}_{part}{unit}", labels] == now[key][part], (name, part)
        labels = ("point", str(p)), ("state", "done"), ("study", "live")
        assert file["fracas_realizations", labels] == then["progress"]["done"]
    assert not any(math.isnan(value) for value in file.values())


what, rest = sys.argv[1], sys.argv[2:]
if what == "terminal":
    check_terminal(rest)
elif what == "colours":
    check_colours(rest)
elif what == "narrow":
    check_narrow(rest)
elif what == "warned":
    check_warned(rest)
elif what == "prometheus":
    check_prometheus(rest[0], rest[1:])
else:
    check_numbers(*rest)
