#!/bin/sh
# ctest-labels: storm
# Plants faults in the scheduler and the store, one at a time and in the simulator alone: 1000 farms must show each.
# The source as changed is compiled beside the build and linked in front of it, as tools/fuzz-planted does.
set -eu
build=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# LIBRARY@FILE@what to replace@by what@what it is
faults='scheduler@campaigns/scheduler/lease/backlog.c@p->from += count;@p->from += count > 1 ? count - 1 : count;@a realization is leased twice
store@campaigns/store/file/writer.c@if (fsync(writer->h5.fd) < 0)@if (0)@a segment is committed before its fsync
store@campaigns/store/file/writer.c@return fracas_disk_sync_folder(writer->path);@return FRACAS_OK;@a segment is committed before its name is synced
store@campaigns/store/index/index_rows.c@"PRAGMA synchronous = FULL"@"PRAGMA synchronous = NORMAL"@a commit returns before its fsync
scheduler@campaigns/scheduler/director/director.c@fracas_scheduler_lost(director->scheduler, worker);
    director->phase@director->phase@leases of a dead server are forgotten
scheduler@campaigns/scheduler/lease/scheduler.c@t->returned++;@@two workers take turns with what never ends
scheduler@campaigns/scheduler/worker/link.c@!link->unacknowledged && @@a new server gets the messages for the former one
store@campaigns/store/study/checkpoint.c@if (fsync(c->fd) < 0)@if (0)@a checkpoint is renamed before its fsync
store@campaigns/store/study/checkpoint.c@return fracas_disk_sync_folder(c->path);@return FRACAS_OK;@a checkpoint is finished before its name is synced
store@campaigns/store/study/checkpoint.c@TRY(fracas_disk_check_own_seal(made->path));@@a damaged checkpoint is loaded
store@campaigns/store/study/checkpoint.c@strncmp(found->version, wanted->version, sizeof found->version) != 0@0@a checkpoint of another version is loaded
scheduler@campaigns/scheduler/worker/interim.c@TRY(load(interim, batch, l, &record[l]));@@a realization begins anew beside its checkpoint
scheduler@campaigns/scheduler/worker/interim.c@interim->replica[lane], &head, &file@interim->replica[0], &head, &file@a lane begins at the checkpoint of another
scheduler@campaigns/scheduler/director/finish.c@fracas_checkpoints_end(director->setup.study);@@checkpoints of a complete study are left'

changed() # FILE FROM TO
{
    FROM=$2 TO=$3 perl -0pe 's/\Q$ENV{FROM}\E/$ENV{TO}/ or exit 3' "$1" ||
        { echo "FAILED: $1 has no \"$2\": bring the list up to date" >&2; exit 1; }
}

plant() # LIBRARY FILE FROM TO WHAT
{
    changed "$2" "$3" "$4" >"$folder/$(basename "$2")"
    compile=$(ninja -C "$build" -t commands "CMakeFiles/fracas_$1.dir/$2.o" | tail -n 1 |
        sed "s| -o [^ ]*| -o $folder/planted.o|; s| -MF [^ ]*| -MF $folder/planted.d|; s| -c [^ ]*| -c $folder/$(basename "$2")|")
    link=$(ninja -C "$build" -t commands tests/simulate | tail -n 1 | sed "s| -o [^ ]*| -o $folder/simulate $folder/planted.o|")
    (cd "$build" && sh -c "$compile -Wno-error" && sh -c "$link") >"$folder/log" 2>&1 || { tail -n 20 "$folder/log"; exit 1; }
    if "$folder/simulate" 1 1000 --jobs 2 >"$folder/trace"; then
        echo "FAILED: 1000 farms do not show that $5"
        exit 1
    fi
    echo "$5: $(grep -m 1 -o 'BROKEN.*' "$folder/trace")"
}

printf '%s\n' "$faults" | perl -0pe 's/\n    /\001    /g' >"$folder/faults"
while IFS='@' read -r library file from to what; do
    plant "$library" "$file" "$(printf '%s' "$from" | tr '\001' '\n')" "$to" "$what"
done <"$folder/faults"
