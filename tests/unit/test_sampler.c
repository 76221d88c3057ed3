/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Streams by name, inverse transforms against GSL, and the contract that a value depends on its
 * name alone. */
#include "base/hash.h"
#include "sampler/special/incomplete_gamma.h"
#include "sampler/special/normal.h"
#include "tests/support/strengths.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <inttypes.h>

#include <Random123/philox.h>

static const double VOLUME = 2e-9; /* m3, of every interface where not said otherwise */

/* Philox4x64-10 as published with Random123 (tests/kat_vectors): nothing, all ones, digits of pi.
 */
static const struct {
    uint64_t counter[4], key[2], out[4];
} published[] = {
    {{0, 0, 0, 0},
     {0, 0},
     {0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}},
    {{UINT64_MAX, UINT64_MAX, UINT64_MAX, UINT64_MAX},
     {UINT64_MAX, UINT64_MAX},
     {0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}},
    {{0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
     {0x452821e638d01377, 0xbe5466cf34e90c6c},
     {0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6}},
};

static void philox_gives_the_published_words(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(published); i++) {
        philox4x64_ctr_t counter;
        philox4x64_key_t key;
        memcpy(counter.v, published[i].counter, sizeof counter.v);
        memcpy(key.v, published[i].key, sizeof key.v);
        philox4x64_ctr_t out = philox4x64(counter, key);
        assert_memory_equal(out.v, published[i].out, sizeof out.v);
    }
}

/* The stream's key and counter are in their places, and u is exactly (x >> 12) + 1/2 in units of
 * 2^-52. */
static void stream_is_the_published_first_word(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(published); i++) {
        const uint64_t *counter = published[i].counter, *key = published[i].key;
        fracas_stream stream = {.seed = key[0],
                                .purpose = key[1],
                                .replica = counter[1],
                                .point = {counter[2], counter[3]}};
        double u = fracas_stream_uniform(&stream, counter[0]);
        uint64_t halves = 2 * (published[i].out[0] >> 12) + 1;
        assert_true(ldexp(u, 53) == (double)halves); /* 53 bits: exact */
        assert_true(1.0 - (1.0 - u) == u);
    }
}

/* u = 2^-k and 1 - 2^-k down both tails, and 999 values between. */
enum { TAIL = 53, MIDDLE = 999, PROBES = 2 * TAIL + MIDDLE };

static double probe(int i, double *rest)
{
    double u = i < TAIL ? ldexp(1.0, -(i + 2)) : (i - TAIL + 1) / (MIDDLE + 1.0);
    if (i >= TAIL + MIDDLE) u = 1.0 - ldexp(1.0, -(i - TAIL - MIDDLE + 1));
    *rest = 1.0 - u;
    return u;
}

/* The oracle takes u in the lower half, 1 - u in the upper one. Errors of both sides: of ln t,
 * 2^-53 |ln t|/m with |ln t| < 37.5, m >= 0.1, and a few ulp: below 1e-13; the issue asks for
 * 1e-12. */
static void weibull_is_gsl_in_both_tails(void **state)
{
    static const double shapes[] = {0.1, 0.5, 1.0, 2.0, 5.0, 40.0, 1000.0};
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++) {
        fracas_strength two = STRENGTH("weibull", .scale = 50e6, .shape = shapes[k]);
        fracas_strength three = two;
        three.minimum = 264e6;
        for (int i = 0; i < PROBES; i++) {
            double rest, u = probe(i, &rest);
            double got = quantile_of(&two, VOLUME, u);
            double expected = u < 0.5 ? gsl_cdf_weibull_Pinv(u, two.scale, two.shape)
                                      : gsl_cdf_weibull_Qinv(rest, two.scale, two.shape);
            assert_close(got, expected, 1e-12);
            assert_true(quantile_of(&three, VOLUME, u) == 264e6 + got);
        }
        /* far below what a stream gives, where 1 - u is 1 */
        assert_close(quantile_of(&two, VOLUME, 1e-25),
                     gsl_cdf_weibull_Pinv(1e-25, two.scale, two.shape), 1e-12);
    }
}

/* Both sides round some twenty times by 2^-53, few of them at full weight: 5e-15.
 * GSL's normal quantile is AS 241 too, so its inverse, from erfc in long double, is asked as well:
 * an error of 1e-15 in z is one of z^2 1e-15 in u, |z| < 8.3. */
