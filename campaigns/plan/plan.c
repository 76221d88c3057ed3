/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/plan.h"

#include "base/json.h"
#include "base/own.h"
#include "base/units.h"
#include "campaigns/plan/forecast.h"
#include "engine/mesh/make.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A campaign and its predicted costs. */
typedef struct {
    const fracas_campaign *campaign;
    const fracas_point_table *table; /* the campaign's */
    int jobs;
    fracas_forecast *forecast;                   /* one a point */
    size_t nvaried, *varied;                     /* columns that vary */
    int64_t realizations, most;                  /* totals; with rules, minimum and maximum */
    double least_time, time, least_bytes, bytes; /* their totals [s], [bytes] */
    double slowest;                              /* element-steps per second */
} campaign_plan;

static void campaign_plan_clear(campaign_plan *plan)
{
    free(plan->forecast);
    free(plan->varied);
}

/* Minimum of a point's replicas over their maximum. */
static double least_part(const fracas_point *point)
{
    return (double)point->replicas / (double)fracas_point_most(point);
}

/* The caller clears the plan, also after an error. */
static fracas_err plan_init(const fracas_campaign *campaign, int jobs, bool quick,
                            campaign_plan *made)
{
    const fracas_point_table *table = &campaign->table;
    *made = (campaign_plan){
        .campaign = campaign, .table = table, .jobs = jobs, .slowest = INFINITY};
    made->forecast = malloc(table->npoints * sizeof *made->forecast);
    made->varied = malloc(table->ncolumns * sizeof *made->varied);
    if (!made->forecast || !made->varied) return fracas_no_memory("the plan");
    TRY(fracas_forecast_all(campaign, jobs, quick, made->forecast));
    for (size_t c = 0; c < table->ncolumns; c++)
        if (fracas_point_table_varies(table, c)) made->varied[made->nvaried++] = c;
    for (size_t p = 0; p < table->npoints; p++) {
        const double least = least_part(&campaign->point[p]);
        made->realizations += table->point[p].replicas;
        made->most += fracas_point_most(&campaign->point[p]);
        made->least_time += least * made->forecast[p].time;
        made->time += made->forecast[p].time;
        made->least_bytes += least * made->forecast[p].bytes;
        made->bytes += made->forecast[p].bytes;
        made->slowest = fmin(made->slowest, made->forecast[p].speed);
    }
    return FRACAS_OK;
}

/* ---- a table of text ---- */

enum { CELL = 64 };

/* Right-aligned cells. */
typedef struct {
    size_t rows, columns;
    char (*cell)[CELL];
    int *width; /* one a column */
} text_sheet;

static fracas_err sheet_init(size_t rows, size_t columns, text_sheet *sheet)
{
    *sheet = (text_sheet){rows, columns, calloc(rows * columns, CELL),
                          calloc(columns, sizeof *sheet->width)};
    return sheet->cell && sheet->width ? FRACAS_OK : fracas_no_memory("the plan");
}

static void text_sheet_clear(text_sheet *sheet)
{
    free(sheet->cell);
    free(sheet->width);
}

static FRACAS_PRINTF(4, 5) void sheet_put(text_sheet *sheet, size_t row, size_t column,
                                          const char *format, ...)
{
    char *cell = sheet->cell[row * sheet->columns + column];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cell, CELL, format, arguments);
    va_end(arguments);
    if ((int)strlen(cell) > sheet->width[column]) sheet->width[column] = (int)strlen(cell);
}

static void sheet_print(const text_sheet *sheet, FILE *out)
{
    for (size_t r = 0; r < sheet->rows; r++)
        for (size_t c = 0; c < sheet->columns; c++)
            fprintf(out, "%*s%s", sheet->width[c], sheet->cell[r * sheet->columns + c],
                    c + 1 < sheet->columns ? "  " : "\n");
}

enum { SHORT = FRACAS_SIZE_TEXT }; /* bytes of a number; a cell holds two */

