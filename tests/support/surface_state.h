/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Membranes and shells alike: their unknowns, masses and states, K as an operator and as a matrix,
 * and runs of one lane. */
#ifndef FRACAS_TESTS_SUPPORT_SURFACE_STATE_H
#define FRACAS_TESTS_SUPPORT_SURFACE_STATE_H

#include "engine/formulation/surface/surface.h"
#include "tests/support/dense.h"
#include "tests/support/distorted_model.h"
#include "tests/support/gmsh.h"
#include "tests/support/surface.h"

/* Where the state has component i (dimension node + component) of SURFACE_U, ... of an element. */
static inline double *surface_value(const fracas_model *model, const fracas_step *step,
                                    size_t element, int field, int i, int lane)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const size_t at = element * fracas_surface_element_fields(&c) +
                      (size_t)field * fracas_surface_unknowns(c.tables) + (size_t)i;
    return fracas_surface_field(step, at, lane);
}

/* Where it has a value of the law, SURFACE_DAMAGE, ..., at point p of an interface: layers of its
 * first Gauss point, of its second, ... */
static inline double *surface_point(const fracas_model *model, const fracas_step *step,
                                    size_t interface, int p, int field, int lane)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const size_t at = fracas_surface_interfaces_at(&c) +
                      interface * fracas_surface_interface_fields(&c);
    return fracas_surface_field(step, at + (size_t)(p * c.point_fields + field), lane);
}

/* Breaks an interface of lane 0 at all its points. */
static inline void break_interface(const fracas_batch *batch, size_t interface)
{
    for (size_t p = 0; p < fracas_surface_points(batch->model->plan); p++)
        *surface_point(batch->model, &batch->step, interface, (int)p, SURFACE_DAMAGE, 0) = 1;
}

#define PI 3.14159265358979323846
#define DISTORTION 0.2

static inline fracas_surface_tables *tables_of(const fracas_model *model)
{
    return model->plan;
}

/* Unknowns of an element, and of the body. */
static inline size_t element_unknowns(const fracas_model *model)
{
    return fracas_surface_unknowns(tables_of(model));
}

static inline size_t unknowns_of(const fracas_model *model)
{
    return element_unknowns(model) * model->elements;
}

static inline const double *node_at(const fracas_model *model, size_t element, size_t k)
{
    return model->surface->node[model->surface->element[element * model->surface->corners + k]];
}

/* x of an unknown's node. */
static inline const double *place_of(const fracas_model *model, size_t unknown)
{
    const size_t size = element_unknowns(model);
    return node_at(model, unknown / size,
                   unknown % size / (size_t)tables_of(model)->body->dimension);
}

static inline bool is_held(const fracas_model *model, size_t unknown)
{
    const size_t size = element_unknowns(model);
    const fracas_surface_tables *t = tables_of(model);
    return t->held && (t->held[unknown / size] >> (unknown % size) & 1);
}

/* The lumped mass of an unknown's node. */
static inline double mass_of(const fracas_model *model, size_t unknown)
{
    const size_t size = element_unknowns(model), nodes = model->surface->corners;
    return tables_of(model)->lumped[(2 * (unknown / size) + 1) * nodes +
                                    unknown % size / (size_t)tables_of(model)->body->dimension];
}

/* M_kl of an element's nodes: its lumped masses on the diagonal, or the consistent matrix. */
static inline double mass_between(const fracas_model *model, size_t e, size_t k, size_t l)
{
    const fracas_surface_tables *t = tables_of(model);
    const size_t nodes = model->surface->corners;
    if (t->consistent) return t->consistent[((3 * e + 2) * nodes + k) * nodes + l];
    return k == l ? t->lumped[(2 * e + 1) * nodes + k] : 0;
}

/* Where lane 0 has component i (dimension node + component) of an element's SURFACE_U, ... */
static inline double *value_at(const fracas_batch *batch, size_t e, int field, size_t i)
{
    return surface_value(batch->model, &batch->step, e, field, (int)i, 0);
}

