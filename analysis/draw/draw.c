/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts as SVG. */
#include "analysis/draw/chart.h"

#include "analysis/draw/frame.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { RIGHT = 24, LINE_HEIGHT = 21, SWATCH = 30, GAP = 14, TICK = 4 }; /* pixels */
enum { PAD = 7 };                  /* between marks and frame */
enum { TITLE = 25, BETWEEN = 12 }; /* above a panel of small multiples, and below it */
enum { LEGEND_MOST = 12 };         /* further series are counted, not named */
enum { COLOURS = FRACAS_CHART_COLOURS };

static const double character = 8.6; /* width of a mean character of 15 px sans serif */

/* ---- where things are ---- */

static size_t characters(const char *text)
{
    size_t count = 0;
    for (; *text; text++)
        if (((unsigned char)*text & 0xC0) != 0x80) count++; /* UTF-8: not a continuation byte */
    return count;
}

/* From 1/2 to n + 1/2, with a tick a name. */
static void fit_names(fracas_frame *f)
{
    f->x = (fracas_scale){.low = 0.5, .high = (double)f->panel.x.nnames + 0.5};
    f->nxtick = 0;
    for (size_t i = 0; i < f->panel.x.nnames && i < FRACAS_MAX_TICKS; i++) {
        fracas_tick *tick = &f->xtick[f->nxtick++];
        tick->value = (double)i + 1;
        FRACAS_PRINT(tick->label, "%s", f->panel.x.name[i]);
    }
}

/* No mark lies on the frame. */
static double pad_of(const fracas_chart *chart)
{
    for (size_t p = 0; p < chart->npanels; p++)
        for (size_t s = 0; s < chart->panel[p].nseries; s++)
            if (chart->panel[p].series[s].kind == FRACAS_MARKS) return PAD;
    return 0;
}

static void fit(fracas_frame *f)
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

/* ---- axes and legend ---- */

/* A text about x, or one that ends there, that shrinks where it is wider than its room. */
static void put_text(const fracas_frame *f, const char *text, double x, double y,
                     const char *anchor, double room)
{
    const double wide = character * (double)characters(text);
    fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"", x, y, anchor);
    if (wide > room) fprintf(f->out, " style=\"font-size:%.1fpx\"", fmax(8, 15 * room / wide));
    fracas_markup(f->out, ">%s</text>\n", text);
}

static void put_y_label(const char *label, double middle, FILE *out)
{
    fprintf(out, "<text transform=\"translate(16 %.1f) rotate(-90)\" text-anchor=\"middle\">",
            middle);
    fracas_markup(out, "%s</text>\n", label);
}

static void draw_x_ticks(const fracas_frame *f, double bottom)
{
    const double room = f->panel.x.nnames ? (f->x.to - f->x.from) / (double)f->panel.x.nnames - 6
                                          : INFINITY;
    for (size_t i = 0; i < f->nxtick; i++) {
        double x = fracas_scale_place(&f->x, f->xtick[i].value);
        bool major = *f->xtick[i].label;
        if (major)
            fprintf(f->out, "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>\n", x, f->y.to - f->pad,
                    bottom);
        fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fv%d\"/>\n", x, bottom,
                major ? TICK : TICK / 2);
        if (major && !f->inner_x) put_text(f, f->xtick[i].label, x, bottom + 20, "middle", room);
    }
}

static void draw_axes(const fracas_frame *f)
{
    const double bottom = f->y.from + f->pad, left = f->x.from - f->pad, right = f->x.to + f->pad;
    draw_x_ticks(f, bottom);
    for (size_t i = 0; i < f->nytick; i++) {
        double y = fracas_scale_place(&f->y, f->ytick[i].value);
        bool major = *f->ytick[i].label;
        if (major)
            fprintf(f->out, "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>\n", left, y, right);
        fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fh%d\"/>\n", left, y,
                major ? -TICK : -TICK / 2);
        if (major && !f->inner_y)
            put_text(f, f->ytick[i].label, left - 7, y + 5.2, "end", INFINITY);
    }
    fprintf(f->out, "<path class=\"axis\" d=\"M%.1f %.1fV%.1fH%.1f\"/>\n", left, f->y.to - f->pad,
            bottom, right);
    if (*f->panel.title && f->legend)
        put_text(f, f->panel.title, (left + right) / 2, f->y.to - f->pad - 7, "middle",
                 right - left);
    if (f->legend) return; /* which labels all panels together */
    if (*f->panel.x.label) {
        fprintf(f->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", (left + right) / 2,
                bottom + 43);
        fracas_markup(f->out, "%s</text>\n", f->panel.x.label);
    }
    put_y_label(f->panel.y.label, (f->y.from + f->y.to) / 2, f->out);
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

/* An entry of the shared legend for a series: of its name, else of its look. */
static size_t entry_of(const fracas_panel *legend, const fracas_series *series)
{
    for (size_t e = 0; e < legend->nseries; e++)
        if (legend->series[e].look == series->look &&
            (!in_legend(series) || !strcmp(legend->series[e].name, series->name)))
            return e;
    return SIZE_MAX;
}

