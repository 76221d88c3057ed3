/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/grids.h"

#include "analysis/data/text.h"
#include "base/own.h"
#include "campaigns/store/vtk.h"

#include <stdlib.h>
#include <string.h>

/* ---- one time ---- */

static fracas_err write_fragments(const fracas_stored_mesh *mesh, const fracas_surface_state *state,
                                  const char *path)
{
    const size_t n = mesh->nelements, corners = n && mesh->element[0].node[3] >= 0 ? 6 : 3;
    OWNED int64_t *corner = malloc((n * corners + 1) * sizeof *corner);
    OWNED int64_t *whole = malloc((2 * n + 1) * sizeof *whole);
    if (!corner || !whole) return fracas_no_memory("a grid");
    int64_t *number = whole, *elements = whole + n;
    for (size_t e = 0; e < n; e++) {
        memcpy(corner + e * corners, mesh->element[e].node, corners * sizeof *corner);
        number[e] = state->fragment[e];
        elements[e] = (int64_t)state->elements[number[e]];
    }
    const fracas_vtk_array array[] = {{"fragment", NULL, number}, {"elements", NULL, elements}};
    const fracas_vtk_grid grid = {.npoints = mesh->nnodes,
                                  .point = (const double(*)[3])(const void *)mesh->node,
                                  .ncells = n,
                                  .corners = corners,
                                  .corner = corner,
                                  .shape = corners == 6 ? FRACAS_VTK_QUADRATIC_TRIANGLE
                                                        : FRACAS_VTK_TRIANGLE,
                                  .narrays = 2,
                                  .array = array};
    return fracas_vtk_write(path, &grid);
}

static fracas_err write_cracks(const fracas_broken_surface *surface,
                               const fracas_surface_state *state, const char *path)
{
    const fracas_stored_mesh *mesh = &surface->mesh;
    const size_t n = mesh->ninterfaces, corners = n && mesh->interface[0].node[2] >= 0 ? 3 : 2;
    OWNED int64_t *corner = malloc((n * (corners + 1) + 1) * sizeof *corner);
    OWNED double *real = malloc((4 * n + 1) * sizeof *real);
    if (!corner || !real) return fracas_no_memory("a grid");
    int64_t *now = corner + n * corners;
    for (size_t i = 0; i < n; i++) {
        const fracas_interface_row *row = &surface->record.interface[i];
        memcpy(corner + i * corners, mesh->interface[i].node, corners * sizeof *corner);
        now[i] = state->interface[i];
        real[i] = row->strength;
        real[n + i] = row->damage;
        real[2 * n + i] = row->onset_time;
        real[3 * n + i] = row->break_time;
    }
    const fracas_vtk_array array[] = {{"state", NULL, now},
                                      {"strength", real, NULL},
                                      {"damage_at_end", real + n, NULL},
                                      {"onset_time", real + 2 * n, NULL},
                                      {"break_time", real + 3 * n, NULL}};
    const fracas_vtk_grid grid = {.npoints = mesh->nnodes,
                                  .point = (const double(*)[3])(const void *)mesh->node,
                                  .ncells = n,
                                  .corners = corners,
                                  .corner = corner,
                                  .shape = corners == 3 ? FRACAS_VTK_QUADRATIC_LINE
                                                        : FRACAS_VTK_LINE,
                                  .narrays = 5,
                                  .array = array};
    return fracas_vtk_write(path, &grid);
}

/* ---- all times ---- */

static const char *const parts[] = {"fragments", "cracks"};

static fracas_err write_time(const fracas_broken_surface *surface, double time, size_t number,
                             const char *folder, const char *stem)
{
    FRACAS_CLEARED(fracas_surface_state) state = {.time = time};
    TRY(fracas_surface_state_create(&surface->mesh, &surface->record, time, &state));
    for (int p = 0; p < 2; p++) {
        OWNED char *path = NULL;
        TRY(fracas_path(&path, "%s/%s-%s-%zu.hdf", folder, stem, parts[p], number));
        TRY(p ? write_cracks(surface, &state, path)
              : write_fragments(&surface->mesh, &state, path));
    }
    return FRACAS_OK;
}

fracas_err fracas_grids_write(const fracas_broken_surface *surface, const double *time,
                              size_t count, const char *folder, const char *stem, FILE *out)
{
    for (size_t k = 0; k < count; k++) TRY(write_time(surface, time[k], k + 1, folder, stem));
    for (int p = 0; p < 2; p++) {
        char name[160];
        FRACAS_PRINT(name, "%s-%s", stem, parts[p]);
        TRY(fracas_vtk_write_series(folder, name, time, count));
        fprintf(out, "%s/%s.hdf.series: %zu times\n", folder, name, count);
    }
    return FRACAS_OK;
}
