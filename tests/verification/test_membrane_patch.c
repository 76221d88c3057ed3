/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane's operator on distorted meshes: uniform strain, rigid motions, its matrix against
 * the bilinear form written down anew, its eigenvalues, masses and critical step. */
#include "tests/support/membrane_elastic.h"
#include "tests/support/test.h"

#include <gsl/gsl_integration.h>

/* Those of body_of, and a plate of quadratic triangles of which no edge is straight. */
enum { BENT = BODIES, ALL_BODIES };

/* That plate: a map bends the nodes of a distorted one. */
static fracas_model *bent_plate(int64_t divisions, uint64_t seed)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 2, divisions);
    OWN(fracas_model) flat = distorted_model(spec, DISTORTION, seed);
    fracas_surface bent = *flat->surface;
    double(*node)[3] = taken(bent.nnodes * sizeof *node);
    for (size_t n = 0; n < bent.nnodes; n++) {
        const double *x = bent.node[n];
        node[n][0] = x[0] + 0.4e-3 * sin(400 * x[1] + 1);
        node[n][1] = x[1] + 0.3e-3 * cos(500 * x[0]);
        node[n][2] = 0;
    }
    bent.node = (const double(*)[3])node;
    fracas_model *model = mesh_model(spec, &bent);
    free(node);
    return model;
}

static fracas_model *distorted(int which, int64_t divisions, uint64_t seed)
{
    return which == BENT ? bent_plate(divisions, seed)
                         : distorted_model(body_of(which, divisions), DISTORTION, seed);
}

/* u = g x + c, g = du_i/dx_j */
typedef struct {
    double g[2][2], c[2];
} linear_field;

static void linear_at(const void *how, const double x[2], double u[2])
{
    const linear_field *f = how;
    for (int i = 0; i < 2; i++) u[i] = f->c[i] + f->g[i][0] * x[0] + f->g[i][1] * x[1];
}

/* Force of a uniform stress on the nodes of the boundary: int N n.sigma h ds, by Gauss' rule of 4
 * points, exact to degree 7. */
static void tractions(const fracas_model *model, const double stress[3], double *f)
{
    const size_t nodes = model->surface->corners;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(4);
    for (size_t b = 0; b < model->surface->nborders; b++) {
        const fracas_surface_border *border = &model->surface->border[b];
        for (size_t g = 0; g < 4; g++) {
            double s, weight, at[2], n[2];
            gsl_integration_glfixed_point(0, 1, g, &s, &weight, rule);
            on_edge(border->edge, s, at);
            edge_normal(model, border->element, border->edge, s, n);
            const membrane_place p = place_at(model, border->element, at[0], at[1]);
            weight *= model->spec.geometry.thickness;
            for (size_t k = 0; k < nodes; k++) {
                f[2 * (nodes * border->element + k)] += weight * p.shape.value[k] *
                                                        (stress[0] * n[0] + stress[2] * n[1]);
                f[2 * (nodes * border->element + k) + 1] += weight * p.shape.value[k] *
                                                            (stress[2] * n[0] + stress[1] * n[1]);
            }
        }
    }
    gsl_integration_glfixed_table_free(rule);
}

/* Forces are sums of some 50 terms as large as the largest force by the ratio of the body to an
 * element, about 10 (u is as large as the body's size lets it, and its differences over an element
 * are taken): 50 x 10 x 1.1e-16 = 6e-14 of it; 1e-12. Isoparametric elements with a bent edge pass
 * as well: their shape functions' derivatives by their Jacobian's cofactors are of degree 2, which
 * the bulk's rule integrates, and edges' integrands are of degree 3. */
