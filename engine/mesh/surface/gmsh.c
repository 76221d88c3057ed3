/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/surface/gmsh.h"

#include "base/own.h"
#include "engine/mesh/surface/gmsh_scan.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { GMSH_LINE = 1, GMSH_TRIANGLE = 2, GMSH_LINE_3 = 8, GMSH_TRIANGLE_6 = 9, GMSH_POINT = 15 };

/* A number of Gmsh's and its meaning. */
typedef struct {
    int64_t number, value;
} entry;

/* A line in a physical group. */
typedef struct {
    int64_t node[2], element;
    int32_t tag;
} line;

typedef struct {
    fracas_gmsh_scan scan;
    bool is_4; /* MSH 4.1, else 2.2 */
    size_t nnodes, nelements, nlines, ncurves;
    double (*node)[3];
    entry *node_entry;    /* sorted: index of each node */
    int64_t (*corner)[6]; /* triangles in Gmsh's numbers */
    int64_t *element;     /* number of each triangle */
    line *line;
    entry *curve; /* sorted: physical group of each curve */
    int order;    /* 0: no triangle so far */
} mesh;

static void mesh_clear(mesh *m)
{
    free(m->node);
    free(m->node_entry);
    free(m->corner);
    free(m->element);
    free(m->line);
    free(m->curve);
}

static int compare_entries(const void *left, const void *right)
{
    const entry *a = left, *b = right;
    return a->number < b->number ? -1 : a->number > b->number;
}

static const entry *find(const entry *all, size_t count, int64_t number)
{
    const entry key = {.number = number};
    return bsearch(&key, all, count, sizeof *all, compare_entries);
}

/* Sorts; FRACAS_USAGE for a number that comes twice. */
static fracas_err sort(const mesh *m, const char *what, entry *all, size_t count)
{
    qsort(all, count, sizeof *all, compare_entries);
    for (size_t i = 1; i < count; i++)
        if (all[i].number == all[i - 1].number)
            return fracas_gmsh_fail(&m->scan, "%s %" PRId64 " comes twice", what, all[i].number);
    return FRACAS_OK;
}

/* Reads a count, then as many `int`s; *last: the last of them, 0 without any. */
static fracas_err read_list(mesh *m, int64_t *count, int32_t *last)
{
    *last = 0;
    TRY(fracas_gmsh_integer(&m->scan, 8, count));
    TRY(fracas_gmsh_fits(&m->scan, *count, 1));
    for (int64_t i = 0; i < *count; i++) TRY(fracas_gmsh_ints(&m->scan, 1, last));
    return FRACAS_OK;
}

/* ---- entities (4.1): the physical group of each curve ---- */

static fracas_err read_entity(mesh *m, int dimension)
{
    int32_t number, group, border;
    int64_t groups, borders;
    double box[6];
    TRY(fracas_gmsh_ints(&m->scan, 1, &number));
    TRY(fracas_gmsh_reals(&m->scan, dimension == 0 ? 3 : 6, box));
    TRY(read_list(m, &groups, &group));
    if (dimension == 1 && groups > 1)
        return fracas_gmsh_fail(&m->scan,
                                "curve %" PRId32 " is in %" PRId64
                                " physical groups: an edge has one tag at most",
                                number, groups);
    if (dimension == 1) m->curve[m->ncurves++] = (entry){.number = number, .value = group};
    return dimension == 0 ? FRACAS_OK : read_list(m, &borders, &border);
}

static fracas_err read_entities(mesh *m)
{
    int64_t count[4];
    if (m->curve) return fracas_gmsh_fail(&m->scan, "a second section $Entities");
    for (int d = 0; d < 4; d++) TRY(fracas_gmsh_integer(&m->scan, 8, &count[d]));
    for (int d = 0; d < 4; d++) TRY(fracas_gmsh_fits(&m->scan, count[d], 5));
    m->curve = malloc(((size_t)count[1] + 1) * sizeof *m->curve); /* there may be none */
    if (!m->curve) return fracas_no_memory("the curves of a mesh");
    for (int d = 0; d < 4; d++)
        for (int64_t i = 0; i < count[d]; i++) TRY(read_entity(m, d));
    return sort(m, "curve", m->curve, m->ncurves);
}

