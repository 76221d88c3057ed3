/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/compare/compare.h"

#include "analysis/compare/methods.h"
#include "analysis/data/room.h"
#include "analysis/summary/study.h"
#include "base/own.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cuts of the sizes: more than CUTS would not be seen, and each is a sum over realizations in every
 * permutation, of which there are no more than SUMS at a time. */
enum { CUTS = 256, LEAST_CUTS = 16, SUMS = 200000 };

/* The compared realizations of both points, those of A first. */
typedef struct {
    size_t na, nb;
    const fracas_ensemble *a, *b;
    size_t *index;             /* na + nb: which of the ensemble */
    double *value;             /* (na + nb) x FRACAS_COMPARED_VALUES */
    double *below, *fragments; /* as fracas_two_samples has them */
    double *cut;               /* ascending */
    size_t ncuts;
} gathered;

/* Both are ascending by replica in a study's order; a replica missing on one side is left out. */
static void pair_up(gathered *of)
{
    size_t pairs = 0;
    for (size_t i = 0; i < of->a->nrealizations; i++)
        for (size_t j = 0; j < of->b->nrealizations; j++) {
            if (of->a->replica[i] != of->b->replica[j]) continue;
            of->index[pairs] = i;
            of->index[of->a->nrealizations + pairs++] = j;
            break;
        }
    memmove(of->index + pairs, of->index + of->a->nrealizations, pairs * sizeof *of->index);
    of->na = of->nb = pairs;
}

static bool same_but_rounding(double a, double b)
{
    return fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b));
}

/* Values that differ by rounding alone are made equal. Else an onset time would seem to differ, and
 * surely, by a parameter without influence on it. */
static void forget_rounding(gathered *of, bool paired)
{
    const size_t nv = FRACAS_COMPARED_VALUES, n = of->na + of->nb;
    for (size_t v = 0; v < nv; v++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t i = 0; i < n; i++) {
            least = fmin(least, of->value[i * nv + v]); /* the number where the other is NaN */
            most = fmax(most, of->value[i * nv + v]);
        }
        for (size_t i = 0; i < n && same_but_rounding(least, most); i++)
            if (isfinite(of->value[i * nv + v])) of->value[i * nv + v] = least;
        for (size_t i = 0; i < of->na && paired; i++) {
            double *a = &of->value[i * nv + v], *b = a + of->na * nv;
            if (same_but_rounding(*a, *b)) *b = *a;
        }
    }
}

static fracas_err gather(const fracas_ensemble *a, const fracas_ensemble *b, bool paired,
                         fracas_room *room, gathered *of)
{
    *of = (gathered){.na = a->nrealizations, .nb = b->nrealizations, .a = a, .b = b};
    const size_t n = of->na + of->nb;
    FRACAS_TAKE(room, of->index, n);
    FRACAS_TAKE(room, of->value, n * FRACAS_COMPARED_VALUES);
    FRACAS_TAKE(room, of->below, n * CUTS);
    FRACAS_TAKE(room, of->fragments, n);
    FRACAS_TAKE(room, of->cut, CUTS);
    TRY(fracas_room_check(room, "the realizations of two points"));
    for (size_t i = 0; i < n; i++) of->index[i] = i < of->na ? i : i - of->na;
    if (paired) pair_up(of);
    for (size_t i = 0; i < of->na + of->nb; i++) {
        const char *value = (const char *)&(i < of->na ? a : b)->value[of->index[i]];
        for (size_t v = 0; v < FRACAS_COMPARED_VALUES; v++)
            memcpy(&of->value[i * FRACAS_COMPARED_VALUES + v],
                   value + fracas_realization_numbers[v].value, sizeof *of->value);
    }
    forget_rounding(of, paired);
    return FRACAS_OK;
}

/* Cuts at which the distributions of sizes are compared: all sizes if they are few, else even ones
 * of them  (compare.9). */
