/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes moved by loads, and where to (docs/theory/loads.md). */
#include "engine/formulation/surface/loads.h"

#include "engine/loading/initial.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EDGES_MOST = 2 }; /* edges of a load */
#define NOTHING 1e-12    /* component of a direction of length 1 by rounding alone */

static const fracas_load *motion_of(const fracas_model *model, int n)
{
    const fracas_load *load = fracas_loading_load(&model->spec, n);
    const bool moves = load && load->path &&
                       !(load->rests && load->rests(fracas_loading_at(&model->spec, n)));
    return moves ? load : NULL;
}

/* True of a motion of edges that moves those of this tag. */
static bool has_edge(const fracas_model *model, int n, int32_t tag)
{
    const fracas_load *load = motion_of(model, n);
    for (int i = 0; load && load->on == FRACAS_LOAD_ON_EDGE && i < EDGES_MOST; i++) {
        const char *key = load->edge(fracas_loading_at(&model->spec, n), i);
        int32_t found;
        if (key && !fracas_shape_edge_tag(&model->spec.geometry, "edge", key, &found) &&
            found == tag)
            return true;
    }
    return false;
}

int fracas_surface_mover(const fracas_model *model, int32_t tag)
{
    int n = 0;
    while (n < FRACAS_LOADINGS && (tag <= 0 || !has_edge(model, n, tag))) n++;
    return n;
}

/* Its edges exist, and are its own. */
static fracas_err check_edges(const fracas_model *model, int n)
{
    for (int i = 0; i < EDGES_MOST; i++) {
        int32_t tag;
        TRY(fracas_surface_load_tag(model, n, i, &tag));
        const int first = tag > 0 ? fracas_surface_mover(model, tag) : n;
        if (first != n)
            return fracas_fail(FRACAS_USAGE, "%s and %s move the same edge %s: leave one out",
                               fracas_loading_sections[first].name, fracas_loading_sections[n].name,
                               motion_of(model, n)->edge(fracas_loading_at(&model->spec, n), i));
    }
    return FRACAS_OK;
}

fracas_err fracas_surface_motions(const fracas_model *model, fracas_surface_tables *t)
{
    const fracas_spec *spec = &model->spec;
    for (int n = 0; n < FRACAS_LOADINGS; n++) {
        if (!motion_of(model, n)) continue;
        if (n > 0 && fracas_loading_traits_of(spec)->surface(spec, &spec->loading, 0).moving)
            return fracas_fail(FRACAS_USAGE,
                               "loading %s and %s %s both prescribe how edges or nodes move: leave "
                               "one out",
                               spec->loading.type->name, fracas_loading_sections[n].name,
                               fracas_loading_at(spec, n)->type->name);
        if (motion_of(model, n)->on == FRACAS_LOAD_ON_EDGE) TRY(check_edges(model, n));
        t->motion[t->motions++] = n;
    }
    return FRACAS_OK;
}

/* Nodes of a border in its element: at s = 0, 1, and 1/2 of quadratic ones. */
static void nodes_of(const fracas_surface_border *border, size_t node[3])
{
    node[0] = border->edge;
    node[1] = (border->edge + 1) % 3;
    node[2] = 3 + border->edge;
}

/* Adds to `sum` [node of the mesh] the directions of the borders of a tag: edges that are bent meet
 * at nodes where their normals differ. */
static void add_directions(const fracas_model *model, int motion, int32_t tag, double (*sum)[3])
{
    static const double at[3] = {0, 1, 0.5};
    const fracas_surface *surface = model->surface;
    const fracas_loading *loading = fracas_loading_at(&model->spec, motion);
    const fracas_load *load = motion_of(model, motion);
    for (size_t b = 0; b < surface->nborders; b++) {
        const fracas_surface_border *border = &surface->border[b];
        size_t node[3];
        if (border->tag != tag) continue;
        nodes_of(border, node);
        for (int n = 0; n < surface->order + 1; n++) {
            double direction[3], speed;
            const fracas_place place = fracas_surface_place_on(surface, border, at[n], &speed);
            load->density(&model->spec, loading, &place, direction);
            double *to = sum[surface->element[border->element * surface->corners + node[n]]];
            for (int i = 0; i < 3; i++) to[i] += direction[i];
        }
    }
}

