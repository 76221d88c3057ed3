/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The weakest-link size effect: laws of an interface from those of a specimen. */
#include "base/elementary.h"
#include "base/hash.h"
#include "sampler/special/exponential.h"
#include "sampler/special/incomplete_gamma.h"
#include "sampler/special/normal.h"
#include "tests/support/strengths.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <inttypes.h>

static const fracas_extent one = {1.0, 1.0};
static const double VOLUME = 2e-9, AREA = 3e-6; /* of a specimen, m3 and m2 */

static const fracas_attachment measured = FILE_OF("m.csv", "3e8\n5e8\n4e8\n2e8\n2.5e8\n");
static const fracas_attachment table = FILE_OF("t.csv",
                                               "1e8, 0\n2e8 0.25\n3e8\t0.25\n5e8,0.999\n6e8 1\n");

enum { LAWS = 8 };

/* Number k of the laws that can have a reference, of specimens of this volume. */
static fracas_strength example(int k, double volume)
{
    const fracas_strength laws[LAWS] = {
        STRENGTH("weibull", .minimum = 264e6, .scale = 50e6, .shape = 2.0),
        STRENGTH("lognormal", .median = 300e6, .sigma = 0.3),
        STRENGTH("normal", .mean = 300e6, .deviation = 120e6),
        STRENGTH("gamma", .shape = 9.0, .scale = 30e6),
        STRENGTH("gamma", .shape = 150.0, .scale = 2e6),
        STRENGTH("uniform", .minimum = 264e6, .maximum = 364e6),
        law_of_file(&measured, false),
        law_of_file(&table, false),
    };
    fracas_strength law = laws[k];
    law.reference_volume = volume;
    law.reference_area = NAN;
    return law;
}

/* As fracas_probability_of, of P(strength > s) = e^-t, in long double first. */
static fracas_probability after(long double t)
{
    return (fracas_probability){(double)-expm1l(-t), (double)expl(-t)};
}

/* ---- far tails ---- */

/* z moves ln P by z times as much: an error of 1e-15 of z is one of 2e-15 of t. */
static void normal_far_is_erfc(void **state)
{
    for (double t = 600.0; t < 11000.0; t *= 1.01) {
        const double z = fracas_normal_far(t);
        assert_close((double)-logl(0.5L * erfcl((long double)z / sqrtl(2.0L))), t, 2e-15);
    }
    assert_close(fracas_normal_far(700.0),
                 fracas_normal_quantile((fracas_probability){1.0, fracas_exp(-700.0)}), 1e-14);
    assert_close(fracas_normal_far(1e10),
                 sqrt(2e10) - log(sqrt(2e10) * sqrt(2.0 * acos(-1.0))) / sqrt(2e10), 1e-15);
}

/* Q by the continued fraction from its far end; ln Gamma in long double. What x is off by, times
 * the slope, is what ln Q is. */
static void gamma_far_inverts_its_law(void **state)
{
    static const double shapes[] = {0.1, 0.5, 1.0, 3.0, 9.9, 10.1, 120.0, 1e4, 1e6};
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++)
        for (double t = 40.0; t < 1e9; t *= 3.0) {
            const long double a = shapes[k], x = fracas_incomplete_gamma_far(shapes[k], t);
            long double rest = 0.0L;
            for (int n = 20000; n > 0; n--) rest = n * (n - a) / (x + 2.0L * n + 1.0L - a - rest);
            rest = 1.0L / (x + 1.0L - a - rest);
            const long double log_q = a * logl(x) - x - lgammal(a) + logl(rest);
            if (!(fabsl((log_q + t) * rest) < 5e-14L))
                fail_msg("shape %g, t %g: off by %Lg", shapes[k], t, (log_q + t) * rest);
        }
    assert_close(fracas_incomplete_gamma_far(1.0, 1e6), 1e6, 1e-15);
}

/* Probabilities far below those of a stream, against GSL: t = -ln P from 1e-300 to -ln 1e-300.
 * GSL's inverse of gamma gives up there. */
