/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell's operator on distorted and curved meshes: rigid motions give no force, uniform states
 * are exact. */
#include "tests/support/shell_bodies.h"
#include "tests/support/test.h"

#include <gsl/gsl_integration.h>

/* ---- rigid motions ---- */

static void rigid(const void *how, const double x[3], double u[3])
{
    const double *at = how; /* translation, rotation */
    for (int i = 0; i < 3; i++)
        u[i] = at[i] + at[3 + (i + 1) % 3] * x[(i + 2) % 3] - at[3 + (i + 2) % 3] * x[(i + 1) % 3];
}

/* No force at all, on curved elements too: strains and jumps are linear in u, and 0 for u = c + w x
 * X, each of them alone. What remains is the round-off of K u: some 50 terms, each below max|K|
 * max|u|, 6e-15 of that. */
static void rigid_motions_give_no_force(void **unused)
{
    for (int which = 0; which < BODIES; which++) {
        OWN(fracas_model) model = body_of(which, shell_spec(&fracas_shape_sphere), 5, 7);
        fracas_surface_operator *op = open_operator(model);
        const size_t n = unknowns_of(model);
        OWNED double *u = vector_of(n), *f = vector_of(n);
        double stiffness = 0, worst = 0;
        for (size_t i = 0; i < SHELL_UNKNOWNS; i++) {
            u[n / SHELL_UNKNOWNS / 2 * SHELL_UNKNOWNS + i] = 1;
            apply_stiffness(model, op, u, f);
            u[n / SHELL_UNKNOWNS / 2 * SHELL_UNKNOWNS + i] = 0;
            stiffness = fmax(stiffness, largest_of(f, n));
        }
        for (int motion = 0; motion < 6; motion++) {
            double how[6] = {0};
            how[motion] = 1;
            interpolate(model, rigid, how, u);
            apply_stiffness(model, op, u, f);
            worst = fmax(worst, largest_of(f, n) / (stiffness * largest_of(u, n)));
        }
        print_message("%s: %zu elements, forces of rigid motions within %.1e of max|K| max|u|\n",
                      body_name[which], model->elements, worst);
        assert_true(worst < 1e-14);
        fracas_surface_operator_close(op);
    }
}

/* ---- uniform states of a plate ---- */

/* u1, u2 linear: du_i/dx_j; u3 quadratic: its second derivatives xx, yy, xy. */
typedef struct {
    double g[2][2], second[3];
} uniform_state;

static void uniform_at(const void *how, const double x[3], double u[3])
{
    const uniform_state *s = how;
    for (int i = 0; i < 2; i++) u[i] = s->g[i][0] * x[0] + s->g[i][1] * x[1];
    u[2] = 0.5 * (s->second[0] * x[0] * x[0] + s->second[1] * x[1] * x[1]) +
           s->second[2] * x[0] * x[1] + 0.3 * x[0] - 0.2 * x[1];
}

/* n and m of a state, by hand. */
static void resultants(const fracas_spec *spec, const uniform_state *s, double n[3], double m[3])
{
    const double nu = spec->material.poisson, h = spec->geometry.thickness,
                 c = spec->material.young * h / (1 - nu * nu), d = c * h * h / 12;
    n[0] = c * (s->g[0][0] + nu * s->g[1][1]);
    n[1] = c * (s->g[1][1] + nu * s->g[0][0]);
    n[2] = c * (1 - nu) / 2 * (s->g[0][1] + s->g[1][0]);
    m[0] = -d * (s->second[0] + nu * s->second[1]);
    m[1] = -d * (s->second[1] + nu * s->second[0]);
    m[2] = -d * (1 - nu) * s->second[2];
}

/* What the rest of the world does to the edges: int v.n.N - m_nj dv3/dx_j, v each node's shape
 * function. A rule of 3 points is exact for straight edges. */
