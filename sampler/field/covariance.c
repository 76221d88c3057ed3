/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/field/covariance.h"

#include "base/elementary.h"
#include "sampler/distribution/distribution.h"
#include "sampler/special/bessel.h"

#include <math.h>
#include <stdlib.h>

#define USUAL_SMOOTHNESS 1.5

const fracas_kind fracas_covariance_exponential = {
    .name = "exponential", .doc = "exp(-d/l): rough, as matern of smoothness 1/2"};
const fracas_kind fracas_covariance_matern = {.name = "matern", .doc = "of any smoothness nu"};
const fracas_kind fracas_covariance_gaussian = {
    .name = "gaussian", .doc = "exp(-d^2/(2 l^2)): smoother than anything real"};

/* Pieces of a table in x = sqrt(2 nu) d/l: four in each octave from 2^LOWEST to 2^HIGHEST. */
enum { LOWEST = -40, HIGHEST = 10, PIECES = 4 * (HIGHEST - LOWEST), TERMS = 14 };

struct fracas_covariance {
    const fracas_kind *kind;
    double length;     /* m */
    double smoothness; /* nu */
    double factor;     /* 2^(1 - nu)/Gamma(nu) */
    int degree;        /* the polynomial's; -1: nu is no half-integer */
    double polynomial[10];
    double (*table)[TERMS]; /* [PIECES] Chebyshev coefficients of e^x rho; NULL for a polynomial */
};

fracas_err fracas_covariance_check(const fracas_strength *strength)
{
    if (!strength->covariance && strength->correlation_length > 0)
        return fracas_fail(FRACAS_USAGE, "`correlation_length` without a `covariance`: say which, "
                                         "exponential, matern or gaussian");
    if (strength->covariance != &fracas_covariance_matern && strength->smoothness > 0)
        return fracas_fail(FRACAS_USAGE, "`smoothness` is that of a matern covariance alone: leave "
                                         "it out, or say `covariance: matern`");
    if (!strength->covariance) return FRACAS_OK;
    if (!(strength->correlation_length > 0))
        return fracas_fail(FRACAS_USAGE,
                           "`covariance` without a `correlation_length`: give it, a length");
    if (fracas_strength_is_given(strength))
        return fracas_fail(FRACAS_USAGE,
                           "`covariance` is of strengths that are drawn, and those of distribution "
                           "`%s` are given: leave it out",
                           strength->distribution->name);
    if (strength->distribution == &fracas_constant.kind)
        return fracas_fail(
            FRACAS_USAGE,
            "`covariance` changes nothing where all strengths are the same, as those of "
            "distribution `constant`: leave it out, or choose another distribution");
    return FRACAS_OK;
}

/* e^x rho, of x = sqrt(2 nu) d/l. (fields.2) */
static double matern_scaled(const fracas_covariance *covariance, double x)
{
    const double nu = covariance->smoothness;
    return covariance->factor * fracas_pow(x, nu) * fracas_bessel_k_scaled(nu, x);
}

static double piece_start(int piece)
{
    return ldexp(1.0 + 0.25 * (piece & 3), LOWEST + piece / 4);
}

/* The coefficients from the values at the zeros of T_TERMS, t = cos(pi (i + 1/2)/TERMS). */
static void interpolate(const fracas_covariance *covariance, int piece, double coefficient[TERMS])
{
    const double low = piece_start(piece), high = piece_start(piece + 1);
    for (int k = 0; k < TERMS; k++) coefficient[k] = 0.0;
    for (int i = 0; i < TERMS; i++) {
        const double t = fracas_cospi((i + 0.5) / TERMS);
        const double value = matern_scaled(covariance, 0.5 * (low + high) + 0.5 * (high - low) * t);
        for (int k = 0; k < TERMS; k++)
            coefficient[k] += (k > 0 ? 2.0 : 1.0) / TERMS * value *
                              fracas_cospi(k * (i + 0.5) / TERMS);
    }
}

static double from_table(const fracas_covariance *covariance, double x)
{
    int exponent;
    const double mantissa = frexp(x, &exponent); /* [1/2, 1) */
    const int piece = 4 * (exponent - 1 - LOWEST) + (int)(8.0 * mantissa) - 4;
    const double low = piece_start(piece), high = piece_start(piece + 1),
                 t = (2.0 * x - low - high) / (high - low);
    const double *c = covariance->table[piece];
    double next = 0.0, after = 0.0;
    for (int k = TERMS - 1; k > 0; k--) {
        const double here = 2.0 * t * next - after + c[k];
        after = next;
        next = here;
    }
    return t * next - after + c[0];
}

/* (fields.3) */
static double half_integer(const fracas_covariance *covariance, double x)
{
    double sum = covariance->polynomial[covariance->degree];
    for (int j = covariance->degree - 1; j >= 0; j--) sum = sum * x + covariance->polynomial[j];
    return sum;
}

/* (fields.1), (fields.2) */
double fracas_covariance_at(const fracas_covariance *covariance, double distance)
{
    const double y = distance / covariance->length;
    if (!(y > 0.0)) return 1.0;
    if (covariance->kind == &fracas_covariance_exponential) return fracas_exp(-y);
    if (covariance->kind == &fracas_covariance_gaussian) return fracas_exp(-0.5 * y * y);
    const double x = sqrt(2.0 * covariance->smoothness) * y;
    if (x > 1000.0) return 0.0; /* below the smallest double */
    const double scaled = covariance->degree >= 0   ? half_integer(covariance, x)
                          : x >= ldexp(1.0, LOWEST) ? from_table(covariance, x)
                          : x >= 1e-20              ? matern_scaled(covariance, x)
                                                    : 1.0;
    return fmin(1.0, scaled * fracas_exp(-x));
}

static void make_polynomial(fracas_covariance *covariance, int degree)
{
    covariance->degree = degree;
    covariance->polynomial[0] = 1.0;
    for (int j = 0; j < degree; j++)
        covariance->polynomial[j + 1] = covariance->polynomial[j] * (2.0 * (degree - j)) /
                                        ((2.0 * degree - j) * (j + 1.0));
}

fracas_err fracas_covariance_create(const fracas_strength *strength, fracas_covariance **covariance)
{
    OWN(fracas_covariance) made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a covariance");
    const double nu = strength->smoothness > 0 ? strength->smoothness : USUAL_SMOOTHNESS;
    *made = (fracas_covariance){.kind = strength->covariance,
                                .length = strength->correlation_length,
                                .smoothness = nu,
                                .degree = -1};
    if (nu - 0.5 == floor(nu)) {
        make_polynomial(made, (int)nu);
    } else {
        made->factor = nu / fracas_gamma(nu + 1.0) * fracas_pow(2.0, 1.0 - nu);
        made->table = malloc(PIECES * sizeof *made->table);
        if (!made->table) return fracas_no_memory("a covariance");
        for (int piece = 0; piece < PIECES; piece++) interpolate(made, piece, made->table[piece]);
    }
    *covariance = made;
    made = NULL;
    return FRACAS_OK;
}

void fracas_covariance_destroy(fracas_covariance *covariance)
{
    if (!covariance) return;
    free(covariance->table);
    free(covariance);
}
