/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The forgetful disk: losses allowed and not allowed. */
#define FOLDER "fracas-disk-model"
#include "tests/support/folder.h"

#include "tests/support/disk_model.h"

#include <sys/stat.h>

enum { SEEDS = 100, ROOT = 1, A = 10, B = 11, SUB = 12, SECTOR = 512 };

static disk *d;
static disk_entry entries[16];
static disk_change changes[16];
static size_t nchanges;

/* Names and bytes must live on. */
static void change(disk_kind kind, disk_entry entry, const char *name, const char *other,
                   const void *bytes)
{
    entries[nchanges] = entry;
    entries[nchanges].kind = kind;
    changes[nchanges] = (disk_change){&entries[nchanges], name, other, bytes};
    disk_apply(d, &changes[nchanges++]);
}

static void create(uint64_t node, uint64_t in, const char *name)
{
    change(DISK_CREATE, (disk_entry){.node = node, .folder = in}, name, "", NULL);
}

static void write_at(uint64_t node, uint64_t at, const void *bytes, size_t size)
{
    change(DISK_WRITE, (disk_entry){.node = node, .at = at, .size = (uint32_t)size}, "", "", bytes);
}

static void sync_node(uint64_t node)
{
    change(DISK_SYNC, (disk_entry){.node = node}, "", "", NULL);
}

static void rename_to(uint64_t node, const char *from, const char *to)
{
    change(DISK_RENAME, (disk_entry){.node = node, .folder = ROOT, .other = ROOT}, from, to, NULL);
}

static int begin(void **state)
{
    d = disk_create(ROOT);
    nchanges = 0;
    return 0;
}

static int end(void **state)
{
    disk_destroy(d);
    return 0;
}

static bool never(const char *name)
{
    return false;
}

/* The state of a seed in a folder of its own; a path in it. */
static const char *built(uint64_t seed, const char *path)
{
    static char whole[100];
    static uint64_t number;
    snprintf(whole, sizeof whole, "%s/%d", folder, (int)number++);
    assert_int_equal(mkdir(whole, 0755), 0);
    disk_build(d, seed, whole, NULL, never);
    snprintf(whole + strlen(whole), sizeof whole - strlen(whole), "/%s", path);
    return whole;
}

/* How often a file has these bytes in all states; *absent: how often it is not there. */
static int count_states(const char *path, const void *bytes, size_t size, int *absent)
{
    int same = 0;
    *absent = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        const char *whole = built(seed, path);
        struct stat info;
        if (stat(whole, &info) < 0) {
            ++*absent;
            continue;
        }
        size_t has;
        unsigned char *found = whole_bytes(whole, &has);
        same += has == size && memcmp(found, bytes, size) == 0;
        free(found);
    }
    return same;
}

static void synced_is_there(void **state)
{
    int absent;
    create(A, ROOT, "a");
    write_at(A, 0, "bytes", 5);
    sync_node(A);
    assert_in_range(count_states("a", "bytes", 5, &absent), 1, SEEDS - 1);
    assert_in_range(absent, 1, SEEDS - 1); /* its name is not durable yet */
    sync_node(ROOT);
    assert_int_equal(count_states("a", "bytes", 5, &absent), SEEDS);
}

static void unsynced_may_be_lost_by_sectors(void **state)
{
    enum { SIZE = 3 * SECTOR };
    static char before[SIZE], after[SIZE], half[SIZE];
    int absent;
    memset(before, 'b', SIZE);
    memset(after, 'a', SIZE);
    memset(half, 'a', SIZE);
    memset(half + SECTOR, 'b', SECTOR); /* the middle one is lost */
    create(A, ROOT, "a");
    write_at(A, 0, before, SIZE);
    sync_node(A);
    sync_node(ROOT);
    write_at(A, 0, after, SIZE);
    const int old = count_states("a", before, SIZE, &absent),
              new = count_states("a", after, SIZE, &absent),
              torn = count_states("a", half, SIZE, &absent);
    assert_in_range(old, 1, SEEDS);
    assert_in_range(new, 1, SEEDS);
    assert_in_range(torn, 1, SEEDS);
    assert_in_range(old + new + torn, 1, SEEDS - 1); /* there are others */
    assert_int_equal(absent, 0);
}

static void size_may_come_without_bytes(void **state)
{
    static const char zeros[600];
    int absent;
    static char bytes[600];
    memset(bytes, 'x', sizeof bytes);
    create(A, ROOT, "a");
    sync_node(ROOT);
    write_at(A, 0, bytes, sizeof bytes);
    assert_in_range(count_states("a", zeros, sizeof zeros, &absent), 1, SEEDS);
    assert_in_range(count_states("a", "", 0, &absent), 1, SEEDS);
    change(DISK_TRUNCATE, (disk_entry){.node = A, .at = 0}, "", "", NULL);
    sync_node(A);
    assert_int_equal(count_states("a", "", 0, &absent), SEEDS);
}

static void truncation_is_whole(void **state)
{
    static char bytes[3 * SECTOR];
    int absent;
    memset(bytes, 'x', sizeof bytes);
    create(A, ROOT, "a");
    write_at(A, 0, bytes, sizeof bytes);
    sync_node(A);
    sync_node(ROOT);
    change(DISK_TRUNCATE, (disk_entry){.node = A, .at = 0}, "", "", NULL);
    const int old = count_states("a", bytes, sizeof bytes, &absent);
    assert_in_range(old, 1, SEEDS - 1);
    assert_int_equal(old + count_states("a", "", 0, &absent), SEEDS);
}

/* A name leads to one file or the other at all times. */
static void rename_is_atomic(void **state)
{
    int absent, lost;
    create(A, ROOT, "a");
    write_at(A, 0, "old", 3);
    sync_node(A);
    sync_node(ROOT);
    create(B, ROOT, "b");
    write_at(B, 0, "new", 3);
    sync_node(B);
    rename_to(B, "b", "a");
    const int old = count_states("a", "old", 3, &absent), new = count_states("a", "new", 3, &lost);
    assert_in_range(old, 1, SEEDS - 1);
    assert_int_equal(old + new, SEEDS);
    assert_int_equal(absent + lost, 0);
    sync_node(ROOT);
    assert_int_equal(count_states("a", "new", 3, &absent), SEEDS);
    count_states("b", "new", 3, &absent);
    assert_int_equal(absent, SEEDS);
}

static void folders_need_their_own_name(void **state)
{
    int absent;
    change(DISK_MKDIR, (disk_entry){.node = SUB, .folder = ROOT}, "sub", "", NULL);
    create(A, SUB, "a");
    write_at(A, 0, "x", 1);
    sync_node(A);
    sync_node(SUB);
    count_states("sub/a", "x", 1, &absent);
    assert_in_range(absent, 1, SEEDS - 1);
    sync_node(ROOT);
    assert_int_equal(count_states("sub/a", "x", 1, &absent), SEEDS);
    change(DISK_REMOVE, (disk_entry){.node = A, .folder = SUB}, "a", "", NULL);
    assert_in_range(count_states("sub/a", "x", 1, &absent), 1, SEEDS - 1);
    sync_node(SUB);
    assert_int_equal(count_states("sub/a", "x", 1, &absent), 0);
}

TESTS_RUN(make_folder, remove_folder, begin, end, synced_is_there, unsynced_may_be_lost_by_sectors,
          size_may_come_without_bytes, truncation_is_whole, rename_is_atomic,
          folders_need_their_own_name)
