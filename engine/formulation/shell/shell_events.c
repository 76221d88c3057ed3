/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Onsets and breaks of interfaces, one lane at a time: when within the step. */
#include "engine/formulation/shell/shell.h"

#include <math.h>

/* One lane's view of the state after its drift. */
typedef struct {
    const fracas_surface_constants *shell;
    const double *elements, *joints, *strengths; /* of the lane's group, from its own place in it */
    size_t lanes;
    double back; /* s: displacements are looked at so much earlier */
} view;

static view view_of(const fracas_surface_constants *shell, const fracas_step *step, int lane,
                    double back)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes;
    const double *state = step->state + group * lanes * fracas_surface_state_fields(shell) +
                          (size_t)lane % lanes;
    return (view){.shell = shell,
                  .elements = state,
                  .joints = state + fracas_surface_interfaces_at(shell) * lanes,
                  .strengths = state + fracas_surface_strengths_at(shell) * lanes,
                  .lanes = lanes,
                  .back = back};
}

static void displacements(const view *v, size_t element, double u[SHELL_UNKNOWNS])
{
    const double *at = v->elements + element * fracas_surface_element_fields(v->shell) * v->lanes;
    for (int i = 0; i < SHELL_UNKNOWNS; i++)
        u[i] = at[(size_t)(SURFACE_U * SHELL_UNKNOWNS + i) * v->lanes] -
               v->back * at[(size_t)(SURFACE_V * SHELL_UNKNOWNS + i) * v->lanes];
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Resultants at bulk point g  (shell.4). */
static void resultants_at(const view *v, size_t element, const double u[SHELL_UNKNOWNS], int g,
                          double r[6])
{
    static const double shape[3][6][2] = FRACAS_TRIANGLE_DERIVATIVES_2,
                        second[3][6] = FRACAS_TRIANGLE_SECOND_2;
    const fracas_surface_constants *s = v->shell;
    const double *bulk = s->tables->bulk + (element * SHELL_BULK + (size_t)g) * SHELL_BULK_TABLE;
    double bent[3][3] = {{0}}, by[2][3] = {{0}}, along[2][3], out[5], rho[3];
    for (int k = 0; k < SHELL_NODES; k++)
        for (int i = 0; i < 3; i++) {
            for (int a = 0; a < 2; a++) by[a][i] += shape[g][k][a] * u[3 * k + i];
            for (int b = 0; b < 3; b++) bent[b][i] += second[b][k] * u[3 * k + i];
        }
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 3; i++)
            along[j][i] = bulk[SHELL_XI_X + j] * by[0][i] + bulk[SHELL_ETA_X + j] * by[1][i];
    for (int b = 0; b < 3; b++) out[b] = dot(bulk + SHELL_T, bent[b]);
    for (int a = 0; a < 2; a++) out[3 + a] = dot(bulk + SHELL_T, by[a]);
    for (int ij = 0; ij < 3; ij++)
        rho[ij] = dot(bulk + SHELL_SECOND + 3 * ij, out) + bulk[SHELL_FIRST + 2 * ij] * out[3] +
                  bulk[SHELL_FIRST + 2 * ij + 1] * out[4];
    const double xx = dot(bulk + SHELL_X, along[0]), yy = dot(bulk + SHELL_Y, along[1]);
    const double xy = dot(bulk + SHELL_X, along[1]) + dot(bulk + SHELL_Y, along[0]);
    r[0] = s->c11 * xx + s->c12 * yy;
    r[1] = s->c12 * xx + s->c11 * yy;
    r[2] = s->c33 * xy;
    r[3] = s->d11 * rho[0] + s->d12 * rho[1];
    r[4] = s->d12 * rho[0] + s->d11 * rho[1];
    r[5] = s->d33 * rho[2];
}

/* Of a Gauss point, along its normal and along the edge: means of N, M and jumps  (shell.5),
 * (shell.6). */
typedef struct {
    double n[2], m[2], jump[2], turn[2];
} sight;

