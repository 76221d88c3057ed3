/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/surface_picture.h"

#include "analysis/data/format.h"
#include "analysis/draw/body_picture.h"
#include "analysis/draw/chart.h"
#include "analysis/draw/trail.h"
#include "analysis/draw/facets.h"
#include "base/own.h"

#include <math.h>
#include <stdlib.h>

enum {
    MARGIN = FRACAS_FRAME_MARGIN,
    UNITS = FRACAS_FRAME_UNITS,
    LINE_HEIGHT = 19,
    BAR_ROOM = 26,
    AXIS = 18
}; /* pixels */

/* Tints light enough for broken interfaces to stand out on them. */
static const char style_light[] =
    ".chart .body{fill:#eceff3}.chart .dust-fill{fill:#D55E00}.chart .t0{fill:#cfe0f0}.chart "
    ".t1{fill:#f3dfc8}.chart .t2{fill:#d3ebda}.chart .t3{fill:#ecd9e6}.chart "
    ".t4{fill:#f5eec4}.chart .t5{fill:#cdeaed}.chart .t6{fill:#ddd9f0}\n"
    ".chart .mesh,.chart .cracked,.chart .broken,.chart "
    ".outline{fill:none;stroke-linejoin:round;stroke-linecap:round}\n"
    ".chart .mesh{stroke:#fff}.chart .cracked{stroke:#a9b3bf}.chart .broken{stroke:#1b1f24}.chart "
    ".outline{stroke:#57606a;stroke-width:10}\n";
static const char style_dark[] =
    "@media screen and (prefers-color-scheme:dark){.chart .body{fill:#262d35}.chart "
    ".dust-fill{fill:#ee7c2b}.chart .t0{fill:#1f4263}.chart .t1{fill:#5c3f22}.chart "
    ".t2{fill:#1f5038}.chart .t3{fill:#55304c}.chart .t4{fill:#56501f}.chart "
    ".t5{fill:#175058}.chart .t6{fill:#403a72}.chart .mesh{stroke:#14181d}.chart "
    ".cracked{stroke:#6d7884}.chart .broken{stroke:#f0f3f6}.chart .outline{stroke:#9aa4af}}\n";

void fracas_surface_style(FILE *out)
{
    fprintf(out, "%s%s", style_light, style_dark);
}

fracas_number_text fracas_surface_time(double time, bool unicode)
{
    return isfinite(time) ? fracas_with_unit(time, 4, "s", unicode) : (fracas_number_text){"never"};
}

typedef struct {
    const fracas_stored_mesh *mesh;
    const fracas_surface_state *state;
    const fracas_surface_picture *picture;
    FILE *out;
    fracas_frame frame;
    fracas_spot *spot; /* for each node */
    uint8_t *tint;     /* for each fragment */
    double line;       /* width of a broken interface, units */
} canvas;

/* ---- where things are ---- */

bool fracas_surface_is_flat(const fracas_stored_mesh *mesh)
{
    double least = INFINITY, largest = -INFINITY, reach = 0;
    for (size_t n = 0; n < mesh->nnodes; n++) {
        const double *at = mesh->node[n].position;
        least = fmin(least, at[2]);
        largest = fmax(largest, at[2]);
        reach = fmax(reach, fmax(fabs(at[0]), fabs(at[1])));
    }
    return largest - least <= 1e-9 * reach;
}

static fracas_err place_nodes(canvas *on)
{
    const fracas_stored_mesh *mesh = on->mesh;
    double least[2] = {INFINITY, INFINITY}, largest[2] = {-INFINITY, -INFINITY};
    on->spot = calloc(mesh->nnodes + 1, sizeof *on->spot);
    if (!on->spot) return fracas_no_memory("a picture");
    for (size_t n = 0; n < mesh->nnodes; n++) {
        const double *at = mesh->node[n].position;
        for (int i = 0; i < 2; i++)
            least[i] = fmin(least[i], at[i]), largest[i] = fmax(largest[i], at[i]);
    }
    fracas_frame_fit(least, largest, on->picture->width, &on->frame);
    for (size_t n = 0; n < mesh->nnodes; n++)
        on->spot[n] = fracas_frame_place(&on->frame, mesh->node[n].position);
    return FRACAS_OK;
}

