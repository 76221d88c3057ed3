/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A disk that forgets: from a log of changes (disk_log.h) to the states that a power cut may leave.
 * The model is that of docs/decisions/power-loss.md. */
#ifndef FRACAS_TESTS_SUPPORT_DISK_MODEL_H
#define FRACAS_TESTS_SUPPORT_DISK_MODEL_H

#include "tests/support/disk_log.h"

#include <stdbool.h>
#include <stddef.h>

/* ---- the log ---- */

typedef struct {
    const disk_entry *entry;
    const char *name, *other; /* "" where there is none; of a promise: its text */
    const unsigned char *bytes;
} disk_change;

typedef struct {
    void *mapped;
    size_t size;
    uint64_t root;
    disk_change *change;
    size_t count;
} disk_log;

/* Maps the log; ends the program with a message if it is none. */
void disk_log_open(const char *path, disk_log *log);
void disk_log_close(disk_log *log);

/* ---- the disk ---- */

typedef struct disk disk;

/* An empty folder with this node. */
disk *disk_create(uint64_t root);
void disk_destroy(disk *d); /* NULL is allowed */
/* The next change; the log must live as long as the disk. */
void disk_apply(disk *d, const disk_change *change);

/* A name in a state: the number of a file or folder, which is never used again. */
typedef struct {
    size_t folder, node;
    char name[256];
} disk_name;

/* Calls `visit` with every file that is durable under its name, its path from the root. */
void disk_each_durable(const disk *d, void (*visit)(void *context, const char *path, size_t node),
                       void *context);

/* The bytes of a file as programs see them, unsynced or not; freed by the caller. */
unsigned char *disk_latest(const disk *d, size_t node, size_t *size);
/* The file that has the name of a DISK_CREATE, DISK_LINK or DISK_RENAME after it was applied. */
size_t disk_node(const disk *d, uint64_t node);

/* ---- states ---- */

/* How a state treats changes that no sync has made durable: each style draws from the seed. */
#define DISK_EACH_STYLE(X)                                                      \
    X(NOTHING, "nothing unsynced is left")                                      \
    X(EVERYTHING, "everything is left: a prefix")                               \
    X(HALF, "each sector, size and name by half a chance")                      \
    X(MOST, "nine of ten of them")                                              \
    X(FEW, "one of ten of them")                                                \
    X(NAMES, "names and sizes, no bytes: zeros")                                \
    X(BYTES, "bytes, no names")                                                 \
    X(WHOLE, "each file whole or not, each name or not")                        \
    X(GARBAGE, "names and sizes, half of the bytes; other bytes are of nobody") \
    X(JOURNAL, "names in their order up to one of them, files whole or not")    \
    X(LAST, "of a folder only the latest names, files whole or not")
#define DISK_STYLE(name, meaning) DISK_##name,
typedef enum { DISK_EACH_STYLE(DISK_STYLE) DISK_NSTYLES } disk_style;

extern const char *const disk_style_text[DISK_NSTYLES];
disk_style disk_style_of(uint64_t seed);

/* A number of [0, 2^64) from a seed and a counter. */
uint64_t disk_random(uint64_t seed, uint64_t counter);

/* Builds the state of this seed in `folder`, which is there and empty. Files without unsynced
 * changes are links to a copy in `pool` (same filesystem; NULL: all are written), but for names of
 * which `changes` says that a program changes them in place. Ends the program if the system fails.
 */
void disk_build(const disk *d, uint64_t seed, const char *folder, const char *pool,
                bool (*changes)(const char *name));

#endif
