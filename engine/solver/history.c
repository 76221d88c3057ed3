/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/history.h"

#include "base/own.h"

#include <math.h>

fracas_err fracas_history_init(fracas_history *history, int64_t intervals, double end)
{
    *history = (fracas_history){.intervals = intervals, .end = end};
    history->entry = malloc(((size_t)intervals + 1) * sizeof *history->entry);
    fracas_history_begin(history);
    return history->entry ? FRACAS_OK : fracas_no_memory("the history of a realization");
}

void fracas_history_clear(fracas_history *history)
{
    free(history->entry);
    *history = (fracas_history){0};
}

void fracas_history_begin(fracas_history *history)
{
    *history = (fracas_history){.intervals = history->intervals,
                                .end = history->end,
                                .entry = history->entry,
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

void fracas_history_observe(fracas_history *history, int64_t step, const fracas_history_row *row,
                            bool cracked)
{
    const fracas_history_entry entry = {step, *row};
    if (cracked && !history->cracked) {
        history->cracked = true;
        history->onset = entry;
    }
    if (row->elastic + row->cohesive > history->peak) {
        history->peak = row->elastic + row->cohesive;
        history->highest = entry;
    }
    history->last = entry;
    bool due = false;
    while (is_due(history, row->time)) {
        due = true;
        history->next++;
    }
    if (due) history->entry[history->count++] = entry;
}

static int by_step(const void *a, const void *b)
{
    int64_t left = ((const fracas_history_entry *)a)->step,
            right = ((const fracas_history_entry *)b)->step;
    return (left > right) - (left < right);
}

fracas_err fracas_history_harvest(const fracas_history *history, fracas_record *record)
{
    OWNED fracas_history_entry *all = malloc((history->count + 3) * sizeof *all);
    record->history = malloc((history->count + 3) * sizeof *record->history);
    if (!all || !record->history) return fracas_no_memory("the history of a realization");
    size_t count = history->count;
    memcpy(all, history->entry, count * sizeof *all);
    all[count++] = history->last;
    if (history->onset.step >= 0) all[count++] = history->onset;
    if (history->highest.step >= 0) all[count++] = history->highest;
    qsort(all, count, sizeof *all, by_step); /* equal steps hold equal rows */
    record->nhistory = 0;
    for (size_t i = 0; i < count; i++)
        if (i == 0 || all[i].step != all[i - 1].step)
            record->history[record->nhistory++] = all[i].row;
    return FRACAS_OK;
}
