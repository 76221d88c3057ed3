/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failed realizations planned again. */
#include "campaigns/store/index/index.h"
#include "campaigns/store/upkeep.h"

#include <inttypes.h>
#include <stdio.h>

/* ?1 is the hash of a point, or NULL for all of them. A decision stands on the replicas 0 to
 * decision.replicas - 1. */
#define OF_POINT                                                                                   \
    " status IN ('failed', 'quarantined') AND (?1 IS NULL OR point = (SELECT id FROM point WHERE " \
    "hash = ?1))"

static const char undecide[] = "DELETE FROM decision WHERE replicas > (SELECT min(r.replica) FROM "
                               "realization r WHERE r.point = decision.point AND" OF_POINT ")";
static const char plan_again[] =
    "UPDATE realization SET attempts = 0, reason = NULL, " FRACAS_UNSET_PLACE " WHERE" OF_POINT;

static fracas_err run(fracas_index *index, const char *text, const fracas_hash *point,
                      int64_t *rows)
{
    TRY(fracas_sql_do(index, text, SQL_VALUES(SQL_HASH(point))));
    *rows = sqlite3_changes64(index->db);
    return FRACAS_OK;
}

static fracas_err retry(fracas_index *index, const fracas_hash *point, int64_t *rows)
{
    int64_t decisions;
    char text[128];
    TRY(run(index, undecide, point, &decisions));
    TRY(run(index, plan_again, point, rows));
    if (!*rows) return FRACAS_OK;
    snprintf(text, sizeof text, "%" PRId64 " failed realizations%s%s are planned again", *rows,
             point ? " of point " : "", point ? fracas_hash_hex(point).text : "");
    return fracas_index_event(index, "retried", text);
}

fracas_err fracas_index_retry(fracas_index *index, const fracas_hash *point, int64_t *rows)
{
    *rows = 0;
    TRY(fracas_index_begin(index));
    fracas_err err = fracas_index_end(index, retry(index, point, rows));
    if (err) *rows = 0;
    return err;
}
