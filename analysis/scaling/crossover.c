/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/scaling/scaling.h"
#include "analysis/data/room.h"
#include "analysis/summary/study.h"
#include "base/own.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NUMBER(key, doc, member) FRACAS_FIELD(fracas_size_crossover, NUMBER, key, "1", doc, member)
#define INTERVAL(key, unit, doc, member) \
    FRACAS_FIELD_OF(fracas_size_crossover, fracas_interval_error_fields, key, unit, doc, member)
static const fracas_field fields[] = {
    FRACAS_FIELD(fracas_size_crossover, CHARS, "series", "", "name of the series", name),
    FRACAS_FIELD(fracas_size_crossover, INTEGER, "points", "1", "points in the fit", n),
    FRACAS_FIELD(fracas_size_crossover, REASON, "reason", "",
                 "why there is no crossover; null: there is one", reason),
    INTERVAL("rate", "1/s", "strain rate of the bend", rate),
    INTERVAL("rate_normalised", "1", "the same / edot0", rate_normalised),
    INTERVAL("size", "m", "mean size at low rates", size),
    INTERVAL("size_normalised", "1", "the same / s0", size_normalised),
    NUMBER("low_exponent", "exponent at low rates, 0 by the form", low_exponent),
    INTERVAL("high_exponent", "1", "exponent at high rates", exponent),
    NUMBER("chi2", "squared residuals of log(size), each over its variance", chi2),
    NUMBER("freedom", "degrees of freedom: points - 3", freedom),
    NUMBER("misfit", "probability of such a chi2 or more if the means are on the curve", misfit),
    NUMBER("pooled_freedom", "as of slopes", pooled),
    NUMBER("inflation", "factor of the standard errors, max(1, sqrt(chi2/freedom))", inflation),
    FRACAS_FIELD(fracas_size_crossover, INTEGER, "resamples", "1", "draws that gave a curve",
                 rate.resamples),
};
const fracas_fields fracas_crossover_fields = FRACAS_FIELDS(fields);

enum { SIZE, RATE, EXPONENT, NPARAMETERS }; /* log s_q, log edot_c, log k */

typedef struct {
    size_t n;
    double *x, *y, *error; /* log rate, log size, its standard error */
    fracas_mean *mean;
    fracas_mean_error *known; /* values behind the standard error */
    gsl_multifit_nlinear_workspace *solver;
    gsl_multifit_nlinear_fdf problem;
} fitter;

/* log(1 + e^z), and its slope. */
static double soft(double z, double *slope)
{
    *slope = 1 / (1 + exp(-z));
    return z > 0 ? z + log1p(exp(-z)) : log1p(exp(z));
}

/* log s  (scaling-laws.14) */
static double model(const double parameter[NPARAMETERS], double x)
{
    double slope;
    return parameter[SIZE] - soft(exp(parameter[EXPONENT]) * (x - parameter[RATE]), &slope);
}

static int residuals(const gsl_vector *parameter, void *context, gsl_vector *f)
{
    const fitter *of = context;
    for (size_t i = 0; i < of->n; i++)
        gsl_vector_set(f, i, (model(parameter->data, of->x[i]) - of->y[i]) / of->error[i]);
    return GSL_SUCCESS;
}

static int jacobian(const gsl_vector *parameter, void *context, gsl_matrix *J)
{
    const fitter *of = context;
    const double k = exp(gsl_vector_get(parameter, EXPONENT)), x0 = gsl_vector_get(parameter, RATE);
    for (size_t i = 0; i < of->n; i++) {
        const double z = k * (of->x[i] - x0);
        double slope;
        soft(z, &slope);
        gsl_matrix_set(J, i, SIZE, 1 / of->error[i]);
        gsl_matrix_set(J, i, RATE, slope * k / of->error[i]);
        gsl_matrix_set(J, i, EXPONENT, -slope * z / of->error[i]);
    }
    return GSL_SUCCESS;
}

/* chi2 of the least squares found from *parameter, which becomes them; NaN without any
 * (scaling-laws.15). */
