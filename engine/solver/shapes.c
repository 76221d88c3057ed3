/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/shapes.h"

#include "base/own.h"

#include <math.h>
#include <stdlib.h>

/* Elements sorted by their fragments, numbers rising in each: those of fragment f are sorted[end[f
 * - 1]] to before sorted[end[f]]. Returns the most elements of a fragment. */
static size_t sort_elements(const uint32_t *label, size_t elements, size_t fragments,
                            uint32_t *sorted, size_t *end)
{
    size_t most = 0, sum = 0;
    for (size_t e = 0; e < elements; e++) end[label[e]]++;
    for (size_t f = 0; f < fragments; f++) {
        const size_t count = end[f];
        most = count > most ? count : most;
        end[f] = sum;
        sum += count;
    }
    for (size_t e = 0; e < elements; e++) sorted[end[label[e]]++] = (uint32_t)e;
    return most;
}

fracas_err fracas_shapes_take(const fracas_model *model, const fracas_step *step, int lane,
                              fracas_record *record)
{
    const fracas_formulation *body = model->formulation;
    OWNED uint32_t *sorted = malloc(model->elements * sizeof *sorted);
    OWNED size_t *end = calloc(record->nfragment, sizeof *end);
    if (!sorted || !end) return fracas_no_memory("the shapes of fragments");
    const size_t most = sort_elements(step->partition.label, model->elements, record->nfragment,
                                      sorted, end),
                 nodes = body->element_nodes(model);
    OWNED double(*node)[3] = malloc(most * nodes * sizeof *node);
    if (!node) return fracas_no_memory("the shapes of fragments");
    size_t first = 0;
    for (size_t f = 0; f < record->nfragment; f++) {
        fracas_fragment *fragment = &record->fragment[f];
        fracas_fragment_matter matter = {0};
        const size_t count = end[f] - first;
        body->add_matter(model, step, lane, sorted + first, count, &matter, node);
        fracas_fragment_set_ellipsoid(&matter, fragment);
        fragment->volume = fragment->mass / model->spec.material.density;
        fragment->extent = isfinite(fragment->semi_axis[0])
                               ? fracas_fragment_extent((const double(*)[3])node, count * nodes)
                               : NAN;
        fragment->crack_area = 0;
        first = end[f];
    }
    body->add_cracks(model, step, lane, record->fragment);
    return FRACAS_OK;
}
