/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uncracked shells: their models, on meshes that a map bends or from the engine's makers
 * (docs/theory/shell.md). */
#ifndef FRACAS_TESTS_SUPPORT_SHELL_H
#define FRACAS_TESTS_SUPPORT_SHELL_H

#include "engine/formulation/shell/shell.h"
#include "engine/formulation/shell/geometry.h"
#include "engine/integrator/integrator.h"
#include "engine/mesh/make.h"
#include "tests/support/surface_state.h"

/* Steel-like in units of its own, thickness 0.1; beta 5, beta_shear 1; never cracks. */
static inline fracas_spec shell_spec(const fracas_kind *shape)
{
    fracas_spec spec = surface_spec(&fracas_formulation_shell, shape);
    spec.geometry.thickness = 0.1;
    spec.geometry.radius = spec.geometry.width = spec.geometry.height = 1;
    spec.material = (fracas_material){.young = 200, .density = 2, .poisson = 0.3};
    spec.cohesive.fracture_energy = 1e12;
    return spec;
}

/* ---- a rectangle of nx x ny cells, two triangles each, that a map of [0, 1]^2 puts in space ----
 */

typedef void shell_map(const void *how, double s, double t, double x[3]);

typedef struct {
    size_t nx, ny;
    shell_map *map;
    const void *how;
    double distortion; /* of inner vertices, in cells; middles of edges stay in the middle, before
                          the map */
    uint64_t seed;
    int diagonals; /* 0: alternate, 1: all along s = t, 2: all across */
} shell_grid;

static inline size_t grid_node(const shell_grid *g, size_t i, size_t j)
{
    return j * (2 * g->nx + 1) + i;
}

static inline void grid_places(const shell_grid *g, double (*at)[2])
{
    uint64_t noise = g->seed + 1;
    const size_t nx = 2 * g->nx, ny = 2 * g->ny;
    for (size_t j = 0; j <= ny; j += 2)
        for (size_t i = 0; i <= nx; i += 2)
            for (int c = 0; c < 2; c++) {
                const bool inner = i > 0 && j > 0 && i < nx && j < ny;
                const double move = inner ? g->distortion * (2 * next_share(&noise) - 1) : 0;
                at[grid_node(g, i, j)][c] = c ? ((double)j / 2 + move) / (double)g->ny
                                              : ((double)i / 2 + move) / (double)g->nx;
            }
}

/* Which way the cell's diagonal goes: from its corner of the smallest s, t to that of the largest.
 */
static inline bool goes_up(const shell_grid *g, size_t i, size_t j)
{
    return g->diagonals == 1 || (g->diagonals == 0 && (i + j) % 2 == 0);
}

/* Tags: 1 s = 0, 2 s = 1, 3 t = 0, 4 t = 1. The caller frees. */
static inline fracas_surface_tag *grid_tags(const shell_grid *g, size_t *count)
{
    fracas_surface_tag *tag = taken(2 * (g->nx + g->ny) * sizeof *tag), *put = tag;
    for (size_t j = 0; j < g->ny; j++)
        for (int side = 0; side < 2; side++) {
            const size_t i = side ? 2 * g->nx : 0;
            *put++ = (fracas_surface_tag){
                {(uint32_t)grid_node(g, i, 2 * j), (uint32_t)grid_node(g, i, 2 * j + 2)}, 1 + side};
        }
    for (size_t i = 0; i < g->nx; i++)
        for (int side = 0; side < 2; side++) {
            const size_t j = side ? 2 * g->ny : 0;
            *put++ = (fracas_surface_tag){
                {(uint32_t)grid_node(g, 2 * i, j), (uint32_t)grid_node(g, 2 * i + 2, j)}, 3 + side};
        }
    *count = (size_t)(put - tag);
    return tag;
}

static inline uint32_t *grid_elements(const shell_grid *g, double (*at)[2])
{
    uint32_t *element = taken(12 * g->nx * g->ny * sizeof *element), *put = element;
    for (size_t j = 0; j < g->ny; j++)
        for (size_t i = 0; i < g->nx; i++) {
            const size_t corner[4][2] = {
                {2 * i, 2 * j}, {2 * i + 2, 2 * j}, {2 * i + 2, 2 * j + 2}, {2 * i, 2 * j + 2}};
            const int up[2][3] = {{0, 1, 2}, {0, 2, 3}}, down[2][3] = {{0, 1, 3}, {1, 2, 3}};
            for (int half = 0; half < 2; half++) {
                const int *c = goes_up(g, i, j) ? up[half] : down[half];
                for (int k = 0; k < 6; k++) {
                    const size_t *a = corner[c[k % 3]], *b = corner[c[(k + (k > 2)) % 3]];
                    const size_t n = grid_node(g, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
                    for (int x = 0; x < 2 && k > 2; x++)
                        at[n][x] = 0.5 * (at[grid_node(g, a[0], a[1])][x] +
                                          at[grid_node(g, b[0], b[1])][x]);
                    *put++ = (uint32_t)n;
                }
            }
        }
    return element;
}

static inline fracas_model *grid_model(const fracas_spec *spec, const shell_grid *g)
{
    const size_t nodes = (2 * g->nx + 1) * (2 * g->ny + 1);
    double(*at)[2] = zeroed(nodes, sizeof *at), (*node)[3] = zeroed(nodes, sizeof *node);
    grid_places(g, at);
    OWNED uint32_t *element = grid_elements(g, at);
    size_t ntags;
    OWNED fracas_surface_tag *tag = grid_tags(g, &ntags);
    for (size_t n = 0; n < nodes; n++) g->map(g->how, at[n][0], at[n][1], node[n]);
    const fracas_surface_arrays arrays = {.order = 2,
                                          .nnodes = nodes,
                                          .nelements = 2 * g->nx * g->ny,
                                          .ntags = ntags,
                                          .node = (const double(*)[3])node,
                                          .element = element,
                                          .tag = tag};
    const fracas_surface *surface;
    OK(fracas_surface_assemble(&arrays, &surface));
    fracas_model *model = mesh_model(*spec, surface);
    fracas_surface_destroy(surface);
    free(node);
    free(at);
    return model;
}

/* `how`: width and height. */
static inline void flat_map(const void *how, double s, double t, double x[3])
{
    const double *size = how;
    x[0] = s * size[0];
    x[1] = t * size[1];
    x[2] = 0;
}

/* `how`: radius, length along y, half the angle from the top. */
static inline void roof_map(const void *how, double s, double t, double x[3])
{
    const double *size = how, angle = (2 * s - 1) * size[2];
    x[0] = size[0] * sin(angle);
    x[1] = (t - 0.5) * size[1];
    x[2] = size[0] * cos(angle);
}

#endif
