/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/support/disk_model.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SECTOR = 512 };
static const size_t NONE = SIZE_MAX;

static void end(const char *what, const char *path)
{
    fprintf(stderr, "disk_model: cannot %s %s: %s\n", what, path, strerror(errno));
    exit(2);
}

/* Room for one element more. */
static void *grown(void *array, size_t size, size_t count)
{
    if (count & (count - 1)) return array; /* at powers of two */
    void *more = realloc(array, (count ? 2 * count : 1) * size);
    if (!more) end("allocate", "the model");
    return more;
}

uint64_t disk_random(uint64_t seed, uint64_t counter) /* splitmix64 */
{
    uint64_t z = seed * 0xd1342543de82ef95U + (counter + 1) * 0x9e3779b97f4a7c15U;
    for (int round = 0; round < 2; round++) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        z ^= z >> 31;
    }
    return z;
}

/* ---- the log ---- */

void disk_log_open(const char *path, disk_log *log)
{
    struct stat info;
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    *log = (disk_log){0};
    if (fd < 0 || fstat(fd, &info) < 0) end("open", path);
    log->size = (size_t)info.st_size;
    log->mapped = mmap(NULL, log->size, PROT_READ, MAP_PRIVATE, fd, 0);
    close(fd);
    const disk_log_head *head = log->mapped;
    if (log->mapped == MAP_FAILED || log->size < sizeof *head ||
        strcmp(head->mark, DISK_LOG_MARK) != 0 || head->end > log->size)
        end("read the log", path);
    log->root = head->root;
    for (uint64_t at = sizeof *head; at < head->end;) {
        const unsigned char *from = (const unsigned char *)log->mapped + at;
        disk_entry *entry = malloc(sizeof *entry); /* aligned */
        if (!entry) end("allocate", "the log");
        memcpy(entry, from, sizeof *entry);
        disk_change c = {.entry = entry, .name = "", .other = ""};
        if (entry->text) {
            c.name = (const char *)from + sizeof *entry;
            const size_t first = strlen(c.name) + 1;
            if (first < entry->text) c.other = c.name + first;
        }
        c.bytes = from + sizeof *entry + entry->text;
        at += sizeof *entry + entry->text + entry->size;
        log->change = grown(log->change, sizeof c, log->count);
        log->change[log->count++] = c;
    }
}

void disk_log_close(disk_log *log)
{
    for (size_t c = 0; c < log->count; c++) free((void *)log->change[c].entry);
    free(log->change);
    if (log->mapped) munmap(log->mapped, log->size);
    *log = (disk_log){0};
}

/* ---- the disk ---- */

/* A file or folder: durable bytes, and changes since the last sync. */
typedef struct {
    uint64_t number; /* of its inode */
    bool folder;
    unsigned char *bytes;
    size_t size, room;
    uint64_t version;           /* of the durable bytes */
    const disk_change **change; /* DISK_WRITE and DISK_TRUNCATE */
    size_t nchanges;
} disk_file;

typedef struct {
    disk_name *name;
    size_t count;
} disk_names;

/* A change of names, waiting for the sync of a folder. */
typedef struct {
    disk_kind kind;
    size_t node, folder, other; /* `other`: of the second name; NONE: there is one name */
    const char *name, *second;
} disk_move;

struct disk {
    disk_file *file; /* the root first */
    size_t nfiles;
    disk_names durable;
    disk_move *move;
    size_t nmoves;
};

disk *disk_create(uint64_t root)
{
    disk *d = calloc(1, sizeof *d);
    if (!d) end("allocate", "the model");
    d->file = grown(NULL, sizeof *d->file, 0);
    d->file[d->nfiles++] = (disk_file){.number = root, .folder = true};
    return d;
}

void disk_destroy(disk *d)
{
    if (!d) return;
    for (size_t f = 0; f < d->nfiles; f++) {
        free(d->file[f].bytes);
        free(d->file[f].change);
    }
    free(d->file);
    free(d->durable.name);
    free(d->move);
    free(d);
}

size_t disk_node(const disk *d, uint64_t number)
{
    for (size_t f = d->nfiles; f-- > 0;) /* the last one with it: numbers are used again */
        if (d->file[f].number == number) return f;
    return NONE;
}

