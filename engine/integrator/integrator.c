/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/integrator/integrator.h"

#include "engine/integrator/hulbert_chung.h"

#include <math.h>

static double central_difference_limit(const fracas_time *time)
{
    (void)time;
    return FRACAS_CENTRAL_DIFFERENCE_LIMIT;
}

const fracas_kind fracas_integrator_central_difference = {
    "central-difference", "leapfrog: second order, damps nothing",
    .traits = &(const fracas_integrator){.limit = central_difference_limit}};

/* (membrane.14), (membrane.15), (membrane.20), (membrane.21) */
fracas_hulbert_chung fracas_hulbert_chung_of(double r)
{
    const double alpha_m = (2 * r - 1) / (1 + r), cube = (1 - r) * (1 - r) * (1 - r);
    return (fracas_hulbert_chung){.alpha_m = alpha_m,
                                  .beta = (5 - 3 * r) / ((1 + r) * (1 + r) * (2 - r)),
                                  .gamma = 1.5 - alpha_m,
                                  .excess = cube / ((1 + r) * (1 + r) * (2 - r)),
                                  .damping = cube / ((1 + r) * (1 + r) * (1 + r)),
                                  .limit = sqrt(12 * (1 + r) * (2 - r) / (10 - 5 * r + r * r))};
}

static double hulbert_chung_limit(const fracas_time *time)
{
    return fracas_hulbert_chung_of(time->spectral_radius).limit;
}

const fracas_kind fracas_integrator_hulbert_chung = {
    "hulbert-chung", "explicit generalised alpha: second order, damps high frequencies",
    .traits = &(const fracas_integrator){.limit = hulbert_chung_limit, .accelerations = true}};

const fracas_kind fracas_mass_lumped = {
    "lumped", "diagonal; of quadratic triangles by the rule of Hinton, Rock and Zienkiewicz"};
const fracas_kind fracas_mass_consistent = {
    "consistent", "the integral of the shape functions' products, inverted element by element"};

bool fracas_mass_is_consistent(const fracas_time *time)
{
    return time->mass == &fracas_mass_consistent;
}
