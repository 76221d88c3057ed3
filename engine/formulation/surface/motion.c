/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges moved by a load: their nodes, and where to (docs/theory/loads.md). */
#include "engine/formulation/surface/loads.h"

#include "engine/loading/initial.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EDGES_MOST = 2 }; /* edges of a load */
#define NOTHING 1e-12    /* component of a direction of length 1 by rounding alone */

static bool is_motion(const fracas_model *model, int n)
{
    const fracas_load *load = fracas_loading_load(&model->spec, n);
    return load && load->path;
}

int fracas_surface_motion_number(const fracas_model *model)
{
    int n = 0;
    while (n < FRACAS_LOADINGS && !is_motion(model, n)) n++;
    return n;
}

/* One loading alone prescribes velocities of edges. */
static fracas_err check_alone(const fracas_model *model, int n)
{
    const fracas_spec *spec = &model->spec;
    const char *name = fracas_loading_sections[n].name;
    if (n > 0 && fracas_loading_traits_of(spec)->surface(spec, &spec->loading, 0).moving)
        return fracas_fail(FRACAS_USAGE,
                           "loading %s and %s %s both prescribe how edges move: leave one out",
                           spec->loading.type->name, name, fracas_loading_at(spec, n)->type->name);
    for (int other = n + 1; other < FRACAS_LOADINGS; other++)
        if (is_motion(model, other))
            return fracas_fail(FRACAS_USAGE,
                               "%s and %s both move edges: one load moves up to two edges, by edge "
                               "and second_edge: leave %s out",
                               name, fracas_loading_sections[other].name,
                               fracas_loading_sections[other].name);
    return FRACAS_OK;
}

fracas_err fracas_surface_moved_tags(const fracas_model *model, unsigned *tags)
{
    const int n = fracas_surface_motion_number(model);
    *tags = 0;
    if (n == FRACAS_LOADINGS) return FRACAS_OK;
    TRY(check_alone(model, n));
    for (int i = 0; i < EDGES_MOST; i++) {
        int32_t tag;
        TRY(fracas_surface_load_tag(model, n, i, &tag));
        if (tag > 0) *tags |= 1u << tag;
    }
    return FRACAS_OK;
}

size_t fracas_surface_moved_count(const fracas_surface *surface, unsigned tags)
{
    size_t count = 0;
    for (size_t b = 0; b < surface->nborders; b++) {
        const fracas_surface_border *border = &surface->border[b];
        const bool again = b > 0 && border[-1].element == border->element &&
                           fracas_surface_is_moved(border[-1].tag, tags);
        count += fracas_surface_is_moved(border->tag, tags) && !again;
    }
    return count;
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
static void add_directions(const fracas_model *model, int32_t tag, double (*sum)[3])
{
    static const double at[3] = {0, 1, 0.5};
    const fracas_surface *surface = model->surface;
    const int motion = fracas_surface_motion_number(model);
    const fracas_loading *loading = fracas_loading_at(&model->spec, motion);
    const fracas_load *load = fracas_loading_load(&model->spec, motion);
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

/* Key of the load's edge of a tag. */
static const char *key_of(const fracas_model *model, int32_t tag)
{
    const int n = fracas_surface_motion_number(model);
    for (int i = 0; i < EDGES_MOST; i++) {
        int32_t found;
        if (!fracas_surface_load_tag(model, n, i, &found) && found == tag)
            return fracas_loading_load(&model->spec, n)
                ->edge(fracas_loading_at(&model->spec, n), i);
    }
    return "none";
}

static fracas_err not_held(const fracas_model *model, int32_t tag)
{
    return fracas_fail(FRACAS_USAGE,
                       "%s moves the edge %s in a direction in which geometry, where it is "
                       "%s, does not hold it: hold it otherwise, or leave it free: then all of it "
                       "goes along",
                       fracas_loading_sections[fracas_surface_motion_number(model)].name,
                       key_of(model, tag), fracas_surface_edge_kind(&model->spec, tag)->name);
}

/* Adds to a direction the part of another edge's beside it: a corner of two moved edges goes with
 * both. */
static void go_along(double direction[3], const double other[3])
{
    double along = 0;
    for (int i = 0; i < 3; i++) along += direction[i] * other[i];
    for (int i = 0; i < 3; i++) direction[i] += other[i] - along * direction[i];
}

/* The directions of the nodes of a tag's borders, by those of the mesh, into their rows. An edge
 * around a corner has both borders in one element. `others`: of the other edge, NULL: there is
 * none. */
static fracas_err fill_tag(const fracas_model *model, fracas_surface_tables *t, int32_t tag,
                           const double (*sum)[3], const double (*others)[3], double *largest)
{
    const fracas_surface *surface = model->surface;
    const size_t dimension = (size_t)t->body->dimension, size = fracas_surface_unknowns(t);
    const fracas_initial_strain strain = fracas_initial_strain_of(&model->spec);
    for (size_t b = 0; b < surface->nborders; b++) {
        const fracas_surface_border *border = &surface->border[b];
        const size_t e = border->element;
        size_t node[3];
        if (border->tag != tag) continue;
        if (t->moved_row[e] == 0) t->moved_row[e] = (uint32_t)++t->nmoved;
        double *row = t->direction + (t->moved_row[e] - 1) * size;
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
                if (moved > 0 && !(t->held[e] >> unknown & 1)) return not_held(model, tag);
                if (!(t->moved[e] >> unknown & 1)) continue;
                row[unknown] = direction[i];
                if (t->start) t->start[(t->moved_row[e] - 1) * size + unknown] = at_start[i];
                *largest = fmax(*largest, moved);
            }
        }
    }
    return FRACAS_OK;
}

fracas_err fracas_surface_motion_fill(const fracas_model *model, fracas_surface_tables *t)
{
    double largest = 0;
    int32_t tag[EDGES_MOST];
    if (!t->moved) return FRACAS_OK;
    const int n = fracas_surface_motion_number(model);
    const fracas_loading *loading = fracas_loading_at(&model->spec, n);
    TRY(fracas_load_history(loading, &t->history[n]));
    for (int i = 0; i < EDGES_MOST; i++) TRY(fracas_surface_load_tag(model, n, i, &tag[i]));
    OWNED double(*sum)[3] = calloc(EDGES_MOST * model->surface->nnodes, sizeof *sum);
    if (!sum) return fracas_no_memory("the edges that a load moves");
    double(*const second)[3] = sum + model->surface->nnodes;
    add_directions(model, tag[0], sum);
    if (tag[1] != 0) add_directions(model, tag[1], second);
    TRY(fill_tag(model, t, tag[0], (const double(*)[3])sum,
                 tag[1] ? (const double(*)[3])second : NULL, &largest));
    if (tag[1] != 0)
        TRY(fill_tag(model, t, tag[1], (const double(*)[3])second, (const double(*)[3])sum,
                     &largest));
    if (largest > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s %s moves no node: others hold all of the edge: free one of them",
                       fracas_loading_sections[n].name, loading->type->name);
}
