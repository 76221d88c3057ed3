/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What follows from a point's parameters without a model. */
#include "engine/spec.h"

#include "base/elementary.h"
#define LANES 1 /* plain numbers */
#include "engine/cohesive/energy.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

double fracas_spec_length(const fracas_spec *spec)
{
    const fracas_geometry *geometry = &spec->geometry;
    if (geometry->shape == &fracas_shape_ring) return 2 * FRACAS_PI * geometry->radius;
    return geometry->shape == &fracas_shape_bar ? geometry->length : NAN;
}

double fracas_spec_strain_rate(const fracas_spec *spec)
{
    const fracas_loading *loading = &spec->loading;
    if (loading->type == &fracas_loading_imposed_rate || loading->type == &fracas_loading_expansion)
        return loading->rate;
    if (loading->type == &fracas_loading_initial_velocity)
        return loading->radial / spec->geometry.radius;
    if (loading->type == &fracas_loading_held_velocity && loading->direction == &fracas_axis_radial)
        return loading->velocity / spec->geometry.radius;
    return NAN;
}

double fracas_spec_fracture_energy(const fracas_spec *spec, double strength)
{
    return cohesive_energy(spec->cohesive.fracture_energy, spec->cohesive.critical_opening,
                           strength);
}
