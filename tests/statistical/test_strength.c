/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strength fields against their exact laws: moments, Kolmogorov-Smirnov, minima. */
#include "tests/support/strength_samples.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sf_gamma.h>

static fracas_strength weibull(double minimum, double scale, double shape)
{
    return STRENGTH("weibull", .minimum = minimum, .scale = scale, .shape = shape);
}

/* `number` flaws in each interface, on average. */
static fracas_strength flaws(double number)
{
    return STRENGTH("flaws", .own[0] = number / 2e-9, .minimum = 100e6, .maximum = 400e6,
                    .own[1] = 4.0);
}

static const double body = 2e-9; /* m3, of one interface, or of a chain of them */

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

static void distributions_follow_their_laws(void **state)
{
    const fracas_strength laws[] = {
        weibull(264e6, 50e6, 2.0),
        weibull(0.0, 450e6, 40.0),
        weibull(0.0, 450e6, 0.5),
        STRENGTH("lognormal", .median = 300e6, .sigma = 0.3),
        STRENGTH("uniform", .minimum = 264e6, .maximum = 364e6),
        STRENGTH("normal", .mean = 300e6, .deviation = 30e6),
        STRENGTH("normal", .mean = 100e6, .deviation = 200e6),
        STRENGTH("gamma", .shape = 0.3, .scale = 300e6),
        STRENGTH("gamma", .shape = 12.0, .scale = 25e6),
        STRENGTH("gamma", .shape = 2e4, .scale = 15e3),
        flaws(0.7),
        flaws(3.0),
        flaws(40.0),
    };
    for (size_t k = 0; k < FRACAS_COUNT(laws); k++) {
        draw(&laws[k], 100 + k, body);
        assert_follows(&laws[k], cdf, 1, sample, N);
    }
}

/* Mean 310 MPa above 264 MPa with modulus 2: scale 46 MPa/Gamma(3/2) = 92 MPa/sqrt(pi); by shape
 * alone (1000 at most) the mean above 0. Rounding of a gamma function. */
static void weibull_by_its_mean_and_shape(void **state)
{
    const fracas_strength given = STRENGTH("weibull", .minimum = 264e6, .mean = 310e6, .shape = 2),
                          narrow = STRENGTH("weibull", .mean = 310e6, .shape = 1000),
                          low = STRENGTH("weibull", .minimum = 264e6, .mean = 264e6, .shape = 2),
                          three = STRENGTH("weibull", .mean = 310e6, .shape = 2, .scale = 1e6);
    const fracas_probability median = fracas_probability_of(0.5);
    fracas_strength ready;
    assert_true(fabs(mean_of_strength(&given, body) - 310e6) < 1e-12 * 310e6);
    assert_true(fabs(mean_of_strength(&narrow, body) - 310e6) < 1e-12 * 310e6);
    OK(fracas_strength_init(&given, &ready));
    assert_true(fabs(fracas_strength_quantile(&ready, (fracas_extent){body, 1.0}, median) -
                     (264e6 + 92e6 / sqrt(M_PI) * sqrt(log(2)))) < 1e-12 * 310e6);
    FAILS(fracas_strength_init(&low, &ready), FRACAS_USAGE, "the mean is above the minimum");
    FAILS(fracas_strength_init(&three, &ready), FRACAS_USAGE, "take out `mean`");
}

/* `raw`: first four moments of strength - minimum. Returns the mean, in closed form. */
static double check_law(const fracas_strength *law, uint64_t seed, const double raw[4])
{
    double m = raw[0], variance = raw[1] - m * m;
    double fourth = raw[3] - 4 * m * raw[2] + 6 * m * m * raw[1] - 3 * m * m * m * m;
    double deviation = sqrt(variance), mean = law->minimum + m;
    /* GSL's functions are good to 1e-13 here, and the first moment is one or two of them */
    assert_true(fabs(mean_of_strength(law, body) - mean) <= 1e-12 * mean);
    /* the variance is the difference of two that are 1000 times larger at most */
    assert_true(fabs(fracas_strength_deviation(law, (fracas_extent){body, 1.0}) - deviation) <=
                1e-10 * deviation);
    draw(law, seed, body);
    assert_moments(mean, deviation, fourth / (variance * variance));
    return mean;
}

