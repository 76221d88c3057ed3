/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fracas_export_grids: stored realizations as they move, for ParaView. */
#include "analysis/analysis.h"
#include "analysis/data/flight.h"
#include "analysis/data/output.h"
#include "analysis/data/text.h"
#include "analysis/summary/study.h"
#include "base/file.h"
#include "base/own.h"
#include "campaigns/store/vtk.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- one time ---- */

/* 0, 1, 2, ...: cells have nodes of their own. */
static void count_up(int64_t *number, size_t count)
{
    for (size_t k = 0; k < count; k++) number[k] = (int64_t)k;
}

static fracas_err write_body(const fracas_flight *flight, const fracas_flight_instant *now,
                             const char *path)
{
    const size_t n = flight->mesh.nelements, nodes = n * flight->corners;
    OWNED int64_t *whole = malloc((nodes + 2 * n + 1) * sizeof *whole);
    OWNED double *mass = malloc((n + 1) * sizeof *mass);
    if (!whole || !mass) return fracas_no_memory("a grid");
    int64_t *number = whole + nodes, *elements = number + n;
    count_up(whole, nodes);
    for (size_t e = 0; e < n; e++) {
        number[e] = now->state.fragment[e];
        elements[e] = (int64_t)now->state.elements[number[e]];
        mass[e] = now->mass[number[e]];
    }
    const fracas_vtk_array of_cells[] = {
        {"fragment", NULL, number}, {"elements", NULL, elements}, {"fragment_mass", mass, NULL}};
    const fracas_vtk_array of_points[] = {
        {"displacement", (const double *)now->displacement, NULL, .components = 3},
        {"velocity", (const double *)now->velocity, NULL, .components = 3}};
    const fracas_vtk_grid grid = {.npoints = nodes,
                                  .point = (const double(*)[3])now->place,
                                  .ncells = n,
                                  .corners = flight->corners,
                                  .corner = whole,
                                  .shape = fracas_vtk_shapes[0][flight->corners],
                                  .narrays = FRACAS_COUNT(of_cells),
                                  .array = of_cells,
                                  .npoint_arrays = FRACAS_COUNT(of_points),
                                  .point_array = of_points};
    return fracas_vtk_write(path, &grid);
}

/* Where an element has a node of an interface; the last one of a chain, and the first one behind
 * it, share a seam without a common node. */
static const double *side_of(const fracas_flight *flight, const fracas_flight_instant *now,
                             size_t i, size_t end, int side)
{
    const fracas_stored_interface *of = &flight->mesh.interface[i];
    const size_t e = (size_t)of->element[side], corners = flight->corners;
    size_t k = 0;
    while (k < corners && flight->mesh.element[e].node[k] != of->node[end]) k++;
    return now->place[e * corners + (k < corners ? k : 0)];
}

/* Half-way between both sides; at the end of a periodic bar, whose other side is at its start. */
static void place_end(const fracas_flight *flight, const fracas_flight_instant *now, size_t i,
                      size_t end, double place[3])
{
    const double *a = side_of(flight, now, i, end, 0), *b = side_of(flight, now, i, end, 1);
    if (flight->period > 0 && i + 1 == flight->mesh.nelements) b = a;
    for (int k = 0; k < 3; k++) place[k] = (a[k] + b[k]) / 2;
}