static inline double *value_of(const fracas_batch *batch, size_t unknown, int field)
{
    const size_t size = element_unknowns(batch->model);
    return value_at(batch, unknown / size, field, unknown % size);
}

/* Displacements at a place. */
typedef void displacement_field(const void *how, const double *x, double *u);

static inline void interpolate(const fracas_model *model, displacement_field *field,
                               const void *how, double *u)
{
    for (size_t i = 0; i < unknowns_of(model); i += (size_t)tables_of(model)->body->dimension)
        field(how, place_of(model, i), u + i);
}

/* N_k, their first and second derivatives by xi, eta (xi xi, eta eta, xi eta), from products of
 * barycentric coordinates. */
typedef struct {
    double value[6], first[6][2], second[6][3];
} surface_shape;

static inline surface_shape shape_at(size_t nodes, double xi, double eta)
{
    const double l[3] = {1 - xi - eta, xi, eta}, d[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
    surface_shape s;
    for (size_t k = 0; k < nodes; k++) { /* c l_a l_b + e l_a */
        const size_t a = k % 3, b = k < 3 ? k : (k + 1) % 3;
        const double c = nodes == 3 ? 0 : k < 3 ? 2 : 4, e = nodes == 3 ? 1 : k < 3 ? -1 : 0;
        s.value[k] = c * l[a] * l[b] + e * l[a];
        for (int i = 0; i < 2; i++)
            s.first[k][i] = c * (d[a][i] * l[b] + l[a] * d[b][i]) + e * d[a][i];
        for (int i = 0; i < 3; i++) {
            const int p = i == 1, q = i != 0;
            s.second[k][i] = c * (d[a][p] * d[b][q] + d[a][q] * d[b][p]);
        }
    }
    return s;
}

/* xi, eta at s along an edge, from its first vertex. */
static inline void on_edge(size_t edge, double s, double at[2])
{
    const double corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    for (int i = 0; i < 2; i++) at[i] = (1 - s) * corner[edge][i] + s * corner[(edge + 1) % 3][i];
}

/* The model of a surface as a mesh file. */
static inline fracas_model *mesh_model(fracas_spec spec, const fracas_surface *surface)
{
    gmsh_file file = gmsh_write(surface, false, true, false);
    const fracas_attachment mesh = {.path = "mesh", .text = file.bytes, .size = file.size};
    spec.geometry.shape = &fracas_shape_file;
    spec.geometry.file = &mesh;
    spec.mesh = (fracas_mesh){.spacing = &fracas_spacing_given};
    fracas_model *model = distorted_model(spec, 0, 0);
    model->spec.geometry.file = NULL; /* it is gone */
    free(file.bytes);
    return model;
}

/* ---- K ---- */

static inline fracas_surface_operator *open_operator(const fracas_model *model)
{
    fracas_surface_operator *op = NULL;
    OK(fracas_surface_operator_open(model, 0, &op));
    return op;
}

/* result += t R (t . a) of an element with rotary inertia */
static inline void add_turning(const double *table, const double *a, double *result)
{
    const double *t = table + SURFACE_TURNING, *r = table + SURFACE_ROTARY;
    for (int k = 0, at = 0; k < 6; k++)
        for (int l = 0; l <= k; l++, at++)
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    result[3 * k + i] += t[i] * r[at] * t[j] * a[3 * l + j];
                    if (k != l) result[3 * l + i] += t[i] * r[at] * t[j] * a[3 * k + j];
                }
}