static void normalize(double a[3])
{
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++) a[i] = length > 0 ? a[i] / length : 0;
}

/* The direction at a node, of length 1; along an axis without rounding beside it. */
static void direction_of(const double sum[3], double direction[3])
{
    for (int i = 0; i < 3; i++) direction[i] = sum[i];
    normalize(direction);
    for (int i = 0; i < 3; i++)
        if (fabs(direction[i]) < NOTHING) direction[i] = 0;
    normalize(direction);
}

static fracas_err not_held(const fracas_model *model, int n, int32_t tag)
{
    const fracas_loading *loading = fracas_loading_at(&model->spec, n);
    int32_t first;
    TRY(fracas_surface_load_tag(model, n, 0, &first));
    return fracas_fail(FRACAS_USAGE,
                       "%s moves the edge %s in a direction in which geometry, where it is "
                       "%s, does not hold it: hold it otherwise, or leave it free: then all of it "
                       "goes along",
                       fracas_loading_sections[n].name,
                       motion_of(model, n)->edge(loading, first == tag ? 0 : 1),
                       fracas_surface_edge_kind(&model->spec, tag)->name);
}

/* Adds to a direction the part of another edge's beside it: a corner of two moved edges goes with
 * both. */
static void go_along(double direction[3], const double other[3])
{
    double along = 0;
    for (int i = 0; i < 3; i++) along += direction[i] * other[i];
    for (int i = 0; i < 3; i++) direction[i] += other[i] - along * direction[i];
}

/* The row of an element that motion m moves. */
static fracas_err row_of(const fracas_model *model, fracas_surface_tables *t, int m, size_t e,
                         size_t *row)
{
    if (t->moved_row[e] == 0) {
        t->moved_by[t->nmoved] = (uint8_t)m;
        t->moved_row[e] = (uint32_t)++t->nmoved;
    }
    *row = t->moved_row[e] - 1;
    const int other = t->moved_by[*row];
    if (other == m) return FRACAS_OK;
    const double *x = fracas_surface_node(model->surface, e, 0);
    return fracas_fail(FRACAS_USAGE,
                       "%s and %s move nodes of one element, near (%.6g, %.6g, %.6g) m: keep them "
                       "an element apart, or move two edges by one load, `second_edge`",
                       fracas_loading_sections[t->motion[other]].name,
                       fracas_loading_sections[t->motion[m]].name, x[0], x[1], x[2]);
}

/* The directions of the nodes of a tag's borders, by those of the mesh, into their rows. An edge
 * around a corner has both borders in one element. `others`: of the other edge, NULL: there is
 * none. */
static fracas_err fill_tag(const fracas_model *model, fracas_surface_tables *t, int m, int32_t tag,
                           const double (*sum)[3], const double (*others)[3], double *largest)
{
    const fracas_surface *surface = model->surface;
    const size_t dimension = (size_t)t->body->dimension, size = fracas_surface_unknowns(t);
    const fracas_initial_strain strain = fracas_initial_strain_of(&model->spec);
    for (size_t b = 0; b < surface->nborders; b++) {
        const fracas_surface_border *border = &surface->border[b];
        const size_t e = border->element;
        size_t node[3], first;
        if (border->tag != tag) continue;
        TRY(row_of(model, t, m, e, &first));
        double *row = t->direction + first * size;
        nodes_of(border, node);
        for (int n = 0; n < surface->order + 1; n++) {
            const uint32_t at = surface->element[e * surface->corners + node[n]];
            double own[3], direction[3], other[3] = {0}, at_start[3];
            fracas_initial_displacement(&strain, surface->node[at], at_start);
            direction_of(sum[at], own);
            if (others) direction_of(others[at], other);
            memcpy(direction, own, sizeof own);
            go_along(direction, other);
            for (size_t i = 0; i < dimension; i++) {
                const size_t unknown = dimension * node[n] + i;
                const double moved = fabs(own[i]);
                if (moved > 0 && !(t->held[e] >> unknown & 1))
                    return not_held(model, t->motion[m], tag);
                if (!(t->moved[e] >> unknown & 1)) continue;
                row[unknown] = direction[i];
                if (t->start) t->start[first * size + unknown] = at_start[i];
                *largest = fmax(*largest, moved);
            }
        }
    }
    return FRACAS_OK;
}

