/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/frame.h"

#include "analysis/data/format.h"

#include <math.h>

enum { BOX = 8 }; /* half the width of a box */
enum { DASHES = 5, SHAPES = 4 };

static bool shown(double value, const fracas_axis *axis)
{
    return isfinite(value) && (!axis->log || value > 0);
}

void fracas_frame_mark(unsigned look, double x, double y, FILE *out)
{
    static const char *const shape[SHAPES] = {
        "m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z", /* disc */
        "m-4.5 -4.5h9v9h-9z",                    /* square */
        "m0 -6l6 6l-6 6l-6 -6z",                 /* diamond */
        "m0 -5.5l5.5 9.5h-11z",                  /* triangle */
    };
    fprintf(out, "M%.1f %.1f%s", x, y, shape[look % SHAPES]);
}

const char *fracas_frame_dash(unsigned look)
{
    static const char *const dash[DASHES] = {"none", "7 3", "2 3", "9 3 2 3", "4 2"};
    return dash[look % DASHES];
}

static void draw_title(const fracas_frame *f, const fracas_series *series, size_t i)
{
    char x[32], y[32];
    const char *name = fracas_axis_name(&f->panel.x, series->x[i]);
    if (name) FRACAS_PRINT(x, "%s", name);
    else fracas_format_digits(series->x[i], 4, x, sizeof x);
    fracas_format_digits(series->y[i], 4, y, sizeof y);
    fracas_markup(f->out, "<title>%s%s%s", f->panel.title, *f->panel.title ? "; " : "",
                  series->name);
    fprintf(f->out, "%s", *series->name ? "; " : "");
    fracas_markup(f->out, "%s: %s; %s", f->panel.x.label, x, f->panel.y.label);
    fprintf(f->out, ": %s", y);
    if (isfinite(series->low[i])) {
        fracas_format_digits(series->low[i], 4, x, sizeof x);
        fracas_format_digits(series->high[i], 4, y, sizeof y);
        fprintf(f->out, " (%s: %s to %s)", f->panel.bars ? f->panel.bars : "95 %", x, y);
    }
    fputs("</title>", f->out);
}

static void draw_marks(const fracas_frame *f, const fracas_series *series)
{
    for (size_t i = 0; i < series->n; i++) {
        if (!fracas_panel_shows(&f->panel, series, i)) continue;
        double x = fracas_scale_place(&f->x, series->x[i]),
               y = fracas_scale_place(&f->y, series->y[i]);
        if (isfinite(series->low[i]) && isfinite(series->high[i])) {
            bool open = !shown(series->low[i], &f->panel.y);
            double low = open ? f->y.from : fracas_scale_place(&f->y, series->low[i]);
            double high = fracas_scale_place(&f->y, series->high[i]);
            const char *foot = open ? "" : "m-4 0h8m-4 0";
            fprintf(f->out, "<path class=\"bar\" d=\"M%.1f %.1f%sV%.1fm-4 0h8\"/>\n", x, low, foot,
                    high);
        }
        fprintf(f->out, "<path class=\"mark%s\" d=\"", series->open ? " open" : "");
        fracas_frame_mark(series->look, x, y, f->out);
        fputs("\">", f->out);
        draw_title(f, series, i);
        fputs("</path>\n", f->out);
    }
}

/* Vertices closer than half a pixel to the one before are left out, except the last. */
static void draw_line(const fracas_frame *f, const fracas_series *series)
{
    bool begun = false;
    double last_x = 0, last_y = 0;
    for (size_t i = 0; i < series->n; i++) {
        if (!fracas_panel_shows(&f->panel, series, i)) continue;
        double x = fracas_scale_place(&f->x, series->x[i]),
               y = fracas_scale_place(&f->y, series->y[i]);
        bool near = begun && fabs(x - last_x) < 0.5 && fabs(y - last_y) < 0.5;
        if (near && i + 1 < series->n) continue;
        if (!begun)
            fprintf(f->out, FRACAS_LINE_START "M%.1f %.1f", fracas_frame_dash(series->look), x, y);
        else if (series->kind == FRACAS_STEPS) fprintf(f->out, "V%.1fH%.1f", y, x);
        else fprintf(f->out, "L%.1f %.1f", x, y);
        begun = true;
        last_x = x;
        last_y = y;
    }
    if (!begun) return;
    fracas_markup(f->out, "\"><title>%s</title></path>\n", series->name);
}

/* The areas of values begin to end - 1, all with a low and a high: along the lows, and back along
 * the highs. Values below a log axis lie at its foot. */
static void draw_area(const fracas_frame *f, const fracas_series *series, size_t begin, size_t end)
{
    fputs("<path class=\"area\" d=\"", f->out);
    for (size_t k = 0; k < 2 * (end - begin); k++) {
        const size_t i = k < end - begin ? begin + k : end - 1 - (k - (end - begin));
        const double value = k < end - begin ? series->low[i] : series->high[i];
        const double y = shown(value, &f->panel.y) ? fracas_scale_place(&f->y, value) : f->y.from;
        fprintf(f->out, "%c%.1f %.1f", k ? 'L' : 'M', fracas_scale_place(&f->x, series->x[i]),
                fmin(y, f->y.from));
    }
    fputs("z\"/>\n", f->out);
}

static void draw_band(const fracas_frame *f, const fracas_series *series)
{
    for (size_t i = 0, begin = 0; i <= series->n; i++) {
        if (i < series->n && fracas_panel_shows(&f->panel, series, i) && isfinite(series->low[i]) &&
            isfinite(series->high[i]))
            continue;
        if (i > begin) draw_area(f, series, begin, i);
        begin = i + 1;
    }
    draw_line(f, series);
}

static void draw_boxes(const fracas_frame *f, const fracas_series *series)
{
    for (size_t i = 0; i < series->n; i++) {
        if (!fracas_panel_shows(&f->panel, series, i) || !isfinite(series->low[i]) ||
            !isfinite(series->high[i]))
            continue;
        const double top = fracas_scale_place(&f->y, series->high[i]);
        const double bottom = shown(series->low[i], &f->panel.y)
                                  ? fracas_scale_place(&f->y, series->low[i])
                                  : f->y.from;
        fprintf(f->out, "<path class=\"area\" d=\"M%.1f %.1fh%dV%.1fh%dz\"/>\n",
                fracas_scale_place(&f->x, series->x[i]) - BOX, top, 2 * BOX, bottom, -2 * BOX);
    }
}

void fracas_frame_draw(const fracas_frame *f, const fracas_series *series)
{
    if (series->kind == FRACAS_MARKS) draw_marks(f, series);
    else if (series->kind == FRACAS_BAND) draw_band(f, series);
    else if (series->kind == FRACAS_BOXES) draw_boxes(f, series);
    else draw_line(f, series);
}
