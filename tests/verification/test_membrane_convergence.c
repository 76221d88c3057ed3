/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Manufactured solutions: how fast the membrane's errors fall with the size of its elements.
 */
#include "tests/support/membrane_elastic.h"

#include "engine/element/triangle.h"
#include "tests/support/test.h"

#include <gsl/gsl_fit.h>

#define SMALL 1e-6 /* m, of the displacements */
#define P 260.0    /* 1/m: half a wave over the plate and more */
#define Q 330.0

/* u = (sin(P x + 0.2) cos(Q y - 0.1), 0.8 cos(P x + 0.5) sin(Q y + 0.3)) */
static void exact(const void *unused, const double x[2], double u[2])
{
    (void)unused;
    u[0] = SMALL * sin(P * x[0] + 0.2) * cos(Q * x[1] - 0.1);
    u[1] = 0.8 * SMALL * cos(P * x[0] + 0.5) * sin(Q * x[1] + 0.3);
}

/* -div sigma of it: -C (u_i,ii + nu u_j,ij + (1 - nu)/2 (u_i,jj + u_j,ij)) */
static void body_force(const fracas_material *m, const double x[2], double f[2])
{
    const double nu = m->poisson, c = m->young / (1 - nu * nu), shear = (1 - nu) / 2;
    double u[2];
    exact(NULL, x, u);
    const double u0_xy = -SMALL * P * Q * cos(P * x[0] + 0.2) * sin(Q * x[1] - 0.1);
    const double u1_xy = -0.8 * SMALL * P * Q * sin(P * x[0] + 0.5) * cos(Q * x[1] + 0.3);
    f[0] = c * (P * P * u[0] + shear * Q * Q * u[0] - (nu + shear) * u1_xy);
    f[1] = c * (Q * Q * u[1] + shear * P * P * u[1] - (nu + shear) * u0_xy);
}

/* ---- solving K u = f ---- */

/* Conjugate gradients on what is not held, preconditioned by the masses' diagonal; u holds the
 * start. */
static void solve(const fracas_model *model, const double *f, double *u)
{
    const size_t n = unknowns_of(model), nodes = model->surface->corners;
    const fracas_surface_tables *t = tables_of(model);
    fracas_surface_operator *op = open_operator(model);
    OWNED double *r = vector_of(n), *z = vector_of(n), *p = vector_of(n), *kp = vector_of(n);
    double before = 1, first = 0;
    apply_stiffness(model, op, u, r);
    for (size_t i = 0; i < n; i++) r[i] = is_held(model, i) ? 0 : f[i] - r[i];
    for (int step = 0; step < 20000; step++) {
        for (size_t i = 0; i < n; i++)
            z[i] = r[i] * t->lumped[i / (2 * nodes) * 2 * nodes + i / 2 % nodes];
        const double now = dot_of(r, z, n);
        if (step == 0) first = now;
        if (now <= 1e-24 * first) break; /* the error's norm has fallen by 1e-12 */
        for (size_t i = 0; i < n; i++) p[i] = z[i] + (step ? now / before : 0) * p[i];
        before = now;
        apply_stiffness(model, op, p, kp);
        const double length = now / dot_of(p, kp, n);
        for (size_t i = 0; i < n; i++) {
            u[i] += length * p[i];
            r[i] -= length * kp[i];
        }
        assert_true(step < 19999);
    }
    fracas_surface_operator_close(op);
}

/* f = int N b h dA; L2 norm of u - exact: both by the rule of degree 6. */
static void load(const fracas_model *model, double *f)
{
    const size_t nodes = model->surface->corners;
    for (size_t e = 0; e < model->elements; e++)
        for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
            const double *rule = fracas_triangle_fine[g];
            const membrane_place p = place_at(model, e, rule[0], rule[1]);
            double b[2];
            body_force(&model->spec.material, p.x, b);
            for (size_t k = 0; k < nodes; k++)
                for (size_t i = 0; i < 2; i++)
                    f[2 * (nodes * e + k) + i] += rule[2] * p.det * model->spec.geometry.thickness *
                                                  p.shape.value[k] * b[i];
        }
}

static double miss(const fracas_model *model, const double *u)
{
    const size_t nodes = model->surface->corners;
    double sum = 0, scale = 0;
    for (size_t e = 0; e < model->elements; e++)
        for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
            const double *rule = fracas_triangle_fine[g];
            const membrane_place p = place_at(model, e, rule[0], rule[1]);
            double want[2];
            exact(NULL, p.x, want);
            for (size_t i = 0; i < 2; i++) {
                double have = 0;
                for (size_t k = 0; k < nodes; k++)
                    have += p.shape.value[k] * u[2 * (nodes * e + k) + i];
                sum += rule[2] * p.det * (have - want[i]) * (have - want[i]);
                scale += rule[2] * p.det * want[i] * want[i];
            }
        }
    return sqrt(sum / scale);
}

static void hold_all(fracas_spec *spec, const fracas_kind *edge)
{
    for (int tag = 0; tag < FRACAS_EDGES; tag++) spec->geometry.edge[tag] = edge;
}

/* Relative L2 error of one mesh, and the mean size of its elements. */
static double static_error(fracas_spec spec, double distortion, double *size)
{
    hold_all(&spec, &fracas_edge_held);
    spec.material.poisson = 0.22;
    OWN(fracas_model) model = distorted_model(spec, distortion, (uint64_t)spec.mesh.divisions);
    const size_t n = unknowns_of(model);
    OWNED double *u = vector_of(n), *f = vector_of(n);
    interpolate(model, exact, NULL, u);
    for (size_t i = 0; i < n; i++)
        if (!is_held(model, i)) u[i] = 0;
    load(model, f);
    solve(model, f, u);
    const double error = miss(model, u);
    *size = 1 / sqrt((double)model->elements);
    return error;
}

