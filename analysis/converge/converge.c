/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/converge/rows.h"

#include "analysis/compare/methods.h"
#include "analysis/data/room.h"
#include "base/own.h"
#include "base/text.h"

#include <gsl/gsl_cdf.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const fracas_number_verdict_name[FRACAS_NUMBER_VERDICTS] = {"moved", "shifted", "holds",
                                                                        "unclear", "unknown"};

/* ---- notes ---- */

static fracas_err add_note(fracas_convergence *convergence, const char *refinement, size_t point,
                           fracas_convergence_note **note)
{
    TRY(fracas_grow(&convergence->note, sizeof *convergence->note, convergence->nnotes,
                    &convergence->note_room, "the notes of the convergence"));
    *note = &convergence->note[convergence->nnotes++];
    (*note)->refinement = refinement;
    (*note)->point = point;
    return FRACAS_OK;
}

/* "7 of 10 realizations ended ENERGY_DRIFT, 1 NONFINITE: judged from 2" */
static void write_lost(const fracas_point_statistics *of, size_t judged, char *text, size_t size)
{
    char first[64];
    FRACAS_PRINT(first, " of %" PRId64 " realizations ended", of->realizations);
    *text = '\0';
    for (int o = FRACAS_NONFINITE; o <= FRACAS_FAILED; o++)
        if (of->outcome[o] > 0)
            fracas_append(text, size, ", ", "%" PRId64 "%s %s", of->outcome[o], *text ? "" : first,
                          fracas_outcome_name(o));
    if (judged > 0) fracas_append(text, size, "", ": judged from %zu", judged);
    else fracas_append(text, size, "", ": none is left, its numbers are unknown");
}

/* The outcomes of unusable realizations, with `judged`, the number of realizations behind its
 * numbers (0: unknown); and whether every usable one stays whole. */
static fracas_err note_point(fracas_convergence *convergence, const char *refinement, size_t point,
                             const fracas_point_statistics *of, size_t judged)
{
    fracas_convergence_note *note;
    if (of->usable < of->realizations) {
        TRY(add_note(convergence, refinement, point, &note));
        write_lost(of, judged, note->text, sizeof note->text);
    }
    if (of->usable == 0 || of->outcome[FRACAS_INTACT] != of->usable) return FRACAS_OK;
    TRY(add_note(convergence, refinement, point, &note));
    FRACAS_PRINT(
        note->text,
        "all %" PRId64
        " usable realizations end INTACT: nothing breaks, and nothing is judged of how it breaks",
        of->usable);
    return FRACAS_OK;
}

/* The number of warnings in the report of a study, if any, and the command to show them. */
static fracas_err note_study(fracas_convergence *convergence, const char *refinement,
                             const fracas_analysis *analysis, const char *study)
{
    fracas_convergence_note *note;
    OWNED fracas_warning_line *line = NULL;
    size_t count;
    TRY(fracas_analysis_warning_lines(analysis, &line, &count));
    if (count == 0) return FRACAS_OK;
    TRY(add_note(convergence, refinement, SIZE_MAX, &note));
    FRACAS_PRINT(note->text, "its report has %zu warning%s: fracas report %.390s", count,
                 count == 1 ? "" : "s", fracas_shell_path(study, NULL).text);
    return FRACAS_OK;
}

static fracas_err note_base(fracas_convergence *convergence, const char *study)
{
    const fracas_analysis *base = convergence->study;
    for (size_t p = 0; p < base->table->npoints; p++)
        TRY(note_point(convergence, "base", p, &base->point[p],
                       base->point[p].ensemble.nrealizations));
    return note_study(convergence, "base", base, study);
}

fracas_err fracas_convergence_create(const char *study, double tolerance,
                                     fracas_convergence **convergence)
{
    *convergence = NULL;
    fracas_convergence *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("the convergence");
    made->tolerance = tolerance;
    fracas_err err = fracas_analysis_create(study, NULL, NULL, &made->study);
    if (!err) err = note_base(made, study);
    if (err) fracas_convergence_destroy(made);
    else *convergence = made;
    return err;
}

void fracas_convergence_destroy(fracas_convergence *convergence)
{
    if (!convergence) return;
    fracas_analysis_destroy(convergence->study);
    free(convergence->row);
    free(convergence->note);
    free(convergence);
}

/* ---- rows ---- */

static double value_of(const fracas_ensemble *ensemble, size_t i, const fracas_number *number)
{
    return *(const double *)(const void *)((const char *)&ensemble->value[i] + number->value);
}

/* The same number of two points, realization by realization: only complete pairs, or all. */
typedef struct {
    size_t n[2];
    double *value[2];
} two_samples;

