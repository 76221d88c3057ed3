/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Onsets and breaks of interfaces, one lane at a time: when within the step. */
#include "engine/formulation/surface/membrane.h"

#include <math.h>

/* One lane's view of the state after its drift. */
typedef struct {
    const fracas_surface_constants *membrane;
    const double *elements, *joints, *strengths; /* of the lane's group, from its own place in it */
    size_t lanes;
    double back; /* s: displacements are looked at so much earlier */
} view;

static view view_of(const fracas_surface_constants *membrane, const fracas_step *step, int lane,
                    double back)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes;
    const double *state = step->state + group * lanes * fracas_surface_state_fields(membrane) +
                          (size_t)lane % lanes;
    return (view){.membrane = membrane,
                  .elements = state,
                  .joints = state + fracas_surface_interfaces_at(membrane) * lanes,
                  .strengths = state + fracas_surface_strengths_at(membrane) * lanes,
                  .lanes = lanes,
                  .back = back};
}

static double displacement(const view *v, size_t element, int i)
{
    const int size = 2 * SURFACE_NODES(v->membrane->tables->order);
    const double *at = v->elements +
                       element * fracas_surface_element_fields(v->membrane) * v->lanes;
    return at[(size_t)(SURFACE_U * size + i) * v->lanes] -
           v->back * at[(size_t)(SURFACE_V * size + i) * v->lanes];
}

/* Stress at bulk point g (membrane.3). */
static void stress_at(const view *v, size_t element, int g, double stress[3])
{
    static const double shape[2][3][6][2] = {FRACAS_TRIANGLE_DERIVATIVES_1,
                                             FRACAS_TRIANGLE_DERIVATIVES_2};
    const fracas_surface_constants *m = v->membrane;
    const int order = m->tables->order, points = SURFACE_BULK(order);
    const double *bulk = m->tables->bulk +
                         (element * (size_t)points + (size_t)g) * MEMBRANE_BULK_TABLE;
    double by[2][2] = {{0}};
    for (int k = 0; k < SURFACE_NODES(order); k++)
        for (int i = 0; i < 2; i++) {
            const double u = displacement(v, element, 2 * k + i), *d = shape[order - 1][g][k];
            by[i][0] += u * (d[0] * bulk[MEMBRANE_XI_X] + d[1] * bulk[MEMBRANE_ETA_X]);
            by[i][1] += u * (d[0] * bulk[MEMBRANE_XI_Y] + d[1] * bulk[MEMBRANE_ETA_Y]);
        }
    stress[0] = m->c11 * by[0][0] + m->c12 * by[1][1];
    stress[1] = m->c12 * by[0][0] + m->c11 * by[1][1];
    stress[2] = m->c33 * (by[0][1] + by[1][0]);
}

/* Mean traction and jump at Gauss point g of an interface, along its normal and tangent. */
static void look(const view *v, size_t interface, int g, double mean[2], double jump[2])
{
    static const double edge_point[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};
    const fracas_surface_tables *t = v->membrane->tables;
    const int order = t->order;
    double shape[3], spread[3];
    fracas_edge_shape(order, edge_point[order - 1][g], shape, spread);
    const double *place = t->interface +
                          interface *
                              (size_t)(SURFACE_HEAD + SURFACE_EDGE(order) * MEMBRANE_POINT_TABLE) +
                          SURFACE_HEAD + g * MEMBRANE_POINT_TABLE;
    double stress[3] = {0}, q[2] = {0};
    for (int side = 0; side < 2; side++) {
        const int k = t->edge[interface][side], next = (k + 1) % 3;
        const int node[3] = {side ? next : k, side ? k : next, 3 + k},
                  bulk[3] = {node[0], node[1], (k + 2) % 3};
        const size_t element = t->element[interface][side];
        for (int n = 0; n < order + 1; n++)
            for (int i = 0; i < 2; i++)
                q[i] += (side ? shape[n] : -shape[n]) * displacement(v, element, 2 * node[n] + i);
        for (int p = 0; p < SURFACE_BULK(order); p++) {
            double at[3];
            stress_at(v, element, order == 1 ? 0 : bulk[p], at);
            for (int i = 0; i < 3; i++) stress[i] += 0.5 * (order == 1 ? 1.0 : spread[p]) * at[i];
        }
    }
    const double nx = place[MEMBRANE_NX], ny = place[MEMBRANE_NY];
    const double pull[2] = {stress[0] * nx + stress[2] * ny, stress[2] * nx + stress[1] * ny};
    mean[0] = pull[0] * nx + pull[1] * ny;
    mean[1] = pull[1] * nx - pull[0] * ny;
    jump[0] = q[0] * nx + q[1] * ny;
    jump[1] = q[1] * nx - q[0] * ny;
}