static const char *write_duration(double time, char text[SHORT])
{
    if (time < 120.0) snprintf(text, SHORT, time < 1.0 ? "%.2g s" : "%.1f s", time);
    else if (time < 7200.0) snprintf(text, SHORT, "%.0f min", time / 60.0);
    else if (time < 172800.0) snprintf(text, SHORT, "%.1f h", time / 3600.0);
    else snprintf(text, SHORT, "%.1f days", time / 86400.0);
    return text;
}

const char *fracas_size_write(double bytes, char text[FRACAS_SIZE_TEXT])
{
    static const char *const unit[] = {"kB", "MB", "GB", "TB"};
    size_t u = 0;
    for (bytes /= 1e3; bytes >= 1e3 && u < 3; u++) bytes /= 1e3;
    snprintf(text, FRACAS_SIZE_TEXT, "%.1f %s", bytes, unit[u]);
    return text;
}

/* "16-256": minimum and maximum, or the one number. */
static void put_count(text_sheet *sheet, size_t row, size_t column, int64_t least, int64_t most)
{
    if (least == most) sheet_put(sheet, row, column, "%" PRId64, most);
    else sheet_put(sheet, row, column, "%" PRId64 "-%" PRId64, least, most);
}

static void put_range(text_sheet *sheet, size_t row, size_t column, double least, double most,
                      const char *(*write)(double value, char text[SHORT]))
{
    char from[SHORT], to[SHORT];
    if (least == most) sheet_put(sheet, row, column, "%s", write(most, to));
    else sheet_put(sheet, row, column, "%s - %s", write(least, from), write(most, to));
}

/* ---- warnings ---- */

enum { WARNING_TEXT = 400 }; /* bytes of a text */

/* Warning `which` of point p, without its number; how bad it is, 0: it does not apply. */
static double warning_of(const campaign_plan *plan, size_t p, int which, char *text, size_t size)
{
    if (plan->forecast[p].estimated) return 0;
    return fracas_plan_warnings[which](&plan->campaign->point[p], &plan->forecast[p], text, size);
}

/* ---- the plan as text ---- */

static const char *const own_heads[][2] = {{"replicas", ""},    {"elements", ""},
                                           {"time step", "s"},  {"steps", "at most"},
                                           {"time", "at most"}, {"size", "about"}};
enum { OWN_COLUMNS = sizeof own_heads / sizeof *own_heads };

static void put_heads(const campaign_plan *plan, text_sheet *sheet)
{
    sheet_put(sheet, 0, 0, "point");
    for (size_t v = 0; v < plan->nvaried; v++) {
        const fracas_column *column = &plan->table->column[plan->varied[v]];
        sheet_put(sheet, 0, 1 + v, "%s", column->path);
        sheet_put(sheet, 1, 1 + v, "%s", strcmp(column->unit, "1") ? column->unit : "");
    }
    for (size_t c = 0; c < OWN_COLUMNS; c++)
        for (size_t r = 0; r < 2; r++)
            sheet_put(sheet, r, 1 + plan->nvaried + c, "%s", own_heads[c][r]);
}

enum { LONG = 9 }; /* characters of a number before it is rounded */

static void put_point(const campaign_plan *plan, size_t p, text_sheet *sheet)
{
    const fracas_point_row *point = &plan->table->point[p];
    const fracas_forecast *forecast = &plan->forecast[p];
    const size_t row = p + 2, own = 1 + plan->nvaried;
    sheet_put(sheet, row, 0, "%zu", p);
    for (size_t v = 0; v < plan->nvaried; v++) {
        const fracas_value *value = &point->value[plan->varied[v]];
        char number[FRACAS_NUMBER_TEXT];
        fracas_number_write(value->real, number); /* all digits, which --json has */
        if (strlen(number) > LONG) snprintf(number, sizeof number, "%.6g", value->real);
        const bool text = plan->table->column[plan->varied[v]].text;
        sheet_put(sheet, row, 1 + v, "%s", text ? value->text : isnan(value->real) ? "-" : number);
    }
    const double least = least_part(&plan->campaign->point[p]);
    put_count(sheet, row, own, point->replicas, fracas_point_most(&plan->campaign->point[p]));
    sheet_put(sheet, row, own + 1, "%" PRId64, forecast->elements);
    sheet_put(sheet, row, own + 2, "%.4g", forecast->time_step);
    sheet_put(sheet, row, own + 3, "%" PRId64, forecast->steps);
    put_range(sheet, row, own + 4, least * forecast->time, forecast->time, write_duration);
    put_range(sheet, row, own + 5, least * forecast->bytes, forecast->bytes, fracas_size_write);
}