static void tails_are_exact_to_1e300(void **state)
{
    for (double tail = 1e-300; tail < 0.1; tail *= 1e7) {
        const fracas_probability low = {tail, 1.0 - tail}, high = {1.0 - tail, tail};
        assert_close(fracas_exponential_quantile(high), -log(tail), 1e-15);
        for (double shape = 0.5; shape < 100.0; shape *= 3.0) {
            const fracas_strength law = STRENGTH("weibull", .scale = 50e6, .shape = shape);
            assert_close(fracas_strength_quantile(&law, one, low),
                         gsl_cdf_weibull_Pinv(tail, 50e6, shape), 1e-12);
            assert_close(fracas_strength_quantile(&law, one, high),
                         gsl_cdf_weibull_Qinv(tail, 50e6, shape), 1e-12);
        }
        const fracas_strength lognormal = STRENGTH("lognormal", .median = 300e6, .sigma = 0.3);
        assert_close(fracas_strength_quantile(&lognormal, one, low),
                     gsl_cdf_lognormal_Pinv(tail, log(300e6), 0.3), 1e-12);
        assert_close(fracas_strength_quantile(&lognormal, one, high),
                     gsl_cdf_lognormal_Qinv(tail, log(300e6), 0.3), 1e-12);
        const fracas_strength normal = STRENGTH("normal", .mean = 600e6,
                                                .deviation = 15e6); /* nothing is cut off */
        assert_close(fracas_strength_quantile(&normal, one, high),
                     600e6 + gsl_cdf_gaussian_Qinv(tail, 15e6), 1e-12);
        assert_close(fracas_strength_quantile(&normal, one, low),
                     600e6 + gsl_cdf_gaussian_Pinv(tail, 15e6), 1e-12);
        const fracas_strength gamma = STRENGTH("gamma", .shape = 1.0,
                                               .scale = 30e6); /* exponential */
        assert_close(fracas_strength_quantile(&gamma, one, high), -30e6 * log(tail), 1e-13);
        assert_close(fracas_strength_quantile(&gamma, one, low), -30e6 * log1p(-tail), 1e-13);
        static const double shapes[] = {2.0, 9.0, 12.0, 150.0, 1e4};
        for (size_t k = 0; k < FRACAS_COUNT(shapes);
             k++) { /* from the law: P as a sum, its slope the density */
            const double a = shapes[k], x = fracas_incomplete_gamma_inverse(a, low);
            long double term = expl(a * logl(x) - x - lgammal(a + 1.0L)), slope = term * a,
                        sum = term;
            for (int n = 1; n < 40000 && term > 1e-25L * sum; n++) sum += term *= x / (a + n);
            if (!(fabsl(sum - tail) < 1e-12L * slope))
                fail_msg("shape %g, P = %g: x is off by %Lg", a, tail, (sum - tail) / slope);
        }
    }
}

/* ---- laws ---- */

/* Scale (reference/extent)^(1/m). Both sides round a logarithm of 40 at most, over m: 2^-53 40/0.5
 * is 1e-14. */
static void weibull_is_one_of_another_scale(void **state)
{
    for (double m = 0.5; m < 200.0; m *= 2.3)
        for (double size = 1e-8; size < 1e9; size *= 7.0) {
            const fracas_strength plain = STRENGTH("weibull", .scale = 50e6 * pow(size, -1.0 / m),
                                                   .shape = m);
            fracas_strength by_volume = plain, by_area = plain;
            by_volume.scale = by_area.scale = 50e6;
            by_volume.reference_volume = VOLUME;
            by_area.reference_area = AREA;
            const fracas_extent extent = {size * VOLUME, size * AREA};
            for (double u = 0x1p-53; u < 1.0; u = u < 0.01 ? 5.0 * u : u + 0.093) {
                const fracas_probability p = fracas_probability_of(u);
                const double expected = fracas_strength_quantile(&plain, extent, p);
                assert_close(fracas_strength_quantile(&by_volume, extent, p), expected, 1e-13);
                assert_close(fracas_strength_quantile(&by_area, extent, p), expected, 1e-13);
            }
            assert_close(fracas_strength_mean(&by_volume, extent),
                         fracas_strength_mean(&plain, extent), 1e-13);
            assert_close(fracas_strength_deviation(&by_area, extent),
                         fracas_strength_deviation(&plain, extent), 1e-13);
            assert_true(fracas_strength_has_size_effect(&by_area) &&
                        !fracas_strength_has_size_effect(&plain));
        }
}

/* The weakest of n interfaces of volume V/n is as strong as one of V: where the whole has
 * P(strength > s) = e^-t, a part has e^(-t/n). Also the definition itself: an interface of the size
 * of a specimen has the law that is given. */
