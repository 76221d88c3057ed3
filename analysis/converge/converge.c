#include "analysis/converge/rows.h"

#include <math.h>
#include <stdlib.h>

const char *const fracas_number_verdict_name[FRACAS_NUMBER_VERDICTS] = {"moved", "shifted", "holds", "unclear", "unknown"};

#define HEADLINE(key, unit, member) {key, unit, offsetof(fracas_replica_values, member)}
const fracas_headline fracas_headlines[FRACAS_NHEADLINES] = {
    HEADLINE("count", "1", count),           HEADLINE("count_large", "1", count_large),
    HEADLINE("size", "m", size),             HEADLINE("dissipated", "J", dissipated),
    HEADLINE("dissipated_bending", "J", bending), HEADLINE("onset_time", "s", onset_time),
};

fracas_err fracas_convergence_create(const char *study, double tolerance, fracas_convergence **convergence)
{
    *convergence = NULL;
    fracas_convergence *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("the convergence");
    made->tolerance = tolerance;
    fracas_err err = fracas_analysis_create(study, &made->study);
    if (err) fracas_convergence_destroy(made);
    else *convergence = made;
    return err;
}

void fracas_convergence_destroy(fracas_convergence *convergence)
{
    if (!convergence) return;
    fracas_analysis_destroy(convergence->study);
    free(convergence->row);
    free(convergence);
}

/* ---- rows ---- */

static double value_of(const fracas_ensemble *ensemble, size_t i, size_t headline)
{
    return *(const double *)(const void *)((const char *)&ensemble->value[i] + fracas_headlines[headline].offset);
}

static fracas_estimate estimate(const fracas_ensemble *ensemble, size_t headline)
{
    static const fracas_replica_values nothing;
    const char *first = (const char *)(ensemble->nrealizations ? ensemble->value : &nothing);
    return fracas_estimate_of((const double *)(const void *)(first + fracas_headlines[headline].offset), FRACAS_REPLICA_STRIDE,
                              ensemble->nrealizations);
}

/* Of the replicas that both have. */
static fracas_err compare_pairs(const fracas_ensemble *before, const fracas_ensemble *after, fracas_convergence_row *row)
{
    double *difference = malloc((before->nrealizations + 1) * sizeof *difference);
    if (!difference) return fracas_no_memory("the pairs of realizations");
    size_t n = 0;
    for (size_t i = 0, k = 0; i < before->nrealizations; i++) { /* both in the order of their replicas */
        while (k < after->nrealizations && after->replica[k] < before->replica[i]) k++;
        if (k < after->nrealizations && after->replica[k] == before->replica[i])
            difference[n++] = value_of(after, k, row->headline) - value_of(before, i, row->headline);
    }
    const fracas_estimate pairs = fracas_estimate_of(difference, 1, n);
    free(difference);
    row->pairs = (size_t)pairs.n;
    row->difference = fracas_difference_of_pairs(&pairs);
    return FRACAS_OK;
}

/* True of a number that says nothing: that no realization has, that is 0 in all of them, or that is the count again. */
static bool is_idle(const fracas_convergence_row *row, const fracas_ensemble *before, const fracas_ensemble *after)
{
    const fracas_estimate *a = &row->before, *b = &row->after;
    if (a->n == 0 && b->n == 0) return true;
    if (a->mean == 0 && b->mean == 0 && !(a->deviation > 0) && !(b->deviation > 0)) return true;
    return fracas_headlines[row->headline].offset == offsetof(fracas_replica_values, count_large) && a->mean == estimate(before, 0).mean &&
           b->mean == estimate(after, 0).mean; /* dust only ever takes away */
}

static fracas_err add_row(fracas_convergence *convergence, const fracas_convergence_row *row)
{
    if (convergence->nrows == convergence->room) {
        const size_t room = 2 * convergence->room + 64;
        fracas_convergence_row *more = realloc(convergence->row, room * sizeof *more);
        if (!more) return fracas_no_memory("the convergence");
        convergence->row = more;
        convergence->room = room;
    }
    convergence->row[convergence->nrows++] = *row;
    return FRACAS_OK;
}

