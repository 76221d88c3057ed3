/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/membrane_tables.h"

#include "engine/element/triangle.h"
#include "engine/formulation/surface/common.h"
#include "engine/formulation/surface/edges.h"
#include "engine/formulation/surface/nodal_mass.h"
#include "engine/integrator/integrator.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <stdlib.h>

void fracas_membrane_tables_destroy(void *p)
{
    fracas_membrane_tables *t = p;
    if (!t) return;
    void *const owned[] = {t->bulk,    t->lumped, t->consistent, t->position, t->joint,
                           t->element, t->edge,   t->held,       t->fixed};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++) free(owned[i]);
    fracas_surface_visits_clear(&t->visits);
    free(t);
}

static bool allocate(fracas_membrane_tables *t, bool consistent, bool positions, bool held)
{
    const size_t n = t->nelements, m = t->ninterfaces, nodes = (size_t)MEMBRANE_NODES(t->order);
    const size_t joint = MEMBRANE_POINTS + (size_t)MEMBRANE_EDGE(t->order) * MEMBRANE_POINT_TABLE;
    t->bulk = malloc(n * (size_t)MEMBRANE_BULK(t->order) * MEMBRANE_BULK_TABLE * sizeof *t->bulk);
    t->lumped = malloc(n * 2 * nodes * sizeof *t->lumped);
    if (consistent) t->consistent = malloc(n * 3 * nodes * nodes * sizeof *t->consistent);
    if (positions) t->position = malloc(n * nodes * 2 * sizeof *t->position);
    if (held) t->held = calloc(n, sizeof *t->held);
    if (held) t->fixed = calloc(n, sizeof *t->fixed);
    t->joint = malloc((m ? m : 1) * joint * sizeof *t->joint);
    t->element = malloc((m ? m : 1) * sizeof *t->element);
    t->edge = malloc((m ? m : 1) * sizeof *t->edge);
    return t->bulk && t->lumped && (t->consistent || !consistent) && (t->position || !positions) &&
           ((t->held && t->fixed) || !held) && t->joint && t->element && t->edge;
}

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

static void fill_bulk(const fracas_model *model, fracas_membrane_tables *t, size_t e)
{
    static const double at[2][3][2] = {
        {{1.0 / 3, 1.0 / 3}}, {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}}};
    const int points = MEMBRANE_BULK(t->order);
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

/* m = inverse of the n x n matrix m (Gauss-Jordan, positive definite: no pivoting). */
static void invert(double *m, int n)
{
    for (int p = 0; p < n; p++) {
        const double pivot = 1.0 / m[p * n + p];
        m[p * n + p] = 1.0;
        for (int c = 0; c < n; c++) m[p * n + c] *= pivot;
        for (int r = 0; r < n; r++) {
            if (r == p) continue;
            const double factor = m[r * n + p];
            m[r * n + p] = 0.0;
            for (int c = 0; c < n; c++) m[r * n + c] -= factor * m[p * n + c];
        }
    }
}

/* Inverse of the mass among the nodes that are not held in a component; 0 for those that are. */
static void invert_free(const double *mass, int nodes, unsigned held, int component,
                        double *inverse)
{
    for (int r = 0; r < nodes; r++)
        for (int c = 0; c < nodes; c++) {
            const bool out = (held >> (2 * r + component) & 1) || (held >> (2 * c + component) & 1);
            inverse[r * nodes + c] = out ? r == c : mass[r * nodes + c];
        }
    invert(inverse, nodes);
    for (int r = 0; r < nodes; r++)
        if (held >> (2 * r + component) & 1) inverse[r * nodes + r] = 0.0;
}

static void fill_mass(const fracas_model *model, fracas_membrane_tables *t, size_t e)
{
    const int nodes = MEMBRANE_NODES(t->order);
    double mass[36], *lumped = t->lumped + 2 * (size_t)nodes * e;
    fracas_nodal_mass(model->surface, e,
                      model->spec.material.density * model->spec.geometry.thickness, mass,
                      lumped + nodes);
    for (int k = 0; k < nodes; k++) lumped[k] = 1.0 / lumped[nodes + k];
    if (!t->consistent) return;
    const size_t entries = (size_t)(nodes * nodes);
    double *consistent = t->consistent + 3 * entries * e;
    for (int i = 0; i < 2; i++)
        invert_free(mass, nodes, t->held ? t->held[e] : 0u, i, consistent + (size_t)i * entries);
    for (size_t i = 0; i < entries; i++) consistent[2 * entries + i] = mass[i];
}

/* Edge k of an element at s: tangent dx/ds. */
static void tangent_of(int order, const double (*x)[2], uint32_t k, double s, double tangent[2])
{
    const double *a = x[k], *b = x[(k + 1) % 3], *c = order == 2 ? x[3 + k] : NULL;
    for (int i = 0; i < 2; i++)
        tangent[i] = c ? (4 * s - 3) * a[i] + (4 * s - 1) * b[i] + (4 - 8 * s) * c[i] : b[i] - a[i];
}