static void no_law_sees_the_mesh(void **state)
{
    for (int k = 0; k < LAWS; k++) {
        const fracas_strength law = example(k, VOLUME);
        fracas_strength plain = law, ready;
        plain.reference_volume = NAN;
        OK(fracas_strength_init(&law, &ready));
        for (long double t = 1e-12L; t < 600.0L; t *= 1.7L) {
            const double whole = fracas_strength_quantile(
                &ready, (fracas_extent){3.0 * VOLUME, 1.0}, after(t));
            for (int n = 1; n < 100000; n *= 7)
                assert_close(fracas_strength_quantile(
                                 &ready, (fracas_extent){3.0 * VOLUME / n, 1.0}, after(t / n)),
                             whole, 1e-13);
            assert_close(fracas_strength_quantile(&ready, (fracas_extent){VOLUME, 1.0}, after(t)),
                         fracas_strength_quantile(&plain, (fracas_extent){VOLUME, 1.0}, after(t)),
                         1e-13);
        }
        fracas_strength_clear(&ready);
    }
}

/* The strengths of interfaces much smaller than a specimen are far out in its upper tail; nothing
 * jumps where e^-t leaves the doubles. */
static void small_interfaces_are_strong(void **state)
{
    for (int k = 0; k < LAWS; k++) {
        const fracas_strength law = example(k, VOLUME);
        double before = 0.0;
        for (double size = 1e3; size > 1e-4; size *= 0.9) {
            const double here = fracas_strength_quantile(&law, (fracas_extent){size * VOLUME, 1.0},
                                                         fracas_probability_of(0.5));
            assert_true(here >= before * (1.0 - 1e-15) && isfinite(here));
            before = here;
        }
        /* t/size is 700 and 700 (1 + 2^-52) up to rounding of the extents; 1e-13 of it moves a
         * strength less */
        const fracas_extent tiny = {VOLUME / 1400.0, 1.0};
        const double under = fracas_strength_quantile(&law, tiny, after(0.5 * (1 - 1e-15)));
        assert_close(fracas_strength_quantile(&law, tiny, after(0.5 * (1 + 1e-15))), under, 1e-13);
    }
}

/* ---- moments ---- */

typedef struct {
    fracas_strength law;
    double size;
    int power;
} integrand;

/* P(strength > s) of a specimen, by GSL. */
static double above_of(const fracas_strength *law, double s)
{
    const char *name = law->distribution->name;
    if (strcmp(name, "lognormal") == 0) return gsl_cdf_lognormal_Q(s, log(law->median), law->sigma);
    if (strcmp(name, "gamma") == 0) return gsl_cdf_gamma_Q(s, law->shape, law->scale);
    if (strcmp(name, "normal") == 0)
        return gsl_cdf_gaussian_Q(s - law->mean, law->deviation) /
               gsl_cdf_ugaussian_P(law->mean / law->deviation);
    return gsl_cdf_flat_Q(s, law->minimum, law->maximum);
}

/* For E s^n = integral n s^(n-1) P(strength > s)^size ds, in units of 1e8 Pa. */
static double survival(double s, void *context)
{
    const integrand *of = context;
    return (of->power == 1 ? 1.0 : 2.0 * s) * pow(above_of(&of->law, s * 1e8), of->size);
}

static double moment(const fracas_strength *law, double size, int power)
{
    gsl_integration_cquad_workspace *space = gsl_integration_cquad_workspace_alloc(1000);
    integrand of = {*law, size, power};
    gsl_function f = {survival, &of};
    double sum = 0.0, part, error;
    for (double from = 0.0; from < 1e7;
         from = from < 10.0 ? from + 1.0 : 2.0 * from) { /* beyond 1e15 Pa nothing is left */
        assert_int_equal(gsl_integration_cquad(&f, from, from < 10.0 ? from + 1.0 : 2.0 * from, 0.0,
                                               1e-12, space, &part, &error, NULL),
                         0);
        sum += part;
    }
    gsl_integration_cquad_workspace_free(space);
    return sum;
}

/* GSL's quadrature and its distribution functions, 1e-12 to 1e-11; the variance is a difference of
 * its sums, a tenth to a hundredth. */
static void moments_are_the_integrals(void **state)
{
    for (int k = 1; k < 6; k++) /* lognormal, normal, gamma, uniform */
        for (double size = 0.1; size < 200.0;
             size *= 4.0) { /* below, P^size counts where GSL's P is 0 */
            const fracas_strength law = example(k, VOLUME);
            const fracas_extent extent = {size * VOLUME, 1.0};
            const double mean = moment(&law, size, 1), square = moment(&law, size, 2);
            assert_close(fracas_strength_mean(&law, extent), mean * 1e8, 2e-11);
            assert_close(fracas_strength_deviation(&law, extent), sqrt(square - mean * mean) * 1e8,
                         1e-8);
        }
}

