/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/disk.h"

#include "tests/simulator/machine.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct disk disk;

enum { SECTOR = 512 };

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

#define GROW(array, count, room) \
    if (fracas_grow(&(array), sizeof *(array), (count), &(room), "the disk")) abort()

static node *new_node(bool folder)
{
    node *n = need(calloc(1, sizeof *n));
    n->folder = folder;
    return n;
}

void disk_begin(bool network)
{
    disk = (struct disk){.root = new_node(true), .network = network};
}

/* ---- names ---- */

bool disk_has(const char *path)
{
    const size_t length = strlen(DISK_ROOT);
    return !strncmp(path, DISK_ROOT, length) && (path[length] == '/' || !path[length]);
}

static entry *entry_of(entry *all, size_t count, const char *name)
{
    for (size_t i = count; i-- > 0;)
        if (!strcmp(all[i].name, name)) return &all[i];
    return NULL;
}

/* The folder of a path and the last name in it; NULL, and errno, without. */
static node *folder_of(const char *path, const char **name)
{
    node *n = disk.root;
    const char *at = path + strlen(DISK_ROOT);
    while (*at == '/') at++;
    for (const char *slash; (slash = strchr(at, '/')); at = slash + strspn(slash, "/")) {
        char part[256];
        snprintf(part, sizeof part, "%.*s", (int)(slash - at), at);
        const entry *e = entry_of(n->entry, n->nentries, part);
        errno = ENOENT;
        if (!e || !e->to->folder) return NULL;
        n = e->to;
    }
    *name = at;
    return n;
}

node *disk_find(const char *path)
{
    const char *name;
    node *folder = folder_of(path, &name);
    if (!folder || !*name) return folder;
    const entry *e = entry_of(folder->entry, folder->nentries, name);
    errno = ENOENT;
    return e ? e->to : NULL;
}

/* Applies a change to a list of entries. */
static void apply(entry **all, size_t *count, size_t *room, const entry *move)
{
    entry *gone = move->from ? entry_of(*all, *count, move->from) : NULL;
    if (gone) *gone = (*all)[--*count];
    entry *e = entry_of(*all, *count, move->name);
    if (!move->to) {
        if (e) *e = (*all)[--*count];
        return;
    }
    if (!e) {
        GROW(*all, *count, *room);
        e = &(*all)[(*count)++];
    }
    *e = (entry){.name = move->name, .to = move->to};
}

static void move_entry(node *folder, const char *name, node *to, const char *from)
{
    const entry move = {need(strdup(name)), to, from ? need(strdup(from)) : NULL};
    GROW(folder->moved, folder->nmoved, folder->moved_room);
    folder->moved[folder->nmoved++] = move;
    apply(&folder->entry, &folder->nentries, &folder->entries_room, &move);
}

static bool is_full(void)
{
    return world.now < disk.full_until;
}

node *disk_make(const char *path, bool is_folder)
{
    const char *name;
    node *folder = folder_of(path, &name);
    if (!folder) return NULL;
    const entry *e = entry_of(folder->entry, folder->nentries, name);
    if (e) return e->to;
    if (is_full() && chance(DICE_DISK, 0.3)) {
        errno = ENOSPC;
        return NULL;
    }
    node *n = new_node(is_folder);
    move_entry(folder, name, n, NULL);
    return n;
}

int disk_unlink(const char *path)
{
    const char *name;
    node *folder = folder_of(path, &name);
    errno = ENOENT;
    if (!folder || !entry_of(folder->entry, folder->nentries, name)) return -1;
    machine_removes(path, false);
    move_entry(folder, name, NULL, NULL);
    return 0;
}

int disk_rename(const char *from, const char *to)
{
    const char *old, *name;
    node *folder = folder_of(from, &old), *there = folder_of(to, &name);
    entry *e = folder ? entry_of(folder->entry, folder->nentries, old) : NULL;
    errno = ENOENT;
    if (!e || there != folder) return -1; /* fracas renames within a folder */
    machine_removes(to, true);
    move_entry(folder, name, e->to, old);
    return 0;
}

/* ---- bytes ---- */

static void put(char **data, size_t *size, size_t *room, const change *c)
{
    const size_t end = c->at + c->size;
    if (c->bytes && !c->size) return;
    if (end > *room || !*data) {
        *room = 2 * end + 4096;
        *data = need(realloc(*data, *room));
    }
    if (end > *size) memset(*data + *size, 0, end - *size);
    if (c->bytes) memcpy(*data + c->at, c->bytes, c->size);
    if (!c->bytes || end > *size) *size = end;
}