/* The law's fields of a Gauss point. */
static const double *point_at(const view *v, size_t interface, int g)
{
    const fracas_surface_constants *m = v->membrane;
    return v->joints +
           (interface * fracas_surface_interface_fields(m) + (size_t)(g * m->point_fields)) *
               v->lanes;
}

static double effective(double t_n, double t_t, double beta_c)
{
    const double pull = fmax(t_n, 0), shear = t_t / beta_c;
    return sqrt(pull * pull + shear * shear);
}

static double onset_value(double t_n, double t_t, double beta_c, double mu_c)
{
    return effective(t_n, fmax(0, fabs(t_t) + mu_c * fmin(t_n, 0)), beta_c);
}

/* What the laws compare at a Gauss point: with the strength, and with the limit of a break; see
 * nitsche.h, extrinsic.h. */
static void compared(const view *v, size_t interface, int g, double *onset, double *opening)
{
    const fracas_surface_constants *m = v->membrane;
    const fracas_surface_tables *t = m->tables;
    const double stiffness =
        t->interface[interface *
                         (size_t)(SURFACE_HEAD + SURFACE_EDGE(t->order) * MEMBRANE_POINT_TABLE) +
                     SURFACE_STIFFNESS];
    const double k_n = m->normal * stiffness, k_t = m->tangential * stiffness;
    const double *point = point_at(v, interface, g);
    double mean[2], jump[2];
    look(v, interface, g, mean, jump);
    const double t_n = mean[0] + k_n * jump[0], t_t = mean[1] + k_t * jump[1];
    *onset = m->onset_mean ? onset_value(mean[0], mean[1], m->beta_c, m->mu_c)
                           : onset_value(t_n, t_t, m->beta_c, m->mu_c);
    if (m->flux) *opening = effective(t_n, t_t, m->beta_c) / k_n; /* broken at delta_c */
    else
        *opening = effective(
            jump[0] - point[SURFACE_POINT_FIELDS * v->lanes],
            m->beta_c * m->beta_c * (jump[1] - point[(SURFACE_POINT_FIELDS + 1) * v->lanes]),
            m->beta_c);
}

/* t with value(t) = limit, linear between the step before and this one; held within the step
 * (membrane.12) */
static double crossing(const fracas_step *step, int lane, double before, double now, double limit)
{
    const double share = (now - limit) / (now - before);
    return step->time[lane] - step->drift[lane] * (share > 0 ? fmin(share, 1.0) : 0.0);
}

void fracas_membrane_book(const fracas_surface_constants *membrane, fracas_step *step, int lane,
                          size_t interface, const fracas_surface_event *event)
{
    const view before = view_of(membrane, step, lane, step->drift[lane]),
               now = view_of(membrane, step, lane, 0);
    const size_t at = interface * (size_t)step->width + (size_t)lane;
    double first = INFINITY, last = -INFINITY;
    for (int g = 0; g < SURFACE_EDGE(membrane->tables->order); g++) {
        const double peak = point_at(&now, interface, g)[SURFACE_PEAK * now.lanes];
        const double sigma_c =
            now.strengths[fracas_surface_strength_of(membrane, interface, g) * now.lanes];
        const double delta_c = membrane->opening > 0 ? membrane->opening
                                                     : 2 * membrane->energy / peak;
        double onset[2], opening[2];
        compared(&before, interface, g, &onset[0], &opening[0]);
        compared(&now, interface, g, &onset[1], &opening[1]);
        if (event->cracks[g])
            first = fmin(first, crossing(step, lane, onset[0], onset[1], sigma_c));
        if (event->breaks[g])
            last = fmax(last, crossing(step, lane, opening[0], opening[1], delta_c));
    }
    if (event->opens) {
        step->cracked[lane]++;
        step->first_onset[lane] = fmin(step->first_onset[lane], first); /* NaN: none yet */
        if (step->onset_time) step->onset_time[at] = first;
    }
    if (event->parts) {
        step->broken[lane]++;
        if (step->break_time) step->break_time[at] = last;
    }
}