/* ---- heads of sections and blocks ---- */

/* 2.2: the number of things, text even in a binary file. */
static fracas_err read_count(mesh *m, int64_t *count)
{
    const bool is_binary = m->scan.is_binary;
    m->scan.is_binary = false;
    fracas_err err = fracas_gmsh_integer(&m->scan, 8, count);
    if (!err) err = fracas_gmsh_line_end(&m->scan);
    m->scan.is_binary = is_binary;
    return err;
}

/* 4.1: blocks, things in them all, lowest and highest number. */
static fracas_err read_head(mesh *m, int64_t head[4])
{
    for (int i = 0; i < 4; i++) TRY(fracas_gmsh_integer(&m->scan, 8, &head[i]));
    return fracas_gmsh_fits(&m->scan, head[0], 4);
}

static fracas_err check_block(const mesh *m, const char *things, int64_t least, int64_t count,
                              size_t left)
{
    if (count >= least && (size_t)count <= left) return FRACAS_OK;
    return fracas_gmsh_fail(&m->scan,
                            "%" PRId64 " %s in a block, but %zu are left of those announced", count,
                            things, left);
}

/* 4.1: three numbers, and the number of things, at most `left`. */
static fracas_err read_block(mesh *m, const char *things, size_t left, int32_t head[3],
                             int64_t *count)
{
    TRY(fracas_gmsh_ints(&m->scan, 3, head));
    TRY(fracas_gmsh_integer(&m->scan, 8, count));
    return check_block(m, things, 0, *count, left);
}

/* ---- nodes ---- */

static fracas_err allocate_nodes(mesh *m, int64_t count)
{
    if (m->node) return fracas_gmsh_fail(&m->scan, "a second section $Nodes");
    TRY(fracas_gmsh_fits(&m->scan, count, 4));
    m->node = malloc(((size_t)count + 1) * sizeof *m->node);
    m->node_entry = malloc(((size_t)count + 1) * sizeof *m->node_entry);
    return m->node && m->node_entry ? FRACAS_OK : fracas_no_memory("the nodes of a mesh");
}

static fracas_err read_nodes_2(mesh *m)
{
    int64_t count;
    TRY(read_count(m, &count));
    TRY(allocate_nodes(m, count));
    for (; m->nnodes < (size_t)count; m->nnodes++) {
        entry *of = &m->node_entry[m->nnodes];
        of->value = (int64_t)m->nnodes;
        TRY(fracas_gmsh_integer(&m->scan, 4, &of->number));
        TRY(fracas_gmsh_reals(&m->scan, 3, m->node[m->nnodes]));
    }
    return sort(m, "node", m->node_entry, m->nnodes);
}

/* Numbers of the block's nodes, then their coordinates, with those on the entity itself where it is
 * parametric. */
static fracas_err read_node_block(mesh *m, size_t all)
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

static fracas_err read_nodes_4(mesh *m)
{
    int64_t head[4];
    TRY(read_head(m, head));
    TRY(allocate_nodes(m, head[1]));
    for (int64_t block = 0; block < head[0]; block++) TRY(read_node_block(m, (size_t)head[1]));
    return sort(m, "node", m->node_entry, m->nnodes);
}

/* ---- elements ---- */

/* Nodes of an element; FRACAS_USAGE with its name for those that are no part of a surface. */
static fracas_err nodes_of_type(const mesh *m, int32_t type, size_t *nodes)
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
    if (known)
        return fracas_gmsh_fail(
            &m->scan, "%zu-node %s (Gmsh's type %" PRId32 "): a surface has 3- or 6-node triangles",
            *nodes, shapes[types[type].shape], type);
    return fracas_gmsh_fail(
        &m->scan, "elements of Gmsh's type %" PRId32 ": a surface has 3- or 6-node triangles",
        type);
}

