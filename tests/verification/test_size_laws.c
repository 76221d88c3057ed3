/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Size laws against the table of docs/theory/scaling-laws.md, digit by digit as printed, and
 * against their limits. (Glenn-Chudnovsky at 1e3 /s is 1.99948.) */
#include "analysis/estimate/scales.h"

#include "tests/support/test.h"

static fracas_scales reference_scales(void)
{
    return fracas_scales_of(275e9, 2750, 300e6, 100);
}

static void assert_prints(const char *format, double value, const char *expected)
{
    char text[32];
    snprintf(text, sizeof text, format, value);
    assert_string_equal(text, expected);
}

static void scales_of_the_reference_material(void **state)
{
    fracas_scales scales = reference_scales();
    assert_prints("%.3f", scales.time * 1e9, "30.556");
    assert_prints("%.5f", scales.size * 1e3, "0.30556");
    assert_prints("%.1f", scales.rate, "35702.5");
    assert_true(isnan(fracas_scales_of(275e9, 2750, NAN, 100).size));
}

static void laws_as_printed(void **state)
{
    static const struct {
        double rate;
        const char *e, *e_format, *grady, *grady_format, *gc, *gc_format, *zmr, *zmr_format, *zmr2,
            *zmr2_format;
        const char *count, *count_format;
    } row[] = {
        {1e3, "0.02801", "%.5f", "31.28", "%.2f", "1.999", "%.3f", "3.180", "%.3f", "2.671", "%.3f",
         "51.5", "%.1f"},
        {1e4, "0.28009", "%.5f", "6.738", "%.3f", "1.951", "%.3f", "1.538", "%.3f", "1.237", "%.3f",
         "106.4", "%.1f"},
        {1e5, "2.8009", "%.4f", "1.452", "%.3f", "1.109", "%.3f", "0.4526", "%.4f", "0.3288",
         "%.4f", "361.5", "%.1f"},
        {1e6, "28.009", "%.3f", "0.3128", "%.4f", "0.2965", "%.4f", "0.1059", "%.4f", "0.0657",
         "%.4f", "1546", "%.0f"},
    };
    fracas_scales scales = reference_scales();
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        double e = row[i].rate / scales.rate;
        assert_prints(row[i].e_format, e, row[i].e);
        assert_prints(row[i].grady_format, fracas_scaling_laws[FRACAS_LAW_GRADY].normalised(e, NAN),
                      row[i].grady);
        assert_prints(row[i].gc_format,
                      fracas_scaling_laws[FRACAS_LAW_GLENN_CHUDNOVSKY].normalised(e, NAN),
                      row[i].gc);
        assert_prints(row[i].zmr_format, fracas_scaling_laws[FRACAS_LAW_ZMR].normalised(e, NAN),
                      row[i].zmr);
        assert_prints(row[i].zmr2_format, fracas_scaling_laws[FRACAS_LAW_ZMR2].normalised(e, NAN),
                      row[i].zmr2);
        double zmr_size = fracas_scaling_law_at(FRACAS_LAW_ZMR, &scales, row[i].rate);
        assert_prints(row[i].count_format, 50e-3 / zmr_size, row[i].count);
    }
}

/* The dimensional forms, written out: Grady's s = (24 Gc/(rho edot^2))^(1/3) and Glenn and
 * Chudnovsky's s = 4 sqrt(alpha/3) sinh(phi/3). A dozen roundings of 1.1e-16, a cube root and
 * sinh(asinh) amplify to below 1e-14. */
static void dimensional_forms(void **state)
{
    double young = 70e9, density = 2700, strength = 264e6, fracture_energy = 50;
    fracas_scales scales = fracas_scales_of(young, density, strength, fracture_energy);
    for (double rate = 1e2; rate < 2e6; rate *= 10) {
        double by_grady = cbrt(24 * fracture_energy / (density * rate * rate));
        assert_true(fabs(fracas_scaling_law_at(FRACAS_LAW_GRADY, &scales, rate) / by_grady - 1) <
                    1e-14);
        double alpha = 3 * strength * strength / (density * young * rate * rate);
        double beta = 3 * fracture_energy / (2 * density * rate * rate);
        double phi = asinh(beta * pow(3 / alpha, 1.5));
        double by_gc = 4 * sqrt(alpha / 3) * sinh(phi / 3);
        assert_true(fabs(fracas_scaling_law_at(FRACAS_LAW_GLENN_CHUDNOVSKY, &scales, rate) / by_gc -
                         1) < 1e-13);
    }
}

/* With x = 1.5 e, s/s0 = (4/e) sinh(asinh(x)/3) = 2 (1 - 4 x^2/27 + ...) as e -> 0: 2 to 6.7e-9 at
 * e = 1e-4. As e -> infinity sinh(asinh(x)/3) -> ((2x)^(1/3) - (2x)^(-1/3))/2, so GC/Grady -> 1 -
 * (3e)^(-2/3): 1 to 4.8e-7 at e = 1e9. ZMR -> 4.5 as e -> 0 and e^(-2/3) as e -> infinity; ZMR-2
 * -> 4.5 and (4.5/5.4) e^(-3/4). */
