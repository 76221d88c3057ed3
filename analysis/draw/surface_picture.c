/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/surface_picture.h"

#include "analysis/data/format.h"
#include "analysis/draw/chart.h"
#include "analysis/draw/facets.h"
#include "analysis/draw/scale.h"
#include "base/own.h"

#include <math.h>

enum { MARGIN = FRACAS_FRAME_MARGIN, LINE_HEIGHT = 19, BAR_ROOM = 26, AXIS = 18 }; /* pixels */

fracas_number_text fracas_surface_time(double time, bool unicode)
{
    return isfinite(time) ? fracas_with_unit(time, 4, "s", unicode) : (fracas_number_text){"never"};
}

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

/* Below the drawing: the time, the fragments, and a bar of at most 0.3 of the width. */
static void draw_words(const fracas_surface_state *state, const fracas_surface_picture *picture,
                       const fracas_frame *frame, FILE *out)
{
    const double bar = fracas_scale_nice(0.3 * picture->width / frame->scale * 1e3, false),
                 x = MARGIN, y = frame->height + 2 * MARGIN + LINE_HEIGHT;
    const double to = x + bar * 1e-3 * frame->scale;
    char dust[48] = "", apart[48] = "";
    if (state->ndust > 0) FRACAS_PRINT(dust, " (dust: %zu)", state->ndust);
    if (picture->explode > 0) FRACAS_PRINT(apart, ", fragments apart: %g", picture->explode);
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\">%s: %zu fragment%s%s</text>\n", x, y - 5,
            fracas_surface_time(state->time, true).text, state->nfragments,
            state->nfragments == 1 ? "" : "s", dust);
    fprintf(out, "<path class=\"ink\" d=\"M%.1f %.1fv8m0 -4H%.1fm0 -4v8\"/>\n", x, y + 6, to);
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\">%g mm%s</text>\n", to + 8, y + 14.5, bar, apart);
}

/* Directions of x, y and z, at the lower right; none for an axis parallel to the line of sight. */
static void draw_axes(const fracas_surface_picture *picture, const fracas_frame *frame, FILE *out)
{
    const double x = picture->width - MARGIN - AXIS - 12, y = frame->height + 2 * MARGIN + 22;
    for (int i = 0; i < 3; i++) {
        double axis[3] = {i == 0, i == 1, i == 2}, at[3];
        fracas_view_turn(picture->view, axis, at);
        const double length = hypot(at[0], at[1]), label = AXIS + 7 / length;
        if (!(length > 0.1)) continue;
        fprintf(out, "<path class=\"ink\" d=\"M%.1f %.1fl%.1f %.1f\"/>\n", x, y, AXIS * at[0],
                -AXIS * at[1]);
        fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%c</text>\n",
                x + label * at[0], y - label * at[1] + 4, "xyz"[i]);
    }
}

fracas_err fracas_surface_picture_write(const fracas_stored_mesh *mesh,
                                        const fracas_surface_state *state,
                                        const fracas_surface_picture *picture, FILE *out)
{
    static const fracas_view above = {-90, 90}, corner = FRACAS_VIEW_DEFAULT;
    const bool flat = fracas_surface_is_flat(mesh),
               lies = flat && !picture->view && !(picture->explode > 0);
    fracas_surface_picture of = *picture;
    FRACAS_CLEARED(fracas_facets) facets = {0};
    OWNED uint8_t *tint = NULL;
    fracas_frame frame;
    if (!of.view) of.view = flat ? &above : &corner;
    if (lies) of.thickness = 0;
    TRY(fracas_facets_create(mesh, state, &of, &facets));
    if (!lies) TRY(fracas_facets_hide(&facets));
    if (of.show != FRACAS_SHOW_CRACKS) TRY(fracas_tint_fragments(mesh, state, &tint));
    fracas_frame_fit(facets.least, facets.largest, of.width, &frame);
    fracas_svg_begin(of.title, of.width, frame.height + 2 * MARGIN + LINE_HEIGHT + BAR_ROOM,
                     of.standalone, out);
    if (of.standalone) fprintf(out, "<style>\n%s</style>\n", fracas_surface_style);
    fprintf(out, "<g transform=\"scale(%g)\">\n", 1.0 / FRACAS_FRAME_UNITS);
    TRY(fracas_facets_draw(&facets, &frame, tint, !lies, of.show, out));
    fputs("</g>\n", out);
    draw_words(state, &of, &frame, out);
    if (!lies) draw_axes(&of, &frame, out);
    fputs("</svg>\n", out);
    return FRACAS_OK;
}
