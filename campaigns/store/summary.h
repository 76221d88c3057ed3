/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The summary of a realization: values of its record in the index, beside the place of its bytes,
 * for counts, decisions and comparisons without opening a segment.
 *
 * A new value is one line of FRACAS_EACH_SUMMARY. The table makes the struct, its comparison, the
 * columns of `realization` in index.sqlite with their statements, and docs/formats/study.md. */
#ifndef FRACAS_CAMPAIGNS_STORE_SUMMARY_H
#define FRACAS_CAMPAIGNS_STORE_SUMMARY_H

#include "engine/record.h"

#include <stdbool.h>

/* X(key, type, value, meaning): `type` INTEGER or REAL (NULL in SQLite for NaN), `value` from a
 * fracas_record *record. */
#define FRACAS_EACH_SUMMARY(X)                                                      \
    X(outcome, INTEGER, record->outcome,                                            \
      "0 to 5 as in `/realization/outcome`; NULL before it is done or failed")      \
    X(fragments, INTEGER, record->fragments, "as in `/realization`, dust included") \
    X(fragments_dust, INTEGER, record->fragments_dust, "as in `/realization`")      \
    X(steps, INTEGER, record->steps, "as in `/realization`")                        \
    X(dissipated, REAL, record->dissipated, "as in `/realization`; NULL for NaN")   \
    X(residual, REAL, record->residual, "as in `/realization`; NULL for NaN")       \
    X(size, REAL, fracas_record_mean_size(record),                                  \
      "mean of `/fragment/size` over its fragments, in their order; NULL without fragments")

typedef int64_t fracas_sql_INTEGER;
typedef double fracas_sql_REAL;

#define FRACAS_SUMMARY_MEMBER(key, type, value, meaning) fracas_sql_##type key;
typedef struct {
    FRACAS_EACH_SUMMARY(FRACAS_SUMMARY_MEMBER)
} fracas_summary;

/* Mean size of the fragments [m], summed in their order; NaN without fragments. */
double fracas_record_mean_size(const fracas_record *record);

fracas_summary fracas_summary_of(const fracas_record *record);

/* True if all values are equal, NaN equal to NaN. */
bool fracas_summary_same(const fracas_summary *a, const fracas_summary *b);

#endif
