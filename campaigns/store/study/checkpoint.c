/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/checkpoint.h"

#include "base/file.h"
#include "base/version.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/index/index.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

static const char mark[8] = "fracasCP";

struct fracas_checkpoint {
    int fd;
    uint64_t at;
    char *path, *temporary; /* temporary: NULL of one that is read, or finished */
};

static fracas_err name_of(const char *study, const fracas_hash *point, int64_t replica, char **path)
{
    return fracas_path(path, "%s/" FRACAS_CHECKPOINTS "/%s-%" PRId64, study,
                       fracas_hash_hex(point).text, replica);
}

static fracas_checkpoint_head head_of(const fracas_file_header *header, const fracas_hash *point,
                                      int64_t replica)
{
    fracas_checkpoint_head head = {.point = *point,
                                   .replica = replica,
                                   .seed = header->seed,
                                   .history = header->history,
                                   .interfaces = header->interfaces,
                                   .reactions = header->reactions};
    char probes[FRACAS_PROBES_TEXT];
    fracas_probes_write(&header->probes, probes);
    head.probes = fracas_hash_of(probes, strlen(probes));
    memcpy(head.mark, mark, sizeof mark);
    memcpy(head.version, header->version, sizeof head.version);
    return head;
}

void fracas_checkpoint_close(fracas_checkpoint *checkpoint)
{
    if (!checkpoint) return;
    if (checkpoint->fd >= 0) close(checkpoint->fd);
    if (checkpoint->temporary) unlink(checkpoint->temporary);
    free(checkpoint->temporary);
    free(checkpoint->path);
    free(checkpoint);
}

static fracas_err begin(const char *study, const fracas_hash *point, int64_t replica,
                        fracas_checkpoint **checkpoint)
{
    OWN(fracas_checkpoint) made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a checkpoint");
    made->fd = -1;
    TRY(name_of(study, point, replica, &made->path));
    *checkpoint = made;
    made = NULL;
    return FRACAS_OK;
}

/* ---- writing ---- */

fracas_err fracas_checkpoint_create(const char *study, const fracas_file_header *header,
                                    fracas_checkpoint_head *head, fracas_checkpoint **checkpoint)
{
    OWN(fracas_checkpoint) made = NULL;
    OWNED char *folder = NULL;
    fracas_checkpoint_head whole = head_of(header, &head->point, head->replica);
    whole.over = head->over;
    whole.steps = head->steps;
    whole.time = head->time;
    whole.end = head->end;
    TRY(begin(study, &head->point, head->replica, &made));
    TRY(fracas_disk_join(study, FRACAS_CHECKPOINTS, &folder));
    if (!fracas_folder_create(folder)) return fracas_disk_fail("create", folder);
    OWNED char *temporary = NULL;
    TRY(fracas_disk_temporary(made->path, &temporary));
    made->fd = fracas_file_create(temporary);
    if (made->fd < 0) return fracas_disk_fail("create", temporary);
    made->temporary = temporary;
    temporary = NULL;
    TRY(fracas_checkpoint_put(made, &whole, sizeof whole));
    *head = whole;
    *checkpoint = made;
    made = NULL;
    return FRACAS_OK;
}

fracas_err fracas_checkpoint_put(void *checkpoint, void *bytes, size_t size)
{
    fracas_checkpoint *c = checkpoint;
    if (!fracas_disk_write(c->fd, c->at, bytes, size)) return fracas_disk_fail("write", c->path);
    c->at += size;
    return FRACAS_OK;
}

fracas_err fracas_checkpoint_finish(fracas_checkpoint *checkpoint)
{
    fracas_checkpoint *c = checkpoint;
    TRY(fracas_disk_append_seal(c->fd, c->path));
    if (fsync(c->fd) < 0) return fracas_disk_fail("sync", c->path);
    if (rename(c->temporary, c->path) < 0) return fracas_disk_fail("rename to", c->path);
    free(c->temporary);
    c->temporary = NULL;
    return fracas_disk_sync_folder(c->path);
}

/* ---- reading ---- */

fracas_err fracas_checkpoint_get(void *checkpoint, void *bytes, size_t size)
{
    fracas_checkpoint *c = checkpoint;
    size_t got;
    if (!fracas_disk_read(c->fd, c->at, bytes, size, &got))
        return fracas_disk_fail("read", c->path);
    c->at += got;
    return got == size ? FRACAS_OK
                       : fracas_fail(FRACAS_DAMAGED, "%s: damaged: it is too short", c->path);
}

/* The same realization, program and output. */
static fracas_err check_head(const fracas_checkpoint *c, const fracas_checkpoint_head *found,
                             const fracas_checkpoint_head *wanted)
{
    if (memcmp(found->mark, wanted->mark, sizeof mark) != 0)
        return fracas_fail(FRACAS_DAMAGED, "%s: no checkpoint of fracas", c->path);
    if (strncmp(found->version, wanted->version, sizeof found->version) != 0)
        return fracas_fail(FRACAS_DAMAGED, "%s: of fracas %.31s, not %s", c->path, found->version,
                           wanted->version);
    if (!fracas_hash_equal(&found->point, &wanted->point) || found->replica != wanted->replica ||
        found->seed != wanted->seed || found->history != wanted->history ||
        found->interfaces != wanted->interfaces || found->reactions != wanted->reactions ||
        !fracas_hash_equal(&found->probes, &wanted->probes))
        return fracas_fail(FRACAS_DAMAGED, "%s: of another realization, seed or output", c->path);
    return FRACAS_OK;
}

