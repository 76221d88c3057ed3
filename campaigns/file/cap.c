/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/cap.h"

#include "base/elementary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Transits of a fragment of size L over those of the rule, and the fewest of a rule.
 * Bars at 2e3 to 1e5 /s, uniform and Weibull of moduli 3 and 10, had fragments of 0.85 to 1.7 L. */
#define BEYOND 6.0
#define FEWEST 20.0

/* By (scaling-laws.6) and (scaling-laws.10), of modulus M; NaN: it has none [m]. */
static double size_of(const fracas_spec *spec, double strength, double modulus)
{
    const double e = fracas_spec_normalised_rate(spec, strength),
                 zmr = 4.5 / (1 + 4.5 * fracas_pow(e, 2.0 / 3)),
                 mott = sqrt(2 * M_PI / modulus) / e,
                 scale = spec->material.young * fracas_spec_fracture_energy(spec, strength) /
                         (strength * strength);
    return fmin(scale * sqrt(zmr * fmax(zmr, mott)), fracas_spec_length(spec));
}

/* (settled.10) */
double fracas_point_cap(const fracas_point *point, fracas_extent extent)
{
    const fracas_spec *spec = &point->spec;
    const fracas_strength *strength = &point->strength;
    const fracas_extent given = {.volume = strength->reference_volume,
                                 .area = strength->reference_area};
    const bool sized = strength->reference_volume > 0 || strength->reference_area > 0;
    const double mean = fracas_strength_mean(strength, extent),
                 reference = sized ? fracas_strength_mean(strength, given) : mean,
                 young = spec->material.young, wave = sqrt(young / spec->material.density),
                 onset = fmax(mean, reference) / (young * fabs(fracas_spec_strain_rate(spec))),
                 size = size_of(spec, fmin(mean, reference),
                                fracas_strength_modulus(strength, extent));
    const double span = BEYOND * fmax(spec->time.transits, FEWEST) * size / wave,
                 cap = onset + span;
    double end = NAN;
    char digits[32];
    if (!isfinite(cap) || !(mean > 0)) return NAN;
    for (int n = 1; n < 16 && !(fabs(end - cap) <= span / 10); n++) {
        snprintf(digits, sizeof digits, "%.*e", n, cap);
        end = strtod(digits, NULL);
    }
    return end;
}