static void uniform_strain_is_exact(void **unused)
{
    const linear_field fields[] = {{{{1e-3, 0}, {0, 0}}, {0}},
                                   {{{0, 0}, {0, 1e-3}}, {0}},
                                   {{{0, 1e-3}, {1e-3, 0}}, {0}},
                                   {{{2e-3, -1e-3}, {3e-3, 1e-3}}, {1e-6, -2e-6}}};
    for (int which = 0; which < ALL_BODIES; which++)
        for (size_t f = 0; f < 4; f++) {
            OWN(fracas_model) model = distorted(which, 6, 5 + f);
            fracas_surface_operator *op = open_operator(model);
            const size_t n = unknowns_of(model);
            OWNED double *u = vector_of(n), *force = vector_of(n), *expected = vector_of(n);
            double stress[3], g[2][2], worst = 0;
            memcpy(g, fields[f].g, sizeof g);
            hooke(&model->spec.material, g, stress);
            interpolate(model, linear_at, &fields[f], u);
            apply_stiffness(model, op, u, force);
            tractions(model, stress, expected);
            for (size_t i = 0; i < n; i++) worst = fmax(worst, fabs(force[i] - expected[i]));
            print_message("body %d, field %zu: %zu elements, forces within %.1e of the largest\n",
                          which, f, model->elements, worst / largest_of(expected, n));
            assert_true(worst < 1e-12 * largest_of(expected, n));
            fracas_surface_operator_close(op);
        }
}

/* No force at all: what remains is the round-off of K u, some 30 terms K_ij u_j of which none
 * exceeds max|K| max|u|: 4e-15 of that. */
static void rigid_motions_give_no_force(void **unused)
{
    const linear_field fields[] = {{{{0, 0}, {0, 0}}, {1e-3, 0}},
                                   {{{0, 0}, {0, 0}}, {0, 1e-3}},
                                   {{{0, -1e-2}, {1e-2, 0}}, {0}}};
    for (int which = 0; which < ALL_BODIES; which++) {
        OWN(fracas_model) model = distorted(which, 4, 11);
        fracas_surface_operator *op = open_operator(model);
        const size_t n = unknowns_of(model);
        OWNED double *u = vector_of(n), *force = vector_of(n);
        u[n / 2] = 1;
        apply_stiffness(model, op, u, force);
        const double stiffness = largest_of(force, n);
        for (size_t f = 0; f < 3; f++) {
            interpolate(model, linear_at, &fields[f], u);
            apply_stiffness(model, op, u, force);
            print_message("body %d, motion %zu: %.1e\n", which, f,
                          largest_of(force, n) / (stiffness * largest_of(u, n)));
            assert_true(largest_of(force, n) < 1e-14 * stiffness * largest_of(u, n));
        }
        fracas_surface_operator_close(op);
    }
}

/* ---- the matrix ---- */

/* Stress of an element's unit displacement `d` at a place, as interfaces see it: extrapolated from
 * the points l_g = 2/3 of quadratic triangles. Straight ones have it anywhere. */
static void stress_of(const fracas_model *model, size_t e, size_t d, const double at[2],
                      double stress[3])
{
    double u[12] = {0};
    u[d] = 1;
    if (model->surface->order == 1) {
        const membrane_place p = place_at(model, e, at[0], at[1]);
        stress_at(model, &p, u, stress);
        return;
    }
    const double place[3][2] = {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
    const double share[3] = {1 - at[0] - at[1], at[0], at[1]};
    stress[0] = stress[1] = stress[2] = 0;
    for (int g = 0; g < 3; g++) {
        double here[3];
        const membrane_place p = place_at(model, e, place[g][0], place[g][1]);
        stress_at(model, &p, u, here);
        for (int i = 0; i < 3; i++) stress[i] += (2 * share[g] - 1.0 / 3) * here[i];
    }
}

/* int eps : sigma: the rule of 3 points at l_g = 2/3 for quadratic triangles, exact for straight
 * ones. */
static void add_bulk(const fracas_model *model, size_t n, double *matrix)
{
    const size_t size = 2 * model->surface->corners, points = size == 6 ? 1 : 3;
    const double place[2][3][2] = {{{1.0 / 3, 1.0 / 3}},
                                   {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}}};
    for (size_t e = 0; e < model->elements; e++)
        for (size_t g = 0; g < points; g++) {
            const double *at = place[points / 3][g];
            const membrane_place p = place_at(model, e, at[0], at[1]);
            const double weight = 0.5 / (double)points * p.det * model->spec.geometry.thickness;
            for (size_t d = 0; d < size; d++) {
                double u[12] = {0}, stress[3];
                u[d] = 1;
                stress_at(model, &p, u, stress);
                for (size_t k = 0; k < size / 2; k++) {
                    matrix[(e * size + 2 * k) * n + e * size + d] +=
                        weight * (stress[0] * p.by[k][0] + stress[2] * p.by[k][1]);
                    matrix[(e * size + 2 * k + 1) * n + e * size + d] +=
                        weight * (stress[2] * p.by[k][0] + stress[1] * p.by[k][1]);
                }
            }
        }
}