static size_t find(const disk_names *names, size_t folder, const char *name)
{
    for (size_t n = 0; n < names->count; n++)
        if (names->name[n].folder == folder && strcmp(names->name[n].name, name) == 0) return n;
    return NONE;
}

static void unset(disk_names *names, size_t folder, const char *name)
{
    const size_t n = find(names, folder, name);
    if (n != NONE) names->name[n] = names->name[--names->count];
}

static void set(disk_names *names, size_t folder, const char *name, size_t node)
{
    unset(names, folder, name);
    names->name = grown(names->name, sizeof *names->name, names->count);
    disk_name *new = &names->name[names->count++];
    new->folder = folder;
    new->node = node;
    snprintf(new->name, sizeof new->name, "%s", name);
}

static void make_move(disk_names *names, const disk_move *move)
{
    if (move->kind == DISK_REMOVE) {
        unset(names, move->folder, move->name);
    } else if (move->kind == DISK_RENAME) {
        const size_t n = find(names, move->folder, move->name);
        if (n != NONE && names->name[n].node == move->node) unset(names, move->folder, move->name);
        set(names, move->other, move->second, move->node);
    } else {
        set(names, move->folder, move->name, move->node);
    }
}

/* Changes of a name that a rename took away cannot come after it. */
static void forget_source(disk *d, size_t before)
{
    const disk_move rename = d->move[before];
    size_t left = 0;
    for (size_t m = 0; m < d->nmoves; m++)
        if (m >= before || d->move[m].folder != rename.folder ||
            strcmp(d->move[m].name, rename.name) != 0)
            d->move[left++] = d->move[m];
    d->nmoves = left;
}

static void sync_folder(disk *d, size_t folder)
{
    for (size_t m = 0; m < d->nmoves;) {
        const disk_move move = d->move[m];
        if (move.folder != folder && move.other != folder) {
            m++;
            continue;
        }
        make_move(&d->durable, &move);
        if (move.kind == DISK_RENAME) {
            const size_t before = d->nmoves;
            forget_source(d, m);
            m -= before - d->nmoves;
        }
        memmove(&d->move[m], &d->move[m + 1], (d->nmoves - m - 1) * sizeof move);
        d->nmoves--;
    }
}

static void resize(disk_file *f, size_t size)
{
    if (size > f->room) {
        const size_t room = 2 * size;
        unsigned char *more = realloc(f->bytes, room);
        if (!more) end("allocate", "a file");
        memset(more + f->room, 0, room - f->room);
        f->bytes = more;
        f->room = room;
    }
    if (size < f->size) memset(f->bytes + size, 0, f->size - size);
    f->size = size;
}

static void change_file(disk_file *f, const disk_change *c)
{
    if (c->entry->kind == DISK_TRUNCATE) {
        resize(f, c->entry->at);
        return;
    }
    const size_t to = c->entry->at + c->entry->size;
    if (to > f->size) resize(f, to);
    memcpy(f->bytes + c->entry->at, c->bytes, c->entry->size);
}

static void sync_file(disk_file *f)
{
    for (size_t c = 0; c < f->nchanges; c++) change_file(f, f->change[c]);
    f->version += f->nchanges > 0;
    f->nchanges = 0;
}

static void add_move(disk *d, const disk_change *c, size_t node)
{
    const disk_entry *e = c->entry;
    const bool two = e->kind == DISK_RENAME;
    d->move = grown(d->move, sizeof *d->move, d->nmoves);
    d->move[d->nmoves++] = (disk_move){.kind = e->kind,
                                       .node = node,
                                       .folder = disk_node(d, e->folder),
                                       .other = two ? disk_node(d, e->other) : NONE,
                                       .name = c->name,
                                       .second = c->other};
}

