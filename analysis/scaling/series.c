/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/scaling/scaling.h"

#include "analysis/summary/study.h"
#include "base/own.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bool fracas_size_counts(const fracas_analysis *analysis, size_t point)
{
    const fracas_point_statistics *statistics = &analysis->point[point];
    return statistics->rate > 0 && isfinite(statistics->rate) && statistics->size.mean > 0;
}

bool fracas_size_whole(const fracas_analysis *analysis, size_t point)
{
    return analysis->point[point].count.mean == 1; /* no body has less than one */
}

static int by_rate(const void *a, const void *b)
{
    const fracas_size_point *p = a, *q = b;
    if (p->rate != q->rate) return p->rate < q->rate ? -1 : 1;
    return p->point < q->point ? -1 : 1;
}

static fracas_err gather(const fracas_analysis *analysis, const fracas_columns *others,
                         size_t first, fracas_size_series *series)
{
    const fracas_scales none = {NAN, NAN, NAN, NAN};
    const size_t npoints = analysis->table->npoints;
    *series = (fracas_size_series){.scales = analysis->point[first].scales};
    series->point = calloc(npoints, sizeof *series->point);
    if (!series->point) return fracas_no_memory("the series of the study");
    for (size_t p = first; p < npoints; p++) {
        const fracas_point_statistics *statistics = &analysis->point[p];
        if (!fracas_size_counts(analysis, p) ||
            !fracas_columns_same(analysis->table, others, p, first))
            continue;
        const fracas_estimate *size = &statistics->size;
        if (!fracas_scales_same(&statistics->scales, &analysis->point[first].scales))
            series->scales = none;
        series->point[series->n++] = (fracas_size_point){
            .point = p,
            .replicas = size->n,
            .rate = statistics->rate,
            .size = size->mean,
            .error = size->deviation / (sqrt((double)size->n) * size->mean),
            .whole = fracas_size_whole(analysis, p)};
    }
    qsort(series->point, series->n, sizeof *series->point, by_rate);
    return FRACAS_OK;
}

static bool begins_series(const fracas_analysis *analysis, const fracas_columns *others, size_t p)
{
    if (!fracas_size_counts(analysis, p)) return false;
    for (size_t q = 0; q < p; q++)
        if (fracas_size_counts(analysis, q) && fracas_columns_same(analysis->table, others, p, q))
            return false;
    return true;
}

static fracas_err gather_all(const fracas_analysis *analysis, const fracas_columns *others,
                             fracas_size_series *list, size_t *count)
{
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        if (!begins_series(analysis, others, p)) continue;
        fracas_size_series *series = &list[(*count)++];
        TRY(gather(analysis, others, p, series));
        fracas_columns_label(analysis->table, others, p, series->name, sizeof series->name);
    }
    if (*count == 1) FRACAS_PRINT(list->name, "all points");
    return FRACAS_OK;
}

fracas_err fracas_size_series_create(const fracas_analysis *analysis, fracas_size_series **list,
                                     size_t *count)
{
    FRACAS_CLEARED(fracas_columns) others = {0};
    *count = 0;
    *list = NULL;
    TRY(fracas_columns_without_rate(analysis->table, &analysis->shown, &others));
    fracas_size_series *made = calloc(analysis->table->npoints + 1, sizeof *made);
    fracas_err err = made ? gather_all(analysis, &others, made, count)
                          : fracas_no_memory("the series of the study");
    if (!err) *list = made;
    else fracas_size_series_free(made, *count);
    return err;
}

void fracas_size_series_free(fracas_size_series *list, size_t count)
{
    for (size_t i = 0; list && i < count; i++) free(list[i].point);
    free(list);
}
