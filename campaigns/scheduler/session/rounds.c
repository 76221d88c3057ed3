/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/rounds.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- decisions ---- */

/* Counts the same outcomes as the report (analysis); NaN leaves a realization out. */
static double value_of(const fracas_row_place *row, fracas_quantity quantity)
{
    const fracas_summary *found = &row->summary;
    const bool counts = row->status == FRACAS_DONE &&
                        (found->outcome == FRACAS_FRAGMENTED || found->outcome == FRACAS_INTACT ||
                         found->outcome == FRACAS_TIME_LIMIT);
    if (!counts) return NAN;
    switch (quantity) {
    case FRACAS_MEAN_COUNT: return (double)found->fragments;
    case FRACAS_MEAN_SIZE: return found->size;
    default: return found->dissipated;
    }
}

/* The decision of a round from its replicas, 0 to replicas - 1; *complete: every one is done or
 * failed for good, *decision only then. */
static fracas_err decide(fracas_index *index, const fracas_point *point, int64_t round,
                         int64_t replicas, fracas_decision *decision, bool *complete)
{
    OWNED double *value = malloc((size_t)replicas * sizeof *value);
    OWNED fracas_row_place *row = malloc((size_t)replicas * sizeof *row);
    if (!value || !row) return fracas_no_memory("the realizations of a round");
    TRY(fracas_index_summaries(index, &point->hash, (size_t)replicas, row));
    *complete = true;
    for (int64_t r = 0; r < replicas; r++) {
        *complete = *complete && row[r].status != FRACAS_PLANNED && row[r].status != FRACAS_LEASED;
        value[r] = value_of(&row[r], point->rule.quantity);
    }
    if (!*complete) return FRACAS_OK;
    const fracas_sequential_rule *rule = &point->rule;
    const fracas_sequential_decision made = fracas_sequential_decide(rule, value, replicas);
    *decision = (fracas_decision){.round = round,
                                  .replicas = replicas,
                                  .used = made.used,
                                  .mean = made.mean,
                                  .half_width = made.half_width,
                                  .stop = made.stop,
                                  .quantity = rule->quantity,
                                  .minimum = rule->minimum,
                                  .maximum = rule->maximum,
                                  .relative_half_width = rule->relative_half_width,
                                  .confidence = rule->confidence};
    return FRACAS_OK;
}

static bool is_by(const fracas_decision *recorded, const fracas_sequential_rule *rule)
{
    return recorded->quantity == (int64_t)rule->quantity && recorded->minimum == rule->minimum &&
           recorded->maximum == rule->maximum &&
           recorded->relative_half_width == rule->relative_half_width &&
           recorded->confidence == rule->confidence;
}

/* ---- recording ---- */

static fracas_err record(fracas_rounds *rounds, fracas_index *index, size_t p,
                         const fracas_decision *made)
{
    const fracas_sequential_rule *rule = &rounds->campaign->point[p].rule;
    char reason[160], text[240];
    snprintf(reason, sizeof reason,
             "%s of %" PRId64 " realizations %.6g +- %.3g, %.3g %% of it; %.3g %% asked for%s",
             fracas_quantity_name[rule->quantity], made->used, made->mean, made->half_width,
             100 * fracas_decision_relative(made), 100 * rule->relative_half_width,
             made->stop == FRACAS_AT_MAXIMUM ? ", but this is the maximum" : "");
    snprintf(text, sizeof text, "point %zu, round %" PRId64 ", %" PRId64 " replicas: %s: %s", p,
             made->round, made->replicas, fracas_sequential_stop_name[made->stop], reason);
    TRY(fracas_index_decide(index, &rounds->point[p], made, reason));
    return fracas_index_event(index, "decided", text);
}

static fracas_err disagrees(size_t p, const fracas_decision *recorded)
{
    return fracas_fail(FRACAS_DAMAGED,
                       "the index records for round %" PRId64
                       " of point %zu a decision (mean %.17g, half width %.17g) that its "
                       "realizations do not give; `fracas reindex` makes it anew from the segments",
                       recorded->round, p, recorded->mean, recorded->half_width);
}

