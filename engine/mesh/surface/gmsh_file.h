/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contents of a Gmsh file, in its own numbers. */
#ifndef FRACAS_ENGINE_MESH_SURFACE_GMSH_FILE_H
#define FRACAS_ENGINE_MESH_SURFACE_GMSH_FILE_H

#include "engine/mesh/surface/gmsh_scan.h"
#include "engine/mesh/surface/surface.h"

/* A number of Gmsh's and its meaning. */
typedef struct {
    int64_t number, value;
} fracas_gmsh_entry;

/* A line in a physical group. */
typedef struct {
    int64_t node[2], element;
    int32_t tag;
} fracas_gmsh_line;

typedef struct {
    fracas_gmsh_scan scan;
    bool is_4; /* MSH 4.1, else 2 */
    size_t nnodes, nelements, nlines, ncurves, npieces, ngroups;
    double (*node)[3];
    fracas_gmsh_entry *node_entry; /* sorted: index of each node */
    int64_t (*corner)[6];          /* triangles */
    int64_t *element;              /* number of each triangle */
    fracas_gmsh_line *line;
    fracas_gmsh_entry *curve;    /* sorted: physical group of each curve */
    fracas_gmsh_entry *piece;    /* sorted: the same of its pieces, of a mesh in partitions */
    fracas_surface_group *group; /* names of physical groups of curves */
    unsigned passed;             /* as of fracas_surface */
    int order;                   /* 0: no triangle so far */
} fracas_gmsh_mesh;

/* Fills a mesh that is all zero but for the text of its scan; the caller clears, after an error
 * too. */
FRACAS_MUST_USE fracas_err fracas_gmsh_read(fracas_gmsh_mesh *mesh);
void fracas_gmsh_mesh_clear(fracas_gmsh_mesh *mesh);

/* NULL: no such number. */
const fracas_gmsh_entry *fracas_gmsh_find(const fracas_gmsh_entry *all, size_t count,
                                          int64_t number);

/* The group of an edge in two groups: the lesser, and *passed has a bit for the other; 0 where both
 * have keys that are always set. */
int32_t fracas_gmsh_choose(int32_t a, int32_t b, unsigned *passed);

/* ---- names (gmsh_names.c) ---- */

/* The number of a group of curves: the one of a key with its name, or else its own. Gmsh turns a
 * curve of a group round by a minus. */
int32_t fracas_gmsh_key_of(const fracas_surface_group *named, size_t count, int32_t group);

/* The first curves of a section of names from `at` on: dimension, number, "name"; other lines are
 * passed over. *at goes behind them; false: none is left before `end`. */
bool fracas_gmsh_next_group(const char *text, size_t end, size_t *at, fracas_surface_group *group);

/* Name number i, from 0, of the physical groups of curves in the text of a file; false after the
 * last. */
bool fracas_gmsh_group_name(const char *text, size_t size, size_t i, char name[64]);

/* *number: edge_N's N of the physical group of curves with this name in the text of a file; 0: no
 * such group. *shared: another group has the same key. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_gmsh_group(const char *text, size_t size, const char *name,
                                             int32_t *number, bool *shared);

#endif
