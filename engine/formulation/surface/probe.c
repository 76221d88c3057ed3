/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of a surface: the nearest to a place, and their motion (docs/theory/probes.md). */
#include "engine/formulation/surface/surface.h"

#include <math.h>

enum { ROUNDS = 30 };

void fracas_surface_at(const fracas_surface *surface, size_t e, double xi, double eta,
                       double shape[6], double place[3], double base[2][3])
{
    double derivative[6][2];
    fracas_triangle_shape(surface->order, xi, eta, shape, derivative);
    for (int i = 0; i < 3; i++) place[i] = base[0][i] = base[1][i] = 0;
    for (size_t k = 0; k < surface->corners; k++)
        for (int i = 0; i < 3; i++) {
            const double x = fracas_surface_node(surface, e, k)[i];
            place[i] += shape[k] * x;
            for (int a = 0; a < 2; a++) base[a][i] += derivative[k][a] * x;
        }
}

/* The search for a point of the surface near to `place`. */
typedef struct {
    const fracas_surface *surface;
    const double *place;
    bool found;
    fracas_spot best;
} search;

/* A point of an element, its weights, place and distance; `slope`: derivatives by xi and eta. */
static fracas_spot spot_at(const search *s, size_t e, const double at[2], double slope[2][3])
{
    fracas_spot spot = {.element = e};
    double square = 0;
    fracas_surface_at(s->surface, e, at[0], at[1], spot.weight, spot.place, slope);
    for (int i = 0; i < 3; i++)
        square += (s->place[i] - spot.place[i]) * (s->place[i] - spot.place[i]);
    spot.distance = sqrt(square);
    return spot;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Takes a point that is nearer than the best so far, not only by a rounding. */
static void take(search *s, const fracas_spot *spot, double size)
{
    if (s->found && !(spot->distance < s->best.distance - 1e-9 * size)) return;
    s->found = true;
    s->best = *spot;
}

/* Steps of Gauss and Newton to the foot of the perpendicular, from the middle; false where it is
 * beyond the element's edges  (probes.1) */
static bool find_foot(const search *s, size_t e, fracas_spot *spot)
{
    double at[2] = {1.0 / 3, 1.0 / 3}, slope[2][3], step = 1;
    for (int n = 0; n < ROUNDS && step > 1e-15; n++) {
        double off[3], a[2][2], b[2];
        *spot = spot_at(s, e, at, slope);
        for (int i = 0; i < 3; i++) off[i] = s->place[i] - spot->place[i];
        for (int r = 0; r < 2; r++) {
            b[r] = dot(slope[r], off);
            for (int c = 0; c < 2; c++) a[r][c] = dot(slope[r], slope[c]);
        }
        const double per = 1 / (a[0][0] * a[1][1] - a[0][1] * a[1][0]),
                     change[2] = {per * (a[1][1] * b[0] - a[0][1] * b[1]),
                                  per * (a[0][0] * b[1] - a[1][0] * b[0])};
        for (int r = 0; r < 2; r++) at[r] += change[r];
        step = fabs(change[0]) + fabs(change[1]);
        if (!(fabs(at[0]) < 8 && fabs(at[1]) < 8)) return false; /* far away */
    }
    *spot = spot_at(s, e, at, slope);
    return at[0] > -1e-9 && at[1] > -1e-9 && at[0] + at[1] < 1 + 1e-9;
}

/* The same along edge k, to its ends. */
static fracas_spot find_on_edge(const search *s, size_t e, int k)
{
    static const double corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    const double *from = corner[k], *to = corner[(k + 1) % 3];
    double along = 0.5, step = 1;
    fracas_spot spot = {0};
    for (int n = 0; n < ROUNDS && step > 1e-15; n++) {
        double at[2], slope[2][3], tangent[3], off[3];
        for (int r = 0; r < 2; r++) at[r] = from[r] + along * (to[r] - from[r]);
        spot = spot_at(s, e, at, slope);
        for (int i = 0; i < 3; i++) {
            tangent[i] = slope[0][i] * (to[0] - from[0]) + slope[1][i] * (to[1] - from[1]);
            off[i] = s->place[i] - spot.place[i];
        }
        const double next = along + dot(tangent, off) / dot(tangent, tangent), inside = next < 0 ? 0
                                                                                        : next > 1
                                                                                            ? 1
                                                                                            : next;
        step = fabs(inside - along);
        along = inside;
    }
    return spot;
}

/* A sphere around the element, curved ones with some room, is farther than the best. */
static bool is_far(const search *s, size_t e, double *size)
{
    double middle[3] = {0}, reach = 0, square = 0;
    const size_t corners = s->surface->corners;
    for (size_t k = 0; k < corners; k++)
        for (int i = 0; i < 3; i++)
            middle[i] += fracas_surface_node(s->surface, e, k)[i] / (double)corners;
    for (size_t k = 0; k < corners; k++) {
        double off[3];
        for (int i = 0; i < 3; i++) off[i] = fracas_surface_node(s->surface, e, k)[i] - middle[i];
        reach = fmax(reach, dot(off, off));
    }
    for (int i = 0; i < 3; i++) square += (s->place[i] - middle[i]) * (s->place[i] - middle[i]);
    *size = sqrt(reach);
    return s->found && sqrt(square) - 1.5 * *size > s->best.distance;
}

/* Takes the nearest point of an element, if it is nearer than the best so far. */
static void look_into(search *s, size_t e, double size)
{
    fracas_spot there;
    if (find_foot(s, e, &there)) {
        take(s, &there, size);
        return;
    }
    for (int k = 0; k < 3; k++) {
        there = find_on_edge(s, e, k);
        take(s, &there, size);
    }
}

void fracas_surface_locate(const fracas_model *model, const double place[3], fracas_spot *spot)
{
    search s = {.surface = model->surface, .place = place};
    for (size_t e = 0; e < model->elements; e++) {
        double size;
        if (!is_far(&s, e, &size)) look_into(&s, e, size);
    }
    *spot = s.best;
}

bool fracas_surface_has(const fracas_surface *surface, size_t e, const double place[3],
                        fracas_spot *spot)
{
    search s = {.surface = surface, .place = place, .found = true};
    double size;
    if (is_far(&s, e, &size)) return false;
    s.found = false;
    look_into(&s, e, size);
    *spot = s.best;
    return spot->distance <= 1e-9 * size;
}

/* (probes.2) */
void fracas_surface_motion_at(const fracas_model *model, const fracas_step *step, int lane,
                              const fracas_spot *spot, double displacement[3], double velocity[3])
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const size_t dimension = (size_t)c.tables->body->dimension,
                 unknowns = fracas_surface_unknowns(c.tables),
                 first = spot->element * fracas_surface_element_fields(&c);
    for (int i = 0; i < 3; i++) displacement[i] = velocity[i] = 0;
    for (size_t k = 0; k < model->surface->corners; k++)
        for (size_t i = 0; i < dimension; i++) {
            const size_t at = first + dimension * k + i;
            displacement[i] += spot->weight[k] *
                               *fracas_surface_field(step, at + SURFACE_U * unknowns, lane);
            velocity[i] += spot->weight[k] *
                           *fracas_surface_field(step, at + SURFACE_V * unknowns, lane);
        }
}
