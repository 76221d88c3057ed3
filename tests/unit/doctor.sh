# fracas doctor: all is well where tests run; a folder where nobody can write, a missing or broken mpirun are told.
. tests/support/campaigns.sh

# health NAME: of a check in the object said.
health() { /usr/bin/python3 -c 'import json, sys; print(next(c["health"] for c in json.load(open("said"))["checks"] if c["name"] == sys.argv[1]))' "$1"; }

mkdir studies
expect 0 "$fracas" doctor studies --json
for check in program HDF5 SQLite 'open files' clock folder locks sync rename run; do
    [ "$(health "$check")" = ok ] || { cat said >&2; fail "$check is not ok"; }
done
[ "$(ls -A studies)" = '' ] || fail "something is left in the folder"
! command -v mpirun > /dev/null || [ "$(health 'ranks by MPI')" = ok ] || fail "mpirun starts no ranks"

mkdir bin
expect 0 env PATH="$work/bin" "$fracas" doctor
said '^note   mpirun       no mpirun in PATH: .*; install Debian.s openmpi-bin'
said '^ok     run          fracas starts two ranks'
printf '#!/bin/sh\necho "no licence for ranks" >&2\n[ "$1" = --version ]\n' > bin/mpirun
chmod +x bin/mpirun
expect 6 env PATH="$work/bin:$PATH" "$fracas" doctor --quiet
said '^WRONG  ranks by MPI a run of two ranks by mpirun ended with'
said '1 of 17 checks found something wrong: ranks by MPI$'
! grep -q '^ok' said || fail "--quiet prints what is ok"

# Root may write everywhere but here.
expect 6 "$fracas" doctor /proc
said '^WRONG  folder       no study can be made in /proc: .*; choose a folder where you may write'
said '^note   run          not tried, for want of a folder'
if [ "$(id -u)" -ne 0 ]; then
    chmod 555 studies
    expect 6 "$fracas" doctor studies
    said '^WRONG  folder       no study can be made in studies: Permission denied'
    chmod 755 studies
fi
expect 6 "$fracas" doctor none
said 'no study can be made in none: No such file'
expect 2 "$fracas" doctor none none
said 'one argument too many'
"$fracas" help doctor | grep -q '^usage: fracas doctor \[FOLDER\] \[options\]' || fail "the help has no optional operand"
