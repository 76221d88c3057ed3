/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/compare/methods.h"
#include "analysis/estimate/bootstrap.h"
#include "analysis/data/room.h"

#include <gsl/gsl_combination.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <string.h>

static const double hair = 1e-10; /* statistics equal to rounding are equal */

typedef struct {
    double *sum, *square, *known; /* a value each */
    double *cut;                  /* fragments up to each cut, and all of them */
} totals;

typedef struct {
    const fracas_two_samples *of;
    size_t n;                   /* na + nb */
    double *value;              /* less their mean, over their deviation: for less rounding */
    bool *in_a;                 /* the assignment */
    totals a, all;              /* side a, and both sides */
    double *statistic;          /* nvalues + 1 */
    double *observed, *reached; /* nvalues + 1 */
} permuter;

static void standardise(permuter *p)
{
    for (size_t v = 0; v < p->of->nvalues; v++) {
        double n = 0, mean = 0, squares = 0;
        for (size_t i = 0; i < p->n; i++) {
            const double x = p->of->value[i * p->of->nvalues + v];
            if (!isfinite(x)) continue;
            n++;
            const double step = x - mean;
            mean += step / n;
            squares += step * (x - mean);
        }
        const double deviation = sqrt(squares / n);
        for (size_t i = 0; i < p->n; i++) {
            const double x = p->of->value[i * p->of->nvalues + v];
            p->value[i * p->of->nvalues + v] = deviation > 0 ? (x - mean) / deviation : x - mean;
        }
    }
}

static void take_totals(fracas_room *room, const fracas_two_samples *of, totals *t)
{
    FRACAS_TAKE(room, t->sum, of->nvalues);
    FRACAS_TAKE(room, t->square, of->nvalues);
    FRACAS_TAKE(room, t->known, of->nvalues);
    FRACAS_TAKE(room, t->cut, of->ncuts);
}

static void add_up(const permuter *p, bool all, totals *to)
{
    const size_t nv = p->of->nvalues, nc = p->of->ncuts;
    memset(to->sum, 0, nv * sizeof *to->sum);
    memset(to->square, 0, nv * sizeof *to->square);
    memset(to->known, 0, nv * sizeof *to->known);
    memset(to->cut, 0, (nc + 1) * sizeof *to->cut);
    for (size_t i = 0; i < p->n; i++) {
        if (!all && !p->in_a[i]) continue;
        for (size_t v = 0; v < nv; v++) {
            const double x = p->value[i * nv + v];
            if (!isfinite(x)) continue;
            to->sum[v] += x;
            to->square[v] += x * x;
            to->known[v]++;
        }
        const double *below = p->of->below + i * nc;
        for (size_t c = 0; c < nc; c++) to->cut[c] += below[c];
        to->cut[nc] += p->of->fragments[i];
    }
}

/* |T| of one value  (compare.6) */
static double welch(const permuter *p, size_t v)
{
    const double sum = p->a.sum[v], square = p->a.square[v], n = p->a.known[v];
    const double rest = p->all.sum[v] - sum, m = p->all.known[v] - n;
    const double mean = sum / n, other = rest / m;
    if (!(n >= 2 && m >= 2)) return NAN;
    double a = (square - sum * mean) / (n - 1),
           b = (p->all.square[v] - square - rest * other) / (m - 1);
    a = a > hair ? a : 0; /* equal values, over a deviation of 1 */
    b = b > hair ? b : 0;
    const double difference = fabs(mean - other);
    return difference < hair ? 0 : difference / sqrt(a / n + b / m);
}

/* |mean of the differences| of pairs  (compare.8) */
static double paired(const permuter *p, size_t v)
{
    double sum = 0, n = 0;
    const size_t pairs = p->of->na, nv = p->of->nvalues;
    for (size_t i = 0; i < pairs; i++) {
        const double d = p->value[(pairs + i) * nv + v] - p->value[i * nv + v];
        if (!isfinite(d)) continue;
        sum += p->in_a[i] ? d : -d;
        n++;
    }
    return n < 2 ? NAN : fabs(sum / n);
}

/* (compare.9) */
static double distance(const permuter *p)
{
    double most = 0;
    const size_t nc = p->of->ncuts;
    const double *cut = p->a.cut, *all = p->all.cut;
    const double a = cut[nc], b = all[nc] - a;
    if (!(a > 0 && b > 0)) return NAN;
    for (size_t c = 0; c < nc; c++) most = fmax(most, fabs(cut[c] / a - (all[c] - cut[c]) / b));
    return most;
}

