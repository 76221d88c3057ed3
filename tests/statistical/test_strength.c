/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strength fields against their exact laws: moments, Kolmogorov-Smirnov, minima, independence of
 * streams. Seeds are fixed, so a result is the same in every run; every bound is the one that a
 * right sampler exceeds with probability ALPHA or less. */
#include "tests/support/kinds.h"
#include "tests/support/strengths.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sf_gamma.h>

#define ALPHA 1e-6
static const double normal_bound = 4.8916; /* |z| exceeds it with probability ALPHA */

enum { N = 100000 };
static double sample[N], other[N], volume[N];

static fracas_strength weibull(double minimum, double scale, double shape)
{
    return (fracas_strength){.distribution = kind_of(&fracas_strength_section, "weibull"),
                             .minimum = minimum,
                             .scale = scale,
                             .shape = shape};
}

/* `number` flaws in each interface, on average. */
static fracas_strength flaws(double number)
{
    return (fracas_strength){.distribution = kind_of(&fracas_strength_section, "flaws"),
                             .own[0] = number / 2e-9,
                             .minimum = 100e6,
                             .maximum = 400e6,
                             .own[1] = 4.0};
}

static fracas_stream stream(uint64_t seed)
{
    return (fracas_stream){
        .seed = seed, .purpose = FRACAS_PURPOSE_STRENGTH, .point = {11, 22}, .replica = 3};
}

static const double body = 2e-9; /* m3, of one interface, or of a chain of them */

static void fill_volumes(double each)
{
    for (size_t i = 0; i < N; i++) volume[i] = each;
}

