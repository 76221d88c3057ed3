#include "analysis/report/chart.h"

#include "analysis/tables/format.h"
#include "analysis/report/scale.h"

#include <math.h>
#include <stdlib.h>

enum { RIGHT = 16, LINE_HEIGHT = 19, SWATCH = 30, GAP = 14, TICK = 4 }; /* pixels */
enum { LEGEND_MOST = 12 }; /* further series are counted, not named */
enum { COLOURS = FRACAS_CHART_COLOURS, DASHES = 5, SHAPES = 4 };

static const double character = 7.6; /* width of a mean character of 13 px sans serif */

static const char style_light[] =
    ".chart text{font:13px system-ui,-apple-system,\"Segoe UI\",\"DejaVu Sans\",Arial,sans-serif;fill:#1b1f24}\n"
    ".chart .grid{stroke:#e3e6ea;stroke-width:1;fill:none}\n"
    ".chart .axis{stroke:#6b7480;stroke-width:1;fill:none}\n"
    ".chart .line{fill:none;stroke:currentColor;stroke-width:1.8;stroke-linejoin:round}\n"
    ".chart .bar{fill:none;stroke:currentColor;stroke-width:1.4}\n"
    ".chart .mark{fill:currentColor;stroke:#fff;stroke-width:.8}\n"
    ".chart .band{fill:currentColor;stroke:#fff;stroke-width:.5}\n"
    ".chart .ink{fill:none;stroke:#1b1f24;stroke-width:1.1;stroke-linejoin:round}.chart .dust{fill:#1b1f24}\n"
    ".chart .paper{fill:#fff}\n"
    ".c0{color:#0072B2}.c1{color:#D55E00}.c2{color:#009E73}.c3{color:#CC79A7}.c4{color:#E69F00}.c5{color:#56B4E9}\n";

static const char style_dark[] =
    "@media screen and (prefers-color-scheme:dark){"
    ".chart text{fill:#e6e9ed}.chart .grid{stroke:#30363d}.chart .axis{stroke:#9aa4af}.chart .mark,"
    ".chart .band{stroke:#14181d}.chart .ink{stroke:#e6e9ed}.chart .dust{fill:#e6e9ed}"
    ".c0{color:#3d9fdb}.c1{color:#ee7c2b}.c2{color:#1cc194}}\n";

void fracas_chart_init(fracas_chart *chart)
{
    *chart = (fracas_chart){.width = FRACAS_CHART_WIDE};
}

void fracas_chart_clear(fracas_chart *chart)
{
    for (size_t p = 0; p < chart->npanels; p++) {
        fracas_panel *panel = &chart->panel[p];
        for (size_t s = 0; s < panel->nseries; s++) {
            free(panel->series[s].x);
            free(panel->series[s].y);
            free(panel->series[s].low);
            free(panel->series[s].high);
        }
        free(panel->series);
    }
    fracas_chart_init(chart);
}

fracas_panel *fracas_chart_add(fracas_chart *chart, double height)
{
    fracas_panel *panel = &chart->panel[chart->npanels++];
    panel->height = height;
    return panel;
}

fracas_err fracas_panel_add(fracas_panel *panel, fracas_series_kind kind, unsigned look, size_t n,
                            fracas_series **series)
{
    if (panel->nseries == panel->capacity) {
        size_t capacity = panel->capacity ? 2 * panel->capacity : 8;
        fracas_series *more = realloc(panel->series, capacity * sizeof *more);
        if (!more) return fracas_no_memory("a figure");
        panel->series = more;
        panel->capacity = capacity;
    }
    fracas_series *made = &panel->series[panel->nseries++];
    *made = (fracas_series){.kind = kind, .look = look, .n = n};
    made->x = calloc(n + 1, sizeof *made->x);
    made->y = calloc(n + 1, sizeof *made->y);
    if (kind == FRACAS_MARKS) {
        made->low = calloc(n + 1, sizeof *made->low);
        made->high = calloc(n + 1, sizeof *made->high);
    }
    if (!made->x || !made->y || (kind == FRACAS_MARKS && (!made->low || !made->high)))
        return fracas_no_memory("a figure");
    *series = made;
    return FRACAS_OK;
}

void fracas_markup_text(const char *text, FILE *out)
{
    for (; *text; text++) {
        switch (*text) {
        case '&': fputs("&amp;", out); break;
        case '<': fputs("&lt;", out); break;
        case '>': fputs("&gt;", out); break;
        case '"': fputs("&quot;", out); break;
        default: putc(*text, out);
        }
    }
}

/* ---- where things are ---- */

