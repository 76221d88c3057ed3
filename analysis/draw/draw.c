/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts as SVG. */
#include "analysis/draw/chart.h"

#include "analysis/draw/scale.h"
#include "analysis/data/format.h"

#include <math.h>

enum { BOX = 8 }; /* half the width of a box */
enum { RIGHT = 24, LINE_HEIGHT = 21, SWATCH = 30, GAP = 14, TICK = 4 }; /* pixels */
enum { LEGEND_MOST = 12 }; /* further series are counted, not named */
enum { COLOURS = FRACAS_CHART_COLOURS, DASHES = 5, SHAPES = 4 };

static const double character = 8.6; /* width of a mean character of 15 px sans serif */

/* ---- where things are ---- */

typedef struct {
    fracas_panel panel; /* with the axes of this drawing; its series are the chart's */
    size_t number;
    bool page; /* on a page, for its script */
    FILE *out;
    fracas_scale x, y;
    double top;   /* width of the legend */
    double width; /* for the chart */
    fracas_tick xtick[FRACAS_MAX_TICKS], ytick[FRACAS_MAX_TICKS];
    size_t nxtick, nytick;
} frame;

static size_t characters(const char *text)
{
    size_t count = 0;
    for (; *text; text++)
        if (((unsigned char)*text & 0xC0) != 0x80) count++; /* UTF-8: not a continuation byte */
    return count;
}

static bool shown(double value, const fracas_axis *axis)
{
    return isfinite(value) && (!axis->log || value > 0);
}

/* From 1/2 to n + 1/2, with a tick a name. */
static void fit_names(frame *f)
{
    f->x = (fracas_scale){.low = 0.5, .high = (double)f->panel.x.nnames + 0.5};
    f->nxtick = 0;
    for (size_t i = 0; i < f->panel.x.nnames && i < FRACAS_MAX_TICKS; i++) {
        fracas_tick *tick = &f->xtick[f->nxtick++];
        tick->value = (double)i + 1;
        FRACAS_PRINT(tick->label, "%s", f->panel.x.name[i]);
    }
}

static void fit(frame *f)
{
    double x[2], y[2];
    fracas_panel_extent(&f->panel, x, y);
    if (x[0] > x[1]) x[0] = x[1] = 1; /* nothing to show: axes about one */
    if (y[0] > y[1]) y[0] = y[1] = 1;
    if (f->panel.x.nnames > 0) fit_names(f);
    else fracas_scale_fit(&f->x, f->panel.x.log, x[0], x[1]);
    fracas_scale_fit(&f->y, f->panel.y.log, y[0], y[1]);
    f->y.from = f->panel.height; /* ticks depend on the room they have; their places come later */
    f->x.to = f->width;
    if (f->panel.x.nnames == 0) f->nxtick = fracas_scale_ticks(&f->x, f->xtick);
    f->nytick = fracas_scale_ticks(&f->y, f->ytick);
}

/* ---- drawing ---- */

static void draw_axes(const frame *f, double bottom)
{
    for (size_t i = 0; i < f->nxtick; i++) {
        double x = fracas_scale_place(&f->x, f->xtick[i].value);
        bool major = *f->xtick[i].label;
        if (major)
            fprintf(f->out, "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>\n", x, f->y.to, bottom);
        fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fv%d\"/>\n", x, bottom,
                major ? TICK : TICK / 2);
        if (!major) continue;
        fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", x, bottom + 20);
        fracas_markup(f->out, "%s</text>\n", f->xtick[i].label);
    }
    for (size_t i = 0; i < f->nytick; i++) {
        double y = fracas_scale_place(&f->y, f->ytick[i].value);
        bool major = *f->ytick[i].label;
        if (major)
            fprintf(f->out, "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>\n", f->x.from, y,
                    f->x.to);
        fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fh%d\"/>\n", f->x.from, y,
                major ? -TICK : -TICK / 2);
        if (major)
            fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n",
                    f->x.from - 7, y + 5.2, f->ytick[i].label);
    }
    fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fV%.1fH%.1f\"/>\n", f->x.from, f->y.to,
            bottom, f->x.to);
    if (*f->panel.x.label) {
        fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">",
                (f->x.from + f->x.to) / 2, bottom + 43);
        fracas_markup(f->out, "%s</text>\n", f->panel.x.label);
    }
    fprintf(f->out, "<text transform=\"translate(16 %.1f) rotate(-90)\" text-anchor=\"middle\">",
            (f->y.from + f->y.to) / 2);
    fracas_markup(f->out, "%s</text>\n", f->panel.y.label);
}

