/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/surface/gmsh.h"

#include "base/own.h"
#include "engine/mesh/surface/gmsh_file.h"
#include "engine/mesh/surface/parts.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROUND_OFF 1e-9 /* largest in z of a flat body, by its extent */

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

static fracas_err allocate_resolved(const fracas_gmsh_mesh *m, resolved *out)
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

static fracas_err resolve_elements(const fracas_gmsh_mesh *m, double unit, resolved *out)
{
    const size_t corners = (size_t)(3 * m->order);
    for (size_t n = 0; n < m->nnodes; n++) out->new_node[n] = UINT32_MAX;
    for (size_t e = 0; e < m->nelements; e++)
        for (size_t k = 0; k < corners; k++) {
            const fracas_gmsh_entry *at = fracas_gmsh_find(m->node_entry, m->nnodes,
                                                           m->corner[e][k]);
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

static fracas_err resolve_lines(const fracas_gmsh_mesh *m, resolved *out)
{
    for (size_t l = 0; l < m->nlines; l++) {
        out->tag[l].tag = m->line[l].tag;
        for (int k = 0; k < 2; k++) {
            const fracas_gmsh_entry *at = fracas_gmsh_find(m->node_entry, m->nnodes,
                                                           m->line[l].node[k]);
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

/* Nodes beside a plane z = const by round-off go to their mean z. */
static void flatten(resolved *out)
{
    double least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY},
           mean = 0;
    for (size_t n = 0; n < out->nnodes; n++) {
        for (int i = 0; i < 3; i++) {
            least[i] = fmin(least[i], out->node[n][i]);
            most[i] = fmax(most[i], out->node[n][i]);
        }
        mean += out->node[n][2] / (double)out->nnodes;
    }
    const double extent = fmax(most[0] - least[0], most[1] - least[1]);
    if (least[2] == most[2] || !(fmax(most[2] - mean, mean - least[2]) <= ROUND_OFF * extent))
        return;
    for (size_t n = 0; n < out->nnodes; n++) out->node[n][2] = mean;
}

static int compare_tags(const void *left, const void *right)
{
    const fracas_surface_tag *a = left, *b = right;
    for (int k = 0; k < 2; k++)
        if (a->node[k] != b->node[k]) return a->node[k] < b->node[k] ? -1 : 1;
    return a->tag < b->tag ? -1 : a->tag > b->tag;
}

/* MSH 2 has a line once for each of its physical groups: one is chosen, where one can be. */
static size_t merge_lines(fracas_gmsh_mesh *m, resolved *out)
{
    size_t merged = 0;
    for (size_t l = 0; l < m->nlines; l++) {
        uint32_t *node = out->tag[l].node, was = node[0];
        if (was > node[1]) node[0] = node[1], node[1] = was;
    }
    if (m->nlines) qsort(out->tag, m->nlines, sizeof *out->tag, compare_tags);
    for (size_t l = 0; l < m->nlines; l++) {
        fracas_surface_tag *last = merged ? &out->tag[merged - 1] : NULL;
        const bool same = last && last->node[0] == out->tag[l].node[0] &&
                          last->node[1] == out->tag[l].node[1];
        const int32_t chosen = same ? fracas_gmsh_choose(last->tag, out->tag[l].tag, &m->passed)
                                    : 0;
        if (chosen) last->tag = chosen;
        else out->tag[merged++] = out->tag[l];
    }
    return merged;
}

fracas_err fracas_surface_read_gmsh(const void *bytes, size_t size, double unit, bool flat,
                                    const fracas_surface **surface)
{
    FRACAS_CLEARED(fracas_gmsh_mesh) m = {.scan = {.text = bytes, .size = size}};
    FRACAS_CLEARED(resolved) out = {0};
    TRY(fracas_gmsh_read(&m));
    TRY(allocate_resolved(&m, &out));
    TRY(resolve_elements(&m, unit, &out));
    TRY(resolve_lines(&m, &out));
    if (flat) flatten(&out);
    const size_t ntags = merge_lines(&m, &out);
    fracas_surface_arrays arrays = {.order = m.order,
                                    .nnodes = out.nnodes,
                                    .nelements = m.nelements,
                                    .ntags = ntags,
                                    .passed = m.passed,
                                    .ngroups = m.ngroups,
                                    .group = m.group,
                                    .node = (const double(*)[3])out.node,
                                    .element = out.element,
                                    .tag = out.tag,
                                    .node_number = out.node_number,
                                    .element_number = m.element};
    TRY(fracas_surface_orient(&arrays, flat, out.element, &arrays.turned));
    return fracas_surface_assemble(&arrays, surface);
}