typedef struct {
    const fracas_panel *panel;
    FILE *out;
    fracas_scale x, y;
    double top;   /* of the legend */
    double width; /* of the chart */
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

static bool shown(double value, const fracas_axis *axis, double floor_value)
{
    return isfinite(value) && (!axis->log || value > 0) && value >= floor_value;
}

static bool value_shown(const fracas_panel *panel, const fracas_series *series, size_t i)
{
    double floor_value = panel->y_floor > 0 ? panel->y_floor : -INFINITY;
    return shown(series->x[i], &panel->x, -INFINITY) && shown(series->y[i], &panel->y, floor_value);
}

static void widen(double value, const fracas_axis *axis, double *least, double *greatest)
{
    if (!shown(value, axis, -INFINITY)) return;
    if (value < *least) *least = value;
    if (value > *greatest) *greatest = value;
}

/* Scales that hold every shown value and bar. */
static void fit(frame *f)
{
    double x[2] = {INFINITY, -INFINITY}, y[2] = {INFINITY, -INFINITY};
    for (size_t s = 0; s < f->panel->nseries; s++) {
        const fracas_series *series = &f->panel->series[s];
        for (size_t i = 0; i < series->n; i++) {
            widen(series->x[i], &f->panel->x, &x[0], &x[1]); /* of all values: panels share their x axis */
            if (!value_shown(f->panel, series, i)) continue;
            widen(series->y[i], &f->panel->y, &y[0], &y[1]);
            if (series->kind != FRACAS_MARKS) continue;
            widen(series->low[i], &f->panel->y, &y[0], &y[1]);
            widen(series->high[i], &f->panel->y, &y[0], &y[1]);
        }
    }
    if (x[0] > x[1]) x[0] = x[1] = 1; /* nothing to show: axes about one */
    if (y[0] > y[1]) y[0] = y[1] = 1;
    fracas_scale_fit(&f->x, f->panel->x.log, x[0], x[1]);
    fracas_scale_fit(&f->y, f->panel->y.log, y[0], y[1]);
    f->y.from = f->panel->height; /* ticks depend on the room they have; their places come later */
    f->x.to = f->width;
    f->nxtick = fracas_scale_ticks(&f->x, f->xtick);
    f->nytick = fracas_scale_ticks(&f->y, f->ytick);
}

static size_t legend_count(const fracas_panel *panel)
{
    size_t named = 0;
    for (size_t s = 0; s < panel->nseries; s++)
        if (*panel->series[s].name) named++;
    return named;
}

/* ---- drawing ---- */

static void draw_axes(const frame *f, double bottom)
{
    for (size_t i = 0; i < f->nxtick; i++) {
        double x = fracas_scale_place(&f->x, f->xtick[i].value);
        bool major = *f->xtick[i].label;
        if (major)
            fprintf(f->out, "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>\n", x, f->y.to, bottom);
        fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fv%d\"/>\n", x, bottom, major ? TICK : TICK / 2);
        if (major)
            fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", x, bottom + 18,
                    f->xtick[i].label);
    }
    for (size_t i = 0; i < f->nytick; i++) {
        double y = fracas_scale_place(&f->y, f->ytick[i].value);
        bool major = *f->ytick[i].label;
        if (major)
            fprintf(f->out, "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>\n", f->x.from, y, f->x.to);
        fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fh%d\"/>\n", f->x.from, y, major ? -TICK : -TICK / 2);
        if (major)
            fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", f->x.from - 7, y + 4.5,
                    f->ytick[i].label);
    }
    fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fV%.1fH%.1f\"/>\n", f->x.from, f->y.to, bottom, f->x.to);
    fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", (f->x.from + f->x.to) / 2, bottom + 39);
    fracas_markup_text(f->panel->x.label, f->out);
    double middle = (f->y.from + f->y.to) / 2;
    fprintf(f->out, "</text>\n<text transform=\"translate(15 %.1f) rotate(-90)\" text-anchor=\"middle\">", middle);
    fracas_markup_text(f->panel->y.label, f->out);
    fputs("</text>\n", f->out);
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
    fracas_format_digits(series->x[i], 4, x, sizeof x);
    fracas_format_digits(series->y[i], 4, y, sizeof y);
    fputs("<title>", f->out);
    fracas_markup_text(series->name, f->out);
    fprintf(f->out, "%s", *series->name ? "; " : "");
    fracas_markup_text(f->panel->x.label, f->out);
    fprintf(f->out, ": %s; ", x);
    fracas_markup_text(f->panel->y.label, f->out);
    fprintf(f->out, ": %s", y);
    if (isfinite(series->low[i])) {
        fracas_format_digits(series->low[i], 4, x, sizeof x);
        fracas_format_digits(series->high[i], 4, y, sizeof y);
        fprintf(f->out, " (95 %%: %s to %s)", x, y);
    }
    fputs("</title>", f->out);
}