static void draw_mark(unsigned look, double x, double y, FILE *out)
{
    static const char *const shape[SHAPES] = {
        "m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z", /* disc */
        "m-4.5 -4.5h9v9h-9z",                    /* square */
        "m0 -6l6 6l-6 6l-6 -6z",                 /* diamond */
        "m0 -5.5l5.5 9.5h-11z",                  /* triangle */
    };
    fprintf(out, "M%.1f %.1f%s", x, y, shape[look % SHAPES]);
}

#define LINE_START "<path class=\"line\" stroke-dasharray=\"%s\" d=\""

static const char *dash_of(unsigned look)
{
    static const char *const dash[DASHES] = {"none", "7 3", "2 3", "9 3 2 3", "4 2"};
    return dash[look % DASHES];
}

static void draw_title(const frame *f, const fracas_series *series, size_t i)
{
    char x[32], y[32];
    const char *name = fracas_axis_name(&f->panel.x, series->x[i]);
    if (name) FRACAS_PRINT(x, "%s", name);
    else fracas_format_digits(series->x[i], 4, x, sizeof x);
    fracas_format_digits(series->y[i], 4, y, sizeof y);
    fracas_markup(f->out, "<title>%s", series->name);
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

static void draw_marks(const frame *f, const fracas_series *series)
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
        draw_mark(series->look, x, y, f->out);
        fputs("\">", f->out);
        draw_title(f, series, i);
        fputs("</path>\n", f->out);
    }
}

