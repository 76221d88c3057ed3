/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/unfinished.h"

#include "analysis/summary/statistics.h"

#include <stdlib.h>

/* Values of one realization. */
typedef struct {
    double count, size;
} values;

/* The point at hand: its usable realizations. */
typedef struct {
    fracas_unfinished *running;
    const fracas_point_table *table;
    bool going;
    size_t point; /* SIZE_MAX: none yet */
    fracas_point_statistics of;
    values *value;
    size_t count, room;
} reading;

static void end_point(reading *r)
{
    enum { STRIDE = sizeof(values) / sizeof(double) };
    if (r->point == SIZE_MAX) return;
    fracas_unfinished_point *point = &r->running->point[r->point];
    const values none = {0}, *first = r->count ? r->value : &none;
    point->count = fracas_estimate_of(&first->count, STRIDE, r->count);
    point->size = fracas_estimate_of(&first->size, STRIDE, r->count);
    fracas_point_statistics_clear(&r->of);
}

static void begin_point(reading *r, size_t p)
{
    end_point(r);
    r->point = p;
    r->count = 0;
    r->running->point[p].first = r->running->nstates;
    fracas_point_statistics_init(r->table, p, &r->of);
}

static fracas_err take(void *context, size_t p, int64_t replica, const fracas_row_place *place)
{
    reading *r = context;
    const bool known = place->status != FRACAS_PLANNED && place->status != FRACAS_LEASED;
    const fracas_row_status status = known || r->going ? place->status : FRACAS_PLANNED;
    const int64_t outcome = known ? place->summary.outcome : -1;
    (void)replica;
    if (r->point != p) begin_point(r, p);
    fracas_unfinished *running = r->running;
    fracas_unfinished_point *point = &running->point[p];
    TRY(fracas_grow(&running->state, sizeof *running->state, running->nstates, &running->room,
                    "the states of the realizations"));
    running->state[running->nstates++] = status;
    fracas_index_counts_add(&running->all, status, outcome);
    fracas_index_counts_add(&point->counts, status, outcome);
    point->computed += known && place->segment >= running->run.segment;
    if (status != FRACAS_DONE || !fracas_outcome_usable(outcome)) return FRACAS_OK;
    TRY(fracas_grow(&r->value, sizeof *r->value, r->count, &r->room, "the values of a point"));
    const int64_t fragments = place->summary.fragments;
    r->value[r->count++] = (values){
        .count = (double)fragments,
        .size = fracas_point_statistics_size(&r->of, fragments, place->summary.size)};
    return FRACAS_OK;
}

fracas_err fracas_unfinished_read(fracas_index *index, const fracas_point_table *table, bool going,
                                  fracas_unfinished *running)
{
    reading r = {.running = running, .table = table, .going = going, .point = SIZE_MAX};
    *running = (fracas_unfinished){.npoints = table->npoints};
    running->point = calloc(table->npoints + 1, sizeof *running->point);
    if (!running->point) return fracas_no_memory("the points of the study");
    for (size_t p = 0; p < table->npoints; p++) {
        running->point[p].count = fracas_estimate_of(NULL, 1, 0);
        running->point[p].size = running->point[p].count;
    }
    TRY(fracas_index_latest_run(index, &running->run));
    TRY(fracas_index_count_segments(index, &running->all.segments, &running->all.bytes));
    const fracas_err err = fracas_index_each(index, table, take, &r);
    end_point(&r);
    free(r.value);
    return err;
}

void fracas_unfinished_clear(fracas_unfinished *running)
{
    free(running->point);
    free(running->state);
    *running = (fracas_unfinished){0};
}