static fracas_err allocate_elements(mesh *m, int64_t count)
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
static fracas_err read_element(mesh *m, int32_t type, size_t bytes, int64_t number, int32_t tag)
{
    size_t nodes = 0;
    int64_t node[6];
    TRY(nodes_of_type(m, type, &nodes));
    for (size_t k = 0; k < nodes; k++) TRY(fracas_gmsh_integer(&m->scan, bytes, &node[k]));
    if (tag == INT32_MIN)
        return fracas_gmsh_fail(&m->scan, "element %" PRId64 " in the physical group %" PRId32,
                                number, tag);
    if ((type == GMSH_LINE || type == GMSH_LINE_3) && tag != 0)
        /* Gmsh turns a group's curve round by a minus. */
        m->line[m->nlines++] = (line){
            .node = {node[0], node[1]}, .element = number, .tag = tag < 0 ? -tag : tag};
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
static fracas_err read_elements_2(mesh *m)
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

static fracas_err read_elements_4(mesh *m)
{
    int64_t head[4], count, number, left;
    TRY(read_head(m, head));
    TRY(allocate_elements(m, head[1]));
    left = head[1];
    for (int64_t block = 0; block < head[0]; block++, left -= count) {
        int32_t of[3]; /* dimension, entity, type */
        TRY(read_block(m, "elements", (size_t)left, of, &count));
        const entry *curve = of[0] == 1 ? find(m->curve, m->ncurves, of[1]) : NULL;
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
static fracas_err read_format(mesh *m)
{
    fracas_gmsh_scan *scan = &m->scan;
    char version[FRACAS_GMSH_WORD];
    int64_t kind, bytes;
    if (fracas_gmsh_at_end(scan)) return fracas_gmsh_fail(scan, "an empty file");
    TRY(fracas_gmsh_expect(scan, "$MeshFormat"));
    TRY(fracas_gmsh_word(scan, version));
    TRY(fracas_gmsh_integer(scan, 8, &kind));
    TRY(fracas_gmsh_integer(scan, 8, &bytes));
    m->is_4 = strcmp(version, "4.1") == 0;
    if (!m->is_4 && strcmp(version, "2.2") != 0)
        return fracas_gmsh_fail(
            scan, "a mesh of format %s: save it as 4.1 or 2.2 (gmsh -format msh41)", version);
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
    fracas_err (*read[2])(mesh *m); /* 2.2, 4.1; NULL: not in this version */
} section;

static fracas_err read_section(mesh *m)
{
    static const section sections[] = {{"Nodes", {read_nodes_2, read_nodes_4}},
                                       {"Elements", {read_elements_2, read_elements_4}},
                                       {"Entities", {NULL, read_entities}}};
    char word[FRACAS_GMSH_WORD], end[FRACAS_GMSH_WORD + 8] = "$End";
    TRY(fracas_gmsh_word(&m->scan, word));
    if (word[0] != '$')
        return fracas_gmsh_fail(&m->scan, "expected a section, which begins with $, not `%s`",
                                word);
    if (strcmp(word, "$PartitionedEntities") == 0)
        return fracas_gmsh_fail(&m->scan,
                                "a mesh in partitions: save it as one (gmsh -unpartition)");
    for (size_t s = 0; s < sizeof sections / sizeof *sections; s++) {
        fracas_err (*read)(mesh *) = sections[s].read[m->is_4];
        if (strcmp(word + 1, sections[s].name) != 0 || !read) continue;
        /* Text goes on in any place, numbers of a binary 4.1 file with the next line. */
        if (m->scan.is_binary) TRY(fracas_gmsh_line_end(&m->scan));
        TRY(read(m));
        strcat(end, sections[s].name);
        return fracas_gmsh_expect(&m->scan, end);
    }
    return fracas_gmsh_skip(&m->scan, word + 1);
}

static fracas_err read_file(mesh *m)
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
    return FRACAS_OK;
}

/* ---- to a surface ---- */

/* Input of fracas_surface_assemble. */
typedef struct {
    uint32_t *new_node; /* number of each node of the file, UINT32_MAX: no triangle has it */
    uint32_t *element;
    double (*node)[3];
    int64_t *node_number;
    fracas_surface_tag *tag;
    size_t nnodes;
} resolved;

static void resolved_clear(resolved *out)
{
    free(out->new_node);
    free(out->element);
    free(out->node);
    free(out->node_number);
    free(out->tag);
}

static fracas_err allocate_resolved(const mesh *m, resolved *out)
{
    out->new_node = malloc((m->nnodes + 1) * sizeof *out->new_node);
    out->element = malloc(m->nelements * (size_t)(3 * m->order) * sizeof *out->element);
    out->node = malloc((m->nnodes + 1) * sizeof *out->node);
    out->node_number = malloc((m->nnodes + 1) * sizeof *out->node_number);
    out->tag = malloc((m->nlines + 1) * sizeof *out->tag);
    if (out->new_node && out->element && out->node && out->node_number && out->tag)
        return FRACAS_OK;
    return fracas_no_memory("a mesh");
}

static fracas_err resolve_elements(const mesh *m, double unit, resolved *out)
{
    const size_t corners = (size_t)(3 * m->order);
    for (size_t n = 0; n < m->nnodes; n++) out->new_node[n] = UINT32_MAX;
    for (size_t e = 0; e < m->nelements; e++)
        for (size_t k = 0; k < corners; k++) {
            const entry *at = find(m->node_entry, m->nnodes, m->corner[e][k]);
            if (!at)
                return fracas_fail(FRACAS_USAGE,
                                   "element %" PRId64 " names node %" PRId64
                                   ", which the file does not have",
                                   m->element[e], m->corner[e][k]);
            uint32_t *node = &out->new_node[at->value];
            if (*node == UINT32_MAX) {
                for (int i = 0; i < 3; i++)
                    out->node[out->nnodes][i] = unit * m->node[at->value][i];
                out->node_number[out->nnodes] = at->number;
                *node = (uint32_t)out->nnodes++;
            }
            out->element[corners * e + k] = *node;
        }
    return FRACAS_OK;
}

static fracas_err resolve_lines(const mesh *m, resolved *out)
{
    for (size_t l = 0; l < m->nlines; l++) {
        out->tag[l].tag = m->line[l].tag;
        for (int k = 0; k < 2; k++) {
            const entry *at = find(m->node_entry, m->nnodes, m->line[l].node[k]);
            if (!at || out->new_node[at->value] == UINT32_MAX)
                return fracas_fail(FRACAS_USAGE,
                                   "line %" PRId64 " of the physical group %" PRId32
                                   " has node %" PRId64 ", which no triangle has",
                                   m->line[l].element, m->line[l].tag, m->line[l].node[k]);
            out->tag[l].node[k] = out->new_node[at->value];
        }
    }
    return FRACAS_OK;
}

fracas_err fracas_surface_read_gmsh(const void *bytes, size_t size, double unit,
                                    const fracas_surface **surface)
{
    FRACAS_CLEARED(mesh) m = {.scan = {.text = bytes, .size = size}};
    FRACAS_CLEARED(resolved) out = {0};
    TRY(read_file(&m));
    TRY(allocate_resolved(&m, &out));
    TRY(resolve_elements(&m, unit, &out));
    TRY(resolve_lines(&m, &out));
    const fracas_surface_arrays arrays = {.order = m.order,
                                          .nnodes = out.nnodes,
                                          .nelements = m.nelements,
                                          .ntags = m.nlines,
                                          .node = (const double(*)[3])out.node,
                                          .element = out.element,
                                          .tag = out.tag,
                                          .node_number = out.node_number,
                                          .element_number = m.element};
    return fracas_surface_assemble(&arrays, surface);
}