static void evaluate(permuter *p)
{
    add_up(p, false, &p->a);
    for (size_t v = 0; v < p->of->nvalues; v++)
        p->statistic[v] = p->of->paired ? paired(p, v) : welch(p, v);
    p->statistic[p->of->nvalues] = distance(p);
}

/* A permutation without a statistic counts as one beyond the observed: p is not too small. */
static void take(permuter *p)
{
    evaluate(p);
    for (size_t v = 0; v <= p->of->nvalues; v++)
        if (!(p->statistic[v] < p->observed[v] * (1 - hair) - (isinf(p->observed[v]) ? 0 : 1e-14)))
            p->reached[v]++;
}

static void flip(permuter *p, size_t pair, bool swapped)
{
    p->in_a[pair] = !swapped;
    p->in_a[p->of->na + pair] = swapped;
}

/* Every assignment; returns how many. */
static fracas_err enumerate(permuter *p, int64_t *count)
{
    *count = 0;
    for (uint64_t word = 0; p->of->paired && word < UINT64_C(1) << p->of->na; word++, ++*count) {
        for (size_t i = 0; i < p->of->na; i++) flip(p, i, word >> i & 1);
        take(p);
    }
    if (p->of->paired) return FRACAS_OK;
    gsl_combination *chosen = gsl_combination_calloc(p->n, p->of->na);
    if (!chosen) return fracas_no_memory("a permutation test");
    do {
        memset(p->in_a, 0, p->n * sizeof *p->in_a);
        for (size_t i = 0; i < p->of->na; i++) p->in_a[gsl_combination_get(chosen, i)] = true;
        take(p);
        ++*count;
    } while (gsl_combination_next(chosen) == GSL_SUCCESS);
    gsl_combination_free(chosen);
    return FRACAS_OK;
}

static fracas_err draw(permuter *p, int64_t permutations, uint64_t seed)
{
    OWN(gsl_rng) random = fracas_random(seed);
    if (!random) return fracas_no_memory("a permutation test");
    for (int64_t b = 0; b < permutations; b++) {
        if (p->of->paired) {
            for (size_t i = 0; i < p->of->na; i++) flip(p, i, gsl_rng_uniform_int(random, 2));
        } else { /* a random order of the labels: Fisher and Yates */
            for (size_t i = p->n; i-- > 1;) {
                const size_t j = gsl_rng_uniform_int(random, i + 1);
                const bool held = p->in_a[i];
                p->in_a[i] = p->in_a[j];
                p->in_a[j] = held;
            }
        }
        take(p);
    }
    return FRACAS_OK;
}

/* (compare.7) */
fracas_err fracas_permutation_test(const fracas_two_samples *samples, int64_t permutations,
                                   uint64_t seed, fracas_permuted *result, int64_t *count,
                                   bool *exact)
{
    const size_t nv = samples->nvalues, n = samples->na + samples->nb;
    for (size_t v = 0; v <= nv; v++) result[v] = (fracas_permuted){NAN, NAN};
    *count = 0;
    *exact = false;
    if (samples->na == 0 || samples->nb == 0) return FRACAS_OK;
    permuter p = {.of = samples, .n = n};
    FRACAS_CLEARED(fracas_room) room = {0};
    FRACAS_TAKE(&room, p.value, n * nv);
    FRACAS_TAKE(&room, p.in_a, n);
    take_totals(&room, samples, &p.a);
    take_totals(&room, samples, &p.all);
    FRACAS_TAKE(&room, p.statistic, nv);
    FRACAS_TAKE(&room, p.observed, nv);
    FRACAS_TAKE(&room, p.reached, nv);
    TRY(fracas_room_check(&room, "a permutation test"));
    standardise(&p);
    add_up(&p, true, &p.all);
    for (size_t i = 0; i < n; i++) p.in_a[i] = i < samples->na;
    evaluate(&p);
    memcpy(p.observed, p.statistic, (nv + 1) * sizeof *p.observed);
    const double all = samples->paired ? exp2((double)samples->na)
                                       : exp(gsl_sf_lnchoose((unsigned)n, (unsigned)samples->na));
    *exact = all < (double)permutations + 1.5;
    if (*exact) {
        TRY(enumerate(&p, count));
    } else {
        TRY(draw(&p, permutations, seed));
        *count = permutations + 1;
        for (size_t v = 0; v <= nv; v++) p.reached[v]++; /* the observed one */
    }
    for (size_t v = 0; v <= nv; v++)
        if (!isnan(p.observed[v])) result[v].p = p.reached[v] / (double)*count;
    result[nv].distance = p.observed[nv];
    return FRACAS_OK;
}
