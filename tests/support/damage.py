"""Damages one file of a study at a sampled place and looks at what fracas makes of it.

    damage.py FRACAS SEED FLIPS TRUNCATIONS NAME=CAMPAIGN=STUDY=RESULT...

NAME of a study; CAMPAIGN, its file; STUDY, its folder, finished, interrupted or without an index; RESULT, the undisturbed study.h5.
Of each damaged copy: `verify` names the file, or nothing that counts has changed; a sample of them is run on, doing
what the messages say. Prints how many went which way; status 1 if one went wrong, which is then kept in ./kept-N.
"""
import collections, filecmp, os, random, re, shutil, signal, sqlite3, subprocess, sys

LIMIT = 600  # s for a command
COPIED = {"index.sqlite", "index.sqlite-wal", "lock", "campaign.yaml"}  # what is written in place; the rest is linked
fracas, seed, flips, truncations = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
studies = [dict(zip(("name", "campaign", "folder", "result"), word.split("="))) for word in sys.argv[5:]]
chance = random.Random(seed)
count = collections.Counter()
failures = []


class Wrong(Exception):
    pass


def call(*words):
    """Status and words of a command; a crash, a bug of fracas or a hang is wrong."""
    try:
        done = subprocess.run([fracas, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LIMIT, start_new_session=True)
    except subprocess.TimeoutExpired:
        raise Wrong(f"`{' '.join(words)}` hangs")
    said = done.stdout.decode(errors="replace")
    if done.returncode not in (0, 1, 2, 3, 5, 6):
        raise Wrong(f"`{' '.join(words)}` ends with {done.returncode}: {said}")
    return done.returncode, said


# The quick verification is another than the full one in programs that have both.
has_full = call("verify", "--full", studies[0]["folder"])[0] != 2
has_reindex = "reindex" in call("help")[1]


def copy(study, to):
    shutil.rmtree(to, ignore_errors=True)
    for folder, _, names in os.walk(study):
        os.makedirs(os.path.join(to, os.path.relpath(folder, study)), exist_ok=True)
        for name in names:
            put = os.path.join(to, os.path.relpath(folder, study), name)
            (shutil.copy if name in COPIED else os.link)(os.path.join(folder, name), put)


def damage(path, at, mask):
    """One byte at `at` changed by `mask`, or, without a mask, the file cut short there."""
    data = bytearray(open(path, "rb").read())
    if mask:
        data[at] ^= mask
    else:
        del data[at:]
    os.unlink(path)  # it may be a link
    with open(path, "wb") as out:
        out.write(data)


def content(study):
    """What counts in the index, as text; None if SQLite cannot read it."""
    if not os.path.exists(f"{study}/index.sqlite"):
        return None
    base = sqlite3.connect(f"file:{study}/index.sqlite?immutable=1", uri=True)
    base.text_factory = bytes
    try:
        if base.execute("PRAGMA integrity_check").fetchall() != [(b"ok",)]:
            return None
        return [sorted(base.execute(query)) for query in (
            "SELECT * FROM meta", "SELECT * FROM point", "SELECT id, name, bytes, checksum, rows FROM segment",
            "SELECT point, replica, status, ifnull(outcome, -1), ifnull(segment, -1), ifnull(row, -1), ifnull(fragments, -1),"
            " ifnull(fragments_dust, -1), ifnull(steps, -1), quote(dissipated), quote(residual), quote(size) FROM realization",
            "SELECT point, round, replicas, failed, quote(mean), quote(half_width), stop, quantity, minimum, maximum,"
            " relative_half_width, confidence FROM decision")]
    except (sqlite3.Error, UnicodeDecodeError):
        return None
    finally:
        base.close()


def obey(study, said):
    """Does what a message says."""
    if "fracas reindex" in said and has_reindex:
        status, more = call("reindex", study)
        if status:
            raise Wrong(f"reindex: {status}: {more}\nafter: {said}")
        return "reindexed"
    remove = re.search(r"(?:remove|move) (%s/\S*?)(?: away)?(?: and|:|;|\s)" % re.escape(study), said)
    if remove:
        os.unlink(remove.group(1))
        return "removed a file"
    if re.search(r"index[^\n]*remove (it|index.sqlite)|remove the index|reindex", said):
        for tail in ("", "-wal", "-shm"):
            if os.path.exists(f"{study}/index.sqlite{tail}"):
                os.unlink(f"{study}/index.sqlite{tail}")
        return "removed the index"
    if re.search(r"study\.h5[^\n]*remove it", said):
        os.unlink(f"{study}/study.h5")
        return "removed study.h5"
    if re.search(r"run again|same command|fracas merge|fracas run", said):
        return "ran again"
    raise Wrong(f"this does not say what to do: {said}")


def resume(study, of, found, target):
    """Runs the study on until study.h5 is there, obeying; how it came there."""
    way = []
    for _ in range(6):
        status, said = call("run", of["campaign"], "--study", study, "--jobs", "1")
        if status == 0 and filecmp.cmp(f"{study}/study.h5", of["result"], shallow=False):
            again, said = call("verify", *(["--full"] if has_full else []), study)
            if again:
                # What the run did not need to look at is put right the same way.
                way.append(obey(study, said))
                continue
            return ", ".join(dict.fromkeys(way)) or "by itself"
        if status == 0 and target == "study.h5" and found and not has_full:
            said = found  # a run believes its size; verify said what to do
        elif status == 0:
            raise Wrong(f"a wrong study.h5, and the run says: {said}")
        elif status not in (3, 5):
            raise Wrong(f"status {status}: {said}")
        way.append(obey(study, said))
    raise Wrong(f"not put right: {way}, at last: {said}")


def look(number, of, path, at, mask):
    """One case, in a copy of its own."""
    target = os.path.basename(path)
    kind = "segment" if path.startswith("segments/") else target
    copy(of["folder"], "case")
    damage(f"case/{path}", at, mask)
    before, after = content(of["folder"]), content("case")  # None without an index: then verify says only that
    quick = call("verify", "case")
    status, said = call("verify", "--full", "case") if has_full else quick
    call("status", "case")
    if kind == "study.h5":
        call("report", "case")
    what = f"{of['name']}, {kind}, {'flip' if mask else 'truncation'}"
    if status == 5 and target not in said and before is not None:
        raise Wrong(f"verify does not name {target}: {said}")
    if status not in (0, 5):
        raise Wrong(f"verify: {status}: {said}")
    if quick[0] == 5 and status == 0:
        raise Wrong(f"the quick verification finds what the full one does not: {quick[1]}")
    same = kind == "index.sqlite" and before == after
    if status == 0 and kind != "index.sqlite" and before is not None:
        raise Wrong("verify does not find it")
    verdict = "found" if status == 5 else "not found, and nothing that counts has changed" if same else "not found"
    count[what, verdict] += 1
    if quick[0] == 5:
        count["of those found", "also by the quick verification"] += 1
    often = {"segment": 6, "study.h5": 4, "index.sqlite": 2}[kind]
    if (status == 0 and not same) or number % (often * (6 if same else 1)) == 0:
        copy(of["folder"], "case")
        damage(f"case/{path}", at, mask)
        count["run on", f"{kind}: {resume('case', of, said if status else '', target)}"] += 1


def places():
    """Damages to come: of which study, which file, where, how."""
    for n in range(flips + truncations):
        of = chance.choice(studies)
        names = sorted(f"segments/{name}" for name in os.listdir(f"{of['folder']}/segments") if name.endswith(".h5"))
        others = [name for name in ("index.sqlite", "study.h5") if os.path.exists(f"{of['folder']}/{name}")]
        weights = {"index.sqlite": 5, "study.h5": 1}
        path = chance.choices([chance.choice(names)] + others, [5] + [weights[name] for name in others])[0]
        data = open(f"{of['folder']}/{path}", "rb").read()
        at = chance.randrange(len(data))
        if chance.random() < 0.5:  # where something is written
            at = next((i for i in range(at, len(data)) if data[i]), at)
        mask = 0 if n >= flips else 1 << chance.randrange(8) if chance.random() < 0.5 else chance.randrange(1, 256)
        yield of, path, at, mask


def main():
    print(f"seed {seed}")
    for number, (of, path, at, mask) in enumerate(places()):
        try:
            look(number, of, path, at, mask)
        except Wrong as wrong:
            failures.append(number)
            print(f"WRONG, case {number}: {of['name']}, {path}, byte {at}, {f'changed by {mask:#x}' if mask else 'cut there'}: {wrong}")
            copy(of["folder"], f"kept-{number}")
            damage(f"kept-{number}/{path}", at, mask)
        if len(failures) == 20:
            break
    for (what, verdict), n in sorted(count.items()):
        print(f"{n:5d}  {what}: {verdict}")
    print(f"{flips} flips, {truncations} truncations, {len(failures)} went wrong")
    return 1 if failures else 0


signal.signal(signal.SIGPIPE, signal.SIG_DFL)
sys.exit(main())
