"""No row done without its bytes, read without code of ours: sqlite3 and h5py."""
import os
import shutil
import sqlite3
import tempfile

import h5py


def value(x):
    return None if x is None or x != x else x


def open_index(study):
    """To read. After a kill in the middle of a transaction with a journal (while the index is made, or where there is no log) SQLite must
    roll back first, which it does in a copy: the study stays as the next run will find it."""
    db = sqlite3.connect(f"file:{study}/index.sqlite?mode=ro", uri=True, timeout=60)
    try:
        db.execute("SELECT 1 FROM sqlite_master").fetchone()
        return db
    except sqlite3.OperationalError as error:
        db.close()
        if "readonly" not in str(error):
            raise
    with tempfile.TemporaryDirectory() as folder:
        for tail in ("", "-journal"):
            if os.path.exists(f"{study}/index.sqlite{tail}"):
                shutil.copy(f"{study}/index.sqlite{tail}", f"{folder}/index.sqlite{tail}")
        copy, rolled_back = sqlite3.connect(f"{folder}/index.sqlite"), sqlite3.connect(":memory:")
        copy.backup(rolled_back)
        copy.close()
    return rolled_back


def done_rows(study, trusted=()):
    """{(point hash, replica): (segment, row)} of the rows that are done; each was found in its segment, but for those in `trusted`, an
    earlier answer, whose segments are only looked at from outside."""
    if not os.path.exists(f"{study}/index.sqlite"):
        return {}
    db = open_index(study)
    try:
        if not db.execute("SELECT count(*) FROM sqlite_master WHERE name = 'realization'").fetchone()[0]:
            return {}
        rows = db.execute(
            "SELECT s.name, s.bytes, r.row, p.hash, r.replica, r.outcome, r.fragments, r.steps, r.dissipated, r.residual"
            " FROM realization r JOIN point p ON p.id = r.point LEFT JOIN segment s ON s.id = r.segment"
            " WHERE r.status = 'done' ORDER BY s.name, r.row").fetchall()
    finally:
        db.close()
    segments, places = {}, {}
    known = {place[0] for place in trusted.values()} if trusted else set()
    for name, size, row, point, replica, *numbers in rows:
        assert name is not None, f"{study}: replica {replica} of {point} is done, but in no segment"
        if name not in segments:
            segments[name] = read_segment(f"{study}/segments/{name}", size, name in known)
        found = segments[name]
        places[point, replica] = (name, row)
        if name in known:
            continue
        assert row < len(found), f"{name} has {len(found)} rows, not {row + 1}"
        wanted = (point, replica) + tuple(value(x) for x in numbers)
        assert found[row] == wanted, f"{name}, row {row}: {found[row]}, the index says {wanted}"
    return places


def read_segment(path, size, known=False):
    """What the index keeps of each row. HDF5 checks its sums as it reads."""
    assert os.path.exists(path), f"{path} is not there, but rows of it are done"
    assert os.path.getsize(path) == size, f"{path} has {os.path.getsize(path)} bytes, the index says {size}"
    if known:
        return None
    with h5py.File(path, "r") as file:
        points = [h.decode() for h in file["point/hash"][:]]
        columns = [file[f"realization/{c}"][:].tolist()
                   for c in ("point", "replica", "outcome", "fragments", "steps", "dissipated", "residual")]
        return [(points[p], replica) + tuple(value(x) for x in rest) for p, replica, *rest in zip(*columns)]
