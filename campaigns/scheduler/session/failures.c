/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include "campaigns/scheduler/session/failures.h"

#include <stdio.h>

enum { NAMED = 5 }; /* points in the message; others are counted */

typedef struct {
    long long realizations;
    size_t points, last; /* points with failures; the latest one */
    size_t point[NAMED];
    long long count[NAMED]; /* realizations at each */
} failures;

/* Called in plan order, hence point by point. */
static void count_failure(void *context, const fracas_index_row *row, const char *reason)
{
    failures *f = context;
    (void)reason;
    if (!f->points || row->point != f->last) {
        if (f->points < NAMED) f->point[f->points] = row->point;
        f->points++;
        f->last = row->point;
    }
    f->realizations++;
    if (f->points <= NAMED) f->count[f->points - 1]++;
}

fracas_err fracas_failure_report(const char *study, fracas_index *index,
                                 const fracas_point_table *table)
{
    failures found = {0};
    OWN(fracas_index) opened = NULL;
    if (!index) TRY(fracas_index_open(study, false, &opened));
    TRY(fracas_index_failures(index ? index : opened, table, count_failure, &found));
    if (!found.realizations) return FRACAS_OK;
    char points[NAMED * 64 + 64] = "";
    size_t n = 0;
    for (size_t i = 0; i < found.points && i < NAMED; i++)
        n += (size_t)snprintf(points + n, sizeof points - n, "%s%lld of point %zu", i ? ", " : "",
                              found.count[i], found.point[i]);
    if (found.points > NAMED)
        snprintf(points + n, sizeof points - n, ", and of %zu points more", found.points - NAMED);
    const fracas_shell_word word = fracas_shell_path(study, NULL);
    return fracas_fail(FRACAS_SOME_FAILED,
                       "%lld realization%s of %s FAILED: %s (which and why: fracas status %s; to "
                       "try them again: fracas retry %s --failed)",
                       found.realizations, found.realizations > 1 ? "s" : "", study, points,
                       word.text, word.text);
}
