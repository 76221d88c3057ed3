/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/study.h"

#include "analysis/data/format.h"
#include "base/own.h"

#include <errno.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(key, doc) FRACAS_FIELD(fracas_progress, INTEGER, #key, "1", doc, key)
static const fracas_field progress_fields[] = {
    COUNT(planned, "realizations planned, by now where a rule decides their number"),
    COUNT(done, "realizations that are there"),
    COUNT(failed, "realizations that FAILED"),
    COUNT(missing, "realizations that are done but could not be read"),
    FRACAS_FIELD(fracas_progress, BOOLEAN, "complete", "", "all are done and none FAILED",
                 complete),
};
const fracas_fields fracas_progress_fields = FRACAS_FIELDS(progress_fields);

/* The last part of the folder's real path: "." has a name, too. */
static fracas_err name_of(const char *study, char **name)
{
    OWNED char *path = realpath(study, NULL);
    if (!path)
        return fracas_fail(FRACAS_DAMAGED, "%s: %s; name the folder of a study", study,
                           strerror(errno));
    *name = strdup(basename(path));
    return *name ? FRACAS_OK : fracas_no_memory("the name of the study");
}

static fracas_err add(void *context, fracas_result *result)
{
    fracas_analysis *analysis = context;
    return fracas_point_statistics_add(&analysis->point[result->point], result->row,
                                       result->replica, &result->record);
}

/* Where the reading of histories is: they come point by point. */
typedef struct {
    fracas_analysis *analysis;
    size_t point; /* point of the collector; SIZE_MAX: none yet */
    fracas_bands_collector collector;
} history_reading;

static fracas_err begin_bands(history_reading *reading, size_t p)
{
    fracas_point_statistics *statistics = &reading->analysis->point[p];
    fracas_bands_end(&reading->collector);
    reading->point = p;
    fracas_bands_clear(&statistics->bands);
    return fracas_bands_begin(reading->analysis->header.history,
                              fracas_columns_real(reading->analysis->table, p, "time.end"),
                              statistics->ensemble.nrealizations, &statistics->bands,
                              &reading->collector);
}

/* Takes the history into the bands of its point; history, probes and reactions of the typical
 * replica are also kept. */
static fracas_err add_history(void *context, fracas_result *result)
{
    history_reading *reading = context;
    fracas_point_statistics *statistics = &reading->analysis->point[result->point];
    if (!fracas_outcome_usable(result->record.outcome)) return FRACAS_OK;
    if (reading->point != result->point) TRY(begin_bands(reading, result->point));
    fracas_bands_add(&reading->collector, &result->record);
    fracas_point_statistics_add_history(statistics, &result->record);
    if (result->row != statistics->typical_row || statistics->history) return FRACAS_OK;
    statistics->history = result->record.history;
    statistics->nhistory = result->record.nhistory;
    statistics->probe = result->record.probe;
    statistics->nprobe = result->record.nprobe;
    statistics->reaction = result->record.reaction;
    statistics->nreaction = result->record.nreaction;
    result->record.history = NULL;
    result->record.probe = NULL;
    result->record.reaction = NULL;
    result->record.nhistory = result->record.nprobe = result->record.nreaction = 0;
    return FRACAS_OK;
}

static fracas_err read_histories(fracas_analysis *analysis)
{
    fracas_bands none = {0};
    history_reading reading = {
        .analysis = analysis, .point = SIZE_MAX, .collector = {.bands = &none}};
    fracas_err err = fracas_results_walk(
        analysis->results, FRACAS_READ_HISTORY | FRACAS_READ_PROBES | FRACAS_READ_REACTIONS,
        add_history, &reading);
    fracas_bands_end(&reading.collector);
    return err;
}

/* Keeps the last decision of each point: the file has them by point and round. */
static fracas_err read_decisions(fracas_analysis *analysis)
{
    size_t count;
    const fracas_decision *all = fracas_results_decisions(analysis->results, &count);
    if (count == 0) return FRACAS_OK;
    analysis->decision = calloc(analysis->table->npoints, sizeof *analysis->decision);
    if (!analysis->decision) return fracas_no_memory("the decisions of the study");
    for (size_t d = 0; d < count; d++) analysis->decision[all[d].point] = all[d];
    return FRACAS_OK;
}

static fracas_err analyse(const char *study, const fracas_hash *campaign,
                          const fracas_point_table *table, fracas_analysis *analysis)
{
    TRY(name_of(study, &analysis->name));
    TRY(fracas_results_open(study, campaign, table, &analysis->results));
    analysis->header = *fracas_results_header(analysis->results);
    analysis->table = fracas_results_points(analysis->results);
    size_t npoints = analysis->table->npoints;
    analysis->point = calloc(npoints + 1, sizeof *analysis->point);
    if (!analysis->point) return fracas_no_memory("the points of the study");
    for (size_t p = 0; p < npoints; p++)
        fracas_point_statistics_init(analysis->table, p, &analysis->point[p]);
    TRY(fracas_columns_create(analysis->table, &analysis->shown));
    TRY(read_decisions(analysis));
    TRY(fracas_results_walk(analysis->results, FRACAS_READ_FRAGMENTS, add, analysis));
    for (size_t p = 0; p < npoints; p++) TRY(fracas_point_statistics_finish(&analysis->point[p]));
    TRY(read_histories(analysis));
    TRY(fracas_analysis_choose_points(analysis));
    TRY(fracas_means_axes_create(analysis, NULL, NULL, NULL, &analysis->axes));
    return fracas_analysis_ordinates(analysis, NULL);
}

