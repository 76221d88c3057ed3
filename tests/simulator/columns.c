/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5's stand-in (campaigns/store/file/h5.h): a file is a list of objects with attributes and
 * rows, kept in memory and written whole when it is closed. The writer and the reader above are
 * the real ones. */
#include "base/file.h"
#include "base/own.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/file/h5.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_FILES = 65536, MOST_OBJECTS = 2048, NAME = 256 };

/* A group or a dataset, or an attribute: "OBJECT@NAME". */
typedef struct {
    char *name;
    unsigned char *bytes;
    size_t size, room;
    uint64_t rows;
} object;

typedef struct {
    object object[MOST_OBJECTS];
    size_t count;
    uint16_t place[2 * MOST_OBJECTS]; /* by a hash of the name: number of an object from 1 on */
    const char *point[MOST_OBJECTS];  /* names below /point, sorted */
    size_t npoints;
} columns;

static columns *file[MOST_FILES];
static const unsigned char mark[8] = {0x89, 'f', 'a', 'r', 'm', '\r', '\n', 0x1a};

static columns *of(const fracas_h5 *h5)
{
    return file[h5->id];
}

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

/* Where an object of this name is, or would be. */
static uint16_t *place_of(columns *all, const char *name)
{
    uint32_t hash = 2166136261u;
    for (const char *c = name; *c; c++) hash = (hash ^ (unsigned char)*c) * 16777619u;
    for (uint32_t i = hash;; i++) {
        uint16_t *at = &all->place[i % (2 * MOST_OBJECTS)];
        if (!*at || !strcmp(all->object[*at - 1].name, name)) return at;
    }
}

static object *find(const fracas_h5 *h5, const char *name)
{
    columns *all = of(h5);
    const uint16_t at = *place_of(all, name);
    return at ? &all->object[at - 1] : NULL;
}

static object *add(const fracas_h5 *h5, const char *name)
{
    columns *all = of(h5);
    if (all->count == MOST_OBJECTS) abort();
    object *o = &all->object[all->count++];
    *o = (object){.name = need(strdup(name))};
    *place_of(all, name) = (uint16_t)all->count;
    if (!strncmp(name, "/point/", 7) && !strchr(name, '@')) all->point[all->npoints++] = o->name;
    return o;
}

static void append(object *o, const void *bytes, size_t size)
{
    if (o->size + size > o->room) {
        o->room = 2 * (o->size + size);
        o->bytes = need(realloc(o->bytes, o->room));
    }
    if (size) memcpy(o->bytes + o->size, bytes, size);
    o->size += size;
}

static void name_attribute(char *text, const char *where, const char *name)
{
    if (snprintf(text, NAME, "%s@%s", where, name) >= NAME) abort();
}

fracas_err __wrap_fracas_h5_fail(const fracas_h5 *h5, const char *what)
{
    if (h5->error)
        return fracas_fail_system(h5->error, "cannot %s %s (%s)", h5->writing ? "write" : "read",
                                  h5->path, what);
    return fracas_fail(FRACAS_DAMAGED, "%s: %s: damaged, or no file of fracas", h5->path, what);
}

/* ---- files ---- */

