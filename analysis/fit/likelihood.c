/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/point.h"

#include "analysis/data/text.h"

#include <gsl/gsl_multimin.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SCORINGS = 40, HALVINGS = 12, SIMPLEX_STEPS = 600 };
static const double DIFFERENCE = 1e-6, ARRIVED = 1e-6, WORST = 1e300, AT_BOUND = 1e-3;

/* A search: coordinates are logarithms of parameters, or parameters where these are linear. */
typedef struct {
    const fracas_family *family;
    const fracas_fit_sample *sample;
    const double *count;
    double total;
    double lower[FRACAS_FAMILY_PARAMETERS], upper[FRACAS_FAMILY_PARAMETERS];
} search;

static double coordinate(const fracas_family_parameter *parameter, double value)
{
    return parameter->linear ? value : log(value);
}

static void to_parameters(const fracas_family *family, const double *x, double *parameter)
{
    for (size_t i = 0; i < family->nparameters; i++)
        parameter[i] = family->parameter[i].linear ? x[i] : exp(x[i]);
}

static void to_coordinates(const search *s, const double *parameter, double *x)
{
    for (size_t i = 0; i < s->family->nparameters; i++)
        x[i] = fmin(fmax(coordinate(&s->family->parameter[i], parameter[i]), s->lower[i]),
                    s->upper[i]);
}

/* A shift is below the upper edge of the first cell with something in it. */
static search begin(const fracas_family *family, const fracas_fit_sample *sample,
                    const double *count)
{
    search s = {.family = family, .sample = sample, .count = count};
    size_t first = sample->ncells;
    for (size_t k = sample->ncells; k-- > 0;) {
        s.total += count[k];
        if (count[k] > 0) first = k;
    }
    for (size_t i = 0; i < family->nparameters; i++) {
        const fracas_family_parameter *parameter = &family->parameter[i];
        s.lower[i] = coordinate(parameter, parameter->lower);
        s.upper[i] = coordinate(parameter, parameter->shift
                                               ? (1 - 1e-9) * fmin(sample->edge[first + 1], 1e3)
                                               : parameter->upper);
    }
    return s;
}

/* (fits.6): a difference of whichever tail is the smaller one. */
bool fracas_fit_probabilities(const fracas_family *family, const fracas_fit_sample *sample,
                              const double *parameter, double *probability)
{
    double below, above, whole, next_below, next_above;
    family->tails(parameter, sample->edge[0], sample->edge[0], &below, &above);
    whole = above;
    if (!(whole > 0)) return false;
    for (size_t k = 0; k < sample->ncells; k++, below = next_below, above = next_above) {
        next_below = 1;
        next_above = 0;
        if (k + 1 < sample->ncells)
            family->tails(parameter, sample->edge[0], sample->edge[k + 1], &next_below,
                          &next_above);
        probability[k] = (below > 0.5 ? above - next_above : next_below - below) / whole;
        if (!(probability[k] >= 0)) return false;
    }
    return true;
}

/* (fits.7) */
static double sum_log(const search *s, const double *probability)
{
    double sum = 0;
    for (size_t k = 0; k < s->sample->ncells; k++) {
        if (!(s->count[k] > 0)) continue;
        if (!(probability[k] > 0)) return -INFINITY;
        sum += s->count[k] * log(probability[k]);
    }
    return sum;
}

static double likelihood_of(const search *s, const double *parameter, double *probability)
{
    return fracas_fit_probabilities(s->family, s->sample, parameter, probability)
               ? sum_log(s, probability)
               : -INFINITY;
}

static double likelihood_at(const search *s, const double *x, double *probability)
{
    double parameter[FRACAS_FAMILY_PARAMETERS];
    to_parameters(s->family, x, parameter);
    return likelihood_of(s, parameter, probability);
}

double fracas_fit_log_likelihood(const fracas_family *family, const fracas_fit_sample *sample,
                                 const double *count, const double *parameter)
{
    double probability[FRACAS_FIT_CELLS];
    return likelihood_of(&(search){family, sample, count}, parameter, probability);
}

/* Score and expected information at x, whose probabilities are given; differences towards the
 * inside of the bounds. */
