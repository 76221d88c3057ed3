/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell's operator against its bilinear form, written down anew: strains of bending as changes
 * of curvature by differences. */
#include "tests/support/shell_bodies.h"
#include "tests/support/shell_cracks.h"
#include "tests/support/test.h"

#include <gsl/gsl_integration.h>

/* Change of the director by unknown d:  -(t.u_{,a}) a^a */
static void director(const shell_place *p, size_t d, double of[3])
{
    for (int i = 0; i < 3; i++)
        of[i] = -p->t[d % 3] * (p->shape.first[d / 3][0] * p->dual[0][i] +
                                p->shape.first[d / 3][1] * p->dual[1][i]);
}

/* Derivatives of t and of the change of the director by xi or eta: differences of sixth order.
 * Their error is that of the seventh derivatives, below 1e5, times step^6/140, and round-off
 * 1e-16/step: 1e-12. */
static void by_coordinate(const fracas_model *model, size_t e, double xi, double eta, int along,
                          double of_t[3], double of_turn[18][3])
{
    const double step = 1e-3, weight[3] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
    for (int i = 0; i < 3; i++) of_t[i] = 0;
    for (int d = 0; d < 18; d++)
        for (int i = 0; i < 3; i++) of_turn[d][i] = 0;
    for (int far = 1; far < 4; far++)
        for (int sign = -1; sign < 2; sign += 2) {
            const double move = sign * far * step, w = sign * weight[far - 1] / step;
            const shell_place p = place_at(model, e, along ? xi : xi + move,
                                           along ? eta + move : eta);
            for (int i = 0; i < 3; i++) of_t[i] += w * p.t[i];
            for (size_t d = 0; d < 18; d++) {
                double turn[3];
                director(&p, d, turn);
                for (int i = 0; i < 3; i++) of_turn[d][i] += w * turn[i];
            }
        }
}

/* Of each unknown: strains xx, yy, 2 xy of stretching, and of bending as the change of a_a .
 * t_{,b}: a_a . dt_{,b} + u_{,a} . t_{,b}. */
static void strains_at(const fracas_model *model, size_t e, double xi, double eta,
                       double eps[18][3], double rho[18][3])
{
    const shell_place p = place_at(model, e, xi, eta);
    const double *frame[2] = {p.x, p.y};
    double of_t[2][3], of_turn[2][18][3];
    for (int a = 0; a < 2; a++) by_coordinate(model, e, xi, eta, a, of_t[a], of_turn[a]);
    for (size_t d = 0; d < 18; d++) {
        double stretch[2][2] = {{0}}, bend[2][2] = {{0}};
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++)
                for (int a = 0; a < 2; a++) {
                    const double ia = dot3(frame[i], p.dual[a]);
                    stretch[i][j] += ia * p.shape.first[d / 3][a] * frame[j][d % 3];
                    for (int b = 0; b < 2; b++)
                        bend[i][j] += ia * dot3(frame[j], p.dual[b]) *
                                      (dot3(p.base[a], of_turn[b][d]) +
                                       p.shape.first[d / 3][a] * of_t[b][d % 3]);
                }
        for (int i = 0; i < 2; i++) {
            eps[d][i] = stretch[i][i];
            rho[d][i] = bend[i][i];
        }
        eps[d][2] = stretch[0][1] + stretch[1][0];
        rho[d][2] = bend[0][1] + bend[1][0];
    }
}

static void hooke(const fracas_spec *spec, double thickness, const double strain[3], double of[3])
{
    const double nu = spec->material.poisson, c = spec->material.young * thickness / (1 - nu * nu);
    of[0] = c * (strain[0] + nu * strain[1]);
    of[1] = c * (strain[1] + nu * strain[0]);
    of[2] = c * (1 - nu) / 2 * strain[2];
}

/* Of all elements: strains and resultants of each unknown at the bulk points l_g = 2/3. */
typedef struct {
    double eps[3][18][3], rho[3][18][3], n[3][18][3], m[3][18][3];
} element_state;