/* P(strength <= sigma_c), of an interface of volume `body`. */
static double cdf(const fracas_strength *strength, double sigma_c)
{
    const char *name = strength->distribution->name;
    if (strcmp(name, "weibull") == 0)
        return gsl_cdf_weibull_P(sigma_c - strength->minimum, strength->scale, strength->shape);
    if (strcmp(name, "lognormal") == 0)
        return gsl_cdf_lognormal_P(sigma_c, log(strength->median), strength->sigma);
    if (strcmp(name, "normal") == 0) {
        double kept = gsl_cdf_ugaussian_P(strength->mean / strength->deviation);
        return 1.0 - gsl_cdf_gaussian_Q(sigma_c - strength->mean, strength->deviation) / kept;
    }
    if (strcmp(name, "gamma") == 0)
        return gsl_cdf_gamma_P(sigma_c, strength->shape, strength->scale);
    if (strcmp(name, "flaws") == 0) {
        double place = (sigma_c - strength->minimum) / (strength->maximum - strength->minimum);
        return -expm1(-strength->own[0] * body *
                      pow(place, strength->own[1])); /* at the maximum: just below it */
    }
    return gsl_cdf_flat_P(sigma_c, strength->minimum, strength->maximum);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* D = sup |F_n - F|. P(D > d) <= 2 exp(-2 n d^2) for every n (Massart 1990): d =
 * sqrt(ln(2/alpha)/(2 n)). That holds with an atom at the maximum, too: F is then `cdf` just below
 * the maximum and 1, as F_n, at it. */
static void assert_follows(const fracas_strength *law, double *value, size_t n)
{
    qsort(value, n, sizeof *value, ascending);
    double distance = 0.0;
    for (size_t i = 0; i < n; i++) {
        double f = cdf(law, value[i]);
        distance = fmax(distance, f - (double)i / (double)n);
        if (strcmp(law->distribution->name, "flaws") == 0 && value[i] == law->maximum) f = 1.0;
        distance = fmax(distance, (double)(i + 1) / (double)n - f);
    }
    double bound = sqrt(log(2.0 / ALPHA) / (2.0 * (double)n));
    print_message("%s: D = %.2e, bound %.2e\n", law->distribution->name, distance, bound);
    assert_true(distance < bound);
}

static void distributions_follow_their_laws(void **state)
{
    const fracas_strength laws[] = {
        weibull(264e6, 50e6, 2.0),
        weibull(0.0, 450e6, 40.0),
        weibull(0.0, 450e6, 0.5),
        {.distribution = kind_of(&fracas_strength_section, "lognormal"),
         .median = 300e6,
         .sigma = 0.3},
        {.distribution = kind_of(&fracas_strength_section, "uniform"),
         .minimum = 264e6,
         .maximum = 364e6},
        {.distribution = kind_of(&fracas_strength_section, "normal"),
         .mean = 300e6,
         .deviation = 30e6},
        {.distribution = kind_of(&fracas_strength_section, "normal"),
         .mean = 100e6,
         .deviation = 200e6},
        {.distribution = kind_of(&fracas_strength_section, "gamma"), .shape = 0.3, .scale = 300e6},
        {.distribution = kind_of(&fracas_strength_section, "gamma"), .shape = 12.0, .scale = 25e6},
        {.distribution = kind_of(&fracas_strength_section, "gamma"), .shape = 2e4, .scale = 15e3},
        flaws(0.7),
        flaws(3.0),
        flaws(40.0),
    };
    fill_volumes(body);
    for (size_t k = 0; k < FRACAS_COUNT(laws); k++) {
        fracas_stream named = stream(100 + k);
        assert_int_equal(sample_strengths(&laws[k], &named, N, volume, NULL, 1, sample), FRACAS_OK);
        assert_follows(&laws[k], sample, N);
    }
}

/* docs/theory/sampling.md: 308.31 +- 23.16, 413.18 +- 94.64, 443.78 +- 13.98 MPa. The closed forms
 * give these to the last digit; the sample's mean has the standard error s/sqrt(n), its standard
 * deviation s sqrt((kurtosis - 1)/(4 n)), kurtosis from the central moments of (sigma -
 * minimum)/scale. */
static void weibull_moments(void **state)
{
    static const struct {
        double minimum, scale, shape, mean, deviation;
    } published[] = {
        {264e6, 50e6, 2.0, 308.31e6, 23.16e6},
        {0.0, 450e6, 5.0, 413.18e6, 94.64e6},
        {0.0, 450e6, 40.0, 443.78e6, 13.98e6},
    };
    for (size_t k = 0; k < FRACAS_COUNT(published); k++) {
        double m = published[k].shape;
        double g1 = gsl_sf_gamma(1 + 1 / m), g2 = gsl_sf_gamma(1 + 2 / m),
               g3 = gsl_sf_gamma(1 + 3 / m), g4 = gsl_sf_gamma(1 + 4 / m);
        double variance = g2 - g1 * g1;
        double kurtosis = (g4 - 4 * g1 * g3 + 6 * g1 * g1 * g2 - 3 * g1 * g1 * g1 * g1) /
                          (variance * variance);
        double deviation = published[k].scale * sqrt(variance);
        fracas_strength law = weibull(published[k].minimum, published[k].scale, m);
        double mean = mean_of_strength(&law, volume[0]);
        assert_true(fabs(mean - published[k].mean) <= 0.005e6);
        assert_true(fabs(deviation - published[k].deviation) <= 0.005e6);

        fracas_stream named = stream(200 + k);
        assert_int_equal(sample_strengths(&law, &named, N, volume, NULL, 1, sample), FRACAS_OK);
        double sum = 0.0, squares = 0.0;
        for (size_t i = 0; i < N; i++) sum += sample[i] - mean;
        for (size_t i = 0; i < N; i++)
            squares += (sample[i] - mean - sum / N) * (sample[i] - mean - sum / N);
        double sample_deviation = sqrt(squares / (N - 1));
        print_message("m = %g: %.2f +- %.2f MPa\n", m, (mean + sum / N) * 1e-6,
                      sample_deviation * 1e-6);
        assert_true(fabs(sum / N) < normal_bound * deviation / sqrt(N));
        assert_true(fabs(sample_deviation - deviation) <
                    normal_bound * deviation * sqrt((kurtosis - 1) / (4.0 * N)));
    }
}

/* `raw`: first four moments of strength - minimum. Bounds as for Weibull above. */
static void assert_moments(const fracas_strength *law, uint64_t seed, const double raw[4])
{
    double m = raw[0], variance = raw[1] - m * m;
    double fourth = raw[3] - 4 * m * raw[2] + 6 * m * m * raw[1] - 3 * m * m * m * m;
    double deviation = sqrt(variance), kurtosis = fourth / (variance * variance);
    double mean = law->minimum + m;
    /* GSL's functions are good to 1e-13 here, and the first moment is one or two of them */
    assert_true(fabs(mean_of_strength(law, body) - mean) <= 1e-12 * mean);
    /* the variance is the difference of two that are 100 times larger at most */
    assert_true(fabs(fracas_strength_deviation(law, (fracas_extent){body, 1.0}) - deviation) <=
                1e-10 * deviation);
    fracas_stream named = stream(seed);
    assert_int_equal(sample_strengths(law, &named, N, volume, NULL, 1, sample), FRACAS_OK);
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < N; i++) sum += sample[i] - mean;
    for (size_t i = 0; i < N; i++)
        squares += (sample[i] - mean - sum / N) * (sample[i] - mean - sum / N);
    double sample_deviation = sqrt(squares / (N - 1));
    print_message("%s: %.2f +- %.2f MPa, exactly %.2f +- %.2f\n", law->distribution->name,
                  (mean + sum / N) * 1e-6, sample_deviation * 1e-6, mean * 1e-6, deviation * 1e-6);
    assert_true(fabs(sum / N) < normal_bound * deviation / sqrt(N));
    assert_true(fabs(sample_deviation - deviation) <
                normal_bound * deviation * sqrt((kurtosis - 1) / (4.0 * N)));
}