static bool score(const search *s, const double *x, const double *probability, double *gradient,
                  double information[][FRACAS_FAMILY_PARAMETERS])
{
    const size_t n = s->family->nparameters;
    double beside[FRACAS_FAMILY_PARAMETERS][FRACAS_FIT_CELLS];
    for (size_t i = 0; i < n; i++) {
        double y[FRACAS_FAMILY_PARAMETERS], parameter[FRACAS_FAMILY_PARAMETERS];
        memcpy(y, x, sizeof y);
        const double step = x[i] + DIFFERENCE > s->upper[i] ? -DIFFERENCE : DIFFERENCE;
        y[i] += step;
        to_parameters(s->family, y, parameter);
        if (!fracas_fit_probabilities(s->family, s->sample, parameter, beside[i])) return false;
        gradient[i] = 0;
        for (size_t k = 0; k < s->sample->ncells; k++) {
            beside[i][k] = probability[k] > 0
                               ? (beside[i][k] - probability[k]) / (step * probability[k])
                               : 0;
            gradient[i] += s->count[k] * beside[i][k];
        }
        for (size_t j = 0; j <= i; j++) {
            double sum = 0;
            for (size_t k = 0; k < s->sample->ncells; k++)
                sum += probability[k] * beside[i][k] * beside[j][k];
            information[i][j] = information[j][i] = s->total * sum;
        }
    }
    return true;
}

/* information . step = gradient by elimination; parameters held by a bound stay where they are. */
static void solve(size_t n, double information[][FRACAS_FAMILY_PARAMETERS], const double *gradient,
                  const bool *held, double *step)
{
    double a[FRACAS_FAMILY_PARAMETERS][FRACAS_FAMILY_PARAMETERS + 1];
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) a[i][j] = held[i] || held[j] ? i == j : information[i][j];
        a[i][i] *= 1 + 1e-10; /* families nearly equal to one another */
        a[i][n] = held[i] ? 0 : gradient[i];
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            const double factor = a[j][i] / a[i][i];
            for (size_t k = i; k <= n; k++) a[j][k] -= factor * a[i][k];
        }
    for (size_t i = n; i-- > 0;) {
        step[i] = a[i][n];
        for (size_t j = i + 1; j < n; j++) step[i] -= a[i][j] * step[j];
        step[i] /= a[i][i];
    }
}

/* One step of scoring (fits.8), halved until the likelihood grows. *gain: the gain promised by the
 * step; true if there was one. */
static bool advance(const search *s, double *x, double *probability, double *likelihood,
                    double *gain)
{
    const size_t n = s->family->nparameters;
    double gradient[FRACAS_FAMILY_PARAMETERS],
        information[FRACAS_FAMILY_PARAMETERS][FRACAS_FAMILY_PARAMETERS];
    double step[FRACAS_FAMILY_PARAMETERS], tried[FRACAS_FIT_CELLS];
    bool held[FRACAS_FAMILY_PARAMETERS];
    *gain = INFINITY;
    if (!score(s, x, probability, gradient, information)) return false;
    for (size_t i = 0; i < n; i++)
        held[i] = (x[i] <= s->lower[i] && gradient[i] < 0) ||
                  (x[i] >= s->upper[i] && gradient[i] > 0);
    solve(n, information, gradient, held, step);
    *gain = 0;
    for (size_t i = 0; i < n; i++) *gain += held[i] ? 0 : gradient[i] * step[i];
    double share = 1;
    for (int h = 0; h < HALVINGS && isfinite(*gain); h++, share *= 0.5) {
        double y[FRACAS_FAMILY_PARAMETERS];
        for (size_t i = 0; i < n; i++)
            y[i] = fmin(fmax(x[i] + share * step[i], s->lower[i]), s->upper[i]);
        const double found = likelihood_at(s, y, tried);
        if (!(found > *likelihood)) continue;
        *likelihood = found;
        memcpy(x, y, n * sizeof *x);
        memcpy(probability, tried, s->sample->ncells * sizeof *tried);
        return true;
    }
    return false;
}

/* True if it arrives: another step would gain nothing. */
static bool scoring(const search *s, double *x, double *likelihood)
{
    double probability[FRACAS_FIT_CELLS], gain;
    *likelihood = likelihood_at(s, x, probability);
    if (!isfinite(*likelihood)) return false;
    for (int i = 0; i < SCORINGS; i++) {
        const bool better = advance(s, x, probability, likelihood, &gain);
        if (gain < ARRIVED) return true;
        if (!better) return false;
    }
    return false;
}

static double to_minimise(const gsl_vector *at, void *context)
{
    const search *s = context;
    double x[FRACAS_FAMILY_PARAMETERS], probability[FRACAS_FIT_CELLS];
    for (size_t i = 0; i < s->family->nparameters; i++) {
        x[i] = gsl_vector_get(at, i);
        if (x[i] < s->lower[i] || x[i] > s->upper[i]) return WORST;
    }
    const double likelihood = likelihood_at(s, x, probability);
    return isfinite(likelihood) ? -likelihood : WORST;
}

