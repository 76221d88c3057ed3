/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How fast means over designs approach integrals: at random as n^(-1/2), additive functions by
 * Latin hypercubes as n^(-3/2), smooth ones by shifted Sobol sequences about as 1/n. */
#include "base/elementary.h"
#include "sampler/design/design.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>

enum { LATIN_HYPERCUBE, SOBOL, RANDOM };
enum { PARAMETERS = 2, SEEDS = 256, FEW = 16, MANY = 4096 };

typedef double function(const fracas_probability *p);

/* (1 + cos pi u)(1 + cos pi v) - 1 and cos pi u + cos pi v: integral 0. The first is the second and
 * cos pi u cos pi v, so that its variance is 1/2 + 1/2 of the additive parts and 1/4 of the rest.
 */
static double product(const fracas_probability *p)
{
    return (1.0 + fracas_cospi(p[0].below)) * (1.0 + fracas_cospi(p[1].below)) - 1.0;
}

static double sum(const fracas_probability *p)
{
    return fracas_cospi(p[0].below) + fracas_cospi(p[1].below);
}

/* Mean square, over seeds, of the mean of f over n points. */
static double mean_square(int type, size_t n, function *f)
{
    static const uint64_t names[PARAMETERS] = {1, 2};
    OWNED fracas_probability *p = malloc(n * PARAMETERS * sizeof *p);
    double total = 0.0;
    if (!p) abort();
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        const fracas_design design = {fracas_design_types[type], seed, n, PARAMETERS, names, NULL};
        OK(fracas_design_fill(&design, p));
        double mean = 0.0;
        for (size_t i = 0; i < n; i++) mean += f(p + i * PARAMETERS) / (double)n;
        total += mean * mean / SEEDS;
    }
    return total;
}

/* The mean of a sum over points is nearly normal: SEEDS times the mean square over its variance is
 * chi-square of SEEDS degrees, up to `slack`, what the variance is known to. alpha 1e-6. */
static void check_variance(const char *what, double square, double variance, double slack)
{
    const double low = gsl_cdf_chisq_Pinv(5e-7, SEEDS) / SEEDS,
                 high = gsl_cdf_chisq_Qinv(5e-7, SEEDS) / SEEDS;
    if (!(square > variance * low * (1.0 - slack) && square < variance * high * (1.0 + slack)))
        fail_msg("%s: mean square error %g, expected %g times %g to %g", what, square, variance,
                 low, high);
}

static void test_random(void **state)
{
    check_variance("sum, few", mean_square(RANDOM, FEW, sum), 1.0 / FEW, 0.0);
    check_variance("sum, many", mean_square(RANDOM, MANY, sum), 1.0 / MANY, 0.0);
    check_variance("product, many", mean_square(RANDOM, MANY, product), 1.25 / MANY, 0.0);
}

/* Of the additive part of each parameter is left what it varies inside the strata: 1/n^2 times the
 * sum over strata of (pi sin pi u)^2/(12 n^2), that is pi^2/(24 n^3), up to a share of 1/n^2. Of
 * the rest, nothing changes but a share of 1/n (Stein, Technometrics 29, 143-151, 1987). */
static void test_latin_hypercube(void **state)
{
    const double additive = 2.0 * M_PI * M_PI / 24.0;
    check_variance("sum, few", mean_square(LATIN_HYPERCUBE, FEW, sum), additive / pow(FEW, 3),
                   1.0 / FEW);
    check_variance("sum, many", mean_square(LATIN_HYPERCUBE, MANY, sum), additive / pow(MANY, 3),
                   1.0 / MANY);
    check_variance("product, many", mean_square(LATIN_HYPERCUBE, MANY, product), 0.25 / MANY,
                   4.0 / MANY);
}

/* The error is at most V D*, D* <= c log2(n)/n for two parameters (Niederreiter 1992,
 * theorem 4.14): from 16 to 4096 points that is a slope of -1 + ln(12/4)/ln(256) = -0.80 or
 * steeper. The logarithm of a root mean square over 256 seeds is known to 1/sqrt(2 256) = 0.044 for
 * normal errors, so that a slope is known to 4.9 sqrt(2) 0.044/ln(256) = 0.055 at alpha 1e-6; those
 * of Sobol are not normal: twice that. */
static void test_slopes(void **state)
{
    double slope[3];
    for (int type = 0; type < 3; type++) {
        slope[type] = 0.5 *
                      log(mean_square(type, MANY, product) / mean_square(type, FEW, product)) /
                      log((double)MANY / FEW);
        print_message("%s: error of the product as n^%.3f\n", fracas_design_types[type]->name,
                      slope[type]);
    }
    assert_true(fabs(slope[RANDOM] + 0.5) < 0.055);
    assert_true(slope[SOBOL] < -0.80 + 0.11);
}

TESTS(test_random, test_latin_hypercube, test_slopes)