static double area_of(const fracas_model *model, size_t e)
{
    double area = 0; /* the Jacobian is of degree 2: middles of the edges */
    const double middle[3][2] = {{0.5, 0}, {0.5, 0.5}, {0, 0.5}};
    for (int g = 0; g < 3; g++) area += place_at(model, e, middle[g][0], middle[g][1]).det / 6;
    return area;
}

static double length_of(const fracas_model *model, size_t e, size_t edge,
                        const gsl_integration_glfixed_table *rule)
{
    double length = 0;
    for (size_t g = 0; g < rule->n; g++) {
        double s, weight, normal[2];
        gsl_integration_glfixed_point(0, 1, g, &s, &weight, rule);
        edge_normal(model, e, edge, s, normal);
        length += weight * hypot(normal[0], normal[1]);
    }
    return length;
}

/* At one point of an interface, of each unknown of both elements: jump u+ - u- and mean traction.
 */
typedef struct {
    double jump[24][2], mean[24][2];
    size_t at[24]; /* row of the matrix */
} interface_point;

static void fill_point(const fracas_model *model, const fracas_surface_interface *it, double s,
                       const double normal[2], interface_point *p)
{
    const size_t size = 2 * model->surface->corners;
    for (size_t side = 0; side < 2; side++) {
        double at[2];
        on_edge(it->edge[side], side ? 1 - s : s,
                at); /* neighbours go along their edge in opposite directions */
        const membrane_place place = place_at(model, it->element[side], at[0], at[1]);
        for (size_t d = 0; d < size; d++) {
            double stress[3], *jump = p->jump[side * size + d], *mean = p->mean[side * size + d];
            stress_of(model, it->element[side], d, at, stress);
            jump[0] = jump[1] = 0;
            jump[d % 2] = (side ? 1 : -1) * place.shape.value[d / 2];
            mean[0] = 0.5 * (stress[0] * normal[0] + stress[2] * normal[1]);
            mean[1] = 0.5 * (stress[2] * normal[0] + stress[1] * normal[1]);
            p->at[side * size + d] = it->element[side] * size + d;
        }
    }
}

/* int <t(u)>.[v] + <t(v)>.[u] + K [u].[v], K = beta E/(1 - nu^2) (|e|/A- + |e|/A+)/2, by Gauss'
 * points: the engine's 2 and 3, which are exact where edges are straight. */
