/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

fracas_err fracas_stored_mesh_allocate(fracas_stored_mesh *mesh)
{
    mesh->node = calloc(mesh->nnodes + 1, sizeof *mesh->node);
    mesh->element = calloc(mesh->nelements + 1, sizeof *mesh->element);
    mesh->interface = calloc(mesh->ninterfaces + 1, sizeof *mesh->interface);
    mesh->border = calloc(mesh->nborders + 1, sizeof *mesh->border);
    if (mesh->node && mesh->element && mesh->interface && mesh->border) return FRACAS_OK;
    return fracas_no_memory("a mesh");
}

void fracas_stored_mesh_clear(fracas_stored_mesh *mesh)
{
    free(mesh->node);
    free(mesh->element);
    free(mesh->interface);
    free(mesh->border);
    *mesh = (fracas_stored_mesh){0};
}

static bool same(const void *a, const void *b, size_t count, size_t size)
{
    return count == 0 || memcmp(a, b, count * size) == 0;
}

bool fracas_stored_mesh_same(const fracas_stored_mesh *a, const fracas_stored_mesh *b)
{
    return a->nnodes == b->nnodes && a->nelements == b->nelements &&
           a->ninterfaces == b->ninterfaces && a->nborders == b->nborders &&
           same(a->node, b->node, a->nnodes, sizeof *a->node) &&
           same(a->element, b->element, a->nelements, sizeof *a->element) &&
           same(a->interface, b->interface, a->ninterfaces, sizeof *a->interface) &&
           same(a->border, b->border, a->nborders, sizeof *a->border);
}

static bool exists(int64_t number, size_t count)
{
    return number >= 0 && (uint64_t)number < count;
}

/* True if `element` has the edge node[0] to node[1], with that middle; either way round unless
 * `forward`. */
static bool has_edge(const fracas_stored_mesh *mesh, int64_t element, const int64_t node[3],
                     bool forward)
{
    const int64_t *of = mesh->element[element].node;
    for (int k = 0; k < 3; k++) {
        const int64_t from = of[k], to = of[(k + 1) % 3];
        const bool found = (from == node[0] && to == node[1]) ||
                           (!forward && from == node[1] && to == node[0]);
        if (found) return of[3 + k] == node[2];
    }
    return false;
}

static const char *fault_of_element(const fracas_stored_mesh *mesh,
                                    const fracas_stored_element *element)
{
    for (int k = 0; k < 6; k++) {
        if (k >= 3 && element->node[k] == -1) continue;
        if (!exists(element->node[k], mesh->nnodes))
            return "an element has a node that does not exist";
    }
    return NULL;
}

const char *fracas_stored_mesh_fault(const fracas_stored_mesh *mesh)
{
    for (size_t n = 0; n < mesh->nnodes; n++)
        for (int i = 0; i < 3; i++)
            if (!isfinite(mesh->node[n].position[i])) return "a node has no position";
    for (size_t e = 0; e < mesh->nelements; e++) {
        const char *fault = fault_of_element(mesh, &mesh->element[e]);
        if (fault) return fault;
    }
    for (size_t i = 0; i < mesh->ninterfaces; i++) {
        const fracas_stored_interface *interface = &mesh->interface[i];
        for (int side = 0; side < 2; side++)
            if (!exists(interface->element[side], mesh->nelements) ||
                !has_edge(mesh, interface->element[side], interface->node, side == 0))
                return "an interface is no edge of its elements";
    }
    for (size_t b = 0; b < mesh->nborders; b++) {
        const fracas_stored_border *border = &mesh->border[b];
        if (!exists(border->element, mesh->nelements) ||
            !has_edge(mesh, border->element, border->node, true))
            return "a border is no edge of its element";
    }
    return NULL;
}
