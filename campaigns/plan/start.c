/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/start.h"

#include "engine/formulation/surface/loads.h"
#include "engine/loading/initial.h"
#include "engine/mesh/body.h"

#include <math.h>

double fracas_start_speed(const fracas_model *model)
{
    const fracas_surface *surface = fracas_model_surface(model);
    double fastest = 0, v[3];
    if (!surface) return 0;
    for (size_t n = 0; n < surface->nnodes; n++) {
        fracas_initial_velocity(&model->spec.initial, surface->node[n], v);
        fastest = fmax(fastest, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
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

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* An edge: its direction, the outward normal in its element's plane, its middle, its length. */
typedef struct {
    double along[3], normal[3], middle[3], length;
} side;

static side side_of(const fracas_surface *surface, const fracas_surface_border *border)
{
    const double *a = fracas_surface_node(surface, border->element, border->edge),
                 *b = fracas_surface_node(surface, border->element, (border->edge + 1) % 3),
                 *c = fracas_surface_node(surface, border->element, (border->edge + 2) % 3);
    side made;
    double inward[3];
    for (int i = 0; i < 3; i++) {
        made.along[i] = b[i] - a[i];
        inward[i] = c[i] - a[i];
        made.middle[i] = 0.5 * (a[i] + b[i]);
    }
    made.length = sqrt(dot(made.along, made.along));
    for (int i = 0; i < 3; i++) made.along[i] /= made.length;
    const double along = dot(inward, made.along);
    for (int i = 0; i < 3; i++) made.normal[i] = along * made.along[i] - inward[i];
    const double height = sqrt(dot(made.normal, made.normal));
    for (int i = 0; i < 3; i++) made.normal[i] /= height;
    return made;
}

/* It faces away from the middle, as far out as half of the box, or farther. */
static bool is_outer(const side *edge, const box *around)
{
    double out = 0, half = 0;
    for (int i = 0; i < 3; i++) {
        out += edge->normal[i] * (edge->middle[i] - around->middle[i]);
        half += 0.5 * fabs(edge->normal[i]) * around->side[i];
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
static void traction_of(const fracas_spec *spec, const fracas_initial_strain *s, const side *edge,
                        double traction[3])
{
    const double nu = spec->material.poisson,
                 across = strain_of(s, edge->normal, edge->normal) +
                          nu * strain_of(s, edge->along, edge->along),
                 shear = (1 - nu) * strain_of(s, edge->normal, edge->along);
    for (int i = 0; i < 3; i++) traction[i] = across * edge->normal[i] + shear * edge->along[i];
}

/* True if some load acts on edges of this tag. */
static bool is_loaded(const fracas_model *model, int32_t tag)
{
    for (int n = 0; n < FRACAS_LOADINGS; n++) {
        const fracas_load *load = fracas_loading_load(&model->spec, n);
        int32_t loaded = 0;
        for (int i = 0; load && i < 2; i++)
            if (!fracas_surface_load_tag(model, n, i, &loaded) && loaded == tag && tag > 0)
                return true;
    }
    return false;
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
        const side edge = side_of(surface, border);
        if (fracas_shape_edge(spec, border->tag) || !is_outer(&edge, &around)) continue;
        double traction[3];
        traction_of(spec, &strain, &edge, traction);
        all += edge.length * sqrt(dot(traction, traction));
        if (is_loaded(model, border->tag)) continue;
        const unsigned held = fracas_surface_held_by(model, border);
        for (int i = 0; i < 3; i++)
            if (held >> i & 1) traction[i] = 0;
        released += edge.length * sqrt(dot(traction, traction));
    }
    return all > 0 ? released / all : 1;
}