static bool any_surface_field(const campaign_plan *plan)
{
    for (size_t p = 0; p < plan->table->npoints; p++)
        if (plan->campaign->point[p].strength.covariance &&
            fracas_spec_is_surface(&plan->campaign->point[p].spec))
            return true;
    return false;
}

/* Prints a line a kind of warning: how many points have it, and the worst one's text. */
static void print_warnings(const campaign_plan *plan, FILE *out)
{
    const size_t points = plan->table->npoints;
    char text[WARNING_TEXT];
    for (int w = 0; w < FRACAS_PLAN_WARNINGS; w++) {
        size_t count = 0, worst = 0;
        double most = 0;
        for (size_t p = 0; p < points; p++) {
            const double badness = warning_of(plan, p, w, text, sizeof text);
            count += badness > 0;
            if (!(badness > most)) continue;
            most = badness;
            worst = p;
        }
        if (count == 0) continue;
        warning_of(plan, worst, w, text, sizeof text);
        if (count == 1) fprintf(out, "warning: point %zu: %s\n", worst, text);
        else
            fprintf(out, "warning: %zu of %zu points (--json lists them), worst %zu: %s\n", count,
                    points, worst, text);
    }
}

/* Where it is worth a word. */
static void print_memory(const campaign_plan *plan, FILE *out)
{
    enum { NOTABLE = 100000000 };
    char text[FRACAS_SIZE_TEXT];
    size_t most = 0;
    for (size_t p = 1; p < plan->table->npoints; p++)
        if (plan->forecast[p].memory > plan->forecast[most].memory) most = p;
    if (plan->forecast[most].memory < NOTABLE) return;
    fprintf(
        out,
        "Each process takes up to %s of memory (point %zu), the launcher at its start half as much "
        "again.\n",
        fracas_size_write(plan->forecast[most].memory, text), most);
}

static fracas_err print_text(const campaign_plan *plan, FILE *out)
{
    const size_t points = plan->table->npoints, own = 1 + plan->nvaried, last = points + 2;
    FRACAS_CLEARED(text_sheet) sheet = {0};
    TRY(sheet_init(last + 1, own + OWN_COLUMNS, &sheet));
    put_heads(plan, &sheet);
    for (size_t p = 0; p < points; p++) put_point(plan, p, &sheet);
    sheet_put(&sheet, last, 0, "total");
    put_count(&sheet, last, own, plan->realizations, plan->most);
    put_range(&sheet, last, own + 4, plan->least_time, plan->time, write_duration);
    put_range(&sheet, last, own + 5, plan->least_bytes, plan->bytes, fracas_size_write);
    fprintf(out, "Campaign %s: %zu point%s, %" PRId64, plan->campaign->name, points,
            points == 1 ? "" : "s", plan->realizations);
    if (plan->most > plan->realizations) fprintf(out, " to %" PRId64, plan->most);
    fprintf(out, " realization%s\n\n", plan->most == 1 ? "" : "s");
    sheet_print(&sheet, out);
    fprintf(out,
            "\nTimes are for %d process%s at %.2g element-steps per second each, timed just "
            "now, and for running to time.end;\na stop rule may end realizations earlier. "
            "Sizes count one fragment for every %d elements.\n",
            plan->jobs, plan->jobs == 1 ? "" : "es", plan->slowest,
            FRACAS_PLAN_ELEMENTS_PER_FRAGMENT);
    print_memory(plan, out);
    if (plan->most > plan->realizations)
        fprintf(out, "Replicas are added until replicas.until holds: from the least to the "
                     "most, with their times and sizes.\n");
    size_t estimated = 0;
    for (size_t p = 0; p < points; p++) estimated += plan->forecast[p].estimated;
    if (estimated > 0)
        fprintf(out,
                "Estimated (--quick) from meshes of %d divisions: elements, time step, steps, time "
                "and size of %zu point%s.\nTheir strengths are not checked, and warnings are left "
                "out.\n",
                FRACAS_FORECAST_QUICK, estimated, estimated == 1 ? "" : "s");
    if (any_surface_field(plan))
        fprintf(out, "Correlated fields of surfaces are made once a point by each process, "
                     "which is not in these times: some seconds for 10 000 interfaces.\n");
    print_warnings(plan, out);
    return FRACAS_OK;
}