fracas_err fracas_analysis_create(const char *study, const fracas_hash *campaign,
                                  const fracas_point_table *table, fracas_analysis **analysis)
{
    *analysis = NULL;
    fracas_analysis *made = calloc(1, sizeof *made);
    if (made) made->kept = calloc(1, sizeof *made->kept);
    if (!made || !made->kept) {
        free(made);
        return fracas_no_memory("an analysis");
    }
    fracas_err err = analyse(study, campaign, table, made);
    if (err) fracas_analysis_destroy(made);
    else *analysis = made;
    return err;
}

void fracas_analysis_destroy(fracas_analysis *analysis)
{
    if (!analysis) return;
    if (analysis->point)
        for (size_t p = 0; p < analysis->table->npoints; p++)
            fracas_point_statistics_clear(&analysis->point[p]);
    free(analysis->point);
    free(analysis->decision);
    fracas_columns_clear(&analysis->shown);
    fracas_means_axes_clear(&analysis->axes);
    free(analysis->drawn);
    fracas_results_close(analysis->results);
    free(analysis->kept->crossovers);
    free(analysis->kept);
    free(analysis->name);
    free(analysis);
}

fracas_err fracas_analysis_axes(fracas_analysis *analysis, const char *x, const char *series,
                                const char *panels)
{
    fracas_means_axes_clear(&analysis->axes);
    return fracas_means_axes_create(analysis, x, series, panels, &analysis->axes);
}

fracas_err fracas_analysis_ordinates(fracas_analysis *analysis, const char *list)
{
    analysis->asked = list != NULL;
    return fracas_ordinates_find(analysis, list, analysis->ordinate, &analysis->nordinates);
}

/* ---- how far it is ---- */

fracas_progress fracas_analysis_progress_of(const fracas_analysis *analysis, size_t point)
{
    const fracas_point_statistics *statistics = &analysis->point[point];
    fracas_progress progress = {
        .planned = analysis->table->point[point].replicas,
        .done = statistics->realizations - statistics->outcome[FRACAS_FAILED],
        .failed = statistics->outcome[FRACAS_FAILED],
        .missing = fracas_results_missing(analysis->results, point),
    };
    progress.ended = progress.done + progress.failed == progress.planned &&
                     fracas_results_decided(analysis->results, point);
    progress.complete = progress.ended && progress.failed == 0;
    return progress;
}

fracas_progress fracas_analysis_progress(const fracas_analysis *analysis)
{
    fracas_progress all = {.ended = true, .complete = true};
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_progress point = fracas_analysis_progress_of(analysis, p);
        all.planned += point.planned;
        all.done += point.done;
        all.failed += point.failed;
        all.missing += point.missing;
        all.ended = all.ended && point.ended;
        all.complete = all.complete && point.complete;
    }
    return all;
}

bool fracas_analysis_partial(const fracas_analysis *analysis, char *text, size_t size)
{
    if (!fracas_results_partial(analysis->results)) return false;
    const fracas_progress all = fracas_analysis_progress(analysis);
    char failed[40] = "", missing[40] = "";
    if (all.failed) FRACAS_PRINT(failed, ", %lld FAILED", (long long)all.failed);
    if (all.missing) FRACAS_PRINT(missing, ", %lld missing", (long long)all.missing);
    snprintf(text, size, "partial: %lld of %lld realizations done%s%s", (long long)all.done,
             (long long)all.planned, failed, missing);
    return true;
}

fracas_label fracas_analysis_label(const fracas_analysis *analysis, size_t point)
{
    fracas_label label = {""};
    if (point != SIZE_MAX)
        fracas_columns_label(analysis->table, &analysis->shown, point, label.text,
                             sizeof label.text);
    return label;
}

const fracas_decision *fracas_analysis_decision(const fracas_analysis *analysis, size_t point)
{
    return analysis->decision && analysis->decision[point].replicas > 0 ? &analysis->decision[point]
                                                                        : NULL;
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
    const fracas_label label = fracas_analysis_label(analysis, point);
    snprintf(
        text, size,
        "%s%s%lld replicas in %lld round%s: half width of the %.4g %% interval of %s %s %%, "
        "%.3g %% asked for%s",
        label.text, *label.text ? ": " : "", (long long)last->replicas, (long long)last->round + 1,
        last->round ? "s" : "", 100 * last->confidence, fracas_analysis_quantity(last),
        fracas_beside(100 * fracas_decision_relative(last), 100 * last->relative_half_width).text,
        100 * last->relative_half_width, last->stop == 2 ? " (maximum)" : "");
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

bool fracas_analysis_much_dust(const fracas_analysis *analysis)
{
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (analysis->point[p].dust_share > FRACAS_DUST_LIMIT) return true;
    return false;
}

void fracas_analysis_share_numbers(fracas_analysis *analysis)
{
    analysis->common = true;
}
