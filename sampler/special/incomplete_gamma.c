/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Incomplete gamma functions: a series below x = a + 1, a continued fraction above, and for large
 * a, where both take some sqrt(a) terms, the uniform expansion of Temme (SIAM J. Math. Anal. 10,
 * 757-766, 1979; DLMF 8.12). */
#include "sampler/special/incomplete_gamma.h"

#include "base/elementary.h"
#include "sampler/special/normal.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static const double stirling_from = 10.0; /* a */
static const double temme_from = 1000.0, temme_mu = 0.3;

/* ((c[n-1] x + ...) x + c[1]) x + c[0] */
static double polynomial(const double *c, size_t n, double x)
{
    double sum = c[n - 1];
    for (size_t i = n - 1; i-- > 0;) sum = sum * x + c[i];
    return sum;
}

/* mu - ln(1 + mu), mu = x/a - 1, without cancellation: with s = mu/(2 + mu), ln(1 + mu) = 2 artanh
 * s, mu - 2 s = mu s. */
static double excess(double a, double x)
{
    static const double c[12] = {1.0 / 3.0,  1.0 / 5.0,  1.0 / 7.0,  1.0 / 9.0,
                                 1.0 / 11.0, 1.0 / 13.0, 1.0 / 15.0, 1.0 / 17.0,
                                 1.0 / 19.0, 1.0 / 21.0, 1.0 / 23.0, 1.0 / 25.0};
    double mu = (x - a) / a;
    if (fabs(mu) > temme_mu) return mu - fracas_log(x / a);
    double s = mu / (2.0 + mu);
    double z = s * s; /* at most 0.031: the first term left out is below 2^-60 of the sum */
    return s * (mu - 2.0 * z * polynomial(c, 12, z));
}

/* ln(Gamma(a) sqrt(a/(2 pi)) (e/a)^a), a >= 10: Stirling's series; the first term left out is below
 * 2^-60. */
static double stirling(double a)
{
    static const double c[8] = {1.0 / 12.0,   -1.0 / 360.0,      1.0 / 1260.0, -1.0 / 1680.0,
                                1.0 / 1188.0, -691.0 / 360360.0, 1.0 / 156.0,  -3617.0 / 122400.0};
    return polynomial(c, 8, 1.0 / (a * a)) / a;
}

/* (sampling.25) x^a e^-x / Gamma(a), x times the density. For large a as sqrt(a/(2 pi)) e^(-a
 * excess - stirling), since a ln x - x - ln Gamma(a) would cancel. */
static double weight(double a, double x)
{
    if (a >= stirling_from)
        return sqrt(a / (2 * FRACAS_PI)) * fracas_exp(-a * excess(a, x) - stirling(a));
    if (x > 1000.0) return 0.0;
    return a * (fracas_pow(x, a) * fracas_exp(-x) / fracas_gamma(1.0 + a));
}

/* 1 + x/(a + 1) + x^2/((a + 1)(a + 2)) + ... = a P/weight; all terms positive, at most 300 of them
 * for the a and x used here. */
static double series(double a, double x)
{
    double term = 1.0, sum = 1.0;
    for (double n = a + 1.0; term > 0x1p-56 * sum; n += 1.0) {
        term *= x / n;
        sum += term;
    }
    return sum;
}

/* (sampling.24) Q/weight, x >= a + 1: 1/(x + 1 - a - 1 (1 - a)/(x + 3 - a - 2 (2 - a)/(x + 5 - a -
 * ...))), from the front by the method of Lentz. */
static double fraction(double a, double x)
{
    double b = x + 1.0 - a;
    double d = 1.0 / b, c = INFINITY, value = d;
    for (double n = 1.0; n < 1e4; n += 1.0) {
        double numerator = -n * (n - a);
        b += 2.0;
        d = 1.0 / (numerator * d + b);
        c = b + numerator / c;
        double factor = c * d;
        value *= factor;
        if (fabs(factor - 1.0) < 0x1p-52) break;
    }
    return value;
}

/* (sampling.26) With eta^2/2 = mu - ln(1 + mu), mu = x/a - 1: Q = Q_normal(eta sqrt(a)) + e^(-a
 * eta^2/2)/sqrt(2 pi a) (C_0(eta) + C_1(eta)/a + ...). For abs(mu) <= 0.3 and a >= 1000 the
 * truncation error is below 3e-16 relative. */
