/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/summary.h"

#include <math.h>

double fracas_record_mean_size(const fracas_record *record)
{
    double sum = 0;
    for (size_t i = 0; i < record->nfragment; i++) sum += record->fragment[i].size;
    return record->nfragment ? sum / (double)record->nfragment : NAN;
}

fracas_summary fracas_summary_of(const fracas_record *record)
{
#define TAKE(key, type, value, meaning) .key = value,
    return (fracas_summary){FRACAS_EACH_SUMMARY(TAKE)};
}

bool fracas_same_real(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

bool fracas_summary_same(const fracas_summary *a, const fracas_summary *b)
{
#define SAME_INTEGER(x, y) ((x) == (y))
#define SAME_REAL(x, y) fracas_same_real(x, y)
#define SAME(key, type, value, meaning) &&SAME_##type(a->key, b->key)
    return true FRACAS_EACH_SUMMARY(SAME);
}
