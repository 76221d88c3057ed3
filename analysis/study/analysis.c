#include "analysis/study/study.h"

#include "analysis/tables/format.h"

#include <errno.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The last part of the folder's real path, so that "." has a name too. */
static fracas_err name_of(const char *study, char **name)
{
    char *path = realpath(study, NULL);
    if (!path)
        return fracas_fail(FRACAS_DAMAGED, "%s: %s; name the folder of a study", study, strerror(errno));
    *name = strdup(basename(path));
    free(path);
    return *name ? FRACAS_OK : fracas_no_memory("the name of the study");
}

fracas_err fracas_analysis_open(const char *study, fracas_reader **reader)
{
    char *path = malloc(strlen(study) + sizeof "/study.h5");
    if (!path) return fracas_no_memory("a path");
    strcat(strcpy(path, study), "/study.h5");
    fracas_err err = FRACAS_OK;
    if (access(path, F_OK))
        err = fracas_fail(FRACAS_DAMAGED, "%s is not there; `fracas run` makes it", path);
    if (!err) err = fracas_reader_open(path, reader);
    free(path);
    return err;
}

static fracas_err read_realizations(fracas_analysis *analysis)
{
    fracas_record record;
    fracas_record_init(&record);
    fracas_err err = FRACAS_OK;
    size_t rows = fracas_reader_realizations(analysis->reader);
    for (size_t row = 0; row < rows && !err; row++) {
        size_t point;
        int64_t replica;
        err = fracas_reader_record(analysis->reader, row, FRACAS_READ_FRAGMENTS, &point, &replica, &record);
        if (!err) err = fracas_point_statistics_add(&analysis->point[point], row, replica, &record);
        fracas_record_clear(&record);
    }
    return err;
}

/* The energies over time of each point's realizations together, and of its typical replica. */
static fracas_err read_histories(fracas_analysis *analysis)
{
    fracas_record record;
    fracas_record_init(&record);
    fracas_err err = FRACAS_OK;
    for (size_t p = 0; p < analysis->table->npoints && !err; p++) {
        fracas_point_statistics *statistics = &analysis->point[p];
        if (statistics->typical_replica < 0) continue;
        TRY(fracas_bands_read(analysis->reader, &statistics->ensemble, fracas_columns_real(analysis->table, p, "time.end"),
                              &statistics->bands));
        size_t point;
        int64_t replica;
        err = fracas_reader_record(analysis->reader, statistics->typical_row, FRACAS_READ_HISTORY, &point, &replica,
                                   &record);
        if (!err) {
            statistics->history = record.history;
            statistics->nhistory = record.nhistory;
            record.history = NULL;
        }
        fracas_record_clear(&record);
    }
    return err;
}

/* Keeps the last decision of each point: the file has them by point and round. */
static fracas_err read_decisions(fracas_analysis *analysis)
{
    fracas_decision *all;
    size_t count;
    TRY(fracas_reader_decisions(analysis->reader, &all, &count));
    if (count > 0) analysis->decision = calloc(analysis->table->npoints, sizeof *analysis->decision);
    for (size_t d = 0; analysis->decision && d < count; d++) analysis->decision[all[d].point] = all[d];
    free(all);
    return count > 0 && !analysis->decision ? fracas_no_memory("the decisions of the study") : FRACAS_OK;
}

static fracas_err analyse(const char *study, fracas_analysis *analysis)
{
    TRY(name_of(study, &analysis->name));
    TRY(fracas_analysis_open(study, &analysis->reader));
    analysis->header = *fracas_reader_header(analysis->reader);
    analysis->table = fracas_reader_points(analysis->reader);
    size_t npoints = analysis->table->npoints;
    analysis->point = calloc(npoints + 1, sizeof *analysis->point);
    if (!analysis->point) return fracas_no_memory("the points of the study");
    for (size_t p = 0; p < npoints; p++) fracas_point_statistics_init(analysis->table, p, &analysis->point[p]);
    TRY(fracas_columns_create(analysis->table, &analysis->shown));
    TRY(read_decisions(analysis));
    TRY(read_realizations(analysis));
    for (size_t p = 0; p < npoints; p++) TRY(fracas_point_statistics_finish(&analysis->point[p]));
    return read_histories(analysis);
}

fracas_err fracas_analysis_create(const char *study, fracas_analysis **analysis)
{
    *analysis = NULL;
    fracas_analysis *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("an analysis");
    fracas_err err = analyse(study, made);
    if (err) fracas_analysis_destroy(made);
    else *analysis = made;
    return err;
}

void fracas_analysis_destroy(fracas_analysis *analysis)
{
    if (!analysis) return;
    if (analysis->point)
        for (size_t p = 0; p < analysis->table->npoints; p++) fracas_point_statistics_clear(&analysis->point[p]);
    free(analysis->point);
    free(analysis->decision);
    fracas_columns_clear(&analysis->shown);
    fracas_reader_close(analysis->reader);
    free(analysis->name);
    free(analysis);
}

void fracas_analysis_label(const fracas_analysis *analysis, size_t point, char *text, size_t size)
{
    fracas_columns_label(analysis->table, &analysis->shown, point, text, size);
}

const fracas_decision *fracas_analysis_decision(const fracas_analysis *analysis, size_t point)
{
    return analysis->decision && analysis->decision[point].replicas > 0 ? &analysis->decision[point] : NULL;
}

const char *fracas_analysis_quantity(const fracas_decision *decision)
{
    static const char *const name[] = {"mean-count", "mean-size", "dissipated"};
    return name[decision->quantity]; /* the reader lets no other through */
}

bool fracas_analysis_decided(const fracas_analysis *analysis, size_t point, char *text, size_t size)
{
    const fracas_decision *last = fracas_analysis_decision(analysis, point);
    if (!last) return false;
    char label[256], found[32];
    fracas_analysis_label(analysis, point, label, sizeof label);
    fracas_format_beside(100 * fracas_decision_relative(last), 100 * last->relative_half_width, found, sizeof found);
    snprintf(text, size, "%s%s%lld replicas in %lld round%s: half width of the %.4g %% interval of %s %s %%, %.3g %% asked for%s", label,
             *label ? ": " : "", (long long)last->replicas, (long long)last->round + 1, last->round ? "s" : "", 100 * last->confidence,
             fracas_analysis_quantity(last), found, 100 * last->relative_half_width, last->stop == 2 ? " (maximum)" : "");
    return true;
}

bool fracas_analysis_any_surface(const fracas_analysis *analysis)
{
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (analysis->point[p].surface) return true;
    return false;
}

bool fracas_analysis_all_surfaces(const fracas_analysis *analysis)
{
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (!analysis->point[p].surface) return false;
    return analysis->table->npoints > 0;
}
