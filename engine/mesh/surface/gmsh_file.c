/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/surface/gmsh_file.h"

#include "base/own.h"
#include "engine/spec.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GMSH_LINE = 1, GMSH_TRIANGLE = 2, GMSH_LINE_3 = 8, GMSH_TRIANGLE_6 = 9, GMSH_POINT = 15 };

void fracas_gmsh_mesh_clear(fracas_gmsh_mesh *m)
{
    free(m->node);
    free(m->node_entry);
    free(m->corner);
    free(m->element);
    free(m->line);
    free(m->curve);
    free(m->piece);
    free(m->group);
}

static int compare_entries(const void *left, const void *right)
{
    const fracas_gmsh_entry *a = left, *b = right;
    return a->number < b->number ? -1 : a->number > b->number;
}

const fracas_gmsh_entry *fracas_gmsh_find(const fracas_gmsh_entry *all, size_t count,
                                          int64_t number)
{
    const fracas_gmsh_entry key = {.number = number};
    return count ? bsearch(&key, all, count, sizeof *all, compare_entries) : NULL;
}

/* Sorts; FRACAS_USAGE for a number that comes twice. */
static fracas_err sort(const fracas_gmsh_mesh *m, const char *what, fracas_gmsh_entry *all,
                       size_t count)
{
    if (count) qsort(all, count, sizeof *all, compare_entries);
    for (size_t i = 1; i < count; i++)
        if (all[i].number == all[i - 1].number)
            return fracas_gmsh_fail(&m->scan, "%s %" PRId64 " comes twice", what, all[i].number);
    return FRACAS_OK;
}

/* Reads a count, then as many `int`s; *last: the last of them, 0 without any. */
static fracas_err read_list(fracas_gmsh_mesh *m, int64_t *count, int32_t *last)
{
    *last = 0;
    TRY(fracas_gmsh_integer(&m->scan, 8, count));
    TRY(fracas_gmsh_fits(&m->scan, *count, 1));
    for (int64_t i = 0; i < *count; i++) TRY(fracas_gmsh_ints(&m->scan, 1, last));
    return FRACAS_OK;
}

/* ---- physical groups ---- */

/* Their number, then a line each. */
static fracas_err read_names(fracas_gmsh_mesh *m)
{
    const size_t begin = m->scan.at;
    size_t lines = 0;
    if (m->group) return fracas_gmsh_fail(&m->scan, "a second section $PhysicalNames");
    TRY(fracas_gmsh_skip(&m->scan, "PhysicalNames"));
    for (size_t i = begin; i < m->scan.at; i++) lines += m->scan.text[i] == '\n';
    m->group = malloc((lines + 1) * sizeof *m->group);
    if (!m->group) return fracas_no_memory("the names of a mesh");
    for (size_t at = begin; m->ngroups < lines;)
        if (fracas_gmsh_next_group(m->scan.text, m->scan.at, &at, &m->group[m->ngroups]))
            m->ngroups++;
        else break;
    return FRACAS_OK;
}

/* ---- entities (4.1): the physical group of each curve ---- */

/* Physical groups of an entity of 0 to 3 dimensions, and the entities on its border. *clash: two
 * of the groups, of which neither is to be chosen. */
static fracas_err read_groups(fracas_gmsh_mesh *m, int dimension, int32_t *group, int32_t clash[2])
{
    int32_t one;
    int64_t count;
    double box[6];
    unsigned passed = 0;
    *group = clash[0] = 0;
    TRY(fracas_gmsh_reals(&m->scan, dimension == 0 ? 3 : 6, box));
    TRY(fracas_gmsh_integer(&m->scan, 8, &count));
    TRY(fracas_gmsh_fits(&m->scan, count, 1));
    for (int64_t i = 0; i < count; i++) {
        TRY(fracas_gmsh_ints(&m->scan, 1, &one));
        one = fracas_gmsh_key_of(m->group, m->ngroups, one);
        const int32_t before = *group;
        *group = i ? fracas_gmsh_choose(before, one, &passed) : one;
        if (i && *group == 0) clash[0] = before, clash[1] = one;
    }
    if (dimension == 1) m->passed |= passed;
    return dimension == 0 ? FRACAS_OK : read_list(m, &count, &one);
}

