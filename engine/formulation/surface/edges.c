/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conditions of a surface's edges: held components, and rims. */
#include "engine/formulation/surface/loads.h"
#include "engine/mesh/body.h"

/* Least cosine at a plane of symmetry: bent edges of coarse meshes are off by some degrees. */
#define UPRIGHT 0.93

const fracas_kind *fracas_surface_edge_kind(const fracas_spec *spec, int32_t tag)
{
    const fracas_kind *const *edge = spec->geometry.edge, *decided = fracas_shape_edge(spec, tag);
    if (decided) return decided;
    if (tag > 0 && tag < FRACAS_EDGES && edge[tag]) return edge[tag];
    return edge[0] ? edge[0] : &fracas_edge_free;
}

static fracas_err cannot_be(const fracas_model *model, const fracas_surface_border *border,
                            const fracas_kind *kind)
{
    char names[120];
    const fracas_kind *of = &model->formulation->kind;
    return fracas_fail(
        FRACAS_USAGE, "an edge with tag %d is `%s`, which edges of a %s cannot be: let it be %s",
        (int)border->tag, kind->name, of->name, fracas_edge_names(of->groups, names));
}

fracas_err fracas_surface_hold_edge(const fracas_model *model, const fracas_surface_border *border,
                                    const fracas_kind *kind, bool moved, unsigned *components)
{
    const fracas_surface_body *body = model->formulation->kind.traits;
    const fracas_edge *edge = fracas_edge_of(kind);
    const double *at = fracas_surface_node(model->surface, border->element, border->edge);
    unsigned across = 0;
    if (!(edge->models & model->formulation->kind.groups)) return cannot_be(model, border, kind);
    if (edge->plane) {
        across = body->edge_axis(model->surface, border, edge->mirror ? UPRIGHT : 0);
        if (!across)
            return fracas_fail(FRACAS_USAGE,
                               "an edge with tag %d is `%s`, but at (%g, %g, %g) m it does not lie "
                               "in a plane x, y or z = const%s: hold it otherwise, or leave it "
                               "free",
                               (int)border->tag, kind->name, at[0], at[1], at[2],
                               edge->mirror ? " that the body meets at a right angle" : "");
    }
    const unsigned all = (1u << body->dimension) - 1;
    *components = edge->holds ? edge->holds(all, across) : moved ? all : 0;
    return FRACAS_OK;
}

bool fracas_surface_has_rim(const fracas_model *model, const fracas_surface_border *border)
{
    const fracas_surface_body *body = model->formulation->kind.traits;
    return body->fill_rim &&
           fracas_edge_of(fracas_surface_edge_kind(&model->spec, border->tag))->director;
}

unsigned fracas_surface_held_by(const fracas_model *model, const fracas_surface_border *border)
{
    const fracas_kind *kind = fracas_surface_edge_kind(&model->spec, border->tag);
    unsigned components = 0;
    const bool moves = fracas_surface_mover(model, border->tag) < FRACAS_LOADINGS;
    return fracas_surface_hold_edge(model, border, kind, moves, &components) ? 0 : components;
}

/* Each edge of a mesh file held by the campaign must exist, and be whole. */
static fracas_err check_edge_tags(const fracas_model *model)
{
    const fracas_surface *surface = model->surface;
    for (int32_t tag = 1; fracas_shape_of(&model->spec)->from_file && tag < FRACAS_EDGES; tag++) {
        size_t found = 0;
        if (surface->passed >> tag & 1 && (fracas_surface_edge_key(model, tag) == tag ||
                                           fracas_surface_is_loaded(model, tag, true)))
            return fracas_fail(FRACAS_USAGE,
                               "edge_%d is used, but the mesh has lines of the physical group %d "
                               "in a group of a lesser number, too: an edge has one: take these "
                               "lines out of one of them, or leave edge_%d to `edges`",
                               (int)tag, (int)tag, (int)tag);
        for (size_t b = 0; b < surface->nborders; b++) found += surface->border[b].tag == tag;
        const fracas_kind *edge = model->spec.geometry.edge[tag];
        if (found == 0 && edge && fracas_edge_is_held(fracas_edge_of(edge)))
            return fracas_fail(
                FRACAS_USAGE,
                "geometry.edge_%d is %s, but the mesh has no edge on its boundary of the physical "
                "group %d: give the lines that number, or the group the name edge_%d, or use "
                "`edges` "
                "for all others",
                (int)tag, edge->name, (int)tag, (int)tag);
    }
    return FRACAS_OK;
}

/* Element by element: so the borders are sorted. */
fracas_err fracas_surface_edges_fill(const fracas_model *model, fracas_surface_tables *t)
{
    TRY(check_edge_tags(model));
    const fracas_surface_body *body = t->body;
    const int dimension = body->dimension;
    size_t r = 0, e = 0;
    for (size_t b = 0; b < model->surface->nborders; b++) {
        const fracas_surface_border *border = &model->surface->border[b];
        const fracas_kind *kind = fracas_surface_edge_kind(&model->spec, border->tag);
        const fracas_edge *edge = fracas_edge_of(kind);
        const uint32_t k = border->edge, node[3] = {k, (k + 1) % 3, 3 + k};
        const bool moves = fracas_surface_mover(model, border->tag) < FRACAS_LOADINGS;
        unsigned components = 0;
        uint32_t held = 0;
        TRY(fracas_surface_hold_edge(model, border, kind, moves, &components));
        for (int n = 0; n < t->order + 1; n++) held |= components << dimension * (int)node[n];
        t->held[border->element] |= held;
        if (moves) t->moved[border->element] |= held;
        else if (!edge->moving) t->fixed[border->element] |= held;
        while (e < border->element) t->rim_from[++e] = (uint32_t)r;
        if (!fracas_surface_has_rim(model, border)) continue;
        t->rim_edge[r] = (uint8_t)k;
        body->fill_rim(model, border, t->rim + r++ * body->rim_table);
    }
    while (e < t->nelements) t->rim_from[++e] = (uint32_t)r;
    for (e = 0; t->moved && e < t->nelements; e++) t->moved[e] &= ~t->fixed[e];
    return FRACAS_OK;
}