static double descend(fitter *of, double parameter[NPARAMETERS])
{
    gsl_vector_view start = gsl_vector_view_array(parameter, NPARAMETERS);
    int info;
    if (gsl_multifit_nlinear_init(&start.vector, &of->problem, of->solver)) return NAN;
    if (gsl_multifit_nlinear_driver(200, 1e-9, 1e-9, 0, NULL, NULL, &info, of->solver)) return NAN;
    const gsl_vector *found = gsl_multifit_nlinear_position(of->solver),
                     *f = gsl_multifit_nlinear_residual(of->solver);
    double chi2 = 0;
    for (size_t i = 0; i < of->n; i++) chi2 += gsl_vector_get(f, i) * gsl_vector_get(f, i);
    for (size_t i = 0; i < NPARAMETERS; i++) parameter[i] = gsl_vector_get(found, i);
    return isfinite(parameter[SIZE] + parameter[RATE] + parameter[EXPONENT]) ? chi2 : NAN;
}

enum { MOST_BENDS = 50 };

/* The least chi2 from a bend at each rate, of many at MOST_BENDS of them, and two exponents. */
static double search(fitter *of, double best[NPARAMETERS])
{
    double least = NAN;
    const size_t bends = of->n < MOST_BENDS ? of->n : MOST_BENDS;
    for (size_t i = 0; i < 2 * bends; i++) {
        const double x = of->x[i / 2 * (of->n - 1) / (bends - 1)];
        double parameter[NPARAMETERS] = {of->y[0], x, i % 2 ? 0 : log(0.5)};
        const double chi2 = descend(of, parameter);
        if (!isfinite(chi2) || chi2 >= least) continue;
        least = chi2;
        for (size_t j = 0; j < NPARAMETERS; j++) best[j] = parameter[j];
    }
    return least;
}

/* Quantiles of `sign` exp(value): s_q and edot_c as they are, the exponent -k. */
static void summarise(double *found, size_t count, double best, double sign,
                      fracas_interval *interval)
{
    *interval = (fracas_interval){sign * exp(best), NAN, NAN, NAN, (int64_t)count};
    if (count < 20) return;
    for (size_t b = 0; b < count; b++) found[b] = sign * exp(found[b]);
    gsl_sort(found, 1, count);
    interval->standard_error =
        (fracas_quantile(found, count, 0.8413) - fracas_quantile(found, count, 0.1587)) / 2;
    interval->low = fracas_quantile(found, count, 0.025);
    interval->high = fracas_quantile(found, count, 0.975);
}

/* Tests whether the means are on the curve `best` with this chi2, and inflates their errors if they
 * are not. */
static fracas_err judge(fitter *of, double best[NPARAMETERS], double chi2,
                        fracas_size_crossover *crossover)
{
    gsl_vector_view at = gsl_vector_view_array(best, NPARAMETERS);
    gsl_matrix *covariance = gsl_matrix_alloc(NPARAMETERS, NPARAMETERS);
    if (!covariance) return fracas_no_memory("a crossover");
    fracas_misfit misfit = {0};
    crossover->chi2 = chi2;
    crossover->freedom = (double)(of->n - NPARAMETERS);
    gsl_multifit_nlinear_init(&at.vector, &of->problem, of->solver); /* derivatives there */
    const gsl_matrix *J = gsl_multifit_nlinear_jac(of->solver);
    gsl_multifit_nlinear_covar(J, 0, covariance);
    for (size_t i = 0; i < of->n; i++) {
        double leverage = 0; /* J_i (J^T J)^-1 J_i^T: rows are over their standard errors */
        for (size_t a = 0; a < NPARAMETERS; a++)
            for (size_t b = 0; b < NPARAMETERS; b++)
                leverage += gsl_matrix_get(J, i, a) * gsl_matrix_get(covariance, a, b) *
                            gsl_matrix_get(J, i, b);
        fracas_misfit_add(&misfit, leverage, &of->known[i]);
    }
    gsl_matrix_free(covariance);
    crossover->misfit = fracas_misfit_probability(&misfit, crossover->chi2, crossover->freedom);
    crossover->pooled = misfit.shared > 0 ? misfit.shared : NAN;
    crossover->inflation = fmax(1, sqrt(crossover->chi2 / crossover->freedom));
    return FRACAS_OK;
}

/* Means about the fitted ones, as far off as their errors are, and as uncertain as these
 * (scaling-laws.16). */
