#include "analysis/report/picture/surfaces.h"

#include "analysis/report/chart.h"
#include "analysis/export/output.h"

#include <math.h>

static const size_t most_elements = 1500000; /* drawn on a page, some 20 MB of it */
static const double apart = 0.1;             /* fragments of surfaces in space on a page */
static const size_t most_apart = 50000;      /* elements of a mesh; of larger ones the gaps are not worth the room they take */

fracas_err fracas_broken_surface_read(fracas_results *results, size_t point, size_t row, fracas_broken_surface *surface)
{
    size_t of;
    int64_t replica;
    *surface = (fracas_broken_surface){0};
    fracas_record_init(&surface->record);
    const double thickness = fracas_columns_real(fracas_results_points(results), point, "geometry.thickness");
    if (thickness > 0) surface->thickness = thickness;
    TRY(fracas_results_mesh(results, point, &surface->mesh));
    return fracas_results_record(results, row, FRACAS_READ_INTERFACES, &of, &replica, &surface->record);
}

void fracas_broken_surface_clear(fracas_broken_surface *surface)
{
    fracas_stored_mesh_clear(&surface->mesh);
    fracas_record_clear(&surface->record);
}

static fracas_err write_picture(const fracas_broken_surface *surface, double time, const fracas_surface_picture *picture,
                                FILE *out)
{
    fracas_surface_state state;
    fracas_err err = fracas_surface_state_create(&surface->mesh, &surface->record, time, &state);
    if (!err) err = fracas_surface_picture_write(&surface->mesh, &state, picture, out);
    fracas_surface_state_clear(&state);
    return err;
}

fracas_err fracas_broken_surface_save(const fracas_broken_surface *surface, double time, const fracas_surface_picture *picture,
                                      const char *folder, const char *name)
{
    fracas_output_file output;
    TRY(fracas_output_open(folder, name, &output));
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", output.file);
    return fracas_output_close(&output, write_picture(surface, time, picture, output.file));
}

/* ---- the page ---- */

static fracas_err has_mesh(const fracas_analysis *analysis, size_t point, bool *has)
{
    size_t interfaces;
    TRY(fracas_results_mesh_interfaces(analysis->results, point, &interfaces));
    *has = interfaces > 0;
    return FRACAS_OK;
}

fracas_err fracas_surfaces_any(const fracas_analysis *analysis, bool *any)
{
    *any = false;
    for (size_t p = 0; p < analysis->table->npoints && !*any; p++) TRY(has_mesh(analysis, p, any));
    return FRACAS_OK;
}

typedef struct {
    const fracas_analysis *analysis;
    const char *folder;
    FILE *out;
    size_t drawn; /* elements so far; a gap takes twice the room of an element */
} gallery;

static double explode_of(const fracas_stored_mesh *mesh)
{
    return fracas_surface_is_flat(mesh) || mesh->nelements > most_apart ? 0 : apart;
}

static fracas_err put_moment(const gallery *to, const fracas_broken_surface *surface, size_t p, size_t k, double time)
{
    char label[160], title[256], moment[48], name[64], file[80];
    fracas_surface_time_text(time, true, moment, sizeof moment);
    fracas_analysis_label(to->analysis, p, label, sizeof label);
    snprintf(title, sizeof title, "Broken surface at %s%s%s", moment, *label ? ": " : "", label);
    snprintf(name, sizeof name, "surface-point-%zu-%zu", p, k + 1);
    snprintf(file, sizeof file, "%s.svg", name);
    fracas_surface_picture picture = {.title = title, .show = FRACAS_SHOW_FRAGMENTS, .width = FRACAS_CHART_NARROW,
                                      .explode = explode_of(&surface->mesh), .thickness = surface->thickness};
    fprintf(to->out, "<figure id=\"%s\">\n", name);
    TRY(write_picture(surface, time, &picture, to->out));
    fprintf(to->out, "<figcaption><a href=\"%s\">SVG</a></figcaption>\n</figure>\n", file);
    picture.standalone = true;
    picture.width = FRACAS_SURFACE_WIDTH;
    return fracas_broken_surface_save(surface, time, &picture, to->folder, file);
}