static void limits(void **state)
{
    double (*gc)(double, double) = fracas_scaling_laws[FRACAS_LAW_GLENN_CHUDNOVSKY].normalised;
    double (*grady)(double, double) = fracas_scaling_laws[FRACAS_LAW_GRADY].normalised;
    double (*zmr)(double, double) = fracas_scaling_laws[FRACAS_LAW_ZMR].normalised;
    double (*zmr2)(double, double) = fracas_scaling_laws[FRACAS_LAW_ZMR2].normalised;
    assert_true(fabs(gc(1e-4, NAN) - 2) < 1e-8);
    assert_true(fabs(gc(1e-4, NAN) - 2) > 1e-9);
    assert_true(fabs(gc(1e9, NAN) / grady(1e9, NAN) - 1) < 5e-7);
    assert_true(fabs(zmr(1e-12, NAN) / 4.5 - 1) < 5e-8);  /* 4.5 e^(2/3) = 4.5e-8 */
    assert_true(fabs(zmr(1e12, NAN) * 1e8 - 1) < 3e-9);   /* 1/(4.5 e^(2/3)) = 2.2e-9 */
    assert_true(fabs(zmr2(1e-24, NAN) / 4.5 - 1) < 1e-6); /* 0.77 e^(1/4) = 7.7e-7 */
    assert_true(fabs(zmr2(1e24, NAN) * 1e18 * 5.4 / 4.5 - 1) <
                1e-12); /* 0.77/5.4 e^(-1/2) = 1.4e-13 */
}

/* Mott's law as printed, and written out: s = sqrt(pi) sqrt(2 sigma_c/(rho gamma))/edot with gamma
 * = M E/sigma_c. Five roundings and two roots: 1e-14. */
static void mott(void **state)
{
    fracas_scales scales = reference_scales();
    assert_true(isnan(scales.modulus) &&
                isnan(fracas_scaling_law_at(FRACAS_LAW_MOTT, &scales, 1e4)));
    const struct {
        double modulus;
        const char *size;
    } row[] = {{10, "2.8300"}, {30, "1.6339"}};
    for (size_t i = 0; i < 2; i++) {
        scales.modulus = row[i].modulus;
        assert_prints("%.4f", fracas_scaling_law_at(FRACAS_LAW_MOTT, &scales, 1e4) / scales.size,
                      row[i].size);
        for (double rate = 1e2; rate < 2e6; rate *= 10) {
            double gamma = row[i].modulus * 275e9 / 300e6,
                   length = sqrt(2 * 300e6 / (2750 * gamma)) / rate;
            assert_true(
                fabs(fracas_scaling_law_at(FRACAS_LAW_MOTT, &scales, rate) / (sqrt(M_PI) * length) -
                     1) < 1e-14);
        }
    }
    scales.modulus = 10;
    assert_prints("%.2f", 50e-3 / fracas_scaling_law_at(FRACAS_LAW_MOTT, &scales, 1e4), "57.82");
}

/* Pieces s0 long. Weibull's, s = E Gc/sigma^2 and sigma = mean (h/s)^(1/m): sigma^(1 - 2/m) = mean
 * (h/(E Gc))^(1/m); with a critical opening Gc = G sigma/mean, and sigma^(1 - 1/m) = mean (h
 * mean/(E G))^(1/m). The others fulfil their equation, whatever the mesh: h becomes 2 h. Logarithms
 * of s are exact to 1e-14, strengths to 1e-13 with the powers of their definitions. */
static void strengths_of_pieces(void **state)
{
    const double E = 275e9, G = 100, h = 2e-5, small = 1e-13;
    for (double m = 2.5; m < 50; m *= 2) {
        fracas_piece_strength of = {300e6, 0, h, m, NAN};
        const double found = fracas_piece_strength_find(&of, E, G, false),
                     closed = pow(300e6 * pow(h / (E * G), 1 / m), m / (m - 2)),
                     opening = fracas_piece_strength_find(&of, E, G, true),
                     closed_opening = pow(300e6 * pow(h * 300e6 / (E * G), 1 / m), m / (m - 1));
        /* log(s) is off by 1e-14, amplified by m/(m - 2), here up to 5 */
        assert_true(fabs(found / closed - 1) < small && fabs(opening / closed_opening - 1) < small);
        of.least = 200e6;
        const double above = fracas_piece_strength_find(&of, E, G, false),
                     s0 = E * G / (above * above);
        assert_true(fabs(above / (200e6 + 100e6 * pow(h / s0, 1 / m)) - 1) < small);
        of.size = 2 * h;
        of.mean = 200e6 + 100e6 * pow(2, -1 / m);
        assert_true(fabs(fracas_piece_strength_find(&of, E, G, false) / above - 1) < small);
    }
    fracas_piece_strength uniform = {300e6, 200e6, h, NAN, 1}; /* 200 to 400 MPa */
    const double found = fracas_piece_strength_find(&uniform, E, G, false),
                 s0 = E * G / (found * found);
    assert_true(fabs(found / (200e6 + 200e6 / (s0 / h + 1)) - 1) < small);
    uniform = (fracas_piece_strength){200e6 + 200e6 / 3, 200e6, 2 * h, NAN, 2};
    assert_true(fabs(fracas_piece_strength_find(&uniform, E, G, false) / found - 1) < small);
    const fracas_piece_strength none[] = {
        {300e6, 0, h, 2, NAN},       /* as strong as it is long: any s0, or none */
        {300e6, 0, h, 1.5, NAN},     /* two */
        {300e6, 10e6, h, NAN, 1},    /* 10 to 590 MPa: may have three */
        {300e6, 0, h, NAN, NAN},     /* of no known form */
        {NAN, 0, h, 10, NAN},        /* of a file */
        {300e6, 0, NAN, 10, NAN},    /* of no mesh */
        {300e6, 300e6, h, 10, NAN}}; /* no scatter */
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_true(isnan(fracas_piece_strength_find(&none[i], E, G, false)));
    assert_true(isfinite(fracas_piece_strength_find(&none[0], E, G, true)));
}

TESTS(scales_of_the_reference_material, laws_as_printed, dimensional_forms, limits, mott,
      strengths_of_pieces)
