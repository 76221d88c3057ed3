/* SPDX-License-Identifier: GPL-3.0-or-later */
/* base/elementary: errors against long double, special values, and the bits themselves. */
#include "base/elementary.h"
#include "base/hash.h"
#include "tests/support/test.h"

#include <float.h>
#include <inttypes.h>

enum { POINTS = 200000 };

/* Weyl sequences: evenly spread words, the same everywhere; `which` names the sequence. */
static uint64_t word(uint64_t i, int which)
{
    static const uint64_t step[2] = {0x9e3779b97f4a7c15, 0xd1342543de82ef95};
    return (i + 1) * step[which];
}

static double between(double a, double b, uint64_t i, int which)
{
    return a + (b - a) * ((double)(word(i, which) >> 11) * 0x1p-53);
}

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Any positive finite double, every exponent equally likely, the subnormal ones too. */
static double any_positive(uint64_t i)
{
    uint64_t bits = 1 + word(i, 0) % (bits_of(INFINITY) - 1);
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Distance from the exact value in spacings of the doubles around it. */
static double ulps(double got, long double exact)
{
    if (!isfinite((double)exact)) return got == (double)exact ? 0.0 : INFINITY;
    int exponent;
    frexpl(exact, &exponent);
    if (exponent < DBL_MIN_EXP) exponent = DBL_MIN_EXP;
    return (double)(fabsl((long double)got - exact) * ldexpl(1.0L, DBL_MANT_DIG - exponent));
}

static void raise_to(double *largest, double value)
{
    if (!(value <= *largest)) *largest = value; /* a NaN is kept, and fails */
}

static void assert_below(const char *what, double error, double bound)
{
    print_message("%s: largest error %.3f ulp\n", what, error);
    assert_true(error < bound);
}

/* The bounds are those of elementary.h. The oracle's own error (below 2 ulp of long double) adds at
 * most 2^-10 ulp. */
static void log_is_within_one_ulp(void **state)
{
    double all = 0.0, middle = 0.0, near_one = 0.0;
    for (uint64_t i = 0; i < POINTS; i++) {
        double x = any_positive(i);
        raise_to(&all, ulps(fracas_log(x), logl(x)));
        x = between(0.5, 2.0, i, 0);
        raise_to(&middle, ulps(fracas_log(x), logl(x)));
        x = 1.0 + ldexp(between(-0.5, 0.5, i, 0), -(int)(i % 53));
        raise_to(&near_one, ulps(fracas_log(x), logl(x)));
    }
    assert_below("log, all exponents", all, 1.0);
    assert_below("log in [1/2, 2]", middle, 1.0);
    assert_below("log near 1", near_one, 1.0);
}

static void exp_is_within_one_ulp(void **state)
{
    double all = 0.0, middle = 0.0, small = 0.0;
    for (uint64_t i = 0; i < POINTS; i++) {
        double x = between(-746.0, 710.0, i, 0);
        raise_to(&all, ulps(fracas_exp(x), expl(x)));
        x = between(-1.0, 1.0, i, 0);
        raise_to(&middle, ulps(fracas_exp(x), expl(x)));
        x = ldexp(between(-0.5, 0.5, i, 0), -(int)(i % 60));
        raise_to(&small, ulps(fracas_exp(x), expl(x)));
    }
    assert_below("exp, whole range", all, 1.0);
    assert_below("exp in [-1, 1]", middle, 1.0);
    /* e^x > 0.7, so 1 ulp >= 2^-53; the last sum rounds by 1/2 ulp, r^2 P(r) < 0.061 is rounded
     * four times by 2^-58 or less, and r is kept in two doubles: below 0.66. */
    assert_below("exp near 0", small, 0.66);
}

/* The bounds of elementary.h; near 0 and around the three seams of expm1. */
static void expm1_and_log1p_are_exact_near_zero(void **state)
{
    double below = 0.0, above = 0.0, small = 0.0, seams = 0.0, log_all = 0.0, log_small = 0.0;
    for (uint64_t i = 0; i < POINTS; i++) {
        double x = between(-40.0, 0.0, i, 0);
        raise_to(&below, ulps(fracas_expm1(x), expm1l(x)));
        x = between(0.0, 710.0, i, 0);
        raise_to(&above, ulps(fracas_expm1(x), expm1l(x)));
        x = between(0.3, 0.75, i, 0);
        raise_to(&seams, ulps(fracas_expm1(x), expm1l(x)));
        raise_to(&below, ulps(fracas_expm1(-x), expm1l(-x)));
        x = ldexp(between(-0.34, 0.34, i, 0), -(int)(i % 1000));
        raise_to(&small, ulps(fracas_expm1(x), expm1l(x)));
        raise_to(&log_small, ulps(fracas_log1p(x), log1pl(x)));
        x = any_positive(i);
        raise_to(&log_all, ulps(fracas_log1p(x), log1pl(x)));
        raise_to(&log_all,
                 ulps(fracas_log1p(-between(0.0, 1.0, i, 0)), log1pl(-between(0.0, 1.0, i, 0))));
    }
    assert_below("expm1 below 0", below, 3.0);
    assert_below("expm1 above 0", above, 3.0);
    assert_below("expm1 in [0.3, 0.75]", seams, 3.0);
    assert_below("expm1 near 0", small, 1.0);
    assert_below("log1p", log_all, 2.0);
    assert_below("log1p near 0", log_small, 2.0);
    assert_true(fracas_expm1(0.0) == 0.0 && fracas_expm1(-INFINITY) == -1.0 &&
                fracas_expm1(INFINITY) == INFINITY);
    assert_true(isnan(fracas_expm1(NAN)));
    assert_true(fracas_log1p(0.0) == 0.0 && fracas_log1p(-1.0) == -INFINITY &&
                fracas_log1p(INFINITY) == INFINITY);
    assert_true(isnan(fracas_log1p(-1.5)) && isnan(fracas_log1p(NAN)));
}

static void pow_is_within_two_ulp(void **state)
{
    double all = 0.0, near_one = 0.0, usual = 0.0;
    for (uint64_t i = 0; i < POINTS; i++) {
        double x = any_positive(i);
        double y = between(-745.0, 710.0, i, 1) / log(x);
        raise_to(&all, ulps(fracas_pow(x, y), powl(x, y)));
        x = between(0.6, 1.6, i, 0);
        y = between(-745.0, 710.0, i, 1) / log(x);
        raise_to(&near_one, ulps(fracas_pow(x, y), powl(x, y)));
        x = any_positive(i);
        y = between(-100.0, 100.0, i, 1) / log(x);
        raise_to(&usual, ulps(fracas_pow(x, y), powl(x, y)));
    }
    assert_below("pow, whole range of results", all, 2.0);
    assert_below("pow of x near 1, whole range of results", near_one, 2.0);
    assert_below("pow, |y ln x| < 100", usual, 1.0);
}

static void gamma_is_within_x_ulp(void **state)
{
    double low = 0.0, all = 0.0;
    for (uint64_t i = 0; i < POINTS; i++) {
        double x = between(1.0, 2.0, i, 0);
        raise_to(&low, ulps(fracas_gamma(x), tgammal(x)));
        x = between(2.0, 171.0, i, 0);
        raise_to(&all, ulps(fracas_gamma(x), tgammal(x)) / x);
    }
    assert_below("gamma in [1, 2]", low, 1.5);
    assert_below("gamma in [2, 171], over x", all, 1.0);
    assert_true(isfinite(fracas_gamma(171.0)));
}

/* sin(pi r), cos(pi r) for a double |r| <= 1/4: long double rounds pi r by 2^-64 relative, twice,
 * which moves either function by less than 2^-9 ulp of double. */
static const long double pi_l = 3.14159265358979323846264338327950288L;

static long double sinpi_l(double x)
{
    double n = rint(2.0 * x), r = x - 0.5 * n; /* exact */
    long double s = sinl(pi_l * (long double)r), c = cosl(pi_l * (long double)r);
    int quadrant = (int)(fmod(n, 4.0) + 4.0) % 4;
    return quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
}

static long double cospi_l(double x)
{
    double n = rint(2.0 * x), r = x - 0.5 * n;
    long double s = sinl(pi_l * (long double)r), c = cosl(pi_l * (long double)r);
    int quadrant = (int)(fmod(n, 4.0) + 4.0) % 4;
    return quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
}

static void sinpi_and_cospi_are_within_one_ulp(void **state)
{
    double sine = 0.0, cosine = 0.0;
    for (uint64_t i = 0; i < POINTS; i++) {
        double tiny = fmin(any_positive(i), 0x1p52), scale = ldexp(1.0, (int)(i % 54) - 1);
        const double x[4] = {
            between(-0.25, 0.25, i, 0),           /* the polynomials themselves */
            tiny,                                 /* every exponent, subnormal results too */
            between(-scale, scale, i, 0),         /* all sizes up to 2^52, spread within each */
            floor(scale) * 0.5 + ldexp(tiny, -3), /* close above zeros, where the result is small */
        };
        for (int k = 0; k < 4; k++) {
            raise_to(&sine, ulps(fracas_sinpi(x[k]), sinpi_l(x[k])));
            raise_to(&cosine, ulps(fracas_cospi(x[k]), cospi_l(x[k])));
        }
    }
    assert_below("sinpi", sine, 1.0);
    assert_below("cospi", cosine, 1.0);
}

/* Whole and half arguments over the whole range, and both signs. */
static void sinpi_and_cospi_are_exact_at_halves(void **state)
{
    for (uint64_t i = 0; i < POINTS; i++) {
        double n = i < 1000 ? (double)i - 500.0
                            : floor(ldexp(between(-1.0, 1.0, i, 0), (int)(i % 53)));
        double odd = fmod(fabs(n), 2.0);
        assert_true(fracas_sinpi(n) == 0.0 && fracas_cospi(n) == 1.0 - 2.0 * odd);
        if (fabs(n) >= 0x1p51) continue; /* n + 1/2 is no double */
        assert_true(fracas_sinpi(n + 0.5) == 1.0 - 2.0 * odd && fracas_cospi(n + 0.5) == 0.0);
        double x = between(-300.0, 300.0, i, 1);
        assert_true(fracas_sinpi(-x) == -fracas_sinpi(x) && fracas_cospi(-x) == fracas_cospi(x));
    }
    assert_true(fracas_sinpi(0x1p52) == 0.0 && fracas_cospi(0x1p52) == 1.0 &&
                fracas_cospi(-0x1p52) == 1.0);
    assert_true(fracas_sinpi(0x1p52 - 0.5) == -1.0 && fracas_cospi(0x1p52 - 1.0) == -1.0);
    assert_true(isnan(fracas_sinpi(0x1.0000000000001p52)) && isnan(fracas_cospi(-INFINITY)));
    assert_true(isnan(fracas_sinpi(NAN)) && isnan(fracas_cospi(NAN)));
}

static void special_values(void **state)
{
    assert_true(fracas_log(0.0) == -INFINITY && fracas_log(-0.0) == -INFINITY);
    assert_true(fracas_log(INFINITY) == INFINITY && fracas_log(1.0) == 0.0);
    assert_true(isnan(fracas_log(-1.0)) && isnan(fracas_log(-INFINITY)) && isnan(fracas_log(NAN)));
    assert_true(fracas_exp(0.0) == 1.0 && fracas_exp(-0.0) == 1.0 &&
                fracas_exp(DBL_TRUE_MIN) == 1.0);
    assert_true(fracas_exp(INFINITY) == INFINITY && fracas_exp(DBL_MAX) == INFINITY &&
                fracas_exp(709.79) == INFINITY);
    assert_true(fracas_exp(-INFINITY) == 0.0 && fracas_exp(-DBL_MAX) == 0.0 &&
                fracas_exp(-745.14) == 0.0);
    assert_true(isnan(fracas_exp(NAN)));
    assert_true(isfinite(fracas_exp(709.78)) && fracas_exp(-745.13) == DBL_TRUE_MIN);
    assert_true(fracas_pow(NAN, 0.0) == 1.0 && fracas_pow(0.0, 0.0) == 1.0 &&
                fracas_pow(1.0, NAN) == 1.0);
    assert_true(fracas_pow(0.0, 2.0) == 0.0 && fracas_pow(0.0, -2.0) == INFINITY);
    assert_true(fracas_pow(INFINITY, 2.0) == INFINITY && fracas_pow(INFINITY, -2.0) == 0.0);
    assert_true(fracas_pow(0.5, INFINITY) == 0.0 && fracas_pow(2.0, INFINITY) == INFINITY);
    assert_true(fracas_pow(0.5, -DBL_MAX) == INFINITY && fracas_pow(2.0, -DBL_MAX) == 0.0);
    assert_true(fracas_pow(2.0, DBL_TRUE_MIN) == 1.0);
    assert_true(isnan(fracas_pow(-1.0, 2.0)) && isnan(fracas_pow(NAN, 1.0)) &&
                isnan(fracas_pow(2.0, NAN)));
    assert_true(isnan(fracas_gamma(0.999)) && isnan(fracas_gamma(171.5)) &&
                isnan(fracas_gamma(NAN)));
    assert_true(fracas_gamma(1.0) == 1.0 && fracas_gamma(2.0) == 1.0);
}

/* A result that is a double is found exactly when the error before the last rounding is below 1/2
 * ulp. */
static void powers_of_two_are_exact(void **state)
{
    for (int k = -1074; k <= 1023; k++) assert_true(fracas_pow(2.0, k) == ldexp(1.0, k));
}

/* Another compiler, CPU or edit that changes one bit is noticed here. To change the functions on
 * purpose, first see that the errors above hold, then put in the values that this test prints. */
static void bits_are_golden(void **state)
{
    static double value[8][65536];
    for (uint64_t i = 0; i < 65536; i++) {
        value[0][i] = fracas_log(any_positive(i));
        value[1][i] = fracas_exp(between(-746.0, 710.0, i, 0));
        value[2][i] = fracas_pow(between(0.0, 4.0, i, 0), between(-500.0, 500.0, i, 1));
        value[3][i] = fracas_gamma(between(1.0, 171.0, i, 0));
        value[4][i] = fracas_sinpi(between(-100.0, 100.0, i, 0));
        value[5][i] = fracas_cospi(between(-100.0, 100.0, i, 0));
        value[6][i] = fracas_expm1(between(-2.0, 2.0, i, 0));
        value[7][i] = fracas_log1p(between(-1.0, 1.0, i, 0));
    }
    static const uint64_t golden[8] = {
        0xbfdf2083b4417ad9, 0x8336a488abcb45d6, 0xc2b74ed1d3919bda, 0xcafa3d684bb9a879,
        0xf59206dd7560170a, 0x89522cf0e139ff2b, 0x8faa0994163ef5ce, 0xa15edca7c2293ada,
    };
    uint64_t got[8];
    for (int function = 0; function < 8; function++) {
        got[function] = fracas_checksum_of(value[function], sizeof value[function]);
        print_message("0x%016" PRIx64 "\n", got[function]);
    }
    assert_memory_equal(got, golden, sizeof got);
}

int fracas_test(void)
{
    if (LDBL_MANT_DIG < 64) {
        puts("long double is no wider than double here: no oracle");
        return EXIT_FAILURE;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(log_is_within_one_ulp),
        cmocka_unit_test(exp_is_within_one_ulp),
        cmocka_unit_test(expm1_and_log1p_are_exact_near_zero),
        cmocka_unit_test(pow_is_within_two_ulp),
        cmocka_unit_test(gamma_is_within_x_ulp),
        cmocka_unit_test(sinpi_and_cospi_are_within_one_ulp),
        cmocka_unit_test(sinpi_and_cospi_are_exact_at_halves),
        cmocka_unit_test(special_values),
        cmocka_unit_test(powers_of_two_are_exact),
        cmocka_unit_test(bits_are_golden),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
