/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of held edges and nodes on a surface, from the forces that the sweep kept
 * (docs/theory/probes.md).
 */
#include "engine/formulation/surface/loads.h"

#include <stdlib.h>
#include <string.h>

/* Components of an element held by a border. */
static uint32_t held_at(const fracas_model *model, const fracas_surface_border *border)
{
    const fracas_surface_tables *t = model->plan;
    const uint32_t k = border->edge, node[3] = {k, (k + 1) % 3, 3 + k};
    const unsigned components = fracas_surface_held_by(model, border);
    uint32_t held = 0;
    for (int n = 0; n < t->order + 1; n++) held |= components << t->body->dimension * (int)node[n];
    return held;
}

size_t fracas_surface_held_edges(const fracas_model *model, int64_t tag[FRACAS_HOLDERS])
{
    int number[FRACAS_LOADINGS];
    bool holds[FRACAS_EDGES] = {false};
    size_t count = 0;
    for (size_t b = 0; b < model->surface->nborders; b++) {
        const fracas_surface_border *border = &model->surface->border[b];
        const int32_t edge = fracas_surface_edge_key(model, border->tag);
        holds[edge] = holds[edge] || fracas_surface_held_by(model, border) != 0;
    }
    for (int64_t edge = 0; edge < FRACAS_EDGES; edge++)
        if (holds[edge]) tag[count++] = edge;
    const int sets = fracas_surface_node_sets(model, number);
    for (int s = 0; s < sets; s++) tag[count++] = -(number[s] + 1);
    return count;
}

/* Components of border b but those of an edge of a lower tag, or an earlier border of its own. */
static uint32_t held_alone(const fracas_model *model, size_t b)
{
    const fracas_surface *surface = model->surface;
    const fracas_surface_border *border = &surface->border[b];
    const int32_t edge = fracas_surface_edge_key(model, border->tag);
    uint32_t held = held_at(model, border);
    for (size_t o = b > 2 ? b - 2 : 0; o < surface->nborders && o <= b + 2; o++) { /* 3 edges */
        const fracas_surface_border *other = &surface->border[o];
        if (o == b || other->element != border->element) continue;
        const int32_t of_other = fracas_surface_edge_key(model, other->tag);
        if (of_other < edge || (of_other == edge && o < b)) held &= ~held_at(model, other);
    }
    return held;
}

fracas_err fracas_surface_holds_fill(const fracas_model *model, fracas_surface_division *division)
{
    const fracas_surface_tables *t = model->plan;
    int64_t tag[FRACAS_HOLDERS];
    const size_t holders = fracas_surface_held_edges(model, tag), sets = (size_t)t->sets,
                 edges = holders - sets, borders = model->surface->nborders;
    division->hold = malloc((borders + sets * t->nelements + 1) * sizeof *division->hold);
    if (!division->hold) return fracas_no_memory("the reactions of a body");
    for (size_t n = 0; n < edges; n++)
        for (size_t b = 0; b < borders; b++) {
            const fracas_surface_border *border = &model->surface->border[b];
            const uint32_t held = fracas_surface_edge_key(model, border->tag) == tag[n]
                                      ? held_alone(model, b)
                                      : 0;
            if (held)
                division->hold[division->holds++] = (fracas_surface_hold){border->element,
                                                                          (uint32_t)n, held};
        }
    for (size_t s = 0; s < sets; s++)
        for (size_t e = 0; e < t->nelements; e++) {
            const uint32_t held = t->set[s * t->nelements + e];
            if (held)
                division->hold[division->holds++] = (fracas_surface_hold){
                    (uint32_t)e, (uint32_t)(edges + s), held};
        }
    return FRACAS_OK;
}

/* Forces and accelerations of an element, kept by the sweep. */
typedef struct {
    double force[SURFACE_UNKNOWNS_MOST], acceleration[SURFACE_UNKNOWNS_MOST];
} kept;

static kept kept_of(const fracas_surface_tables *t, const fracas_step *step, int lane, size_t e)
{
    const fracas_surface_division *division = step->division.plan;
    const size_t size = fracas_surface_unknowns(t);
    const size_t row = division->kept + (division->kept_row[e] - 1) * 2 * size;
    kept of;
    for (size_t i = 0; i < size; i++) {
        of.force[i] = *fracas_surface_field(step, row + i, lane);
        of.acceleration[i] = *fracas_surface_field(step, row + size + i, lane);
    }
    return of;
}

/* Component i of f + M a, rotary inertia's part included, less the body force  (probes.3) */
static double reaction_at(const fracas_surface_tables *t, const kept *of, size_t e, size_t i,
                          double spin)
{
    const size_t dimension = (size_t)t->body->dimension, k = i / dimension, j = i % dimension,
                 nodes = (size_t)SURFACE_NODES(t->order);
    const double *table = t->rotary ? t->rotary + e * SURFACE_ROTARY_TABLE : NULL;
    double sum = of->force[i];
    for (size_t l = 0; l < nodes; l++) {
        const double body = t->position ? spin * t->position[2 * (e * nodes + l) + j] : 0;
        sum += fracas_surface_mass(t, e, k, l) * (of->acceleration[dimension * l + j] - body);
    }
    for (size_t l = 0; table && l < nodes; l++) {
        double along = 0;
        for (size_t c = 0; c < 3; c++)
            along += table[SURFACE_TURNING + c] * of->acceleration[3 * l + c];
        sum += table[SURFACE_TURNING + j] *
               table[SURFACE_ROTARY + (size_t)fracas_surface_entry((int)k, (int)l)] * along;
    }
    return sum;
}

void fracas_surface_reactions(const fracas_model *model, const fracas_step *step, int lane,
                              double (*force)[3])
{
    const fracas_surface_tables *t = model->plan;
    const fracas_surface_division *division = step->division.plan;
    const size_t dimension = (size_t)t->body->dimension, size = fracas_surface_unknowns(t);
    for (size_t h = 0; h < division->holds; h++) {
        const fracas_surface_hold *hold = &division->hold[h];
        const kept of = kept_of(t, step, lane, hold->element);
        if (h == 0 || hold->edge != hold[-1].edge)
            memset(force[hold->edge], 0, sizeof force[hold->edge]);
        for (size_t i = 0; i < size; i++)
            if (hold->held >> i & 1)
                force[hold->edge][i % dimension] += reaction_at(t, &of, hold->element, i,
                                                                step->spin[lane]);
    }
}