/* Moments of a normal law cut off at 0: M_n = mean M_(n-1) + (n - 1) deviation^2 M_(n-2) for n >=
 * 2, by parts. */
static void normal_moments(void **state)
{
    fill_volumes(body);
    static const double means[] = {300e6, 100e6, 10e6}, d = 120e6;
    for (size_t k = 0; k < FRACAS_COUNT(means); k++) {
        double m = means[k], hazard = gsl_ran_ugaussian_pdf(m / d) / gsl_cdf_ugaussian_P(m / d);
        double raw[4] = {m + d * hazard};
        raw[1] = m * raw[0] + d * d;
        raw[2] = m * raw[1] + 2 * d * d * raw[0];
        raw[3] = m * raw[2] + 3 * d * d * raw[1];
        fracas_strength law = {
            .distribution = kind_of(&fracas_strength_section, "normal"), .mean = m, .deviation = d};
        assert_moments(&law, 500 + k, raw);
    }
}

/* M_n = scale^n k (k + 1) ... (k + n - 1). */
static void gamma_moments(void **state)
{
    fill_volumes(body);
    static const double shapes[] = {0.3, 2.0, 12.0, 500.0}, t = 30e6;
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++) {
        double a = shapes[k];
        double raw[4] = {t * a, t * t * a * (a + 1), t * t * t * a * (a + 1) * (a + 2),
                         t * t * t * t * a * (a + 1) * (a + 2) * (a + 3)};
        fracas_strength law = {
            .distribution = kind_of(&fracas_strength_section, "gamma"), .shape = a, .scale = t};
        assert_moments(&law, 520 + k, raw);
    }
}

/* M_n = range^n integral_0^1 n x^(n-1) exp(-mu x^p) dx = range^n Gamma(1 + n/p) mu^(-n/p) P(n/p,
 * mu). */
static void flaws_moments(void **state)
{
    fill_volumes(body);
    static const double numbers[] = {0.1, 0.7, 3.0, 40.0};
    for (size_t k = 0; k < FRACAS_COUNT(numbers); k++) {
        fracas_strength law = flaws(numbers[k]);
        double raw[4], p = law.own[1], mu = law.own[0] * body, range = law.maximum - law.minimum;
        for (int n = 1; n <= 4; n++)
            raw[n - 1] = pow(range, n) * gsl_sf_gamma(1 + n / p) * pow(mu, -n / p) *
                         gsl_sf_gamma_inc_P(n / p, mu);
        assert_moments(&law, 540 + k, raw);
    }
}