/* A fifth of a mean edge, to show small elements and not only lines; between 0.4 and 1.2 pixels. */
static double line_width(const canvas *on)
{
    double sum = 0;
    for (size_t i = 0; i < on->mesh->ninterfaces; i++) {
        const int64_t *node = on->mesh->interface[i].node;
        sum += hypot(on->spot[node[1]].x - on->spot[node[0]].x,
                     on->spot[node[1]].y - on->spot[node[0]].y);
    }
    return fmin(fmax(0.2 * sum / (double)on->mesh->ninterfaces, 0.4 * UNITS), 1.2 * UNITS);
}

/* ---- lines ---- */

/* Interfaces in one state; the width is relative to the line of a broken one. */
static fracas_err draw_interfaces(const canvas *on, fracas_interface_state state, const char *class,
                                  double width)
{
    FRACAS_CLEARED(fracas_trail) trail = {0};
    for (size_t i = 0; i < on->mesh->ninterfaces; i++)
        if (on->state->interface[i] == state)
            TRY(fracas_trail_add(&trail, on->mesh->interface[i].node, false));
    fprintf(on->out, "<g stroke-width=\"%.1f\">\n", width * on->line);
    TRY(fracas_trail_write(&trail, on->spot, false, class, on->out));
    fputs("</g>\n", on->out);
    return FRACAS_OK;
}

static fracas_err draw_outline(const canvas *on)
{
    FRACAS_CLEARED(fracas_trail) trail = {0};
    for (size_t b = 0; b < on->mesh->nborders; b++)
        TRY(fracas_trail_add(&trail, on->mesh->border[b].node, false));
    return fracas_trail_write(&trail, on->spot, false, "outline", on->out);
}

/* ---- areas ---- */

/* The tint of an element; with cracks alone they are all of one body. */
static int tint_of(const canvas *on, int64_t element)
{
    return on->tint ? on->tint[on->state->fragment[element]] : 0;
}

/* Fills the fragments of this tint. Their boundary is traversed with the inside to the left; an
 * edge between two of them would be traversed both ways, and is no boundary. */
static fracas_err fill(const canvas *on, int tint, const char *class)
{
    FRACAS_CLEARED(fracas_trail) trail = {0};
    for (size_t i = 0; i < on->mesh->ninterfaces; i++) {
        const fracas_stored_interface *interface = &on->mesh->interface[i];
        const int first = tint_of(on, interface->element[0]),
                  second = tint_of(on, interface->element[1]);
        if (first == second || (first != tint && second != tint)) continue;
        TRY(fracas_trail_add(&trail, interface->node, second == tint));
    }
    for (size_t b = 0; b < on->mesh->nborders; b++)
        if (tint_of(on, on->mesh->border[b].element) == tint)
            TRY(fracas_trail_add(&trail, on->mesh->border[b].node, false));
    return fracas_trail_write(&trail, on->spot, true, class, on->out);
}

static fracas_err draw_areas(const canvas *on)
{
    if (!on->tint) return fill(on, 0, "body");
    for (int t = 0; t < FRACAS_TINTS; t++) {
        char class[16];
        FRACAS_PRINT(class, "t%d", t);
        TRY(fill(on, t, class));
    }
    return fill(on, FRACAS_TINT_DUST, "dust-fill");
}

/* ---- words ---- */