static void edge_forces(const fracas_model *model, const double n[3], const double m[3], double *f)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(3);
    for (size_t b = 0; b < model->surface->nborders; b++) {
        const fracas_surface_border *border = &model->surface->border[b];
        const double *from = node_at(model, border->element, border->edge),
                     *to = node_at(model, border->element, (border->edge + 1) % 3);
        const double length = hypot(to[0] - from[0], to[1] - from[1]),
                     nx = (to[1] - from[1]) / length, ny = -(to[0] - from[0]) / length;
        for (size_t g = 0; g < 3; g++) {
            double s, weight, xi, eta;
            fracas_shell_geometry at;
            gsl_integration_glfixed_point(0, 1, g, &s, &weight, rule);
            fracas_shell_edge_point(border->edge, s, &xi, &eta);
            fracas_shell_geometry_at(model->surface, border->element, xi, eta, &at);
            weight *= length;
            for (size_t k = 0; k < SHELL_NODES; k++) {
                double by[2], *to_node = f + border->element * SHELL_UNKNOWNS + 3 * k;
                for (int i = 0; i < 2; i++)
                    by[i] = at.dual[0][i] * at.slope[k][0] + at.dual[1][i] * at.slope[k][1];
                to_node[0] += weight * at.shape[k] * (n[0] * nx + n[2] * ny);
                to_node[1] += weight * at.shape[k] * (n[2] * nx + n[1] * ny);
                to_node[2] -= weight *
                              ((m[0] * nx + m[2] * ny) * by[0] + (m[2] * nx + m[1] * ny) * by[1]);
            }
        }
    }
    gsl_integration_glfixed_table_free(rule);
}

/* Quadratic displacements have no jumps, and uniform resultants are in balance: the forces are
 * those of the edges, and the energy is the density times the area. Round-off: of stretching, the
 * terms K_ij u_j are (size/h_s) beta = 100 times the forces of edges, and some 100 of them add up
 * at random: 1e-13. Of bending they are (size/h_s)^2 beta = 5000 times those, and more where the
 * state is a twist, whose forces are the smaller by 1 - nu: 2e-11 at the most; 1e-10. */
static void uniform_states_are_exact(void **unused)
{
    const uniform_state states[] = {{{{1, 0}, {0, 0}}, {0}},
                                    {{{0, 0}, {0, 1}}, {0}},
                                    {{{0, 2}, {-1, 0}}, {0}},
                                    {{{0}}, {1, 0, 0}},
                                    {{{0}}, {0, 1, 0}},
                                    {{{0}}, {0, 0, 1}},
                                    {{{1, 2}, {3, -1}}, {2, -1, 3}}};
    for (size_t k = 0; k < sizeof states / sizeof *states; k++) {
        OWN(fracas_model) model = body_of(PLATE, shell_spec(&fracas_shape_file), 6, 5 + k);
        fracas_surface_operator *op = open_operator(model);
        const size_t size = unknowns_of(model);
        OWNED double *u = vector_of(size), *f = vector_of(size), *expected = vector_of(size);
        double n[3], m[3], worst = 0;
        const uniform_state *s = &states[k];
        resultants(&model->spec, s, n, m);
        interpolate(model, uniform_at, s, u);
        apply_stiffness(model, op, u, f);
        edge_forces(model, n, m, expected);
        for (size_t i = 0; i < size; i++) worst = fmax(worst, fabs(f[i] - expected[i]));
        const double density = 0.5 * (n[0] * s->g[0][0] + n[1] * s->g[1][1] +
                                      n[2] * (s->g[0][1] + s->g[1][0]) - m[0] * s->second[0] -
                                      m[1] * s->second[1] - 2 * m[2] * s->second[2]);
        const double energy = 0.5 * dot_of(u, f, size) / (1.2 * density) - 1;
        print_message("state %zu: forces within %.1e of the largest, energy %+.1e\n", k,
                      worst / largest_of(expected, size), energy);
        assert_true(worst < (m[0] == 0 && m[2] == 0 ? 1e-13 : 1e-10) * largest_of(expected, size));
        assert_true(fabs(energy) < 1e-12);
        fracas_surface_operator_close(op);
    }
}

TESTS(rigid_motions_give_no_force, uniform_states_are_exact)
