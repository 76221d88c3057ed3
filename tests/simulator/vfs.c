/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/vfs.h"

#include "tests/simulator/calls.h"
#include "tests/simulator/disk.h"

#include <errno.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REGION = 32 << 10, SLOTS = SQLITE_SHM_NLOCK };

typedef struct vfs_file {
    sqlite3_file base; /* SQLite's part, first */
    node *file;
    char *path; /* NULL: without a name */
    process *owner;
    int level;                 /* SQLITE_LOCK_... */
    bool mapped;               /* has the shared memory */
    bool sync_folder;          /* it is new: its name is to be synced with it */
    bool remove;               /* when it is closed */
    uint8_t shared, exclusive; /* slots of the shared memory, by bits */
    struct vfs_file *next;
} vfs_file;

/* Of a node, in memory: they go when the power fails. */
typedef struct vfs_locks {
    char **region;
    size_t nregions, room;
} vfs_locks;

static vfs_file *open_files;

static vfs_file *of(sqlite3_file *file)
{
    return (vfs_file *)(void *)file;
}

static vfs_locks *locks_of(node *n)
{
    if (!n->locks) n->locks = calloc(1, sizeof *n->locks);
    if (!n->locks) abort();
    return n->locks;
}

static void forget(vfs_file *f)
{
    for (vfs_file **at = &open_files; *at; at = &(*at)->next)
        if (*at == f) {
            *at = f->next;
            return;
        }
}

void vfs_ended(const process *p)
{
    for (vfs_file **at = &open_files; *at;)
        if ((*at)->owner == p) *at = (*at)->next;
        else at = &(*at)->next;
}

/* ---- bytes ---- */

static int vfs_close(sqlite3_file *file)
{
    vfs_file *f = of(file);
    forget(f);
    if (f->remove && f->path) disk_unlink(f->path);
    free(f->path);
    return SQLITE_OK;
}

static int vfs_read(sqlite3_file *file, void *to, int size, sqlite3_int64 at)
{
    const ssize_t got = disk_read(of(file)->file, (size_t)at, to, (size_t)size);
    if (got == size) return SQLITE_OK;
    memset((char *)to + got, 0, (size_t)(size - got));
    return SQLITE_IOERR_SHORT_READ;
}

static int vfs_write(sqlite3_file *file, const void *from, int size, sqlite3_int64 at)
{
    call("SQLite writes");
    const char *next = from;
    for (ssize_t put = 0; size > 0; size -= (int)put, at += put, next += put) {
        put = disk_write(of(file)->file, (size_t)at, next, (size_t)size);
        if (put < 0) return SQLITE_FULL;
    }
    return SQLITE_OK;
}

static int vfs_truncate(sqlite3_file *file, sqlite3_int64 size)
{
    call("SQLite truncates");
    disk_truncate(of(file)->file, (size_t)size);
    return SQLITE_OK;
}

static int sync_folder_of(const char *path)
{
    char folder[512];
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(path, '/') - path), path);
    return disk_sync(disk_find(folder));
}

static int vfs_sync(sqlite3_file *file, int flags)
{
    vfs_file *f = of(file);
    (void)flags;
    call("SQLite syncs");
    disk_sync(f->file);
    if (f->sync_folder) sync_folder_of(f->path);
    f->sync_folder = false;
    return SQLITE_OK;
}

static int vfs_size(sqlite3_file *file, sqlite3_int64 *size)
{
    *size = (sqlite3_int64)of(file)->file->size;
    return SQLITE_OK;
}

/* ---- locks of the database ---- */

/* The highest lock of another one. */
static int others(const vfs_file *f)
{
    int most = SQLITE_LOCK_NONE;
    for (const vfs_file *o = open_files; o; o = o->next)
        if (o != f && o->file == f->file && o->level > most) most = o->level;
    return most;
}