/* result = M a */
static inline void multiply_mass(const fracas_model *model, const double *a, double *result)
{
    const size_t nodes = model->surface->corners, size = element_unknowns(model),
                 dimension = size / nodes;
    const bool consistent = tables_of(model)->consistent;
    for (size_t i = 0; i < unknowns_of(model); i++) {
        const size_t e = i / size, k = i % size / dimension;
        result[i] = consistent ? 0 : mass_of(model, i) * a[i];
        for (size_t l = 0; consistent && l < nodes; l++)
            result[i] += mass_between(model, e, k, l) * a[e * size + l * dimension + i % dimension];
    }
    const double *rotary = tables_of(model)->rotary;
    for (size_t e = 0; rotary && e < model->elements; e++)
        add_turning(rotary + e * SURFACE_ROTARY_TABLE, a + 18 * e, result + 18 * e);
}

/* f = K u [N], 0 where nodes are held. */
static inline void apply_stiffness(const fracas_model *model, fracas_surface_operator *op,
                                   const double *u, double *f)
{
    const size_t n = unknowns_of(model);
    OWNED double *a = vector_of(n);
    fracas_surface_operator_apply(op, u, a);
    multiply_mass(model, a, f);
    for (size_t i = 0; i < n; i++) f[i] = is_held(model, i) ? 0 : -f[i];
}

/* K as a matrix, [n][n]: column j is the force of a unit displacement j. */
static inline double *stiffness_matrix(const fracas_model *model, size_t n)
{
    fracas_surface_operator *op = open_operator(model);
    OWNED double *unit = vector_of(n), *column = vector_of(n);
    double *matrix = vector_of(n * n);
    for (size_t j = 0; j < n; j++) {
        unit[j] = 1;
        apply_stiffness(model, op, unit, column);
        unit[j] = 0;
        for (size_t i = 0; i < n; i++) matrix[i * n + j] = column[i];
    }
    fracas_surface_operator_close(op);
    return matrix;
}

/* By how much K misses `expected`, and how far it is from symmetric, where nothing is held; by its
 * largest entry. */
static inline void compare_matrix(const fracas_model *model, const double *expected, double *miss,
                                  double *skew)
{
    const size_t n = unknowns_of(model);
    OWNED double *got = stiffness_matrix(model, n);
    const double largest = largest_of(got, n * n);
    *miss = *skew = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            if (is_held(model, i) || is_held(model, j)) continue;
            *miss = fmax(*miss, fabs(got[i * n + j] - expected[i * n + j]) / largest);
            *skew = fmax(*skew, fabs(got[i * n + j] - got[j * n + i]) / largest);
        }
}

/* Eigenvalues omega^2 of M^-1/2 K M^-1/2, ascending; the matrix becomes that product. */
static inline double *squares_of_frequencies(const fracas_model *model, double *matrix, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            matrix[i * n + j] /= sqrt(mass_of(model, i) * mass_of(model, j));
    return eigenvalues_of(matrix, n);
}

/* One step from displacements up to 0.5e-9 and velocities up to `speed`/2 at random: the kick is
 * that of the operator, the elastic energy u.K u/2, the kinetic one v.M v'/2 with the velocities
 * before and after. Sums of n terms: 1e-12 by the largest. */
static inline void check_first_step(fracas_model *model, int width, double strength, double speed)
{
    one_run run = begin_run(model, width, strength);
    const size_t n = unknowns_of(model);
    OWNED double *u = vector_of(n), *v = vector_of(n), *f = vector_of(n), *a = vector_of(n),
                 *momentum = vector_of(n);
    uint64_t noise = 3;
    for (size_t i = 0; i < n; i++) {
        u[i] = is_held(model, i) ? 0 : 1e-9 * (next_share(&noise) - 0.5);
        v[i] = is_held(model, i) ? 0 : speed * (next_share(&noise) - 0.5);
        *value_of(run.batch, i, SURFACE_U) = u[i];
        *value_of(run.batch, i, SURFACE_V) = v[i];
    }
    fracas_surface_operator *op = open_operator(model);
    fracas_surface_operator_apply(op, u, a);
    apply_stiffness(model, op, u, f);
    multiply_mass(model, v, momentum);
    step_run(&run);
    const fracas_step *step = &run.batch->step;
    const double kick = step->kick[0], elastic = 0.5 * dot_of(u, f, n);
    double worst = 0, kinetic = 0;
    for (size_t i = 0; i < n; i++) {
        worst = fmax(worst, fabs(*value_of(run.batch, i, SURFACE_V) - v[i] - kick * a[i]));
        kinetic += 0.5 * momentum[i] * (v[i] + kick * a[i]);
    }
    assert_true(kick > 0 && elastic > 0);
    assert_true(worst <= 1e-12 * (kick * largest_of(a, n) + largest_of(v, n)));
    assert_true(fabs(step->elastic[0] / elastic - 1) < 1e-12);
    assert_true(fabs(step->kinetic[0] - kinetic) < 1e-12 * fabs(kinetic));
    fracas_surface_operator_close(op);
    clear_run(&run);
}