fracas_err fracas_checkpoint_open(const char *study, const fracas_file_header *header,
                                  const fracas_hash *point, int64_t replica,
                                  fracas_checkpoint_head *head, fracas_checkpoint **checkpoint)
{
    const fracas_checkpoint_head wanted = head_of(header, point, replica);
    OWN(fracas_checkpoint) made = NULL;
    *checkpoint = NULL;
    TRY(begin(study, point, replica, &made));
    if (access(made->path, F_OK) < 0 && errno == ENOENT) return FRACAS_OK;
    TRY(fracas_disk_check_own_seal(made->path));
    TRY(fracas_disk_open(made->path, &made->fd));
    TRY(fracas_checkpoint_get(made, head, sizeof *head));
    TRY(check_head(made, head, &wanted));
    *checkpoint = made;
    made = NULL;
    return FRACAS_OK;
}

/* ---- the folder ---- */

void fracas_checkpoints_remove(const char *study, const fracas_segment_row *row, size_t count)
{
    OWNED char *folder = NULL;
    if (fracas_disk_join(study, FRACAS_CHECKPOINTS, &folder) || !fracas_folder_is_own(folder) ||
        access(folder, F_OK) < 0)
        return;
    for (size_t i = 0; i < count; i++) {
        OWNED char *path = NULL;
        if (!name_of(study, &row[i].point, row[i].replica, &path)) unlink(path);
    }
}

/* A name is 32 hexadecimal digits, '-' and a number. */
static bool read_name(const char *name, fracas_hash *point, int64_t *replica)
{
    char hex[FRACAS_HASH_HEX];
    int end = 0;
    snprintf(hex, sizeof hex, "%s", name);
    return fracas_hash_parse(hex, point) &&
           sscanf(name + strlen(hex), "-%" SCNd64 "%n", replica, &end) == 1 && *replica >= 0 &&
           !name[strlen(hex) + (size_t)end];
}

static fracas_err remove_ours(void *context, const char *path, const char *name)
{
    fracas_hash point;
    int64_t replica;
    (void)context;
    if (fracas_disk_is_temporary(name) || read_name(name, &point, &replica)) unlink(path);
    return FRACAS_OK;
}

void fracas_checkpoints_end(const char *study)
{
    OWNED char *folder = NULL;
    if (!fracas_disk_join(study, FRACAS_CHECKPOINTS, &folder) && fracas_folder_is_own(folder) &&
        !fracas_disk_each(folder, remove_ours, NULL))
        rmdir(folder);
}

typedef struct {
    const char *study;
    const fracas_file_header *header;
    fracas_index *index;
    FILE *report;
} sweeping;

/* *why: a reason to remove a file, "" if there is none. */
static fracas_err judge(const sweeping *s, const char *path, const char *name, char why[1024])
{
    fracas_hash point;
    fracas_row_place place;
    int64_t replica;
    OWN(fracas_checkpoint) file = NULL;
    fracas_checkpoint_head head;
    *why = '\0';
    if (fracas_disk_is_temporary(name)) {
        snprintf(why, 1024, "removed %s, half written", path);
        return FRACAS_OK;
    }
    if (!read_name(name, &point, &replica)) return FRACAS_OK;
    fracas_err err = fracas_index_place(s->index, &point, replica, &place);
    if (err == FRACAS_DAMAGED || (!err && place.segment)) {
        snprintf(why, 1024, "removed %s, no longer needed", path);
        return FRACAS_OK;
    }
    TRY(err);
    err = fracas_checkpoint_open(s->study, s->header, &point, replica, &head, &file);
    if (err != FRACAS_DAMAGED) return err;
    snprintf(why, 1024, "%s; it is removed, and its realization computed from the start",
             fracas_message());
    return FRACAS_OK;
}

static fracas_err sweep_one(void *context, const char *path, const char *name)
{
    const sweeping *s = context;
    char why[1024];
    TRY(judge(s, path, name, why));
    if (!*why) return FRACAS_OK;
    if (unlink(path) < 0 && errno != ENOENT) return fracas_disk_fail("remove", path);
    fprintf(s->report, "%s\n", why);
    return FRACAS_OK;
}

fracas_err fracas_checkpoints_sweep(const char *study, const fracas_file_header *header,
                                    fracas_index *index, FILE *report)
{
    OWNED char *folder = NULL;
    TRY(fracas_disk_join(study, FRACAS_CHECKPOINTS, &folder));
    if (!fracas_folder_is_own(folder)) return fracas_disk_fail("remove files of", folder);
    return fracas_disk_each(folder, sweep_one, &(sweeping){study, header, index, report});
}

typedef struct {
    fracas_err (*visit)(void *context, const fracas_checkpoint_head *head, double age);
    void *context;
} visiting;

static fracas_err visit_one(void *context, const char *path, const char *name)
{
    const visiting *v = context;
    fracas_checkpoint_head head;
    struct stat info;
    size_t got;
    OWN_FD fd = fracas_disk_is_temporary(name) ? -1 : fracas_file_open(path);
    if (fd < 0 || fstat(fd, &info) < 0 || !fracas_disk_read(fd, 0, &head, sizeof head, &got) ||
        got < sizeof head || memcmp(head.mark, mark, sizeof mark) != 0 ||
        strncmp(head.version, FRACAS_VERSION, sizeof head.version) != 0)
        return FRACAS_OK; /* nobody's, or gone meanwhile */
    return v->visit(v->context, &head, difftime(time(NULL), info.st_mtime));
}

fracas_err fracas_checkpoints_each(const char *study,
                                   fracas_err (*visit)(void *context,
                                                       const fracas_checkpoint_head *head,
                                                       double age),
                                   void *context)
{
    OWNED char *folder = NULL;
    TRY(fracas_disk_join(study, FRACAS_CHECKPOINTS, &folder));
    return fracas_disk_each(folder, visit_one, &(visiting){visit, context});
}
