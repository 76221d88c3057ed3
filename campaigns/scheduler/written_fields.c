/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/written_fields.h"

#include "base/file.h"
#include "base/own.h"
#include "base/version.h"
#include "campaigns/file/chosen.h"
#include "campaigns/plan/point_model.h"
#include "campaigns/scheduler/replay.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/results.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Realizations of all points, by point. */
typedef struct {
    size_t n, *first; /* for each point, in `candidate` */
    fracas_candidate *candidate;
    const fracas_wanted_fields *wanted;
} candidates;

static fracas_err note(void *context, fracas_result *result)
{
    candidates *of = context;
    if (result->record.outcome == FRACAS_FAILED) return FRACAS_OK;
    of->candidate[of->n++] = (fracas_candidate){result->replica,
                                                fracas_fields_number(of->wanted, &result->record)};
    of->first[result->point + 1] = of->n;
    return FRACAS_OK;
}

/* ---- folders in STUDY/fields ---- */

#define MARK "fields.txt" /* in the folder of a realization: whose fields, of which instants */

enum { MARK_TEXT = 200 };

static void write_mark(const fracas_campaign *campaign, size_t point, int64_t replica,
                       char text[MARK_TEXT])
{
    snprintf(text, MARK_TEXT,
             "point %s replica %" PRId64 " every %.17g s %s %s fracas " FRACAS_VERSION "\n",
             fracas_hash_hex(&campaign->point[point].hash).text, replica, campaign->fields.every,
             campaign->fields.of->name, campaign->fields.by ? campaign->fields.by->name : "all");
}

/* The mark of a folder; "" if it has none. */
static fracas_err read_mark(const char *folder, char text[MARK_TEXT])
{
    OWNED char *path = NULL;
    text[0] = '\0';
    TRY(fracas_path(&path, "%s/" MARK, folder));
    FILE *in = fracas_file_stream(fracas_file_open(path), "r");
    if (!in) return FRACAS_OK;
    if (!fgets(text, MARK_TEXT, in)) text[0] = '\0';
    fclose(in);
    return FRACAS_OK;
}

static fracas_err put_mark(const char *path, const char *text)
{
    FILE *out = fracas_file_stream(fracas_file_create(path), "w");
    if (!out) return fracas_fail_system(errno, "cannot write %s", path);
    const bool bad = fputs(text, out) < 0;
    if (fclose(out) || bad) return fracas_fail_system(errno, "cannot write %s", path);
    return FRACAS_OK;
}

/* Removes parts left by a killed run, and marked folders of other points or instants, whose names
 * may belong to others now. */
static fracas_err tidy(void *context, const char *path, const char *name)
{
    const fracas_campaign *campaign = context;
    size_t point;
    int64_t replica;
    char found[MARK_TEXT], wanted[MARK_TEXT] = "";
    if (sscanf(name, "%zu-%" SCNd64, &point, &replica) != 2) return FRACAS_OK;
    TRY(read_mark(path, found));
    if (point < campaign->npoints) write_mark(campaign, point, replica, wanted);
    if (fracas_disk_ends(name, ".part") || (*found && strcmp(found, wanted) != 0))
        fracas_folder_remove(path);
    return FRACAS_OK;
}

/* ---- writing ---- */

static fracas_err sync_file(void *unused, const char *path, const char *name)
{
    (void)unused, (void)name;
    OWN_FD fd = fracas_file_open(path);
    return fd < 0 || fsync(fd) ? fracas_fail_system(errno, "cannot sync %s", path) : FRACAS_OK;
}

/* Durable on return: a renamed folder is whole, whatever happens to the machine. */
static fracas_err write_part(const char *study, const fracas_campaign *campaign, size_t point,
                             int64_t replica, const char *part)
{
    FRACAS_CLEARED(fracas_replay) replay = {0};
    const double every = campaign->fields.every;
    const fracas_fields_request request = {.folder = part,
                                           .every = every,
                                           .onset = !(every > 0),
                                           .peak = !(every > 0),
                                           .end = !(every > 0)};
    char mark[MARK_TEXT];
    OWNED char *within = NULL;
    TRY(fracas_path(&within, "%s/" MARK, part));
    TRY(fracas_replay_find(study, campaign, point, replica, &replay));
    TRY(fracas_replay_run(&replay, &request, NULL));
    write_mark(campaign, point, replica, mark);
    TRY(put_mark(within, mark));
    TRY(fracas_disk_each(part, sync_file, NULL));
    return fracas_disk_sync_folder(within);
}