static void add_interfaces(const fracas_model *model, size_t n, double *matrix)
{
    const size_t both = 4 * model->surface->corners;
    const double nu = model->spec.material.poisson,
                 modulus = model->spec.material.young / (1 - nu * nu);
    const size_t points = (size_t)model->surface->order + 1;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(points);
    for (size_t i = 0; i < model->interfaces; i++) {
        const fracas_surface_interface *it = &model->surface->interface[i];
        const double length = length_of(model, it->element[0], it->edge[0], rule);
        const double k = model->spec.cohesive.beta * modulus * length *
                         (0.5 / area_of(model, it->element[0]) +
                          0.5 / area_of(model, it->element[1]));
        for (size_t g = 0; g < points; g++) {
            double s, weight, normal[2];
            interface_point p;
            gsl_integration_glfixed_point(0, 1, g, &s, &weight, rule);
            edge_normal(model, it->element[0], it->edge[0], s, normal);
            const double speed = hypot(normal[0], normal[1]),
                         unit[2] = {normal[0] / speed, normal[1] / speed};
            fill_point(model, it, s, unit, &p);
            weight *= speed * model->spec.geometry.thickness;
            for (size_t a = 0; a < both; a++)
                for (size_t b = 0; b < both; b++)
                    for (int c = 0; c < 2; c++)
                        matrix[p.at[a] * n + p.at[b]] += weight * (p.mean[b][c] * p.jump[a][c] +
                                                                   p.mean[a][c] * p.jump[b][c] +
                                                                   k * p.jump[a][c] * p.jump[b][c]);
        }
    }
    gsl_integration_glfixed_table_free(rule);
}

/* Entries sum some 20 terms as large as the largest: 1e-14 of that, 1e-12 as the theory asks. */
static void the_matrix_is_the_bilinear_form(void **unused)
{
    for (int which = 0; which < ALL_BODIES; which++) {
        OWN(fracas_model) model = distorted(which, which < 2 || which == BENT ? 3 : 1, 3);
        const size_t n = unknowns_of(model);
        OWNED double *expected = vector_of(n * n);
        double miss, skew;
        add_bulk(model, n, expected);
        add_interfaces(model, n, expected);
        compare_matrix(model, expected, &miss, &skew);
        print_message("body %d: %zu unknowns, within %.1e, symmetric to %.1e\n", which, n, miss,
                      skew);
        assert_true(miss < 1e-12 && skew < 1e-12);
    }
}

/* Three rigid motions, and nothing below: zeros are known to n 1.1e-16 of the largest eigenvalue,
 * 1e-13; the first elastic one is far above. */
static void only_rigid_motions_cost_no_energy(void **unused)
{
    for (int which = 0; which < BODIES; which++) {
        OWN(fracas_model) model = distorted_model(body_of(which, which < 2 ? 2 : 1), DISTORTION, 7);
        const size_t n = unknowns_of(model);
        OWNED double *matrix = stiffness_matrix(model, n), *value = eigenvalues_of(matrix, n);
        print_message("body %d: %.1e %.1e %.1e, then %.1e of the largest\n", which,
                      value[0] / value[n - 1], value[1] / value[n - 1], value[2] / value[n - 1],
                      value[3] / value[n - 1]);
        for (int i = 0; i < 3; i++) assert_true(fabs(value[i]) < 1e-13 * value[n - 1]);
        assert_true(value[3] > 1e-6 * value[n - 1]);
    }
}

/* ---- masses ---- */

/* Of straight triangles: a third each of order 1; of order 2 1/19 at corners, 16/57 at middles; and
 * int N_k N_l, by A/12 or A/180 (textbook). Ratios of sums of 12 points: 1e-13. The inverse, times
 * M, is 1: its condition is below 100. */
