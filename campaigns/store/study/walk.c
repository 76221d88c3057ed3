/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk over the realizations of a study. */
#include "campaigns/store/study/segments.h"

#include <inttypes.h>
#include <stdlib.h>

/* Realizations read ahead, in the order of the walk. */
typedef struct {
    fracas_visit *item;
    size_t count, room;
} window;

enum { WINDOW_BYTES = 128 << 20 };

/* ---- the realizations of a plan ---- */

typedef struct {
    fracas_index *index;
    const fracas_point_table *table;
    size_t point;
    int64_t replica;
} plan;

static fracas_err next_planned(void *context, fracas_visit *visit, bool *more)
{
    plan *at = context;
    const fracas_point_table *table = at->table;
    while (at->point < table->npoints && at->replica == table->point[at->point].replicas)
        at->point++, at->replica = 0;
    *more = at->point < table->npoints;
    if (!*more) return FRACAS_OK;
    visit->result.point = at->point;
    visit->result.replica = at->replica++;
    return fracas_index_place(at->index, &table->point[at->point].hash, visit->result.replica,
                              &visit->place);
}

/* ---- the window ---- */

/* From row *row on as many as fit; *more: others follow. */
static fracas_err window_fill(window *w, const fracas_segments *segments, const fracas_want *want,
                              size_t *row, bool *more)
{
    for (uint64_t bytes = 0; bytes < WINDOW_BYTES;) {
        TRY(fracas_grow(&w->item, sizeof *w->item, w->count, &w->room, "realizations read ahead"));
        fracas_visit *item = &w->item[w->count];
        *item = (fracas_visit){.result.row = *row};
        fracas_record_init(&item->result.record);
        TRY(want->next(want->source, item, more));
        if (!*more) break;
        w->count++;
        ++*row;
        bytes += sizeof *item + sizeof item +
                 fracas_segments_size(segments, &item->place, want->parts);
    }
    return FRACAS_OK;
}

static int by_place(const void *a, const void *b)
{
    const fracas_place *x = &(*(fracas_visit *const *)a)->place,
                       *y = &(*(fracas_visit *const *)b)->place;
    if (x->segment != y->segment) return x->segment < y->segment ? -1 : 1;
    return (x->row > y->row) - (x->row < y->row);
}

static fracas_err window_read(window *w, fracas_segments *segments, const fracas_want *want)
{
    size_t n = 0;
    OWNED fracas_visit **sorted = malloc((w->count + 1) * sizeof *sorted);
    if (!sorted) return fracas_no_memory("realizations read ahead");
    for (size_t i = 0; i < w->count; i++) {
        if (!want->damaged)
            TRY(fracas_segments_check_failed(segments, &w->item[i].place,
                                             w->item[i].result.replica));
        if (w->item[i].place.status == FRACAS_DONE && !w->item[i].damaged)
            sorted[n++] = &w->item[i];
    }
    if (n) qsort(sorted, n, sizeof *sorted, by_place);
    for (size_t i = 0; i < n; i++) {
        fracas_result *result = &sorted[i]->result;
        fracas_err err = fracas_segments_record(segments, &sorted[i]->place,
                                                &want->table->point[result->point].hash,
                                                result->replica, want->parts, &result->record);
        sorted[i]->damaged = err == FRACAS_DAMAGED;
        if (err == FRACAS_DAMAGED && want->damaged) err = want->damaged(want->context, result);
        TRY(err);
    }
    return FRACAS_OK;
}

static void window_empty(window *w)
{
    for (size_t i = 0; i < w->count; i++) fracas_record_clear(&w->item[i].result.record);
    w->count = 0;
}

/* ---- the walk ---- */

fracas_err fracas_study_each(fracas_segments *segments, const fracas_want *want)
{
    window w = {0};
    size_t row = 0;
    bool more = true;
    fracas_err err = FRACAS_OK;
    while (!err && more) {
        err = window_fill(&w, segments, want, &row, &more);
        if (!err) err = window_read(&w, segments, want);
        for (size_t i = 0; !err && i < w.count; i++) err = want->visit(want->context, &w.item[i]);
        window_empty(&w);
    }
    free(w.item);
    return err;
}

fracas_err fracas_study_each_planned(fracas_segments *segments, fracas_index *index,
                                     const fracas_want *want)
{
    plan planned = {.index = index, .table = want->table};
    fracas_want all = *want;
    all.next = next_planned;
    all.source = &planned;
    TRY(fracas_index_begin_reading(index)); /* one lock for all its look-ups */
    return fracas_index_end(index, fracas_study_each(segments, &all));
}
