/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which points have figures of their own. */
#include "analysis/summary/study.h"

#include "base/own.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool fracas_analysis_draws(const fracas_analysis *analysis, size_t point)
{
    return !analysis->drawn || analysis->drawn[point];
}

size_t fracas_analysis_ndrawn(const fracas_analysis *analysis)
{
    size_t count = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++)
        count += fracas_analysis_draws(analysis, p);
    return count;
}

typedef struct {
    double count;
    size_t point;
} ranked;

static int by_count(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->count != y->count) return x->count < y->count ? -1 : 1;
    return x->point < y->point ? -1 : x->point > y->point;
}

fracas_err fracas_analysis_choose_points(fracas_analysis *analysis)
{
    const size_t npoints = analysis->table->npoints;
    size_t n = 0;
    if (npoints <= FRACAS_ALL_DRAWN) return FRACAS_OK;
    OWNED ranked *order = calloc(npoints, sizeof *order);
    analysis->drawn = calloc(npoints, sizeof *analysis->drawn);
    if (!order || !analysis->drawn) return fracas_no_memory("the figures of the points");
    for (size_t p = 0; p < npoints; p++)
        if (isfinite(analysis->point[p].count.mean))
            order[n++] = (ranked){analysis->point[p].count.mean, p};
    qsort(order, n, sizeof *order, by_count);
    for (size_t i = 0; i < FRACAS_FEW_DRAWN && n > 0; i++)
        analysis->drawn[order[i * (n - 1) / (FRACAS_FEW_DRAWN - 1)].point] = true;
    return FRACAS_OK;
}

/* ---- the list of a user ---- */

static bool read_number(const char **text, size_t *number)
{
    char *end;
    if (**text < '0' || **text > '9') return false;
    const unsigned long long value = strtoull(*text, &end, 10);
    *number = value < SIZE_MAX ? (size_t)value : SIZE_MAX;
    *text = end;
    return true;
}

/* Takes "3" or "3-7", which ends at a comma or with the text. */
static fracas_err take_part(size_t npoints, const char *list, const char **rest, size_t *from,
                            size_t *to)
{
    const int length = (int)strcspn(*rest, ",");
    const char *at = *rest;
    size_t first = 0, last;
    bool good = read_number(&at, &first);
    last = first;
    if (good && *at == '-') {
        at++;
        good = read_number(&at, &last);
    }
    if (!good || at != *rest + length)
        return fracas_fail(FRACAS_USAGE,
                           "points `%s`: `%.*s` is no number of a point; give them as 3,17,20-25, "
                           "or `all`",
                           list, length, *rest);
    if (last < first)
        return fracas_fail(FRACAS_USAGE,
                           "points `%s`: `%.*s` is no range; its end is less than its "
                           "beginning",
                           list, length, *rest);
    if (last >= npoints)
        return fracas_fail(FRACAS_USAGE,
                           "points `%s`: there is no point %zu: the study has points 0 to %zu",
                           list, last, npoints - 1);
    *from = first;
    *to = last;
    *rest = *at ? at + 1 : at;
    return FRACAS_OK;
}

fracas_err fracas_points_listed(const char *list, size_t npoints, size_t **point, size_t *count)
{
    const char *rest = list;
    size_t room = 0, first = 0, last = 0;
    *point = NULL;
    *count = 0;
    do {
        TRY(take_part(npoints, list, &rest, &first, &last));
        for (size_t p = first; p <= last; p++) {
            TRY(fracas_grow(point, sizeof **point, *count, &room, "a list of points"));
            (*point)[(*count)++] = p;
        }
    } while (*rest || rest[-1] == ',');
    return FRACAS_OK;
}

fracas_err fracas_analysis_points(fracas_analysis *analysis, const char *list)
{
    free(analysis->drawn);
    analysis->drawn = NULL;
    if (!strcmp(list, "all")) return FRACAS_OK;
    analysis->drawn = calloc(analysis->table->npoints + 1, sizeof *analysis->drawn);
    if (!analysis->drawn) return fracas_no_memory("the figures of the points");
    OWNED size_t *point = NULL;
    size_t count;
    TRY(fracas_points_listed(list, analysis->table->npoints, &point, &count));
    for (size_t i = 0; i < count; i++) analysis->drawn[point[i]] = true;
    return FRACAS_OK;
}
