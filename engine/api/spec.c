/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values that follow from a point's parameters without a model. */
#include "engine/spec.h"

#include "engine/cohesive/law.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

double fracas_spec_length(const fracas_spec *spec)
{
    const fracas_shape *shape = fracas_shape_of(spec);
    return shape->length ? shape->length(&spec->geometry) : NAN;
}

double fracas_spec_strain_rate(const fracas_spec *spec)
{
    const fracas_loading_traits *loading = fracas_loading_traits_of(spec);
    return loading->rate ? loading->rate(spec) : NAN;
}

double fracas_spec_fracture_energy(const fracas_spec *spec, double strength)
{
    const fracas_cohesive *cohesive = &spec->cohesive;
    return cohesive->fracture_energy +
           fracas_law_fullness(cohesive) * (cohesive->critical_opening * strength);
}

/* (scaling-laws.3) */
double fracas_spec_normalised_rate(const fracas_spec *spec, double strength)
{
    const double young = spec->material.young, strain = strength / young;
    return fabs(fracas_spec_strain_rate(spec)) * fracas_spec_fracture_energy(spec, strength) /
           (sqrt(young / spec->material.density) * strain * strain * strength);
}

double fracas_spec_critical_opening(const fracas_spec *spec, double strength)
{
    return fracas_spec_fracture_energy(spec, strength) /
           (fracas_law_fullness(&spec->cohesive) * strength);
}
