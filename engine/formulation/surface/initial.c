/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Displacements and velocities with which a surface starts (docs/theory/initial.md). */
#include "engine/loading/initial.h"

#include "engine/formulation/surface/loads.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <string.h>

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

/* Stresses along x and y need a plane z = const; a strain along z does nothing there. */
static fracas_err check_flat(const fracas_model *model)
{
    const fracas_surface *surface = model->surface;
    const bool across = fabs(model->spec.initial.strain[2]) > 0; /* NaN: no */
    size_t n = 1;
    while (n < surface->nnodes &&
           fabs(surface->node[n][2] - surface->node[0][2]) <= 1e-9 * model->longest)
        n++;
    if (n == surface->nnodes && across)
        return fracas_fail(FRACAS_USAGE,
                           "initial.strain_z strains nothing: the body is flat, all "
                           "of it at z = %g m",
                           surface->node[0][2]);
    if (n < surface->nnodes && fracas_initial_has_stress(&model->spec.initial))
        return fracas_fail(FRACAS_USAGE,
                           "initial gives stresses along x and y, but the body is not flat: "
                           "z is %g m at one node and %g m at another: give strains instead",
                           surface->node[0][2], surface->node[n][2]);
    return FRACAS_OK;
}

/* Nodes in a plane of symmetry move along it, and stay in a plane. */
static fracas_err check_plane(const fracas_model *model, const fracas_surface_border *border,
                              const fracas_kind *kind, double (*first)[3])
{
    const fracas_surface_tables *t = model->plan;
    const fracas_surface *surface = model->surface;
    const fracas_initial_strain strain = fracas_initial_strain_of(&model->spec);
    unsigned components = 0;
    TRY(fracas_surface_hold_edge(model, border, kind, false, &components));
    for (size_t k = 0; k < 2; k++) {
        const double *x = surface->node[surface->element[border->element * surface->corners +
                                                         (border->edge + k) % 3]];
        double velocity[3], at[3];
        fracas_initial_velocity(&model->spec.initial, x, velocity);
        fracas_initial_displacement(&strain, x, at);
        if (isnan((*first)[0])) memcpy(*first, at, sizeof *first);
        for (int i = 0; i < t->body->dimension; i++) {
            if (!(components >> i & 1)) continue;
            if (velocity[i] > 0 || velocity[i] < 0)
                return fracas_fail(FRACAS_USAGE,
                                   "initial gives a plane of symmetry the velocity %g m/s along "
                                   "%c, across it: its mirror image would go the other way: take "
                                   "the whole body (geometry.part), or leave that edge free",
                                   velocity[i], "xyz"[i]);
            if (fabs(at[i] - (*first)[i]) > 1e-9 * fracas_initial_stress(&model->spec) /
                                                model->spec.material.young * model->longest)
                return fracas_fail(FRACAS_USAGE,
                                   "initial shears a plane of symmetry, along %c: its mirror image "
                                   "would be sheared the other way: take the whole body "
                                   "(geometry.part), or leave that edge free",
                                   "xyz"[i]);
        }
    }
    return FRACAS_OK;
}

static fracas_err check_planes(const fracas_model *model)
{
    const fracas_surface *surface = model->surface;
    for (int32_t tag = 0; tag < FRACAS_EDGES; tag++) {
        double first[3] = {NAN, NAN, NAN};
        for (size_t b = 0; b < surface->nborders; b++) {
            const fracas_surface_border *border = &surface->border[b];
            const fracas_kind *kind = fracas_surface_edge_kind(&model->spec, border->tag);
            if (border->tag == tag && fracas_edge_of(kind)->mirror)
                TRY(check_plane(model, border, kind, &first));
        }
    }
    return FRACAS_OK;
}

/* A half wave of fewer edges would be another one, or none, at the nodes. */
static fracas_err check_waves(const fracas_model *model)
{
    enum { EDGES = 2 };
    const fracas_initial *initial = &model->spec.initial;
    const double edge = model->element_size;
    for (int i = 0; i < 3; i++) {
        const double half = (initial->to[i] - initial->from[i]) / initial->half_waves[i];
        if (!(initial->half_waves[i] > 0) || half >= EDGES * edge) continue;
        return fracas_fail(
            FRACAS_USAGE,
            "half_waves_%c of initial is %g: a half wave is %.3g m long, and an edge "
            "of the mesh %.3g m: give it %d edges at least, by a finer mesh or fewer "
            "half waves",
            "xyz"[i], initial -> half_waves[i], half, edge, EDGES);
    }
    return FRACAS_OK;
}

fracas_err fracas_surface_check_initial(const fracas_model *model)
{
    const fracas_surface_tables *t = model->plan;
    TRY(check_flat(model));
    TRY(check_waves(model));
    TRY(check_planes(model));
    if (!fracas_initial_moves(&model->spec.initial)) return FRACAS_OK;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; i < fracas_surface_unknowns(t); i++)
            if (fracas_surface_initial_velocity(model, e, i) != 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "the velocity of initial moves no node: edges hold all of "
                                     "them, or none is within its limits: widen them");
}