static element_state *states_of(const fracas_model *model)
{
    static const double at[3][2] = {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
    const double h = model->spec.geometry.thickness;
    element_state *state = zeroed(model->elements, sizeof *state);
    for (size_t e = 0; e < model->elements; e++)
        for (int g = 0; g < 3; g++) {
            strains_at(model, e, at[g][0], at[g][1], state[e].eps[g], state[e].rho[g]);
            for (int d = 0; d < 18; d++) {
                hooke(&model->spec, h, state[e].eps[g][d], state[e].n[g][d]);
                hooke(&model->spec, h * h * h / 12, state[e].rho[g][d], state[e].m[g][d]);
            }
        }
    return state;
}

static void add_bulk(const fracas_model *model, const element_state *state, size_t n,
                     double *matrix)
{
    static const double at[3][2] = {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
    for (size_t e = 0; e < model->elements; e++)
        for (int g = 0; g < 3; g++) {
            const double weight = place_at(model, e, at[g][0], at[g][1]).area / 6;
            for (size_t i = 0; i < 18; i++)
                for (size_t j = 0; j < 18; j++)
                    matrix[(18 * e + i) * n + 18 * e + j] +=
                        weight * (dot3(state[e].eps[g][i], state[e].n[g][j]) +
                                  dot3(state[e].rho[g][i], state[e].m[g][j]));
        }
}

/* One side of an edge at s from the edge's first vertex: the place, n_nn, n_ns, m_nn, m_ns of each
 * unknown, the normal's turn of each, and the curvatures nn, ns, ss by differences of t. */
typedef struct {
    shell_place p;
    double tangent[3], normal[3], speed, of[18][4], turn[18], l[3];
} edge_side;

/* `tangent`: of the first side, or NULL to take the element's own. */
static edge_side side_at(const fracas_model *model, const element_state *state, size_t e,
                         size_t edge, double s, const double *tangent)
{
    double place[2];
    on_edge(edge, s, place);
    const double l[3] = {1 - place[0] - place[1], place[0], place[1]};
    const double along[3][2] = {{1, 0}, {-1, 1}, {0, -1}};
    edge_side of = {.p = place_at(model, e, l[1], l[2])};
    double of_t[2][3], unused[18][3];
    for (int i = 0; i < 3; i++)
        of.tangent[i] = along[edge][0] * of.p.base[0][i] + along[edge][1] * of.p.base[1][i];
    of.speed = unit3(of.tangent);
    if (tangent) memcpy(of.tangent, tangent, sizeof of.tangent);
    cross3(of.tangent, of.p.t, of.normal);
    const double n[2] = {dot3(of.normal, of.p.x), dot3(of.normal, of.p.y)}, t[2] = {-n[1], n[0]};
    for (int d = 0; d < 18; d++) {
        double r[2][3] = {{0}}, turn[3];
        for (int g = 0; g < 3; g++)
            for (int i = 0; i < 3; i++) {
                r[0][i] += (2 * l[g] - 1.0 / 3) * state[e].n[g][d][i];
                r[1][i] += (2 * l[g] - 1.0 / 3) * state[e].m[g][d][i];
            }
        for (int part = 0; part < 2; part++) {
            const double pull[2] = {r[part][0] * n[0] + r[part][2] * n[1],
                                    r[part][2] * n[0] + r[part][1] * n[1]};
            of.of[d][2 * part] = pull[0] * n[0] + pull[1] * n[1];
            of.of[d][2 * part + 1] = pull[0] * t[0] + pull[1] * t[1];
        }
        director(&of.p, (size_t)d, turn);
        of.turn[d] = dot3(turn, of.normal);
    }
    for (int a = 0; a < 2; a++) by_coordinate(model, e, l[1], l[2], a, of_t[a], unused);
    double by[2][3] = {{0}}; /* of t along the normal, along the edge */
    for (int a = 0; a < 2; a++)
        for (int i = 0; i < 3; i++) {
            by[0][i] += dot3(of.normal, of.p.dual[a]) * of_t[a][i];
            by[1][i] += dot3(of.tangent, of.p.dual[a]) * of_t[a][i];
        }
    of.l[0] = dot3(by[0], of.normal);
    of.l[1] = dot3(by[0], of.tangent);
    of.l[2] = dot3(by[1], of.tangent);
    return of;
}

/* |e|/A of an element. */
static double per_size(const fracas_model *model, size_t e, size_t edge)
{
    return fracas_surface_length(model->surface, e, edge) / model->surface->area[e];
}

/* int <N>.[v] + <N(v)>.[u] + k h [u].[v] + the same of M and the turns + beta_shear G h/h_s [u].t
 * [v].t, N_i = n_ni + L_ik m_nk. */
static void add_interfaces(const fracas_model *model, const element_state *state, size_t n,
                           double *matrix, const gsl_integration_glfixed_table *rule)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, h = spec->geometry.thickness,
                 c = spec->cohesive.beta * spec->material.young / (1 - nu * nu);
    const double coupling = spec->cohesive.coupling, normal = fmax(1, 1 / (coupling * coupling)),
                 shear = coupling * coupling * normal;
    for (size_t i = 0; i < model->interfaces; i++) {
        const fracas_surface_interface *it = &model->surface->interface[i];
        const double size = 0.5 * (per_size(model, it->element[0], it->edge[0]) +
                                   per_size(model, it->element[1], it->edge[1]));
        const double stiff[5] = {
            normal * c * size * h, shear * c * size * h, normal * c * size * h * h * h / 12,
            shear * c * size * h * h * h / 12,
            spec->cohesive.beta_shear * spec->material.young / (2 * (1 + nu)) * h * size};
        for (size_t g = 0; g < 3; g++) {
            double s, weight, t[3], out[3], jump[36][5], mean[36][5] = {{0}};
            gsl_integration_glfixed_point(0, 1, g, &s, &weight, rule);
            const edge_side a = side_at(model, state, it->element[0], it->edge[0], s, NULL);
            const edge_side b = side_at(model, state, it->element[1], it->edge[1], 1 - s,
                                        a.tangent);
            const double along[2][3][2] = {{{1, 0}, {-1, 1}, {0, -1}}, {{-1, 0}, {1, -1}, {0, 1}}};
            for (int k = 0; k < 3; k++) t[k] = a.p.t[k] + b.p.t[k];
            unit3(t);
            cross3(a.tangent, t, out);
            const double *axis[2] = {out, a.tangent};
            for (int d = 0; d < 36; d++) {
                const edge_side *of = d < 18 ? &a : &b;
                const int side = d >= 18, k = d % 18 / 3, x = d % 3;
                const double sign = side ? 1 : -1, *way = along[side][it->edge[side]];
                const double ds = (way[0] * of->p.shape.first[k][0] +
                                   way[1] * of->p.shape.first[k][1]) /
                                  a.speed,
                             *r = of->of[d % 18];
                for (int q = 0; q < 2; q++) {
                    jump[d][q] = sign * of->p.shape.value[k] * axis[q][x];
                    mean[d][q] = 0.5 * (r[q] + 0.5 * (a.l[q] + b.l[q]) * r[2] +
                                        0.5 * (a.l[q + 1] + b.l[q + 1]) * r[3]);
                    mean[d][2 + q] = 0.5 * r[2 + q];
                }
                jump[d][2] = sign * of->turn[d % 18];
                jump[d][3] = -sign * ds * t[x];
                jump[d][4] = sign * of->p.shape.value[k] * t[x];
            }
            for (size_t p = 0; p < 36; p++)
                for (size_t q = 0; q < 36; q++)
                    for (int j = 0; j < 5; j++)
                        matrix[(18 * it->element[p >= 18] + p % 18) * n +
                               18 * it->element[q >= 18] + q % 18] +=
                            weight * a.speed *
                            (mean[q][j] * jump[p][j] + mean[p][j] * jump[q][j] +
                             stiff[j] * jump[p][j] * jump[q][j]);
        }
    }
}

/* Edges about which the shell does not turn: as an interface of m_nn alone with its mirror image.
 */
static void add_rims(const fracas_model *model, const element_state *state, size_t n,
                     double *matrix, const gsl_integration_glfixed_table *rule)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, h = spec->geometry.thickness;
    for (size_t i = 0; i < model->surface->nborders; i++) {
        const fracas_surface_border *it = &model->surface->border[i];
        const fracas_kind *kind = spec->geometry.edge[it->tag];
        if (kind != &fracas_edge_clamped && kind != &fracas_edge_symmetry) continue;
        const double stiff = 2 * spec->cohesive.beta * spec->material.young / (1 - nu * nu) * h *
                             h * h / 12 * per_size(model, it->element, it->edge);
        for (size_t g = 0; g < 3; g++) {
            double s, weight;
            gsl_integration_glfixed_point(0, 1, g, &s, &weight, rule);
            const edge_side a = side_at(model, state, it->element, it->edge, s, NULL);
            for (size_t p = 0; p < 18; p++)
                for (size_t q = 0; q < 18; q++)
                    matrix[(18 * it->element + p) * n + 18 * it->element + q] +=
                        weight * a.speed *
                        (stiff * a.turn[p] * a.turn[q] - a.of[q][2] * a.turn[p] -
                         a.of[p][2] * a.turn[q]);
        }
    }
}

