/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions on the number of replicas, and the summaries they rest on. */
#include "campaigns/store/index/index.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

static const char remedy[] = "remove it and run again: it is made anew from the segments";

double fracas_decision_relative(const fracas_decision *decision)
{
    return decision->half_width == 0 ? 0 : decision->half_width / fabs(decision->mean);
}

bool fracas_decision_same(const fracas_decision *a, const fracas_decision *b)
{
    return a->point == b->point && a->round == b->round && a->replicas == b->replicas &&
           a->used == b->used && fracas_same_real(a->mean, b->mean) &&
           fracas_same_real(a->half_width, b->half_width) && a->stop == b->stop &&
           a->quantity == b->quantity && a->minimum == b->minimum && a->maximum == b->maximum &&
           a->relative_half_width == b->relative_half_width && a->confidence == b->confidence;
}

bool fracas_decision_valid(const fracas_decision *d)
{
    return d->round >= 0 && d->replicas > 0 && d->used >= 0 && d->used <= d->replicas &&
           d->stop >= 0 && d->stop <= 2 && d->quantity >= 0 && d->quantity <= 2;
}

static fracas_err need_point(fracas_index *index, const fracas_hash *point, int64_t *id)
{
    TRY(fracas_index_find_point(index, point, id));
    return *id ? FRACAS_OK
               : fracas_fail(FRACAS_DAMAGED, "%s lacks a point of the campaign; %s", index->path,
                             remedy);
}

fracas_err fracas_index_summaries(fracas_index *index, const fracas_hash *point, size_t count,
                                  fracas_index_summary *row)
{
    int64_t id;
    size_t found = 0;
    sqlite3_stmt *s = index->statement[FRACAS_SQL_ROW_OF_POINT_PLACE];
    TRY(need_point(index, point, &id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_OF_POINT_PLACE, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_OF_POINT_PLACE, 2, (int64_t)count));
    for (;; found++) {
        bool more;
        TRY(fracas_index_step(index, FRACAS_SQL_ROW_OF_POINT_PLACE, &more));
        if (!more || found == count) break;
        const fracas_place place = fracas_place_read(s, 1);
        row[found] = (fracas_index_summary){place.status, place.summary};
    }
    fracas_index_reset(index, FRACAS_SQL_ROW_OF_POINT_PLACE);
    if (found == count) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s: %zu of the first %zu replicas of a point are there; %s",
                       index->path, found, count, remedy);
}

fracas_err fracas_index_decisions(fracas_index *index, const fracas_hash *point,
                                  fracas_decision **decision, size_t *count)
{
    int64_t id;
    size_t room = 0;
    sqlite3_stmt *s = index->statement[FRACAS_SQL_DECISION_OF_POINT];
    *decision = NULL;
    *count = 0;
    TRY(need_point(index, point, &id));
    fracas_err err = fracas_index_bind(index, FRACAS_SQL_DECISION_OF_POINT, 1, id);
    for (bool more; !err; ++*count) {
        err = fracas_index_step(index, FRACAS_SQL_DECISION_OF_POINT, &more);
        if (err || !more) break;
        if (*count == room) {
            room = 2 * room + 16;
            fracas_decision *bigger = realloc(*decision, room * sizeof **decision);
            if (!bigger) err = fracas_no_memory("the decisions of a point");
            else *decision = bigger;
            if (err) break;
        }
        const int64_t replicas = sqlite3_column_int64(s, 1);
        (*decision)[*count] = (fracas_decision){.round = sqlite3_column_int64(s, 0),
                                                .replicas = replicas,
                                                .used = replicas - sqlite3_column_int64(s, 2),
                                                .mean = fracas_index_real(s, 3),
                                                .half_width = fracas_index_real(s, 4),
                                                .stop = sqlite3_column_int64(s, 5),
                                                .quantity = sqlite3_column_int64(s, 6),
                                                .minimum = sqlite3_column_int64(s, 7),
                                                .maximum = sqlite3_column_int64(s, 8),
                                                .relative_half_width = fracas_index_real(s, 9),
                                                .confidence = fracas_index_real(s, 10)};
        if (!fracas_decision_valid(&(*decision)[*count]))
            err = fracas_fail(FRACAS_DAMAGED, "%s: a row of its table `decision` is damaged; %s",
                              index->path, remedy);
    }
    fracas_index_reset(index, FRACAS_SQL_DECISION_OF_POINT);
    if (err) free(*decision), *decision = NULL;
    return err;
}

static fracas_err add_decision(fracas_index *index, int64_t id, const fracas_decision *d,
                               const char *reason)
{
    const fracas_sql add = FRACAS_SQL_DECISION_ADD;
    const int64_t whole[] = {id, d->round, d->replicas, d->replicas - d->used};
    const double real[] = {d->mean, d->half_width, fracas_decision_relative(d)};
    for (int i = 0; i < 4; i++) TRY(fracas_index_bind(index, add, 1 + i, whole[i]));
    for (int i = 0; i < 3; i++) TRY(fracas_index_bind_real(index, add, 5 + i, real[i]));
    TRY(fracas_index_bind(index, add, 8, d->stop));
    TRY(fracas_index_bind_text(index, add, 9, reason));
    TRY(fracas_index_bind(index, add, 10, d->quantity));
    TRY(fracas_index_bind(index, add, 11, d->minimum));
    TRY(fracas_index_bind(index, add, 12, d->maximum));
    TRY(fracas_index_bind_real(index, add, 13, d->relative_half_width));
    TRY(fracas_index_bind_real(index, add, 14, d->confidence));
    return fracas_index_do(index, add);
}

fracas_err fracas_index_decide(fracas_index *index, const fracas_point_row *point,
                               const fracas_decision *decision, const char *reason)
{
    int64_t id;
    TRY(need_point(index, &point->hash, &id));
    TRY(fracas_index_bind(index, FRACAS_SQL_DECISION_DROP, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_DECISION_DROP, 2, decision->round));
    TRY(fracas_index_do(index, FRACAS_SQL_DECISION_DROP));
    TRY(add_decision(index, id, decision, reason));
    if (!decision->stop) return fracas_index_plan_point(index, point);
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_TRIM, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_TRIM, 2, point->replicas));
    return fracas_index_do(index, FRACAS_SQL_ROW_TRIM);
}
