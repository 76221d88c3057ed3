"""Damages one file of a study at a sampled place and looks at what fracas makes of it.

    damage.py FRACAS SEED DAMAGES NAME=CAMPAIGN=STUDY=RESULT...

NAME of a study; CAMPAIGN, its file; STUDY, its folder, finished, interrupted, killed or without an index; RESULT, the study that an
undisturbed run made. A damage is a flipped bit, a byte with another value, a cut, a block of zeros, bytes more at the end, or the
file gone. Of each damaged copy:
  - no command crashes, hangs, or ends with a status that is not documented;
  - `verify` and `verify --full` name the file, or nothing that counts has changed: the rows and numbers of the index, what
    `report --json` and `fit --json` tell. A damaged log of SQLite (index.sqlite-wal) may have lost its last commits: what is left are
    rows of the undamaged index;
  - fits.csv is named, its numbers are told by nobody, and `fit` writes the undisturbed one again;
  - a checkpoint changes nothing: a run on names and drops it;
  - report/ and export/ nobody reads: everything is as before, and `report` and `export` write the undisturbed bytes again;
  - a sample is run on, doing what the messages say, until a run says that it is done: study.h5 has the undisturbed bytes,
    `verify --full` finds nothing, and `report --json` tells what it tells of the undisturbed study.
Prints how many went which way; status 1 if one went wrong, which is then kept in ./kept-N.
"""
import collections
import filecmp
import json
import os
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile

LIMIT = 600  # s for a command
# How often a kind of file is damaged, and which part of these is run on.
KINDS = {"segment": (20, 8), "study.h5": (12, 8), "index": (16, 4), "wal": (10, 4), "shm": (5, 8), "lock": (6, 4), "campaign.yaml": (9, 3),
         "attachment": (8, 3), "fits.csv": (8, 3), "report": (4, 8), "export": (2, 8),
         "orphan": (8, 4), "temporary": (2, 8), "checkpoint": (8, 3)}
NOT_NEEDED = {"report", "export", "lock", "shm", "orphan", "temporary", "checkpoint"}
NAMED = {"segment", "fits.csv", "attachment"}  # whatever is changed in them
DAMAGES = ["bit", "byte", "cut", "zeros", "more", "gone"]
NUMBERS = {"segment", "study.h5", "index", "wal", "campaign.yaml", "attachment"}  # whose numbers fits are made of
fracas, seed, damages = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
studies = [dict(zip(("name", "campaign", "folder", "result"), word.split("="))) for word in sys.argv[4:]]
chance = random.Random(seed)
count = collections.Counter()


class Wrong(Exception):
    pass


def call(*words):
    """Status, output and errors of a command; a crash, a bug of fracas or a hang is wrong."""
    try:
        done = subprocess.run([fracas, *words], stdin=subprocess.DEVNULL, capture_output=True, timeout=LIMIT, start_new_session=True)
    except subprocess.TimeoutExpired:
        raise Wrong(f"`{' '.join(words)}` hangs")
    said, errors = (text.decode(errors="replace") for text in (done.stdout, done.stderr))
    if done.returncode not in (0, 1, 2, 3, 4, 5, 6):
        raise Wrong(f"`{' '.join(words)}` ends with {done.returncode}: {errors}")
    if done.returncode and not errors:
        raise Wrong(f"`{' '.join(words)}` ends with {done.returncode}, without a word")
    return done.returncode, said, errors


def kind_of(path):
    name = os.path.basename(path)
    if ".tmp-" in name:
        return "temporary"
    for folder, kind in (("segments/", "segment"), ("attachments/", "attachment"), ("report/", "report"), ("export/", "export"),
                         ("checkpoints/", "checkpoint")):
        if path.startswith(folder):
            return kind
    return {"index.sqlite": "index", "index.sqlite-wal": "wal", "index.sqlite-shm": "shm"}.get(name, name)


def kind_in(of, path):
    """A segment that the index does not know is an orphan, which the next run looks at."""
    kind = kind_of(path)
    known = of["content"] is not None and os.path.basename(path).encode() in (row[1] for row in of["content"][0][2])
    return "orphan" if kind == "segment" and not known else kind


def files(study):
    return sorted(os.path.relpath(os.path.join(folder, name), study) for folder, _, names in os.walk(study) for name in names)