static fracas_err begin(fracas_h5 *h5, int fd, const char *path, bool writing)
{
    static hid_t next;
    *h5 = (fracas_h5){.id = -1, .driver = -1, .fd = fd, .writing = writing, .path = path};
    if (fd < 0) return fracas_disk_fail("open", path);
    for (hid_t n = 0; n < MOST_FILES; n++) {
        h5->id = (next + n) % MOST_FILES;
        if (!file[h5->id]) break;
    }
    next = h5->id + 1;
    file[h5->id] = need(calloc(1, sizeof(columns)));
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_create(fracas_h5 *h5, const char *name, const char *path)
{
    return begin(h5, fracas_file_create(name), path, true);
}

/* The bytes of a file: its mark, then name, rows, size and bytes of each object. */
static void take(object *out, const object *o)
{
    const uint64_t head[3] = {strlen(o->name), o->rows, o->size};
    append(out, head, sizeof head);
    append(out, o->name, strlen(o->name));
    append(out, o->bytes, o->size);
}

fracas_err __wrap_fracas_h5_flush_close(fracas_h5 *h5)
{
    object out = {0};
    append(&out, mark, sizeof mark);
    for (size_t i = 0; i < of(h5)->count; i++) take(&out, &of(h5)->object[i]);
    const size_t half = out.size / 2;
    if (!fracas_disk_write(h5->fd, 0, out.bytes, half) ||
        !fracas_disk_write(h5->fd, half, out.bytes + half, out.size - half))
        h5->error = errno;
    free(out.bytes);
    return h5->error ? __wrap_fracas_h5_fail(h5, "the file") : FRACAS_OK;
}

static bool give(const fracas_h5 *h5, const object *in, size_t *at)
{
    uint64_t head[3];
    char name[NAME] = "";
    if (in->size - *at < sizeof head) return false;
    memcpy(head, in->bytes + *at, sizeof head);
    *at += sizeof head;
    if (head[0] >= sizeof name || in->size - *at < head[0] || in->size - *at - head[0] < head[2])
        return false;
    memcpy(name, in->bytes + *at, head[0]);
    *at += head[0];
    object *o = add(h5, name);
    o->rows = head[1];
    append(o, in->bytes + *at, head[2]);
    *at += head[2];
    return true;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

fracas_err __wrap_fracas_h5_open(fracas_h5 *h5, const char *path)
{
    int fd;
    object in = {0};
    unsigned char block[4096];
    size_t got = sizeof block, at = sizeof mark;
    *h5 = FRACAS_H5_CLOSED;
    TRY(fracas_disk_open(path, &fd));
    TRY(begin(h5, fd, path, false));
    while (got == sizeof block) {
        if (!fracas_disk_read(fd, in.size, block, sizeof block, &got)) abort();
        append(&in, block, got);
    }
    bool good = in.size >= sizeof mark && !memcmp(in.bytes, mark, sizeof mark);
    if (good && in.size >= FRACAS_OWN_SEAL &&
        !memcmp(in.bytes + in.size - FRACAS_OWN_SEAL, "fracas segment", 14))
        in.size -= FRACAS_OWN_SEAL;
    while (good && at < in.size) good = give(h5, &in, &at);
    h5->bytes = in.size;
    qsort(of(h5)->point, of(h5)->npoints, sizeof(char *), by_name);
    free(in.bytes);
    return good ? FRACAS_OK : __wrap_fracas_h5_fail(h5, "the file");
}

void __wrap_fracas_h5_close(fracas_h5 *h5)
{
    if (h5->id >= 0) {
        columns *all = of(h5);
        for (size_t i = 0; i < all->count; i++) {
            free(all->object[i].name);
            free(all->object[i].bytes);
        }
        free(all);
        file[h5->id] = NULL;
    }
    if (h5->fd >= 0) close(h5->fd);
    *h5 = FRACAS_H5_CLOSED;
}

/* ---- attributes and groups ---- */

static fracas_err put(const fracas_h5 *h5, const char *where, const char *name, const void *bytes,
                      size_t size)
{
    char text[NAME];
    name_attribute(text, where, name);
    append(add(h5, text), bytes, size);
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_put_text(const fracas_h5 *h5, const char *where, const char *name,
                                     const char *text)
{
    return put(h5, where, name, text, strlen(text));
}

fracas_err __wrap_fracas_h5_put_integer(const fracas_h5 *h5, const char *where, const char *name,
                                        hid_t type, uint64_t value)
{
    (void)type;
    return put(h5, where, name, &value, sizeof value);
}

static object *attribute(const fracas_h5 *h5, const char *where, const char *name)
{
    char text[NAME];
    name_attribute(text, where, name);
    return find(h5, text);
}

fracas_err __wrap_fracas_h5_get_text(const fracas_h5 *h5, const char *where, const char *name,
                                     char **text)
{
    const object *o = attribute(h5, where, name);
    *text = NULL;
    if (!o) return __wrap_fracas_h5_fail(h5, name);
    *text = need(calloc(1, o->size + 1));
    if (o->size) memcpy(*text, o->bytes, o->size);
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_has_attribute(const fracas_h5 *h5, const char *where, const char *name,
                                          bool *has)
{
    *has = attribute(h5, where, name) != NULL;
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_get_integer(const fracas_h5 *h5, const char *where, const char *name,
                                        hid_t type, uint64_t *value)
{
    const object *o = attribute(h5, where, name);
    (void)type;
    if (!o || o->size != sizeof *value) return __wrap_fracas_h5_fail(h5, name);
    memcpy(value, o->bytes, sizeof *value);
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_create_group(const fracas_h5 *h5, const char *path)
{
    add(h5, path);
    return FRACAS_OK;
}

htri_t __wrap_H5Lexists(hid_t id, const char *path, hid_t list)
{
    const fracas_h5 h5 = {.id = id};
    (void)list;
    return find(&h5, path) != NULL;
}

fracas_err __wrap_fracas_h5_link_names(const fracas_h5 *h5, const char *group, size_t most,
                                       char **name, size_t *count)
{
    const columns *of = file[h5->id];
    for (*count = 0; *count < of->npoints; ++*count) {
        if (*count == most) return __wrap_fracas_h5_fail(h5, group);
        name[*count] = strdup(of->point[*count] + strlen("/point/"));
        if (!name[*count]) return fracas_no_memory("the names of a group");
    }
    return FRACAS_OK;
}

/* ---- datasets: their handle is their place in the list ---- */

fracas_err __wrap_fracas_h5_text_width(const fracas_h5 *h5, const char *path, size_t *width)
{
    const object *o = find(h5, path);
    *width = 0;
    if (!o) return __wrap_fracas_h5_fail(h5, path);
    const object *text = attribute(h5, path, "width");
    if (text && text->size) memcpy(width, text->bytes, sizeof *width);
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_create_column(const fracas_h5 *h5, const fracas_store_column *column,
                                          size_t chunk, hid_t *dataset)
{
    (void)chunk;
    *dataset = (hid_t)of(h5)->count;
    add(h5, column->path);
    TRY(__wrap_fracas_h5_put_text(h5, column->path, "unit", column->unit));
    TRY(__wrap_fracas_h5_put_text(h5, column->path, "description", column->description));
    const uint64_t width = column->type == FRACAS_TEXT ? column->width : 0;
    return put(h5, column->path, "width", &width, sizeof width);
}

fracas_err __wrap_fracas_h5_open_column(const fracas_h5 *h5, const fracas_store_column *column,
                                        size_t chunk, hid_t *dataset, uint64_t *rows)
{
    const object *o = find(h5, column->path);
    (void)chunk;
    *dataset = -1;
    if (!o || o->size != o->rows * fracas_stored_size(column))
        return __wrap_fracas_h5_fail(h5, column->path);
    *dataset = o - of(h5)->object;
    *rows = o->rows;
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_append_rows(const fracas_h5 *h5, const fracas_store_column *column,
                                        hid_t dataset, uint64_t start, size_t count,
                                        const void *stored)
{
    object *o = &of(h5)->object[dataset];
    if (start != o->rows) abort();
    append(o, stored, count * fracas_stored_size(column));
    o->rows += count;
    return FRACAS_OK;
}

fracas_err __wrap_fracas_h5_read_rows(const fracas_h5 *h5, const fracas_store_column *column,
                                      hid_t dataset, uint64_t start, size_t count, void *stored)
{
    const object *o = &of(h5)->object[dataset];
    const size_t row = fracas_stored_size(column);
    if ((start + count) * row > o->size) return __wrap_fracas_h5_fail(h5, column->path);
    memcpy(stored, o->bytes + start * row, count * row);
    return FRACAS_OK;
}

void __wrap_fracas_h5_let_go(const hid_t *id)
{
    (void)id;
}