static void gather(const fracas_ensemble *before, const fracas_ensemble *after,
                   const fracas_number *number, bool paired, two_samples *to)
{
    to->n[0] = to->n[1] = 0;
    for (size_t i = 0, k = 0; i < before->nrealizations; i++) {
        while (paired && k < after->nrealizations && after->replica[k] < before->replica[i]) k++;
        const bool found = k < after->nrealizations && after->replica[k] == before->replica[i];
        if (paired && !found) continue;
        to->value[0][to->n[0]++] = value_of(before, i, number);
        if (paired) to->value[1][to->n[1]++] = value_of(after, k, number);
    }
    for (size_t k = 0; !paired && k < after->nrealizations; k++)
        to->value[1][to->n[1]++] = value_of(after, k, number);
}

/* All realizations are alike: they do not say how far the difference scatters, and of few of them
 * it may be chance. */
static bool is_alike(const fracas_compared_value *value)
{
    return !(value->high > value->low);
}

/* Relative change; a change within rounding counts as none (convergence.1), (convergence.2) */
static void put_parts(fracas_compared_value *value)
{
    const double base = fabs(value->a.mean);
    if (fmax(fabs(value->low), fabs(value->high)) <= FRACAS_CONVERGENCE_ROUND_OFF * base)
        value->difference = value->low = value->high = 0; /* false of NaN */
    if (base == 0) return;
    value->relative = value->difference / base;
    value->relative_low = value->low / base;
    value->relative_high = value->high / base;
}

enum { ALIKE_LEAST = 8 }; /* two equal chances agree in all once in 128 times */

/* Two-sided, by Student's law: the intervals are of the same  (convergence.3) */
static double student(const fracas_compared_value *value)
{
    if (!isfinite(value->low)) return NAN;
    if (is_alike(value)) return value->difference == 0 ? 1 : NAN; /* no scatter, no law */
    const double error = 0.5 * (value->high - value->low) /
                         gsl_cdf_tdist_Pinv(0.975, value->freedom);
    return 2 * gsl_cdf_tdist_Q(fabs(value->difference) / error, value->freedom);
}

static bool is_zero(const fracas_estimate *estimate)
{
    return estimate->mean == 0 && !(estimate->deviation > 0);
}

/* True of a number without information: missing in a study, or 0 in all realizations of both. Where
 * a study has `lost` all realizations of the point, the numbers of the other are unknown, not idle;
 * where both have, the count stands for all. */
static bool is_idle(const fracas_convergence_row *row, bool lost)
{
    const fracas_compared_value *value = &row->value;
    const bool a = value->a.n > 0, b = value->b.n > 0, zero_a = is_zero(&value->a),
               zero_b = is_zero(&value->b);
    if (lost)
        return (!a || zero_a) && (!b || zero_b) &&
               row->number != &fracas_realization_numbers[FRACAS_NUMBER_count];
    return !a || !b || (zero_a && zero_b);
}

static bool is_same(double x, double y)
{
    return x == y || (isnan(x) && isnan(y));
}

static fracas_err add_row(fracas_convergence *convergence, const fracas_convergence_row *row)
{
    TRY(fracas_grow(&convergence->row, sizeof *convergence->row, convergence->nrows,
                    &convergence->room, "the convergence"));
    convergence->row[convergence->nrows++] = *row;
    return FRACAS_OK;
}

fracas_err fracas_convergence_compare(fracas_convergence *convergence, size_t p,
                                      const fracas_ensemble *after,
                                      const fracas_refinement_map *map)
{
    const fracas_ensemble *before = &convergence->study->point[p].ensemble;
    const bool lost = before->nrealizations == 0 || after->nrealizations == 0,
               paired = map->paired && !lost;
    double count[2] = {NAN, NAN}; /* without dust it is the count again */
    two_samples samples;
    FRACAS_CLEARED(fracas_room) room = {0};
    FRACAS_TAKE(&room, samples.value[0], before->nrealizations);
    FRACAS_TAKE(&room, samples.value[1], before->nrealizations + after->nrealizations);
    TRY(fracas_room_check(&room, "the realizations of two points"));
    for (size_t v = 0; v < FRACAS_FIRST_VALUES; v++) {
        fracas_convergence_row row = {.refinement = map->name,
                                      .point = p,
                                      .number = &fracas_realization_numbers[v],
                                      .paired = map->paired};
        gather(before, after, row.number, paired, &samples);
        if (paired)
            fracas_difference_of_pairs(samples.value[0], samples.value[1], samples.n[0], 1,
                                       &row.value);
        else
            fracas_difference_of(samples.value[0], samples.n[0], samples.value[1], samples.n[1], 1,
                                 &row.value);
        put_parts(&row.value);
        const bool counted = v == FRACAS_NUMBER_count_large &&
                             is_same(row.value.a.mean, count[0]) &&
                             is_same(row.value.b.mean, count[1]);
        if (v == FRACAS_NUMBER_count) count[0] = row.value.a.mean, count[1] = row.value.b.mean;
        row.value.p = student(&row.value);
        if (!counted && !is_idle(&row, lost)) TRY(add_row(convergence, &row));
    }
    return FRACAS_OK;
}