static sight look(const view *v, size_t interface, int g)
{
    static const double edge_point[3] = FRACAS_EDGE_POINTS_2;
    const fracas_surface_tables *t = v->shell->tables;
    const double *place = t->interface + interface * SHELL_INTERFACE_TABLE + SHELL_POINTS +
                          g * SHELL_POINT_TABLE;
    double shape[3], spread[3], slope[3], q[3] = {0}, along[3] = {0}, mean[4] = {0};
    sight s = {.turn = {0}};
    fracas_edge_shape(2, edge_point[g], shape, spread);
    fracas_edge_slope(edge_point[g], slope);
    for (int side = 0; side < 2; side++) {
        const double sign = side ? 1 : -1, *table = place + SHELL_SIDES + side * SHELL_SIDE;
        const int k = t->edge[interface][side], next = (k + 1) % 3;
        const int node[3] = {side ? next : k, side ? k : next, 3 + k},
                  bulk[3] = {node[0], node[1], (k + 2) % 3};
        const size_t element = t->element[interface][side];
        double u[SHELL_UNKNOWNS], by_normal[3] = {0}, r[6] = {0};
        displacements(v, element, u);
        for (int i = 0; i < 3; i++) {
            for (int n = 0; n < 3; n++) {
                q[i] += sign * shape[n] * u[3 * node[n] + i];
                along[i] += sign * slope[n] * u[3 * node[n] + i];
            }
            for (int n = 0; n < SHELL_NODES; n++)
                by_normal[i] += table[SHELL_SLOPE + n] * u[3 * n + i];
        }
        s.turn[0] += dot(table + SHELL_TURN, by_normal);
        for (int p = 0; p < 3; p++) {
            double at[6];
            resultants_at(v, element, u, bulk[p], at);
            for (int j = 0; j < 6; j++) r[j] += spread[p] * at[j];
        }
        const double xx = table[SHELL_SQUARE_X], yy = table[SHELL_SQUARE_Y],
                     xy = table[SHELL_PRODUCT];
        for (int part = 0; part < 2; part++) {
            mean[2 * part] += xx * r[3 * part] + yy * r[3 * part + 1] + 2 * xy * r[3 * part + 2];
            mean[2 * part + 1] += xy * (r[3 * part + 1] - r[3 * part]) +
                                  (xx - yy) * r[3 * part + 2];
        }
    }
    s.turn[1] = -place[SHELL_PER_SPEED] * dot(place + SHELL_LIFT, along);
    s.jump[0] = dot(place + SHELL_N, q);
    s.jump[1] = dot(place + SHELL_S, q);
    s.n[0] = mean[0] + place[SHELL_L_NN] * mean[2] + place[SHELL_L_NS] * mean[3];
    s.n[1] = mean[1] + place[SHELL_L_NS] * mean[2] + place[SHELL_L_SS] * mean[3];
    s.m[0] = mean[2];
    s.m[1] = mean[3];
    return s;
}

static double effective(double t_n, double t_t, double beta_c)
{
    const double pull = fmax(t_n, 0), shear = t_t / beta_c;
    return sqrt(pull * pull + shear * shear);
}

/* What the law compares at layer k of a Gauss point: with the strength, and with delta_c; see
 * engine/cohesive/nitsche.h. */
static void compared(const fracas_surface_constants *s, size_t interface, const sight *at, int k,
                     double *onset, double *opening)
{
    static const double place[SHELL_LAYERS] = SHELL_LAYER_PLACES;
    const double h = s->thickness, z = place[k] * h,
                 stiffness =
                     s->tables->interface[interface * SHELL_INTERFACE_TABLE + SURFACE_STIFFNESS];
    const double k_n = s->normal * stiffness, k_t = s->tangential * stiffness;
    const double mean_n = at->n[0] / h + 12 * z * at->m[0] / (h * h * h),
                 mean_t = at->n[1] / h + 12 * z * at->m[1] / (h * h * h);
    const double t_n = mean_n + k_n * (at->jump[0] + z * at->turn[0]),
                 t_t = mean_t + k_t * (at->jump[1] + z * at->turn[1]);
    const double on_n = s->onset_mean ? mean_n : t_n, on_t = s->onset_mean ? mean_t : t_t;
    *onset = effective(on_n, fmax(0, fabs(on_t) + s->mu_c * fmin(on_n, 0)), s->beta_c);
    *opening = effective(t_n, t_t, s->beta_c) / k_n;
}

/* t with value(t) = limit, linear between the step before and this one; held within the step
 * (membrane.12) */
static double crossing(const fracas_step *step, int lane, double before, double now, double limit)
{
    const double share = (now - limit) / (now - before);
    return step->time[lane] - step->drift[lane] * (share > 0 ? fmin(share, 1.0) : 0.0);
}

void fracas_shell_book(const fracas_surface_constants *shell, fracas_step *step, int lane,
                       size_t interface, const fracas_surface_event *event)
{
    const view before = view_of(shell, step, lane, step->drift[lane]),
               now = view_of(shell, step, lane, 0);
    const size_t at = interface * (size_t)step->width + (size_t)lane;
    const double *joint = now.joints +
                          interface * fracas_surface_interface_fields(shell) * now.lanes;
    double first = INFINITY, last = -INFINITY;
    for (int g = 0; g < SHELL_EDGE; g++) {
        const double sigma_c =
            now.strengths[fracas_surface_strength_of(shell, interface, g) * now.lanes];
        const sight then = look(&before, interface, g), here = look(&now, interface, g);
        for (int k = 0; k < SHELL_LAYERS; k++) {
            const int field = (g * SHELL_LAYERS + k) * shell->point_fields + SURFACE_PEAK;
            const double delta_c = shell->opening > 0
                                       ? shell->opening
                                       : 2 * shell->energy / joint[(size_t)field * now.lanes];
            double onset[2], opening[2];
            compared(shell, interface, &then, k, &onset[0], &opening[0]);
            compared(shell, interface, &here, k, &onset[1], &opening[1]);
            if (event->cracks[g * SHELL_LAYERS + k])
                first = fmin(first, crossing(step, lane, onset[0], onset[1], sigma_c));
            if (event->breaks[g * SHELL_LAYERS + k])
                last = fmax(last, crossing(step, lane, opening[0], opening[1], delta_c));
        }
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