static fracas_err add_curve(const fracas_gmsh_mesh *m, int32_t number, int32_t group,
                            const int32_t clash[2], fracas_gmsh_entry *curve)
{
    if (clash[0] != 0)
        return fracas_gmsh_fail(&m->scan,
                                "curve %" PRId32 " is in the physical groups %" PRId32
                                " and %" PRId32 ": an edge has one at most of those with keys",
                                number, clash[0], clash[1]);
    *curve = (fracas_gmsh_entry){.number = number, .value = group};
    return FRACAS_OK;
}

static fracas_err read_entity(fracas_gmsh_mesh *m, int dimension)
{
    int32_t number, group, clash[2];
    TRY(fracas_gmsh_ints(&m->scan, 1, &number));
    TRY(read_groups(m, dimension, &group, clash));
    return dimension == 1 ? add_curve(m, number, group, clash, &m->curve[m->ncurves++]) : FRACAS_OK;
}

/* Number, dimension and number of what it is a piece of, partitions, then as an entity. A piece's
 * groups are those of the whole; where partitions meet, curves are pieces of a surface. */
static fracas_err read_piece(fracas_gmsh_mesh *m, int dimension)
{
    int32_t head[3], partition, group, clash[2];
    int64_t partitions;
    TRY(fracas_gmsh_ints(&m->scan, 3, head));
    TRY(read_list(m, &partitions, &partition));
    TRY(read_groups(m, dimension, &group, clash));
    if (dimension != 1) return FRACAS_OK;
    if (head[1] != 1) group = clash[0] = 0;
    return add_curve(m, head[0], group, clash, &m->piece[m->npieces++]);
}

/* Counts of points, curves, surfaces, volumes, then all of them. */
static fracas_err read_each(fracas_gmsh_mesh *m, fracas_gmsh_entry **curve,
                            fracas_err (*read)(fracas_gmsh_mesh *m, int dimension))
{
    int64_t count[4];
    if (*curve) return fracas_gmsh_fail(&m->scan, "a second section of entities");
    for (int d = 0; d < 4; d++) TRY(fracas_gmsh_integer(&m->scan, 8, &count[d]));
    for (int d = 0; d < 4; d++) TRY(fracas_gmsh_fits(&m->scan, count[d], 5));
    *curve = malloc(((size_t)count[1] + 1) * sizeof **curve); /* there may be none */
    if (!*curve) return fracas_no_memory("the curves of a mesh");
    for (int d = 0; d < 4; d++)
        for (int64_t i = 0; i < count[d]; i++) TRY(read(m, d));
    return FRACAS_OK;
}

static fracas_err read_entities(fracas_gmsh_mesh *m)
{
    TRY(read_each(m, &m->curve, read_entity));
    return sort(m, "curve", m->curve, m->ncurves);
}

/* The number of partitions and their ghosts, then the pieces. */
static fracas_err read_pieces(fracas_gmsh_mesh *m)
{
    int64_t partitions, ghosts;
    int32_t ghost[2];
    TRY(fracas_gmsh_integer(&m->scan, 8, &partitions));
    TRY(fracas_gmsh_integer(&m->scan, 8, &ghosts));
    TRY(fracas_gmsh_fits(&m->scan, ghosts, 2));
    for (int64_t i = 0; i < ghosts; i++) TRY(fracas_gmsh_ints(&m->scan, 2, ghost));
    TRY(read_each(m, &m->piece, read_piece));
    return sort(m, "curve", m->piece, m->npieces);
}

/* ---- heads of sections and blocks ---- */

/* 2.2: the number of things, text even in a binary file. */
static fracas_err read_count(fracas_gmsh_mesh *m, int64_t *count)
{
    const bool is_binary = m->scan.is_binary;
    m->scan.is_binary = false;
    fracas_err err = fracas_gmsh_integer(&m->scan, 8, count);
    if (!err) err = fracas_gmsh_line_end(&m->scan);
    m->scan.is_binary = is_binary;
    return err;
}

/* 4.1: blocks, things in them all, lowest and highest number. */
static fracas_err read_head(fracas_gmsh_mesh *m, int64_t head[4])
{
    for (int i = 0; i < 4; i++) TRY(fracas_gmsh_integer(&m->scan, 8, &head[i]));
    return fracas_gmsh_fits(&m->scan, head[0], 4);
}