static int vfs_lock(sqlite3_file *file, int level)
{
    vfs_file *f = of(file);
    if (f->level >= level) return SQLITE_OK;
    const int most = others(f);
    if (level == SQLITE_LOCK_SHARED && most >= SQLITE_LOCK_PENDING) return SQLITE_BUSY;
    if (level == SQLITE_LOCK_RESERVED && most >= SQLITE_LOCK_RESERVED) return SQLITE_BUSY;
    if (level == SQLITE_LOCK_EXCLUSIVE && most >= SQLITE_LOCK_SHARED) {
        if (most < SQLITE_LOCK_RESERVED) f->level = SQLITE_LOCK_PENDING;
        return SQLITE_BUSY;
    }
    f->level = level;
    return SQLITE_OK;
}

static int vfs_unlock(sqlite3_file *file, int level)
{
    if (of(file)->level > level) of(file)->level = level;
    return SQLITE_OK;
}

static int vfs_check(sqlite3_file *file, int *reserved)
{
    *reserved = others(of(file)) >= SQLITE_LOCK_RESERVED || of(file)->level >= SQLITE_LOCK_RESERVED;
    return SQLITE_OK;
}

static int vfs_control(sqlite3_file *file, int what, void *argument)
{
    (void)file, (void)what, (void)argument;
    return SQLITE_NOTFOUND;
}

static int vfs_sector(sqlite3_file *file)
{
    (void)file;
    return 4096;
}

static int vfs_traits(sqlite3_file *file)
{
    (void)file;
    return SQLITE_IOCAP_POWERSAFE_OVERWRITE;
}

/* ---- shared memory ---- */

static bool any_mapped(const vfs_file *f)
{
    for (const vfs_file *o = open_files; o; o = o->next)
        if (o->file == f->file && o->mapped) return true;
    return false;
}

static int vfs_map(sqlite3_file *file, int number, int size, int extend, void volatile **to)
{
    vfs_file *f = of(file);
    vfs_locks *locks = locks_of(f->file);
    *to = NULL;
    if (size != REGION) abort();
    if (!any_mapped(f)) /* leavings of the dead are void */
        for (size_t r = 0; r < locks->nregions; r++) memset(locks->region[r], 0, REGION);
    f->mapped = true;
    while (locks->nregions <= (size_t)number) {
        if (!extend) return SQLITE_OK;
        if (fracas_grow(&locks->region, sizeof *locks->region, locks->nregions, &locks->room,
                        "shared memory"))
            abort();
        char *region = calloc(1, REGION);
        if (!region) abort();
        locks->region[locks->nregions++] = region;
    }
    *to = locks->region[number];
    return SQLITE_OK;
}

static int vfs_lock_slots(sqlite3_file *file, int first, int count, int flags)
{
    vfs_file *f = of(file);
    const uint8_t mask = (uint8_t)(((1 << count) - 1) << first);
    uint8_t shared = 0, exclusive = 0;
    for (const vfs_file *o = open_files; o; o = o->next)
        if (o != f && o->file == f->file) shared |= o->shared, exclusive |= o->exclusive;
    if (flags & SQLITE_SHM_UNLOCK) {
        f->shared &= (uint8_t)~mask;
        f->exclusive &= (uint8_t)~mask;
        return SQLITE_OK;
    }
    if (mask & (flags & SQLITE_SHM_EXCLUSIVE ? shared | exclusive : exclusive)) return SQLITE_BUSY;
    if (flags & SQLITE_SHM_EXCLUSIVE) f->exclusive |= mask;
    else f->shared |= mask;
    return SQLITE_OK;
}

static void vfs_barrier(sqlite3_file *file)
{
    (void)file;
}

static int vfs_unmap(sqlite3_file *file, int remove)
{
    vfs_file *f = of(file);
    (void)remove;
    f->mapped = false;
    f->shared = f->exclusive = 0;
    return SQLITE_OK;
}