static fracas_err fill_edges(const fracas_model *model, fracas_surface_tables *t, int m)
{
    const int n = t->motion[m];
    double largest = 0;
    int32_t tag[EDGES_MOST];
    for (int i = 0; i < EDGES_MOST; i++) TRY(fracas_surface_load_tag(model, n, i, &tag[i]));
    OWNED double(*sum)[3] = calloc(EDGES_MOST * model->surface->nnodes, sizeof *sum);
    if (!sum) return fracas_no_memory("the edges that a load moves");
    double(*const second)[3] = sum + model->surface->nnodes;
    add_directions(model, n, tag[0], sum);
    if (tag[1] != 0) add_directions(model, n, tag[1], second);
    TRY(fill_tag(model, t, m, tag[0], (const double(*)[3])sum,
                 tag[1] ? (const double(*)[3])second : NULL, &largest));
    if (tag[1] != 0)
        TRY(fill_tag(model, t, m, tag[1], (const double(*)[3])second, (const double(*)[3])sum,
                     &largest));
    if (largest > 0) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE, "%s %s moves no node: others hold all of the edge: free one of them",
        fracas_loading_sections[n].name, fracas_loading_at(&model->spec, n)->type->name);
}

/* Number of its set. */
static size_t set_of(const fracas_model *model, int n)
{
    int number[FRACAS_LOADINGS];
    size_t s = 0;
    fracas_surface_node_sets(model, number);
    while (number[s] != n) s++;
    return s;
}

static fracas_err fill_nodes(const fracas_model *model, fracas_surface_tables *t, int m)
{
    const int n = t->motion[m];
    const fracas_initial_strain strain = fracas_initial_strain_of(&model->spec);
    const uint32_t *set = t->set + set_of(model, n) * t->nelements;
    const size_t dimension = (size_t)t->body->dimension, size = fracas_surface_unknowns(t);
    double direction[3];
    motion_of(model, n)->density(&model->spec, fracas_loading_at(&model->spec, n),
                                 &(const fracas_place){0}, direction);
    for (size_t e = 0; e < t->nelements; e++) {
        size_t row;
        if (!set[e]) continue;
        TRY(row_of(model, t, m, e, &row));
        for (size_t i = 0; i < size; i++) {
            double at_start[3];
            if (!(set[e] >> i & 1)) continue;
            fracas_initial_displacement(
                &strain, fracas_surface_node(model->surface, e, i / dimension), at_start);
            t->direction[row * size + i] = direction[i % dimension];
            if (t->start) t->start[row * size + i] = at_start[i % dimension];
        }
    }
    return FRACAS_OK;
}

/* Elements with a moved node, and those at an edge that moves, of which others may hold all. */
static fracas_err make_rows(const fracas_model *model, fracas_surface_tables *t)
{
    const fracas_surface *surface = model->surface;
    const size_t size = fracas_surface_unknowns(t);
    size_t rows = 0, b = 0;
    for (size_t e = 0; e < t->nelements; e++) {
        bool moves = t->moved[e] != 0;
        for (; b < surface->nborders && surface->border[b].element == e; b++)
            moves = moves || fracas_surface_mover(model, surface->border[b].tag) < FRACAS_LOADINGS;
        rows += moves;
    }
    t->moved_by = calloc(rows + 1, sizeof *t->moved_by);
    t->direction = calloc(rows * size + 1, sizeof *t->direction);
    const bool strained = fracas_initial_is_strained(&model->spec);
    if (strained) t->start = calloc(rows * size + 1, sizeof *t->start);
    return t->moved_by && t->direction && (t->start || !strained)
               ? FRACAS_OK
               : fracas_no_memory("the nodes that a load moves");
}

fracas_err fracas_surface_motion_fill(const fracas_model *model, fracas_surface_tables *t)
{
    if (t->motions == 0) return FRACAS_OK;
    TRY(make_rows(model, t));
    for (int m = 0; m < t->motions; m++) {
        const int n = t->motion[m];
        TRY(fracas_load_history(fracas_loading_at(&model->spec, n), &t->history[n]));
        TRY(motion_of(model, n)->on == FRACAS_LOAD_ON_EDGE ? fill_edges(model, t, m)
                                                           : fill_nodes(model, t, m));
    }
    return FRACAS_OK;
}