static fracas_err check_block(const fracas_gmsh_mesh *m, const char *things, int64_t least,
                              int64_t count, size_t left)
{
    if (count >= least && (size_t)count <= left) return FRACAS_OK;
    return fracas_gmsh_fail(&m->scan,
                            "%" PRId64 " %s in a block, but %zu are left of those announced", count,
                            things, left);
}

/* 4.1: three numbers, and the number of things, at most `left`. */
static fracas_err read_block(fracas_gmsh_mesh *m, const char *things, size_t left, int32_t head[3],
                             int64_t *count)
{
    TRY(fracas_gmsh_ints(&m->scan, 3, head));
    TRY(fracas_gmsh_integer(&m->scan, 8, count));
    return check_block(m, things, 0, *count, left);
}

/* ---- nodes ---- */

static fracas_err allocate_nodes(fracas_gmsh_mesh *m, int64_t count)
{
    if (m->node) return fracas_gmsh_fail(&m->scan, "a second section $Nodes");
    TRY(fracas_gmsh_fits(&m->scan, count, 4));
    m->node = malloc(((size_t)count + 1) * sizeof *m->node);
    m->node_entry = malloc(((size_t)count + 1) * sizeof *m->node_entry);
    return m->node && m->node_entry ? FRACAS_OK : fracas_no_memory("the nodes of a mesh");
}

static fracas_err read_nodes_2(fracas_gmsh_mesh *m)
{
    int64_t count;
    TRY(read_count(m, &count));
    TRY(allocate_nodes(m, count));
    for (; m->nnodes < (size_t)count; m->nnodes++) {
        fracas_gmsh_entry *of = &m->node_entry[m->nnodes];
        of->value = (int64_t)m->nnodes;
        TRY(fracas_gmsh_integer(&m->scan, 4, &of->number));
        TRY(fracas_gmsh_reals(&m->scan, 3, m->node[m->nnodes]));
    }
    return sort(m, "node", m->node_entry, m->nnodes);
}

/* Numbers of the block's nodes, then their coordinates, with those on the entity itself where it is
 * parametric. */
static fracas_err read_node_block(fracas_gmsh_mesh *m, size_t all)
{
    int32_t head[3]; /* dimension, entity, is it parametric */
    int64_t count;
    double ignored[3];
    TRY(read_block(m, "nodes", all - m->nnodes, head, &count));
    if (head[0] < 0 || head[0] > 3)
        return fracas_gmsh_fail(&m->scan, "nodes of an entity of %" PRId32 " dimensions", head[0]);
    for (size_t n = m->nnodes; n < m->nnodes + (size_t)count; n++) {
        TRY(fracas_gmsh_integer(&m->scan, 8, &m->node_entry[n].number));
        m->node_entry[n].value = (int64_t)n;
    }
    for (int64_t i = 0; i < count; i++, m->nnodes++) {
        TRY(fracas_gmsh_reals(&m->scan, 3, m->node[m->nnodes]));
        if (head[2]) TRY(fracas_gmsh_reals(&m->scan, (size_t)head[0], ignored));
    }
    return FRACAS_OK;
}

static fracas_err read_nodes_4(fracas_gmsh_mesh *m)
{
    int64_t head[4];
    TRY(read_head(m, head));
    TRY(allocate_nodes(m, head[1]));
    for (int64_t block = 0; block < head[0]; block++) TRY(read_node_block(m, (size_t)head[1]));
    return sort(m, "node", m->node_entry, m->nnodes);
}

/* ---- elements ---- */

