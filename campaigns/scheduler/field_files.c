/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/field_files.h"

#include "base/param.h"
#include "campaigns/plan/plan.h"
#include "campaigns/store/vtk.h"
#include "engine/fragments/overlap.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>

/* ---- instants ---- */

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Time of the first row of a history at or after the first onset; NaN: nothing cracked. */
static double onset_of(const fracas_record *record)
{
    for (size_t r = 0; r < record->nhistory; r++)
        if (record->history[r].time >= record->onset_time) return record->history[r].time;
    return NAN;
}

static double peak_of(const fracas_record *record)
{
    double peak = -INFINITY, time = NAN;
    for (size_t r = 0; r < record->nhistory; r++) {
        const fracas_history_row *row = &record->history[r];
        if (!(row->elastic + row->cohesive > peak)) continue;
        peak = row->elastic + row->cohesive;
        time = row->time;
    }
    return time;
}

/* Number of instants from 0 on, `every` after another. */
static fracas_err count_evenly(const fracas_fields_request *request, double end, size_t *count)
{
    *count = 0;
    if (!(request->every > 0)) return FRACAS_OK;
    const double steps = floor(end / request->every * (1 + 1e-12));
    if (!(steps < FRACAS_MOST_INSTANTS))
        return fracas_fail(FRACAS_USAGE,
                           "an instant every %g s makes %g until the end at %g s; at most %d are "
                           "written: raise --every to %.2g s",
                           request->every, steps + 1, end, FRACAS_MOST_INSTANTS,
                           end / (0.9 * FRACAS_MOST_INSTANTS));
    *count = (size_t)steps + 1;
    return FRACAS_OK;
}

static fracas_err list_instants(const fracas_fields_request *request, const fracas_record *stored,
                                fracas_field_files *files)
{
    size_t evenly, count = 0;
    TRY(count_evenly(request, stored->end_time, &evenly));
    double *due = files->due = malloc((evenly + 3) * sizeof *due);
    files->taken = malloc((evenly + 3) * sizeof *files->taken);
    if (!due || !files->taken) return fracas_no_memory("the instants of fields");
    for (; count < evenly; count++)
        due[count] = fmin((double)count * request->every, stored->end_time);
    const double event[] = {request->onset ? onset_of(stored) : NAN,
                            request->peak ? peak_of(stored) : NAN,
                            request->end ? stored->end_time : NAN};
    for (size_t i = 0; i < FRACAS_COUNT(event); i++)
        if (event[i] >= 0) due[count++] = event[i];
    qsort(due, count, sizeof *due, by_value);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || due[i] > due[files->count - 1]) due[files->count++] = due[i];
    const size_t steps = (size_t)stored->steps + 1; /* at which something can be taken */
    files->most = files->count < steps ? files->count : steps;
    if (files->count > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "the realization never cracked: there is no onset; ask for --at peak,end");
}

/* ---- grids ---- */

static const char *const parts[] = {"body", "interfaces"};

enum { MOST_ARRAYS = FRACAS_STRESSES + 5 };

/* A grid, and the arrays that it points to. */
typedef struct {
    fracas_vtk_grid grid;
    fracas_vtk_array cell[MOST_ARRAYS], node[3];
} part_grid;

static void add(part_grid *p, fracas_vtk_array array)
{
    p->cell[p->grid.narrays++] = array;
}

static void make_body(const fracas_field_files *files, part_grid *p)
{
    const fracas_fields *f = files->fields;
    *p = (part_grid){.node = {{"displacement", f->displacement[0], NULL, 3},
                              {"velocity", f->velocity[0], NULL, 3},
                              {"mass", f->mass, NULL, 1, .still = true}}};
    for (size_t s = 0; s < FRACAS_STRESSES; s++)
        if (f->name[s])
            add(p, (fracas_vtk_array){f->name[s], f->stress[s], NULL, f->components[s]});
    add(p, (fracas_vtk_array){"fragment", NULL, f->fragment});
    add(p, (fracas_vtk_array){"fragment_mass", f->fragment_mass});
    p->grid.npoints = f->elements * f->corners;
    p->grid.ncells = f->elements;
    p->grid.point = (const double(*)[3])f->place;
    p->grid.corners = f->corners;
    p->grid.npoint_arrays = FRACAS_COUNT(p->node);
    p->grid.point_array = p->node;
}