static fracas_err find_point(const fracas_analysis *study, const fracas_hash *hash, size_t *point)
{
    for (*point = 0; *point < study->table->npoints; ++*point)
        if (fracas_hash_equal(&study->table->point[*point].hash, hash)) return FRACAS_OK;
    return fracas_fail(
        FRACAS_DAMAGED,
        "the study %s has no point %s; it is of another campaign: remove it and run again",
        study->name, fracas_hash_hex(hash).text);
}

static fracas_err note_refined(fracas_convergence *convergence, size_t before,
                               const fracas_point_statistics *after,
                               const fracas_refinement_map *map)
{
    const fracas_ensemble *a = &convergence->study->point[before].ensemble, *b = &after->ensemble;
    size_t judged = a->nrealizations > 0 && !map->paired ? b->nrealizations : 0;
    for (size_t i = 0, k = 0; map->paired && i < a->nrealizations; i++) { /* as gather does */
        while (k < b->nrealizations && b->replica[k] < a->replica[i]) k++;
        judged += k < b->nrealizations && b->replica[k] == a->replica[i];
    }
    return note_point(convergence, map->name, before, after, judged);
}

fracas_err fracas_convergence_add(fracas_convergence *convergence, const char *study,
                                  const fracas_refinement_map *map)
{
    OWN(fracas_analysis) refined = NULL;
    TRY(fracas_analysis_create(study, NULL, NULL, &refined));
    for (size_t i = 0; i < map->npoints; i++) {
        size_t before, after;
        TRY(find_point(convergence->study, &map->before[i], &before));
        TRY(find_point(refined, &map->after[i], &after));
        TRY(fracas_convergence_compare(convergence, before, &refined->point[after].ensemble, map));
        TRY(note_refined(convergence, before, &refined->point[after], map));
    }
    return note_study(convergence, map->name, refined, study);
}

void fracas_convergence_leave(fracas_convergence *convergence, const char *refinement,
                              size_t points, const char *why)
{
    if (convergence->nleft == FRACAS_MOST_LEFT) return;
    convergence->left[convergence->nleft].refinement = refinement;
    convergence->left[convergence->nleft].points = points;
    convergence->left[convergence->nleft++].why = why;
}

/* ---- judgement ---- */

static bool is_within(const fracas_compared_value *value, double most)
{
    return value->relative_low >= -most && value->relative_high <= most;
}

static fracas_number_verdict judge(const fracas_convergence_row *row, double tolerance)
{
    const fracas_compared_value *value = &row->value;
    const double level = 0.05;
    if (!isfinite(value->low)) return FRACAS_NUMBER_UNKNOWN;
    if (is_alike(value)) {
        const int64_t least = row->number->continuous ? 2 : ALIKE_LEAST;
        const bool many = value->a.n >= least && value->b.n >= least;
        return many && value->difference == 0 ? FRACAS_NUMBER_HOLDS : FRACAS_NUMBER_UNCLEAR;
    }
    const bool differs = value->p_holm < level;
    if (is_within(value, tolerance)) return differs ? FRACAS_NUMBER_SHIFTED : FRACAS_NUMBER_HOLDS;
    return differs ? FRACAS_NUMBER_MOVED : FRACAS_NUMBER_UNCLEAR;
}

static void find_levels(fracas_convergence *convergence)
{
    convergence->nlevels = 0;
    for (size_t i = 0; i < convergence->nrows && convergence->nlevels < FRACAS_MOST_LEFT; i++)
        if (i == 0 ||
            strcmp(convergence->row[i].refinement, convergence->row[i - 1].refinement) != 0)
            convergence->level[convergence->nlevels++] = convergence->row[i].refinement;
}

fracas_err fracas_convergence_judge(fracas_convergence *convergence)
{
    find_levels(convergence);
    OWNED double *p = calloc(2 * convergence->nrows + 1, sizeof *p);
    if (!p) return fracas_no_memory("the p-values");
    double *corrected = p + convergence->nrows;
    for (size_t i = 0; i < convergence->nrows; i++) p[i] = convergence->row[i].value.p;
    TRY(fracas_holm(p, convergence->nrows, 1, corrected));
    for (size_t i = 0; i < convergence->nrows; i++) {
        fracas_convergence_row *row = &convergence->row[i];
        row->value.p_holm = corrected[i];
        row->verdict = judge(row, convergence->tolerance);
    }
    return FRACAS_OK;
}

/* An interval falls as n^(-1/2), and its quantile to the normal one  (convergence.4) */
double fracas_convergence_replicas(const fracas_convergence *convergence,
                                   const fracas_convergence_row *row)
{
    const fracas_compared_value *value = &row->value;
    const double n = fmin((double)value->a.n, (double)value->b.n),
                 reach = 0.5 * (value->relative_high - value->relative_low);
    const double t = value->freedom > 0 ? gsl_cdf_tdist_Pinv(0.975, value->freedom)
                                        : gsl_cdf_ugaussian_Pinv(0.975);
    const double part = reach / (0.5 * convergence->tolerance) * gsl_cdf_ugaussian_Pinv(0.975) / t;
    return fmax(ALIKE_LEAST, ceil(n * part * part));
}