/* Nodes of an element; FRACAS_USAGE with its name for those that are no part of a surface. */
static fracas_err nodes_of_type(const fracas_gmsh_mesh *m, int32_t type, size_t *nodes)
{
    enum { LINE, TRIANGLE, QUAD, TETRA, HEXA, PRISM, PYRAMID, POINT };
    static const char *const shapes[] = {"lines",     "triangles", "quadrangles", "tetrahedra",
                                         "hexahedra", "prisms",    "pyramids"};
    static const struct {
        uint8_t nodes, shape;
    } types[] = {{0, 0},         {2, LINE},      {3, TRIANGLE},  {4, QUAD},      {4, TETRA},
                 {8, HEXA},      {6, PRISM},     {5, PYRAMID},   {3, LINE},      {6, TRIANGLE},
                 {9, QUAD},      {10, TETRA},    {27, HEXA},     {18, PRISM},    {14, PYRAMID},
                 {1, POINT},     {8, QUAD},      {20, HEXA},     {15, PRISM},    {13, PYRAMID},
                 {9, TRIANGLE},  {10, TRIANGLE}, {12, TRIANGLE}, {15, TRIANGLE}, {15, TRIANGLE},
                 {21, TRIANGLE}, {4, LINE},      {5, LINE},      {6, LINE},      {20, TETRA},
                 {35, TETRA},    {56, TETRA}};
    const bool known = type > 0 && (size_t)type < sizeof types / sizeof *types;
    *nodes = known ? types[type].nodes : 0;
    if (type == GMSH_LINE || type == GMSH_TRIANGLE || type == GMSH_LINE_3 ||
        type == GMSH_TRIANGLE_6 || type == GMSH_POINT)
        return FRACAS_OK;
    const int shape = known ? types[type].shape : LINE;
    if (known)
        return fracas_gmsh_fail(
            &m->scan,
            "%zu-node %s (Gmsh's type %" PRId32 "): a surface has 3- or 6-node triangles: %s",
            *nodes, shapes[shape], type,
            shape == QUAD                        ? "mesh it without Recombine"
            : shape == LINE || shape == TRIANGLE ? "set Mesh.ElementOrder to 1 or 2"
                                                 : "mesh the surface alone, with `gmsh -2`");
    return fracas_gmsh_fail(
        &m->scan, "elements of Gmsh's type %" PRId32 ": a surface has 3- or 6-node triangles",
        type);
}

static fracas_err allocate_elements(fracas_gmsh_mesh *m, int64_t count)
{
    if (m->corner) return fracas_gmsh_fail(&m->scan, "a second section $Elements");
    TRY(fracas_gmsh_fits(&m->scan, count, 2));
    m->corner = malloc(((size_t)count + 1) * sizeof *m->corner);
    m->element = malloc(((size_t)count + 1) * sizeof *m->element);
    m->line = malloc(((size_t)count + 1) * sizeof *m->line);
    return m->corner && m->element && m->line ? FRACAS_OK
                                              : fracas_no_memory("the elements of a mesh");
}

/* Reads the nodes of an element, and keeps it where it matters. */
static fracas_err read_element(fracas_gmsh_mesh *m, int32_t type, size_t bytes, int64_t number,
                               int32_t tag)
{
    size_t nodes = 0;
    int64_t node[6];
    TRY(nodes_of_type(m, type, &nodes));
    for (size_t k = 0; k < nodes; k++) TRY(fracas_gmsh_integer(&m->scan, bytes, &node[k]));
    if (tag == INT32_MIN)
        return fracas_gmsh_fail(&m->scan, "element %" PRId64 " in the physical group %" PRId32,
                                number, tag);
    if ((type == GMSH_LINE || type == GMSH_LINE_3) && tag != 0)
        m->line[m->nlines++] = (fracas_gmsh_line){
            .node = {node[0], node[1]},
            .element = number,
            .tag = fracas_gmsh_key_of(m->group, m->ngroups, tag)};
    if (type != GMSH_TRIANGLE && type != GMSH_TRIANGLE_6) return FRACAS_OK;
    const int order = type == GMSH_TRIANGLE ? 1 : 2;
    if (m->order != 0 && m->order != order)
        return fracas_gmsh_fail(&m->scan,
                                "element %" PRId64
                                " is a %zu-node triangle, those before are of the other order",
                                number, nodes);
    m->order = order;
    memcpy(m->corner[m->nelements], node, nodes * sizeof *node);
    m->element[m->nelements++] = number;
    return FRACAS_OK;
}

/* Text has the number, type and count of tags of each element; a binary file has blocks of one type
 * and count of tags. The first tag is the physical group. */
