/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fracas_pictures_write: pictures and first times of one realization, and the first times of all of
 * a point. */
#include "analysis/data/field.h"
#include "analysis/data/output.h"
#include "analysis/report/films.h"
#include "analysis/report/page.h"
#include "base/file.h"
#include "base/own.h"
#include "base/text.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
                       "%s --study %s` completes it",
                       m->study, m->study, fracas_shell_path(m->study, "campaign.yaml").text,
                       fracas_shell_path(m->study, NULL).text);
}

static fracas_err check_point(making *m)
{
    const size_t point = m->request->point, npoints = m->table->npoints;
    if (!fracas_results_header(m->results)->interfaces)
        return fracas_fail(FRACAS_USAGE,
                           "%s keeps no interfaces, so it does not say where the cracks are: run "
                           "the campaign with `output: {interfaces: true}` into another study",
                           m->study);
    if (point >= npoints)
        return fracas_fail(FRACAS_USAGE, "there is no point %zu: %s has %zu of them, from 0", point,
                           m->study, npoints);
    for (size_t p = 0; p < point; p++) m->first_row += (size_t)m->table->point[p].replicas;
    return FRACAS_OK;
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
    if (m->request->film) TRY(fracas_flight_check(record));
    for (size_t k = 0; m->request->time && k < m->request->count; k++) {
        const double time = m->request->time[k];
        if (time >= 0 && (time <= record->end_time || (m->request->film && !m->request->dots)))
            continue;
        return fracas_fail(FRACAS_USAGE,
                           "time %s is outside of the realization, which goes from 0 to %s",
                           fracas_surface_time(time, false).text,
                           fracas_surface_time(record->end_time, false).text);
    }
    return FRACAS_OK;
}

/* ---- the files ---- */

enum { STEM = 48, TABLE = 40 };

/* "surface-point-0-replica-3" */
static void name_realization(const making *m, char stem[STEM])
{
    snprintf(stem, STEM, "surface-point-%zu-replica-%" PRId64, m->request->point,
             m->request->replica);
}

static void name_table(const making *m, char name[TABLE])
{
    snprintf(name, TABLE, "times-point-%zu", m->request->point);
}

/* "surface-point-0-replica-3-07" of 12: in order by their names, too. */
static void name_picture(const making *m, size_t k, size_t count, char name[FRACAS_DRAWING])
{
    char stem[STEM];
    name_realization(m, stem);
    snprintf(name, FRACAS_DRAWING, "%s-%0*zu", stem, snprintf(NULL, 0, "%zu", count), k + 1);
}

/* ---- somebody's own files ---- */

static bool is_picture(const char *path)
{
    return fracas_file_begins(path, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg "
                                    "xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\"");
}

static bool is_table(const char *path)
{
    return fracas_file_begins(path, "replica,outcome,first_onset,first_break,");
}

/* FRACAS_USAGE for a file that is there and not ours. */
static fracas_err check_file(const making *m, const char *stem, const char *ending,
                             bool (*is_ours)(const char *path))
{
    OWNED char *path = NULL;
    TRY(fracas_path(&path, "%s/%s.%s", m->folder, stem, ending));
    const bool own = fracas_file_is_own(path);
    return own && (access(path, F_OK) || is_ours(path)) ? FRACAS_OK : fracas_output_refuse(path);
}

/* Our drawing is there: a PNG beside it is ours, too, also of a version that did not mark it. */
static bool has_drawing(const making *m, const char *stem)
{
    OWNED char *path = NULL;
    return !fracas_path(&path, "%s/%s.svg", m->folder, stem) && !access(path, F_OK) &&
           is_picture(path);
}

/* Before anything is written; count: pictures. */
static fracas_err check_free(const making *m, size_t count)
{
    char name[FRACAS_DRAWING], stem[STEM], table[TABLE];
    name_realization(m, stem);
    name_table(m, table);
    for (size_t k = 0; k < count; k++) {
        name_picture(m, k, count, name);
        TRY(check_file(m, name, "svg", is_picture));
        if (m->request->dots && fracas_convert_possible && !has_drawing(m, name))
            TRY(check_file(m, name, "png", fracas_convert_made_png));
    }
    if (m->request->film) TRY(check_file(m, stem, "html", fracas_output_is_page));
    return m->request->table ? check_file(m, table, "csv", is_table) : FRACAS_OK;
}

/* ---- the drawings ---- */

/* Fills the title, which the picture points to. */
static fracas_surface_picture picture_at(const making *m, const fracas_broken_surface *surface,
                                         double time, char title[128])
{
    snprintf(title, 128, "Point %zu, replica %" PRId64 " at %s", m->request->point,
             m->request->replica, fracas_surface_time(time, true).text);
    return (fracas_surface_picture){.title = title,
                                    .show = m->request->show,
                                    .width = FRACAS_SURFACE_WIDTH,
                                    .standalone = true,
                                    .view = m->request->view,
                                    .explode = m->request->explode,
                                    .thickness = surface->thickness};
}