static void draw(const fitter *of, const double best[NPARAMETERS],
                 const fracas_size_crossover *crossover, gsl_rng *random)
{
    const bool off = crossover->misfit < FRACAS_MISFIT_LIMIT; /* the residuals tell how far */
    const double shared = off ? crossover->freedom : crossover->pooled;
    const double factor = shared > 0 ? sqrt(shared / gsl_ran_chisq(random, shared))
                                     : 1; /* a shared error is off for all equally */
    for (size_t i = 0; i < of->n; i++) {
        const bool alike = off || of->known[i].pooled;
        const double z = alike ? factor * gsl_ran_ugaussian(random)
                               : gsl_ran_tdist(random, of->known[i].freedom);
        of->y[i] = model(best, of->x[i]) + crossover->inflation * sqrt(of->known[i].most) * z;
    }
}

/* The quantiles of constants fitted to drawn means  (scaling-laws.16). */
static fracas_err resample(fitter *of, const double best[NPARAMETERS], int64_t resamples,
                           uint64_t seed, fracas_size_crossover *crossover)
{
    const size_t most = (size_t)resamples;
    OWN(gsl_rng) random = fracas_random(seed);
    OWNED double *found = malloc((NPARAMETERS * most + 1) * sizeof *found);
    size_t count = 0;
    if (!random || !found) return fracas_no_memory("a crossover");
    for (size_t b = 0; b < most; b++) {
        double parameter[NPARAMETERS] = {best[SIZE], best[RATE], best[EXPONENT]};
        draw(of, best, crossover, random);
        if (!isfinite(descend(of, parameter))) continue;
        for (size_t j = 0; j < NPARAMETERS; j++) found[j * most + count] = parameter[j];
        count++;
    }
    if (count < most * 95 / 100) count = 0; /* draws without a fit are not missing at random */
    summarise(found + SIZE * most, count, best[SIZE], 1, &crossover->size);
    summarise(found + RATE * most, count, best[RATE], 1, &crossover->rate);
    summarise(found + EXPONENT * most, count, best[EXPONENT], -1, &crossover->exponent);
    return FRACAS_OK;
}

/* Takes the points that came apart and have a known standard error; returns the number of their
 * rates. */
static size_t take(const fracas_size_series *series, fitter *of)
{
    size_t rates = 0, n = 0;
    for (size_t i = 0; i < series->n; i++) {
        const fracas_size_point *point = &series->point[i];
        if (point->whole) continue;
        of->x[n] = log(point->rate);
        of->y[n] = log(point->size);
        of->mean[n++] = (fracas_mean){point->replicas,
                                      sqrt((double)point->replicas) * point->error};
    }
    fracas_mean_errors(of->mean, n, of->known);
    for (size_t i = 0; i < n; i++) {
        if (!(of->known[i].variance > 0) || !isfinite(of->known[i].variance)) continue;
        of->x[of->n] = of->x[i];
        of->y[of->n] = of->y[i];
        of->known[of->n] = of->known[i];
        of->error[of->n] = sqrt(of->known[i].variance);
        rates += of->n == 0 || of->x[of->n] - of->x[of->n - 1] > 1e-9;
        of->n++;
    }
    return rates;
}

FRACAS_OWNER(gsl_multifit_nlinear_workspace, gsl_multifit_nlinear_free)

static fracas_err fit(const fracas_size_series *series, int64_t resamples, uint64_t seed,
                      fitter *of, fracas_size_crossover *crossover)
{
    double best[NPARAMETERS] = {0};
    const size_t rates = take(series, of);
    crossover->n = (int64_t)of->n;
    if (rates < FRACAS_CROSSOVER_RATES) {
        FRACAS_PRINT(crossover->reason, "%zu rate%s with a known standard error, %d are needed",
                     rates, rates == 1 ? "" : "s", FRACAS_CROSSOVER_RATES);
        return FRACAS_OK;
    }
    const gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    of->problem = (gsl_multifit_nlinear_fdf){
        .f = residuals, .df = jacobian, .n = of->n, .p = NPARAMETERS, .params = of};
    OWN(gsl_multifit_nlinear_workspace) solver = of->solver = gsl_multifit_nlinear_alloc(
        gsl_multifit_nlinear_trust, &how, of->n, NPARAMETERS);
    if (!solver) return fracas_no_memory("a crossover");
    const double chi2 = search(of, best);
    if (!isfinite(chi2)) {
        FRACAS_PRINT(crossover->reason, "the least squares did not converge");
        return FRACAS_OK;
    }
    if (!(best[RATE] > of->x[0] && best[RATE] < of->x[of->n - 1])) {
        FRACAS_PRINT(crossover->reason, "no bend: the fitted crossover is %s rates",
                     best[RATE] <= of->x[0] ? "below all" : "above all");
        return FRACAS_OK;
    }
    TRY(judge(of, best, chi2, crossover));
    return resample(of, best, resamples, seed, crossover);
}

