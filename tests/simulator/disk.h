/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The disk of a simulated farm: one filesystem, whose files and folders keep what was synced and
 * what was done since. When the power fails it keeps some of that: a prefix of the changes, each by
 * chance, all or none; a write may be torn at a sector. */
#ifndef FRACAS_TESTS_SIMULATOR_DISK_H
#define FRACAS_TESTS_SIMULATOR_DISK_H

#include "tests/simulator/world.h"

#include <sys/types.h>

#define DISK_ROOT "/farm" /* paths below are on it */

typedef struct node node;

/* One entry of a folder, or the change to one: `to` NULL takes it away. */
typedef struct {
    char *name; /* of a rename: the new one */
    node *to;
    char *from; /* of a rename: the old name */
} entry;

/* One change of a file: `bytes` NULL is a truncation to `at`. */
typedef struct {
    size_t at, size;
    char *bytes;
} change;

struct node {
    bool folder;
    char *data, *safe; /* as it is, as it was synced */
    size_t size, room, safe_size, safe_room;
    change *changed; /* since */
    size_t nchanged, changed_room;
    entry *entry, *safe_entry; /* of a folder */
    size_t nentries, entries_room, nsafe, safe_entries_room;
    entry *moved; /* changes of entries since it was synced */
    size_t nmoved, moved_room;
    process *locked_by; /* fcntl's lock */
    struct vfs_locks *locks;
};

extern struct disk {
    node *root;
    double full_until, slow_until; /* s */
    bool network;
} disk;

void disk_begin(bool network);
bool disk_has(const char *path); /* one below DISK_ROOT */

/* NULL, and errno, without one. */
node *disk_find(const char *path);
/* The node of an entry, made if it is not there. */
node *disk_make(const char *path, bool folder);
int disk_unlink(const char *path);
int disk_rename(const char *from, const char *to);

/* As pread, pwrite, ftruncate and fsync. A full disk takes no byte more; a slow one takes its time
 * to sync. */
ssize_t disk_read(const node *n, size_t at, void *to, size_t size);
ssize_t disk_write(node *n, size_t at, const void *from, size_t size);
int disk_truncate(node *n, size_t size);
int disk_sync(node *n);

/* The power fails. */
void disk_crash(void);
/* Its bytes and its name would be there after that. */
bool disk_is_durable(const char *path);

#endif