static fracas_err save_pictures(const making *m, const fracas_broken_surface *surface,
                                const double *time, size_t count)
{
    OWNED char(*name)[FRACAS_DRAWING] = calloc(count + 1, sizeof *name);
    char title[128], file[FRACAS_DRAWING + 4];
    if (!name) return fracas_no_memory("the names of pictures");
    for (size_t k = 0; k < count; k++) {
        const fracas_surface_picture picture = picture_at(m, surface, time[k], title);
        name_picture(m, k, count, name[k]);
        FRACAS_PRINT(file, "%s.svg", name[k]);
        TRY(fracas_broken_surface_save(surface, time[k], &picture, m->folder, file));
        fprintf(m->out, "%s/%s: %s\n", m->folder, file, fracas_surface_time(time[k], false).text);
    }
    if (!m->request->dots) return FRACAS_OK;
    if (!fracas_convert_possible)
        return fracas_fail(FRACAS_ENVIRONMENT, "this fracas was built without librsvg, which "
                                               "draws PNGs: install librsvg2-dev and build it "
                                               "again; the SVG files are written");
    return fracas_convert(m->folder, name, count, FRACAS_DRAWING_PNG);
}

static fracas_err save_film(const making *m)
{
    FRACAS_CLEARED(fracas_flight) flight = {.corners = 0};
    const fracas_picture_request *request = m->request;
    const size_t count = request->count;
    OWNED double *time = calloc(count + 1, sizeof *time);
    char stem[STEM], file[STEM + 5], title[512];
    if (!time) return fracas_no_memory("the times of a film");
    TRY(fracas_flight_read(m->results, request->point, m->first_row + (size_t)request->replica,
                           &flight));
    const size_t most = fracas_flight_film_most(&flight);
    if (count > most)
        return fracas_fail(FRACAS_USAGE,
                           "a film of %zu times would have more than browsers like to hold: say "
                           "--times %zu, or see `fracas export --vtk` in ParaView",
                           count, most);
    if (request->time) memcpy(time, request->time, count * sizeof *time);
    else TRY(fracas_flight_moments(&flight, time, count));
    name_realization(m, stem);
    FRACAS_PRINT(file, "%s.html", stem);
    snprintf(title, sizeof title, "%s: point %zu, replica %" PRId64, m->study, request->point,
             request->replica);
    TRY(fracas_flight_film(&flight, time, count, m->folder, file, title));
    fprintf(m->out, "%s/%s: %zu times\n", m->folder, file, count);
    return FRACAS_OK;
}

static fracas_err save(const making *m, const fracas_broken_surface *surface)
{
    const fracas_picture_request *request = m->request;
    OWNED double *time = calloc(request->count + 1, sizeof *time);
    if (!time) return fracas_no_memory("the times of pictures");
    size_t count = request->count;
    if (request->time) memcpy(time, request->time, count * sizeof *time);
    else TRY(fracas_surface_moments(&surface->record, time, &count));
    const bool draws = !request->film || request->dots;
    TRY(check_free(m, draws ? count : 0));
    if (request->film) TRY(save_film(m));
    return draws ? save_pictures(m, surface, time, count) : FRACAS_OK;
}

static fracas_err say_times(const making *m, const fracas_broken_surface *surface)
{
    static const char *const what[] = {"first onset", "first break", "first crack through"};
    fracas_surface_times times;
    TRY(fracas_surface_times_of(&surface->mesh, &surface->record, &times));
    const double at[] = {times.onset, times.broken, fmin(times.through[0], times.through[1])};
    const bool through = !surface->strip && fracas_surface_is_flat(&surface->mesh);
    for (int k = 0; k < (through ? 3 : 2); k++) {
        fprintf(m->out, "%s: %s\n", what[k], fracas_surface_time(at[k], false).text);
    }
    return FRACAS_OK;
}

/* mesh: of a surface; a bar or ring has none, and cracks through its width as it breaks. */
static fracas_err put_line(const making *m, const fracas_stored_mesh *mesh, int64_t replica,
                           fracas_record *record, FILE *out)
{
    size_t point;
    int64_t found;
    TRY(fracas_results_record(m->results, m->first_row + (size_t)replica, FRACAS_READ_INTERFACES,
                              &point, &found, record));
    fracas_surface_times times = {NAN, NAN, {NAN, NAN}};
    if (record->ninterface > 0 && mesh) TRY(fracas_surface_times_of(mesh, record, &times));
    else fracas_surface_first_times(record, &times);
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
    char stem[TABLE], name[TABLE + 4];
    fracas_output_file output;
    FRACAS_CLEARED(fracas_record) record;
    fracas_record_init(&record);
    fracas_err err = FRACAS_OK;
    name_table(m, stem);
    FRACAS_PRINT(name, "%s.csv", stem);
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
    TRY(fracas_output_folder_in(m->request->folder, m->study, "pictures", &m->folder));
    TRY(save(m, &surface));
    if (m->request->table) TRY(save_table(m, surface.strip ? NULL : &surface.mesh));
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