static void uniform_expansion(double a, double x, double *lower, double *upper)
{
    static const double c0[16] = {
        -0x1.5555555555555p-2,  0x1.5555555555555p-4,   -0x1.e573ac901e574p-7,
        0x1.2f684bda12f68p-10,  0x1.71de3a556c734p-12,  -0x1.76e06fec7273bp-13,
        0x1.48c5892f7cd83p-15,  -0x1.255370652afc1p-19, -0x1.f1b22f594c6b5p-20,
        0x1.bd6d21e4b4109p-21,  -0x1.7b5f9a2d0465cp-23, 0x1.ccf5ceb7f0d9fp-28,
        0x1.6097d55c37c1cp-27,  -0x1.2d2197c7a2faap-28, 0x1.f6e66d24d5c8ap-31,
        -0x1.c0d9b6edf2b0bp-36,
    };
    static const double c1[12] = {
        -0x1.e573ac901e574p-10, -0x1.c71c71c71c71cp-9, 0x1.5ac056b015ac0p-9,
        -0x1.0394f6f09e723p-10, 0x1.af83440e53dbcp-13, -0x1.af83440e53dbcp-22,
        -0x1.2fa4ae89e5af0p-16, 0x1.00a9cabd6b83ep-17, -0x1.b0bdfcc629cbap-20,
        0x1.3f59230a8357cp-28,  0x1.280f2cde3f847p-23, -0x1.ee23d0cba8aeep-25,
    };
    static const double c2[8] = {
        0x1.0ee643b990ee6p-8,   -0x1.5f7268edab4c8p-9,  0x1.948b0fcd6e9e0p-11,
        0x1.0db20a88f4696p-19,  -0x1.c253efaa1a932p-14, 0x1.bbf43daf4fe53p-15,
        -0x1.ac2d05890f2c3p-17, 0x1.26154ae39151dp-25,
    };
    static const double c3[5] = {
        0x1.547d93b34e2b6p-11, 0x1.e13ce465fa859p-13,  -0x1.ebfb188b7ca00p-12,
        0x1.18b9b5bf2d984p-12, -0x1.3d2a3a29b5d9dp-14,
    };
    double half_square = excess(a, x);
    double eta = x < a ? -sqrt(2.0 * half_square) : sqrt(2.0 * half_square);
    double sum = polynomial(c3, 5, eta);
    sum = sum / a + polynomial(c2, 8, eta);
    sum = sum / a + polynomial(c1, 12, eta);
    sum = sum / a + polynomial(c0, 16, eta);
    double rest = fracas_exp(-a * half_square) / sqrt(2 * FRACAS_PI * a) * sum;
    double z = eta * sqrt(a);
    *lower = fracas_normal_upper(-z) - rest;
    *upper = fracas_normal_upper(z) + rest;
}

/* (sampling.23), (sampling.24) */
void fracas_incomplete_gamma(double a, double x, double *lower, double *upper)
{
    if (a >= temme_from && fabs(x - a) <= temme_mu * a) {
        uniform_expansion(a, x, lower, upper);
    } else if (x < a + 1.0) {
        *lower = weight(a, x) * series(a, x) / a;
        *upper = 1.0 - *lower;
    } else {
        *upper = weight(a, x) * fraction(a, x);
        *lower = 1.0 - *upper;
    }
}

/* ln of the weight, where it is no double. */
static double log_weight(double a, double x)
{
    if (a >= stirling_from)
        return 0.5 * fracas_log(a / (2 * FRACAS_PI)) - a * excess(a, x) - stirling(a);
    return a * fracas_log(x) - x - fracas_log(fracas_gamma(1.0 + a) / a);
}

/* (distributions.15) Newton on ln Q = ln w + ln fraction, nearly a straight line there; its slope
 * is -1/(x fraction). */
double fracas_incomplete_gamma_far(double a, double t)
{
    const double root = 1.0 - 1.0 / (9.0 * a) + fracas_normal_far(t) / (3.0 * sqrt(a));
    double x = a < stirling_from ? t : a * root * root * root;
    for (int i = 0; i < 50; i++) {
        const double rest = fraction(a, x),
                     step = (log_weight(a, x) + fracas_log(rest) + t) * x * rest;
        x += step;
        if (fabs(step) < 1e-9 * x) break; /* the next one would be below 1e-18 */
    }
    return x;
}

/* Where the search for x begins. Small a: P is near x^a/Gamma(a + 1) as long as x is small; else
 * Wilson and Hilferty, for whom (x/a)^(1/3) is normal. */
static double first_guess(double a, fracas_probability p)
{
    if (a < 1.0 || (a < stirling_from && p.below < 0.1))
        return fracas_exp(fracas_log(p.below * fracas_gamma(1.0 + a)) / a);
    double root = 1.0 - 1.0 / (9.0 * a) + fracas_normal_quantile(p) / (3.0 * sqrt(a));
    root = fmax(root, 0.05);
    return a * root * root * root;
}

/* (sampling.27) The zero of g(y) = ln P - ln u, or ln Q - ln(1 - u) in the upper half, in y = ln x.
 * g is concave, so Newton's steps cannot fail; close to the zero they are Halley's. */
double fracas_incomplete_gamma_inverse(double a, fracas_probability p)
{
    const double largest_step = 2.0;
    const bool low = p.below <= 0.5;
    if (p.above < 0x1p-60)
        return fracas_incomplete_gamma_far(a, -fracas_log(p.above)); /* beyond any stream */
    double x = first_guess(a, p);
    for (int i = 0; i < 50 && x > 0.0; i++) {
        double lower, upper;
        fracas_incomplete_gamma(a, x, &lower, &upper);
        double tail = low ? lower : upper;
        double slope = weight(a, x) / (low ? lower : -upper);
        double ratio = tail / (low ? p.below : p.above);
        double g = fracas_log(ratio);
        double step = -g / slope;
        double bend = 0.5 * step * (a - x - slope); /* g''/g' = a - x - g' */
        if (fabs(bend) < 0.5) step /= 1.0 + bend;
        step = fmax(-largest_step, fmin(step, largest_step));
        x *= fracas_exp(step);
        if (fabs(step) * (1.0 + sqrt(a)) < 1e-6) break; /* the next one would be below 1e-18 */
    }
    return x;
}

/* (sampling.22) The series for small mu, free of powers; beyond it P is near 1. */
double fracas_stretched_exponential(double mu, double p)
{
    double a = 1.0 / p;
    if (mu < a + 1.0) return fracas_exp(-mu) * series(a, mu);
    double lower, upper;
    fracas_incomplete_gamma(a, mu, &lower, &upper);
    return fracas_gamma(1.0 + a) * fracas_pow(mu, -a) * lower;
}