static void normal_quantile_is_gsl_and_inverts_erfc(void **state)
{
    for (int i = 0; i < PROBES; i++) {
        double rest, u = probe(i, &rest);
        double z = fracas_normal_quantile(fracas_probability_of(u));
        assert_close(z, u < 0.5 ? gsl_cdf_ugaussian_Pinv(u) : gsl_cdf_ugaussian_Qinv(rest), 5e-15);
        double tail = (double)(0.5L * erfcl(fabsl((long double)z) / sqrtl(2.0L)));
        assert_close(tail, u < 0.5 ? u : rest, 1e-13);
        if (1.0 - rest == u) assert_true(fracas_normal_quantile(fracas_probability_of(rest)) == -z);
    }
    assert_true(fracas_normal_quantile(fracas_probability_of(0.5)) == 0.0);
    assert_close(fracas_normal_quantile(fracas_probability_of(1e-300)),
                 gsl_cdf_ugaussian_Pinv(1e-300), 1e-12);
}

static void lognormal_is_gsl_in_both_tails(void **state)
{
    static const double sigmas[] = {0.01, 0.2, 1.0, 10.0};
    for (size_t k = 0; k < FRACAS_COUNT(sigmas); k++) {
        fracas_strength strength = STRENGTH("lognormal", .median = 300e6, .sigma = sigmas[k]);
        for (int i = 0; i < PROBES; i++) {
            double rest, u = probe(i, &rest);
            double expected = u < 0.5 ? gsl_cdf_lognormal_Pinv(u, log(300e6), sigmas[k])
                                      : gsl_cdf_lognormal_Qinv(rest, log(300e6), sigmas[k]);
            assert_close(quantile_of(&strength, VOLUME, u), expected, 1e-12);
        }
    }
}

static void uniform_and_constant(void **state)
{
    fracas_strength uniform = STRENGTH("uniform", .minimum = 100e6, .maximum = 350e6);
    fracas_strength constant = STRENGTH("constant", .value = 123e6);
    for (int i = 0; i < PROBES; i++) {
        double rest, u = probe(i, &rest);
        assert_close(quantile_of(&uniform, VOLUME, u), gsl_cdf_flat_Pinv(u, 100e6, 350e6), 1e-15);
        assert_true(quantile_of(&constant, VOLUME, u) == 123e6);
    }
    assert_true(mean_of_strength(&uniform, VOLUME) == 225e6);
    assert_true(mean_of_strength(&constant, VOLUME) == 123e6);
}

/* GSL's gamma function is good to 1e-14 relative up to x = 11. */
static void means_are_exact(void **state)
{
    for (double shape = 0.1; shape < 1000.0; shape *= 1.07) {
        fracas_strength weibull = STRENGTH("weibull", .minimum = 1e6, .scale = 50e6,
                                           .shape = shape);
        assert_close(mean_of_strength(&weibull, VOLUME),
                     1e6 + 50e6 * gsl_sf_gamma(1.0 + 1.0 / shape), 1e-14);
    }
    fracas_strength lognormal = STRENGTH("lognormal", .median = 300e6, .sigma = 0.7);
    assert_close(mean_of_strength(&lognormal, VOLUME), 300e6 * exp(0.245), 1e-15 * 2);
}

/* One distribution after another, as in the file. */
enum { EXAMPLES = 7 };

static const fracas_strength *example(size_t k)
{
    static fracas_strength strength[EXAMPLES];
    strength[0] = STRENGTH("weibull", .minimum = 264e6, .scale = 50e6, .shape = 2.0);
    strength[1] = STRENGTH("lognormal", .median = 300e6, .sigma = 0.3);
    strength[2] = STRENGTH("uniform", .minimum = 264e6, .maximum = 364e6);
    strength[3] = STRENGTH("constant", .value = 300e6);
    strength[4] = STRENGTH("normal", .mean = 300e6, .deviation = 120e6);
    strength[5] = STRENGTH("gamma", .shape = 9.0, .scale = 30e6);
    strength[6] = STRENGTH("flaws", .minimum = 100e6, .maximum = 400e6, .own = {1e9, 3.0});
    return &strength[k];
}

static const fracas_stream name = {.seed = 42,
                                   .purpose = FRACAS_PURPOSE_STRENGTH,
                                   .point = {0x0123456789abcdef, 0xfedcba9876543210},
                                   .replica = 7};