/* docs/theory/sampling.md: 308.31 +- 23.16, 413.18 +- 94.64, 443.78 +- 13.98 MPa, which closed
 * forms give to the last digit. */
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
        fracas_strength law = weibull(published[k].minimum, published[k].scale, published[k].shape);
        double raw[4];
        for (int n = 1; n <= 4; n++)
            raw[n - 1] = pow(law.scale, n) * gsl_sf_gamma(1 + n / law.shape);
        assert_true(fabs(check_law(&law, 200 + k, raw) - published[k].mean) <= 0.005e6);
        assert_true(fabs(sqrt(raw[1] - raw[0] * raw[0]) - published[k].deviation) <= 0.005e6);
    }
}

/* Moments of a normal law cut off at 0: M_n = mean M_(n-1) + (n - 1) deviation^2 M_(n-2) for n >=
 * 2, by parts. */
static void normal_moments(void **state)
{
    static const double means[] = {300e6, 100e6, 10e6}, d = 120e6;
    for (size_t k = 0; k < FRACAS_COUNT(means); k++) {
        double m = means[k], hazard = gsl_ran_ugaussian_pdf(m / d) / gsl_cdf_ugaussian_P(m / d);
        double raw[4] = {m + d * hazard};
        raw[1] = m * raw[0] + d * d;
        raw[2] = m * raw[1] + 2 * d * d * raw[0];
        raw[3] = m * raw[2] + 3 * d * d * raw[1];
        fracas_strength law = STRENGTH("normal", .mean = m, .deviation = d);
        check_law(&law, 500 + k, raw);
    }
}

/* M_n = scale^n k (k + 1) ... (k + n - 1). */
static void gamma_moments(void **state)
{
    static const double shapes[] = {0.3, 2.0, 12.0, 500.0}, t = 30e6;
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++) {
        double a = shapes[k];
        double raw[4] = {t * a, t * t * a * (a + 1), t * t * t * a * (a + 1) * (a + 2),
                         t * t * t * t * a * (a + 1) * (a + 2) * (a + 3)};
        fracas_strength law = STRENGTH("gamma", .shape = a, .scale = t);
        check_law(&law, 520 + k, raw);
    }
}

/* M_n = range^n integral_0^1 n x^(n-1) exp(-mu x^p) dx = range^n Gamma(1 + n/p) mu^(-n/p) P(n/p,
 * mu). */
static void flaws_moments(void **state)
{
    static const double numbers[] = {0.1, 0.7, 3.0, 40.0};
    for (size_t k = 0; k < FRACAS_COUNT(numbers); k++) {
        fracas_strength law = flaws(numbers[k]);
        double raw[4], p = law.own[1], mu = law.own[0] * body, range = law.maximum - law.minimum;
        for (int n = 1; n <= 4; n++)
            raw[n - 1] = pow(range, n) * gsl_sf_gamma(1 + n / p) * pow(mu, -n / p) *
                         gsl_sf_gamma_inc_P(n / p, mu);
        check_law(&law, 540 + k, raw);
    }
}

/* The weakest of n interfaces that share a body is that of the body, however many they are. */
static void flaws_do_not_see_the_mesh(void **state)
{
    fracas_strength law = flaws(5.0);
    for (size_t n = 1; n <= LONGEST; n *= 4) {
        draw_weakest(&law, n, body, 560 + n);
        assert_follows(&law, cdf, 1, sample, CHAINS);
    }
}

/* The weakest of n has the same law with scale n^(-1/m). */
static void the_weakest_of_n_scales(void **state)
{
    static const double shapes[] = {2.0, 10.0};
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++)
        for (size_t n = 1; n <= LONGEST; n *= 4) {
            fracas_strength law = weibull(264e6, 50e6, shapes[k]), weakest = law;
            weakest.scale = law.scale * pow((double)n, -1.0 / law.shape);
            draw_weakest(&law, n, body, 300 + k);
            assert_follows(&weakest, cdf, 1, sample, CHAINS);
        }
}

TESTS(distributions_follow_their_laws, weibull_by_its_mean_and_shape, weibull_moments,
      normal_moments, gamma_moments, flaws_moments, flaws_do_not_see_the_mesh,
      the_weakest_of_n_scales)
