/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/history.h"

#include "base/own.h"

#include <math.h>

fracas_err fracas_history_init(fracas_history *history, int64_t intervals, double end, size_t width)
{
    *history = (fracas_history){.intervals = intervals, .end = end, .width = width};
    history->entry = malloc(((size_t)intervals + 1) * sizeof *history->entry);
    if (width) history->value = calloc(fracas_history_values(history), sizeof *history->value);
    fracas_history_begin(history);
    return history->entry && (history->value || !width)
               ? FRACAS_OK
               : fracas_no_memory("the history of a realization");
}

void fracas_history_clear(fracas_history *history)
{
    free(history->entry);
    free(history->value);
    *history = (fracas_history){0};
}

void fracas_history_begin(fracas_history *history)
{
    *history = (fracas_history){.intervals = history->intervals,
                                .end = history->end,
                                .entry = history->entry,
                                .width = history->width,
                                .value = history->value,
                                .peak = -INFINITY,
                                .onset.step = -1,
                                .highest.step = -1,
                                .last.step = -1};
}

static bool is_due(const fracas_history *history, double time)
{
    return history->intervals > 0 && history->next <= history->intervals &&
           time >= (double)history->next * history->end / (double)history->intervals;
}

bool fracas_history_keeps(const fracas_history *history, const fracas_history_row *row,
                          bool cracked)
{
    return (cracked && !history->cracked) || row->elastic + row->cohesive > history->peak ||
           is_due(history, row->time);
}

/* Keeps an entry, and its values in its slot. */
static void keep(fracas_history *history, size_t slot, fracas_history_entry *at, int64_t step,
                 const fracas_history_row *row, const double *value)
{
    *at = (fracas_history_entry){step, *row, slot};
    if (history->width && value)
        memcpy(history->value + slot * history->width, value,
               history->width * sizeof *history->value);
}

void fracas_history_observe(fracas_history *history, int64_t step, const fracas_history_row *row,
                            bool cracked, const double *value)
{
    const size_t own = (size_t)history->intervals + 1; /* slots behind those of the intervals */
    if (cracked && !history->cracked) {
        history->cracked = true;
        keep(history, own, &history->onset, step, row, value);
    }
    if (row->elastic + row->cohesive > history->peak) {
        history->peak = row->elastic + row->cohesive;
        keep(history, own + 1, &history->highest, step, row, value);
    }
    keep(history, own + 2, &history->last, step, row, value);
    bool due = false;
    while (is_due(history, row->time)) {
        due = true;
        history->next++;
    }
    if (due) {
        keep(history, history->count, &history->entry[history->count], step, row, value);
        history->count++;
    }
}

static int by_step(const void *a, const void *b)
{
    int64_t left = ((const fracas_history_entry *)a)->step,
            right = ((const fracas_history_entry *)b)->step;
    return (left > right) - (left < right);
}

fracas_err fracas_history_harvest(const fracas_history *history, fracas_record *record,
                                  double **value)
{
    const size_t width = history->width, most = history->count + 3;
    OWNED fracas_history_entry *all = malloc(most * sizeof *all);
    record->history = malloc(most * sizeof *record->history);
    *value = width ? malloc(most * width * sizeof **value) : NULL;
    if (!all || !record->history || (width && !*value))
        return fracas_no_memory("the history of a realization");
    size_t count = history->count;
    memcpy(all, history->entry, count * sizeof *all);
    all[count++] = history->last;
    if (history->onset.step >= 0) all[count++] = history->onset;
    if (history->highest.step >= 0) all[count++] = history->highest;
    qsort(all, count, sizeof *all, by_step); /* equal steps hold equal rows */
    record->nhistory = 0;
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && all[i].step == all[i - 1].step) continue;
        if (width)
            memcpy(*value + record->nhistory * width, history->value + all[i].slot * width,
                   width * sizeof **value);
        record->history[record->nhistory++] = all[i].row;
    }
    return FRACAS_OK;
}