static fracas_err make_cuts(gathered *of)
{
    size_t n = 0, distinct = 0;
    OWNED double *size = malloc((of->a->nfragments + of->b->nfragments + 1) * sizeof *size);
    if (!size) return fracas_no_memory("the fragments of two points");
    for (size_t i = 0; i < of->na + of->nb; i++) {
        const fracas_ensemble *from = i < of->na ? of->a : of->b;
        for (size_t f = from->first[of->index[i]]; f < from->first[of->index[i] + 1]; f++)
            size[n++] = from->size[f];
    }
    gsl_sort(size, 1, n);
    for (size_t i = 0; i < n; i++) /* sizes equal to rounding are one */
        if (i == 0 || size[i] > size[distinct - 1] * (1 + 1e-9)) size[distinct++] = size[i];
    const size_t affordable = SUMS / (of->na + of->nb + 1), most = affordable > CUTS ? CUTS
                                                                   : affordable < LEAST_CUTS
                                                                       ? LEAST_CUTS
                                                                       : affordable;
    of->ncuts = distinct < most ? distinct : most;
    for (size_t c = 0; c < of->ncuts; c++)
        of->cut[c] = size[distinct <= most ? c : c * (distinct - 1) / (most - 1)] * (1 + 1e-9);
    return FRACAS_OK;
}

static void count_below(gathered *of)
{
    for (size_t i = 0; i < of->na + of->nb; i++) {
        const fracas_ensemble *from = i < of->na ? of->a : of->b;
        const size_t begin = from->first[of->index[i]], end = from->first[of->index[i] + 1];
        double *below = of->below + i * of->ncuts;
        of->fragments[i] = (double)(end - begin);
        for (size_t f = begin; f < end; f++) {
            size_t low = 0, high = of->ncuts; /* the first cut not below the size */
            while (low < high) {
                const size_t middle = (low + high) / 2;
                if (of->cut[middle] < from->size[f]) low = middle + 1;
                else high = middle;
            }
            if (low < of->ncuts) below[low]++;
        }
        for (size_t c = 1; c < of->ncuts; c++) below[c] += below[c - 1];
    }
}

static fracas_err test(gathered *of, const fracas_compare_options *options,
                       fracas_compared_point *point)
{
    fracas_permuted result[FRACAS_COMPARED_VALUES + 1];
    TRY(make_cuts(of));
    count_below(of);
    const fracas_two_samples samples = {.na = of->na,
                                        .nb = of->nb,
                                        .paired = point->paired,
                                        .nvalues = FRACAS_COMPARED_VALUES,
                                        .value = of->value,
                                        .ncuts = of->ncuts,
                                        .below = of->below,
                                        .fragments = of->fragments};
    TRY(fracas_permutation_test(
        &samples, options->permutations > 0 ? options->permutations : FRACAS_COMPARE_PERMUTATIONS,
        options->seed + point->a + 1, result, &point->permutations, &point->exact));
    for (size_t v = 0; v < FRACAS_COMPARED_VALUES; v++) point->value[v].p = result[v].p;
    point->p = of->na > 1 && of->nb > 1 ? result[FRACAS_COMPARED_VALUES].p
                                        : NAN; /* one realization tells nothing of its scatter */
    point->distance = result[FRACAS_COMPARED_VALUES].distance;
    return FRACAS_OK;
}

static fracas_err compare_points(const fracas_analysis *a, const fracas_analysis *b,
                                 const fracas_compare_options *options,
                                 fracas_compared_point *point)
{
    const fracas_point_row *row_a = &a->table->point[point->a], *row_b = &b->table->point[point->b];
    const bool same = !memcmp(&row_a->hash, &row_b->hash, sizeof row_a->hash);
    point->paired = a->header.seed == b->header.seed && (same || options->common);
    point->label = fracas_analysis_label(a, point->a);
    fracas_match_differs(a->table, point->a, b->table, point->b, point->differs,
                         sizeof point->differs);
    const size_t nv = FRACAS_COMPARED_VALUES;
    gathered of = {.na = 0};
    FRACAS_CLEARED(fracas_room) room = {0};
    TRY(gather(&a->point[point->a].ensemble, &b->point[point->b].ensemble, point->paired, &room,
               &of));
    point->used_a = (int64_t)of.na;
    point->used_b = (int64_t)of.nb;
    for (size_t v = 0; v < nv; v++) {
        const double *first = of.value + v, *second = of.value + of.na * nv + v;
        if (point->paired) fracas_difference_of_pairs(first, second, of.na, nv, &point->value[v]);
        else fracas_difference_of(first, of.na, second, of.nb, nv, &point->value[v]);
    }
    return test(&of, options, point);
}

static fracas_err correct(fracas_comparison *comparison)
{
    const size_t stride = sizeof *comparison->point / sizeof(double);
    _Static_assert(sizeof *comparison->point % sizeof(double) == 0,
                   "points are strided over as doubles");
    for (size_t v = 0; v < FRACAS_COMPARED_VALUES && comparison->npoints; v++)
        TRY(fracas_holm(&comparison->point->value[v].p, comparison->npoints, stride,
                        &comparison->point->value[v].p_holm));
    return comparison->npoints ? fracas_holm(&comparison->point->p, comparison->npoints, stride,
                                             &comparison->point->p_holm)
                               : FRACAS_OK;
}

