/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shells that break: small bodies, a way to put them into any state and read all forces, and the
 * kinematics of their interfaces written once more, from the nodes alone (docs/theory/shell.md). */
#ifndef FRACAS_TESTS_SUPPORT_SHELL_CRACKS_H
#define FRACAS_TESTS_SUPPORT_SHELL_CRACKS_H

#include "engine/formulation/shell/shell.h"
#include "tests/support/surface_state.h"

/* E 320 GPa, nu 0.3, rho 3300, G_c 200 J/m2, 0.3 mm thick; law nitsche, beta 5; half the critical
 * step. A plate has 1 mm x 1 mm, an annulus 1 to 3 mm, a sphere 1.5 mm. */
static inline fracas_spec brittle_shell(const fracas_kind *shape, int64_t divisions)
{
    fracas_spec spec = surface_spec(&fracas_formulation_shell, shape);
    spec.geometry.thickness = 3e-4;
    spec.mesh.divisions = divisions;
    if (shape == &fracas_shape_plate) spec.geometry.width = spec.geometry.height = 1e-3;
    else if (shape == &fracas_shape_annulus) spec.geometry.inner = 1e-3, spec.geometry.outer = 3e-3;
    else spec.geometry.radius = 1.5e-3;
    return spec;
}

/* ---- a body in any state ---- */

/* What one evaluation at given displacements says: forces -dPi/du [N], energies [J], and what was
 * added to the sums. */
typedef struct {
    double *force;
    double elastic, cohesive, dissipated, created, bending, rubbed;
} shell_answer;

/* A step of no length from rest at u, that kicks for 1 s: the velocities after it are the
 * accelerations. Damage advances. */
static inline void evaluate(fracas_batch *batch, const double *u, shell_answer *answer)
{
    const fracas_model *model = batch->model;
    fracas_step *step = &batch->step;
    for (size_t i = 0; i < unknowns_of(model); i++) {
        *value_of(batch, i, SURFACE_U) = u[i];
        *value_of(batch, i, SURFACE_V) = 0;
    }
    step->drift[0] = 0;
    step->kick[0] = 1;
    const double created = step->created[0], bending = step->dissipated_bending[0],
                 rubbed = step->friction[0];
    model->formulation->advance(model, step);
    OWNED double *v = vector_of(unknowns_of(model));
    for (size_t i = 0; i < unknowns_of(model); i++) v[i] = *value_of(batch, i, SURFACE_V);
    multiply_mass(model, v, answer->force);
    answer->elastic = step->elastic[0];
    answer->cohesive = step->cohesive[0];
    answer->dissipated = step->dissipated[0];
    answer->created = step->created[0] - created;
    answer->bending = step->dissipated_bending[0] - bending;
    answer->rubbed = step->friction[0] - rubbed;
}

/* As evaluate, but nothing of the state advances. */
static inline void look_at(fracas_batch *batch, const double *u, shell_answer *answer)
{
    const size_t bytes = batch->model->formulation->state_size(batch->model) * sizeof(double);
    OWNED double *kept = taken(bytes);
    memcpy(kept, batch->step.state, bytes);
    const fracas_step step = batch->step;
    evaluate(batch, u, answer);
    batch->step = step;
    memcpy(batch->step.state, kept, bytes);
}

/* ---- kinematics, from the nodes ---- */

static inline double unit3(double a[3])
{
    const double length = sqrt(dot3(a, a));
    for (int i = 0; i < 3; i++) a[i] /= length;
    return length;
}

/* A point of the mid-surface: base phi_a, dual phi^a, phi_ab, unit normal t, and the frame x (edge
 * 0 in the surface), y. */
typedef struct {
    surface_shape shape;
    double base[2][3], dual[2][3], second[3][3], t[3], x[3], y[3], area;
} shell_place;

static inline shell_place place_at(const fracas_model *model, size_t e, double xi, double eta)
{
    shell_place p = {.shape = shape_at(SHELL_NODES, xi, eta)};
    for (int k = 0; k < 6; k++)
        for (int i = 0; i < 3; i++) {
            const double x = node_at(model, e, (size_t)k)[i];
            for (int a = 0; a < 2; a++) p.base[a][i] += p.shape.first[k][a] * x;
            for (int a = 0; a < 3; a++) p.second[a][i] += p.shape.second[k][a] * x;
        }
    cross3(p.base[0], p.base[1], p.t);
    p.area = unit3(p.t);
    /* phi^a from the inverse of the metric */
    const double g[3] = {dot3(p.base[0], p.base[0]), dot3(p.base[1], p.base[1]),
                         dot3(p.base[0], p.base[1])},
                 det = g[0] * g[1] - g[2] * g[2];
    for (int i = 0; i < 3; i++) {
        p.dual[0][i] = (g[1] * p.base[0][i] - g[2] * p.base[1][i]) / det;
        p.dual[1][i] = (g[0] * p.base[1][i] - g[2] * p.base[0][i]) / det;
        p.x[i] = node_at(model, e, 1)[i] - node_at(model, e, 0)[i];
    }
    const double off = dot3(p.x, p.t);
    for (int i = 0; i < 3; i++) p.x[i] -= off * p.t[i];
    unit3(p.x);
    cross3(p.t, p.x, p.y);
    return p;
}