static void a_value_depends_on_its_name_alone(void **state)
{
    enum { N = 1000, STRIDE = 8, LANE = 3 };
    static double lanes[N * STRIDE], plain[N], volume[N];
    for (size_t i = 0; i < N; i++) volume[i] = VOLUME * (1.0 + 0.001 * (double)i);
    for (size_t k = 0; k < EXAMPLES; k++) {
        for (size_t i = 0; i < N * STRIDE; i++) lanes[i] = -1.0;
        assert_int_equal(sample_strengths(example(k), &name, N, volume, NULL, STRIDE, lanes + LANE),
                         FRACAS_OK);
        assert_int_equal(sample_strengths(example(k), &name, N, volume, NULL, 1, plain), FRACAS_OK);
        for (size_t call = 0; call < N; call++) {
            size_t i = call * 617 %
                       N; /* 617 and 1000 have no common factor: every interface once, shuffled */
            double alone = quantile_of(example(k), volume[i], fracas_stream_uniform(&name, i));
            assert_memory_equal(&alone, &plain[i], sizeof alone);
            assert_memory_equal(&alone, &lanes[i * STRIDE + LANE], sizeof alone);
            for (size_t lane = 0; lane < STRIDE; lane++)
                assert_true(lane == LANE || lanes[i * STRIDE + lane] == -1.0);
        }
        double subset[10];
        assert_int_equal(sample_strengths(example(k), &name, 10, volume, NULL, 1, subset),
                         FRACAS_OK);
        assert_memory_equal(subset, plain, sizeof subset);
    }
}

/* As in test_elementary.c: the bits of every study hang on these. */
static void bits_are_golden(void **state)
{
    static const struct {
        uint64_t checksum;
        double mean;
    } golden[EXAMPLES] = {
        {0x5e167cb714770ca5, 0x1.260753245cb99p+28}, {0x7d3c0e4b85b8cf5e, 0x1.2b455e5f8fd4dp+28},
        {0x90cbeadf2f98c448, 0x1.2b7428p+28},        {0xdaa6f1f12ad06343, 0x1.1e1a3p+28},
        {0x28a704d8e97bf53d, 0x1.201eebb0ef545p+28}, {0x39a730a6bb1f4b19, 0x1.017df8p+28},
        {0xff6be244f5929730, 0x1.24fcc2d9c0d26p+28},
    };
    static double strength[65536], volume[65536];
    for (size_t i = 0; i < 65536; i++) volume[i] = VOLUME;
    for (size_t k = 0; k < EXAMPLES; k++) {
        assert_int_equal(sample_strengths(example(k), &name, 65536, volume, NULL, 1, strength),
                         FRACAS_OK);
        uint64_t checksum = fracas_checksum_of(strength, sizeof strength);
        double mean = mean_of_strength(example(k), VOLUME);
        print_message("{0x%016" PRIx64 ", %a}\n", checksum, mean);
        assert_true(checksum == golden[k].checksum && mean == golden[k].mean);
    }
}

/* Strengths at the corners of what the tables allow are positive and finite. Of optional parameters
 * the first two are the law's own. */
static void corners_are_positive_and_finite(void **state)
{
    size_t checked = 0;
    for (size_t k = 0; k < fracas_strength_section.nkinds; k++) {
        const fracas_kind *distribution = fracas_strength_section.kinds[k];
        if (distribution->params[0].type == FRACAS_ATTACHMENT)
            continue; /* has no range: tests/unit/test_attachments.c */
        for (unsigned corner = 0; corner < 1u << distribution->nparams; corner++) {
            fracas_strength strength = {.distribution = distribution};
            for (size_t p = 0, optional = 0; p < distribution->nparams; p++) {
                const fracas_param *param = &distribution->params[p];
                optional += param->optional;
                if (param->optional && optional > 2) continue;
                double low = param->minimum_open ? 1e-3 : param->minimum;
                double high = isfinite(param->maximum) ? param->maximum : 1e12;
                fracas_param_set(param, &strength, corner >> p & 1u ? high : low);
            }
            if (fracas_strength_check(&strength)) continue;
            checked++;
            for (int i = 0; i < PROBES; i++) {
                double rest, sigma_c = quantile_of(&strength, VOLUME, probe(i, &rest));
                assert_true(sigma_c > 0.0 && isfinite(sigma_c));
            }
            double mean = mean_of_strength(&strength, VOLUME);
            assert_true(mean > 0.0 && isfinite(mean));
        }
    }
    assert_true(checked > 50);
}

