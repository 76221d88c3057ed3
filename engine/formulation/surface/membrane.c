/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane: plane stress on a flat surface of triangles that share no nodes
 * (docs/theory/membrane.md). */
#include "engine/formulation/surface/membrane.h"

#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>

FRACAS_KERNEL_TABLE(const fracas_surface_kernel, fracas_membrane);

static fracas_err check_flat(const fracas_surface *surface)
{
    for (size_t n = 0; n < surface->nnodes; n++)
        if (surface->node[n][2] != surface->node[0][2])
            return fracas_fail(FRACAS_USAGE,
                               "a membrane is flat, but the mesh has nodes at z = %g and %g m: its "
                               "elements must lie in a plane z = const",
                               surface->node[0][2], surface->node[n][2]);
    const uint32_t *t = surface->element;
    const double *a = surface->node[t[0]], *b = surface->node[t[1]], *c = surface->node[t[2]];
    if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "the mesh's elements go round clockwise, seen from +z: turn them round");
}

/* ---- tables ---- */

/* Coordinates of the nodes of an element in the plane. */
static void nodes_of(const fracas_surface *surface, size_t e, double (*x)[2])
{
    for (size_t k = 0; k < surface->corners; k++)
        for (int i = 0; i < 2; i++)
            x[k][i] = surface->node[surface->element[e * surface->corners + k]][i];
}

/* d(x, y)/d(xi, eta) at a point, its determinant. */
static double jacobian(int order, const double (*x)[2], double xi, double eta, double *shape,
                       double j[2][2])
{
    double derivative[6][2];
    fracas_triangle_shape(order, xi, eta, shape, derivative);
    for (int i = 0; i < 2; i++)
        for (int a = 0; a < 2; a++) {
            j[i][a] = 0;
            for (int k = 0; k < 3 * order; k++) j[i][a] += x[k][i] * derivative[k][a];
        }
    return j[0][0] * j[1][1] - j[0][1] * j[1][0];
}

static void fill_bulk(const fracas_model *model, fracas_surface_tables *t, size_t e)
{
    static const double at[2][3][2] = {
        {{1.0 / 3, 1.0 / 3}}, {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}}};
    const int points = SURFACE_BULK(t->order);
    double x[6][2], shape[6], j[2][2];
    nodes_of(model->surface, e, x);
    for (int g = 0; g < points; g++) {
        const double det = jacobian(t->order, (const double(*)[2])x, at[t->order - 1][g][0],
                                    at[t->order - 1][g][1], shape, j);
        double *bulk = t->bulk + (e * (size_t)points + (size_t)g) * MEMBRANE_BULK_TABLE;
        bulk[MEMBRANE_XI_X] = j[1][1] / det;
        bulk[MEMBRANE_XI_Y] = -j[0][1] / det;
        bulk[MEMBRANE_ETA_X] = -j[1][0] / det;
        bulk[MEMBRANE_ETA_Y] = j[0][0] / det;
        bulk[MEMBRANE_WEIGHT] = 0.5 / points * det * model->spec.geometry.thickness;
    }
}

/* Edge k of an element at s: tangent dx/ds. */
static void tangent_of(int order, const double (*x)[2], uint32_t k, double s, double tangent[2])
{
    const double *a = x[k], *b = x[(k + 1) % 3], *c = order == 2 ? x[3 + k] : NULL;
    for (int i = 0; i < 2; i++)
        tangent[i] = c ? (4 * s - 3) * a[i] + (4 * s - 1) * b[i] + (4 - 8 * s) * c[i] : b[i] - a[i];
}

/* K = beta E/(1 - nu^2)/h_s, 1/h_s = (|e|/A- + |e|/A+)/2  (membrane.5) */
static void fill_interface(const fracas_model *model, fracas_surface_tables *t, size_t i)
{
    static const double points[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};
    static const double weights[2][3] = {FRACAS_EDGE_WEIGHTS_1, FRACAS_EDGE_WEIGHTS_2};
    const fracas_spec *spec = &model->spec;
    const fracas_surface_interface *interface = &model->surface->interface[i];
    const size_t size = SURFACE_HEAD + (size_t)SURFACE_EDGE(t->order) * MEMBRANE_POINT_TABLE;
    const double nu = spec->material.poisson, modulus = spec->material.young / (1 - nu * nu);
    double *head = t->interface + i * size, x[6][2];
    head[SURFACE_STIFFNESS] = spec->cohesive.beta * modulus *
                              fracas_surface_inverse_size(model->surface, i);
    head[SURFACE_COMPLIANCE] = 1.0 / head[SURFACE_STIFFNESS];
    nodes_of(model->surface, interface->element[0], x);
    for (int g = 0; g < SURFACE_EDGE(t->order); g++) {
        double tangent[2], *point = head + SURFACE_HEAD + g * MEMBRANE_POINT_TABLE;
        tangent_of(t->order, (const double(*)[2])x, interface->edge[0], points[t->order - 1][g],
                   tangent);
        const double speed = sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1]);
        point[MEMBRANE_NX] = tangent[1] / speed;
        point[MEMBRANE_NY] = -tangent[0] / speed;
        point[MEMBRANE_AREA] = weights[t->order - 1][g] * speed * spec->geometry.thickness;
    }
}