static void masses_are_those_of_the_textbook(void **unused)
{
    static const double linear[3][3] = {{2, 1, 1}, {1, 2, 1}, {1, 1, 2}};
    static const double quadratic[6][6] = {{6, -1, -1, 0, -4, 0},  {-1, 6, -1, 0, 0, -4},
                                           {-1, -1, 6, -4, 0, 0},  {0, 0, -4, 32, 16, 16},
                                           {-4, 0, 0, 16, 32, 16}, {0, -4, 0, 16, 16, 32}};
    for (int order = 1; order <= 2; order++) {
        fracas_spec spec = membrane_spec(&fracas_shape_plate, order, 3);
        spec.time.mass = &fracas_mass_consistent;
        OWN(fracas_model) model = distorted_model(spec, DISTORTION, 4);
        const fracas_surface_tables *t = tables_of(model);
        const size_t nodes = model->surface->corners;
        for (size_t e = 0; e < model->elements; e++) {
            const double mass = spec.material.density * spec.geometry.thickness * area_of(model, e);
            const double *all = t->consistent + 3 * nodes * nodes * e, *m = all + 2 * nodes * nodes;
            for (size_t k = 0; k < nodes; k++) {
                const double share = order == 1 ? 1.0 / 3 : k < 3 ? 1.0 / 19 : 16.0 / 57;
                assert_true(fabs(t->lumped[(2 * e + 1) * nodes + k] / (share * mass) - 1) < 1e-13);
                assert_true(fabs(t->lumped[2 * e * nodes + k] * share * mass - 1) < 1e-13);
                for (size_t l = 0; l < nodes; l++) {
                    const double entry = order == 1 ? linear[k][l] / 12 : quadratic[k][l] / 180;
                    double one[2] = {0, 0};
                    assert_true(fabs(m[k * nodes + l] - entry * mass) < 1e-13 * mass);
                    for (size_t i = 0; i < nodes; i++)
                        for (int axis = 0; axis < 2; axis++)
                            one[axis] += all[((size_t)axis * nodes + k) * nodes + i] *
                                         m[i * nodes + l];
                    assert_true(fabs(one[0] - (k == l)) < 1e-13 && fabs(one[1] - (k == l)) < 1e-13);
                }
            }
        }
    }
}

/* 2/omega_max by GSL from the matrix. Lanczos' value of omega^2 is an upper bound, at most 2e-3 too
 * large: 1e-3 of the step, and round-off. */
static void the_critical_step_is_that_of_the_matrix(void **unused)
{
    for (int which = 0; which < ALL_BODIES; which++) {
        OWN(fracas_model) model = distorted(which, which < 2 || which == BENT ? 2 : 1, 3);
        const size_t n = unknowns_of(model);
        OWNED double *matrix = stiffness_matrix(model, n),
                     *value = squares_of_frequencies(model, matrix, n);
        const double ratio = model->critical_closed * sqrt(value[n - 1]) / 2;
        print_message("body %d: critical step by the matrix's %.6f\n", which, ratio);
        assert_true(ratio < 1 + 1e-12 && ratio > 1 - 1e-3);
    }
}

/* ---- the smallest beta ---- */

/* Cholesky's factors exist. `work` is overwritten. */
static bool is_positive(double *work, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            double sum = work[i * n + j];
            for (size_t k = 0; k < j; k++) sum -= work[i * n + k] * work[j * n + k];
            if (j < i) work[i * n + j] = sum / work[j * n + j];
            else if (!(sum > 0)) return false;
            else work[i * n + i] = sqrt(sum);
        }
    return true;
}

/* beta from which K has no negative eigenvalue: K is linear in beta. Zero eigenvalues are lifted by
 * 1e-9 of the largest entry. `given`: a mesh, or NULL to make the spec's. */
static double smallest_beta(fracas_spec spec, double distortion, const fracas_surface *given)
{
    double *k[2], low = 0, high = 10;
    size_t n = 0;
    for (int i = 0; i < 2; i++) {
        spec.cohesive.beta = i ? 20 : 10;
        OWN(fracas_model) model = given ? mesh_model(spec, given)
                                        : distorted_model(spec, distortion, 2);
        n = unknowns_of(model);
        k[i] = stiffness_matrix(model, n);
    }
    OWNED double *work = vector_of(n * n);
    const double lift = 1e-9 * largest_of(k[0], n * n);
    while (high - low > 1e-3) {
        const double beta = 0.5 * (low + high);
        for (size_t i = 0; i < n * n; i++)
            work[i] = k[0][i] + (beta - 10) / 10 * (k[1][i] - k[0][i]) + (i % (n + 1) ? 0 : lift);
        if (is_positive(work, n)) high = beta;
        else low = beta;
    }
    free(k[0]);
    free(k[1]);
    return high;
}

