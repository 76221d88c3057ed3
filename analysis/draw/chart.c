/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/chart.h"

#include "analysis/data/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    TRY(fracas_grow(&panel->series, sizeof *panel->series, panel->nseries, &panel->capacity,
                    "a figure"));
    fracas_series *made = &panel->series[panel->nseries++];
    *made = (fracas_series){.kind = kind, .look = look, .n = n};
    made->x = calloc(n + 1, sizeof *made->x);
    made->y = calloc(n + 1, sizeof *made->y);
    const bool ranges = kind == FRACAS_MARKS || kind == FRACAS_BAND || kind == FRACAS_BOXES;
    if (ranges) {
        made->low = calloc(n + 1, sizeof *made->low);
        made->high = calloc(n + 1, sizeof *made->high);
    }
    if (!made->x || !made->y || (ranges && (!made->low || !made->high)))
        return fracas_no_memory("a figure");
    *series = made;
    return FRACAS_OK;
}

bool fracas_panel_shows(const fracas_panel *panel, const fracas_series *series, size_t i)
{
    const double x = series->x[i], y = series->y[i];
    if (!isfinite(x) || !isfinite(y) || (panel->x.log && x <= 0) || (panel->y.log && y <= 0))
        return false;
    return !(panel->y_floor > 0) || y >= panel->y_floor;
}

static void widen(double value, const fracas_axis *axis, double end[2])
{
    if (!isfinite(value) || (axis->log && value <= 0)) return;
    end[0] = fmin(end[0], value);
    end[1] = fmax(end[1], value);
}

void fracas_panel_extent(const fracas_panel *panel, double x[2], double y[2])
{
    x[0] = y[0] = INFINITY;
    x[1] = y[1] = -INFINITY;
    for (int end = 0; end < 2; end++) {
        if (panel->x.show[0] != panel->x.show[1]) widen(panel->x.show[end], &panel->x, x);
        if (panel->y.show[0] != panel->y.show[1]) widen(panel->y.show[end], &panel->y, y);
    }
    for (size_t s = 0; s < panel->nseries; s++) {
        const fracas_series *series = &panel->series[s];
        for (size_t i = 0; i < series->n; i++) {
            widen(series->x[i], &panel->x, x); /* all panels */
            if (!fracas_panel_shows(panel, series, i)) continue;
            widen(series->y[i], &panel->y, y);
            if (!series->low) continue;
            widen(series->low[i], &panel->y, y);
            widen(series->high[i], &panel->y, y);
        }
    }
}

/* How many panels have the axes of the first. */
static size_t alike(const fracas_chart *chart)
{
    return chart->columns ? chart->npanels : chart->npanels > 0;
}

void fracas_charts_align(fracas_chart *chart, size_t count)
{
    double all[2][2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    for (size_t i = 0; i < count; i++) {
        for (size_t p = 0; p < alike(&chart[i]); p++) {
            double end[2][2];
            fracas_panel_extent(&chart[i].panel[p], end[0], end[1]);
            for (int axis = 0; axis < 2; axis++) {
                all[axis][0] = fmin(all[axis][0], end[axis][0]);
                all[axis][1] = fmax(all[axis][1], end[axis][1]);
            }
        }
    }
    for (size_t i = 0; i < count; i++) {
        for (size_t p = 0; p < alike(&chart[i]); p++) {
            memcpy(chart[i].panel[p].x.show, all[0], sizeof all[0]);
            memcpy(chart[i].panel[p].y.show, all[1], sizeof all[1]);
        }
    }
}

const char *fracas_axis_name(const fracas_axis *axis, double value)
{
    if (axis->nnames == 0) return NULL;
    const double most = (double)axis->nnames, nearest = round(value);
    return axis->name[(size_t)fmin(fmax(nearest, 1), most) - 1];
}

/* ---- CSV ---- */

static void put_label(const fracas_chart *chart, bool of_y, FILE *out)
{
    char text[FRACAS_MAX_PANELS * (sizeof chart->panel->x.label + 4)] = "";
    const char *before = "";
    for (size_t p = 0; p < chart->npanels; p++) {
        const char *label = of_y ? chart->panel[p].y.label : chart->panel[p].x.label;
        if (!*label || !strcmp(label, before)) continue;
        if (*text) strcat(text, " | ");
        strcat(text, label);
        before = label;
    }
    fracas_csv_text(text, out);
}

static void put_x(const fracas_axis *axis, double x, FILE *out)
{
    const char *name = fracas_axis_name(axis, x);
    if (!name) {
        fracas_csv_real(x, out);
        return;
    }
    putc(',', out);
    fracas_csv_text(name, out);
}

static void put_series(const fracas_panel *panel, size_t number, const fracas_series *series,
                       bool titled, FILE *out)
{
    static const char *const kind[] = {"curve", "steps", "mark", "band", "box"};
    for (size_t i = 0; i < series->n; i++) {
        if (!fracas_panel_shows(panel, series, i)) continue;
        fprintf(out, "%zu,", number);
        fracas_csv_text(series->name, out);
        fprintf(out, ",%s", kind[series->kind]);
        put_x(&panel->x, series->x[i], out);
        fracas_csv_real(series->y[i], out);
        fracas_csv_real(series->low ? series->low[i] : NAN, out);
        fracas_csv_real(series->high ? series->high[i] : NAN, out);
        if (titled) putc(',', out), fracas_csv_text(panel->title, out);
        putc('\n', out);
    }
}

void fracas_chart_csv(const fracas_chart *chart, FILE *out)
{
    fputs("panel,series,kind,", out);
    put_label(chart, false, out);
    putc(',', out);
    put_label(chart, true, out);
    fputs(chart->columns ? ",low,high,title\n" : ",low,high\n", out);
    for (size_t p = 0; p < chart->npanels; p++)
        for (size_t s = 0; s < chart->panel[p].nseries; s++)
            put_series(&chart->panel[p], p + 1, &chart->panel[p].series[s], chart->columns > 0,
                       out);
}
