/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/page.h"

#include "analysis/data/field.h"
#include "analysis/data/output.h"
#include "analysis/data/strip.h"
#include "analysis/draw/chart.h"
#include "analysis/report/films.h"
#include "base/own.h"

#include <math.h>
#include <unistd.h>

static const size_t most_elements = 1500000; /* drawn on a page, some 20 MB of it */
static const double apart = 0.1;             /* fragments of surfaces in space on a page */
static const size_t most_apart = 50000; /* elements; of larger meshes gaps take too much room */
static const double most_filmed = 60e6; /* bytes of all films of a report */

fracas_err fracas_broken_surface_read(fracas_results *results, size_t point, size_t row,
                                      fracas_broken_surface *surface)
{
    size_t of;
    int64_t replica;
    *surface = (fracas_broken_surface){0};
    fracas_record_init(&surface->record);
    const double thickness = fracas_columns_real(fracas_results_points(results), point,
                                                 "geometry.thickness");
    if (thickness > 0) surface->thickness = thickness;
    TRY(fracas_results_mesh(results, point, &surface->mesh));
    TRY(fracas_results_record(results, row, FRACAS_READ_INTERFACES | FRACAS_READ_FRAGMENTS, &of,
                              &replica, &surface->record));
    surface->strip = surface->mesh.nelements == 0;
    surface->ninterfaces = surface->record.ninterface;
    if (!surface->strip || surface->record.ninterface == 0) return FRACAS_OK;
    return fracas_strip_create(&surface->record, &surface->mesh);
}

fracas_err fracas_broken_surface_kept(fracas_results *results, size_t point, bool *kept)
{
    size_t interfaces;
    TRY(fracas_results_mesh_interfaces(results, point, &interfaces));
    const fracas_point_table *table = fracas_results_points(results);
    const bool chain = fracas_columns_real(table, point, "derived.surface") == 0;
    *kept = interfaces > 0 || (chain && fracas_results_header(results)->interfaces);
    return FRACAS_OK;
}

void fracas_broken_surface_clear(fracas_broken_surface *surface)
{
    fracas_stored_mesh_clear(&surface->mesh);
    fracas_record_clear(&surface->record);
}

fracas_err fracas_broken_surface_draw(const fracas_broken_surface *surface, double time,
                                      const fracas_surface_picture *picture, FILE *out)
{
    FRACAS_CLEARED(fracas_surface_state) state = {.time = time};
    TRY(fracas_surface_state_create(&surface->mesh, &surface->record, time, &state));
    return fracas_surface_picture_write(&surface->mesh, &state, picture, out);
}

fracas_err fracas_broken_surface_save(const fracas_broken_surface *surface, double time,
                                      const fracas_surface_picture *picture, const char *folder,
                                      const char *name)
{
    fracas_output_file output;
    TRY(fracas_output_open(folder, name, &output));
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", output.file);
    return fracas_output_close(&output,
                               fracas_broken_surface_draw(surface, time, picture, output.file));
}

/* ---- the page ---- */

typedef struct {
    fracas_page *page;
    size_t drawn;  /* elements so far; a gap takes twice the room of an element */
    double filmed; /* bytes so far */
} gallery;

static double explode_of(const fracas_stored_mesh *mesh)
{
    return fracas_surface_is_flat(mesh) || mesh->nelements > most_apart ? 0 : apart;
}

/* Elements that a picture has room for. */
static size_t weight_of(const fracas_stored_mesh *mesh)
{
    return (explode_of(mesh) > 0 ? 3 : 1) * mesh->nelements;
}

static const char *body_of(const fracas_broken_surface *surface)
{
    return surface->strip ? "body" : "surface";
}

