# Fields that cannot be written: one message, no half file, status as for any other file; and their size is what was said.
. tests/support/campaigns.sh

campaign small.yaml 2 '1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study small --jobs 1
refused() # STATUS WORDS OPTIONS...
{
    status=$1 words=$2
    shift 2
    expect "$status" "$fracas" replay small 0/1 "$@"
    said "$words"
    [ "$(grep -c . said)" -eq 1 ] || { cat said >&2; fail "more than a message: $*"; }
}
refused 2 'every is for fields and films: say --fields DIR' --every 50ns
refused 2 'at is for fields and films: say --fields DIR' --at end
refused 2 'one-file is for fields: say --fields DIR' --one-file
refused 2 'fields is empty; it must be a folder' --fields ''
refused 2 'at has `offset`; did you mean `onset`? it can have: onset, peak, end' --fields f --at end,offset
refused 2 'every is `0ns`; it must be a time above 0' --fields f --every 0ns
refused 2 'every is `3 m`' --fields f --every '3 m'
refused 2 'at most 10000 are written: raise --every' --fields f --every 1e-15s
[ ! -e f ] || fail "a folder for fields that are refused"
refused 6 'cannot make the folder no/f' --fields no/f
: > file
refused 6 'cannot write fields into file' --fields file
mkdir full && : > full/.hidden
refused 2 'the folder full is not empty: name a new one' --fields full
refused 6 'cannot make the folder /proc/f' --fields /proc/f

# An unbroken bar has no onset.
sed 's/299 MPa/9 GPa/; s/301 MPa/9.1 GPa/; s/fracture_energy: 100/fracture_energy: 1e5/' small.yaml > strong.yaml
expect 0 "$fracas" run --no-report strong.yaml --study strong --jobs 1
expect 2 "$fracas" replay strong 0/1 --fields f --at onset
said 'never cracked: there is no onset'
expect 0 "$fracas" replay strong 0/1 --fields strong.fields
said '^fields: [12] instants\? of'

# Instants of both kinds, each once; the size is what was said, and 20 kB a file at most.
expect 0 "$fracas" replay small 0/1 --fields sized --every 40ns --at end,peak
/usr/bin/python3 - <<'END' || fail "wrong instants, or another size"
import json, os, re
import h5py, numpy as np
count, size, unit = re.match(r"fields: up to (\d+) instants of ([\d.]+) (kB|MB), ", open("said").read()).groups()
study = h5py.File("small/study.h5")
end, step = study["realization/end_time"][1], study["realization/time_step"][1]
for part in "body", "interfaces":
    files = json.load(open(f"sized/{part}.hdf.series"))["files"]
    times = np.array([one["time"] for one in files])
    assert (np.diff(times) > 0).all() and times[0] == 0 and times[-1] == end and len(files) == int(count)
    evenly = 40e-9 * np.arange(end // 40e-9 + 1)
    assert all(((times >= t) & (times < t + step)).any() for t in evenly) and len(times) in (len(evenly) + 1, len(evenly) + 2)
    assert [one["name"] for one in files] == [f"{part}-{k + 1}.hdf" for k in range(len(files))]
on_disk = sum(os.path.getsize("sized/" + name) for name in os.listdir("sized") if name.endswith(".hdf")) / int(count)
said = float(size) * {"kB": 1e3, "MB": 1e6}[unit]
assert len(os.listdir("sized")) == 2 * int(count) + 2
assert -0.01 * said < on_disk - said < 2 * 20e3, (on_disk, said)
END

# An even instant half a step before the peak is taken with it, once.
cat > peak.py <<'END'
import json
import h5py, numpy as np
study = h5py.File("small/study.h5")
rows = slice(study["history/offset"][1], study["history/offset"][2])
stored = study["history/elastic"][rows] + study["history/cohesive"][rows]
peak, end = study["history/time"][rows][stored.argmax()], study["realization/end_time"][1]
every = peak - study["realization/time_step"][1] / 2
END
expect 0 "$fracas" replay small 0/1 --fields merged --at peak --every "$(/usr/bin/python3 -c 'from peak import *; print("%.12g" % every)')s"
/usr/bin/python3 - <<'END' || fail "the peak is not taken once"
from peak import *
times = [one["time"] for one in json.load(open("merged/body.hdf.series"))["files"]]
assert times[:2] == [0, peak] and len(times) == end // every + 1, (times, peak, every)
END

# Another result than the study's: the fields are there, and the message says whose they are.
cp -r small other
/usr/bin/python3 - <<'END'
import h5py, numpy
with h5py.File("other/study.h5", "r+") as study:
    column = study["fragment/mass"]
    column[study["fragment/offset"][1]] *= 1 + 1e-15
END
expect 5 "$fracas" replay other 0/1 --fields differing --at end
said 'differs from the study: first in /fragment/mass'
said 'fields in differing are of the computed one'

# A disk that is full after some instants: they are whole and listed, nothing else is there.
mkdir disk
cat > in-small-disk.sh <<'END'
mount -t tmpfs -o size=800k tmpfs disk || exit 77
status=0
"$1" replay small 0/1 --fields disk/f --every 20ns || status=$?
[ $status -eq 6 ] || exit 1
ls -A disk/f && cp disk/f/*.series .
rm -r disk/f
"$1" replay small 0/1 --fields disk/one --every 20ns --one-file > one 2>&1 || status=$?
[ $status -eq 6 ] || exit 1
[ -z "$(ls -A disk/one)" ] || exit 1
echo refused
END
root=-r
[ "$(id -u)" -ne 0 ] || root=
status=0
unshare $root -m sh in-small-disk.sh "$fracas" > said 2>&1 || status=$?
if [ $status -eq 77 ] || grep -q '^unshare:' said; then
    echo "skipped: a small disk cannot be mounted here"
    exit 0
fi
[ $status -eq 0 ] && said '^refused' || { cat said >&2; fail "status $status"; }
said 'cannot write disk/f/.*No space left\|disk is full\|disk full'
[ "$(grep -c '^fracas:' said)" -eq 1 ] || { cat said >&2; fail "more than one message"; }
! grep -q tmp- said || { cat said >&2; fail "half a file"; }
grep '^fracas: cannot write disk/one/.*.vtkhdf .*No space left' one || { cat one; fail "one file on a full disk"; }
/usr/bin/python3 - <<'END' || fail "not as listed"
import json
there = set(open("said").read().split())
for part in "body", "interfaces":
    listed = {one["name"] for one in json.load(open(part + ".hdf.series"))["files"]}
    assert 1 < len(listed) < 12 and listed <= there, (listed, there)
    assert {name for name in there if name.startswith(part + "-")} == listed # nothing of the instant that did not fit
END