static void make_interfaces(const fracas_field_files *files, part_grid *p)
{
    const fracas_fields *f = files->fields;
    *p = (part_grid){.grid = {.npoints = f->interfaces * f->ends,
                              .ncells = f->interfaces,
                              .point = (const double(*)[3])f->middle,
                              .corners = f->ends}};
    add(p, (fracas_vtk_array){"damage", f->damage});
    add(p, (fracas_vtk_array){"opening", f->opening});
    add(p, (fracas_vtk_array){"strength", f->strength, .still = true});
    add(p, (fracas_vtk_array){"onset_time", f->onset_time});
    add(p, (fracas_vtk_array){"elements", NULL, f->between[0], 2, .still = true});
}

/* Part 0 or 1 of `parts`; *p must stay where it is. */
static const fracas_vtk_grid *make_part(const fracas_field_files *files, int part, part_grid *p)
{
    if (part == 0) make_body(files, p);
    else make_interfaces(files, p);
    p->grid.corner = files->corner;
    p->grid.shape = fracas_vtk_shapes[part][p->grid.corners];
    p->grid.array = p->cell;
    return &p->grid;
}

/* ---- a batch that runs ---- */

/* Both parts, or none. */
static fracas_err write_parts(const fracas_field_files *files)
{
    OWNED char *body = NULL;
    OWNED char *interfaces = NULL;
    part_grid p;
    TRY(fracas_path(&body, "%s/%s-%zu.hdf", files->request->folder, parts[0], files->ntaken));
    TRY(fracas_path(&interfaces, "%s/%s-%zu.hdf", files->request->folder, parts[1], files->ntaken));
    TRY(fracas_vtk_write(body, make_part(files, 0, &p)));
    const fracas_err err = fracas_vtk_write(interfaces, make_part(files, 1, &p));
    if (err) unlink(body);
    return err;
}

static fracas_err write_instant(const fracas_field_files *files)
{
    TRY(write_parts(files));
    for (int part = 0; part < 2; part++)
        TRY(fracas_vtk_write_series(files->request->folder, parts[part], files->taken,
                                    files->ntaken));
    return FRACAS_OK;
}

static fracas_err add_instant(fracas_field_files *files, double time)
{
    for (int part = 0; part < 2; part++) {
        part_grid p;
        TRY(fracas_vtk_film_add(files->film[part], make_part(files, part, &p), time));
    }
    return FRACAS_OK;
}

/* A run that drifts begins again with the same steps: its instants have been taken. */
static fracas_err take(void *context, fracas_batch *batch, const fracas_record *record)
{
    fracas_field_files *files = context;
    const double now = fracas_batch_progress(batch, 0).time;
    (void)record;
    if (files->next == files->count || now < files->due[files->next]) return FRACAS_OK;
    while (files->next < files->count && now >= files->due[files->next]) files->next++;
    fracas_batch_fields(batch, 0, files->fields);
    files->taken[files->ntaken++] = now;
    const fracas_fields_request *request = files->request;
    if (request->show) TRY(request->show(request->context, files->fields, files->most));
    if (!request->folder) return FRACAS_OK;
    return files->film[0] ? add_instant(files, now) : write_instant(files);
}

/* ---- before and after ---- */

static fracas_err prepare_folder(const char *folder)
{
    if (mkdir(folder, 0777) < 0 && errno != EEXIST)
        return fracas_fail_system(errno, "cannot make the folder %s", folder);
    DIR *entries = opendir(folder);
    if (!entries) return fracas_fail_system(errno, "cannot write fields into %s", folder);
    int count = 0;
    while (count < 3 && readdir(entries)) count++; /* `.` and `..` are two */
    closedir(entries);
    if (count > 2)
        return fracas_fail(FRACAS_USAGE,
                           "the folder %s is not empty: name a new one for the fields, or empty it",
                           folder);
    if (access(folder, W_OK | X_OK) < 0)
        return fracas_fail_system(errno, "cannot write fields into %s", folder);
    return FRACAS_OK;
}