static fracas_err write_interfaces(const fracas_flight *flight, const fracas_flight_instant *now,
                                   const char *path)
{
    const size_t n = flight->mesh.ninterfaces, nodes = n * flight->ends;
    OWNED int64_t *whole = malloc((nodes + n + 1) * sizeof *whole);
    OWNED double *real = malloc((4 * n + 1) * sizeof *real);
    OWNED double(*place)[3] = malloc((nodes + 1) * sizeof *place);
    if (!whole || !real || !place) return fracas_no_memory("a grid");
    int64_t *state = whole + nodes;
    count_up(whole, nodes);
    for (size_t k = 0; k < nodes; k++)
        place_end(flight, now, k / flight->ends, k % flight->ends, place[k]);
    for (size_t i = 0; i < n; i++) {
        const fracas_interface_row *row = &flight->record.interface[i];
        state[i] = now->state.interface[i];
        real[i] = row->strength;
        real[n + i] = row->damage;
        real[2 * n + i] = row->onset_time;
        real[3 * n + i] = row->break_time;
    }
    const fracas_vtk_array array[] = {{"state", NULL, state},
                                      {"strength", real, NULL},
                                      {"damage_at_end", real + n, NULL},
                                      {"onset_time", real + 2 * n, NULL},
                                      {"break_time", real + 3 * n, NULL}};
    const fracas_vtk_grid grid = {.npoints = nodes,
                                  .point = (const double(*)[3])place,
                                  .ncells = n,
                                  .corners = flight->ends,
                                  .corner = whole,
                                  .shape = fracas_vtk_shapes[1][flight->ends],
                                  .narrays = FRACAS_COUNT(array),
                                  .array = array};
    return fracas_vtk_write(path, &grid);
}

/* ---- all times ---- */

static const char *const parts[] = {"body", "interfaces"};

/* bytes[2]: of both files, are added. */
static fracas_err write_time(const fracas_flight *flight, double time, size_t number,
                             const char *folder, const char *stem, double *bytes)
{
    FRACAS_CLEARED(fracas_flight_instant) now = {.mass = NULL};
    TRY(fracas_flight_at(flight, time, &now));
    for (int p = 0; p < 2; p++) {
        OWNED char *path = NULL;
        TRY(fracas_path(&path, "%s/%s-%s-%zu.hdf", folder, stem, parts[p], number));
        struct stat is;
        TRY(p ? write_interfaces(flight, &now, path) : write_body(flight, &now, path));
        if (stat(path, &is) == 0) bytes[p] += (double)is.st_size;
    }
    return FRACAS_OK;
}

static fracas_err write_times(const fracas_flight *flight, const double *time, size_t count,
                              const char *folder, const char *stem, FILE *out)
{
    double bytes[2] = {0, 0};
    for (size_t k = 0; k < count; k++) TRY(write_time(flight, time[k], k + 1, folder, stem, bytes));
    for (int p = 0; p < 2; p++) {
        char name[160];
        FRACAS_PRINT(name, "%s-%s", stem, parts[p]);
        TRY(fracas_vtk_write_series(folder, name, time, count));
        fprintf(out, "%s/%s.hdf.series: %zu time%s, %.3g MB\n", folder, name, count,
                count == 1 ? "" : "s", bytes[p] / 1e6);
    }
    return FRACAS_OK;
}

/* ---- a study ---- */

static fracas_err check(const fracas_analysis *analysis, const fracas_grids_request *request)
{
    const size_t npoints = analysis->table->npoints;
    if (!analysis->header.interfaces)
        return fracas_fail(FRACAS_USAGE,
                           "the study keeps no interfaces, by which its cracks are known: set "
                           "`output: {interfaces: true}` and run it into another folder, or see "
                           "`fracas replay --fields`");
    if (fracas_results_partial(analysis->results))
        return fracas_fail(FRACAS_INTERRUPTED,
                           "grids come with the complete study: finish its run first");
    if (request->point != SIZE_MAX && request->point >= npoints)
        return fracas_fail(FRACAS_USAGE, "there is no point %zu: the study has %zu of them, from 0",
                           request->point, npoints);
    return FRACAS_OK;
}

/* True of a file of an export; the fields of a replay have neither array. */
static bool is_ours(const char *path, bool series, int part)
{
    static const char *const array[] = {"elements", "damage_at_end"};
    return fracas_file_is_own(path) &&
           (series ? fracas_vtk_is_series(path) : fracas_vtk_has(path, array[part]));
}