/* K = beta E/(1 - nu^2)/h_s, 1/h_s = (|e|/A- + |e|/A+)/2  (membrane.5) */
static void fill_joint(const fracas_model *model, fracas_membrane_tables *t, size_t i)
{
    static const double points[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};
    static const double weights[2][3] = {FRACAS_EDGE_WEIGHTS_1, FRACAS_EDGE_WEIGHTS_2};
    const fracas_spec *spec = &model->spec;
    const fracas_surface_interface *interface = &model->surface->interface[i];
    const size_t size = MEMBRANE_POINTS + (size_t)MEMBRANE_EDGE(t->order) * MEMBRANE_POINT_TABLE;
    const double nu = spec->material.poisson, modulus = spec->material.young / (1 - nu * nu);
    double *joint = t->joint + i * size, x[6][2];
    for (int side = 0; side < 2; side++) {
        t->element[i][side] = interface->element[side];
        t->edge[i][side] = (uint8_t)interface->edge[side];
    }
    joint[MEMBRANE_STIFFNESS] = spec->cohesive.beta * modulus *
                                fracas_surface_inverse_size(model->surface, i);
    joint[MEMBRANE_COMPLIANCE] = 1.0 / joint[MEMBRANE_STIFFNESS];
    nodes_of(model->surface, interface->element[0], x);
    for (int g = 0; g < MEMBRANE_EDGE(t->order); g++) {
        double tangent[2], *point = joint + MEMBRANE_POINTS + g * MEMBRANE_POINT_TABLE;
        tangent_of(t->order, (const double(*)[2])x, interface->edge[0], points[t->order - 1][g],
                   tangent);
        const double speed = sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1]);
        point[MEMBRANE_NX] = tangent[1] / speed;
        point[MEMBRANE_NY] = -tangent[0] / speed;
        point[MEMBRANE_AREA] = weights[t->order - 1][g] * speed * spec->geometry.thickness;
    }
}

static fracas_err hold_edge(const fracas_model *model, const fracas_surface_border *border,
                            const fracas_kind *kind, fracas_membrane_tables *t)
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
    for (int n = 0; n < t->order + 1; n++)
        for (unsigned i = 0; i < 2; i++)
            if (held[i]) {
                const uint16_t bit = (uint16_t)(1u << (2 * node[n] + i));
                t->held[border->element] |= bit;
                if (kind == &fracas_edge_fixed) t->fixed[border->element] |= bit;
            }
    return FRACAS_OK;
}

static bool holds_something(const fracas_model *model)
{
    for (size_t b = 0; b < model->surface->nborders; b++)
        if (fracas_surface_edge_kind(&model->spec, model->surface->border[b].tag) !=
            &fracas_edge_free)
            return true;
    return false;
}

static fracas_err fill(const fracas_model *model, fracas_membrane_tables *t)
{
    TRY(fracas_surface_check_edge_tags(model));
    for (size_t b = 0; t->held && b < model->surface->nborders; b++) {
        const fracas_kind *kind = fracas_surface_edge_kind(&model->spec,
                                                           model->surface->border[b].tag);
        if (kind != &fracas_edge_free) TRY(hold_edge(model, &model->surface->border[b], kind, t));
    }
    for (size_t e = 0; e < t->nelements; e++) {
        fill_bulk(model, t, e);
        fill_mass(model, t, e);
        if (t->position)
            nodes_of(
                model->surface, e,
                (double(*)[2])(void *)(t->position + e * 2 * (size_t)MEMBRANE_NODES(t->order)));
    }
    for (size_t i = 0; i < t->ninterfaces; i++) fill_joint(model, t, i);
    return fracas_surface_visits_init(&t->visits, model->surface);
}

fracas_err fracas_membrane_tables_create(const fracas_model *model, fracas_membrane_tables **tables)
{
    const fracas_surface *surface = model->surface;
    fracas_membrane_tables *t = calloc(1, sizeof *t);
    if (!t) return fracas_no_memory("the tables of a membrane");
    t->order = surface->order;
    t->nelements = surface->nelements;
    t->ninterfaces = surface->ninterfaces;
    const bool consistent = model->spec.time.mass == &fracas_mass_consistent;
    const bool positions = model->spec.loading.type == &fracas_loading_centrifugal;
    fracas_err err = allocate(t, consistent, positions, holds_something(model))
                         ? fill(model, t)
                         : fracas_no_memory("the tables of a membrane");
    if (err) {
        fracas_membrane_tables_destroy(t);
        return err;
    }
    *tables = t;
    return FRACAS_OK;
}