static fracas_err number_corners(fracas_field_files *files)
{
    const fracas_fields *f = files->fields;
    const size_t body = f->elements * f->corners, cracks = f->interfaces * f->ends,
                 most = body > cracks ? body : cracks;
    files->corner = malloc(most * sizeof *files->corner);
    if (!files->corner) return fracas_no_memory("the cells of fields");
    for (size_t k = 0; k < most; k++) files->corner[k] = (int64_t)k;
    return FRACAS_OK;
}

static fracas_err open_films(fracas_field_files *files)
{
    for (int part = 0; part < 2; part++) {
        part_grid p;
        TRY(fracas_path(&files->path[part], "%s/%s.vtkhdf", files->request->folder, parts[part]));
        TRY(fracas_vtk_film_create(files->path[part], make_part(files, part, &p), files->most,
                                   &files->film[part]));
    }
    return FRACAS_OK;
}

/* The bytes of one instant. */
static double sum_bytes(const fracas_field_files *files)
{
    double bytes = 0;
    for (int part = 0; part < 2; part++) {
        part_grid p;
        bytes += fracas_vtk_bytes(make_part(files, part, &p));
    }
    return bytes;
}

fracas_err fracas_field_files_bytes(const fracas_model *model, double *bytes)
{
    FRACAS_CLEARED(fracas_field_files) files = {0};
    TRY(fracas_fields_create(model, &files.fields));
    *bytes = sum_bytes(&files);
    return FRACAS_OK;
}

/* An even instant and an event may fall into one step. */
static void announce(const fracas_field_files *files, bool evenly, FILE *out)
{
    char one[FRACAS_SIZE_TEXT], all[FRACAS_SIZE_TEXT];
    double still = 0;
    for (int part = 0; part < 2 && files->film[0]; part++) {
        part_grid p;
        still += fracas_vtk_still_bytes(make_part(files, part, &p));
    }
    const double bytes = sum_bytes(files) - still;
    fprintf(out, "fields: %s%zu instant%s of %s, %s in all, into %s\n", evenly ? "up to " : "",
            files->most, files->most == 1 ? "" : "s", fracas_size_write(bytes, one),
            fracas_size_write(bytes * (double)files->most + still, all), files->request->folder);
    fflush(out);
}

fracas_err fracas_field_files_open(const fracas_fields_request *request, const fracas_model *model,
                                   const fracas_record *stored, fracas_field_files *files,
                                   FILE *out)
{
    *files = (fracas_field_files){.request = request,
                                  .watch = {.pause = take, .end = take, .every = 1}};
    files->watch.context = files;
    TRY(list_instants(request, stored, files));
    TRY(fracas_fields_create(model, &files->fields));
    if (!request->folder) return FRACAS_OK;
    TRY(number_corners(files));
    TRY(prepare_folder(request->folder));
    if (request->one_file) TRY(open_films(files));
    if (out) announce(files, request->every > 0, out);
    return FRACAS_OK;
}

void fracas_field_files_clear(fracas_field_files *files)
{
    fracas_fields_destroy(files->fields);
    for (int part = 0; part < 2; part++) {
        fracas_vtk_film_destroy(files->film[part]);
        free(files->path[part]);
    }
    free(files->corner);
    free(files->due);
    free(files->taken);
    *files = (fracas_field_files){0};
}

/* Nothing is said where it is not defined. */
static void tell_overlap(const fracas_field_files *files, FILE *out)
{
    if (isnan(files->overlap)) return;
    fprintf(
        out,
        "overlap: fragments lie over each other on %.2g %% of the body at %g s (those that were "
        "no neighbours pass through each other)\n",
        100 * files->overlap, files->taken[files->ntaken - 1]);
}

fracas_err fracas_field_files_finish(fracas_field_files *files, FILE *out)
{
    TRY(fracas_fragments_overlap(files->fields, &files->overlap));
    for (int part = 0; part < 2; part++) {
        if (files->film[part]) TRY(fracas_vtk_film_finish(files->film[part]));
        if (!out || !files->request->folder) continue;
        fprintf(out, "%s/%s.%s: %zu instant%s\n", files->request->folder, parts[part],
                files->film[part] ? "vtkhdf" : "hdf.series", files->ntaken,
                files->ntaken == 1 ? "" : "s");
    }
    if (out) tell_overlap(files, out);
    return FRACAS_OK;
}