static fracas_err list_points(const fracas_analysis *a, const fracas_analysis *b,
                              const size_t *partner, fracas_comparison *comparison)
{
    const size_t na = a->table->npoints, nb = b->table->npoints;
    comparison->point = calloc(na + 1, sizeof *comparison->point);
    comparison->only_a = malloc((na + 1) * sizeof *comparison->only_a);
    comparison->only_b = malloc((nb + 1) * sizeof *comparison->only_b);
    if (!comparison->point || !comparison->only_a || !comparison->only_b)
        return fracas_no_memory("the points of two studies");
    for (size_t p = 0; p < na; p++) {
        if (partner[p] == SIZE_MAX) comparison->only_a[comparison->nonly_a++] = p;
        else
            comparison->point[comparison->npoints].a = p,
            comparison->point[comparison->npoints++].b = partner[p];
    }
    for (size_t q = 0; q < nb; q++) {
        bool taken = false;
        for (size_t p = 0; p < na; p++) taken = taken || partner[p] == q;
        if (!taken) comparison->only_b[comparison->nonly_b++] = q;
    }
    return FRACAS_OK;
}

/* ---- points of one study ---- */

/* "3,17" has two parts; longer lists are parted by a colon. */
static fracas_err part_lists(const char *points, char **first, const char **second)
{
    const size_t colon = strcspn(points, ":"), comma = strcspn(points, ","),
                 end = points[colon] ? colon : comma;
    if (!points[end] || (!points[colon] && strchr(points + end + 1, ',')))
        return fracas_fail(FRACAS_USAGE,
                           "points `%s`: give two points or ranges as 3,17 or 0-2,9-11, or two "
                           "lists as 0,1,2:9,10,11",
                           points);
    *first = strndup(points, end);
    *second = points + end + 1;
    return *first ? FRACAS_OK : fracas_no_memory("a list of points");
}

static fracas_err list_pairs(const fracas_analysis *of, const char *points,
                             fracas_comparison *comparison)
{
    OWNED char *first = NULL;
    OWNED size_t *a = NULL, *b = NULL;
    const char *second = NULL;
    size_t na, nb;
    TRY(part_lists(points, &first, &second));
    TRY(fracas_points_listed(first, of->table->npoints, &a, &na));
    TRY(fracas_points_listed(second, of->table->npoints, &b, &nb));
    if (na != nb)
        return fracas_fail(FRACAS_USAGE,
                           "points `%s`: %zu on one side and %zu on the other; they are compared "
                           "in their order, each with one",
                           points, na, nb);
    comparison->point = calloc(na + 1, sizeof *comparison->point);
    if (!comparison->point) return fracas_no_memory("the points of a study");
    comparison->listed = true;
    FRACAS_PRINT(comparison->how, "%s", points);
    for (size_t i = 0; i < na; i++) {
        if (a[i] == b[i])
            return fracas_fail(FRACAS_USAGE, "points `%s`: point %zu would be compared with itself",
                               points, a[i]);
        comparison->point[comparison->npoints].a = a[i];
        comparison->point[comparison->npoints++].b = b[i];
    }
    return FRACAS_OK;
}

static fracas_err list_partners(const fracas_analysis *a, const fracas_analysis *b, const char *by,
                                fracas_comparison *comparison)
{
    OWNED size_t *partner = malloc((a->table->npoints + 1) * sizeof *partner);
    if (!partner) return fracas_no_memory("the points of two studies");
    TRY(fracas_match_points(a->table, b->table, by, partner, comparison->how,
                            sizeof comparison->how));
    return list_points(a, b, partner, comparison);
}

/* ---- the whole ---- */

fracas_err fracas_compare(const fracas_analysis *a, const fracas_analysis *b,
                          const fracas_compare_options *options, fracas_comparison *comparison)
{
    *comparison = (fracas_comparison){0};
    TRY(options->points ? list_pairs(a, options->points, comparison)
                        : list_partners(a, b, options->by, comparison));
    for (size_t i = 0; i < comparison->npoints; i++)
        TRY(compare_points(a, b, options, &comparison->point[i]));
    return correct(comparison);
}

void fracas_comparison_clear(fracas_comparison *comparison)
{
    free(comparison->point);
    free(comparison->only_a);
    free(comparison->only_b);
    *comparison = (fracas_comparison){0};
}