static void check_names_both_bounds(void **state)
{
    for (size_t k = 0; k < EXAMPLES; k++) OK(fracas_strength_check(example(k)));
    fracas_strength swapped = STRENGTH("uniform", .minimum = 350e6, .maximum = 100e6);
    FAILS(fracas_strength_check(&swapped), FRACAS_USAGE, "strength.minimum is 350000000 Pa",
          "strength.maximum 100000000 Pa");
    swapped.minimum = swapped.maximum;
    assert_int_equal(fracas_strength_check(&swapped), FRACAS_USAGE);
}

/* ---- normal, cut off at 0 ---- */

/* Against erfc in long double, over both tails. Rounding: e^(-z^2/2) twice, the series and the
 * quotient. */
static void normal_tail_is_erfc(void **state)
{
    double largest = 0.0;
    for (int i = -38000; i <= 37500; i++) {
        double z = i / 1000.0 + 1e-5;
        long double exact = 0.5L * erfcl((long double)z / sqrtl(2.0L));
        largest = fmax(largest, (double)fabsl(fracas_normal_upper(z) / exact - 1.0L));
    }
    print_message("normal tail: largest error %.2g\n", largest);
    assert_true(largest < 2e-15);
    assert_true(fracas_normal_upper(0.0) == 0.5 && fracas_normal_upper(41.0) == 0.0 &&
                fracas_normal_upper(-41.0) == 1.0);
}

/* Where nothing is cut off (k = mean/deviation = 30), mean + deviation z with GSL's z. The error of
 * z, 1e-15 relative, counts at most |z|/(k + z) < 0.4 times. */
static void normal_far_from_zero_is_gsl(void **state)
{
    fracas_strength normal = STRENGTH("normal", .mean = 300e6, .deviation = 10e6);
    for (int i = 0; i < PROBES; i++) {
        double rest, u = probe(i, &rest);
        double z = u < 0.5 ? gsl_cdf_ugaussian_Pinv(u) : gsl_cdf_ugaussian_Qinv(rest);
        assert_close(quantile_of(&normal, VOLUME, u), 300e6 + 10e6 * z, 2e-15);
    }
    assert_true(mean_of_strength(&normal, VOLUME) == 300e6);
}

/* P(strength <= s) kept = integral over (0, s) of the density, by Gauss-Legendre in long double,
 * which does not cancel; above s = 3 deviations 1 - u from erfc. */
static long double normal_share(long double k, long double y, bool upper)
{
    if (upper) return 0.5L * erfcl((y - k) / sqrtl(2.0L));
    static const long double at[5] = {0.1488743389816312108848L, 0.4333953941292471907993L,
                                      0.6794095682990244062343L, 0.8650633666889845107321L,
                                      0.9739065285171717200780L};
    static const long double weight[5] = {0.2955242247147528701739L, 0.2692667193099963550912L,
                                          0.2190863625159820439955L, 0.1494513491505805931458L,
                                          0.0666713443086881375936L};
    enum { PANELS = 32 };
    long double sum = 0.0L, h = y / PANELS;
    for (int panel = 0; panel < PANELS; panel++)
        for (int i = 0; i < 10; i++) {
            long double t = ((long double)panel + 0.5L + (i % 2 ? 0.5L : -0.5L) * at[i / 2]) * h;
            sum += 0.5L * h * weight[i / 2] * expl(-0.5L * (t - k) * (t - k));
        }
    return sum / sqrtl(2.0L * acosl(-1.0L));
}

/* The inverse is inverted. A relative error e of s is one of s f/F e in u, f the density: that is
 * allowed for, and e is asserted below 2e-14; at u = 2^-54 and k = 0 s is 1e-16 deviations. */