/* A rhombus of equilateral triangles with edges of 1 mm, n x n, for the caller to destroy. Its
 * nodes, middles too, are a grid of half that spacing; vertices are those of even numbers. */
static const fracas_surface *equilateral(size_t n, int order)
{
    const size_t step = (size_t)order, row = step * n + 1;
    const fracas_surface *surface = NULL;
    double(*node)[3] = taken(row * row * sizeof *node);
    uint32_t *element = taken(12 * n * n * sizeof *element), *put = element;
    for (size_t j = 0; j < row; j++)
        for (size_t i = 0; i < row; i++) {
            node[row * j + i][0] = 1e-3 / order * ((double)i + 0.5 * (double)j);
            node[row * j + i][1] = 1e-3 / order * sqrt(0.75) * (double)j;
            node[row * j + i][2] = 0;
        }
    const size_t corner[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}};
    for (size_t e = 0; e < 2 * n * n; e++) {
        size_t at[3];
        for (int k = 0; k < 3; k++)
            at[k] = row * step * (e / 2 / n + corner[e % 2][k][1]) +
                    step * (e / 2 % n + corner[e % 2][k][0]);
        for (int k = 0; k < 3; k++) *put++ = (uint32_t)at[k];
        for (int k = 0; order == 2 && k < 3; k++)
            *put++ = (uint32_t)((at[k] + at[(k + 1) % 3]) / 2);
    }
    const fracas_surface_arrays arrays = {.order = order,
                                          .nnodes = row * row,
                                          .nelements = 2 * n * n,
                                          .node = (const double(*)[3])node,
                                          .element = element};
    OK(fracas_surface_assemble(&arrays, &surface));
    free(node);
    free(element);
    return surface;
}

/* The theory has 1.01 to 1.23 and 2.0 to 2.3 from equilateral to right-angled triangles, with the
 * smaller element's area by the edge: the same for equal elements. Meshes as small as these, of
 * which a third of the elements are at the boundary, get by with less, up to a fifth; so do small
 * Poisson's ratios. The mean of both elements does for distorted ones too. */
static void beta_has_room(void **unused)
{
    const double poisson[] = {0, 0.22, 0.3, 0.45};
    for (int order = 1; order <= 2; order++) {
        const fracas_surface *equal = equilateral(4, order);
        for (int p = 0; p < 4; p++) {
            fracas_spec spec = membrane_spec(&fracas_shape_plate, order, 4);
            spec.material.poisson = poisson[p];
            spec.geometry.width = spec.geometry.height;
            const double least = order == 1 ? 1.01 : 2.0, most = order == 1 ? 1.23 : 2.3;
            const double beta[] = {smallest_beta(spec, 0, equal), smallest_beta(spec, 0, NULL),
                                   smallest_beta(spec, DISTORTION, NULL),
                                   smallest_beta(spec, 0.3, NULL)};
            print_message("order %d, nu %.2f: smallest beta %.3f equilateral, %.3f right-angled, "
                          "%.3f and %.3f distorted by 20 and 30 %%\n",
                          order, poisson[p], beta[0], beta[1], beta[2], beta[3]);
            for (int i = 0; i < 4; i++) assert_true(beta[i] < most);
            for (int i = 0; i < 2 && poisson[p] > 0.2; i++) assert_true(beta[i] > 0.8 * least);
        }
        fracas_surface_destroy(equal);
    }
}

TESTS(uniform_strain_is_exact, rigid_motions_give_no_force, the_matrix_is_the_bilinear_form,
      only_rigid_motions_cost_no_energy, masses_are_those_of_the_textbook,
      the_critical_step_is_that_of_the_matrix, beta_has_room)
