/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/support/power_truth.h"

#include "campaigns/store/datafile.h"
#include "campaigns/store/pack.h"

#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void end(const char *what)
{
    fprintf(stderr, "power_loss: %s\n", what);
    exit(2);
}

static void *checked(void *memory)
{
    if (!memory) end("no memory");
    return memory;
}

/* ---- records ---- */

typedef struct {
    power_line line;
    fracas_record record;
} known_record;

typedef struct {
    const fracas_point_table *table;
    known_record *known;
    size_t count;
    power_file *file;
} reading;

static void name_row(const reading *r, const fracas_result *result, power_line line)
{
    snprintf(line, POWER_LINE, "%s %lld",
             fracas_hash_hex(&r->table->point[result->point].hash).text,
             (long long)result->replica);
}

static fracas_err keep(void *context, fracas_result *result)
{
    reading *r = context;
    r->known = checked(realloc(r->known, (r->count + 1) * sizeof *r->known));
    known_record *k = &r->known[r->count++];
    name_row(r, result, k->line);
    k->record = result->record;
    fracas_record_init(&result->record); /* its rows are ours now */
    return FRACAS_OK;
}

static fracas_err compare(void *context, fracas_result *result)
{
    reading *r = context;
    power_file *f = r->file;
    name_row(r, result, f->row[f->nrows]);
    for (size_t k = 0; k < r->count; k++)
        if (strcmp(r->known[k].line, f->row[f->nrows]) == 0 &&
            !fracas_record_same(&r->known[k].record, &result->record))
            return fracas_fail(FRACAS_DAMAGED, "%s: %s is not as in the undisturbed study", f->name,
                               f->row[f->nrows]);
    f->nrows++;
    return FRACAS_OK;
}

static void read_file(const char *path, reading *r, fracas_result_visit *visit)
{
    OWN(fracas_reader) reader = NULL;
    fracas_err err = fracas_reader_open(path, &reader);
    if (!err) {
        r->table = fracas_reader_points(reader);
        if (r->file)
            r->file->row = checked(
                calloc(fracas_reader_realizations(reader) + 1, sizeof *r->file->row));
        err = fracas_reader_each(reader, FRACAS_READ_ALL, visit, r);
    }
    if (err) end(fracas_message());
}

/* ---- files ---- */

/* The name of a whole file. */
static bool is_of_interest(const char *name)
{
    const size_t length = strlen(name);
    return name[0] != '.' && strcmp(name + (length < 4 ? 0 : length - 4), ".tmp") != 0;
}

static void add_file(power_truth *truth, const disk *d, const char *name, uint64_t number)
{
    const size_t node = disk_node(d, number);
    truth->file = checked(realloc(truth->file, (truth->nfiles + 1) * sizeof *truth->file));
    power_file *f = &truth->file[truth->nfiles++];
    *f = (power_file){0};
    snprintf(f->name, sizeof f->name, "%s", name);
    f->bytes = disk_latest(d, node, &f->size);
}

static bool is_segment(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot && strcmp(dot, ".h5") == 0 && strcmp(name, "study.h5") != 0;
}

static void read_segment(power_file *f, reading *reference, const char *folder)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/scratch.h5", folder);
    const int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (fd < 0 || write(fd, f->bytes, f->size) != (ssize_t)f->size)
        end("cannot write a scratch file");
    close(fd);
    reference->file = f;
    read_file(path, reference, compare);
    unlink(path);
}

void power_truth_make(const disk_log *log, const char *reference, const char *folder,
                      power_truth *truth)
{
    reading r = {0};
    disk *d = disk_create(log->root);
    *truth = (power_truth){.reference = reference};
    read_file(reference, &r, keep);
    for (size_t c = 0; c < log->count; c++) {
        const disk_change *change = &log->change[c];
        disk_apply(d, change);
        if (change->entry->kind == DISK_UNKNOWN) end("the log has a call that the model has not");
        const bool renamed = change->entry->kind == DISK_RENAME;
        const char *name = renamed ? change->other : change->name;
        if ((renamed || change->entry->kind == DISK_LINK) && is_of_interest(name))
            add_file(truth, d, name, change->entry->node);
    }
    for (size_t f = 0; f < truth->nfiles; f++)
        if (is_segment(truth->file[f].name)) read_segment(&truth->file[f], &r, folder);
    for (size_t k = 0; k < r.count; k++) fracas_record_clear(&r.known[k].record);
    free(r.known);
    disk_destroy(d);
}

const power_file *power_truth_next(const power_truth *truth, const char *name,
                                   const power_file *from)
{
    for (size_t f = from ? (size_t)(from - truth->file) + 1 : 0; f < truth->nfiles; f++)
        if (strcmp(truth->file[f].name, name) == 0) return &truth->file[f];
    return NULL;
}

/* Inodes of files with the right bytes, never changed in place. */
static struct {
    uint64_t node;
    size_t size;
} right[4096];

bool power_truth_has(const power_truth *truth, const char *name, const char *path)
{
    struct stat info;
    bool has = false;
    if (stat(path, &info) < 0) return false;
    const size_t size = (size_t)info.st_size, slot = info.st_ino % 4096;
    if (info.st_nlink > 1 && right[slot].node == info.st_ino && right[slot].size == size)
        return true;
    unsigned char *bytes = checked(malloc(size + 1));
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    const bool whole = fd >= 0 && read(fd, bytes, size) == (ssize_t)size;
    if (fd >= 0) close(fd);
    for (const power_file *f = NULL; whole && (f = power_truth_next(truth, name, f));)
        has = has || (f->size == size && memcmp(f->bytes, bytes, size) == 0);
    free(bytes);
    if (has) right[slot].node = info.st_ino, right[slot].size = size;
    return has;
}

/* ---- promises ---- */

static int by_text(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static char **lines_of(const char *text, size_t *count)
{
    size_t most = 1;
    for (const char *c = text; *c; c++) most += *c == '\n';
    char **line = checked(malloc(most * sizeof *line + strlen(text) + 1));
    char *copy = strcpy((char *)(line + most), text);
    *count = 0;
    for (char *one = strtok(copy, "\n"); one; one = strtok(NULL, "\n"))
        if (strncmp(one, "study.h5 ", 9) != 0 || one[9])
            line[(*count)++] = one; /* a seal, or none */
    qsort(line, *count, sizeof *line, by_text);
    return line;
}

static bool is_promise(const disk_change *c, const char *study)
{
    const size_t length = strlen(study);
    return c->entry->kind == DISK_PROMISE && strncmp(c->other, study, length) == 0 &&
           c->other[length] == '/';
}

char **power_promised(const disk_log *log, const char *study, size_t at, size_t *count)
{
    size_t before = at, after = at, nlater, left = 0;
    while (before > 0 && !is_promise(&log->change[before - 1], study)) before--;
    while (after < log->count && !is_promise(&log->change[after], study)) after++;
    char **line = lines_of(before ? log->change[before - 1].name : "", count);
    if (after == log->count) return line;
    char **later = lines_of(log->change[after].name, &nlater);
    for (size_t l = 0; l < *count; l++)
        if (bsearch(&line[l], later, nlater, sizeof *later, by_text)) line[left++] = line[l];
    *count = left;
    free(later);
    return line;
}
