/* SPDX-License-Identifier: GPL-3.0-or-later */
/* base/elementary_lanes.h: the bits of the scalar functions, for every argument, on every
 * instruction set of this CPU. */
#include "base/elementary.h"
#include "base/isa.h"
#include "tests/support/elementary_lanes.h"
#include "tests/support/test.h"

#include <float.h>

enum { N = 1 << 20 };
static double x[N] __attribute__((aligned(64))), y[N] __attribute__((aligned(64)));

static uint64_t word(uint64_t i)
{
    return (i + 1) * 0x9e3779b97f4a7c15;
}

static double between(double a, double b, uint64_t i)
{
    return a + (b - a) * ((double)(word(i) >> 11) * 0x1p-53);
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

FRACAS_KERNEL_TABLE(const elementary_unit, elementary);

/* Bits, not values: 0 and -0, and every NaN, differ. `is_log`: of the logarithm; else of exp. */
static void assert_same_bits(double (*scalar)(double), bool is_log)
{
    for (fracas_isa isa = FRACAS_ISA_BASELINE; isa < FRACAS_NISAS; isa++) {
        fracas_isa had;
        if (fracas_isa_choose(isa, &had)) {
            print_message("[  skipped ] this CPU has no %s\n", fracas_isa_name[isa]);
            continue;
        }
        for (int lanes = fracas_isa_lanes(isa, FRACAS_LANES_MAX); lanes > 0;
             lanes = fracas_isa_lanes(isa, lanes - 1)) {
            const elementary_unit *unit = elementary[isa][lanes];
            (is_log ? unit->log : unit->exp)(N, x, y);
            for (size_t i = 0; i < N; i++) {
                const double expected = scalar(x[i]);
                if (memcmp(&expected, &y[i], sizeof expected) != 0)
                    fail_msg("%s(%a), %s, %d lanes: %a, the scalar function has %a",
                             is_log ? "log" : "exp", x[i], fracas_isa_name[isa], lanes, y[i],
                             expected);
            }
        }
    }
}

/* A value and its neighbours, each in every lane among usual ones. */
static void fill_special(double usual)
{
    const double special[] = {0.0,
                              -0.0,
                              INFINITY,
                              -INFINITY,
                              NAN,
                              -NAN,
                              0x1p-1074,
                              DBL_MIN,
                              DBL_MAX,
                              -DBL_MAX,
                              1.0,
                              -1.0,
                              0x1p-537,
                              M_SQRT1_2,
                              M_SQRT2,
                              708.0,
                              -708.0,
                              709.0,
                              -708.4,
                              709.782712893384,
                              710.0,
                              -745.133219101941,
                              -746.0,
                              1e300,
                              0.34657359027997264};
    enum { SPECIAL = sizeof special / sizeof *special };
    for (size_t i = 0; i < N; i++) x[i] = usual;
    for (size_t s = 0; s < SPECIAL; s++)
        for (size_t lane = 0; lane < 8; lane++) {
            double *at = &x[(8 * s + lane) * 24 + lane];
            at[0] = special[s];
            at[8] = nextafter(special[s], INFINITY);
            at[16] = nextafter(special[s], -INFINITY);
        }
}

static void log_has_the_same_bits(void **state)
{
    for (size_t i = 0; i < N; i++)
        x[i] = double_of(1 + word(i) %
                                 0x7fefffffffffffff); /* all exponents, subnormal ones among them */
    assert_same_bits(fracas_log, true);
    for (size_t i = 0; i < N; i++)
        x[i] = double_of(0x0010000000000000 + word(i) % 0x7fdfffffffffffff); /* normal ones */
    assert_same_bits(fracas_log, true);
    for (size_t i = 0; i < N; i++) x[i] = 1.0 + ldexp(between(-0.5, 0.5, i), -(int)(i % 53));
    assert_same_bits(fracas_log, true);
    for (size_t i = 0; i < N; i++) /* near 2^k sqrt(1/2), on both sides: k turns */
        x[i] = double_of(0x0016a09e667f3bcd + (i % 2045 << 52) +
                         (uint64_t)((int64_t)word(i) >> (16 + i % 48)));
    assert_same_bits(fracas_log, true);
    for (size_t i = 0; i < N; i++) x[i] = double_of(word(i)); /* any bits */
    assert_same_bits(fracas_log, true);
    fill_special(2.0);
    assert_same_bits(fracas_log, true);
}

static void exp_has_the_same_bits(void **state)
{
    for (size_t i = 0; i < N; i++) x[i] = between(-750.0, 712.0, i);
    assert_same_bits(fracas_exp, false);
    for (size_t i = 0; i < N; i++) x[i] = between(-708.0, 708.0, i); /* usual ones */
    assert_same_bits(fracas_exp, false);
    for (size_t i = 0; i < N; i++) x[i] = ldexp(between(-0.5, 0.5, i), -(int)(i % 60));
    assert_same_bits(fracas_exp, false);
    const double ln_2 = 0x1.62e42fefa39efp-1;
    for (size_t i = 0; i < N; i++) /* near (j + 1/2) ln 2: k turns */
        x[i] = ((double)(i % 2000) - 1000.5) * ln_2 + ldexp(between(-0.5, 0.5, i), -(int)(i % 50));
    assert_same_bits(fracas_exp, false);
    for (size_t i = 0; i < N; i++) x[i] = double_of(word(i));
    assert_same_bits(fracas_exp, false);
    fill_special(2.0);
    assert_same_bits(fracas_exp, false);
}

TESTS(log_has_the_same_bits, exp_has_the_same_bits)
