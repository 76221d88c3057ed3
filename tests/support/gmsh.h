/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes meshes as Gmsh does: MSH 2.2 and 4.1, text and binary of either byte order. */
#ifndef FRACAS_TESTS_SUPPORT_GMSH_H
#define FRACAS_TESTS_SUPPORT_GMSH_H

#include "engine/mesh/surface/gmsh.h"
#include "tests/support/surface.h"

typedef struct {
    char *bytes;
    size_t size, room;
    bool is_4, is_binary, is_swapped;
} gmsh_file;

static inline void gmsh_put(gmsh_file *f, const void *bytes, size_t size)
{
    if (f->size + size > f->room) {
        f->room = 2 * (f->size + size);
        f->bytes = realloc(f->bytes, f->room);
        assert_non_null(f->bytes);
    }
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

static inline void gmsh_text(gmsh_file *f, const char *text)
{
    gmsh_put(f, text, strlen(text));
}

static inline void gmsh_number(gmsh_file *f, const void *value, size_t size)
{
    unsigned char bytes[8];
    for (size_t i = 0; i < size; i++)
        bytes[i] = ((const unsigned char *)value)[f->is_swapped ? size - 1 - i : i];
    gmsh_put(f, bytes, size);
}

static inline void gmsh_int(gmsh_file *f, int32_t value)
{
    char text[24];
    snprintf(text, sizeof text, "%d ", value);
    if (f->is_binary) gmsh_number(f, &value, sizeof value);
    else gmsh_text(f, text);
}

static inline void gmsh_long(gmsh_file *f, int64_t value)
{
    char text[24];
    snprintf(text, sizeof text, "%lld ", (long long)value);
    if (f->is_binary) gmsh_number(f, &value, sizeof value);
    else gmsh_text(f, text);
}

/* A number of 4 bytes in 2.2, of 8 in 4.1. */
static inline void gmsh_name(gmsh_file *f, int64_t value)
{
    if (f->is_4) gmsh_long(f, value);
    else gmsh_int(f, (int32_t)value);
}

static inline void gmsh_real(gmsh_file *f, double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g ", value);
    if (f->is_binary) gmsh_number(f, &value, sizeof value);
    else gmsh_text(f, text);
}

static inline void gmsh_line_end(gmsh_file *f)
{
    if (!f->is_binary) gmsh_text(f, "\n");
}

static inline void gmsh_count(gmsh_file *f, size_t count) /* of 2.2 */
{
    char text[24];
    snprintf(text, sizeof text, "%zu\n", count);
    gmsh_text(f, text);
}

/* Gmsh's numbers, with gaps and not in order. */
static inline int64_t gmsh_node(const fracas_surface *s, size_t n)
{
    return 1000 + 3 * (int64_t)(s->nnodes - n);
}

static inline int64_t gmsh_element(size_t e)
{
    return 500 + 2 * (int64_t)e;
}

static inline void gmsh_head(gmsh_file *f)
{
    char text[64];
    const int32_t one = 1;
    snprintf(text, sizeof text, "$MeshFormat\n%s %d 8\n", f->is_4 ? "4.1" : "2.2", f->is_binary);
    gmsh_text(f, text);
    if (f->is_binary) gmsh_number(f, &one, sizeof one);
    gmsh_text(f, f->is_binary ? "\n$EndMeshFormat\n" : "$EndMeshFormat\n");
    gmsh_text(f, "$PhysicalNames\n1\n1 3 \"a name\"\n$EndPhysicalNames\n");
}

/* A point, curves 1 to 4 in the physical groups 1 to 4 (the second turned round), curve 5 in none.
 */
static inline void gmsh_entities(gmsh_file *f)
{
    gmsh_text(f, "$Entities\n");
    gmsh_long(f, 1), gmsh_long(f, 5), gmsh_long(f, 1), gmsh_long(f, 0);
    gmsh_line_end(f);
    gmsh_int(f, 1);
    for (int i = 0; i < 3; i++) gmsh_real(f, 0.25);
    gmsh_long(f, 2), gmsh_int(f, 8), gmsh_int(f, 9);
    gmsh_line_end(f);
    for (int c = 1; c <= 6; c++) { /* the sixth is the surface */
        gmsh_int(f, c == 6 ? 1 : c);
        for (int i = 0; i < 6; i++) gmsh_real(f, 0.1 * i);
        gmsh_long(f, c != 5);
        if (c != 5) gmsh_int(f, c == 2 ? -c : c);
        gmsh_long(f, 2), gmsh_int(f, 1), gmsh_int(f, -1);
        gmsh_line_end(f);
    }
    gmsh_text(f, f->is_binary ? "\n$EndEntities\n" : "$EndEntities\n");
}

/* The surface's nodes, in 4.1 with parameters on the surface, and one more that no triangle has. */
static inline void gmsh_nodes(gmsh_file *f, const fracas_surface *s)
{
    gmsh_text(f, "$Nodes\n");
    if (!f->is_4) gmsh_count(f, s->nnodes + 1);
    if (f->is_4) {
        gmsh_long(f, 2), gmsh_long(f, (int64_t)s->nnodes + 1), gmsh_long(f, 7), gmsh_long(f, 99999);
        gmsh_line_end(f);
        gmsh_int(f, 0), gmsh_int(f, 1), gmsh_int(f, 0), gmsh_long(f, 1);
        gmsh_line_end(f);
    }
    gmsh_name(f, 7);
    for (int i = 0; i < 3; i++) gmsh_real(f, -1.5);
    gmsh_line_end(f);
    if (f->is_4) {
        gmsh_int(f, 2), gmsh_int(f, 1), gmsh_int(f, 1), gmsh_long(f, (int64_t)s->nnodes);
        gmsh_line_end(f);
        for (size_t n = 0; n < s->nnodes; n++) gmsh_long(f, gmsh_node(s, n));
        gmsh_line_end(f);
    }
    for (size_t n = 0; n < s->nnodes; n++) {
        if (!f->is_4) gmsh_name(f, gmsh_node(s, n));
        for (int i = 0; i < 3; i++) gmsh_real(f, s->node[n][i]);
        if (f->is_4) gmsh_real(f, 0.5), gmsh_real(f, 0.5);
        gmsh_line_end(f);
    }
    gmsh_text(f, f->is_binary ? "\n$EndNodes\n" : "$EndNodes\n");
}

/* Before the nodes of one or, in a binary file and in 4.1, several elements of a type. */
static inline void gmsh_block(gmsh_file *f, int dimension, int entity, int type, size_t count)
{
    if (f->is_4) {
        gmsh_int(f, dimension), gmsh_int(f, entity), gmsh_int(f, type),
            gmsh_long(f, (int64_t)count);
        gmsh_line_end(f);
    } else if (f->is_binary) {
        gmsh_int(f, type), gmsh_int(f, (int32_t)count), gmsh_int(f, 2);
    }
}

static inline void gmsh_one(gmsh_file *f, int64_t number, int type, int group, int entity)
{
    gmsh_name(f, number);
    if (!f->is_4 && !f->is_binary) gmsh_int(f, type), gmsh_int(f, 2);
    if (!f->is_4) gmsh_int(f, group), gmsh_int(f, entity);
}

/* A point, a line of no group on the first border, each border as a line of the group of its tag,
 * all triangles. */
static inline void gmsh_elements(gmsh_file *f, const fracas_surface *s)
{
    const int line = s->order == 1 ? 1 : 8, triangle = s->order == 1 ? 2 : 9;
    gmsh_text(f, "$Elements\n");
    const size_t lines = s->nborders ? s->nborders + 1 : 0, all = s->nelements + lines + 1;
    if (!f->is_4) gmsh_count(f, all);
    if (f->is_4) {
        gmsh_long(f, (int64_t)lines + 2), gmsh_long(f, (int64_t)all), gmsh_long(f, 1),
            gmsh_long(f, 99999);
        gmsh_line_end(f);
    }
    gmsh_block(f, 0, 1, 15, 1);
    gmsh_one(f, 1, 15, 0, 1);
    gmsh_name(f, 7);
    gmsh_line_end(f);
    for (size_t i = 0; i < lines; i++) {
        const fracas_surface_border *b = &s->border[i ? i - 1 : 0];
        const int group = i ? b->tag : 0, curve = i ? b->tag : 5;
        gmsh_block(f, 1, curve, line, 1);
        gmsh_one(f, 2 + (int64_t)i, line, group == 2 && f->is_4 ? -2 : group, curve);
        for (uint32_t k = 0; k < 2; k++)
            gmsh_name(f, gmsh_node(s, corner_of(s, b->element, (b->edge + k) % 3)));
        if (s->order == 2) gmsh_name(f, gmsh_node(s, corner_of(s, b->element, 3 + b->edge)));
        gmsh_line_end(f);
    }
    gmsh_block(f, 2, 1, triangle, s->nelements);
    for (size_t e = 0; e < s->nelements; e++) {
        gmsh_one(f, gmsh_element(e), triangle, 1, 1);
        for (size_t k = 0; k < s->corners; k++) gmsh_name(f, gmsh_node(s, corner_of(s, e, k)));
        gmsh_line_end(f);
    }
    gmsh_text(f, f->is_binary ? "\n$EndElements\n" : "$EndElements\n");
}

/* The caller frees `bytes`. */
static inline gmsh_file gmsh_write(const fracas_surface *s, bool is_4, bool is_binary,
                                   bool is_swapped)
{
    gmsh_file f = {.is_4 = is_4, .is_binary = is_binary, .is_swapped = is_swapped};
    gmsh_head(&f);
    if (is_4) gmsh_entities(&f);
    gmsh_nodes(&f, s);
    gmsh_elements(&f, s);
    gmsh_text(&f, "$NodeData\n1\n\"anything $Nodes\"\n$EndNodeData\n");
    return f;
}

#endif
