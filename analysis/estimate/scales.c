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