/* Decides rounds of point p from its present one on, given its recorded decisions. */
static fracas_err go_on(fracas_rounds *rounds, fracas_index *index, size_t p,
                        const fracas_decision *recorded, size_t count)
{
    const fracas_point *point = &rounds->campaign->point[p];
    while (!rounds->stopped[p]) {
        const int64_t round = rounds->round[p], replicas = rounds->point[p].replicas;
        const fracas_decision *known = (size_t)round < count &&
                                               is_by(&recorded[round], &point->rule)
                                           ? &recorded[round]
                                           : NULL;
        fracas_decision made;
        bool complete;
        TRY(decide(index, point, round, replicas, &made, &complete));
        if (known && complete && !fracas_decision_same(known, &made)) return disagrees(p, known);
        if (!known && !complete) return FRACAS_OK;
        if (known) made = *known;
        if (made.stop) {
            rounds->stopped[p] = true;
            rounds->open--;
        } else {
            rounds->round[p]++;
            rounds->point[p].replicas = fracas_sequential_next(&point->rule, replicas);
        }
        if (!known) TRY(record(rounds, index, p, &made));
    }
    return FRACAS_OK;
}

fracas_err fracas_rounds_advance(fracas_rounds *rounds, fracas_index *index, size_t p)
{
    TRY(fracas_index_begin(index));
    return fracas_index_end(index, go_on(rounds, index, p, NULL, 0));
}

fracas_err fracas_rounds_commit(fracas_rounds *rounds, fracas_index *index,
                                const fracas_segment_row *row, size_t count)
{
    const fracas_campaign *campaign = rounds->campaign;
    TRY(fracas_index_begin(index));
    fracas_err err = FRACAS_OK;
    for (size_t r = 0; !err && r < count; r++) {
        if (r > 0 && fracas_hash_equal(&row[r].point, &row[r - 1].point)) continue;
        for (size_t p = 0; !err && rounds->open > 0 && p < campaign->npoints; p++)
            if (fracas_hash_equal(&campaign->point[p].hash, &row[r].point))
                err = go_on(rounds, index, p, NULL, 0);
    }
    return fracas_index_end(index, err);
}

/* ---- the start and the end ---- */

static fracas_err begin(fracas_rounds *rounds, fracas_index *index, size_t p)
{
    OWNED fracas_decision *recorded = NULL;
    size_t count;
    TRY(fracas_index_decisions(index, &rounds->point[p].hash, &recorded, &count));
    return go_on(rounds, index, p, recorded, count);
}

fracas_err fracas_rounds_init(fracas_rounds *rounds, const fracas_campaign *campaign,
                              fracas_index *index)
{
    *rounds = (fracas_rounds){.campaign = campaign, .table = campaign->table};
    rounds->point = malloc(campaign->npoints * sizeof *rounds->point);
    rounds->round = calloc(campaign->npoints, sizeof *rounds->round);
    rounds->stopped = calloc(campaign->npoints, sizeof *rounds->stopped);
    if (!rounds->point || !rounds->round || !rounds->stopped)
        return fracas_no_memory("the rounds of the campaign");
    memcpy(rounds->point, campaign->table.point, campaign->npoints * sizeof *rounds->point);
    rounds->table.point = rounds->point;
    for (size_t p = 0; p < campaign->npoints; p++) {
        rounds->stopped[p] = campaign->point[p].rule.maximum == 0;
        rounds->open += !rounds->stopped[p];
    }
    TRY(fracas_index_begin(index));
    fracas_err err = FRACAS_OK;
    for (size_t p = 0; !err && p < campaign->npoints; p++)
        if (!rounds->stopped[p]) err = begin(rounds, index, p);
    return fracas_index_end(index, err);
}

void fracas_rounds_clear(fracas_rounds *rounds)
{
    free(rounds->point);
    free(rounds->round);
    free(rounds->stopped);
    *rounds = (fracas_rounds){0};
}

static fracas_err check_point(const fracas_point *point, fracas_index *index, size_t p)
{
    OWNED fracas_decision *recorded = NULL;
    size_t count, d = 0;
    bool complete = true, stopped = false;
    TRY(fracas_index_decisions(index, &point->hash, &recorded, &count));
    for (int64_t replicas = point->rule.minimum; complete && !stopped && d < count; d++) {
        fracas_decision made;
        TRY(decide(index, point, (int64_t)d, replicas, &made, &complete));
        if (complete && !fracas_decision_same(&recorded[d], &made))
            return disagrees(p, &recorded[d]);
        stopped = complete && made.stop;
        replicas = fracas_sequential_next(&point->rule, replicas);
    }
    if (stopped && d == count) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "the index lacks a decision on the replicas of point %zu, or has one too "
                       "many; remove index.sqlite: `fracas run` makes it anew from the segments",
                       p);
}

fracas_err fracas_rounds_check(const fracas_campaign *campaign, fracas_index *index)
{
    for (size_t p = 0; p < campaign->npoints; p++)
        if (campaign->point[p].rule.maximum > 0) TRY(check_point(&campaign->point[p], index, p));
    return FRACAS_OK;
}
