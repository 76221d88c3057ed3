/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes made by hand, without the engine: a grid of squares cut in two, flat or rolled up to an
 * annulus. */
#ifndef FRACAS_TESTS_SUPPORT_STORED_MESH_H
#define FRACAS_TESTS_SUPPORT_STORED_MESH_H

#include "campaigns/store/mesh.h"
#include "engine/record.h"
#include "tests/support/test.h"

/* nx * ny squares. Flat: 1 m each, from (0, 0), tags as those of a plate. Rolled: x goes round
 * (clockwise on radius 2 + y, so that triangles still go counter-clockwise), tag 1 inner, 2 outer
 * circle. `middles`: with middle nodes, at the middles of the straight edges. */
typedef struct {
    size_t nx, ny;
    bool rolled, middles;
} grid_shape;

static inline int64_t grid_vertex(const grid_shape *shape, size_t i, size_t j)
{
    size_t columns = shape->rolled ? shape->nx : shape->nx + 1;
    return (int64_t)(j * columns + i % columns);
}

static inline void grid_place(const grid_shape *shape, size_t i, size_t j, double position[3])
{
    const double angle = -2 * M_PI * (double)i / (double)shape->nx, radius = 2 + (double)j;
    position[0] = shape->rolled ? radius * cos(angle) : (double)i;
    position[1] = shape->rolled ? radius * sin(angle) : (double)j;
    position[2] = 0;
}

/* Tag of the border a to b. */
static inline int64_t grid_tag(const grid_shape *shape, const int64_t node[3])
{
    const int64_t columns = (int64_t)(shape->rolled ? shape->nx : shape->nx + 1);
    const int64_t row[2] = {node[0] / columns, node[1] / columns},
                  column[2] = {node[0] % columns, node[1] % columns};
    if (row[0] == row[1]) return (shape->rolled ? 1 : 3) + (row[0] != 0);
    return column[0] == 0 ? 1 : 2;
}

/* Edge k of element e as a border or an interface, whichever it is; its middle is a node of its
 * own. */
static inline void grid_edge(const grid_shape *shape, fracas_stored_mesh *mesh, size_t e, int k)
{
    int64_t node[3] = {mesh->element[e].node[k], mesh->element[e].node[(k + 1) % 3], -1};
    for (size_t b = 0; b < mesh->nborders; b++) {
        fracas_stored_border other = mesh->border[b];
        if (other.node[0] != node[1] || other.node[1] != node[0]) continue;
        mesh->element[e].node[3 + k] = other.node[2];
        mesh->interface[mesh->ninterfaces++] = (fracas_stored_interface){
            {other.element, (int64_t)e}, {other.node[0], other.node[1], other.node[2]}};
        mesh->border[b] = mesh->border[--mesh->nborders];
        return;
    }
    if (shape->middles) {
        node[2] = (int64_t)mesh->nnodes;
        for (int i = 0; i < 3; i++)
            mesh->node[mesh->nnodes].position[i] =
                (mesh->node[node[0]].position[i] + mesh->node[node[1]].position[i]) / 2;
        mesh->nnodes++;
    }
    mesh->element[e].node[3 + k] = node[2];
    mesh->border[mesh->nborders++] = (fracas_stored_border){
        (int64_t)e, {node[0], node[1], node[2]}, grid_tag(shape, node)};
}

/* Cleared by the caller. Element 2 (j nx + i) is the lower right half of square (i, j), the next
 * one its upper left half. */
static inline void grid_make(const grid_shape *shape, fracas_stored_mesh *mesh)
{
    const size_t vertices = (shape->rolled ? shape->nx : shape->nx + 1) * (shape->ny + 1),
                 elements = 2 * shape->nx * shape->ny;
    *mesh = (fracas_stored_mesh){.nnodes = vertices + 3 * elements,
                                 .nelements = elements,
                                 .ninterfaces = 3 * elements,
                                 .nborders = 3 * elements};
    if (fracas_stored_mesh_allocate(mesh)) abort();
    mesh->nnodes = vertices;
    mesh->ninterfaces = mesh->nborders = 0;
    for (size_t j = 0; j <= shape->ny; j++)
        for (size_t i = 0; i < (shape->rolled ? shape->nx : shape->nx + 1); i++)
            grid_place(shape, i, j, mesh->node[grid_vertex(shape, i, j)].position);
    for (size_t j = 0; j < shape->ny; j++)
        for (size_t i = 0; i < shape->nx; i++) {
            const int64_t a = grid_vertex(shape, i, j), b = grid_vertex(shape, i + 1, j);
            const int64_t c = grid_vertex(shape, i + 1, j + 1), d = grid_vertex(shape, i, j + 1);
            mesh->element[2 * (j * shape->nx + i)] = (fracas_stored_element){{a, b, c, -1, -1, -1}};
            mesh->element[2 * (j * shape->nx + i) + 1] = (fracas_stored_element){
                {a, c, d, -1, -1, -1}};
        }
    for (size_t e = 0; e < elements; e++)
        for (int k = 0; k < 3; k++) grid_edge(shape, mesh, e, k);
}

/* A realization of the mesh in which nothing cracks. Cleared by the caller. */
static inline void grid_record(const fracas_stored_mesh *mesh, double end_time,
                               fracas_record *record)
{
    fracas_record_init(record);
    record->outcome = FRACAS_INTACT;
    record->end_time = end_time;
    record->ninterface = mesh->ninterfaces;
    record->interface = calloc(mesh->ninterfaces + 1, sizeof *record->interface);
    if (!record->interface) abort();
    for (size_t i = 0; i < mesh->ninterfaces; i++)
        record->interface[i] = (fracas_interface_row){
            .strength = 1e8, .onset_time = NAN, .break_time = NAN};
}

/* Cracks the interface between two vertices (NaN: not at all) and breaks it likewise; false if
 * there is none. */
static inline bool grid_crack(const fracas_stored_mesh *mesh, fracas_record *record, int64_t a,
                              int64_t b, double onset, double broken)
{
    for (size_t i = 0; i < mesh->ninterfaces; i++) {
        const int64_t *node = mesh->interface[i].node;
        if (!((node[0] == a && node[1] == b) || (node[0] == b && node[1] == a))) continue;
        record->interface[i].onset_time = onset;
        record->interface[i].break_time = broken;
        return true;
    }
    return false;
}

#endif
