/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fracas_pictures_write: pictures and first times of one realization, and the first times of all of
 * a point. */
#include "analysis/data/field.h"
#include "analysis/data/output.h"
#include "analysis/report/page.h"
#include "base/own.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *study;
    const fracas_picture_request *request;
    fracas_results *results; /* study.h5 */
    const fracas_point_table *table;
    size_t first_row; /* for the point, in the study */
    char *folder;
    FILE *out;
} making;

/* ---- the request ---- */

/* The points of an extended study are numbered anew. */
static fracas_err check_campaign(const making *m)
{
    const fracas_hash *wanted = m->request->campaign;
    if (!wanted || fracas_hash_equal(&fracas_results_header(m->results)->campaign, wanted))
        return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "pictures come with the complete study: %s/study.h5 is of another campaign "
                       "than %s/campaign.yaml, from before it was extended; `fracas run "
                       "%s/campaign.yaml --study %s` completes it",
                       m->study, m->study, m->study, m->study);
}

static fracas_err no_surface(size_t point)
{
    return fracas_fail(FRACAS_USAGE,
                       "point %zu is no surface: only membranes and shells have pictures; `fracas "
                       "report` draws the fragments of rings",
                       point);
}

static fracas_err check_point(making *m)
{
    const size_t point = m->request->point, npoints = m->table->npoints;
    const bool kept = fracas_results_header(m->results)->interfaces;
    if (!kept && point < npoints && !fracas_columns_surface(m->table, point))
        return no_surface(point);
    if (!kept)
        return fracas_fail(FRACAS_USAGE,
                           "%s keeps no interfaces, so it does not say where the cracks are: run "
                           "the campaign with `output: {interfaces: true}` into another study",
                           m->study);
    if (point >= npoints)
        return fracas_fail(FRACAS_USAGE, "there is no point %zu: %s has %zu of them, from 0", point,
                           m->study, npoints);
    for (size_t p = 0; p < point; p++) m->first_row += (size_t)m->table->point[p].replicas;
    size_t interfaces;
    TRY(fracas_results_mesh_interfaces(m->results, point, &interfaces));
    return interfaces ? FRACAS_OK : no_surface(point);
}

static fracas_err check_replica(const making *m)
{
    const int64_t replica = m->request->replica,
                  replicas = m->table->point[m->request->point].replicas;
    if (replica >= 0 && replica < replicas) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "there is no replica %" PRId64 ": point %zu has %" PRId64 " of them, from 0",
                       replica, m->request->point, replicas);
}

static fracas_err check_record(const making *m, const fracas_record *record)
{
    if (record->ninterface == 0)
        return fracas_fail(
            FRACAS_USAGE,
            "replica %" PRId64 " of point %zu ended %s and left nothing to draw; choose another",
            m->request->replica, m->request->point, fracas_outcome_name(record->outcome));
    for (size_t k = 0; m->request->time && k < m->request->count; k++) {
        const double time = m->request->time[k];
        if (time >= 0 && time <= record->end_time) continue;
        return fracas_fail(FRACAS_USAGE,
                           "time %s is outside of the realization, which goes from 0 to %s",
                           fracas_surface_time(time, false).text,
                           fracas_surface_time(record->end_time, false).text);
    }
    return FRACAS_OK;
}

/* ---- the files ---- */

static fracas_err save_pictures(const making *m, const fracas_broken_surface *surface)
{
    const fracas_picture_request *request = m->request;
    OWNED double *time = calloc(request->count + 1, sizeof *time);
    if (!time) return fracas_no_memory("the times of pictures");
    size_t count = request->count;
    if (request->time) memcpy(time, request->time, count * sizeof *time);
    else count = fracas_surface_moments(&surface->record, count, time);
    for (size_t k = 0; k < count; k++) {
        char title[256], name[128];
        FRACAS_PRINT(title, "Point %zu, replica %" PRId64 " at %s", request->point,
                     request->replica, fracas_surface_time(time[k], true).text);
        FRACAS_PRINT(name, "surface-point-%zu-replica-%" PRId64 "-%zu.svg", request->point,
                     request->replica, k + 1);
        const fracas_surface_picture picture = {
            title,         request->show,    FRACAS_SURFACE_WIDTH, true,
            request->view, request->explode, surface->thickness};
        TRY(fracas_broken_surface_save(surface, time[k], &picture, m->folder, name));
        fprintf(m->out, "%s/%s: %s\n", m->folder, name, fracas_surface_time(time[k], false).text);
    }
    return FRACAS_OK;
}