/* Vertices closer than half a pixel to the one before are left out, except the last. */
static void draw_line(const frame *f, const fracas_series *series)
{
    bool begun = false;
    double last_x = 0, last_y = 0;
    for (size_t i = 0; i < series->n; i++) {
        if (!fracas_panel_shows(&f->panel, series, i)) continue;
        double x = fracas_scale_place(&f->x, series->x[i]),
               y = fracas_scale_place(&f->y, series->y[i]);
        bool near = begun && fabs(x - last_x) < 0.5 && fabs(y - last_y) < 0.5;
        if (near && i + 1 < series->n) continue;
        if (!begun) fprintf(f->out, LINE_START "M%.1f %.1f", dash_of(series->look), x, y);
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
static void draw_area(const frame *f, const fracas_series *series, size_t begin, size_t end)
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

static void draw_band(const frame *f, const fracas_series *series)
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

static void draw_boxes(const frame *f, const fracas_series *series)
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

static bool in_legend(const fracas_series *series)
{
    return *series->name && !series->open;
}

/* The series whose legend entry shows and hides series s: itself, or an entry of the same look. */
static size_t named_for(const fracas_panel *panel, size_t s)
{
    if (in_legend(&panel->series[s])) return s;
    for (size_t other = 0; other < panel->nseries; other++)
        if (in_legend(&panel->series[other]) && panel->series[other].look == panel->series[s].look)
            return other;
    return s;
}

static void open_group(const frame *f, const char *class, size_t s)
{
    const unsigned look = f->panel.series[s].look;
    if (look >= FRACAS_CHART_GREY) fprintf(f->out, "<g class=\"%s cg\"", class);
    else fprintf(f->out, "<g class=\"%s c%u\"", class, look % COLOURS);
    if (f->page) fprintf(f->out, " data-key=\"%zu.%zu\"", f->number, named_for(&f->panel, s));
    fputs(">\n", f->out);
}

static void draw_series(const frame *f, size_t s)
{
    const fracas_series *series = &f->panel.series[s];
    open_group(f, "series", s);
    if (series->kind == FRACAS_MARKS) draw_marks(f, series);
    else if (series->kind == FRACAS_BAND) draw_band(f, series);
    else if (series->kind == FRACAS_BOXES) draw_boxes(f, series);
    else draw_line(f, series);
    fputs("</g>\n", f->out);
}

static void draw_entry(const frame *f, size_t s, double x, double y, double width)
{
    const fracas_series *series = &f->panel.series[s];
    open_group(f, "entry", s);
    if (f->page)
        fprintf(f->out,
                "<rect class=\"hit\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%d\" rx=\"3\"/>",
                x - 3, y - LINE_HEIGHT / 2.0, width - GAP + 6, LINE_HEIGHT);
    if (series->kind == FRACAS_BAND || series->kind == FRACAS_BOXES)
        fprintf(f->out, "<path class=\"area\" d=\"M%.1f %.1fh24v10h-24z\"/>", x, y - 5);
    if (series->kind == FRACAS_MARKS) {
        fputs("<path class=\"key\" fill=\"currentColor\" d=\"", f->out);
        draw_mark(series->look, x + 12, y, f->out);
        fputs("\"/>", f->out);
    } else if (series->kind != FRACAS_BOXES) {
        fprintf(f->out, LINE_START "M%.1f %.1fh24\"/>", dash_of(series->look), x, y);
    }
    const double room = f->width - x - SWATCH, wide = width - SWATCH - GAP; /* a long one shrinks */
    fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\"", x + SWATCH, y + 5.2);
    if (wide > room) fprintf(f->out, " style=\"font-size:%.1fpx\"", fmax(8, 15 * room / wide));
    fracas_markup(f->out, ">%s</text></g>\n", series->name);
}

/* The series in the order of their entries: marks, then lines. Returns how many have a name. */
static size_t legend_order(const fracas_panel *panel, size_t order[LEGEND_MOST])
{
    size_t named = 0;
    for (int lines = 0; lines < 2; lines++) {
        for (size_t s = 0; s < panel->nseries; s++) {
            if (!in_legend(&panel->series[s]) || (panel->series[s].kind != FRACAS_MARKS) != lines)
                continue;
            if (named < LEGEND_MOST) order[named] = s;
            named++;
        }
    }
    return named;
}

/* Entries left to right, broken into lines; returns the height used. Draws nothing if `draw` is
 * false. */
static double legend(const frame *f, bool draw)
{
    size_t order[LEGEND_MOST], named = legend_order(&f->panel, order);
    double x = f->x.from, y = f->top + LINE_HEIGHT / 2.0;
    if (named == 0) return 0;
    for (size_t entry = 0; entry < named && entry < LEGEND_MOST; entry++) {
        double width = SWATCH + character * (double)characters(f->panel.series[order[entry]].name) +
                       GAP;
        if (entry > 0 && x + width > f->width) {
            x = f->x.from;
            y += LINE_HEIGHT;
        }
        if (draw) draw_entry(f, order[entry], x, y, width);
        x += width;
    }
    if (named > LEGEND_MOST) {
        char text[32];
        FRACAS_PRINT(text, "and %zu more", named - LEGEND_MOST);
        if (x + character * (double)characters(text) > f->width) {
            x = f->x.from;
            y += LINE_HEIGHT;
        }
        if (draw) fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\">%s</text>\n", x, y + 5.2, text);
    }
    return y + LINE_HEIGHT / 2.0 - f->top;
}

/* ---- the whole ---- */

static fracas_panel panel_of(const fracas_chart *chart, size_t p, fracas_axes axes)
{
    fracas_panel panel = chart->panel[p];
    if (axes != FRACAS_AXES_OWN) panel.x.log = false;
    if (axes == FRACAS_AXES_LINEAR) panel.y.log = false;
    return panel;
}