/* The quadrature against closed forms: at the size of a specimen, and of an exponential law (gamma
 * of shape 1) at any. */
static void quadrature_is_within_1e12(void **state)
{
    for (int k = 1; k < 5; k++) {
        const fracas_strength law = example(k, VOLUME);
        fracas_strength plain = law;
        plain.reference_volume = NAN;
        const fracas_extent extent = {VOLUME, 1.0};
        assert_close(fracas_strength_mean(&law, extent), fracas_strength_mean(&plain, extent),
                     1e-12);
        assert_close(fracas_strength_deviation(&law, extent),
                     fracas_strength_deviation(&plain, extent), 1e-12);
    }
    for (double size = 1e-6; size < 1e6; size *= 11.0) {
        const fracas_strength law = STRENGTH("gamma", .shape = 1.0, .scale = 30e6,
                                             .reference_volume = VOLUME);
        const fracas_extent extent = {size * VOLUME, 1.0};
        assert_close(fracas_strength_mean(&law, extent), 30e6 / size, 1e-12);
        assert_close(fracas_strength_deviation(&law, extent), 30e6 / size, 1e-12);
    }
    fracas_strength wide = STRENGTH("lognormal", .median = 300e6, .sigma = 5.0), same = wide;
    wide.reference_volume = VOLUME;
    const fracas_extent extent = {VOLUME, 1.0};
    assert_close(fracas_strength_mean(&wide, extent), fracas_strength_mean(&same, extent), 1e-12);
}

/* A lognormal tail makes small interfaces so strong that a mean is beyond all doubles: it is
 * infinite then, and not NaN. Where it is a double it is right, whatever strengths there are that
 * are too rare to count. ln of the mean of 0.3 specimens with sigma 10: integral 0.3 Q(z)^-0.7
 * phi(z) e^(10 z) dz by mpmath with 30 digits; 1e-12 relative is 1e-12 of the logarithm, and its
 * double adds 3e-14. */
static void moments_beyond_doubles_are_infinite(void **state)
{
    fracas_strength law = STRENGTH("lognormal", .median = 1.0, .sigma = 1.0,
                                   .reference_volume = VOLUME);
    assert_true(fracas_strength_mean(&law, (fracas_extent){1e-4 * VOLUME, 1.0}) == INFINITY);
    assert_true(fracas_strength_deviation(&law, (fracas_extent){1e-4 * VOLUME, 1.0}) == INFINITY);
    law.sigma = 10.0;
    const double mean = fracas_strength_mean(&law, (fracas_extent){0.3 * VOLUME, 1.0});
    assert_true(fabs(log(mean) - 169.162843620676285) < 2e-12);
    assert_true(fracas_strength_deviation(&law, (fracas_extent){0.3 * VOLUME, 1.0}) > mean);
}

/* Two measured strengths are a uniform law; of more, sums over n equal steps of each segment in
 * long double, right to 1/n^2. */