static void put_key(const fracas_frame *f, size_t s)
{
    const size_t entry = f->legend ? entry_of(f->legend, &f->panel.series[s]) : SIZE_MAX;
    if (entry != SIZE_MAX) fprintf(f->out, " data-key=\"0.%zu\"", entry);
    else
        fprintf(f->out, " data-key=\"%zu.%zu\"", f->number + (f->legend != NULL),
                named_for(&f->panel, s));
}

static void open_group(const fracas_frame *f, const char *class, size_t s)
{
    const unsigned look = f->panel.series[s].look;
    if (look >= FRACAS_CHART_GREY) fprintf(f->out, "<g class=\"%s cg\"", class);
    else fprintf(f->out, "<g class=\"%s c%u\"", class, look % COLOURS);
    if (f->page) put_key(f, s);
    fputs(">\n", f->out);
}

static void draw_series(const fracas_frame *f, size_t s)
{
    const fracas_series *series = &f->panel.series[s];
    open_group(f, "series", s);
    fracas_frame_draw(f, series);
    fputs("</g>\n", f->out);
}

static void draw_entry(const fracas_frame *f, size_t s, double x, double y, double width)
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
        fracas_frame_mark(series->look, x + 12, y, f->out);
        fputs("\"/>", f->out);
    } else if (series->kind != FRACAS_BOXES) {
        fprintf(f->out, FRACAS_LINE_START "M%.1f %.1fh24\"/>", fracas_frame_dash(series->look), x,
                y);
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
static double legend(const fracas_frame *f, bool draw)
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
        fracas_frame f = {.panel = panel_of(chart, p, axes), .width = chart->width};
        fit(&f);
        for (size_t i = 0; i < f.nytick; i++)
            if (characters(f.ytick[i].label) > widest) widest = characters(f.ytick[i].label);
    }
    return 36 + character * (double)widest;
}