static const sqlite3_io_methods methods = {
    .iVersion = 2,
    .xClose = vfs_close,
    .xRead = vfs_read,
    .xWrite = vfs_write,
    .xTruncate = vfs_truncate,
    .xSync = vfs_sync,
    .xFileSize = vfs_size,
    .xLock = vfs_lock,
    .xUnlock = vfs_unlock,
    .xCheckReservedLock = vfs_check,
    .xFileControl = vfs_control,
    .xSectorSize = vfs_sector,
    .xDeviceCharacteristics = vfs_traits,
    .xShmMap = vfs_map,
    .xShmLock = vfs_lock_slots,
    .xShmBarrier = vfs_barrier,
    .xShmUnmap = vfs_unmap,
};

/* ---- names ---- */

static int vfs_open(sqlite3_vfs *vfs, const char *path, sqlite3_file *file, int flags, int *out)
{
    enum { SYNCED = SQLITE_OPEN_WAL | SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_SUPER_JOURNAL };
    static node nameless;
    vfs_file *f = of(file);
    (void)vfs;
    memset(f, 0, sizeof *f);
    node *n = path ? disk_find(path) : &nameless;
    const bool is_new = !n;
    call("SQLite opens");
    if (is_new && !(flags & SQLITE_OPEN_CREATE)) return SQLITE_CANTOPEN;
    if (is_new) n = disk_make(path, false);
    if (!n) return SQLITE_CANTOPEN;
    *f = (vfs_file){.base.pMethods = &methods,
                    .file = n,
                    .path = path ? strdup(path) : NULL,
                    .owner = world.current,
                    .sync_folder = is_new && (flags & SYNCED),
                    .remove = (flags & SQLITE_OPEN_DELETEONCLOSE) != 0,
                    .next = open_files};
    open_files = f;
    if (out) *out = flags;
    return SQLITE_OK;
}

static int vfs_delete(sqlite3_vfs *vfs, const char *path, int sync)
{
    (void)vfs;
    call("SQLite removes");
    if (disk_unlink(path)) return SQLITE_IOERR_DELETE_NOENT;
    if (sync) sync_folder_of(path);
    return SQLITE_OK;
}

static int vfs_access(sqlite3_vfs *vfs, const char *path, int flags, int *result)
{
    const node *n = disk_find(path);
    (void)vfs;
    *result = n && (flags != SQLITE_ACCESS_EXISTS || n->size > 0);
    return SQLITE_OK;
}

static int vfs_full_path(sqlite3_vfs *vfs, const char *path, int size, char *full)
{
    (void)vfs;
    snprintf(full, (size_t)size, "%s", path);
    return SQLITE_OK;
}

static int vfs_random(sqlite3_vfs *vfs, int size, char *to)
{
    (void)vfs;
    for (int i = 0; i < size; i++) to[i] = (char)roll_below(DICE_SQLITE, 256);
    return size;
}

static int vfs_sleep(sqlite3_vfs *vfs, int microseconds)
{
    (void)vfs;
    process_sleep(world.now + 1e-6 * microseconds);
    return microseconds;
}

static int vfs_time(sqlite3_vfs *vfs, sqlite3_int64 *milliseconds)
{
    (void)vfs;
    *milliseconds = (sqlite3_int64)(1e3 * (calls_day() + 210866760000.0));
    return SQLITE_OK;
}

static int vfs_error(sqlite3_vfs *vfs, int size, char *text)
{
    (void)vfs, (void)size, (void)text;
    return errno;
}

void vfs_register(void)
{
    static sqlite3_vfs vfs = {.iVersion = 2,
                              .szOsFile = sizeof(vfs_file),
                              .mxPathname = 512,
                              .zName = "farm",
                              .xOpen = vfs_open,
                              .xDelete = vfs_delete,
                              .xAccess = vfs_access,
                              .xFullPathname = vfs_full_path,
                              .xRandomness = vfs_random,
                              .xSleep = vfs_sleep,
                              .xGetLastError = vfs_error,
                              .xCurrentTimeInt64 = vfs_time};
    /* Fibers of one thread: a mutex would be that thread's, whichever process has it. */
    if (sqlite3_config(SQLITE_CONFIG_SINGLETHREAD) || sqlite3_vfs_register(&vfs, 1)) abort();
}