static fracas_err say_times(const making *m, const fracas_broken_surface *surface)
{
    static const char *const what[] = {"first onset", "first break", "first crack through"};
    fracas_surface_times times;
    TRY(fracas_surface_times_of(&surface->mesh, &surface->record, &times));
    const double at[] = {times.onset, times.broken, fmin(times.through[0], times.through[1])};
    for (int k = 0; k < (fracas_surface_is_flat(&surface->mesh) ? 3 : 2); k++) {
        fprintf(m->out, "%s: %s\n", what[k], fracas_surface_time(at[k], false).text);
    }
    return FRACAS_OK;
}

static fracas_err put_line(const making *m, const fracas_stored_mesh *mesh, int64_t replica,
                           fracas_record *record, FILE *out)
{
    size_t point;
    int64_t found;
    TRY(fracas_results_record(m->results, m->first_row + (size_t)replica, FRACAS_READ_INTERFACES,
                              &point, &found, record));
    fracas_surface_times times = {NAN, NAN, {NAN, NAN}};
    if (record->ninterface > 0) TRY(fracas_surface_times_of(mesh, record, &times));
    fprintf(out, "%" PRId64 ",%s", replica, fracas_outcome_name(record->outcome));
    fracas_csv_real(times.onset, out);
    fracas_csv_real(times.broken, out);
    fracas_csv_real(fmin(times.through[0], times.through[1]), out);
    for (int k = 0; k < 2; k++) fracas_csv_real(times.through[k], out);
    fracas_csv_real(record->end_time, out);
    fprintf(out, ",%" PRId64 ",%" PRId64 "\n", record->fragments, record->fragments_dust);
    return FRACAS_OK;
}

static fracas_err save_table(const making *m, const fracas_stored_mesh *mesh)
{
    char name[64];
    fracas_output_file output;
    FRACAS_CLEARED(fracas_record) record;
    fracas_record_init(&record);
    fracas_err err = FRACAS_OK;
    FRACAS_PRINT(name, "times-point-%zu.csv", m->request->point);
    TRY(fracas_output_open(m->folder, name, &output));
    fputs("replica,outcome,first_onset,first_break,first_through,through_1_2,through_3_4,end_time,"
          "fragments,fragments_dust\n",
          output.file);
    for (int64_t r = 0; !err && r < m->table->point[m->request->point].replicas; r++)
        err = put_line(m, mesh, r, &record, output.file);
    TRY(fracas_output_close(&output, err));
    fprintf(m->out, "%s/%s: all replicas of point %zu\n", m->folder, name, m->request->point);
    return FRACAS_OK;
}

static fracas_err make(making *m)
{
    m->table = fracas_results_points(m->results);
    TRY(check_point(m));
    TRY(check_replica(m));
    FRACAS_CLEARED(fracas_broken_surface) surface = {.thickness = 0};
    TRY(fracas_broken_surface_read(m->results, m->request->point,
                                   m->first_row + (size_t)m->request->replica, &surface));
    TRY(check_record(m, &surface.record));
    const char *wanted = m->request->folder;
    if (wanted) TRY(fracas_path(&m->folder, "%s", wanted));
    TRY(wanted ? fracas_output_folder(m->folder)
               : fracas_output_folder_in(m->study, "pictures", &m->folder));
    TRY(save_pictures(m, &surface));
    if (m->request->table) TRY(save_table(m, &surface.mesh));
    return say_times(m, &surface);
}

fracas_err fracas_pictures_write(const char *study, const fracas_picture_request *request,
                                 FILE *out)
{
    making m = {.study = study, .request = request, .out = out};
    fracas_err err = fracas_results_open(study, NULL, NULL, &m.results);
    if (err) return fracas_fail_within(err, "pictures come with the complete study");
    err = check_campaign(&m);
    if (!err) err = make(&m);
    fracas_results_close(m.results);
    free(m.folder);
    return err;
}