/* ---- momenta ---- */

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross3(const double a[3], const double b[3], double c[3])
{
    const double r[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    memcpy(c, r, sizeof r);
}

/* Sums over nodes: M v, X x M v with X at the start, and of their sizes. */
typedef struct {
    double momentum[3], moment[3], size, turned;
} surface_momenta;

static inline surface_momenta momenta_of(const fracas_batch *batch)
{
    const size_t n = unknowns_of(batch->model),
                 dimension = (size_t)tables_of(batch->model)->body->dimension;
    OWNED double *v = vector_of(n), *p = vector_of(n);
    surface_momenta s = {.size = 0};
    for (size_t i = 0; i < n; i++) v[i] = *value_of(batch, i, SURFACE_V);
    multiply_mass(batch->model, v, p);
    for (size_t at = 0; at < n; at += dimension) {
        double here[3] = {0}, moment[3];
        memcpy(here, p + at, dimension * sizeof *p);
        cross3(place_of(batch->model, at), here, moment);
        for (int i = 0; i < 3; i++) {
            s.momentum[i] += here[i];
            s.moment[i] += moment[i];
            s.size += fabs(here[i]);
            s.turned += fabs(moment[i]);
        }
    }
    return s;
}

/* Runs a batch that has begun to its end, with this drift [m/s] and spin [1/s] on top of its
 * velocities: both momenta stay what they are then, to 1e-12 of their sums of sizes, there is some
 * of each spin, and the record has the momentum. Returns it as it started. */
static inline surface_momenta check_momenta(fracas_batch *batch, const double drift[3],
                                            const double spin[3], fracas_record *record)
{
    const size_t dimension = (size_t)tables_of(batch->model)->body->dimension;
    for (size_t at = 0; at < unknowns_of(batch->model); at += dimension) {
        double turned[3];
        cross3(spin, place_of(batch->model, at), turned);
        for (size_t i = 0; i < dimension; i++)
            *value_of(batch, at + i, SURFACE_V) += drift[i] + turned[i];
    }
    const surface_momenta before = momenta_of(batch);
    surface_momenta now = before;
    double worst = 0, turn = 0;
    for (size_t running = 1; running > 0;) {
        OK(fracas_batch_step(batch, record, &running));
        now = momenta_of(batch);
        for (int i = 0; i < 3; i++) {
            worst = fmax(worst, fabs(now.momentum[i] - before.momentum[i]) / before.size);
            turn = fmax(turn, fabs(now.moment[i] - before.moment[i]) / before.turned);
        }
    }
    print_message("%zu elements, %lld steps, %lld fragments, momentum within %.1e, moment of "
                  "momentum within %.1e\n",
                  batch->model->elements, (long long)record->steps, (long long)record->fragments,
                  worst, turn);
    assert_true(record->fragments > 3 && worst < 1e-12 && turn < 1e-12);
    for (int i = 0; i < 3; i++) {
        assert_true(spin[i] == 0 || fabs(now.moment[i]) > 1e-3 * now.turned);
        assert_true(fabs(record->momentum[i] - before.momentum[i]) < 1e-12 * before.size);
    }
    return before;
}

#endif
