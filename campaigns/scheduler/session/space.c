/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/space.h"

#include "base/terminal.h"
#include "campaigns/plan/plan.h"
#include "campaigns/plan/point_model.h"
#include "campaigns/plan/size.h"
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/store/index.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/statvfs.h>

/* Checks the options, the same for all points, by one batch. */
static fracas_err try_batch(const fracas_model *model, const fracas_run_options *options)
{
    OWN(fracas_batch) batch = NULL;
    fracas_batch_options batch_options = {.width = options->width, .isa = options->isa};
    return fracas_batch_create(model, 1, &batch_options, &batch);
}

static fracas_err find_cost(const fracas_campaign *campaign, size_t point,
                            const fracas_run_options *options, fracas_plan_words *words,
                            double *cost, double *bytes)
{
    OWN(fracas_model) model = NULL;
    const fracas_err err = fracas_point_model_create(campaign, point, &model);
    if (err) return fracas_fail_within(err, "point %zu", point);
    if (point == 0) TRY(try_batch(model, options));
    return fracas_plan_cost_with(campaign, point, model, words, cost, bytes);
}

static void say_unbroken(const fracas_plan_words *words)
{
    char text[sizeof words->first + 64];
    if (words->unbroken == 1) snprintf(text, sizeof text, "%s", words->first);
    else
        snprintf(text, sizeof text, "%zu points break nothing, the first, %s", words->unbroken,
                 words->first);
    fracas_plan_words_say(words, text);
}

fracas_err fracas_costs_create(const fracas_campaign *campaign, const fracas_run_options *options,
                               FILE *warn, double **cost, double **bytes)
{
    OWNED double *c = malloc(campaign->npoints * sizeof *c);
    OWNED double *b = malloc(campaign->npoints * sizeof *b);
    FILE *out = options->quiet ? NULL : warn;
    fracas_plan_words words = {.out = out};
    if (out && !options->wide) words.columns = fracas_terminal_of(fileno(out)).columns;
    if (!c || !b) return fracas_no_memory("the plan");
    for (size_t i = 0; i < campaign->npoints; i++)
        TRY(find_cost(campaign, i, options, out ? &words : NULL, &c[i], &b[i]));
    if (words.unbroken > 0) say_unbroken(&words);
    *cost = c;
    c = NULL;
    if (!bytes) return FRACAS_OK;
    *bytes = b;
    b = NULL;
    return FRACAS_OK;
}

/* Disk of the folder, or of its first existing ancestor. */
static bool find_disk(const char *study, struct statvfs *disk)
{
    char path[4096];
    snprintf(path, sizeof path, "%s", study);
    while (statvfs(path, disk)) {
        char *slash = strrchr(path, '/');
        if (slash && slash != path) *slash = '\0';
        else if (strcmp(path, ".") && strcmp(path, "/")) strcpy(path, slash ? "/" : ".");
        else return false;
    }
    return true;
}

/* Realizations done in a study begun before, and bytes of one; 0 and silent for a damaged index. */
static void read_progress(const char *study, double *done, double *bytes)
{
    OWN(fracas_index) index = NULL;
    fracas_index_counts counts;
    *done = *bytes = 0;
    if (!fracas_index_exists(study) || fracas_index_open(study, false, &index)) return;
    if (!fracas_index_count(index, &counts) && counts.realizations > 0) {
        *done = (double)(counts.done + counts.failed);
        if (counts.done) *bytes = (double)counts.bytes / (double)counts.done;
    }
}

fracas_err fracas_space_check(const char *study, const fracas_campaign *campaign,
                              const fracas_run_options *options, const double *bytes)
{
    enum { EMPTY = 400000, ROW = 300, FILES = 64 }; /* bytes: small file, row of the index; files */
    struct statvfs disk;
    double planned = 0, all = 0, done, measured;
    char need[FRACAS_SIZE_TEXT], segments[FRACAS_SIZE_TEXT], merged[FRACAS_SIZE_TEXT],
        have[FRACAS_SIZE_TEXT];
    if (options->ignore_space || !find_disk(study, &disk)) return FRACAS_OK;
    for (size_t p = 0; p < campaign->npoints; p++) {
        planned += (double)campaign->table.point[p].replicas;
        all += (double)campaign->table.point[p].replicas * bytes[p];
    }
    read_progress(study, &done, &measured);
    const double part = options->parts > 1 ? 1.0 / options->parts : 1.0;
    const double left = fmax(0, planned * part - done), each = fmax(measured, all / planned);
    const double in_segments =
        left > 0 ? left * (each + ROW) + EMPTY * fmin(left, fmax(1, options->jobs)) : 0;
    const double in_merged = options->parts > 1 ? 0 : all + EMPTY + fracas_copy_bytes(campaign),
                 room = (double)disk.f_bavail * (double)disk.f_frsize;
    if (in_segments + in_merged > room)
        return fracas_fail(
            FRACAS_ENVIRONMENT,
            "%s will need about %s (segments of %.0f realizations %s, study.h5 %s), but its disk "
            "has %s free; free some space, choose another --study, keep less (output.history, "
            "output.interfaces), or start all the same with --ignore-space",
            study, fracas_size_write(in_segments + in_merged, need), left,
            fracas_size_write(in_segments, segments), fracas_size_write(in_merged, merged),
            fracas_size_write(room, have));
    struct rlimit limit;
    if (!getrlimit(RLIMIT_FSIZE, &limit) && limit.rlim_cur != RLIM_INFINITY &&
        in_merged > (double)limit.rlim_cur)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "%s/study.h5 will have about %s, but a file may have %s; raise the "
                           "limit (`ulimit -f`), or start all the same with --ignore-space",
                           study, fracas_size_write(in_merged, merged),
                           fracas_size_write((double)limit.rlim_cur, have));
    if (disk.f_files > 0 && left > 0 && (double)disk.f_favail < FILES + fmin(left, options->jobs))
        return fracas_fail(
            FRACAS_ENVIRONMENT,
            "the disk of %s has room for %llu more files (`df -i`), a study needs %d and more; "
            "remove some, choose another --study, or start all the same with --ignore-space",
            study, (unsigned long long)disk.f_favail, FILES + (int)fmin(left, options->jobs));
    return FRACAS_OK;
}