static void change_node(node *n, size_t at, const void *from, size_t size)
{
    change c = {.at = at, .size = size};
    if (from) memcpy(c.bytes = need(malloc(size + 1)), from, size);
    GROW(n->changed, n->nchanged, n->changed_room);
    n->changed[n->nchanged++] = c;
    put(&n->data, &n->size, &n->room, &c);
}

ssize_t disk_read(const node *n, size_t at, void *to, size_t size)
{
    if (at >= n->size) return 0;
    if (size > n->size - at) size = n->size - at;
    memcpy(to, n->data + at, size);
    return (ssize_t)size;
}

ssize_t disk_write(node *n, size_t at, const void *from, size_t size)
{
    if (is_full() && at + size > n->size) {
        if (at < n->size) size = n->size - at;
        else size = chance(DICE_DISK, 0.2) ? roll_below(DICE_DISK, size + 1) : 0;
        errno = ENOSPC;
        if (!size) return -1;
    }
    change_node(n, at, from, size);
    return (ssize_t)size;
}

int disk_truncate(node *n, size_t size)
{
    if (size != n->size) change_node(n, size, NULL, 0);
    return 0;
}

static void sync_bytes(node *n)
{
    for (size_t c = 0; c < n->nchanged; c++) {
        put(&n->safe, &n->safe_size, &n->safe_room, &n->changed[c]);
        free(n->changed[c].bytes);
    }
    n->nchanged = 0;
}

static void sync_entries(node *n)
{
    for (size_t m = 0; m < n->nmoved; m++)
        apply(&n->safe_entry, &n->nsafe, &n->safe_entries_room, &n->moved[m]);
    n->nmoved = 0;
}

int disk_sync(node *n)
{
    const bool slow = world.now < disk.slow_until;
    if (world.current) {
        process_sleep(world.now + (slow ? roll_between(DICE_DISK, 0.1, 20)
                                        : roll_between(DICE_DISK, 1e-4, 1e-2)));
        call("fsync");
    }
    sync_bytes(n);
    sync_entries(n);
    return 0;
}

/* ---- the power fails ---- */

typedef enum { NONE, ALL, PREFIX, ANY, NWAYS } way;

/* Whether change `i` of `count` stays. */
static bool stays(way how, size_t i, size_t most)
{
    return how == ALL || (how == PREFIX && i < most) || (how == ANY && chance(DICE_DISK, 0.5));
}

static void crash_bytes(node *n, way how)
{
    const size_t most = roll_below(DICE_DISK, n->nchanged + 1);
    for (size_t c = 0; c < n->nchanged; c++) {
        change *made = &n->changed[c];
        const bool torn = how != ALL && made->size > SECTOR && chance(DICE_DISK, 0.1);
        if (!torn && !stays(how, c, most)) continue;
        if (torn) made->size = roll_below(DICE_DISK, made->size / SECTOR) * SECTOR;
        put(&n->safe, &n->safe_size, &n->safe_room, made);
    }
    n->nchanged = 0;
    free(n->data);
    n->data = need(malloc(n->safe_size + 1));
    if (n->safe_size) memcpy(n->data, n->safe, n->safe_size);
    n->size = n->safe_size;
    n->room = n->safe_size + 1;
}

static void crash_node(node *n, way how)
{
    n->locked_by = NULL;
    n->locks = NULL;
    if (!n->folder) {
        crash_bytes(n, how);
        return;
    }
    const size_t most = roll_below(DICE_DISK, n->nmoved + 1);
    for (size_t m = 0; m < n->nmoved; m++)
        if (stays(how, m, most))
            apply(&n->safe_entry, &n->nsafe, &n->safe_entries_room, &n->moved[m]);
    n->nmoved = 0;
    n->nentries = 0;
    for (size_t e = 0; e < n->nsafe; e++) {
        apply(&n->entry, &n->nentries, &n->entries_room, &n->safe_entry[e]);
        crash_node(n->safe_entry[e].to, how);
    }
}

void disk_crash(void)
{
    crash_node(disk.root, (way)roll_below(DICE_DISK, NWAYS));
}

bool disk_is_durable(const char *path)
{
    const char *name;
    node *folder = folder_of(path, &name), *n = disk_find(path);
    if (!n || n->nchanged) return false;
    const entry *e = entry_of(folder->safe_entry, folder->nsafe, name);
    return e && e->to == n;
}
