/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/decision.h"

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

/* NaN equals NaN. */
static bool same_real(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

#define SAME_INTEGER(x, y) ((x) == (y))
#define SAME_REAL(x, y) same_real(x, y)
#define SAME(key, type, ignored, meaning) &&SAME_##type(a->key, b->key)

bool fracas_summary_same(const fracas_summary *a, const fracas_summary *b)
{
    return true FRACAS_EACH_SUMMARY(SAME);
}

bool fracas_decision_same(const fracas_decision *a, const fracas_decision *b)
{
    return true FRACAS_EACH_DECISION(SAME);
}

bool fracas_decision_valid(const fracas_decision *d)
{
    return d->round >= 0 && d->replicas > 0 && d->used >= 0 && d->used <= d->replicas &&
           d->stop >= 0 && d->stop <= 2 && d->quantity >= 0 && d->quantity <= 2;
}

double fracas_decision_relative(const fracas_decision *decision)
{
    return decision->half_width == 0 ? 0 : decision->half_width / fabs(decision->mean);
}