/* K itself does not know of rotary inertia: M^-1 K is multiplied by the same M again.
 *
 * Entries sum terms that are known to 1e-12 (see by_coordinate) of the largest entry. K itself is
 * symmetric to the round-off of its sums of some 50 terms, 1e-14 of the largest; 1e-13. */
static void check_matrix(int which, fracas_spec spec, bool edges,
                         gsl_integration_glfixed_table *rule)
{
    OWN(fracas_model) model = body_of(which, spec, 2, 11);
    const size_t n = unknowns_of(model);
    OWNED double *expected = vector_of(n * n);
    OWNED element_state *state = states_of(model);
    double miss, skew;
    add_bulk(model, state, n, expected);
    add_interfaces(model, state, n, expected, rule);
    if (edges) add_rims(model, state, n, expected, rule);
    compare_matrix(model, expected, &miss, &skew);
    print_message("%s, edges %s: entries within %.1e, symmetric within %.1e\n", body_name[which],
                  edges ? "clamped and free" : "free", miss, skew);
    assert_true(miss < 1e-12 && skew < 1e-13);
}

static void the_matrix_is_the_bilinear_form(void **unused)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(3);
    for (int which = 0; which < BODIES; which++)
        for (int edges = 0; edges < (which == SPHERE ? 1 : 2); edges++) {
            fracas_spec spec = shell_spec(&fracas_shape_sphere);
            for (int tag = 0; edges && tag <= PLATE_SIDES; tag++)
                spec.geometry.edge[tag] = tag % 2 ? &fracas_edge_clamped : &fracas_edge_free;
            spec.geometry.thickness = 0.5; /* bending as large as stretching */
            spec.cohesive.beta_shear = 3;
            spec.cohesive.coupling = edges ? 0.8 : 1.25;
            check_matrix(which, spec, edges, rule);
            spec.time.rotary_inertia = 0.7;
            check_matrix(which, spec, edges, rule);
        }
    gsl_integration_glfixed_table_free(rule);
}

TESTS(the_matrix_is_the_bilinear_form)