static fracas_err read_elements_2(fracas_gmsh_mesh *m)
{
    int64_t count, left = 0, number;
    int32_t type = 0, follow, tags = 0, tag, group;
    TRY(read_count(m, &count));
    TRY(allocate_elements(m, count));
    for (int64_t i = 0; i < count; i++) {
        if (m->scan.is_binary && left == 0) {
            int32_t head[3];
            TRY(fracas_gmsh_ints(&m->scan, 3, head));
            type = head[0], follow = head[1], tags = head[2];
            TRY(check_block(m, "elements", 1, follow, (size_t)(count - i)));
            left = follow;
        }
        left--;
        TRY(fracas_gmsh_integer(&m->scan, 4, &number));
        if (!m->scan.is_binary) {
            TRY(fracas_gmsh_ints(&m->scan, 1, &type));
            TRY(fracas_gmsh_ints(&m->scan, 1, &tags));
        }
        TRY(fracas_gmsh_fits(&m->scan, tags, 1));
        group = 0;
        for (int32_t t = 0; t < tags; t++)
            TRY(fracas_gmsh_ints(&m->scan, 1, t == 0 ? &group : &tag));
        TRY(read_element(m, type, 4, number, group));
    }
    return FRACAS_OK;
}

static fracas_err read_elements_4(fracas_gmsh_mesh *m)
{
    int64_t head[4], count, number, left;
    TRY(read_head(m, head));
    TRY(allocate_elements(m, head[1]));
    left = head[1];
    for (int64_t block = 0; block < head[0]; block++, left -= count) {
        int32_t of[3]; /* dimension, entity, type */
        TRY(read_block(m, "elements", (size_t)left, of, &count));
        const fracas_gmsh_entry *curve = of[0] == 1 ? fracas_gmsh_find(m->piece, m->npieces, of[1])
                                                    : NULL;
        if (of[0] == 1 && !curve) curve = fracas_gmsh_find(m->curve, m->ncurves, of[1]);
        for (int64_t i = 0; i < count; i++) {
            TRY(fracas_gmsh_integer(&m->scan, 8, &number));
            TRY(read_element(m, of[2], 8, number, curve ? (int32_t)curve->value : 0));
        }
    }
    return FRACAS_OK;
}

/* ---- the file ---- */

/* "$MeshFormat", version, 0 or 1 for text or binary, bytes of a double; in a binary file the
 * number 1. */
static fracas_err read_format(fracas_gmsh_mesh *m)
{
    fracas_gmsh_scan *scan = &m->scan;
    char version[FRACAS_GMSH_WORD];
    int64_t kind, bytes;
    if (scan->size >= 3 && !memcmp(scan->text, "\xef\xbb\xbf", 3)) scan->at = 3; /* UTF-8 */
    if (fracas_gmsh_at_end(scan)) return fracas_gmsh_fail(scan, "an empty file");
    while (scan->size - scan->at > 9 && !memcmp(scan->text + scan->at, "$Comments", 9)) {
        TRY(fracas_gmsh_skip(scan, "Comments"));
        if (fracas_gmsh_at_end(scan)) break;
    }
    if (scan->size - scan->at < 11 || memcmp(scan->text + scan->at, "$MeshFormat", 11)) {
        char word[FRACAS_GMSH_WORD];
        TRY(fracas_gmsh_word(scan, word));
        return fracas_gmsh_fail(scan,
                                "expected $MeshFormat, not `%s`: no Gmsh mesh; a .geo or .step "
                                "becomes one by `gmsh -2 FILE -o NEW.msh`",
                                word);
    }
    TRY(fracas_gmsh_expect(scan, "$MeshFormat"));
    TRY(fracas_gmsh_word(scan, version));
    TRY(fracas_gmsh_integer(scan, 8, &kind));
    TRY(fracas_gmsh_integer(scan, 8, &bytes));
    m->is_4 = strcmp(version, "4.1") == 0;
    if (!m->is_4 && strcmp(version, "2") != 0 && strncmp(version, "2.", 2) != 0)
        return fracas_gmsh_fail(scan,
                                "a mesh of format %s: save it as 4.1 or 2.2 (gmsh FILE -save "
                                "-format msh41 -o NEW.msh)",
                                version);
    if (bytes != 8 || (kind != 0 && kind != 1))
        return fracas_gmsh_fail(scan,
                                "the format %s %" PRId64 " %" PRId64 ": expected 0 or 1, and 8",
                                version, kind, bytes);
    if (kind == 1) {
        TRY(fracas_gmsh_line_end(scan));
        int32_t one;
        scan->is_binary = true;
        TRY(fracas_gmsh_ints(scan, 1, &one));
        scan->is_swapped = one == 0x01000000;
        if (one != 1 && !scan->is_swapped)
            return fracas_gmsh_fail(
                scan, "the number that tells the byte order is %" PRId32 ", not 1", one);
    }
    return fracas_gmsh_expect(scan, "$EndMeshFormat");
}