static fracas_interval scaled(const fracas_interval *interval, double factor)
{
    return (fracas_interval){interval->value * factor, interval->low * factor,
                             interval->high * factor, interval->standard_error * factor,
                             interval->resamples};
}

static fracas_err fit_series(const fracas_size_series *series, int64_t resamples, uint64_t seed,
                             fracas_size_crossover *crossover)
{
    const fracas_interval none = {NAN, NAN, NAN, NAN, 0};
    *crossover = (fracas_size_crossover){.scales = series->scales,
                                         .size = none,
                                         .rate = none,
                                         .exponent = none,
                                         .chi2 = NAN,
                                         .freedom = NAN,
                                         .misfit = NAN,
                                         .pooled = NAN,
                                         .inflation = NAN};
    FRACAS_PRINT(crossover->name, "%s", series->name);
    fitter of = {0};
    FRACAS_CLEARED(fracas_room) room = {0};
    FRACAS_TAKE(&room, of.x, series->n);
    FRACAS_TAKE(&room, of.y, series->n);
    FRACAS_TAKE(&room, of.error, series->n);
    FRACAS_TAKE(&room, of.mean, series->n);
    FRACAS_TAKE(&room, of.known, series->n);
    TRY(fracas_room_check(&room, "a crossover"));
    TRY(fit(series, resamples, seed, &of, crossover));
    crossover->rate_normalised = scaled(&crossover->rate, 1 / series->scales.rate);
    crossover->size_normalised = scaled(&crossover->size, 1 / series->scales.size);
    crossover->low_exponent = *crossover->reason ? NAN : 0;
    return FRACAS_OK;
}

fracas_err fracas_crossover_fit(const fracas_size_series *series, int64_t resamples, uint64_t seed,
                                fracas_size_crossover *crossover)
{
    gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* failed fits have a reason */
    const fracas_err err = fit_series(series, resamples, seed, crossover);
    gsl_set_error_handler(handler);
    return err;
}

double fracas_crossover_at(const fracas_size_crossover *crossover, double rate)
{
    return crossover->size.value /
           (1 + pow(rate / crossover->rate.value, -crossover->exponent.value));
}

static fracas_err fit_all(const fracas_analysis *analysis, bool intervals,
                          fracas_size_crossover **list, size_t *count)
{
    fracas_size_series *series;
    size_t nseries;
    TRY(fracas_size_series_create(analysis, &series, &nseries));
    fracas_size_crossover *made = calloc(nseries + 1, sizeof *made);
    fracas_err err = made ? FRACAS_OK : fracas_no_memory("the crossovers of the study");
    for (size_t i = 0; i < nseries && !err; i++)
        err = fracas_crossover_fit(&series[i], intervals ? FRACAS_CROSSOVER_RESAMPLES : 0, i + 1,
                                   &made[i]);
    fracas_size_series_free(series, nseries);
    if (err) free(made);
    else *list = made, *count = nseries;
    return err;
}

/* An analysis that keeps them has intervals in any case: the figures come first. */
fracas_err fracas_size_crossovers(const fracas_analysis *analysis, bool intervals,
                                  fracas_size_crossover **list, size_t *count)
{
    fracas_kept *kept = analysis->kept;
    fracas_size_crossover *fitted = NULL;
    *list = NULL;
    *count = 0;
    if (!kept) return fit_all(analysis, intervals, list, count);
    if (!kept->crossovers) {
        TRY(fit_all(analysis, true, &fitted, &kept->ncrossovers));
        kept->crossovers = fitted;
    }
    *list = malloc((kept->ncrossovers + 1) * sizeof **list);
    if (!*list) return fracas_no_memory("the crossovers of the study");
    memcpy(*list, kept->crossovers, kept->ncrossovers * sizeof **list);
    *count = kept->ncrossovers;
    return FRACAS_OK;
}