void disk_apply(disk *d, const disk_change *c)
{
    const disk_entry *e = c->entry;
    size_t node = NONE;
    switch ((disk_kind)e->kind) {
    case DISK_CREATE:
    case DISK_MKDIR:
        d->file = grown(d->file, sizeof *d->file, d->nfiles);
        d->file[d->nfiles++] = (disk_file){.number = e->node, .folder = e->kind == DISK_MKDIR};
        add_move(d, c, d->nfiles - 1);
        break;
    case DISK_WRITE:
    case DISK_TRUNCATE: {
        node = disk_node(d, e->node);
        if (node == NONE) break;
        disk_file *f = &d->file[node];
        f->change = grown(f->change, sizeof *f->change, f->nchanges);
        f->change[f->nchanges++] = c;
        break;
    }
    case DISK_SYNC:
        node = disk_node(d, e->node);
        if (node == NONE) break;
        if (d->file[node].folder) sync_folder(d, node);
        else sync_file(&d->file[node]);
        break;
    case DISK_LINK:
    case DISK_RENAME:
    case DISK_REMOVE: add_move(d, c, disk_node(d, e->node)); break;
    default: break;
    }
}

unsigned char *disk_latest(const disk *d, size_t node, size_t *size)
{
    const disk_file *f = &d->file[node];
    disk_file copy = {0};
    resize(&copy, f->size + 1); /* no NULL for an empty file */
    resize(&copy, f->size);
    if (f->size) memcpy(copy.bytes, f->bytes, f->size);
    for (size_t c = 0; c < f->nchanges; c++) change_file(&copy, f->change[c]);
    *size = copy.size;
    return copy.bytes;
}

/* Calls `visit` with every name below a folder, folders before their content. */
static void walk(const disk *d, const disk_names *names, size_t folder, const char *path,
                 void (*visit)(void *context, const char *path, const disk_name *name),
                 void *context)
{
    for (size_t n = 0; n < names->count; n++) {
        char below[PATH_MAX];
        const disk_name *name = &names->name[n];
        if (name->folder != folder) continue;
        snprintf(below, sizeof below, "%s%s%s", path, *path ? "/" : "", name->name);
        visit(context, below, name);
        if (d->file[name->node].folder) walk(d, names, name->node, below, visit, context);
    }
}

typedef struct {
    const disk *d;
    void (*visit)(void *context, const char *path, size_t node);
    void *context;
} durable_walk;

static void visit_durable(void *context, const char *path, const disk_name *name)
{
    const durable_walk *w = context;
    const disk_file *f = &w->d->file[name->node];
    if (f->folder || f->nchanges) return;
    for (size_t m = 0; m < w->d->nmoves; m++) { /* its name is about to change */
        const disk_move *move = &w->d->move[m];
        if ((move->folder == name->folder && !strcmp(move->name, name->name)) ||
            (move->other == name->folder && !strcmp(move->second, name->name)))
            return;
    }
    w->visit(w->context, path, name->node);
}

void disk_each_durable(const disk *d, void (*visit)(void *context, const char *path, size_t node),
                       void *context)
{
    durable_walk w = {d, visit, context};
    walk(d, &d->durable, 0, "", visit_durable, &w);
}

/* ---- after a power cut ---- */

#define TEXT(name, meaning) meaning,
const char *const disk_style_text[DISK_NSTYLES] = {DISK_EACH_STYLE(TEXT)};

disk_style disk_style_of(uint64_t seed)
{
    return (disk_style)(disk_random(seed, 0) % DISK_NSTYLES);
}

/* Questions to a seed, each with its own numbers. */
typedef enum {
    ABOUT_NAME = 1,
    ABOUT_BOUND,
    ABOUT_SIZE,
    ABOUT_SECTOR,
    ABOUT_FILE,
    ABOUT_GARBAGE
} about;

static uint64_t draw(uint64_t seed, about what, uint64_t of, uint64_t number)
{
    return disk_random(disk_random(disk_random(seed, what), of), number);
}

/* How many of `count` changes are left, the first ones: all by a chance of `tenths`/10. */
static size_t left_of(uint64_t random, size_t count, unsigned tenths)
{
    if (random % 10 < tenths) return count;
    return count ? (random / 10) % count : 0;
}

static unsigned tenths_of_names(disk_style style)
{
    static const unsigned tenths[DISK_NSTYLES] = {
        [DISK_EVERYTHING] = 10, [DISK_HALF] = 5,  [DISK_MOST] = 9,     [DISK_FEW] = 1,
        [DISK_NAMES] = 10,      [DISK_WHOLE] = 5, [DISK_GARBAGE] = 10, [DISK_JOURNAL] = 10};
    return tenths[style];
}