/* "; first crack through the width: 27.1 us" and the like, that one over both pairs of borders of a flat surface. */
static fracas_err put_times(const gallery *to, const fracas_broken_surface *surface)
{
    static const char *const what[] = {"first onset", "first break", "first crack through the width"};
    fracas_surface_times times;
    TRY(fracas_surface_times_of(&surface->mesh, &surface->record, &times));
    const double at[] = {times.onset, times.broken, fmin(times.through[0], times.through[1])};
    const bool flat = fracas_surface_is_flat(&surface->mesh);
    for (int k = 0; k < (flat ? 3 : 2); k++) {
        char text[48];
        fracas_surface_time_text(at[k], true, text, sizeof text);
        fprintf(to->out, "; %s: %s", what[k], text);
    }
    putc('.', to->out);
    if (!flat) fputs(" Seen from the direction (1, 1, 1)", to->out);
    if (explode_of(&surface->mesh) > 0)
        fprintf(to->out, ", each fragment moved by %g of the way from the centroid of the surface to its own", apart);
    fputs(flat ? "</p>\n" : ".</p>\n", to->out);
    return FRACAS_OK;
}

static fracas_err put_row(gallery *to, const fracas_broken_surface *surface, size_t p, int64_t replica)
{
    char label[160];
    double time[FRACAS_MOMENTS];
    const size_t count = fracas_surface_moments(&surface->record, FRACAS_MOMENTS, time);
    fracas_analysis_label(to->analysis, p, label, sizeof label);
    fputs("<p class=\"quiet\">", to->out);
    fracas_markup_text(label, to->out);
    fprintf(to->out, "%sreplica %lld", *label ? ": " : "", (long long)replica);
    TRY(put_times(to, surface));
    fputs("<div class=\"small\">\n", to->out);
    for (size_t k = 0; k < count; k++) TRY(put_moment(to, surface, p, k, time[k]));
    fputs("</div>\n", to->out);
    to->drawn += (explode_of(&surface->mesh) > 0 ? 3 : 1) * count * surface->mesh.nelements;
    return FRACAS_OK;
}

static fracas_err put_point(gallery *to, size_t p)
{
    const fracas_point_statistics *statistics = &to->analysis->point[p];
    const bool broken = statistics->broken_replica >= 0;
    const int64_t replica = broken ? statistics->broken_replica : statistics->typical_replica;
    bool has;
    TRY(has_mesh(to->analysis, p, &has));
    if (!has || replica < 0) return FRACAS_OK;
    if (to->drawn > most_elements) {
        fprintf(to->out, "<p>Point %zu: <code>fracas picture STUDY --point %zu</code></p>\n", p, p);
        return FRACAS_OK;
    }
    fracas_broken_surface surface;
    fracas_err err = fracas_broken_surface_read(to->analysis->results, p,
                                                broken ? statistics->broken_row : statistics->typical_row, &surface);
    if (!err) err = put_row(to, &surface, p, replica);
    fracas_broken_surface_clear(&surface);
    return err;
}

/* Meshes come with study.h5. */
static void say_later(const fracas_analysis *analysis, FILE *page)
{
    if (!fracas_results_partial(analysis->results) || !analysis->header.interfaces || !fracas_analysis_any_surface(analysis)) return;
    fputs("<h2>Broken surfaces</h2>\n<p>Crack pictures come with the complete study: its meshes are in study.h5, which "
          "<code>fracas run</code> writes at the end.</p>\n", page);
}

fracas_err fracas_surfaces_put(const fracas_analysis *analysis, const char *folder, FILE *page)
{
    bool any;
    gallery to = {analysis, folder, page, 0};
    TRY(fracas_surfaces_any(analysis, &any));
    if (!any) {
        say_later(analysis, page);
        return FRACAS_OK;
    }
    fputs("<h2>Broken surfaces</h2>\n<p>One realization of each point, the first that ended FRAGMENTED, at even times from the "
          "first onset to the end, drawn as it was before any motion. Strong lines: broken interfaces; faint ones: cracked, not "
          "yet broken. Fragments have tints by which neighbours differ; orange: dust, of one or two elements. Others: "
          "<code>fracas picture STUDY</code>.</p>\n", page);
    for (size_t p = 0; p < analysis->table->npoints; p++) TRY(put_point(&to, p));
    return FRACAS_OK;
}