static fracas_err compare_point(fracas_convergence *convergence, size_t p, const fracas_ensemble *after, const fracas_refinement_map *map)
{
    const fracas_ensemble *before = &convergence->study->point[p].ensemble;
    for (size_t h = 0; h < FRACAS_NHEADLINES; h++) {
        fracas_convergence_row row = {.refinement = map->name, .point = p, .headline = h, .paired = map->paired,
                                      .before = estimate(before, h), .after = estimate(after, h)};
        if (is_idle(&row, before, after)) continue;
        if (map->paired) TRY(compare_pairs(before, after, &row));
        else row.difference = fracas_difference_of_samples(&row.before, &row.after);
        TRY(add_row(convergence, &row));
    }
    return FRACAS_OK;
}

static fracas_err find_point(const fracas_analysis *study, const fracas_hash *hash, size_t *point)
{
    char hex[FRACAS_HASH_HEX];
    for (*point = 0; *point < study->table->npoints; ++*point)
        if (fracas_hash_equal(&study->table->point[*point].hash, hash)) return FRACAS_OK;
    fracas_hash_hex(hash, hex);
    return fracas_fail(FRACAS_DAMAGED, "the study %s has no point %s; it is of another campaign: remove it and run again", study->name, hex);
}

fracas_err fracas_convergence_add(fracas_convergence *convergence, const char *study, const fracas_refinement_map *map)
{
    fracas_analysis *refined;
    TRY(fracas_analysis_create(study, &refined));
    fracas_err err = FRACAS_OK;
    for (size_t i = 0; i < map->npoints && !err; i++) {
        size_t before, after;
        err = find_point(convergence->study, &map->before[i], &before);
        if (!err) err = find_point(refined, &map->after[i], &after);
        if (!err) err = compare_point(convergence, before, &refined->point[after].ensemble, map);
    }
    fracas_analysis_destroy(refined);
    return err;
}

void fracas_convergence_leave(fracas_convergence *convergence, const char *refinement, size_t points, const char *why)
{
    if (convergence->nleft == FRACAS_MOST_LEFT) return;
    convergence->left[convergence->nleft].refinement = refinement;
    convergence->left[convergence->nleft].points = points;
    convergence->left[convergence->nleft++].why = why;
}

/* ---- judgement ---- */

static bool is_within(const fracas_difference *difference, double most)
{
    return difference->low >= -most && difference->high <= most;
}

static fracas_number_verdict judge(const fracas_convergence_row *row, double tolerance)
{
    const double level = 0.05, round_off = 1e-9, number = fabs(row->before.mean);
    if (isnan(row->difference.p)) return FRACAS_NUMBER_UNKNOWN;
    const bool differs = row->adjusted < level && !is_within(&row->difference, round_off * number);
    if (is_within(&row->difference, tolerance * number)) return differs ? FRACAS_NUMBER_SHIFTED : FRACAS_NUMBER_HOLDS;
    return differs ? FRACAS_NUMBER_MOVED : FRACAS_NUMBER_UNCLEAR;
}

fracas_err fracas_convergence_judge(fracas_convergence *convergence)
{
    double *p = malloc((convergence->nrows + 1) * sizeof *p);
    if (!p) return fracas_no_memory("the p-values");
    for (size_t i = 0; i < convergence->nrows; i++) p[i] = convergence->row[i].difference.p;
    fracas_err err = fracas_difference_adjust(p, convergence->nrows);
    for (size_t i = 0; i < convergence->nrows && !err; i++) {
        convergence->row[i].adjusted = p[i];
        convergence->row[i].verdict = judge(&convergence->row[i], convergence->tolerance);
    }
    free(p);
    return err;
}

/* An interval falls as n^(-1/2). */
double fracas_convergence_replicas(const fracas_convergence *convergence, const fracas_convergence_row *row)
{
    const double n = row->paired ? (double)row->pairs : fmin((double)row->before.n, (double)row->after.n);
    const double reach = row->difference.high - row->difference.value, wanted = 0.5 * convergence->tolerance * fabs(row->before.mean);
    return wanted > 0 ? ceil(n * (reach / wanted) * (reach / wanted)) : NAN;
}