def copy(study, to):
    """Files that are never written in place are linked."""
    shutil.rmtree(to, ignore_errors=True)
    for path in files(study):
        os.makedirs(os.path.dirname(f"{to}/{path}"), exist_ok=True)
        (os.link if kind_of(path) in ("segment", "study.h5") else shutil.copy)(f"{study}/{path}", f"{to}/{path}")


def read(path):
    with open(path, "rb") as file:
        return file.read()


# ---- damages ----

def damaged(data, how):
    """The bytes with a damage of this kind, None for no file; and where. Another place where there is nothing to damage."""
    at = chance.randrange(len(data)) if data else 0
    if chance.random() < 0.5:  # where something is written
        at = next((i for i in range(at, len(data)) if data[i]), at)
    if how == "gone":
        return None, at
    if how == "cut":
        return data[:at], at
    if how == "more" or not data:
        more = chance.choice([1, 16, 512, 4096, 20000])
        return data + chance.choice([bytes(more), chance.randbytes(more), data[-more:] or b"1 host\n"]), len(data)
    if how == "zeros":
        length = chance.choice([8, 64, 512, 4096])
        at -= at % length
        put = bytes(len(data[at:at + length]))
    else:
        put = bytes([data[at] ^ (1 << chance.randrange(8) if how == "bit" else chance.randrange(1, 256))])
    return data[:at] + put + data[at + len(put):], at


def choose():
    """A damage: of which study, which file, how, and its bytes."""
    while True:
        kind = chance.choices(list(KINDS), [weight for weight, _ in KINDS.values()])[0]
        having = [of for of in studies if kind in of["kinds"]]
        if not having:
            continue
        of = chance.choice(having)
        path, how = chance.choice([path for path in of["files"] if kind_in(of, path) == kind]), chance.choice(DAMAGES)
        made, at = damaged(read(f"{of['folder']}/{path}"), how)
        if made != read(f"{of['folder']}/{path}"):
            return of, kind, path, how, at, made


def put(path, data):
    os.unlink(path)  # it may be a link
    if data is not None:
        with open(path, "wb") as out:
            out.write(data)


# ---- numbers of a study ----

def content(study):
    """What counts in the index: text of each table, and each row that is done. None if SQLite cannot read it, or finds it damaged."""
    with tempfile.TemporaryDirectory(dir=".") as folder:
        for tail in ("", "-wal"):
            if os.path.exists(f"{study}/index.sqlite{tail}"):
                shutil.copy(f"{study}/index.sqlite{tail}", folder)
        if not os.path.exists(f"{folder}/index.sqlite"):
            return None
        base = sqlite3.connect(f"{folder}/index.sqlite")
        base.text_factory = bytes
        try:
            if base.execute("PRAGMA integrity_check").fetchall() != [(b"ok",)]:
                return None
            tables = [sorted(base.execute(query)) for query in (
                "SELECT * FROM meta", "SELECT * FROM point", "SELECT id, name, bytes, checksum, rows FROM segment",
                "SELECT point, round, replicas, failed, quote(mean), quote(half_width), stop, quantity, minimum, maximum,"
                " relative_half_width, confidence FROM decision")]
            rows = {row[:2]: row for row in base.execute(
                "SELECT point, replica, status, ifnull(outcome, -1), ifnull(segment, -1), ifnull(row, -1), ifnull(fragments, -1),"
                " ifnull(fragments_dust, -1), ifnull(steps, -1), quote(dissipated), quote(residual), quote(size) FROM realization")}
            return tables, rows
        except (sqlite3.Error, UnicodeDecodeError):  # a message may quote damaged bytes
            return None
        finally:
            base.close()


def is_earlier(before, after):
    """The index after is one from before: every row that is done is the same, the others are not done yet."""
    return after is not None and all(row[2] != b"done" or before[1].get(key) == row for key, row in after[1].items())


def told(fit):
    """The numbers of ./case that report, or fit, tells: (status, numbers, errors)."""
    status, said, errors = call("fit", "case", "--resamples", "99", "--json") if fit else call("report", "case", "--json")
    return status, json.loads(said) if status == 0 else None, errors


def without(numbers, *names):
    """What is told of the rest."""
    if isinstance(numbers, dict):
        return {key: without(value, *names) for key, value in numbers.items() if key not in names}
    return [without(value, *names) for value in numbers] if isinstance(numbers, list) else numbers


def without_fits(numbers):
    return without(numbers, "fits", "stale_fits", "fits_left_out")


