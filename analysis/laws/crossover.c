#include "analysis/laws/crossover.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE, RATE, EXPONENT, NPARAMETERS }; /* log s_q, log edot_c, log k */

typedef struct {
    size_t n;
    double *x, *y, *error; /* log rate, log size, its standard error */
    gsl_multifit_nlinear_workspace *solver;
    gsl_multifit_nlinear_fdf problem;
} fitter;

/* log(1 + e^z), and its slope. */
static double soft(double z, double *slope)
{
    *slope = 1 / (1 + exp(-z));
    return z > 0 ? z + log1p(exp(-z)) : log1p(exp(z));
}

/* log s  (size-laws.14) */
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

/* chi2 of the least squares that are found from *parameter, which becomes them; NaN if none are  (size-laws.15). */
static double descend(fitter *of, double parameter[NPARAMETERS])
{
    gsl_vector_view start = gsl_vector_view_array(parameter, NPARAMETERS);
    int info;
    if (gsl_multifit_nlinear_init(&start.vector, &of->problem, of->solver)) return NAN;
    if (gsl_multifit_nlinear_driver(200, 1e-9, 1e-9, 0, NULL, NULL, &info, of->solver)) return NAN;
    const gsl_vector *found = gsl_multifit_nlinear_position(of->solver), *f = gsl_multifit_nlinear_residual(of->solver);
    double chi2 = 0;
    for (size_t i = 0; i < of->n; i++) chi2 += gsl_vector_get(f, i) * gsl_vector_get(f, i);
    for (size_t i = 0; i < NPARAMETERS; i++) parameter[i] = gsl_vector_get(found, i);
    return isfinite(parameter[SIZE] + parameter[RATE] + parameter[EXPONENT]) ? chi2 : NAN;
}

/* The least chi2 from a bend at each rate and two exponents. */
static double search(fitter *of, double best[NPARAMETERS])
{
    double least = NAN;
    for (size_t i = 0; i < 2 * of->n; i++) {
        double parameter[NPARAMETERS] = {of->y[0], of->x[i / 2], i % 2 ? 0 : log(0.5)};
        const double chi2 = descend(of, parameter);
        if (!isfinite(chi2) || chi2 >= least) continue;
        least = chi2;
        for (size_t j = 0; j < NPARAMETERS; j++) best[j] = parameter[j];
    }
    return least;
}

static double quantile(double *value, size_t count, double p)
{
    const double at = p * (double)(count + 1) - 1; /* value number p (B + 1) */
    const size_t below = at < 0 ? 0 : at > (double)count - 2 ? count - 2 : (size_t)at;
    return value[below] + (at - (double)below) * (value[below + 1] - value[below]);
}

/* `sign` exp(value): s_q and edot_c as they are, the exponent -k. */
static void summarise(double *found, size_t count, double best, double sign, fracas_interval *interval)
{
    *interval = (fracas_interval){sign * exp(best), NAN, NAN, NAN, NAN, (int64_t)count};
    if (count < 20) return;
    double sum = 0, squares = 0;
    for (size_t b = 0; b < count; b++) found[b] = sign * exp(found[b]);
    for (size_t b = 0; b < count; b++) sum += found[b] - interval->value;
    interval->bias = sum / (double)count;
    for (size_t b = 0; b < count; b++) squares += pow(found[b] - interval->value - interval->bias, 2);
    interval->standard_error = sqrt(squares / (double)(count - 1));
    gsl_sort(found, 1, count);
    interval->low = quantile(found, count, 0.025);
    interval->high = quantile(found, count, 0.975);
}

/* Means are drawn again about the fitted ones by their standard errors  (size-laws.16). */
static fracas_err resample(fitter *of, const double best[NPARAMETERS], int64_t resamples, uint64_t seed, fracas_size_crossover *crossover)
{
    const size_t most = (size_t)resamples;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    double *found = malloc((NPARAMETERS * most + 1) * sizeof *found);
    size_t count = 0;
    if (random && found) {
        gsl_rng_set(random, (unsigned long)(seed ^ seed >> 32)); /* it takes 32 bits */
        for (size_t b = 0; b < most; b++) {
            double parameter[NPARAMETERS] = {best[SIZE], best[RATE], best[EXPONENT]};
            for (size_t i = 0; i < of->n; i++)
                of->y[i] = model(best, of->x[i]) + gsl_ran_gaussian(random, crossover->inflation * of->error[i]);
            if (!isfinite(descend(of, parameter))) continue;
            for (size_t j = 0; j < NPARAMETERS; j++) found[j * most + count] = parameter[j];
            count++;
        }
        if (count < most * 95 / 100) count = 0; /* those that did not fit are not missing at random */
        summarise(found + SIZE * most, count, best[SIZE], 1, &crossover->size);
        summarise(found + RATE * most, count, best[RATE], 1, &crossover->rate);
        summarise(found + EXPONENT * most, count, best[EXPONENT], -1, &crossover->exponent);
    }
    const bool room = random && found;
    if (random) gsl_rng_free(random);
    free(found);
    return room ? FRACAS_OK : fracas_no_memory("a crossover");
}

