/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/estimate/final.h"

#include "base/param.h"

#include <math.h>

/* As of the rule `settled`, for the means. `reach`: transits to give a campaign that ends by time
 * (docs/theory/settled.md). */
typedef struct {
    double transits, reach;
} needs;
static const needs of_chains = {20, 40}, of_surfaces = {60, 60};
static const double growth_allowed = 0.03, rest_allowed = 0.02, fewest = 15;
/* Surfaces whose growth predicts their final count, and how far that may be off. */
static const double growth_tells = 20, surface_margin = 0.02;
/* Bodies creep from this vibrating by dissipated energy on: six creeping bars, 22 others. */
static const double creep_begins = 0.38;

#define FINAL(key, unit, doc, member) FRACAS_FIELD(fracas_final, NUMBER, key, unit, doc, member)
static const fracas_field fields[] = {
    FINAL("transits", "1", "transits of a mean fragment since the first onset", transits),
    FINAL("growth", "1", "share of the fragments that the last half of that time added", growth),
    FINAL("rest", "1", "breaks still expected by the fragments' energies; null of surfaces", rest),
    FINAL("bound", "1", "breaks that those energies can pay for; null of surfaces", bound),
    FINAL("held", "1", "fragments on an edge that moves with the load", held),
    FINAL("vibrating", "1", "vibrating / dissipated energy", vibrating),
    FRACAS_FIELD_OF(fracas_final, fracas_interval_fields, "count", "1",
                    "estimate of the final count, without held fragments", count),
};
const fracas_fields fracas_final_fields = FRACAS_FIELDS(fields);

void fracas_final_add(fracas_final *final, const fracas_record *record)
{
    const double count = (double)(record->fragments - record->fragments_held);
    if (!isfinite(record->transits)) return;
    final->realizations++;
    final->transits += record->transits;
    final->growth += count > 0 ? record->growth * count : 0;
    final->rest += record->rest;
    final->variance += record->rest_variance;
    final->bound += record->rest_bound;
    final->held += (double)record->fragments_held;
    final->seen += count;
    for (size_t i = 0; i < record->nfragment; i++)
        final->elements += (double)record->fragment[i].elements;
    if (record->nfragment > 0) final->elements -= (double)record->fragments_held;
    final->onset += record->onset_time;
    final->end += record->end_time;
    if (record->dissipated > 0) final->vibrating += record->vibrating / record->dissipated;
}

/* Least and most of 14 surfaces: share of the final count at k transits. */
static void shares_at(double k, double *low, double *high)
{
    static const double at[][3] = {
        {0, 0, 0.5}, {5, 0.37, 0.71}, {10, 0.64, 0.84}, {20, 0.865, 0.95}};
    size_t i = 1;
    while (i + 1 < FRACAS_COUNT(at) && k > at[i][0]) i++;
    const double part = fmin(1, (k - at[i - 1][0]) / (at[i][0] - at[i - 1][0]));
    *low = at[i - 1][1] + part * (at[i][1] - at[i - 1][1]);
    *high = at[i - 1][2] + part * (at[i][2] - at[i - 1][2]);
}

static double at_most(double count, const fracas_final *f)
{
    return f->elements > 0 && count > f->elements ? f->elements : count;
}

static void estimate(fracas_final *f)
{
    double low, high;
    if (isfinite(f->rest)) {
        f->count.value = f->seen + f->rest;
        f->count.low = f->seen;
        f->count.high = f->seen +
                        fmin(f->bound, 1.5 * f->rest + 2 * sqrt(f->variance / f->realizations));
    } else if (f->transits >= growth_tells) {
        f->count.value = f->seen * (1 + f->growth);
        f->count.low = f->seen;
        f->count.high = f->seen * (1 + f->growth + surface_margin);
    } else {
        shares_at(f->transits, &low, &high);
        f->count.value = f->seen * 2 / (low + high);
        f->count.low = f->seen / high;
        f->count.high = f->seen / low;
    }
    f->count.value = at_most(f->count.value, f);
    f->count.low = at_most(f->count.low, f);
    f->count.high = at_most(f->count.high, f);
}

static fracas_finality judge(const fracas_final *f, const needs *need)
{
    const bool chain = need == &of_chains;
    if (f->bound == 0) return FRACAS_FINAL_YES;            /* no energy pays for a break */
    if (f->count.high <= f->seen) return FRACAS_FINAL_YES; /* all elements are apart */
    if (!(f->transits >= need->transits)) return FRACAS_FINAL_NO;
    if (chain && f->vibrating > creep_begins) return FRACAS_FINAL_CREEP;
    return f->growth <= growth_allowed &&
                   (!chain || f->rest <= rest_allowed * fmax(f->seen, fewest))
               ? FRACAS_FINAL_YES
               : FRACAS_FINAL_NO;
}

/* (settled.8) */
void fracas_final_count(fracas_final *f)
{
    const double n = f->realizations;
    double *const mean[] = {&f->transits, &f->rest,      &f->variance, &f->bound, &f->held,
                            &f->seen,     &f->vibrating, &f->onset,    &f->end,   &f->elements};
    f->growth = f->seen > 0 ? f->growth / f->seen : NAN;
    for (size_t i = 0; i < FRACAS_COUNT(mean); i++) *mean[i] = n > 0 ? *mean[i] / n : NAN;
    f->count = (fracas_interval){.value = NAN, .low = NAN, .high = NAN};
    f->verdict = FRACAS_FINAL_NONE;
    if (!(f->seen > 1)) return;
    estimate(f);
    const needs *const need = isfinite(f->rest) ? &of_chains : &of_surfaces;
    const double longer = need->reach / f->transits;
    f->reach = f->onset + (f->end - f->onset) * (longer > 1.1 ? longer : 2);
    f->verdict = judge(f, need);
}