static void empirical_moments_are_exact(void **state)
{
    static const fracas_attachment pair = FILE_OF("p.csv", "264e6\n364e6\n");
    enum { STEPS = 200000 };
    for (double size = 1e-3; size < 1e4; size *= 6.0) {
        const fracas_extent extent = {size * VOLUME, 1.0};
        fracas_strength two = law_of_file(&pair, false), uniform = example(5, VOLUME);
        two.reference_volume = VOLUME;
        assert_close(fracas_strength_mean(&two, extent), fracas_strength_mean(&uniform, extent),
                     1e-14);
        assert_close(fracas_strength_deviation(&two, extent),
                     fracas_strength_deviation(&uniform, extent), 1e-12);
    }
    static const double x[] = {2.0, 2.5, 3.0, 4.0, 5.0};
    for (double size = 0.6; size < 30.0; size *= 2.5) {
        long double mean = x[0], square = (long double)x[0] * x[0];
        for (int k = 0; k < 4; k++)
            for (int i = 0; i < STEPS; i++) {
                const long double y = (i + 0.5L) / STEPS, s = x[k] + (x[k + 1] - x[k]) * y,
                                  w = (x[k + 1] - x[k]) / (long double)STEPS;
                const long double above = powl(1.0L - (k + y) / 4.0L, size);
                mean += w * above;
                square += 2.0L * s * w * above;
            }
        const fracas_strength law = example(6, VOLUME);
        const fracas_extent extent = {size * VOLUME, 1.0};
        const double bound = size < 1.0 ? 1e-7 : 1e-9; /* an end as (1 - y)^size */
        assert_close(fracas_strength_mean(&law, extent), (double)(mean * 1e8L), bound);
        assert_close(fracas_strength_deviation(&law, extent),
                     (double)(sqrtl(square - mean * mean) * 1e8L), 30 * bound);
    }
    /* 1 - 1e-9 as a double is wrong by 8e-17: its power of 1e9 would be wrong by 6e-8 */
    static const fracas_attachment rare = FILE_OF("r.csv", "1e8 1e-9\n2e8 1\n");
    fracas_strength weak = law_of_file(&rare, true);
    weak.reference_volume = VOLUME;
    assert_close(fracas_strength_mean(&weak, (fracas_extent){1e9 * VOLUME, 1.0}),
                 1e8 * (1.0 + (double)expl(1e9L * log1pl(-1e-9L))), 1e-14);
    static const fracas_attachment rare_flat = FILE_OF("f.csv",
                                                       "1e8 0\n2e8 1e-9\n3e8 1e-9\n4e8 1\n");
    weak = law_of_file(&rare_flat, false);
    weak.reference_volume = VOLUME;
    const double below = (double)((1.0L - expl((1e9L + 1.0L) * log1pl(-1e-9L))) /
                                  ((1e9L + 1.0L) * 1e-9L)),
                 at = (double)expl(1e9L * log1pl(-1e-9L));
    assert_close(fracas_strength_mean(&weak, (fracas_extent){1e9 * VOLUME, 1.0}),
                 1e8 * (1.0 + below + at), 1e-9); /* the last segment is left out: 1e8/1e9 */
    /* the weakest of two: 2, 2.5, 3, 4, 5 with 9, 7, 5, 3, 1 of 25 */
    fracas_strength steps = law_of_file(&measured, true);
    steps.reference_volume = VOLUME;
    assert_close(fracas_strength_mean(&steps, (fracas_extent){2 * VOLUME, 1.0}),
                 (18 + 17.5 + 15 + 12 + 5) / 25 * 1e8, 1e-14);
    assert_close(fracas_strength_deviation(&steps, (fracas_extent){2 * VOLUME, 1.0}),
                 sqrt((36 + 43.75 + 45 + 48 + 25) / 25 - 2.7 * 2.7) * 1e8, 1e-13);
}

/* Whoever compiles it, and for whatever CPU; as in test_sampler.c. */
static void bits_are_golden(void **state)
{
    static double value[LAWS * 3][1000];
    for (int k = 0; k < LAWS; k++)
        for (int step = 0; step < 3; step++) {
            const fracas_strength law = example(k, VOLUME);
            const fracas_extent extent = {(double[]){1e-4, 0.5, 300.0}[step] * VOLUME, 1.0};
            double *of = value[3 * k + step];
            for (int i = 0; i < 998; i++)
                of[i] = fracas_strength_quantile(&law, extent,
                                                 fracas_probability_of((i + 1) / 1000.0));
            of[998] = fracas_strength_mean(&law, extent);
            of[999] = fracas_strength_deviation(&law, extent);
        }
    const uint64_t got = fracas_checksum_of(value, sizeof value);
    print_message("0x%016" PRIx64 "\n", got);
    assert_true(got == 0x4fa02c0c59ae5fe3);
}

static void refused(fracas_strength law, const char *words)
{
    FAILS(fracas_strength_check(&law), FRACAS_USAGE, words);
}

static void references_that_say_nothing_are_refused(void **state)
{
    fracas_strength both = example(0, VOLUME);
    both.reference_area = AREA;
    refused(both, "`reference_volume` and `reference_area` are both given: take out one");
    refused(STRENGTH("constant", .value = 1e8, .reference_area = AREA),
            "`reference_area` does not go with the distribution constant, whose strengths are the "
            "same whatever");
    refused(
        STRENGTH("flaws", .own[0] = 1e9, .maximum = 4e8, .own[1] = 3, .reference_volume = VOLUME),
        "`reference_volume` does not go with the distribution flaws, whose strengths depend on "
        "the volume by themselves: take it out");
    refused(STRENGTH("file", .file = &measured, .reference_volume = VOLUME),
            "the distribution file");
}

TESTS(normal_far_is_erfc, gamma_far_inverts_its_law, tails_are_exact_to_1e300,
      weibull_is_one_of_another_scale, no_law_sees_the_mesh, small_interfaces_are_strong,
      moments_are_the_integrals, quadrature_is_within_1e12, moments_beyond_doubles_are_infinite,
      empirical_moments_are_exact, bits_are_golden, references_that_say_nothing_are_refused)