/* Places the panel, with scales in `f`, below `top`; returns where it ends. */
static double place(fracas_frame *f, double left, double top)
{
    f->top = top;
    fit(f);
    f->x.from = left + f->pad;
    const char *last = f->nxtick > 0 ? f->xtick[f->nxtick - 1].label
                                     : ""; /* in the middle of which the axis may end */
    f->x.to = f->width - fmax(RIGHT, 4 + character * (double)characters(last) / 2) - f->pad;
    const double head = top + legend(f, false) + 8;
    f->y.to = head + f->pad;
    f->y.from = head + f->panel.height - f->pad;
    return head + f->panel.height + (*f->panel.x.label ? 53 : 30);
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
static void put_axis(const fracas_frame *f, const char *name, const fracas_scale *scale,
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

static void draw_panel(const fracas_chart *chart, const fracas_frame *f)
{
    fputs("<g class=\"panel\"", f->out);
    if (f->page) {
        put_axis(f, "x", &f->x, &f->panel.x, x_label(chart, f->number));
        put_axis(f, "y", &f->y, &f->panel.y, f->panel.y.label);
    }
    fputs(">\n", f->out);
    if (!f->legend) legend(f, true);
    draw_axes(f);
    for (size_t s = 0; s < f->panel.nseries; s++) draw_series(f, s);
    fputs("</g>\n", f->out);
}

/* ---- small multiples ---- */

enum { MOST_ENTRIES = 40 };

typedef struct {
    fracas_panel legend; /* its series are copies of the first of each entry */
    fracas_series series[MOST_ENTRIES];
    double left, top, wide, gap; /* the first panel; width of each; between two */
    size_t rows;
} multiples;

static void find_entries(const fracas_chart *chart, multiples *of)
{
    of->legend = (fracas_panel){.series = of->series};
    for (size_t p = 0; p < chart->npanels; p++) {
        for (size_t s = 0; s < chart->panel[p].nseries; s++) {
            const fracas_series *series = &chart->panel[p].series[s];
            if (in_legend(series) && of->legend.nseries < MOST_ENTRIES &&
                entry_of(&of->legend, series) == SIZE_MAX)
                of->series[of->legend.nseries++] = *series;
        }
    }
}

/* Labels of the abscissa that would touch: of logarithmic axes those between decades go, where two
 * decades stay, then each second label. */
static bool touch(const fracas_frame *f)
{
    double end = -INFINITY;
    for (size_t i = 0; i < f->nxtick; i++) {
        if (!*f->xtick[i].label) continue;
        const double x = fracas_scale_place(&f->x, f->xtick[i].value),
                     half = character * (double)characters(f->xtick[i].label) / 2;
        if (x - half < end) return true;
        end = x + half;
    }
    return false;
}

static void thin_labels(fracas_frame *f)
{
    size_t decades = 0;
    for (size_t i = 0; i < f->nxtick; i++)
        decades += *f->xtick[i].label && fracas_scale_decade(f->xtick[i].value);
    if (f->panel.x.nnames > 0) return;
    for (size_t i = 0; i < f->nxtick && f->x.log && decades > 1 && touch(f); i++)
        if (!fracas_scale_decade(f->xtick[i].value)) *f->xtick[i].label = '\0';
    while (touch(f)) {
        size_t labels = 0;
        for (size_t i = 0; i < f->nxtick; i++)
            if (*f->xtick[i].label && labels++ % 2) *f->xtick[i].label = '\0';
    }
}

/* Half of the widest number of the abscissa reaches beyond the frame. */
static double widest_number(const fracas_chart *chart, fracas_axes axes)
{
    size_t widest = 1;
    fracas_frame f = {.panel = panel_of(chart, 0, axes),
                      .width = chart->width / (double)chart->columns};
    fit(&f);
    for (size_t i = 0; i < f.nxtick && f.panel.x.nnames == 0; i++)
        if (characters(f.xtick[i].label) > widest) widest = characters(f.xtick[i].label);
    return character * (double)widest;
}

static void place_multiples(const fracas_chart *chart, fracas_axes axes, multiples *of)
{
    const double beyond = fmax(0, widest_number(chart, axes) / 2 - PAD);
    const size_t columns = chart->columns;
    fracas_frame f = {.panel = of->legend, .width = chart->width};
    of->left = left_margin(chart, axes);
    f.x.from = of->left;
    f.top = 4;
    of->top = 4 + legend(&f, false);
    of->gap = fmax(GAP, 2 * beyond + 8);
    of->wide = (chart->width - of->left - fmax(RIGHT / 2, beyond + 2) -
                of->gap * (double)(columns - 1)) /
               (double)columns;
    of->rows = (chart->npanels + columns - 1) / columns;
}

static void draw_multiple(const fracas_chart *chart, fracas_axes axes, const multiples *of,
                          size_t p, bool page, FILE *out)
{
    const size_t columns = chart->columns;
    fracas_frame f = {.panel = panel_of(chart, p, axes),
                      .number = p,
                      .page = page,
                      .out = out,
                      .pad = pad_of(chart),
                      .width = of->wide,
                      .legend = &of->legend,
                      .inner_x = p + columns<chart->npanels, .inner_y = p % columns> 0};
    const double head = of->top + TITLE +
                        (double)(p / columns) * (TITLE + f.panel.height + BETWEEN),
                 left = of->left + (double)(p % columns) * (of->wide + of->gap);
    fit(&f);
    f.x.from = left + f.pad;
    f.x.to = left + of->wide - f.pad;
    f.y.to = head + f.pad;
    f.y.from = head + f.panel.height - f.pad;
    thin_labels(&f);
    draw_panel(chart, &f);
}

static void draw_multiples(const fracas_chart *chart, fracas_axes axes, bool page, FILE *out)
{
    multiples of;
    find_entries(chart, &of);
    place_multiples(chart, axes, &of);
    const double bottom = of.top + (double)of.rows * (TITLE + chart->panel->height + BETWEEN) -
                          BETWEEN;
    const double right = of.left + (double)chart->columns * (of.wide + of.gap) - of.gap;
    fracas_frame f = {.panel = of.legend,
                      .page = page,
                      .out = out,
                      .width = chart->width,
                      .legend = &of.legend,
                      .top = 4};
    f.x.from = of.left;
    fracas_svg_begin(chart->title, chart->width, bottom + 53, !page, out);
    fputs("<g class=\"panel\">\n", out); /* for its letters */
    legend(&f, true);
    put_text(&f, chart->panel->x.label, (of.left + right) / 2, bottom + 43, "middle",
             right - of.left);
    put_y_label(chart->panel->y.label, (of.top + TITLE + bottom) / 2, out);
    fputs("</g>\n", out);
    for (size_t p = 0; p < chart->npanels; p++) draw_multiple(chart, axes, &of, p, page, out);
    fputs("</svg>\n", out);
}

static void draw_stack(const fracas_chart *chart, fracas_axes axes, bool page, FILE *out)
{
    double left = left_margin(chart, axes), height = 4, top = 4;
    for (int draw = 0; draw < 2; draw++) {
        if (draw) fracas_svg_begin(chart->title, chart->width, height, !page, out);
        for (size_t p = 0; p < chart->npanels; p++) {
            fracas_frame f = {.panel = panel_of(chart, p, axes),
                              .number = p,
                              .page = page,
                              .out = out,
                              .pad = pad_of(chart),
                              .width = chart->width};
            const double end = place(&f, left, draw ? top : height);
            if (draw) draw_panel(chart, &f);
            if (draw) top = end;
            else height = end;
        }
    }
    fputs("</svg>\n", out);
}

static void draw_chart(const fracas_chart *chart, fracas_axes axes, bool page, FILE *out)
{
    if (chart->columns) draw_multiples(chart, axes, page, out);
    else draw_stack(chart, axes, page, out);
}

void fracas_chart_write(const fracas_chart *chart, bool standalone, FILE *out)
{
    draw_chart(chart, FRACAS_AXES_OWN, !standalone, out);
}

void fracas_chart_write_axes(const fracas_chart *chart, fracas_axes axes, FILE *out)
{
    draw_chart(chart, axes, true, out);
}
