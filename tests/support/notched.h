/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces with a crack: the same triangles with doubled nodes along it, and as a mesh file with or
 * without a group of lines along it. */
#ifndef FRACAS_TESTS_SUPPORT_NOTCHED_H
#define FRACAS_TESTS_SUPPORT_NOTCHED_H

#include "engine/mesh/surface/gmsh.h"
#include "tests/support/surface.h"

#include <inttypes.h>

/* True for the interface, by its two nodes, that the crack has. */
typedef bool in_crack(const double a[3], const double b[3]);

static inline void edge_ends(const fracas_surface *s, size_t element, size_t edge, size_t node[3])
{
    const uint32_t *corner = s->element + element * s->corners;
    node[0] = corner[edge];
    node[1] = corner[(edge + 1) % 3];
    node[2] = s->order == 2 ? corner[3 + edge] : node[0];
}

static inline bool is_cracked(const fracas_surface *s, in_crack *crack, size_t i)
{
    size_t node[3];
    edge_ends(s, s->interface[i].element[0], s->interface[i].edge[0], node);
    return crack(s->node[node[0]], s->node[node[1]]);
}

/* MSH 2.2: element e of the surface has the number e + 1. Borders are lines of the groups of their
 * tags. `doubled`: elements of which `beyond` is true have nodes of their own on the crack but for
 * its `tip`; else the crack's interfaces are lines of the group 9, named `name`, and another
 * interface is one of the group 8. The caller frees. */
typedef struct {
    in_crack *crack;
    bool doubled;
    bool (*beyond)(const double middle[3]);
    bool (*tip)(const double node[3]);
    const char *name;
} crack_file;

static inline size_t number_in(const fracas_surface *s, const crack_file *how, const bool *on,
                               size_t element, size_t node)
{
    double middle[3] = {0};
    for (size_t k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) middle[i] += fracas_surface_node(s, element, k)[i] / 3;
    const bool other = how->doubled && on[node] && !how->tip(s->node[node]) && how->beyond(middle);
    return 1 + node + (other ? s->nnodes : 0);
}

static inline char *write_cracked(const fracas_surface *s, const crack_file *how)
{
    bool *on = zeroed(s->nnodes, sizeof *on);
    size_t cracked = 0, node[3];
    for (size_t i = 0; i < s->ninterfaces; i++) {
        if (!is_cracked(s, how->crack, i)) continue;
        cracked++;
        edge_ends(s, s->interface[i].element[0], s->interface[i].edge[0], node);
        for (int k = 0; k < 3; k++) on[node[k]] = true;
    }
    FILE *out = text_begin();
    fputs("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", out);
    fprintf(out, "$PhysicalNames\n1\n1 9 \"%s\"\n$EndPhysicalNames\n", how->name);
    fprintf(out, "$Nodes\n%zu\n", 2 * s->nnodes);
    for (size_t n = 0; n < 2 * s->nnodes; n++) {
        const double *x = s->node[n % s->nnodes];
        fprintf(out, "%zu %.17g %.17g %.17g\n", n + 1, x[0], x[1], x[2]);
    }
    const size_t lines = s->nborders + (how->doubled ? 0 : cracked + 1);
    bool other = true;
    fprintf(out, "$EndNodes\n$Elements\n%zu\n", s->nelements + lines);
    for (size_t e = 0; e < s->nelements; e++) {
        fprintf(out, "%zu %d 2 0 1", e + 1, s->order == 1 ? 2 : 9);
        for (size_t k = 0; k < s->corners; k++)
            fprintf(out, " %zu", number_in(s, how, on, e, s->element[e * s->corners + k]));
        fputc('\n', out);
    }
    size_t number = s->nelements;
    for (size_t b = 0; b < s->nborders + s->ninterfaces; b++) {
        const bool border = b < s->nborders;
        const size_t i = border ? 0 : b - s->nborders;
        const bool in = border || is_cracked(s, how->crack, i);
        if (!border && (how->doubled || (!in && !other))) continue;
        other = other && in;
        const size_t e = border ? s->border[b].element : s->interface[i].element[0];
        edge_ends(s, e, border ? s->border[b].edge : s->interface[i].edge[0], node);
        fprintf(out, "%zu %d 2 %" PRId32 " 1", ++number, s->order == 1 ? 1 : 8,
                border ? s->border[b].tag
                : in   ? 9
                       : 8);
        for (int k = 0; k < s->order + 1; k++)
            fprintf(out, " %zu", number_in(s, how, on, e, node[k]));
        fputc('\n', out);
    }
    fputs("$EndElements\n", out);
    free(on);
    return text_end(out);
}

#endif