/* The largest 1, 2 or 5 times a power of ten [mm] below 0.3 of the width. */
static double scale_bar(const canvas *on)
{
    const double most = 0.3 * on->picture->width / on->frame.scale * 1e3,
                 power = pow(10, floor(log10(most) + 1e-9));
    const double mantissa = most / power * (1 + 1e-9);
    return power * (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
}

static void draw_words(const canvas *on)
{
    const fracas_surface_state *state = on->state;
    const double bar = scale_bar(on), x = MARGIN, y = on->frame.height + 2 * MARGIN + LINE_HEIGHT;
    const double to = x + bar * 1e-3 * on->frame.scale;
    char dust[48] = "", apart[48] = "";
    if (state->ndust > 0) FRACAS_PRINT(dust, " (dust: %zu)", state->ndust);
    if (on->picture->explode > 0)
        FRACAS_PRINT(apart, ", fragments apart: %g", on->picture->explode);
    fprintf(on->out, "<text x=\"%.1f\" y=\"%.1f\">%s: %zu fragment%s%s</text>\n", x, y - 5,
            fracas_surface_time(state->time, true).text, state->nfragments,
            state->nfragments == 1 ? "" : "s", dust);
    fprintf(on->out, "<path class=\"ink\" d=\"M%.1f %.1fv8m0 -4H%.1fm0 -4v8\"/>\n", x, y + 6, to);
    fprintf(on->out, "<text x=\"%.1f\" y=\"%.1f\">%g mm%s</text>\n", to + 8, y + 14.5, bar, apart);
}

/* Directions of x, y and z, at the lower right; none for an axis parallel to the line of sight. */
static void draw_axes(const canvas *on, const fracas_view *view)
{
    const double x = on->picture->width - MARGIN - AXIS - 12,
                 y = on->frame.height + 2 * MARGIN + 22;
    for (int i = 0; i < 3; i++) {
        double axis[3] = {i == 0, i == 1, i == 2}, at[3];
        fracas_view_turn(view, axis, at);
        const double length = hypot(at[0], at[1]), label = AXIS + 7 / length;
        if (!(length > 0.1)) continue;
        fprintf(on->out, "<path class=\"ink\" d=\"M%.1f %.1fl%.1f %.1f\"/>\n", x, y, AXIS * at[0],
                -AXIS * at[1]);
        fprintf(on->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%c</text>\n",
                x + label * at[0], y - label * at[1] + 4, "xyz"[i]);
    }
}

/* ---- pictures ---- */

static fracas_err draw_flat(const canvas *on)
{
    TRY(draw_areas(on));
    if (on->picture->show == FRACAS_SHOW_MESH)
        TRY(draw_interfaces(on, FRACAS_INTERFACE_CLOSED, "mesh", 0.5));
    TRY(draw_interfaces(on, FRACAS_INTERFACE_CRACKED, "cracked", 0.9));
    TRY(draw_interfaces(on, FRACAS_INTERFACE_BROKEN, "broken", 1.0));
    return draw_outline(on);
}

/* body: NULL where the surface is drawn as a flat one. */
static fracas_err draw_picture(canvas *on, const fracas_body_picture *body, const fracas_view *view)
{
    const fracas_surface_picture *picture = on->picture;
    if (picture->show != FRACAS_SHOW_CRACKS)
        TRY(fracas_tint_fragments(on->mesh, on->state, &on->tint));
    fracas_svg_begin(picture->title, picture->width,
                     on->frame.height + 2 * MARGIN + LINE_HEIGHT + BAR_ROOM, picture->standalone,
                     on->out);
    if (picture->standalone) fprintf(on->out, "<style>\n%s</style>\n", style_light);
    fprintf(on->out, "<g transform=\"scale(%g)\">\n", 1.0 / UNITS);
    TRY(body ? fracas_body_picture_draw(body, on->tint, picture->show, on->out) : draw_flat(on));
    fputs("</g>\n", on->out);
    draw_words(on);
    if (body) draw_axes(on, view);
    fputs("</svg>\n", on->out);
    return FRACAS_OK;
}

fracas_err fracas_surface_picture_write(const fracas_stored_mesh *mesh,
                                        const fracas_surface_state *state,
                                        const fracas_surface_picture *picture, FILE *out)
{
    static const fracas_view above = {-90, 90}, corner = FRACAS_VIEW_DEFAULT;
    const bool flat = fracas_surface_is_flat(mesh);
    const fracas_view *view = picture->view ? picture->view : flat ? &above : &corner;
    canvas on = {.mesh = mesh, .state = state, .picture = picture, .out = out};
    fracas_body_picture body = {0};
    fracas_err err;
    if (flat && !picture->view && !(picture->explode > 0)) {
        err = place_nodes(&on);
        if (!err) on.line = line_width(&on);
        if (!err) err = draw_picture(&on, NULL, NULL);
    } else {
        err = fracas_body_picture_create(mesh, state, picture, view, &body);
        on.frame = body.frame;
        if (!err) err = draw_picture(&on, &body, view);
    }
    fracas_body_picture_clear(&body);
    free(on.spot);
    free(on.tint);
    return err;
}
