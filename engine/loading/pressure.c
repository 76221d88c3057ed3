/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `pressure`: along the normal of the mid-surface, on every unit of its area. */
#include "engine/loading/load.h"

#include <math.h>

enum { PRESSURE };

static const fracas_param params[] = {
    {"pressure", FRACAS_REAL, "Pa",
     "pressure, times its amplitude, along the normal of the mid-surface: outward of spheres and "
     "cylinders, of mesh files to the side from which most triangles are counter-clockwise; "
     "negative: against it",
     FRACAS_REQUIRED, -INFINITY, INFINITY, false, offsetof(fracas_loading, own[PRESSURE])},
    FRACAS_LOAD_SPOT,
    FRACAS_LOAD_AMPLITUDE,
};

static void density(const fracas_spec *spec, const fracas_loading *loading, const fracas_place *at,
                    double density[3])
{
    (void)spec;
    for (int i = 0; i < 3; i++) density[i] = loading->own[PRESSURE] * at->normal[i];
}

static const fracas_load load = {.on = FRACAS_LOAD_ON_AREA, .density = density};

/* A body of radius R: p t^2/(2 rho h R) as if it had no stiffness; twice the static strain of a
 * tube while whole, four times a sphere's. A surface without a radius may bend: no bound is known.
 */
static fracas_stretch surface(const fracas_spec *spec, const fracas_loading *loading, double t)
{
    const bool partial = fracas_load_has_front(loading) || loading->spot > 0;
    const double radius = spec->geometry.radius, h = spec->geometry.thickness,
                 p = fabs(loading->own[PRESSURE]) * fracas_load_largest(loading, t);
    return (fracas_stretch){
        .strain = p == 0 ? 0 : p * t * t / (2 * spec->material.density * h * radius),
        .ratio = 1,
        .ratio_z = NAN,
        .whole = partial
                     ? 0
                     : 2 * p * radius * (1 - spec->material.poisson) / (spec->material.young * h)};
}

const fracas_kind fracas_loading_pressure = {
    "pressure",
    "a pressure on one side of a body at rest: constant, or a pulse, behind a front, on a spot",
    FRACAS_PARAMS(params), .only = FRACAS_GROUP_SHELL,
    .traits = &(const fracas_loading_traits){
        .surface = surface, .load = &load, .check = fracas_load_check}};