/* True if the simplex has shrunk to nothing. */
static bool simplex(search *s, double *x, double *likelihood)
{
    const size_t n = s->family->nparameters;
    gsl_multimin_fminimizer *minimiser = gsl_multimin_fminimizer_alloc(
        gsl_multimin_fminimizer_nmsimplex2, n);
    gsl_vector *at = gsl_vector_alloc(n), *size = gsl_vector_alloc(n);
    bool arrived = false;
    if (minimiser && at && size) {
        gsl_multimin_function function = {to_minimise, n, s};
        for (size_t i = 0; i < n; i++) {
            const double step = s->family->parameter[i].shift ? 0.1 * s->upper[i] : 0.2;
            gsl_vector_set(at, i, x[i]);
            gsl_vector_set(size, i, x[i] + step < s->upper[i] ? step : -step);
        }
        int status = gsl_multimin_fminimizer_set(minimiser, &function, at, size);
        for (int i = 0; i < SIMPLEX_STEPS && !status && !arrived; i++) {
            status = gsl_multimin_fminimizer_iterate(minimiser);
            arrived = gsl_multimin_fminimizer_size(minimiser) < 1e-6;
        }
        for (size_t i = 0; i < n; i++) x[i] = gsl_vector_get(minimiser->x, i);
        *likelihood = -minimiser->fval;
    }
    if (minimiser) gsl_multimin_fminimizer_free(minimiser);
    if (at) gsl_vector_free(at);
    if (size) gsl_vector_free(size);
    return arrived && *likelihood > -WORST;
}

/* The number of fragments, and of the different cells they are in, against the parameters. */
static bool enough(const fracas_family *family, const fracas_fit_sample *sample, char *why,
                   size_t size)
{
    size_t cells = 0;
    for (size_t k = 0; k < sample->ncells; k++) cells += sample->count[k] > 0;
    if (sample->total < FRACAS_FIT_LEAST)
        snprintf(why, size, "%.0f fragments above the cut, %d are needed", sample->total,
                 FRACAS_FIT_LEAST);
    else if (cells < family->nparameters + 2)
        snprintf(why, size, "fragments are of %zu different sizes, %zu are needed", cells,
                 family->nparameters + 2);
    return !*why;
}

static void find_bounds(const search *s, const double *x, char *why, size_t size)
{
    for (size_t i = 0; i < s->family->nparameters && !*why; i++) {
        const bool low = x[i] - s->lower[i] < AT_BOUND,
                   high = s->upper[i] - x[i] <
                          AT_BOUND * (s->family->parameter[i].shift ? 1e-3 : 1);
        const fracas_family_parameter *parameter = &s->family->parameter[i];
        if (parameter->shift && high)
            snprintf(why, size, "%s goes to the smallest size", parameter->name);
        else if (low || high)
            snprintf(why, size, "%s goes to its bound, %g%s", parameter->name,
                     low ? parameter->lower : parameter->upper,
                     parameter->length && !(low && parameter->lower == 0) ? " of the mean" : "");
    }
}

void fracas_fit_of(const fracas_family *family, const fracas_fit_sample *sample, fracas_fit *fit)
{
    double best[FRACAS_FAMILY_PARAMETERS] = {0};
    *fit = (fracas_fit){.parameter = {NAN, NAN, NAN}, .log_likelihood = NAN};
    if (!enough(family, sample, fit->why, sizeof fit->why)) return;
    search s = begin(family, sample, sample->count);
    for (int which = 0; which < FRACAS_FAMILY_STARTS; which++) {
        double x[FRACAS_FAMILY_PARAMETERS], found = -INFINITY;
        family->start(&sample->moments, which, x);
        to_coordinates(&s, x, x);
        const bool shrunk = simplex(&s, x, &found), scored = scoring(&s, x, &found);
        if (!(shrunk || scored) || !(found > -INFINITY) || found <= fit->log_likelihood) continue;
        fit->log_likelihood = found;
        memcpy(best, x, sizeof best);
    }
    if (!isfinite(fit->log_likelihood)) {
        FRACAS_PRINT(fit->why, "no start of the search converged");
        return;
    }
    to_parameters(family, best, fit->parameter);
    find_bounds(&s, best, fit->why, sizeof fit->why);
}

bool fracas_fit_again(const fracas_family *family, const fracas_fit_sample *sample,
                      const double *count, const fracas_fit *near, double *parameter)
{
    double x[FRACAS_FAMILY_PARAMETERS], likelihood;
    search s = begin(family, sample, count);
    to_coordinates(&s, near->parameter, x);
    if (!scoring(&s, x, &likelihood)) {
        to_coordinates(&s, near->parameter, x);
        if (!simplex(&s, x, &likelihood)) return false;
        scoring(&s, x, &likelihood); /* as far as it goes */
    }
    to_parameters(family, x, parameter);
    return true;
}