/* sum_ab (a . phi^a)(b . phi^b) f_ab, f = {xixi, etaeta, xieta} */
static inline double second_along(const shell_place *p, const double a[3], const double b[3],
                                  const double f[3])
{
    const double a0 = dot3(a, p->dual[0]), a1 = dot3(a, p->dual[1]), b0 = dot3(b, p->dual[0]),
                 b1 = dot3(b, p->dual[1]);
    return a0 * b0 * f[0] + a1 * b1 * f[1] + (a0 * b1 + a1 * b0) * f[2];
}

/* d u/d direction */
static inline void slope_along(const shell_place *p, const double a[3], const double *u,
                               double by[3])
{
    const double a0 = dot3(a, p->dual[0]), a1 = dot3(a, p->dual[1]);
    by[0] = by[1] = by[2] = 0;
    for (int k = 0; k < 6; k++)
        for (int i = 0; i < 3; i++)
            by[i] += (a0 * p->shape.first[k][0] + a1 * p->shape.first[k][1]) * u[3 * k + i];
}

/* Resultants n_xx, n_yy, n_xy, m_xx, m_yy, m_xy, and energy by area, of displacements u[18] of the
 * element. */
static inline double resultants_at(const fracas_model *model, const shell_place *p, const double *u,
                                   double r[6])
{
    const double nu = model->spec.material.poisson, h = model->spec.geometry.thickness,
                 c = h * model->spec.material.young / (1 - nu * nu);
    const double *frame[2] = {p->x, p->y};
    double by[2][3], strain[2][3], h_ab[3] = {0};
    for (int a = 0; a < 2; a++) slope_along(p, frame[a], u, by[a]);
    strain[0][0] = dot3(p->x, by[0]);
    strain[0][1] = dot3(p->y, by[1]);
    strain[0][2] = 0.5 * (dot3(p->x, by[1]) + dot3(p->y, by[0]));
    for (int ab = 0; ab < 3; ab++) /* t . (u,ab - G^c_ab u,c) */
        for (int k = 0; k < 6; k++) {
            double second = p->shape.second[k][ab];
            for (int d = 0; d < 2; d++)
                second -= dot3(p->second[ab], p->dual[d]) * p->shape.first[k][d];
            h_ab[ab] += second * dot3(p->t, u + 3 * k);
        }
    strain[1][0] = -second_along(p, p->x, p->x, h_ab);
    strain[1][1] = -second_along(p, p->y, p->y, h_ab);
    strain[1][2] = -second_along(p, p->x, p->y, h_ab);
    double energy = 0;
    for (int part = 0; part < 2; part++) {
        const double *e = strain[part], stiff = part ? c * h * h / 12 : c;
        r[3 * part] = stiff * (e[0] + nu * e[1]);
        r[3 * part + 1] = stiff * (e[1] + nu * e[0]);
        r[3 * part + 2] = stiff * (1 - nu) * e[2];
        energy += 0.5 * (r[3 * part] * e[0] + r[3 * part + 1] * e[1] + 2 * r[3 * part + 2] * e[2]);
    }
    return energy;
}

static inline double bulk_energy(const fracas_model *model, size_t e, const double *u)
{
    double energy = 0, r[6];
    for (int g = 0; g < 3; g++) {
        const shell_place p = place_at(model, e, g == 1 ? 2.0 / 3 : 1.0 / 6,
                                       g == 2 ? 2.0 / 3 : 1.0 / 6);
        energy += p.area / 6 * resultants_at(model, &p, u, r);
    }
    return energy;
}

/* Means of N, M, jumps [u], [Dt] along the normal and the edge, [u] . t, and the weight [m], at
 * Gauss point g of an interface, of the displacements of its elements. All but the weight is linear
 * in them. Resultants are linear over an element, by their components in its frame. */
typedef struct {
    double n[2], m[2], jump[2], turn[2], lift, length;
} shell_sight;

