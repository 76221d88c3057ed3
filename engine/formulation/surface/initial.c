/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Displacements and velocities with which a surface starts (docs/theory/initial.md). */
#include "engine/loading/initial.h"

#include "engine/formulation/surface/surface.h"

#include <math.h>

double fracas_surface_initial_velocity(const fracas_model *model, size_t e, size_t i)
{
    const fracas_surface_tables *t = model->plan;
    const size_t dimension = (size_t)t->body->dimension;
    double velocity[3];
    if (t->held[e] >> i & 1) return 0;
    fracas_initial_velocity(&model->spec.initial,
                            fracas_surface_node(model->surface, e, i / dimension), velocity);
    return velocity[i % dimension];
}

double fracas_surface_initial_displacement(const fracas_model *model, size_t e, size_t i)
{
    const fracas_surface_tables *t = model->plan;
    const size_t dimension = (size_t)t->body->dimension;
    const fracas_initial_strain strain = fracas_initial_strain_of(&model->spec);
    double displacement[3];
    fracas_initial_displacement(&strain, fracas_surface_node(model->surface, e, i / dimension),
                                displacement);
    return displacement[i % dimension];
}

/* Stresses along x and y are those of a plane z = const. */
static fracas_err check_flat(const fracas_model *model)
{
    const fracas_surface *surface = model->surface;
    if (!fracas_initial_has_stress(&model->spec.initial)) return FRACAS_OK;
    for (size_t n = 1; n < surface->nnodes; n++)
        if (fabs(surface->node[n][2] - surface->node[0][2]) > 1e-9 * model->longest)
            return fracas_fail(FRACAS_USAGE,
                               "initial gives stresses along x and y, but the body is not flat: "
                               "z is %g m at one node and %g m at another: give strains instead",
                               surface->node[0][2], surface->node[n][2]);
    return FRACAS_OK;
}

fracas_err fracas_surface_check_initial(const fracas_model *model)
{
    const fracas_surface_tables *t = model->plan;
    TRY(check_flat(model));
    if (!fracas_initial_moves(&model->spec.initial)) return FRACAS_OK;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; i < fracas_surface_unknowns(t); i++)
            if (fracas_surface_initial_velocity(model, e, i) != 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "the velocity of initial moves no node: edges hold all of "
                                     "them, or none is within its limits: widen them");
}
