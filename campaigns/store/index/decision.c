/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions on the number of replicas, and the summaries they rest on. */
#include "campaigns/store/index/index.h"
#include "campaigns/store/index/tables.h"

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

fracas_err fracas_index_summaries(fracas_index *index, const fracas_hash *point, size_t count,
                                  fracas_index_summary *row)
{
    int64_t id;
    size_t found = 0;
    OWN(sqlite3_stmt) s = NULL;
    TRY(fracas_index_need_point(index, point, &id));
    TRY(fracas_sql_start(index,
                         "SELECT replica, " FRACAS_PLACE_COLUMNS
                         " FROM realization WHERE point = ?1 AND replica < ?2 ORDER BY replica",
                         SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER((int64_t)count)), &s));
    for (;; found++) {
        bool more;
        TRY(fracas_sql_next(index, s, &more));
        if (!more || found == count) break;
        const fracas_place place = fracas_place_read(s, 1);
        row[found] = (fracas_index_summary){place.status, place.summary};
    }
    if (found == count) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s: %zu of the first %zu replicas of a point are there; %s",
                       index->path, found, count, remedy);
}

fracas_err fracas_index_decisions(fracas_index *index, const fracas_hash *point,
                                  fracas_decision **decision, size_t *count)
{
    int64_t id;
    size_t room = 0;
    OWN(sqlite3_stmt) s = NULL;
    OWNED fracas_decision *found = NULL;
    *decision = NULL;
    *count = 0;
    TRY(fracas_index_need_point(index, point, &id));
    TRY(fracas_sql_start(
        index,
        "SELECT round, replicas, failed, mean, half_width, stop, quantity, minimum, maximum, "
        "relative_half_width, confidence FROM decision WHERE point = ?1 ORDER BY round",
        SQL_VALUES(SQL_INTEGER(id)), &s));
    for (bool more;; ++*count) {
        TRY(fracas_sql_next(index, s, &more));
        if (!more) break;
        TRY(fracas_grow(&found, sizeof *found, *count, &room, "the decisions of a point"));
        const int64_t replicas = sqlite3_column_int64(s, 1);
        found[*count] = (fracas_decision){.round = sqlite3_column_int64(s, 0),
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
        if (!fracas_decision_valid(&found[*count]))
            return fracas_fail(FRACAS_DAMAGED, "%s: a row of its table `decision` is damaged; %s",
                               index->path, remedy);
    }
    *decision = found;
    found = NULL;
    return FRACAS_OK;
}

fracas_err fracas_index_decide(fracas_index *index, const fracas_point_row *point,
                               const fracas_decision *d, const char *reason)
{
    int64_t id;
    TRY(fracas_index_need_point(index, &point->hash, &id));
    TRY(fracas_sql_do(index, "DELETE FROM decision WHERE point = ?1 AND round >= ?2",
                      SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(d->round))));
    TRY(fracas_sql_do(
        index,
        "INSERT INTO decision VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)",
        SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(d->round), SQL_INTEGER(d->replicas),
                   SQL_INTEGER(d->replicas - d->used), SQL_REAL(d->mean), SQL_REAL(d->half_width),
                   SQL_REAL(fracas_decision_relative(d)), SQL_INTEGER(d->stop), SQL_TEXT(reason),
                   SQL_INTEGER(d->quantity), SQL_INTEGER(d->minimum), SQL_INTEGER(d->maximum),
                   SQL_REAL(d->relative_half_width), SQL_REAL(d->confidence))));
    if (!d->stop) return fracas_index_plan_point(index, point);
    return fracas_sql_do(index, "DELETE FROM realization WHERE point = ?1 AND replica >= ?2",
                         SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(point->replicas)));
}
