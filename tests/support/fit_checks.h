/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits of many samples of a known law: how often an interval holds the truth, whether p-values are
 * uniform, bias. */
#ifndef FRACAS_TESTS_SUPPORT_FIT_CHECKS_H
#define FRACAS_TESTS_SUPPORT_FIT_CHECKS_H

#include "analysis/fit/point.h"
#include "tests/support/fit_sample.h"
#include "tests/support/test.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sort.h>

/* Kolmogorov's distance of n uniform numbers is above 2.69/sqrt(n) once in 1e6:
 * sqrt(-log(0.5e-6)/2). */
#define FIT_KOLMOGOROV 2.69

typedef struct {
    size_t n, failed; /* samples that were fitted, and others */
    double ks, ad;    /* Kolmogorov's distance of the p-values from uniform, times sqrt(n) */
    double rejected;  /* share of the p-values of KS at 0.05 or below */
    double held[FRACAS_FAMILY_PARAMETERS]; /* share of the intervals that hold the truth */
    double bias[FRACAS_FAMILY_PARAMETERS]; /* mean error over its own standard deviation */
} fit_check;

static inline double fit_distance(double *p, size_t n)
{
    double distance = 0;
    gsl_sort(p, 1, n);
    for (size_t i = 0; i < n; i++)
        distance = fmax(distance, fmax(fabs(p[i] - (double)i / (double)n),
                                       fabs(p[i] - (double)(i + 1) / (double)n)));
    return distance * sqrt((double)n);
}

/* The intervals and p-values that fracas fit gives, of one family alone: it is all that the point's
 * fits are made to look at. */
static inline fit_check fit_check_of(const synthetic *what, size_t repetitions, int64_t resamples,
                                     unsigned long seed)
{
    const size_t np = what->family->nparameters;
    fit_check found = {0};
    double *p = taken(2 * repetitions * sizeof *p), sum[FRACAS_FAMILY_PARAMETERS] = {0},
           squares[FRACAS_FAMILY_PARAMETERS] = {0};
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, seed);
    for (size_t r = 0; r < repetitions; r++) {
        FRACAS_CLEARED(fracas_ensemble) ensemble;
        FRACAS_CLEARED(fracas_point_fits) fits;
        OK(synthetic_ensemble(what, random, &ensemble));
        OK(fracas_point_fits_of(&ensemble, &what->family, 1, resamples, seed + r, &fits));
        const fracas_family_fit *fit = &fits.family[0];
        found.failed += *fit->fit.why != '\0';
        for (size_t i = 0; !*fit->fit.why && i < np; i++) {
            const double error = fit->parameter[i].value - what->parameter[i];
            found.held[i] += fit->parameter[i].low <= what->parameter[i] &&
                             what->parameter[i] <= fit->parameter[i].high;
            sum[i] += error;
            squares[i] += error * error;
        }
        if (!*fit->fit.why) {
            p[found.n] = fit->goodness.ks_p;
            p[repetitions + found.n++] = fit->goodness.ad_p;
            found.rejected += fit->goodness.ks_p <= 0.05;
        }
    }
    const double n = (double)found.n;
    for (size_t i = 0; i < np; i++) {
        const double mean = sum[i] / n;
        found.held[i] /= n;
        found.bias[i] = mean / sqrt(squares[i] / n - mean * mean);
    }
    found.rejected /= n;
    found.ks = fit_distance(p, found.n);
    found.ad = fit_distance(p + repetitions, found.n);
    gsl_rng_free(random);
    free(p);
    return found;
}

static inline void fit_check_print(const synthetic *what, const fit_check *found)
{
    static const char *const how[NDEPENDENCES] = {"independent", "ring", "shared", "strong"};
    print_message("| %s | %zu | %s | %zu, %zu | %.2f, %.2f | %.3f |", what->family->name,
                  what->realizations, how[what->how], found->n, found->failed, found->ks, found->ad,
                  found->rejected);
    for (size_t i = 0; i < what->family->nparameters; i++)
        print_message(" %s %.3f (%+.2f)%s", what->family->parameter[i].name, found->held[i],
                      found->bias[i], i + 1 < what->family->nparameters ? "," : " |\n");
}

#endif