/* A picture of the row, with files of its own. */
static fracas_err put_moment(const gallery *to, const fracas_broken_surface *surface, size_t p,
                             size_t picture_number, double time)
{
    char title[256], name[64], file[80];
    const fracas_label label = fracas_analysis_label(to->page->analysis, p);
    const fracas_number_text at = fracas_surface_time(time, true);
    FRACAS_PRINT(title, "Broken %s at %s%s%.159s", body_of(surface), at.text,
                 *label.text ? ": " : "", label.text);
    fracas_surface_picture picture = {.title = title,
                                      .show = FRACAS_SHOW_FRAGMENTS,
                                      .width = FRACAS_CHART_NARROW,
                                      .explode = explode_of(&surface->mesh),
                                      .thickness = surface->thickness};
    FRACAS_PRINT(name, "surface-point-%zu-%zu", p, picture_number);
    FRACAS_PRINT(file, "%s.svg", name);
    TRY(fracas_page_make_room(to->page, name));
    TRY(fracas_page_drew(to->page, name));
    fprintf(to->page->out, "<figure id=\"%s\">\n", name);
    TRY(fracas_broken_surface_draw(surface, time, &picture, to->page->out));
    fputs("<figcaption>", to->page->out);
    fracas_page_links(to->page, name, true, false);
    fputs("</figcaption>\n</figure>\n", to->page->out);
    picture.standalone = true;
    picture.width = FRACAS_SURFACE_WIDTH;
    return fracas_broken_surface_save(surface, time, &picture, to->page->folder, file);
}

/* "; first crack through the width: 27.1 us" and the like, the latter over both pairs of borders of
 * a flat surface. */
static fracas_err write_caption(const fracas_broken_surface *surface, int64_t replica, bool broken,
                                char *text, size_t size)
{
    static const char *const what[] = {"first onset", "first break",
                                       "first crack through the width"};
    fracas_surface_times times;
    TRY(fracas_surface_times_of(&surface->mesh, &surface->record, &times));
    const double at[] = {times.onset, times.broken, fmin(times.through[0], times.through[1])};
    const bool flat = fracas_surface_is_flat(&surface->mesh);
    snprintf(text, size, "Replica %lld, %s, each time after as many breaks, the last at the end",
             (long long)replica,
             broken ? "the first that ended FRAGMENTED"
                    : "of typical dissipated energy, for none ended FRAGMENTED");
    for (int k = 0; k < (flat && !surface->strip ? 3 : 2); k++)
        fracas_append(text, size, "; ", "%s: %s", what[k], fracas_surface_time(at[k], true).text);
    fracas_append(text, size, ".", "%s", flat ? "" : " Seen from the direction (1, 1, 1)");
    if (explode_of(&surface->mesh) > 0)
        fracas_append(
            text, size, ", ",
            "each fragment moved by %g of the way from the centroid of the surface to its own",
            apart);
    fracas_append(text, size, "", flat ? "" : ".");
    return FRACAS_OK;
}

/* Data behind all pictures of a point: an interface a line. */
static void write_interfaces(const fracas_broken_surface *surface, FILE *out)
{
    fputs("interface,x1,y1,z1,x2,y2,z2,onset_time,break_time\n", out);
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        fprintf(out, "%zu", i);
        for (int end = 0; end < 2; end++)
            for (int axis = 0; axis < 3; axis++)
                fracas_csv_real(
                    surface->mesh.node[surface->mesh.interface[i].node[end]].position[axis], out);
        fracas_csv_real(surface->record.interface[i].onset_time, out);
        fracas_csv_real(surface->record.interface[i].break_time, out);
        putc('\n', out);
    }
}

/* "film-point-3.html", a page of its own; "" where the report's films are too large with it, and
 * `few` says how many times fit a page, where they are fewer than usual. */
static fracas_err put_film(gallery *to, size_t p, size_t row, const char *title, char name[64],
                           char few[32])
{
    FRACAS_CLEARED(fracas_flight) flight = {.corners = 0};
    double time[FRACAS_FRAMES];
    snprintf(name, 64, FRACAS_FILM_OF_POINT "%zu.html", p);
    TRY(fracas_foreign_aside(to->page->foreign, to->page->folder, name));
    TRY(fracas_flight_read(to->page->analysis->results, p, row, &flight));
    const double bytes = fracas_flight_film_bytes(&flight, FRACAS_FRAMES);
    if (to->filmed + bytes > most_filmed) {
        OWNED char *older = NULL;
        TRY(fracas_path(&older, "%s/%s", to->page->folder, name));
        unlink(older);
        if (fracas_flight_film_most(&flight) < FRACAS_FRAMES)
            snprintf(few, 32, " --times %zu", fracas_flight_film_most(&flight));
        *name = 0;
        return FRACAS_OK;
    }
    to->filmed += bytes;
    TRY(fracas_flight_moments(&flight, time, FRACAS_FRAMES));
    return fracas_flight_film(&flight, time, FRACAS_FRAMES, to->page->folder, name, title);
}