static bool is_in(const disk_move *move, size_t folder)
{
    return move->folder == folder || move->other == folder;
}

/* The first change of names in a folder that is left, as one of its changes; few are left often. */
static size_t first_left(const disk *d, uint64_t seed, size_t folder)
{
    size_t count = 0;
    for (size_t m = 0; m < d->nmoves; m++) count += is_in(&d->move[m], folder);
    const uint64_t random = draw(seed, ABOUT_BOUND, 0, 0);
    return count ? count - 1 - (size_t)((random >> 2) % count >> random % 4) : 0;
}

static disk_names choose_names(const disk *d, uint64_t seed)
{
    const disk_style style = disk_style_of(seed);
    disk_names names = {0};
    const disk_move *latest = d->nmoves ? &d->move[d->nmoves - 1] : NULL;
    const size_t folder = !latest                 ? NONE
                          : latest->other != NONE ? latest->other
                                                  : latest->folder,
                 first = first_left(d, seed, folder),
                 end = style == DISK_JOURNAL ? draw(seed, ABOUT_BOUND, 0, 0) % (d->nmoves + 1)
                                             : d->nmoves;
    for (size_t n = 0; n < d->durable.count; n++)
        set(&names, d->durable.name[n].folder, d->durable.name[n].name, d->durable.name[n].node);
    for (size_t m = 0, number = 0; m < end; m++) {
        const disk_move *move = &d->move[m];
        bool left = draw(seed, ABOUT_NAME, m, 0) % 10 < tenths_of_names(style);
        if (style == DISK_LAST && is_in(move, folder)) left = number++ >= first;
        else if (style == DISK_LAST) left = draw(seed, ABOUT_NAME, move->folder, 1) % 2;
        if (left) make_move(&names, move);
    }
    return names;
}

/* Sectors of a change, [*first, *last). */
static void touched(const disk_change *c, size_t *first, size_t *last)
{
    const disk_entry *e = c->entry;
    *first = e->at / SECTOR;
    *last = e->size ? (e->at + e->size + SECTOR - 1) / SECTOR : *first;
}

static void count_changes(const disk_file *f, size_t *size, size_t *most, unsigned *count,
                          size_t sectors)
{
    size[0] = *most = f->size;
    for (size_t c = 0; c < f->nchanges; c++) {
        const disk_entry *e = f->change[c]->entry;
        const size_t to = e->at + e->size;
        size[c + 1] = e->kind == DISK_TRUNCATE ? e->at : to > size[c] ? to : size[c];
        if (size[c + 1] > *most) *most = size[c + 1];
        size_t first, last;
        touched(f->change[c], &first, &last);
        for (size_t s = first; count && s < last && s < sectors; s++) count[s]++;
    }
}

/* The part of a write within a sector. */
static void change_sector(unsigned char *bytes, const disk_change *c, size_t sector)
{
    const disk_entry *e = c->entry;
    size_t from = sector * SECTOR, to = from + SECTOR;
    if (from < e->at) from = e->at;
    if (to > e->at + e->size) to = e->at + e->size;
    if (to > from) memcpy(bytes + from, c->bytes + (from - e->at), to - from);
}

static unsigned tenths_of_bytes(disk_style style, uint64_t seed, size_t node)
{
    static const unsigned tenths[DISK_NSTYLES] = {
        [DISK_EVERYTHING] = 10, [DISK_HALF] = 5,   [DISK_MOST] = 9,
        [DISK_FEW] = 1,         [DISK_BYTES] = 10, [DISK_GARBAGE] = 5};
    if (style == DISK_WHOLE || style == DISK_JOURNAL || style == DISK_LAST)
        return draw(seed, ABOUT_FILE, node, 0) % 2 ? 10 : 0;
    return tenths[style];
}

static bool is_none_left(disk_style style, unsigned tenths)
{
    return tenths == 0 && style != DISK_FEW;
}