/* The weakest of n interfaces that share a body is that of the body, however many they are. */
static void flaws_do_not_see_the_mesh(void **state)
{
    enum { CHAINS = 10000, LONGEST = 64 };
    fracas_strength law = flaws(5.0);
    for (size_t n = 1; n <= LONGEST; n *= 4) {
        fill_volumes(body / (double)n);
        fracas_stream named = stream(560 + n);
        for (size_t chain = 0; chain < CHAINS; chain++) {
            double strength[LONGEST];
            named.replica = chain;
            assert_int_equal(sample_strengths(&law, &named, n, volume, NULL, 1, strength),
                             FRACAS_OK);
            other[chain] = INFINITY;
            for (size_t i = 0; i < n; i++) other[chain] = fmin(other[chain], strength[i]);
        }
        assert_follows(&law, other, CHAINS);
    }
}

/* The weakest of n has the same law with scale n^(-1/m): each replica is a chain of n interfaces.
 */
static void the_weakest_of_n_scales(void **state)
{
    enum { CHAINS = 10000, LONGEST = 64 };
    static const double shapes[] = {2.0, 10.0};
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++) {
        fracas_strength law = weibull(264e6, 50e6, shapes[k]);
        for (size_t n = 1; n <= LONGEST; n *= 4) {
            fracas_stream named = stream(300 + k);
            for (size_t chain = 0; chain < CHAINS; chain++) {
                double strength[LONGEST];
                named.replica = chain;
                assert_int_equal(sample_strengths(&law, &named, n, volume, NULL, 1, strength),
                                 FRACAS_OK);
                other[chain] = INFINITY;
                for (size_t i = 0; i < n; i++) other[chain] = fmin(other[chain], strength[i]);
            }
            fracas_strength weakest = law;
            weakest.scale = law.scale * pow((double)n, -1.0 / law.shape);
            assert_follows(&weakest, other, CHAINS);
        }
    }
}

/* Mean of 12 (u - 1/2)(v - 1/2): mean 0 and variance 1/N when u and v are independent; the products
 * of neighbours of one sequence are uncorrelated too. */
static void assert_uncorrelated(const char *what, const double *u, const double *v, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) sum += 12.0 * (u[i] - 0.5) * (v[i] - 0.5);
    double r = sum / (double)n, bound = normal_bound / sqrt((double)n);
    print_message("%s: correlation %.1e, bound %.1e\n", what, r, bound);
    assert_true(fabs(r) < bound);
}

static void fill(fracas_stream named, double *u)
{
    for (size_t i = 0; i < N; i++) u[i] = fracas_stream_uniform(&named, i);
}

static void neighbouring_streams_are_independent(void **state)
{
    fracas_stream first = stream(400);
    fill(first, sample);
    for (size_t lag = 1; lag <= 4; lag++)
        assert_uncorrelated("interface and a neighbour", sample, sample + lag, N - lag);
    fracas_stream next[6];
    for (size_t k = 0; k < FRACAS_COUNT(next); k++) next[k] = first;
    next[0].replica++;
    next[1].point[0]++;
    next[2].point[1]++;
    next[3].seed++;
    next[4].purpose++;
    next[5].point[0] = first.point[1], next[5].point[1] = first.point[0];
    static const char *const what[] = {
        "next replica", "next point, first word", "next point, second word",
        "next seed",    "next purpose",           "words of the point swapped"};
    for (size_t k = 0; k < FRACAS_COUNT(next); k++) {
        fill(next[k], other);
        assert_uncorrelated(what[k], sample, other, N);
        assert_uncorrelated(what[k], sample + 1, other, N - 1);
        assert_uncorrelated(what[k], sample, other + 1, N - 1);
    }
}

TESTS(distributions_follow_their_laws, weibull_moments, normal_moments, gamma_moments,
      flaws_moments, flaws_do_not_see_the_mesh, the_weakest_of_n_scales,
      neighbouring_streams_are_independent)