static fracas_err hold_edge(const fracas_model *model, const fracas_surface_border *border,
                            const fracas_kind *kind, uint32_t *bits, uint32_t *fixed)
{
    double x[6][2];
    nodes_of(model->surface, border->element, x);
    const uint32_t k = border->edge, node[3] = {k, (k + 1) % 3, 3 + k};
    bool held[2] = {true, true};
    if (kind == &fracas_edge_clamped || kind == &fracas_edge_symmetry ||
        kind == &fracas_edge_diaphragm)
        return fracas_fail(
            FRACAS_USAGE,
            "an edge with tag %d is %s, which edges of shells are: let an edge of a membrane be %s",
            (int)border->tag, kind->name,
            kind == &fracas_edge_symmetry ? "sliding" : "fixed, held, sliding or free");
    if (kind == &fracas_edge_sliding) {
        const double dx = fabs(x[node[1]][0] - x[node[0]][0]),
                     dy = fabs(x[node[1]][1] - x[node[0]][1]);
        if (fmin(dx, dy) > 1e-9 * fmax(dx, dy))
            return fracas_fail(FRACAS_USAGE,
                               "an edge with tag %d slides, but it is neither along x nor along y "
                               "at (%g, %g) m: hold it, or leave it free",
                               (int)border->tag, x[node[0]][0], x[node[0]][1]);
        held[0] = dy > dx;
        held[1] = dx > dy;
    }
    for (int n = 0; n < model->surface->order + 1; n++)
        for (uint32_t i = 0; i < 2; i++)
            if (held[i]) *bits |= 1u << (2 * node[n] + i);
    if (kind == &fracas_edge_fixed) *fixed = *bits;
    return FRACAS_OK;
}

/* ---- the body ---- */

static void fill_constants(const fracas_model *model, fracas_surface_constants *c)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson;
    const bool centrifugal = spec->loading.type == &fracas_loading_centrifugal;
    c->c11 = spec->material.young / (1 - nu * nu);
    c->c12 = nu * c->c11;
    c->c33 = spec->material.young / (2 * (1 + nu));
    c->speed = centrifugal ? spec->loading.speed : 0;
    c->ramp = spec->loading.ramp;
}

/* M_kl of the lumped or consistent masses of element e [kg]. */
static double mass_at(const fracas_surface_tables *t, size_t e, size_t k, size_t l)
{
    const size_t nodes = (size_t)SURFACE_NODES(t->order);
    if (t->consistent) return t->consistent[((3 * e + 2) * nodes + k) * nodes + l];
    return k == l ? t->lumped[(2 * e + 1) * nodes + k] : 0;
}

/* By the masses that the element moves with: lumped ones of quadratic elements give another
 * momentum, which is not kept. */
static void add_node(const fracas_surface_tables *t, size_t e, size_t k, const double (*x)[3],
                     const double (*v)[3], fracas_fragment_sums *sums)
{
    double mass = 0, carried[3] = {0}, momentum[3] = {0};
    for (size_t l = 0; l < (size_t)SURFACE_NODES(t->order); l++) {
        const double share = mass_at(t, e, k, l);
        mass += share;
        for (size_t i = 0; i < 2; i++) {
            carried[i] += share * x[l][i];
            momentum[i] += share * v[l][i];
        }
    }
    fracas_fragment_sums_add_coupled(sums, mass, x[k], carried, momentum);
}

static const double layer[] = {1.0};
static const fracas_surface_body body = {.dimension = 2,
                                         .stresses = 3,
                                         .layers = 1,
                                         .layer = layer,
                                         .bulk_table = MEMBRANE_BULK_TABLE,
                                         .head = SURFACE_HEAD,
                                         .point_table = MEMBRANE_POINT_TABLE,
                                         .kernels = &fracas_membrane,
                                         .check_mesh = check_flat,
                                         .fill_bulk = fill_bulk,
                                         .fill_interface = fill_interface,
                                         .hold_edge = hold_edge,
                                         .fill_constants = fill_constants,
                                         .add_node = add_node};

static fracas_err membrane_model_init(fracas_model *model)
{
    return fracas_surface_model_init(model, &body);
}

static const fracas_kind *const goes_with[] = {
    &fracas_shape_plate,        &fracas_shape_annulus, &fracas_shape_file,
    &fracas_spacing_triangles,  &fracas_spacing_given, &fracas_loading_expansion,
    &fracas_loading_centrifugal};
const fracas_formulation fracas_formulation_membrane = {
    .kind = {.name = "membrane",
             .doc = "a plate in plane stress, of triangles in its plane",
             .goes_with = goes_with,
             .ngoes_with = FRACAS_COUNT(goes_with)},
    .model_init = membrane_model_init,
    FRACAS_SURFACE_FORMULATION};