static void normal_inverts_its_law_in_both_tails(void **state)
{
    static const double ks[] = {1e-6, 0.01, 0.3, 1.0, 2.5, 4.0, 8.0, 8.3, 9.0, 20.0};
    double largest = 0.0;
    for (size_t j = 0; j < FRACAS_COUNT(ks); j++) {
        fracas_strength normal = STRENGTH("normal", .mean = ks[j] * 50e6, .deviation = 50e6);
        long double k = (long double)normal.mean / 50e6L, kept = 0.5L * erfcl(-k / sqrtl(2.0L));
        double before = 0.0;
        for (int i = 0; i < PROBES; i++) {
            double rest, u = probe(i, &rest);
            bool upper = u > 0.5;
            long double y = (long double)quantile_of(&normal, VOLUME, u) / 50e6L;
            long double tail = (upper ? rest : u) * kept;
            long double density = expl(-0.5L * (y - k) * (y - k)) / sqrtl(2.0L * acosl(-1.0L));
            double error = (double)(fabsl(normal_share(k, y, upper) - tail) / (y * density));
            largest = fmax(largest, error);
            if (i == 0 || (i >= TAIL && i < TAIL + MIDDLE)) {
                assert_true(i == TAIL || (double)y > before);
                before = (double)y;
            }
        }
        long double mean = k + expl(-0.5L * k * k) / sqrtl(2.0L * acosl(-1.0L)) / kept;
        assert_close(mean_of_strength(&normal, VOLUME), (double)(50e6L * mean), 2e-15);
    }
    print_message("normal, cut off at 0: largest error %.2g\n", largest);
    assert_true(largest < 2e-14);
}

/* ---- gamma ---- */

/* P and Q of a Poisson law of mean x: for whole a, Q(a, x) = e^-x (1 + x + ... + x^(a-1)/(a-1)!),
 * all terms positive. */
static void incomplete_gamma_is_a_poisson_sum(void **state)
{
    static const int shapes[] = {1, 2, 5, 9, 10, 11, 40, 200, 999, 1000, 1001, 3000, 20000};
    double largest = 0.0;
    for (size_t j = 0; j < FRACAS_COUNT(shapes); j++) {
        int a = shapes[j];
        for (double z = -8.0; z <= 8.0; z += 0.25) {
            double x = a + z * sqrt(a), lower, upper;
            if (x <= 0.0) continue;
            fracas_incomplete_gamma(a, x, &lower, &upper);
            long double least = expl((long double)a * logl(x) - x -
                                     lgammal(a + 1.0L)); /* P(N = a) */
            long double below = 0.0L, above = 0.0L, term = least;
            for (int n = a; n < a + 40 + 40 * (int)sqrt(a); n++, term *= (long double)x / n)
                above += term; /* N >= a: P */
            term = least;
            for (int n = a; n > 0; n--) {
                term *= (long double)n / x;
                below += term; /* N < a: Q */
            }
            largest = fmax(largest, (double)fabsl(upper / below - 1.0L) * (z > 0.0 || upper < 0.5));
            largest = fmax(largest, (double)fabsl(lower / above - 1.0L) * (z < 0.0 || lower < 0.5));
            assert_close(lower + upper, 1.0, 1e-13);
        }
    }
    print_message("incomplete gamma: largest error %.2g\n", largest);
    assert_true(largest < 1e-13);
}

/* P or Q in long double by other means: the series whatever x is, all terms positive, and the
 * continued fraction from its far end. */
static long double gamma_tail(long double a, long double x, bool upper)
{
    long double front = expl(a * logl(x) - x - lgammal(a));
    if (upper && x > a + 1.0L) {
        long double fraction = 0.0L;
        for (int n = 20000; n > 0; n--)
            fraction = n * (n - a) / (x + 2.0L * n + 1.0L - a - fraction);
        return front / (x + 1.0L - a - fraction);
    }
    long double term = 1.0L / a, sum = term;
    for (long double n = a + 1.0L; term > 1e-22L * sum; n += 1.0L) {
        term *= x / n;
        sum += term;
    }
    return upper ? 1.0L - front * sum : front * sum;
}

/* The error of x is that of its tail over d(ln tail)/d(ln x). */
static void gamma_inverts_its_law_in_both_tails(void **state)
{
    static const double shapes[] = {0.1,   0.25, 0.5,  0.99,  1.0,   1.5,    2.0,    4.0, 9.0,
                                    9.999, 10.0, 37.3, 200.0, 999.0, 1001.0, 5000.0, 1e6};
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++) {
        const long double a = shapes[k];
        double largest = 0.0, before = 0.0;
        for (int i = 0;
             i<PROBES; i += shapes[k]> 900.0 && i >= TAIL && i < TAIL + MIDDLE ? 37 : 1) {
            double rest, u = probe(i, &rest),
                         x = fracas_incomplete_gamma_inverse(shapes[k], fracas_probability_of(u));
            bool upper = u > 0.5;
            long double tail = gamma_tail(a, x, upper), wanted = upper ? rest : u;
            long double slope = expl(a * logl(x) - x - lgammal(a)) / wanted;
            largest = fmax(largest, (double)(fabsl(tail / wanted - 1.0L) / slope));
            if (i > TAIL && i < TAIL + MIDDLE) assert_true(x > before);
            if (i >= TAIL) before = x;
        }
        print_message("gamma of shape %g: largest error %.2g\n", shapes[k], largest);
        assert_true(largest < 5e-14);
    }
}