static void draw_marks(const frame *f, const fracas_series *series)
{
    for (size_t i = 0; i < series->n; i++) {
        if (!value_shown(f->panel, series, i)) continue;
        double x = fracas_scale_place(&f->x, series->x[i]), y = fracas_scale_place(&f->y, series->y[i]);
        if (isfinite(series->low[i]) && isfinite(series->high[i])) {
            bool open = !shown(series->low[i], &f->panel->y, -INFINITY);
            double low = open ? f->y.from : fracas_scale_place(&f->y, series->low[i]);
            double high = fracas_scale_place(&f->y, series->high[i]);
            const char *foot = open ? "" : "m-4 0h8m-4 0";
            fprintf(f->out, "<path class=\"bar\" d=\"M%.1f %.1f%sV%.1fm-4 0h8\"/>\n", x, low, foot, high);
        }
        fputs("<path class=\"mark\" d=\"", f->out);
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
        if (!value_shown(f->panel, series, i)) continue;
        double x = fracas_scale_place(&f->x, series->x[i]), y = fracas_scale_place(&f->y, series->y[i]);
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
    fputs("\"><title>", f->out);
    fracas_markup_text(series->name, f->out);
    fputs("</title></path>\n", f->out);
}

static void draw_series(const frame *f, const fracas_series *series)
{
    fprintf(f->out, "<g class=\"c%u\">\n", series->look % COLOURS);
    if (series->kind == FRACAS_MARKS) draw_marks(f, series);
    else draw_line(f, series);
    fputs("</g>\n", f->out);
}

static void draw_entry(const frame *f, const fracas_series *series, double x, double y)
{
    fprintf(f->out, "<g class=\"c%u\">", series->look % COLOURS);
    if (series->kind == FRACAS_MARKS) {
        fputs("<path class=\"key\" fill=\"currentColor\" d=\"", f->out);
        draw_mark(series->look, x + 12, y, f->out);
        fputs("\"/>", f->out);
    } else {
        fprintf(f->out, LINE_START "M%.1f %.1fh24\"/>", dash_of(series->look), x, y);
    }
    fprintf(f->out, "</g><text x=\"%.1f\" y=\"%.1f\">", x + SWATCH, y + 4.5);
    fracas_markup_text(series->name, f->out);
    fputs("</text>\n", f->out);
}

/* Entries left to right, broken into lines; returns the height used. Draws nothing if `draw` is false. */
static double legend(const frame *f, bool draw)
{
    size_t named = legend_count(f->panel), entry = 0;
    double x = f->x.from, y = f->top + LINE_HEIGHT / 2.0;
    if (named == 0) return 0;
    for (size_t s = 0; s < f->panel->nseries && entry < LEGEND_MOST; s++) {
        const fracas_series *series = &f->panel->series[s];
        if (!*series->name) continue;
        double width = SWATCH + character * (double)characters(series->name) + GAP;
        if (entry++ > 0 && x + width > f->width) {
            x = f->x.from;
            y += LINE_HEIGHT;
        }
        if (draw) draw_entry(f, series, x, y);
        x += width;
    }
    if (named > LEGEND_MOST) {
        char text[32];
        snprintf(text, sizeof text, "and %zu more", named - LEGEND_MOST);
        if (x + character * (double)characters(text) > f->width) {
            x = f->x.from;
            y += LINE_HEIGHT;
        }
        if (draw) fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\">%s</text>\n", x, y + 4.5, text);
    }
    return y + LINE_HEIGHT / 2.0 - f->top;
}

/* Room for the widest tick label of all panels, so that their time axes are above each other. */
static double left_margin(const fracas_chart *chart)
{
    size_t widest = 1;
    for (size_t p = 0; p < chart->npanels; p++) {
        frame f = {.panel = &chart->panel[p], .width = chart->width};
        fit(&f);
        for (size_t i = 0; i < f.nytick; i++)
            if (characters(f.ytick[i].label) > widest) widest = characters(f.ytick[i].label);
    }
    return 34 + character * (double)widest;
}

/* Places panel p below `top`; returns where it ends. */
static double place(frame *f, const fracas_chart *chart, size_t p, double left, double top, FILE *out)
{
    const fracas_panel *panel = &chart->panel[p];
    *f = (frame){.panel = panel, .out = out, .top = top, .width = chart->width};
    fit(f);
    f->x.from = left;
    f->x.to = f->width - RIGHT;
    f->y.to = top + legend(f, false) + 8;
    f->y.from = f->y.to + panel->height;
    return f->y.from + (*panel->x.label ? 48 : 28);
}

void fracas_svg_begin(const char *title, int width, double height, bool standalone, FILE *out)
{
    fprintf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" viewBox=\"0 0 %d %.0f\"", width,
            height);
    if (standalone) fprintf(out, " width=\"%d\" height=\"%.0f\"", width, height);
    fputs(" role=\"img\" aria-label=\"", out);
    fracas_markup_text(title, out);
    fputs("\">\n", out);
    if (standalone)
        fprintf(out, "<style>\n%s</style>\n<rect class=\"paper\" width=\"%d\" height=\"%.0f\"/>\n", style_light,
                width, height);
}

void fracas_chart_write(const fracas_chart *chart, bool standalone, FILE *out)
{
    frame f;
    double left = left_margin(chart), height = 4;
    for (size_t p = 0; p < chart->npanels; p++) height = place(&f, chart, p, left, height, out);
    fracas_svg_begin(chart->title, chart->width, height, standalone, out);
    double top = 4;
    for (size_t p = 0; p < chart->npanels; p++) {
        top = place(&f, chart, p, left, top, out);
        legend(&f, true);
        draw_axes(&f, f.y.from);
        for (size_t s = 0; s < chart->panel[p].nseries; s++) draw_series(&f, &chart->panel[p].series[s]);
    }
    fputs("</svg>\n", out);
}

void fracas_chart_style(FILE *out)
{
    fprintf(out, "%s%s", style_light, style_dark);
}
