/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/chain.h"

#include "base/own.h"

#include <math.h>
#include <stdlib.h>

fracas_err fracas_chain_of(const fracas_record *record, fracas_chain *chain)
{
    const size_t between = record->ninterface;
    *chain = (fracas_chain){0};
    for (size_t f = 0; f < record->nfragment; f++) {
        chain->elements += (size_t)record->fragment[f].elements;
        chain->length += record->fragment[f].size;
    }
    chain->closed = between == chain->elements;
    if (chain->elements >= 2 && (chain->closed || between == chain->elements - 1)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%zu interfaces are not those between the %zu elements of a bar or ring",
                       between, chain->elements);
}

void fracas_chain_along(const fracas_chain *chain, const fracas_record *record, double *along)
{
    size_t f = 0;
    along[0] = 0;
    for (size_t e = 0; e < chain->elements; e++) {
        const fracas_fragment *fragment = &record->fragment[f % record->nfragment];
        along[e + 1] = along[e] + fragment->size / (double)fragment->elements;
        if (e < record->ninterface && isfinite(record->interface[e].break_time)) f++;
    }
}

fracas_err fracas_chain_mesh(const fracas_record *record, bool round, fracas_stored_mesh *mesh)
{
    fracas_chain chain;
    TRY(fracas_chain_of(record, &chain));
    const size_t n = chain.elements;
    OWNED double *along = malloc((n + 1) * sizeof *along);
    if (!along) return fracas_no_memory("the elements of a bar or ring");
    fracas_chain_along(&chain, record, along);
    *mesh = (fracas_stored_mesh){
        .nnodes = n + 1, .nelements = n, .ninterfaces = record->ninterface};
    TRY(fracas_stored_mesh_allocate(mesh));
    const double radius = chain.length / (double)n / (2 * sin(M_PI / (double)n));
    for (size_t i = 0; i <= n; i++) {
        const double angle = 2 * M_PI * along[i] / chain.length;
        double *at = mesh->node[i].position;
        at[0] = round ? radius * cos(angle) : along[i];
        at[1] = round ? radius * sin(angle) : 0;
    }
    for (size_t e = 0; e < n; e++)
        mesh->element[e] = (fracas_stored_element){{(int64_t)e, (int64_t)e + 1, -1, -1, -1, -1}};
    for (size_t i = 0; i < mesh->ninterfaces; i++)
        mesh->interface[i] = (fracas_stored_interface){{(int64_t)i, (int64_t)((i + 1) % n)},
                                                       {(int64_t)i + 1, -1, -1}};
    return FRACAS_OK;
}
