/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uncracked membranes: their meshes and fields on them (docs/theory/membrane.md). */
#ifndef FRACAS_TESTS_SUPPORT_MEMBRANE_ELASTIC_H
#define FRACAS_TESTS_SUPPORT_MEMBRANE_ELASTIC_H

#include "engine/formulation/surface/membrane.h"
#include "engine/integrator/integrator.h"
#include "tests/support/surface_state.h"

/* A free plate or annulus of order `order`, `divisions` of its shorter side or between its circles;
 * lumped masses, beta 4. */
static inline fracas_spec membrane_spec(const fracas_kind *shape, int64_t order, int64_t divisions)
{
    fracas_spec spec = surface_spec(&fracas_formulation_membrane, shape);
    spec.geometry.thickness = 1e-3;
    spec.mesh.divisions = divisions;
    spec.mesh.order = order;
    spec.cohesive.beta = 4;
    spec.loading.rate = 1e4;
    spec.time.end = 1e-6;
    spec.time.safety = 0.9;
    if (shape == &fracas_shape_plate) {
        spec.geometry.width = 12e-3;
        spec.geometry.height = 10e-3;
    } else {
        spec.geometry.inner = 6.5e-3;
        spec.geometry.outer = 13e-3;
    }
    return spec;
}

/* Plates, annuli of both orders. */
enum { BODIES = 4 };
static inline fracas_spec body_of(int which, int64_t divisions)
{
    return membrane_spec(which < 2 ? &fracas_shape_plate : &fracas_shape_annulus, which % 2 + 1,
                         divisions);
}

/* A place in an element: its coordinates, shape functions with their derivatives by x, y, and the
 * Jacobian's determinant. */
typedef struct {
    double x[2], by[6][2], det;
    surface_shape shape;
} membrane_place;

static inline membrane_place place_at(const fracas_model *model, size_t e, double xi, double eta)
{
    const size_t nodes = model->surface->corners;
    membrane_place p = {.x = {0, 0}, .shape = shape_at(nodes, xi, eta)};
    const double(*slope)[2] = (const double(*)[2])p.shape.first;
    double j[2][2] = {{0}};
    for (size_t k = 0; k < nodes; k++)
        for (int i = 0; i < 2; i++) {
            p.x[i] += p.shape.value[k] * node_at(model, e, k)[i];
            for (int a = 0; a < 2; a++) j[i][a] += slope[k][a] * node_at(model, e, k)[i];
        }
    p.det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    for (size_t k = 0; k < nodes; k++) {
        p.by[k][0] = (slope[k][0] * j[1][1] - slope[k][1] * j[1][0]) / p.det;
        p.by[k][1] = (slope[k][1] * j[0][0] - slope[k][0] * j[0][1]) / p.det;
    }
    return p;
}

/* Outward normal by |dx/ds| at s along an edge, by differences: exact for the quadratic. */
static inline void edge_normal(const fracas_model *model, size_t e, size_t edge, double s,
                               double normal[2])
{
    double from[2], to[2];
    on_edge(edge, s - 0.25, from);
    on_edge(edge, s + 0.25, to);
    const membrane_place a = place_at(model, e, from[0], from[1]),
                         b = place_at(model, e, to[0], to[1]);
    normal[0] = 2 * (b.x[1] - a.x[1]);
    normal[1] = -2 * (b.x[0] - a.x[0]);
}

/* Stress xx, yy, xy of plane stress from du_i/dx_j. */
static inline void hooke(const fracas_material *m, double by[2][2], double stress[3])
{
    const double c = m->young / (1 - m->poisson * m->poisson);
    stress[0] = c * (by[0][0] + m->poisson * by[1][1]);
    stress[1] = c * (by[1][1] + m->poisson * by[0][0]);
    stress[2] = c * (1 - m->poisson) / 2 * (by[0][1] + by[1][0]);
}

static inline void stress_at(const fracas_model *model, const membrane_place *p, const double *u,
                             double stress[3])
{
    double by[2][2] = {{0}};
    for (size_t k = 0; k < model->surface->corners; k++)
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) by[i][j] += p->by[k][j] * u[2 * k + (size_t)i];
    hooke(&model->spec.material, by, stress);
}

#endif
