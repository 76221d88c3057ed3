/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/start.h"

#include "engine/formulation/surface/loads.h"
#include "engine/loading/initial.h"
#include "engine/mesh/body.h"

#include <math.h>

static double length_of(const double x[3])
{
    return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

double fracas_start_speed(const fracas_model *model)
{
    const fracas_surface *surface = fracas_model_surface(model);
    double fastest = 0, v[3];
    if (!surface) return 0;
    for (size_t n = 0; n < surface->nnodes; n++) {
        fracas_initial_velocity(&model->spec.initial, surface->node[n], v);
        fastest = fmax(fastest, length_of(v));
    }
    return fastest;
}

/* The box around all nodes. */
typedef struct {
    double middle[3], side[3];
} box;

static box box_of(const fracas_surface *surface)
{
    box made;
    for (int i = 0; i < 3; i++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t n = 0; n < surface->nnodes; n++) {
            least = fmin(least, surface->node[n][i]);
            most = fmax(most, surface->node[n][i]);
        }
        made.middle[i] = 0.5 * (least + most);
        made.side[i] = most - least;
    }
    return made;
}

/* It faces away from the middle, as far out as half of the box, or farther. */
static bool is_outer(const fracas_place *edge, const box *around)
{
    double out = 0, half = 0;
    for (int i = 0; i < 3; i++) {
        out += edge->outward[i] * (edge->x[i] - around->middle[i]);
        half += 0.5 * fabs(edge->outward[i]) * around->side[i];
    }
    return out > 0.5 * half;
}

/* a eps_0 b */
static double strain_of(const fracas_initial_strain *s, const double a[3], const double b[3])
{
    return s->x * a[0] * b[0] + s->y * a[1] * b[1] + s->z * a[2] * b[2] +
           s->xy * (a[0] * b[1] + a[1] * b[0]);
}

/* Traction of plane stress on the edge, by E/(1 - nu^2). */
static void traction_of(const fracas_spec *spec, const fracas_initial_strain *s,
                        const fracas_place *edge, double traction[3])
{
    const double nu = spec->material.poisson,
                 across = strain_of(s, edge->outward, edge->outward) +
                          nu * strain_of(s, edge->along, edge->along),
                 shear = (1 - nu) * strain_of(s, edge->outward, edge->along);
    for (int i = 0; i < 3; i++) traction[i] = across * edge->outward[i] + shear * edge->along[i];
}

double fracas_start_released(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const fracas_surface *surface = fracas_model_surface(model);
    double all = 0, released = 0;
    if (!surface || !fracas_initial_is_strained(spec)) return 0;
    const fracas_initial_strain strain = fracas_initial_strain_of(spec);
    const box around = box_of(surface);
    for (size_t b = 0; b < surface->nborders; b++) {
        const fracas_surface_border *border = &surface->border[b];
        double length;
        const fracas_place edge = fracas_surface_place_on(surface, border, 0.5, &length);
        if (fracas_shape_edge(spec, border->tag) || !is_outer(&edge, &around)) continue;
        double traction[3];
        traction_of(spec, &strain, &edge, traction);
        all += length * length_of(traction);
        if (fracas_surface_is_loaded(model, border->tag, false)) continue;
        const unsigned held = fracas_surface_held_by(model, border);
        for (int i = 0; i < 3; i++)
            if (held >> i & 1) traction[i] = 0;
        released += length * length_of(traction);
    }
    return all > 0 ? released / all : 1;
}
