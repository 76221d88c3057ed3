/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/estimate/scales.h"

#include <math.h>

/* (scaling-laws.1), (scaling-laws.2), (scaling-laws.3). */
fracas_scales fracas_scales_of(double young, double density, double strength,
                               double fracture_energy)
{
    double speed = sqrt(young / density);
    fracas_scales scales = {.modulus = NAN};
    scales.size = young * fracture_energy / (strength * strength);
    scales.time = scales.size / speed;
    scales.rate = speed * strength * strength * strength / (young * young * fracture_energy);
    return scales;
}

bool fracas_scales_same(const fracas_scales *a, const fracas_scales *b)
{
    const double round_off = 1e-9;
    return fabs(a->size - b->size) <= round_off * a->size &&
           fabs(a->rate - b->rate) <= round_off * a->rate;
}

/* (scaling-laws.17), (scaling-laws.18) */
double fracas_piece_strength_at(const fracas_piece_strength *of, double s)
{
    const double above = of->mean - of->least, pieces = s / of->size, n = of->specimens;
    return of->least + (isnan(of->exponent) ? above * (n + 1) / (n * pieces + 1)
                                            : above * pow(pieces, -1 / of->exponent));
}

/* True if log(s0) grows less than log(s). Strengths fall as s^(-1/m) at most. Uniform ones, of
 * range R: 2 R n < least (n + 1)^2 + R (n + 1) for all n. */
static bool is_unique(const fracas_piece_strength *of, double power)
{
    const double round_off = 1e-9;
    if (!isnan(of->exponent)) return of->exponent > power * (1 + round_off);
    return (of->mean - of->least) * (of->specimens + 1) < 8 * of->least;
}

/* (scaling-laws.19), by halving log(s/size) */
double fracas_piece_strength_find(const fracas_piece_strength *of, double young,
                                  double fracture_energy, bool opening)
{
    const double power = opening ? 1 : 2; /* s0 as strength^-power */
    double low = -200, high = 200;
    if (!(of->mean > of->least) || !(of->size > 0) || !is_unique(of, power)) return NAN;
    const double s0 = young * fracture_energy / (of->mean * of->mean);
    if (!isfinite(s0)) return NAN;
    while (high - low > 1e-14) {
        const double x = (low + high) / 2;
        if (x <= low || x >= high) break;
        const double strength = fracas_piece_strength_at(of, of->size * exp(x));
        const bool shorter = x < log(s0 / of->size) - power * log(strength / of->mean);
        *(shorter ? &low : &high) = x;
    }
    return low < -199 || high > 199 ? NAN : fracas_piece_strength_at(of, of->size * exp(low));
}

/* (scaling-laws.4): the kinetic energy of expansion of a fragment pays for its surface. */
static double grady(double e, double modulus)
{
    (void)modulus;
    return cbrt(24 / (e * e));
}

/* (scaling-laws.5): as Grady, with the elastic energy stored at failure. */
static double glenn_chudnovsky(double e, double modulus)
{
    (void)modulus;
    return 4 / e * sinh(asinh(1.5 * e) / 3);
}

/* (scaling-laws.6). */
static double zmr(double e, double modulus)
{
    (void)modulus;
    return 4.5 / (1 + 4.5 * cbrt(e * e));
}

/* (scaling-laws.7). */
static double zmr2(double e, double modulus)
{
    (void)modulus;
    double quarter = sqrt(sqrt(e));
    return 4.5 / (1 + 0.77 * quarter + 5.4 * quarter * quarter * quarter);
}

/* (scaling-laws.10): release waves of a rigid-plastic body stop the flaws in their reach. */
static double mott(double e, double modulus)
{
    return sqrt(2 * M_PI / modulus) / e;
}

const fracas_scaling_law fracas_scaling_laws[FRACAS_SCALING_LAWS] = {
    [FRACAS_LAW_ZMR] = {"zmr", "ZMR", zmr},
    [FRACAS_LAW_GRADY] = {"grady", "Grady", grady},
    [FRACAS_LAW_GLENN_CHUDNOVSKY] = {"glenn_chudnovsky", "GC", glenn_chudnovsky},
    [FRACAS_LAW_ZMR2] = {"zmr2", "ZMR-2", zmr2},
    [FRACAS_LAW_MOTT] = {"mott", "Mott", mott},
};

double fracas_scaling_law_at(fracas_scaling_law_id law, const fracas_scales *scales, double rate)
{
    return scales->size * fracas_scaling_laws[law].normalised(rate / scales->rate, scales->modulus);
}