/* The bytes of a file with unsynced changes; freed by the caller. */
static unsigned char *choose_bytes(const disk_file *f, size_t node, uint64_t seed, size_t *chosen)
{
    const disk_style style = disk_style_of(seed);
    const unsigned tenths = tenths_of_bytes(style, seed, node);
    const bool sizes = style == DISK_NAMES || style == DISK_GARBAGE;
    size_t most, *size = calloc(f->nchanges + 1, sizeof *size);
    if (!size) end("allocate", "a state");
    count_changes(f, size, &most, NULL, 0);
    const size_t sectors = (most + SECTOR - 1) / SECTOR;
    unsigned *count = calloc(sectors + 1, sizeof *count), *seen = calloc(sectors + 1, sizeof *seen);
    unsigned char *bytes = calloc(1, most + 1);
    if (!count || !seen || !bytes) end("allocate", "a state");
    count_changes(f, size, &most, count, sectors);
    if (f->size) memcpy(bytes, f->bytes, f->size);
    size_t last = left_of(draw(seed, ABOUT_SIZE, node, 0), f->nchanges, sizes ? 10 : tenths);
    if (!sizes && is_none_left(style, tenths)) last = 0;
    *chosen = size[last];
    for (size_t s = 0; s < sectors; s++) {
        const uint64_t random = draw(seed, ABOUT_SECTOR, node, s);
        count[s] = is_none_left(style, tenths) ? 0 : (unsigned)left_of(random, count[s], tenths);
        if (style != DISK_GARBAGE || count[s] || s * SECTOR < f->size) continue;
        for (size_t b = s * SECTOR; b < most && b < (s + 1) * SECTOR; b++)
            bytes[b] = (unsigned char)draw(seed, ABOUT_GARBAGE, node, b);
    }
    for (size_t c = 0; c < f->nchanges; c++) {
        size_t first, to;
        touched(f->change[c], &first, &to);
        for (size_t s = first; s < to && s < sectors; s++)
            if (++seen[s] <= count[s]) change_sector(bytes, f->change[c], s);
        if (f->change[c]->entry->kind == DISK_TRUNCATE && c < last && size[c + 1] < most)
            memset(bytes + size[c + 1], 0, most - size[c + 1]); /* whole, with the size */
    }
    free(size);
    free(count);
    free(seen);
    return bytes;
}

/* ---- building ---- */

typedef struct {
    const disk *d;
    uint64_t seed;
    const char *folder, *pool;
    bool (*changes)(const char *name);
} building;

static void write_file(const char *path, const unsigned char *bytes, size_t size)
{
    const int fd = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (fd < 0) end("create", path);
    for (size_t put = 0; put < size;) {
        const ssize_t more = write(fd, bytes + put, size - put);
        if (more <= 0) end("write", path);
        put += (size_t)more;
    }
    if (close(fd) < 0) end("close", path);
}

static void link_durable(const building *b, const disk_file *f, size_t node, const char *path)
{
    char pooled[PATH_MAX];
    snprintf(pooled, sizeof pooled, "%s/%zu-%llu", b->pool, node, (unsigned long long)f->version);
    if (access(pooled, F_OK) < 0) write_file(pooled, f->bytes, f->size);
    if (link(pooled, path) < 0) end("link to", path);
}

static void build(void *context, const char *path, const disk_name *name)
{
    const building *b = context;
    const disk_file *f = &b->d->file[name->node];
    char whole[PATH_MAX];
    size_t size = f->size;
    snprintf(whole, sizeof whole, "%s/%s", b->folder, path);
    if (f->folder) {
        if (mkdir(whole, 0755) < 0) end("create", whole);
        return;
    }
    unsigned char *bytes = f->nchanges ? choose_bytes(f, name->node, b->seed, &size) : NULL;
    const bool same = !bytes || (size == f->size && (!size || !memcmp(bytes, f->bytes, size)));
    if (b->pool && same && !b->changes(name->name)) link_durable(b, f, name->node, whole);
    else write_file(whole, bytes ? bytes : f->bytes, size);
    free(bytes);
}

void disk_build(const disk *d, uint64_t seed, const char *folder, const char *pool,
                bool (*changes)(const char *name))
{
    building b = {d, seed, folder, pool, changes};
    disk_names names = choose_names(d, seed);
    walk(d, &names, 0, "", build, &b);
    free(names.name);
}