def without_state(numbers):
    """Without what it says of the study as a whole, as that it is not merged."""
    return {key: value for key, value in numbers.items() if key not in ("warnings", "partial", "complete")}


# ---- remedies of messages ----

def obey(of, said):
    """Does what a message says to do with ./case."""
    if "fracas reindex" in said:
        status, _, errors = call("reindex", "case")
        if status:
            raise Wrong(f"reindex: {status}: {errors}\nafter: {said}")
        return "reindex"
    if "--force" in said:
        status, _, errors = call("run", of["campaign"], "--study", "case", "--jobs", "1", "--force")
        if status:
            raise Wrong(f"run --force: {status}: {errors}\nafter: {said}")
        return "run --force"
    if "put back the original" in said:
        for path in files(of["folder"]):
            if kind_of(path) == "attachment":
                shutil.copy(f"{of['folder']}/{path}", f"case/{path}")
        return "the original put back"
    if re.search(r"fits\.csv.*(remove it|fracas fit)", said):
        status, _, errors = call("fit", "case", "--resamples", "99")
        if status:
            raise Wrong(f"fit: {status}: {errors}\nafter: {said}")
        return "fit"
    if re.search(r"campaign\.yaml|campaign file", said) and "remove it" in said:
        os.unlink("case/campaign.yaml")
        return "campaign.yaml removed"
    remove = re.search(r"(?:remove|move) (case/\S*?)(?: away)?(?: and|:|;|\s)", said)
    if remove:
        os.unlink(remove.group(1))
        return "a file removed"
    if re.search(r"study\.h5[^\n]*remove it", said):
        os.unlink("case/study.h5")
        return "study.h5 removed"
    if re.search(r"run again|same command|fracas merge|fracas run|run the file it was made from|run the campaign file", said):
        return "run again"
    raise Wrong(f"this does not say what to do: {said}")


def problems(full):
    """What verify says of ./case, line by line."""
    status, said, errors = call("verify", *full, "case")
    lines = {line for line in (said + errors).splitlines() if not re.match(r"note: |fracas: case has \d+ problem", line)}
    if status not in (0, 5) or (status == 0) != ("case is sound" in said):
        raise Wrong(f"verify: {status}: {said}{errors}")
    return lines if status else set()


def resume(of):
    """Runs ./case on until study.h5 is there, obeying; how it came there."""
    way = []
    for _ in range(6):
        status, said, errors = call("run", of["campaign"], "--study", "case", "--jobs", "1")
        if status == 0 and filecmp.cmp("case/study.h5", f"{of['result']}/study.h5", shallow=False):
            lines = problems(["--full"])
            if lines:  # put right the same way: the run did not need to look at it
                way.append(obey(of, "\n".join(lines)))
                continue
            status, numbers, errors = told(False)
            if status or without_fits(numbers) != of["end"]:
                raise Wrong(f"after all the report is another: {status}: {errors}")
            return ", ".join(dict.fromkeys(way)) or "the same command"
        if status == 0:
            raise Wrong(f"a wrong study.h5, and the run says: {said}{errors}")
        if status not in (3, 4, 5):
            raise Wrong(f"run: status {status}: {errors}")
        way.append(obey(of, errors))
    raise Wrong(f"not put right: {way}, at last: {errors}")


# ---- a case ----

def make_case(of, path, data):
    copy(of["folder"], "case")
    put(f"case/{path}", data)


def check_told(of, kind, found, same, data, path, fit):
    """Numbers that are told are the undisturbed ones, or `verify` named the file."""
    make_case(of, path, data)
    status, numbers, errors = told(fit)
    name, wanted = ("fit", of["fit"]) if fit else ("report", of["report"])
    if (status or wanted is None) and not found and kind != "wal" and (numbers is None) != (wanted is None):
        raise Wrong(f"verify finds nothing, and {name} ends with {status}: {errors}")
    if status:
        return f"{name} refuses"
    if kind == "fits.csv":
        if without_state(without_fits(numbers)) != without_state(without_fits(wanted)):
            raise Wrong(f"{name} tells other numbers")
        if any(point.get("fits") for point in numbers["points"]) or data is not None and not numbers["fits_left_out"]:
            raise Wrong(f"{name} tells fits of a damaged file, or does not say that they are left out")
        return f"{name} without fits"
    if numbers == wanted:
        return f"{name} the same"
    if found and not fit and without_state(numbers) == without_state(wanted):
        return f"{name} the same, with a warning"
    if not found and same:
        raise Wrong(f"{name} tells other numbers, and verify finds nothing")
    if not fit and (numbers["complete"] or numbers["campaign"] != wanted["campaign"]):
        raise Wrong(f"{name} tells other numbers, and does not say that some are missing")
    return f"{name} of fewer realizations"