static inline shell_sight sight_at(const fracas_model *model, size_t interface, int g,
                                   const double *const u[2])
{
    const double root = sqrt(0.15), point[3] = {0.5 - root, 0.5, 0.5 + root},
                 weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    const fracas_surface_interface *joint = &model->surface->interface[interface];
    shell_place p[2];
    double tangent[3] = {0}, speed = 0, normal[3], mean_t[3], mean[4] = {0}, curved[3] = {0},
           jump[3] = {0}, along[3] = {0}, turn = 0;
    for (int side = 0; side < 2; side++) {
        double at[2], from[2], to[2];
        const double s = side ? 1 - point[g] : point[g];
        on_edge(joint->edge[side], s, at);
        p[side] = place_at(model, joint->element[side], at[0], at[1]);
        if (side == 0) {
            on_edge(joint->edge[0], 0, from);
            on_edge(joint->edge[0], 1, to);
            for (int i = 0; i < 3; i++)
                tangent[i] = (to[0] - from[0]) * p[0].base[0][i] +
                             (to[1] - from[1]) * p[0].base[1][i];
            speed = unit3(tangent);
        }
    }
    for (int i = 0; i < 3; i++) mean_t[i] = p[0].t[i] + p[1].t[i];
    unit3(mean_t);
    cross3(tangent, mean_t, normal);
    for (int side = 0; side < 2; side++) {
        const double sign = side ? 1 : -1;
        double own[3], by[3], r[6] = {0}, at[2];
        cross3(tangent, p[side].t, own);
        on_edge(joint->edge[side], side ? 1 - point[g] : point[g], at);
        const double l[3] = {1 - at[0] - at[1], at[0], at[1]};
        for (int b = 0; b < 3; b++) {
            double there[6];
            const shell_place bulk = place_at(model, joint->element[side],
                                              b == 1 ? 2.0 / 3 : 1.0 / 6,
                                              b == 2 ? 2.0 / 3 : 1.0 / 6);
            resultants_at(model, &bulk, u[side], there);
            for (int j = 0; j < 6; j++) r[j] += (2 * l[b] - 1.0 / 3) * there[j];
        }
        const double nx = dot3(own, p[side].x), ny = dot3(own, p[side].y),
                     sx = dot3(tangent, p[side].x), sy = dot3(tangent, p[side].y);
        for (int part = 0; part < 2; part++) {
            const double *q = r + 3 * part;
            mean[2 * part] += 0.5 * (nx * (q[0] * nx + q[2] * ny) + ny * (q[2] * nx + q[1] * ny));
            mean[2 * part + 1] += 0.5 *
                                  (sx * (q[0] * nx + q[2] * ny) + sy * (q[2] * nx + q[1] * ny));
        }
        const double f[3] = {dot3(p[side].t, p[side].second[0]), dot3(p[side].t, p[side].second[1]),
                             dot3(p[side].t, p[side].second[2])};
        curved[0] -= 0.5 * second_along(&p[side], own, own, f);
        curved[1] -= 0.5 * second_along(&p[side], own, tangent, f);
        curved[2] -= 0.5 * second_along(&p[side], tangent, tangent, f);
        for (int k = 0; k < 6; k++)
            for (int i = 0; i < 3; i++)
                jump[i] += sign * p[side].shape.value[k] * u[side][3 * k + i];
        slope_along(&p[side], own, u[side], by);
        turn -= sign * dot3(p[side].t, by); /* [Dt_n], Dt_n = -t . d_n u */
        slope_along(&p[side], tangent, u[side], by);
        for (int i = 0; i < 3; i++) along[i] += sign * by[i];
    }
    return (shell_sight){.n = {mean[0] + curved[0] * mean[2] + curved[1] * mean[3],
                               mean[1] + curved[1] * mean[2] + curved[2] * mean[3]},
                         .m = {mean[2], mean[3]},
                         .jump = {dot3(normal, jump), dot3(tangent, jump)},
                         .turn = {turn, -dot3(mean_t, along)},
                         .lift = dot3(mean_t, jump),
                         .length = weight[g] * speed};
}

/* K of an interface [Pa/m], and of the shear [Pa]  (membrane.5) */
static inline double spring_of(const fracas_model *model, size_t interface, double *shearing)
{
    const fracas_surface_interface *joint = &model->surface->interface[interface];
    const fracas_material *m = &model->spec.material;
    double inverse = 0;
    for (int side = 0; side < 2; side++)
        inverse += 0.5 * fracas_surface_length(model->surface, joint->element[0], joint->edge[0]) /
                   model->surface->area[joint->element[side]];
    *shearing = model->spec.cohesive.beta_shear * inverse * m->young / (2 * (1 + m->poisson)) *
                model->spec.geometry.thickness;
    return model->spec.cohesive.beta * m->young / (1 - m->poisson * m->poisson) * inverse;
}

#endif