/* Room for the widest tick label of all panels: their time axes stand above each other. */
static double left_margin(const fracas_chart *chart, fracas_axes axes)
{
    size_t widest = 1;
    for (size_t p = 0; p < chart->npanels; p++) {
        frame f = {.panel = panel_of(chart, p, axes), .width = chart->width};
        fit(&f);
        for (size_t i = 0; i < f.nytick; i++)
            if (characters(f.ytick[i].label) > widest) widest = characters(f.ytick[i].label);
    }
    return 36 + character * (double)widest;
}

/* Places the panel, with scales in `f`, below `top`; returns where it ends. */
static double place(frame *f, double left, double top)
{
    f->top = top;
    fit(f);
    f->x.from = left;
    const char *last = f->nxtick > 0 ? f->xtick[f->nxtick - 1].label
                                     : ""; /* in the middle of which the axis may end */
    f->x.to = f->width - fmax(RIGHT, 4 + character * (double)characters(last) / 2);
    f->y.to = top + legend(f, false) + 8;
    f->y.from = f->y.to + f->panel.height;
    return f->y.from + (*f->panel.x.label ? 53 : 30);
}

void fracas_svg_begin(const char *title, int width, double height, bool standalone, FILE *out)
{
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" viewBox=\"0 0 %d %.0f\"",
            width, height);
    if (standalone) fprintf(out, " width=\"%d\" height=\"%.0f\"", width, height);
    fracas_markup(out, " role=\"img\" aria-label=\"%s\">\n", title);
    if (standalone)
        fprintf(out, "<style>\n%s</style>\n<rect class=\"paper\" width=\"%d\" height=\"%.0f\"/>\n",
                fracas_chart_style, width, height);
}

/* Data for the script of a page, to read values off a drawing: ends of the axes, values and places.
 */
static void put_axis(const frame *f, const char *name, const fracas_scale *scale,
                     const fracas_axis *axis, const char *label)
{
    fprintf(f->out, " data-%s=\"%s %.9g %.9g %.1f %.1f\" data-%s-label=\"", name,
            axis->nnames ? "names"
            : scale->log ? "log"
                         : "linear",
            scale->low, scale->high, scale->from, scale->to, name);
    fracas_markup(f->out, "%s", label);
    putc('"', f->out);
}

/* A panel without a label takes the label of the panel below. */
static const char *x_label(const fracas_chart *chart, size_t p)
{
    while (!*chart->panel[p].x.label && p + 1 < chart->npanels) p++;
    return chart->panel[p].x.label;
}

static void draw_panel(const fracas_chart *chart, const frame *f)
{
    fputs("<g class=\"panel\"", f->out);
    if (f->page) {
        put_axis(f, "x", &f->x, &f->panel.x, x_label(chart, f->number));
        put_axis(f, "y", &f->y, &f->panel.y, f->panel.y.label);
    }
    fputs(">\n", f->out);
    legend(f, true);
    draw_axes(f, f->y.from);
    for (size_t s = 0; s < f->panel.nseries; s++) draw_series(f, s);
    fputs("</g>\n", f->out);
}

static void draw_chart(const fracas_chart *chart, fracas_axes axes, bool page, FILE *out)
{
    double left = left_margin(chart, axes), height = 4, top = 4;
    for (int draw = 0; draw < 2; draw++) {
        if (draw) fracas_svg_begin(chart->title, chart->width, height, !page, out);
        for (size_t p = 0; p < chart->npanels; p++) {
            frame f = {.panel = panel_of(chart, p, axes),
                       .number = p,
                       .page = page,
                       .out = out,
                       .width = chart->width};
            const double end = place(&f, left, draw ? top : height);
            if (draw) draw_panel(chart, &f);
            if (draw) top = end;
            else height = end;
        }
    }
    fputs("</svg>\n", out);
}

void fracas_chart_write(const fracas_chart *chart, bool standalone, FILE *out)
{
    draw_chart(chart, FRACAS_AXES_OWN, !standalone, out);
}

void fracas_chart_write_axes(const fracas_chart *chart, fracas_axes axes, FILE *out)
{
    draw_chart(chart, axes, true, out);
}