/* Finds the files of a former export in STUDY/vtk, and removes them unless it is only to `look`.
 * FRACAS_USAGE for anything else of these names, and for all of them in another folder: they may be
 * anybody's. */
static fracas_err make_room(const fracas_grids_request *request, const char *folder,
                            const char *stem, bool look)
{
    bool there = true;
    for (size_t k = 0; there || k <= request->count; k++) {
        there = false;
        for (int p = 0; p < 2; p++) {
            OWNED char *path = NULL;
            if (k == 0) TRY(fracas_path(&path, "%s/%s-%s.hdf.series", folder, stem, parts[p]));
            else TRY(fracas_path(&path, "%s/%s-%s-%zu.hdf", folder, stem, parts[p], k));
            if (access(path, F_OK) != 0) continue;
            if (request->folder)
                return fracas_fail(FRACAS_USAGE,
                                   "%s is there already: name another folder, or remove it", path);
            if (!is_ours(path, k == 0, p)) return fracas_output_refuse(path);
            if (!look) unlink(path);
            there = true;
        }
    }
    return FRACAS_OK;
}

static fracas_err write_flight(const fracas_flight *flight, const fracas_grids_request *request,
                               const char *folder, const char *stem, FILE *out)
{
    OWNED double *time = malloc((request->count + 1) * sizeof *time);
    if (!time) return fracas_no_memory("the times of grids");
    if (request->time) memcpy(time, request->time, request->count * sizeof *time);
    else TRY(fracas_flight_moments(flight, time, request->count));
    TRY(make_room(request, folder, stem, true));
    TRY(make_room(request, folder, stem, false));
    return write_times(flight, time, request->count, folder, stem, out);
}

/* Writes a realization and counts it, or says why there is none. */
static fracas_err write_realization(const fracas_analysis *analysis, size_t p,
                                    const fracas_grids_request *request, const char *folder,
                                    size_t *written, FILE *out)
{
    FRACAS_CLEARED(fracas_flight) flight = {.corners = 0};
    const fracas_point_statistics *of = &analysis->point[p];
    const int64_t shown = of->broken_replica >= 0 ? of->broken_replica : of->typical_replica,
                  replica = request->replica >= 0 ? request->replica : shown;
    const size_t none = fracas_results_realizations(analysis->results);
    char stem[64];
    size_t row = none;
    FRACAS_PRINT(stem, "point-%zu-replica-%" PRId64, p, replica);
    if (replica >= 0) TRY(fracas_results_find(analysis->results, p, replica, &row));
    else fprintf(out, "point %zu: all its realizations FAILED\n", p);
    if (replica >= 0 && row == none)
        fprintf(out, "there is no replica %" PRId64 ": point %zu has %" PRId64 " of them, from 0\n",
                replica, p, analysis->table->point[p].replicas);
    if (row == none) return FRACAS_OK;
    TRY(fracas_flight_read(analysis->results, p, row, &flight));
    if (flight.mesh.nelements == 0) {
        fprintf(out, "replica %" PRId64 " of point %zu ended %s and left nothing\n", replica, p,
                fracas_outcome_name(flight.record.outcome));
        return FRACAS_OK;
    }
    ++*written;
    return write_flight(&flight, request, folder, stem, out);
}

fracas_err fracas_export_grids(const fracas_analysis *analysis, const char *study,
                               const fracas_grids_request *request, FILE *out)
{
    const bool all = request->point == SIZE_MAX;
    const size_t first = all ? 0 : request->point,
                 end = all ? analysis->table->npoints : request->point + 1;
    OWNED char *folder = NULL;
    size_t written = 0;
    TRY(check(analysis, request));
    TRY(fracas_output_folder_in(request->folder, study, "vtk", &folder));
    for (size_t p = first; p < end; p++)
        TRY(write_realization(analysis, p, request, folder, &written, out));
    if (written > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "nothing was exported: choose another point or replica");
}