/* Into a folder of another name first: STUDY/fields has whole ones. */
static fracas_err write_one(const char *study, const fracas_campaign *campaign, size_t point,
                            int64_t replica, FILE *out)
{
    OWNED char *folder = NULL, *part = NULL;
    struct stat there;
    TRY(fracas_path(&folder, "%s/fields/%zu-%" PRId64, study, point, replica));
    if (stat(folder, &there) == 0) return FRACAS_OK;
    TRY(fracas_path(&part, "%s.part", folder));
    fracas_err err = write_part(study, campaign, point, replica, part);
    if (!err && rename(part, folder)) err = fracas_fail_system(errno, "cannot rename %s", part);
    if (!err) err = fracas_disk_sync_folder(folder);
    if (err) fracas_folder_remove(part);
    else fprintf(out, "%s: fields of replica %" PRId64 " of point %zu\n", folder, replica, point);
    return err;
}

static fracas_err write_all(const char *study, const fracas_campaign *campaign,
                            fracas_results *results, FILE *out)
{
    const size_t most = fracas_results_realizations(results);
    OWNED fracas_candidate *candidate = calloc(most + 1, sizeof *candidate);
    OWNED size_t *first = calloc(campaign->npoints + 1, sizeof *first);
    OWNED int64_t *chosen = calloc(most + 1, sizeof *chosen);
    if (!candidate || !chosen || !first) return fracas_no_memory("the realizations of a study");
    candidates of = {0, first, candidate, &campaign->fields};
    TRY(fracas_results_walk(results, FRACAS_READ_FRAGMENTS, note, &of));
    for (size_t p = 0; p < campaign->npoints; p++) {
        if (first[p + 1] < first[p]) first[p + 1] = first[p]; /* all FAILED */
        const size_t count = fracas_fields_choose(&campaign->fields, candidate + first[p],
                                                  first[p + 1] - first[p], chosen);
        for (size_t k = 0; k < count; k++) TRY(write_one(study, campaign, p, chosen[k], out));
    }
    return FRACAS_OK;
}

static fracas_err write_locked(const char *study, const fracas_campaign *campaign, FILE *out)
{
    OWN(fracas_results) results = NULL;
    OWNED char *folder = NULL;
    TRY(fracas_results_open(study, &campaign->hash, &campaign->table, &results));
    if (fracas_results_partial(results)) return FRACAS_OK;
    TRY(fracas_path(&folder, "%s/fields", study));
    if (!fracas_folder_create(folder)) return fracas_fail_system(errno, "cannot make %s", folder);
    TRY(fracas_disk_each(folder, tidy, (void *)(uintptr_t)campaign));
    return write_all(study, campaign, results, out);
}

fracas_err fracas_written_fields(const char *study, const fracas_campaign *campaign, FILE *out)
{
    int lock;
    if (!fracas_fields_wanted(&campaign->fields)) return FRACAS_OK;
    TRY(fracas_study_lock(study, false, &lock));
    const fracas_err err = write_locked(study, campaign, out);
    fracas_study_unlock(lock);
    return err;
}

/* As many replicas of a point as are chosen of different counts. */
static fracas_err count_chosen(const fracas_campaign *campaign, size_t point, size_t *count)
{
    const size_t n = (size_t)fracas_point_most(&campaign->point[point]);
    OWNED fracas_candidate *candidate = calloc(n + 1, sizeof *candidate);
    OWNED int64_t *chosen = calloc(n + 1, sizeof *chosen);
    if (!candidate || !chosen) return fracas_no_memory("the realizations of a point");
    for (size_t r = 0; r < n; r++) candidate[r] = (fracas_candidate){(int64_t)r, (double)r};
    *count = fracas_fields_choose(&campaign->fields, candidate, n, chosen);
    return FRACAS_OK;
}

fracas_err fracas_written_fields_size(const fracas_campaign *campaign, fracas_planned_fields *size)
{
    enum { EVENTS = 3 };
    const double every = campaign->fields.every;
    *size = (fracas_planned_fields){0};
    if (!fracas_fields_wanted(&campaign->fields)) return FRACAS_OK;
    for (size_t p = 0; p < campaign->npoints; p++) {
        OWN(fracas_model) model = NULL;
        size_t count = 0;
        double bytes = 0;
        TRY(count_chosen(campaign, p, &count));
        TRY(fracas_point_model_create(campaign, p, &model));
        TRY(fracas_field_files_bytes(model, &bytes));
        const double end = campaign->point[p].spec.time.end,
                     steps = (double)fracas_model_steps(model),
                     instants = every > 0 ? fmin(floor(end / every), steps) + 1 : EVENTS;
        size->realizations += count;
        size->bytes += (double)count * instants * bytes;
    }
    return FRACAS_OK;
}