/* ---- the plan as JSON ---- */

static void print_json_point(const campaign_plan *plan, size_t p, fracas_json *json)
{
    const fracas_point_row *point = &plan->table->point[p];
    const fracas_forecast *forecast = &plan->forecast[p];
    fracas_json_object(json, NULL);
    fracas_json_text(json, "hash", fracas_hash_hex(&point->hash).text);
    fracas_json_object(json, "varied");
    for (size_t v = 0; v < plan->nvaried; v++) {
        const fracas_column *column = &plan->table->column[plan->varied[v]];
        const fracas_value *value = &point->value[plan->varied[v]];
        if (column->text) fracas_json_text(json, column->path, value->text);
        else fracas_json_real(json, column->path, value->real);
    }
    fracas_json_close(json);
    fracas_json_integer(json, "replicas", point->replicas);
    fracas_json_integer(json, "replicas_maximum", fracas_point_most(&plan->campaign->point[p]));
    fracas_json_integer(json, "elements", forecast->elements);
    fracas_json_real(json, "time_step", forecast->time_step);
    fracas_json_integer(json, "steps", forecast->steps);
    fracas_json_boolean(json, "estimated", forecast->estimated);
    fracas_json_real(json, "element_steps_per_second", forecast->speed);
    fracas_json_real(json, "seconds", forecast->time);
    fracas_json_real(json, "bytes", forecast->bytes);
    fracas_json_real(json, "memory", forecast->memory);
    fracas_json_close(json);
}

static void print_json(const campaign_plan *plan, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "name", plan->campaign->name);
    fracas_json_integer(&json, "jobs", plan->jobs);
    fracas_json_integer(&json, "points", (int64_t)plan->table->npoints);
    fracas_json_integer(&json, "realizations", plan->realizations);
    fracas_json_integer(&json, "realizations_maximum", plan->most);
    fracas_json_real(&json, "seconds", plan->time);
    fracas_json_real(&json, "bytes", plan->bytes);
    fracas_json_array(&json, "point");
    for (size_t p = 0; p < plan->table->npoints; p++) print_json_point(plan, p, &json);
    fracas_json_close(&json);
    fracas_json_array(&json, "warnings");
    char text[WARNING_TEXT], whole[WARNING_TEXT + 40];
    for (size_t p = 0; p < plan->table->npoints; p++)
        for (int w = 0; w < FRACAS_PLAN_WARNINGS; w++) {
            if (!(warning_of(plan, p, w, text, sizeof text) > 0)) continue;
            snprintf(whole, sizeof whole, "point %zu: %s", p, text);
            fracas_json_text(&json, NULL, whole);
        }
    fracas_json_end(&json);
}

fracas_err fracas_plan_print(const fracas_campaign *campaign, int jobs, bool quick, FILE *out,
                             bool json)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (jobs <= 0) jobs = cores > 0 ? (int)cores : 1;
    FRACAS_CLEARED(campaign_plan) plan = {0};
    TRY(plan_init(campaign, jobs, quick, &plan));
    if (json) print_json(&plan, out);
    else TRY(print_text(&plan, out));
    if (fflush(out) == 0 && !ferror(out)) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT, "cannot write the plan: %s", strerror(errno));
}