static fracas_err fit(fitter *of, int64_t resamples, uint64_t seed, fracas_size_crossover *crossover)
{
    double best[NPARAMETERS] = {0};
    const double chi2 = search(of, best);
    if (!isfinite(chi2)) {
        snprintf(crossover->reason, sizeof crossover->reason, "the least squares did not converge");
        return FRACAS_OK;
    }
    if (!(best[RATE] > of->x[0] && best[RATE] < of->x[of->n - 1])) {
        snprintf(crossover->reason, sizeof crossover->reason, "no bend between the rates: the fitted crossover is %s of them",
                 best[RATE] <= of->x[0] ? "below all" : "above all");
        return FRACAS_OK;
    }
    crossover->chi2 = chi2;
    crossover->freedom = (double)(of->n - NPARAMETERS);
    crossover->inflation = chi2 > gsl_cdf_chisq_Pinv(0.99, crossover->freedom) ? sqrt(chi2 / crossover->freedom) : 1;
    return resample(of, best, resamples, seed, crossover);
}

/* Takes the points whose standard error is known; returns how many rates they are at. */
static size_t take(const fracas_size_series *series, fitter *of)
{
    size_t rates = 0;
    for (size_t i = 0; i < series->n; i++) {
        const fracas_size_point *point = &series->point[i];
        if (!(point->error > 0) || !isfinite(point->error)) continue;
        of->x[of->n] = log(point->rate);
        of->y[of->n] = log(point->size);
        of->error[of->n] = point->error;
        rates += of->n == 0 || of->x[of->n] - of->x[of->n - 1] > 1e-9;
        of->n++;
    }
    return rates;
}

static fracas_err fit_series(const fracas_size_series *series, int64_t resamples, uint64_t seed, fracas_size_crossover *crossover)
{
    const fracas_interval none = {NAN, NAN, NAN, NAN, NAN, 0};
    *crossover = (fracas_size_crossover){.scales = series->scales, .size = none, .rate = none, .exponent = none, .chi2 = NAN,
                                         .freedom = NAN, .inflation = NAN};
    snprintf(crossover->name, sizeof crossover->name, "%s", series->name);
    double *value = malloc((3 * series->n + 1) * sizeof *value);
    if (!value) return fracas_no_memory("a crossover");
    fitter of = {.x = value, .y = value + series->n, .error = value + 2 * series->n};
    const size_t rates = take(series, &of);
    crossover->n = (int64_t)of.n;
    fracas_err err = FRACAS_OK;
    if (rates < FRACAS_CROSSOVER_RATES) {
        snprintf(crossover->reason, sizeof crossover->reason, "%zu rate%s with a known standard error, %d are needed", rates,
                 rates == 1 ? "" : "s", FRACAS_CROSSOVER_RATES);
    } else {
        const gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
        of.problem = (gsl_multifit_nlinear_fdf){.f = residuals, .df = jacobian, .n = of.n, .p = NPARAMETERS, .params = &of};
        of.solver = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, of.n, NPARAMETERS);
        err = of.solver ? fit(&of, resamples, seed, crossover) : fracas_no_memory("a crossover");
        if (of.solver) gsl_multifit_nlinear_free(of.solver);
    }
    free(value);
    return err;
}

fracas_err fracas_crossover_fit(const fracas_size_series *series, int64_t resamples, uint64_t seed, fracas_size_crossover *crossover)
{
    gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* a fit that fails is a reason, no end of the program */
    const fracas_err err = fit_series(series, resamples, seed, crossover);
    gsl_set_error_handler(handler);
    return err;
}

double fracas_crossover_at(const fracas_size_crossover *crossover, double rate)
{
    return crossover->size.value / (1 + pow(rate / crossover->rate.value, -crossover->exponent.value));
}

fracas_err fracas_size_crossovers(const struct fracas_analysis *analysis, bool intervals, fracas_size_crossover **list, size_t *count)
{
    fracas_size_series *series;
    size_t nseries;
    *list = NULL;
    *count = 0;
    TRY(fracas_size_series_create(analysis, &series, &nseries));
    fracas_size_crossover *made = calloc(nseries + 1, sizeof *made);
    fracas_err err = made ? FRACAS_OK : fracas_no_memory("the crossovers of the study");
    for (size_t i = 0; i < nseries && !err; i++)
        err = fracas_crossover_fit(&series[i], intervals ? FRACAS_CROSSOVER_RESAMPLES : 0, i + 1, &made[i]);
    fracas_size_series_free(series, nseries);
    if (err) free(made);
    else *list = made, *count = nseries;
    return err;
}