typedef struct {
    const char *name;
    fracas_err (*read[2])(fracas_gmsh_mesh *m); /* 2.2, 4.1; NULL: not in this version */
} section;

static fracas_err read_section(fracas_gmsh_mesh *m)
{
    static const section sections[] = {{"PhysicalNames", {read_names, read_names}},
                                       {"Nodes", {read_nodes_2, read_nodes_4}},
                                       {"Elements", {read_elements_2, read_elements_4}},
                                       {"Entities", {NULL, read_entities}},
                                       {"PartitionedEntities", {NULL, read_pieces}}};
    char word[FRACAS_GMSH_WORD], end[FRACAS_GMSH_WORD + 8] = "$End";
    TRY(fracas_gmsh_word(&m->scan, word));
    if (word[0] != '$')
        return fracas_gmsh_fail(&m->scan, "expected a section, which begins with $, not `%s`",
                                word);
    for (size_t s = 0; s < sizeof sections / sizeof *sections; s++) {
        fracas_err (*read)(fracas_gmsh_mesh *) = sections[s].read[m->is_4];
        if (strcmp(word + 1, sections[s].name) != 0 || !read) continue;
        /* Text goes on in any place, numbers of a binary 4.1 file with the next line. */
        if (m->scan.is_binary && read != read_names) TRY(fracas_gmsh_line_end(&m->scan));
        TRY(read(m));
        if (read == read_names) return FRACAS_OK; /* behind its end */
        strcat(end, sections[s].name);
        return fracas_gmsh_expect(&m->scan, end);
    }
    return fracas_gmsh_skip(&m->scan, word + 1);
}

/* ---- repeated triangles ---- */

static int compare_triangles(const void *left, const void *right)
{
    const int64_t *a = *(const int64_t *const *)left, *b = *(const int64_t *const *)right;
    for (int k = 0; k < 3; k++)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return a < b ? -1 : a > b;
}

/* MSH 2 has a triangle once for each of its physical groups: leaves the first of them. */
static fracas_err drop_repeated(fracas_gmsh_mesh *m)
{
    OWNED int64_t **sorted = malloc((m->nelements + 1) * sizeof *sorted);
    size_t kept = 0;
    if (!sorted) return fracas_no_memory("the elements of a mesh");
    for (size_t e = 0; e < m->nelements; e++) sorted[e] = m->corner[e];
    qsort(sorted, m->nelements, sizeof *sorted, compare_triangles);
    for (size_t e = 1; e < m->nelements; e++)
        if (!memcmp(sorted[e - 1], sorted[e], (size_t)(3 * m->order) * sizeof **sorted))
            m->element[(int64_t(*)[6])sorted[e] - m->corner] = INT64_MIN;
    for (size_t e = 0; e < m->nelements; e++) {
        if (m->element[e] == INT64_MIN) continue;
        m->element[kept] = m->element[e];
        memmove(m->corner[kept++], m->corner[e], sizeof *m->corner);
    }
    m->nelements = kept;
    return FRACAS_OK;
}

fracas_err fracas_gmsh_read(fracas_gmsh_mesh *m)
{
    TRY(read_format(m));
    while (!fracas_gmsh_at_end(&m->scan)) TRY(read_section(m));
    if (!m->node) return fracas_gmsh_fail(&m->scan, "the file ends without a section $Nodes");
    if (!m->corner) return fracas_gmsh_fail(&m->scan, "the file ends without a section $Elements");
    if (m->nelements == 0) return fracas_gmsh_fail(&m->scan, "the file has no triangles");
    if (m->nelements > FRACAS_SURFACE_LARGEST || m->nnodes > FRACAS_SURFACE_LARGEST)
        return fracas_gmsh_fail(
            &m->scan, "the file has %zu triangles and %zu nodes: at most %zu are possible",
            m->nelements, m->nnodes, FRACAS_SURFACE_LARGEST);
    return m->is_4 ? FRACAS_OK : drop_repeated(m);
}
