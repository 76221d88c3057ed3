/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spheres and octants as study.h5 keeps them, broken along the borders of Voronoi cells. */
#ifndef FRACAS_TESTS_SUPPORT_BODY_H
#define FRACAS_TESTS_SUPPORT_BODY_H

#include "tests/support/store_sample.h"
#include "tests/support/stored_mesh.h"

#include "analysis/draw/facets.h"
#include "analysis/draw/surface_picture.h"
#include "engine/mesh/surface/surface.h"
#include "tests/support/test.h"

/* Cleared by the caller; the surface is destroyed. */
static inline void body_copy(const fracas_surface *surface, fracas_stored_mesh *mesh)
{
    *mesh = (fracas_stored_mesh){.nnodes = surface->nnodes,
                                 .nelements = surface->nelements,
                                 .ninterfaces = surface->ninterfaces,
                                 .nborders = surface->nborders};
    if (fracas_stored_mesh_allocate(mesh)) abort();
    for (size_t n = 0; n < surface->nnodes; n++)
        for (int i = 0; i < 3; i++) mesh->node[n].position[i] = surface->node[n][i];
    for (size_t e = 0; e < surface->nelements; e++)
        for (size_t k = 0; k < 6; k++)
            mesh->element[e].node[k] = k < surface->corners
                                           ? (int64_t)surface->element[e * surface->corners + k]
                                           : -1;
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const fracas_surface_interface *from = &surface->interface[i];
        const int64_t *node = mesh->element[from->element[0]].node, k = from->edge[0];
        mesh->interface[i] = (fracas_stored_interface){{from->element[0], from->element[1]},
                                                       {node[k], node[(k + 1) % 3], node[3 + k]}};
    }
    for (size_t b = 0; b < surface->nborders; b++) {
        const fracas_surface_border *from = &surface->border[b];
        const int64_t *node = mesh->element[from->element].node, k = from->edge;
        mesh->border[b] = (fracas_stored_border){
            from->element, {node[k], node[(k + 1) % 3], node[3 + k]}, from->tag};
    }
    fracas_surface_destroy(surface);
}

/* Element to the nearest of `cells` points, which are spread over the sphere at random: x freely in
 * each coordinate, in the octant of positive ones if `octant`. Interfaces between cells crack at 1
 * s and break at 2 s; `late`: every third of those crack only. Cells are freed by the caller. */
static inline uint32_t *body_break(const fracas_stored_mesh *mesh, size_t cells, bool octant,
                                   bool late, fracas_record *record)
{
    uint64_t x = 20260101;
    double(*seed)[3] = calloc(cells, sizeof *seed);
    uint32_t *cell = calloc(mesh->nelements, sizeof *cell);
    if (!seed || !cell) abort();
    for (size_t c = 0; c < cells; c++) {
        double square = 0;
        do {
            square = 0;
            for (int i = 0; i < 3; i++) {
                x = x * 6364136223846793005u + 1442695040888963407u;
                const double share = (double)(x >> 32) * 0x1p-32;
                seed[c][i] = octant ? share : 2 * share - 1;
                square += seed[c][i] * seed[c][i];
            }
        } while (!(square > 0.01 && square < 1));
        for (int i = 0; i < 3; i++) seed[c][i] /= sqrt(square);
    }
    for (size_t e = 0; e < mesh->nelements; e++) {
        double best = -INFINITY;
        for (size_t c = 0; c < cells; c++) {
            double near = 0;
            for (int k = 0; k < 3; k++)
                for (int i = 0; i < 3; i++)
                    near += seed[c][i] * mesh->node[mesh->element[e].node[k]].position[i];
            if (near > best) best = near, cell[e] = (uint32_t)c;
        }
    }
    grid_record(mesh, 10, record);
    record->onset_time = 1;
    for (size_t i = 0; i < mesh->ninterfaces; i++) {
        const uint32_t a = cell[mesh->interface[i].element[0]],
                       b = cell[mesh->interface[i].element[1]];
        if (a == b) continue;
        record->interface[i].onset_time = 1;
        if (!late || i % 3 != 0) record->interface[i].break_time = 2;
    }
    free(seed);
    return cell;
}

/* ---- a body, broken or not, and what is seen of it ---- */

typedef struct {
    fracas_stored_mesh mesh;
    fracas_record record;
    fracas_surface_state now;
    uint32_t *cell;
} body;

/* cells: 0 for none broken. */
static inline void make_body(bool octant, size_t divisions, int order, size_t cells, bool late,
                             body *b)
{
    const fracas_surface_fineness fineness = {.divisions = divisions, .order = order};
    const fracas_surface *surface;
    if (octant) OK(fracas_surface_octant(1, &fineness, &surface));
    else OK(fracas_surface_sphere(1, &fineness, &surface));
    body_copy(surface, &b->mesh);
    assert_null(fracas_stored_mesh_fault(&b->mesh));
    b->cell = body_break(&b->mesh, cells ? cells : 1, octant, late, &b->record);
    OK(fracas_surface_state_create(&b->mesh, &b->record, 5, &b->now));
    assert_true(late || b->now.nfragments >= (cells ? cells / 2 : 1));
}

static inline void clear_body(body *b)
{
    fracas_surface_state_clear(&b->now);
    fracas_record_clear(&b->record);
    fracas_stored_mesh_clear(&b->mesh);
    free(b->cell);
}

static inline fracas_facets look(const body *b, double azimuth, double elevation, double explode,
                                 double thickness)
{
    const fracas_view view = {azimuth, elevation};
    const fracas_surface_picture form = {.view = &view, .explode = explode, .thickness = thickness};
    fracas_facets facets;
    OK(fracas_facets_create(&b->mesh, &b->now, &form, &facets));
    OK(fracas_facets_hide(&facets));
    return facets;
}

static inline double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static inline const double *corner(const fracas_facets *facets, size_t f, int k)
{
    return facets->node[facets->facet[f].node[k]];
}

static inline double area_of(const fracas_facets *facets, size_t f)
{
    return turn(corner(facets, f, 0), corner(facets, f, 1), corner(facets, f, 2)) / 2;
}

/* How near a facet is at a point, -INFINITY beside it; `close` is set where the point is on an
 * edge, to 1e-6 of the facet. */
static inline double depth_at(const fracas_facets *facets, size_t f, const double point[2],
                              bool *close)
{
    double share[3], depth = 0;
    for (int k = 0; k < 3; k++) {
        share[k] = turn(corner(facets, f, (k + 1) % 3), corner(facets, f, (k + 2) % 3), point) /
                   (2 * area_of(facets, f));
        if (!(share[k] > -1e-6)) return -INFINITY;
        if (share[k] < 1e-6) *close = true;
        depth += share[k] * corner(facets, f, k)[2];
    }
    return depth;
}

#endif