/* Slope of log error by log size, by least squares. */
static double slope_of(const double *size, const double *error, size_t count)
{
    double x[8], y[8], intercept, slope, unused[4];
    for (size_t i = 0; i < count; i++) {
        x[i] = log(size[i]);
        y[i] = log(error[i]);
    }
    gsl_fit_linear(x, 1, y, 1, count, &intercept, &slope, &unused[0], &unused[1], &unused[2],
                   &unused[3]);
    return slope;
}

/* The theory's k + 1, less a tenth for meshes that are no multiples of each other. */
static void static_displacements_converge(void **unused)
{
    const struct {
        const fracas_kind *shape;
        int order;
        int64_t divisions[3];
        double slope;
    } cases[] = {{&fracas_shape_plate, 1, {8, 16, 32}, 1.9},
                 {&fracas_shape_plate, 2, {6, 12, 24}, 2.9},
                 {&fracas_shape_annulus, 2, {2, 4, 8}, 2.9}};
    for (size_t c = 0; c < 3; c++) {
        double size[3], error[3];
        for (int i = 0; i < 3; i++)
            error[i] = static_error(
                membrane_spec(cases[c].shape, cases[c].order, cases[c].divisions[i]), DISTORTION,
                &size[i]);
        const double slope = slope_of(size, error, 3);
        print_message("%s, order %d: errors %.2e %.2e %.2e, slope %.3f\n", cases[c].shape->name,
                      cases[c].order, error[0], error[1], error[2], slope);
        assert_true(slope > cases[c].slope);
    }
}

/* ---- standing waves ---- */

/* The slowest motion of a plate of which all edges slide: u = (psi,y, -psi,x), psi = sin(a x) sin(b
 * y) from a corner, a = pi/width, b = pi/height: shear alone, w = c_s sqrt(a^2 + b^2), and no shear
 * stress at the edges. */
typedef struct {
    double a, b, x, y; /* 1/m, m: the corner */
} wave;

static void wave_at(const void *how, const double x[2], double u[2])
{
    const wave *w = how;
    u[0] = w->b * sin(w->a * (x[0] - w->x)) * cos(w->b * (x[1] - w->y));
    u[1] = -w->a * cos(w->a * (x[0] - w->x)) * sin(w->b * (x[1] - w->y));
}

/* w^2 by w^2 of the exact wave, less 1: inverse iteration from the exact shape. What that differs
 * by from the mesh's own is of the order k + 1, and its square counts, 2 k + 2: less than what is
 * looked for, 2 k at best. Each turn takes most of it away, all but what moves nearly as slowly;
 * four are enough. */
static double frequency_error(int64_t order, int64_t divisions, const fracas_kind *mass,
                              double *size)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, order, divisions);
    spec.material.poisson = 0.22;
    spec.time.mass = mass;
    hold_all(&spec, &fracas_edge_sliding);
    OWN(fracas_model) model = distorted_model(spec, DISTORTION, (uint64_t)divisions);
    const fracas_geometry *g = &spec.geometry;
    const wave exact_wave = {PI / g->width, PI / g->height, -0.5 * g->width, -0.5 * g->height};
    const double shear = spec.material.young /
                         (2 * (1 + spec.material.poisson) * spec.material.density);
    const double square = shear * (exact_wave.a * exact_wave.a + exact_wave.b * exact_wave.b);
    const size_t n = unknowns_of(model);
    OWNED double *u = vector_of(n), *f = vector_of(n), *momentum = vector_of(n);
    double quotient = 0;
    interpolate(model, wave_at, &exact_wave, u);
    for (int turn = 0; turn < 4; turn++) {
        for (size_t i = 0; i < n; i++) u[i] = is_held(model, i) ? 0 : u[i];
        multiply_mass(model, u, f);
        for (size_t i = 0; i < n; i++) f[i] = is_held(model, i) ? 0 : f[i] * square;
        solve(model, f, u);
        multiply_mass(model, u, momentum);
        quotient = dot_of(u, f, n) / (square * dot_of(u, momentum, n)); /* u.K u/(u.M u), K u = f */
    }
    *size = 1 / sqrt((double)model->elements);
    return quotient - 1;
}

/* 2 k with consistent masses, the theory of eigenvalues; 2 with lumped ones of either order: the
 * rule of Hinton, Rock and Zienkiewicz has 11/57 of the element's mass for int l^2, where 1/6 is
 * right, so that it is exact to degree 1 alone. Less a twentieth, as slopes are those of the last
 * term but for the next one. */
static void frequencies_converge(void **unused)
{
    const struct {
        int order;
        const fracas_kind *mass;
        int64_t divisions[3];
        double slope;
    } cases[] = {{1, &fracas_mass_lumped, {8, 16, 32}, 1.9},
                 {1, &fracas_mass_consistent, {8, 16, 32}, 1.9},
                 {2, &fracas_mass_lumped, {6, 12, 24}, 1.9},
                 {2, &fracas_mass_consistent, {4, 8, 16}, 3.8}};
    for (size_t c = 0; c < 4; c++) {
        double size[3], error[3];
        for (int i = 0; i < 3; i++)
            error[i] = frequency_error(cases[c].order, cases[c].divisions[i], cases[c].mass,
                                       &size[i]);
        print_message("order %d, %s masses: w^2 off by %+.2e %+.2e %+.2e", cases[c].order,
                      cases[c].mass->name, error[0], error[1], error[2]);
        for (int i = 0; i < 3; i++) error[i] = fabs(error[i]);
        const double slope = slope_of(size, error, 3);
        print_message(", slope %.3f\n", slope);
        assert_true(slope > cases[c].slope);
    }
}

TESTS(static_displacements_converge, frequencies_converge)