def check_rewritten(of, kind):
    """Commands write the undisturbed bytes again."""
    if kind == "fits.csv":
        call("fit", "case", "--resamples", "99")
    elif kind == "export":
        call("export", "case")
    for path in of["files"]:
        if kind_of(path) == kind and read(f"case/{path}") != of["written"][path]:
            raise Wrong(f"{path} is not written again as it was")


def verify(of, kind, path, data):
    """Whether both verifications name the file, beside what they say of the undamaged study."""
    finds = []
    name = "index.sqlite" if kind == "wal" else os.path.basename(path)
    for full in ([], ["--full"]):
        make_case(of, path, data)
        lines = problems(full) - of["problems"]
        if lines and not any(name in line for line in lines):
            raise Wrong(f"verify does not name {path}: {lines}")
        finds.append(bool(lines))
    if finds[0] and not finds[1]:
        raise Wrong("the quick verification finds what the full one does not")
    count["of those found", "also by the quick verification"] += finds[0]
    return finds[1]


def look(number, of, kind, path, how, data):
    """One case, in a copy of its own."""
    found = verify(of, kind, path, data)
    make_case(of, path, data)
    before, after = of["content"], content("case")
    same = before == after
    if not found and not same and not (kind == "wal" and is_earlier(before, after)):
        raise Wrong("rows or numbers of the index have changed, and verify does not find it")
    if not found and kind in NAMED and not (kind == "fits.csv" and data is None):
        raise Wrong("verify does not find it")
    if found and kind in NOT_NEEDED:
        raise Wrong("what nobody needs is called damage")
    ways = [check_told(of, kind, found, same, data, path, False)]
    if kind in ("report", "export", "fits.csv"):
        check_rewritten(of, kind)
    if kind in NUMBERS and number % 4 == 0:
        ways.append(check_told(of, kind, found, same, data, path, True))
    make_case(of, path, data)
    call("status", "case")
    what = "found and named" if found else "not found, nothing that counts has changed" if same else "not found, earlier rows"
    count[f"{kind}, {how}", what] += 1
    for way in ways:
        count[f"{kind}, {what}", way] += 1
    if number % KINDS[kind][1] == 0:
        make_case(of, path, data)
        count["run on", f"{kind}: {resume(of)}"] += 1


def prepare(of):
    """What is known of the undamaged study, and of the one that it shall be in the end."""
    of["files"] = files(of["folder"])
    of["content"] = content(of["folder"])
    of["kinds"] = collections.Counter(kind_in(of, path) for path in of["files"])
    copy(of["result"], "case")
    of["end"] = without_fits(told(False)[1])
    copy(of["folder"], "case")
    of["problems"] = problems([]) | problems(["--full"])
    for name, fit in (("report", False), ("fit", True)):
        copy(of["folder"], "case")
        of[name] = told(fit)[1]
    copy(of["folder"], "case")
    call("export", "case")
    call("report", "case")
    of["written"] = {path: read(f"case/{path}") for path in of["files"] if kind_of(path) in ("report", "export", "fits.csv")}


def main():
    print(f"seed {seed}", flush=True)
    wrong = 0
    for of in studies:
        prepare(of)
        print(f"{of['name']}: {', '.join(f'{n} {kind}' for kind, n in sorted(of['kinds'].items()))}", flush=True)
    for number in range(damages):
        of, kind, path, how, at, data = choose()
        try:
            look(number, of, kind, path, how, data)
        except Wrong as reason:
            wrong += 1
            print(f"WRONG, case {number}: {of['name']}, {path}, {how} at {at}: {reason}", flush=True)
            make_case(of, path, data)
            shutil.rmtree(f"kept-{number}", ignore_errors=True)
            shutil.copytree("case", f"kept-{number}")
        if wrong == 20:
            break
    for (what, verdict), n in sorted(count.items()):
        print(f"{n:5d}  {what}: {verdict}")
    print(f"{damages} damages, {wrong} went wrong")
    return 1 if wrong else 0


signal.signal(signal.SIGPIPE, signal.SIG_DFL)
sys.exit(main())
