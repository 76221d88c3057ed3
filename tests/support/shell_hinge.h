/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two elements of a flat shell and their interface: a uniform state of stress, and one element
 * moved against the other as a rigid body. Forces on it are those of the interface alone. */
#ifndef FRACAS_TESTS_SUPPORT_SHELL_HINGE_H
#define FRACAS_TESTS_SUPPORT_SHELL_HINGE_H

#include "tests/support/shell.h"
#include "tests/support/shell_cracks.h"

#define HINGE_STRENGTH 300e6 /* Pa */

/* n, s: along the normal and the edge. */
typedef struct {
    double n[2], m[2]; /* uniform N [N/m], M [N] */
} hinge_stress;

typedef struct {
    double u[2], t[2]; /* [u] [m], [Dt] [1] */
} hinge_jump;

typedef struct {
    fracas_model *model;
    fracas_batch *batch;
    double normal[3], along[3], middle[3], length; /* of the edge [m] */
    double *at, *force;                            /* displacements [m], forces [N] */
    shell_answer answer;
    hinge_stress carried; /* the interface's N, M, means over the edge */
    double work;          /* on it since the second step [J/m] */
    long steps;
} hinge;

static inline fracas_spec hinge_spec(void)
{
    fracas_spec spec = brittle_shell(&fracas_shape_plate, 1);
    spec.cohesive.law = &fracas_law_becker_noels.kind;
    spec.cohesive.beta_shear = 0;
    return spec;
}

static inline hinge hinge_begin(const fracas_spec *spec)
{
    static const double size[2] = {1e-3, 0.7e-3};
    hinge h = {.model = grid_model(spec, &(shell_grid){1, 1, flat_map, size})};
    h.batch = lane_of(h.model, 0, 0, 0);
    bar_set_strength(h.batch, 0, 0, HINGE_STRENGTH);
    OK(fracas_batch_begin(h.batch));
    h.at = vector_of(unknowns_of(h.model));
    h.force = vector_of(unknowns_of(h.model));
    h.answer.force = h.force;
    const fracas_surface_interface *joint = &h.model->surface->interface[0];
    const double *from = node_at(h.model, joint->element[0], joint->edge[0]),
                 *to = node_at(h.model, joint->element[0], (joint->edge[0] + 1) % 3);
    const double up[3] = {0, 0, 1};
    for (int i = 0; i < 3; i++) {
        h.along[i] = to[i] - from[i];
        h.middle[i] = 0.5 * (to[i] + from[i]);
    }
    h.length = unit3(h.along);
    cross3(h.along, up, h.normal);
    return h;
}

static inline void hinge_end(hinge *h)
{
    fracas_batch_destroy(h->batch);
    fracas_model_destroy(h->model);
    free(h->at);
    free(h->force);
}

/* Motion of a point of the second element: a turn w along s moves the director by w x t = w n. */
static inline void hinge_move(const hinge *h, const hinge_jump *by, const double *x, double *u)
{
    double arm[3], turn[3], turned[3];
    for (int i = 0; i < 3; i++) {
        arm[i] = x[i] - h->middle[i];
        turn[i] = by->t[0] * h->along[i] - by->t[1] * h->normal[i];
    }
    cross3(turn, arm, turned);
    for (int i = 0; i < 3; i++) u[i] = by->u[0] * h->normal[i] + by->u[1] * h->along[i] + turned[i];
}

/* Displacement of the uniform state  (shell.4): eps = ((1 + nu) n - nu tr(n) I)/(E h), the bending
 * strain 12/h^2 times that of m, w = -x.rho.x/2. */
static inline void hinge_strain(const hinge *h, const hinge_stress *stress, const double *x,
                                double *u)
{
    const fracas_material *material = &h->model->spec.material;
    const double depth = h->model->spec.geometry.thickness, nu = material->poisson;
    const double *part[2] = {stress->n, stress->m};
    u[0] = u[1] = u[2] = 0;
    for (int p = 0; p < 2; p++) {
        const double soft = (p ? 12 / (depth * depth) : 1) / (material->young * depth);
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                const double full = part[p][0] * h->normal[i] * h->normal[j] +
                                    part[p][1] *
                                        (h->normal[i] * h->along[j] + h->along[i] * h->normal[j]);
                const double strain = soft * ((1 + nu) * full - (i == j ? nu * part[p][0] : 0));
                if (p == 0) u[i] += strain * x[j];
                else u[2] -= 0.5 * x[i] * strain * x[j];
            }
    }
}

/* The interface's force by a motion of the second element [J/m]. */
static inline double hinge_power(const hinge *h, const hinge_jump *by)
{
    double power = 0;
    for (size_t i = 0; i < unknowns_of(h->model); i += 3) {
        double u[3];
        if (i / 18 != h->model->surface->interface[0].element[1]) continue;
        hinge_move(h, by, place_of(h->model, i), u);
        power -= dot3(h->force + i, u) / h->length;
    }
    return power;
}

/* Takes the body to a state of stress and a jump. */
static inline void hinge_go(hinge *h, const hinge_stress *stress, const hinge_jump *jump)
{
    const size_t n = unknowns_of(h->model);
    OWNED double *before = vector_of(2 * n);
    memcpy(before, h->at, n * sizeof *before);
    memcpy(before + n, h->force, n * sizeof *before);
    for (size_t i = 0; i < n; i += 3) {
        double moved[3] = {0};
        const double *x = place_of(h->model, i);
        hinge_strain(h, stress, x, h->at + i);
        if (i / 18 == h->model->surface->interface[0].element[1]) hinge_move(h, jump, x, moved);
        for (int c = 0; c < 3; c++) h->at[i + (size_t)c] += moved[c];
    }
    evaluate(h->batch, h->at, &h->answer);
    for (size_t i = 0; i < n && h->steps > 0; i++)
        h->work -= 0.5 * (h->force[i] + before[n + i]) * (h->at[i] - before[i]) / h->length;
    for (int d = 0; d < 2; d++) {
        h->carried.n[d] = hinge_power(h, &(hinge_jump){.u = {d == 0, d == 1}});
        h->carried.m[d] = hinge_power(h, &(hinge_jump){.t = {d == 0, d == 1}});
    }
    h->steps++;
}

static inline double hinge_value(const hinge *h, int field)
{
    return *surface_point(h->model, &h->batch->step, 0, 0, field, 0);
}

#endif