static fracas_err put_row(gallery *to, const fracas_broken_surface *surface, size_t p, size_t row,
                          int64_t replica, bool broken)
{
    char name[64], title[256], caption[640], file[80], film[64], few[32] = "";
    double time[FRACAS_MOMENTS];
    size_t count = FRACAS_MOMENTS;
    TRY(fracas_surface_moments(&surface->record, time, &count));
    const fracas_label label = fracas_analysis_label(to->page->analysis, p);
    FRACAS_PRINT(name, "surface-point-%zu", p);
    FRACAS_PRINT(file, "%s.csv", name);
    FRACAS_PRINT(title, "Broken %s%s%.159s", body_of(surface), *label.text ? ", " : "", label.text);
    TRY(write_caption(surface, replica, broken, caption, sizeof caption));
    TRY(put_film(to, p, row, title, film, few));
    fracas_page_figure(to->page, name, "row");
    fputs("<div class=\"small pictures\">\n", to->page->out);
    for (size_t k = 0; k < count; k++) TRY(put_moment(to, surface, p, k + 1, time[k]));
    fputs("</div>\n", to->page->out);
    if (*film)
        fprintf(to->page->out, "<p class=\"film\"><a href=\"%s\">Film of its motion</a></p>\n",
                film);
    else
        fprintf(to->page->out,
                "<p class=\"film\">Film: <code>fracas picture STUDY --film --point %zu --replica "
                "%lld%s</code></p>\n",
                p, (long long)replica, few);
    fracas_page_figure_end(to->page, title, caption, name, false, true);
    to->drawn += count * weight_of(&surface->mesh);
    fracas_output_file output;
    TRY(fracas_page_make_room(to->page, name));
    TRY(fracas_output_open(to->page->folder, file, &output));
    write_interfaces(surface, output.file);
    return fracas_output_close(&output, FRACAS_OK);
}

static fracas_err put_point(gallery *to, size_t p)
{
    const fracas_point_statistics *statistics = &to->page->analysis->point[p];
    const bool broken = statistics->broken_replica >= 0;
    const int64_t replica = broken ? statistics->broken_replica : statistics->typical_replica;
    bool kept;
    TRY(fracas_broken_surface_kept(to->page->analysis->results, p, &kept));
    if (!kept || replica < 0) return FRACAS_OK;
    if (to->drawn > most_elements) {
        fprintf(to->page->out, "<p>Point %zu: <code>fracas picture STUDY --point %zu</code></p>\n",
                p, p);
        return FRACAS_OK;
    }
    FRACAS_CLEARED(fracas_broken_surface) surface = {.thickness = 0};
    const size_t row = broken ? statistics->broken_row : statistics->typical_row;
    TRY(fracas_broken_surface_read(to->page->analysis->results, p, row, &surface));
    return put_row(to, &surface, p, row, replica, broken);
}

/* Meshes come with study.h5. */
static void say_later(const fracas_page *page)
{
    const fracas_analysis *analysis = page->analysis;
    if (!fracas_results_partial(analysis->results) || !analysis->header.interfaces ||
        !fracas_analysis_any_surface(analysis))
        return;
    fputs("<p>Crack pictures come with the complete study: its meshes are in study.h5, which "
          "<code>fracas run</code> writes at the end.</p>\n",
          page->out);
}

fracas_err fracas_section_surfaces(fracas_page *page)
{
    const size_t npoints = page->analysis->table->npoints;
    bool any = false;
    gallery to = {page, 0, 0};
    for (size_t p = 0; p < npoints && !any; p++)
        TRY(fracas_broken_surface_kept(page->analysis->results, p, &any));
    say_later(page);
    if (!any) return FRACAS_OK;
    fputs("<p>One realization of each point, the first that ended FRAGMENTED, as it was before any "
          "motion; a bar with periodic ends is a circle. Strong lines: broken interfaces; faint "
          "ones: cracked, not yet broken. Fragments have tints by which neighbours differ; orange: "
          "dust, of one element (surfaces: or two). Others: <code>fracas picture STUDY</code>; "
          "computed again, with its stresses: <code>fracas replay STUDY POINT/REPLICA --film "
          "FILE.html</code>.</p>\n",
          page->out);
    for (size_t p = 0; p < npoints; p++)
        if (fracas_analysis_draws(page->analysis, p)) TRY(put_point(&to, p));
    return FRACAS_OK;
}
