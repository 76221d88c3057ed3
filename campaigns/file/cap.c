/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/cap.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* By 6 K crossings of a fragment of that size, those of scattered strengths, up to three times as
 * large, have been crossed 2 K times. */
#define BEYOND 6.0

/* Strength that the load has to reach [Pa]. */
static double strength_of(const fracas_strength *strength)
{
    const fracas_extent reference = {.volume = strength->reference_volume,
                                     .area = strength->reference_area};
    return fracas_strength_mean(strength, reference);
}

/* (settled.10) */
double fracas_point_cap(const fracas_point *point)
{
    const fracas_spec *spec = &point->spec;
    const double young = spec->material.young, rate = fabs(fracas_spec_strain_rate(spec)),
                 strength = strength_of(&point->strength), strain = strength / young,
                 wave = sqrt(young / spec->material.density);
    const double scale = fracas_spec_fracture_energy(spec, strength) / (strain * strength),
                 e = rate * scale / (wave * strain), size = scale * 4.5 / (1 + 4.5 * cbrt(e * e));
    const double cap = strain / rate + BEYOND * spec->time.transits * size / wave;
    char digits[32];
    snprintf(digits, sizeof digits, "%.1e", cap);
    return isfinite(cap) && cap > 0 ? strtod(digits, NULL) : NAN;
}