/* GSL stops its own iteration at a step of 1e-10, and far out in the tails sometimes gives up. */
static void gamma_is_gsl_in_both_tails(void **state)
{
    static const double shapes[] = {0.1, 0.5, 1.0, 2.5, 9.0, 100.0, 1e4};
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    int compared = 0, asked = 0;
    for (size_t k = 0; k < FRACAS_COUNT(shapes); k++) {
        fracas_strength gamma = STRENGTH("gamma", .shape = shapes[k], .scale = 30e6);
        for (int i = 0; i < PROBES; i += 7) {
            double rest, u = probe(i, &rest);
            double expected = u < 0.5 ? gsl_cdf_gamma_Pinv(u, shapes[k], 30e6)
                                      : gsl_cdf_gamma_Qinv(rest, shapes[k], 30e6);
            asked++;
            if (!isfinite(expected)) continue;
            compared++;
            assert_close(quantile_of(&gamma, VOLUME, u), expected, 1e-9);
        }
        assert_close(mean_of_strength(&gamma, VOLUME), shapes[k] * 30e6, 1e-15);
    }
    gsl_set_error_handler(handler);
    print_message("gamma: %d of %d compared with GSL\n", compared, asked);
    assert_true(compared > 0.9 * asked);
    /* shape 1 is the exponential law, shape 1/2 the square of a normal variable */
    for (int i = 0; i < PROBES; i++) {
        double rest, u = probe(i, &rest);
        assert_close(fracas_incomplete_gamma_inverse(1.0, fracas_probability_of(u)),
                     i < TAIL ? -log1p(-u) : -log(rest), 2e-14);
        if (i > TAIL + MIDDLE) continue; /* u/2 + 1/2 is no double */
        double z = gsl_cdf_ugaussian_Qinv(0.5 * rest);
        if (u > 0.01)
            assert_close(fracas_incomplete_gamma_inverse(0.5, fracas_probability_of(u)),
                         0.5 * z * z, 1e-13);
    }
}

/* ---- flaws ---- */

static double share_weaker(const fracas_strength *flaws, double sigma_c)
{
    return pow((sigma_c - flaws->minimum) / (flaws->maximum - flaws->minimum), flaws->own[1]);
}

/* P(strength > s) = exp(-density volume F(s)): put in, 1 - u comes back; where s is the maximum,
 * the atom is left. The strength less a minimum of 100 MPa is rounded by 1e-16 of it, times the
 * exponent: 1e-12 covers both. */
static void flaws_invert_their_law(void **state)
{
    static const double exponents[] = {0.5, 1.0, 3.0, 20.0, 1000.0},
                        numbers[] = {1e-3, 0.7, 2.0, 30.0, 1e6};
    for (size_t e = 0; e < FRACAS_COUNT(exponents); e++)
        for (size_t m = 0; m < FRACAS_COUNT(numbers); m++)
            for (int i = 0; i < PROBES; i++) {
                fracas_strength flaws = STRENGTH("flaws", .maximum = 400e6,
                                                 .own = {numbers[m] / VOLUME, exponents[e]});
                double rest, u = probe(i, &rest), sigma_c = quantile_of(&flaws, VOLUME, u);
                double t = i < TAIL ? -log1p(-u) : -log(rest);
                if (t >= numbers[m] * (1.0 + 1e-15)) assert_true(sigma_c == 400e6);
                else assert_close(share_weaker(&flaws, sigma_c) * numbers[m], t, 1e-12);
                flaws.minimum = 100e6;
                double above = quantile_of(&flaws, VOLUME, u);
                assert_close(above, 100e6 + 0.75 * sigma_c, 1e-15);
            }
}

/* The weakest of n interfaces of volume V/n exceeds s with the probability of one of volume V: with
 * 1 - w = (1 - u)^n, u of the parts is w of the whole. The bound is that of ln(1 - u) n against
 * ln(1 - w), over the exponent. */
static void flaws_do_not_see_the_mesh(void **state)
{
    const fracas_strength *flaws = example(6);
    for (double n = 1.0; n < 2000.0; n *= 3.0)
        for (int i = 1; i < 1000; i++) {
            double w = i / 1000.0, u = -expm1(log1p(-w) / n);
            double part = quantile_of(flaws, VOLUME / n, u);
            assert_close(part, quantile_of(flaws, VOLUME, w), 1e-14);
        }
    /* n interfaces without a flaw are one without a flaw */
    double none = exp(-flaws->own[0] * VOLUME);
    assert_true(quantile_of(flaws, VOLUME, 1.0 - 0.999 * none) == 400e6);
    assert_true(quantile_of(flaws, VOLUME, 1.0 - 1.001 * none) < 400e6);
}

/* The mean is the integral of P(strength > s): minimum + range integral_0^1 exp(-mu x^p) dx, by
 * GSL's quadrature, which is asked for 1e-11. */
static double survival(double x, void *context)
{
    const double *mu_p = context;
    return 2.0 * x *
           exp(-mu_p[0] * pow(x * x, mu_p[1])); /* x^2 for x: smooth at 0 for an exponent of 1/2 */
}

static void flaws_mean_is_the_integral(void **state)
{
    gsl_integration_cquad_workspace *space = gsl_integration_cquad_workspace_alloc(1000);
    static const double exponents[] = {0.5, 1.0, 3.0, 20.0, 1000.0};
    static const double numbers[] = {1e-6, 0.1, 0.999, 1.0, 1.33, 1.34, 2.9, 3.1, 30.0, 1e4};
    for (size_t e = 0; e < FRACAS_COUNT(exponents); e++)
        for (size_t m = 0; m < FRACAS_COUNT(numbers); m++) {
            double mu_p[2] = {numbers[m], exponents[e]}, integral, error;
            gsl_function f = {survival, mu_p};
            assert_int_equal(
                gsl_integration_cquad(&f, 0.0, 1.0, 0.0, 1e-11, space, &integral, &error, NULL), 0);
            assert_close(fracas_stretched_exponential(numbers[m], exponents[e]), integral, 2e-11);
            fracas_strength flaws = STRENGTH("flaws", .minimum = 100e6, .maximum = 400e6,
                                             .own = {numbers[m] / VOLUME, exponents[e]});
            assert_close(mean_of_strength(&flaws, VOLUME), 100e6 + 300e6 * integral, 2e-11);
        }
    gsl_integration_cquad_workspace_free(space);
    for (double mu = 1e-3; mu < 1e6; mu *= 1.3) /* exponent 1: (1 - e^-mu)/mu */
        assert_close(fracas_stretched_exponential(mu, 1.0), -expm1(-mu) / mu, 1e-14);
    assert_true(fracas_stretched_exponential(1e-200, 0.5) ==
                1.0); /* mu^-2 is beyond the largest double */
    assert_close(fracas_stretched_exponential(1e30, 2.0), 0.5e-15 * sqrt(acos(-1.0)), 1e-14);
}

static void flaws_check_names_both_bounds(void **state)
{
    fracas_strength swapped = *example(6);
    swapped.minimum = 500e6;
    FAILS(fracas_strength_check(&swapped), FRACAS_USAGE,
          "strength.minimum is 500000000 Pa and strength.maximum 400000000 Pa",
          "the strength without a flaw, must be the larger");
}

TESTS(philox_gives_the_published_words, stream_is_the_published_first_word,
      weibull_is_gsl_in_both_tails, normal_quantile_is_gsl_and_inverts_erfc,
      lognormal_is_gsl_in_both_tails, uniform_and_constant, means_are_exact,
      a_value_depends_on_its_name_alone, bits_are_golden, corners_are_positive_and_finite,
      check_names_both_bounds, normal_tail_is_erfc, normal_far_from_zero_is_gsl,
      normal_inverts_its_law_in_both_tails, incomplete_gamma_is_a_poisson_sum,
      gamma_inverts_its_law_in_both_tails, gamma_is_gsl_in_both_tails, flaws_invert_their_law,
      flaws_do_not_see_the_mesh, flaws_mean_is_the_integral, flaws_check_names_both_bounds)
