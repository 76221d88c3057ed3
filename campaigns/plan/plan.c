/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/plan.h"

#include "base/json.h"
#include "base/own.h"
#include "base/sheet.h"
#include "base/text.h"
#include "base/units.h"
#include "campaigns/plan/forecast.h"
#include "campaigns/plan/size.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* A campaign and its predicted costs. */
typedef struct {
    const fracas_campaign *campaign;
    const fracas_point_table *table; /* the campaign's */
    int jobs;
    fracas_forecast *forecast;  /* one a point */
    size_t nvaried, *varied;    /* columns that vary */
    int64_t realizations, most; /* totals; with rules, minimum and maximum */
    double least_time, time;    /* their totals [s] */
    fracas_sizes least, sizes;  /* and their files */
    double slowest;             /* element-steps per second */
    fracas_planned_fields fields;
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
        made->slowest = fmin(made->slowest, made->forecast[p].speed);
    }
    made->least = fracas_campaign_sizes(campaign, made->forecast, jobs, true);
    made->sizes = fracas_campaign_sizes(campaign, made->forecast, jobs, false);
    return FRACAS_OK;
}

/* ---- a table of text ---- */

enum { CELL = FRACAS_RENAMED + 10 /* "geometry." */ };

/* Right-aligned cells. */
typedef struct {
    size_t rows, columns, keys;
    char (*cell)[CELL];
} text_sheet;

static fracas_err sheet_init(size_t rows, size_t columns, text_sheet *sheet)
{
    *sheet = (text_sheet){rows, columns, 1, calloc(rows * columns, CELL)};
    return sheet->cell ? FRACAS_OK : fracas_no_memory("the plan");
}

static void text_sheet_clear(text_sheet *sheet)
{
    free(sheet->cell);
}

static FRACAS_PRINTF(4, 5) void sheet_put(text_sheet *sheet, size_t row, size_t column,
                                          const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sheet->cell[row * sheet->columns + column], CELL, format, arguments);
    va_end(arguments);
}

static const char *cell_of(const void *of, size_t row, size_t column)
{
    const text_sheet *sheet = of;
    return sheet->cell[row * sheet->columns + column];
}

static const char *gap_before(const void *of, size_t column)
{
    (void)of;
    return column ? "  " : "";
}

static void sheet_print(const text_sheet *sheet, int columns, FILE *out)
{
    const fracas_sheet print = {.rows = sheet->rows,
                                .columns = sheet->columns,
                                .keys = sheet->keys,
                                .indent = "",
                                .cell = cell_of,
                                .gap = gap_before,
                                .of = sheet};
    fracas_sheet_print(&print, columns, out);
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

/* Warning `which` of point p, without its number; how bad it is, 0: it does not apply. */
static double warning_of(const campaign_plan *plan, size_t p, int which, char *text, size_t size)
{
    if (plan->forecast[p].estimated) return 0;
    return fracas_plan_warnings[which](&plan->campaign->point[p], &plan->forecast[p], text, size);
}

/* ---- the plan as text ---- */

enum { REPLICAS, ELEMENTS, TIME_STEP, STEPS, TIME, SIZE, OWN_COLUMNS };
static const char *const own_heads[OWN_COLUMNS][2] = {{"replicas", ""},    {"elements", ""},
                                                      {"time step", "s"},  {"steps", "at most"},
                                                      {"time", "at most"}, {"size", "about"}};

/* `text`; of a key of edges the name in the mesh file of point p. */
static const char *edge_named(const campaign_plan *plan, size_t p, const char *text,
                              char name[FRACAS_RENAMED])
{
    const fracas_geometry *geometry = &plan->campaign->point[p].spec.geometry;
    return fracas_shape_edge_name(geometry, text, name) ? name : text;
}

/* The column's path, with the name of edges where the mesh files of all points agree on one. */
static const char *head_of(const campaign_plan *plan, const fracas_column *column, char text[CELL])
{
    static const char section[] = "geometry.";
    const size_t size = strlen(section);
    char name[2][FRACAS_RENAMED];
    if (strncmp(column->path, section, size) != 0) return column->path;
    const char *first = edge_named(plan, 0, column->path + size, name[0]);
    for (size_t p = 1; p < plan->table->npoints; p++)
        if (strcmp(first, edge_named(plan, p, column->path + size, name[1])) != 0)
            return column->path;
    snprintf(text, CELL, "%s%s", section, first);
    return text;
}

static void put_heads(const campaign_plan *plan, text_sheet *sheet)
{
    char head[CELL];
    sheet_put(sheet, 0, 0, "point");
    for (size_t v = 0; v < plan->nvaried; v++) {
        const fracas_column *column = &plan->table->column[plan->varied[v]];
        sheet_put(sheet, 0, 1 + v, "%s", head_of(plan, column, head));
        sheet_put(sheet, 1, 1 + v, "%s", strcmp(column->unit, "1") ? column->unit : "");
    }
    for (size_t c = 0; c < OWN_COLUMNS; c++)
        for (size_t r = 0; r < 2; r++)
            sheet_put(sheet, r, 1 + plan->nvaried + c, "%s", own_heads[c][r]);
}

enum { LONG = 9 }; /* characters of a number before it is rounded */

static void put_value(const fracas_column *column, const fracas_value *value, text_sheet *sheet,
                      size_t row, size_t at)
{
    char number[FRACAS_NUMBER_TEXT];
    fracas_number_write(value->real, number); /* all digits, which --json has */
    if (strlen(number) > LONG) snprintf(number, sizeof number, "%.6g", value->real);
    sheet_put(sheet, row, at, "%s", column->text ? value->text : isnan(value->real) ? "-" : number);
}

static void put_point(const campaign_plan *plan, size_t p, text_sheet *sheet)
{
    const fracas_point_row *point = &plan->table->point[p];
    const fracas_forecast *forecast = &plan->forecast[p];
    const size_t row = p + 2, own = 1 + plan->nvaried;
    sheet_put(sheet, row, 0, "%zu", p);
    for (size_t v = 0; v < plan->nvaried; v++) {
        const fracas_column *column = &plan->table->column[plan->varied[v]];
        fracas_value value = point->value[plan->varied[v]];
        char name[FRACAS_RENAMED];
        if (column->text) value.text = edge_named(plan, p, value.text, name);
        put_value(column, &value, sheet, row, 1 + v);
    }
    const double least = least_part(&plan->campaign->point[p]);
    put_count(sheet, row, own + REPLICAS, point->replicas,
              fracas_point_most(&plan->campaign->point[p]));
    sheet_put(sheet, row, own + ELEMENTS, "%" PRId64, forecast->elements);
    sheet_put(sheet, row, own + TIME_STEP, "%.4g", forecast->time_step);
    sheet_put(sheet, row, own + STEPS, "%" PRId64, forecast->steps);
    put_range(sheet, row, own + TIME, least * forecast->time, forecast->time, write_duration);
    put_range(sheet, row, own + SIZE, least * forecast->bytes, forecast->bytes, fracas_size_write);
}

static bool any_surface_field(const campaign_plan *plan)
{
    for (size_t p = 0; p < plan->table->npoints; p++)
        if (plan->campaign->point[p].strength.covariance &&
            fracas_spec_is_surface(&plan->campaign->point[p].spec))
            return true;
    return false;
}

static FRACAS_PRINTF(3, 4) void print_line(int columns, FILE *out, const char *format, ...)
{
    char text[2 * FRACAS_WARNING_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; columns && *c; c++)
        if (*c == '\n') *c = ' ';
    fracas_text_wrap(text, 0, columns, out);
}

/* Prints a line a kind of warning: how many points have it, and the worst one's text. */
static void print_warnings(const campaign_plan *plan, int columns, FILE *out)
{
    const size_t points = plan->table->npoints;
    char text[FRACAS_WARNING_TEXT], line[2 * FRACAS_WARNING_TEXT];
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
        if (count == 1) snprintf(line, sizeof line, "point %zu: %s", worst, text);
        else
            snprintf(line, sizeof line, "%zu of %zu points (--json lists them), worst %zu: %s",
                     count, points, worst, text);
        fracas_sheet_warning(line, columns, out);
    }
}

/* A line for each mesh file: whoever took its unit for another sees it here. */
static void print_files(const campaign_plan *plan, int columns, FILE *out)
{
    for (size_t p = 0; p < plan->table->npoints; p++) {
        const fracas_geometry *is = &plan->campaign->point[p].spec.geometry;
        const fracas_surface_survey *mesh = &plan->forecast[p].mesh;
        char turned[120] = "";
        bool said = mesh->parts == 0;
        for (size_t q = 0; q < p && !said; q++) {
            const fracas_geometry *was = &plan->campaign->point[q].spec.geometry;
            said = plan->forecast[q].mesh.parts > 0 && was->unit == is->unit &&
                   !strcmp(was->file->digest, is->file->digest);
        }
        if (mesh->turned > 0)
            snprintf(turned, sizeof turned, "; %zu of its %" PRId64 " elements are turned round",
                     mesh->turned, plan->forecast[p].elements);
        if (!said)
            print_line(columns, out, "Mesh file %s: %.4g by %.4g by %.4g m%s.", is->file->path,
                       mesh->box[0], mesh->box[1], mesh->box[2], turned);
    }
}

/* Where it is worth a word. */
static void print_memory(const campaign_plan *plan, int columns, FILE *out)
{
    enum { NOTABLE = 100000000 };
    char text[FRACAS_SIZE_TEXT];
    size_t most = 0;
    for (size_t p = 1; p < plan->table->npoints; p++)
        if (plan->forecast[p].memory > plan->forecast[most].memory) most = p;
    if (plan->forecast[most].memory < NOTABLE) return;
    print_line(columns, out,
               "Each process takes up to %s of memory (point %zu), the launcher at its start half "
               "as much again.",
               fracas_size_write(plan->forecast[most].memory, text), most);
}

/* study.h5, what the study takes beside it, and how fragments were counted. */
static void print_sizes(const campaign_plan *plan, int columns, FILE *out)
{
    char study[FRACAS_SIZE_TEXT], segments[FRACAS_SIZE_TEXT], peak[FRACAS_SIZE_TEXT],
        counted[80] = "";
    size_t tried = 0;
    for (size_t p = 0; p < plan->table->npoints; p++) tried += plan->forecast[p].tried > 0;
    const bool all = tried == plan->table->npoints;
    if (tried > 0)
        snprintf(counted, sizeof counted, "realizations of %zu point%s, computed just now%s", tried,
                 tried == 1 ? "" : "s", all ? "" : ", and ");
    print_line(columns, out,
               "Sizes count the fragments of %s%s.\nstudy.h5 will have about %s, the segments %s: "
               "%s while it is written.",
               counted, all ? "" : "a scaling law", fracas_size_write(plan->sizes.study, study),
               fracas_size_write(plan->sizes.segments, segments),
               fracas_size_write(plan->sizes.peak, peak));
}

static void print_fields(const campaign_plan *plan, int columns, FILE *out)
{
    char bytes[FRACAS_SIZE_TEXT];
    if (plan->fields.realizations == 0) return;
    print_line(columns, out, "Fields of %zu realization%s add up to %s beside them.",
               plan->fields.realizations, plan->fields.realizations == 1 ? "" : "s",
               fracas_size_write(plan->fields.bytes, bytes));
}

/* Lines below the table: where its numbers are from. */
static void print_notes(const campaign_plan *plan, int columns, FILE *out)
{
    putc('\n', out);
    print_line(columns, out,
               "Times are for %d process%s at %.2g element-steps per second each, timed just now, "
               "and for running to time.end;\na stop rule may end realizations earlier.",
               plan->jobs, plan->jobs == 1 ? "" : "es", plan->slowest);
    print_sizes(plan, columns, out);
    print_fields(plan, columns, out);
    print_files(plan, columns, out);
    print_memory(plan, columns, out);
    if (plan->most > plan->realizations)
        print_line(columns, out,
                   "Replicas are added until replicas.until holds: from the least to the most, "
                   "with their times and sizes.");
    size_t estimated = 0;
    for (size_t p = 0; p < plan->table->npoints; p++) estimated += plan->forecast[p].estimated;
    if (estimated > 0)
        print_line(columns, out,
                   "Estimated (--quick) from meshes of %d divisions: elements, time step, steps, "
                   "time and size of %zu point%s.\nTheir strengths are not checked, and warnings "
                   "are left out.",
                   FRACAS_FORECAST_QUICK, estimated, estimated == 1 ? "" : "s");
    if (any_surface_field(plan))
        print_line(columns, out,
                   "Correlated fields of surfaces are made once a point by each process, which is "
                   "not in these times: some seconds for 10 000 interfaces.");
}

/* Parameters that each part of a table repeats; of a table with a column of cases; its points. */
enum { MOST_VARIED = 2, MOST_OF_CASES = 8, MOST_CASES = 1000 };

/* shown = the varied parameters, without those of cases where there are many; number left out. */
static size_t name_cases(const campaign_plan *plan, size_t *shown)
{
    const size_t named = fracas_point_table_find(plan->table, "case");
    const bool many = named != SIZE_MAX && plan->nvaried > MOST_OF_CASES &&
                      plan->table->npoints <= MOST_CASES;
    size_t kept = 0;
    for (size_t v = 0; v < plan->nvaried; v++)
        if (!many || !fracas_point_table_follows(plan->table, named, plan->varied[v]))
            shown[kept++] = plan->varied[v];
    return plan->nvaried - kept;
}

/* Every point in a row, and the totals. */
static fracas_err print_points(const campaign_plan *whole, int columns, FILE *out)
{
    campaign_plan part = *whole, *const plan = &part;
    OWNED size_t *shown = part.varied = malloc(whole->nvaried * sizeof *shown + 1);
    if (!shown) return fracas_no_memory("the plan");
    const size_t named = name_cases(whole, shown);
    part.nvaried -= named;
    const size_t points = plan->table->npoints, own = 1 + plan->nvaried, last = points + 2;
    FRACAS_CLEARED(text_sheet) sheet = {0};
    TRY(sheet_init(last + 1, own + OWN_COLUMNS, &sheet));
    put_heads(plan, &sheet);
    for (size_t p = 0; p < points; p++) put_point(plan, p, &sheet);
    sheet_put(&sheet, last, 0, "total");
    put_count(&sheet, last, own, plan->realizations, plan->most);
    put_range(&sheet, last, own + TIME, plan->least_time, plan->time, write_duration);
    put_range(&sheet, last, own + SIZE, plan->least.study, plan->sizes.study, fracas_size_write);
    sheet.keys = plan->nvaried <= MOST_VARIED ? own : 1;
    sheet_print(&sheet, columns, out);
    if (named)
        print_line(columns, out, "\nCases stand for %zu more of the parameters: see --json.",
                   named);
    return FRACAS_OK;
}

/* ---- many points ---- */

/* A number of point p: the varied column `of`, or one of its own. */
static double number_of(const campaign_plan *plan, size_t p, size_t of)
{
    const fracas_forecast *forecast = &plan->forecast[p];
    if (of < plan->nvaried) return plan->table->point[p].value[plan->varied[of]].real;
    switch (of - plan->nvaried) {
    case REPLICAS: return (double)fracas_point_most(&plan->campaign->point[p]);
    case ELEMENTS: return (double)forecast->elements;
    case TIME_STEP: return forecast->time_step;
    case STEPS: return (double)forecast->steps;
    case TIME: return forecast->time;
    default: return forecast->bytes;
    }
}

/* A number of own column `c`. */
static const char *write_own(size_t c, double number, char text[SHORT])
{
    if (c == TIME) return write_duration(number, text);
    if (c == SIZE) return fracas_size_write(number, text);
    snprintf(text, SHORT, c == TIME_STEP ? "%.4g" : "%.0f", number);
    return text;
}

/* Column `of` over all points: its unit, least and most, and the points of both. */
static void put_span(const campaign_plan *plan, size_t of, text_sheet *sheet)
{
    const size_t row = 1 + of;
    const bool own = of >= plan->nvaried;
    const fracas_column *column = own ? NULL : &plan->table->column[plan->varied[of]];
    char text[SHORT], head[CELL];
    size_t end[2] = {SIZE_MAX, SIZE_MAX};
    sheet_put(sheet, row, 0, "%s",
              own ? own_heads[of - plan->nvaried][0] : head_of(plan, column, head));
    sheet_put(sheet, row, 1, "%s",
              own                              ? own_heads[of - plan->nvaried][1]
              : strcmp(column->unit, "1") != 0 ? column->unit
                                               : "");
    for (size_t p = 0; p < plan->table->npoints; p++) {
        const double number = number_of(plan, p, of);
        if (!own && column->text && end[0] == SIZE_MAX) end[0] = p;
        if (isnan(number)) continue;
        if (end[0] == SIZE_MAX || number < number_of(plan, end[0], of)) end[0] = p;
        if (end[1] == SIZE_MAX || number > number_of(plan, end[1], of)) end[1] = p;
    }
    for (size_t e = 0; e < 2; e++) {
        const double number = end[e] == SIZE_MAX ? NAN : number_of(plan, end[e], of);
        if (own) sheet_put(sheet, row, 2 + e, "%s", write_own(of - plan->nvaried, number, text));
        else if (column->text) sheet_put(sheet, row, 2 + e, "%s", e ? "" : "several");
        else put_value(column, &(fracas_value){.real = number, .text = ""}, sheet, row, 2 + e);
    }
}

/* The least and most of every column, and the totals. */
static fracas_err print_summary(const campaign_plan *plan, int columns, FILE *out)
{
    const size_t rows = plan->nvaried + OWN_COLUMNS;
    FRACAS_CLEARED(text_sheet) sheet = {0};
    TRY(sheet_init(1 + rows, 5, &sheet));
    sheet_put(&sheet, 0, 2, "least");
    sheet_put(&sheet, 0, 3, "most");
    sheet_put(&sheet, 0, 4, "total");
    for (size_t c = 0; c < rows; c++) put_span(plan, c, &sheet);
    put_count(&sheet, 1 + plan->nvaried, 4, plan->realizations, plan->most);
    put_range(&sheet, rows - 1, 4, plan->least_time, plan->time, write_duration);
    put_range(&sheet, rows, 4, plan->least.study, plan->sizes.study, fracas_size_write);
    sheet.keys = 1;
    sheet_print(&sheet, columns, out);
    print_line(columns, out, "\n`--points` lists every point.");
    return FRACAS_OK;
}

static fracas_err print_text(const campaign_plan *plan, const fracas_plan_options *options,
                             FILE *out)
{
    const size_t points = plan->table->npoints;
    fprintf(out, "Campaign %s: %zu point%s, %" PRId64, plan->campaign->name, points,
            points == 1 ? "" : "s", plan->realizations);
    if (plan->most > plan->realizations) fprintf(out, " to %" PRId64, plan->most);
    fprintf(out, " realization%s\n\n", plan->most == 1 ? "" : "s");
    TRY(options->points || points <= FRACAS_PLAN_LISTED
            ? print_points(plan, options->columns, out)
            : print_summary(plan, options->columns, out));
    print_notes(plan, options->columns, out);
    print_warnings(plan, options->columns, out);
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
    fracas_json_real(json, "fragments", forecast->fragments);
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
    fracas_json_real(&json, "bytes", plan->sizes.study);
    fracas_json_real(&json, "bytes_segments", plan->sizes.segments);
    fracas_json_real(&json, "bytes_peak", plan->sizes.peak);
    fracas_json_real(&json, "bytes_fields", plan->fields.bytes);
    fracas_json_array(&json, "point");
    for (size_t p = 0; p < plan->table->npoints; p++) print_json_point(plan, p, &json);
    fracas_json_close(&json);
    fracas_json_array(&json, "warnings");
    char text[FRACAS_WARNING_TEXT], whole[FRACAS_WARNING_TEXT + 40];
    for (size_t p = 0; p < plan->table->npoints; p++)
        for (int w = 0; w < FRACAS_PLAN_WARNINGS; w++) {
            if (!(warning_of(plan, p, w, text, sizeof text) > 0)) continue;
            snprintf(whole, sizeof whole, "point %zu: %s", p, text);
            fracas_json_text(&json, NULL, whole);
        }
    fracas_json_end(&json);
}

fracas_err fracas_plan_print(const fracas_campaign *campaign, const fracas_plan_options *options,
                             FILE *out)
{
    FRACAS_CLEARED(campaign_plan) plan = {0};
    TRY(plan_init(campaign, options->jobs > 0 ? options->jobs : 1, options->quick, &plan));
    plan.fields = options->fields;
    if (options->json) print_json(&plan, out);
    else TRY(print_text(&plan, options, out));
    if (fflush(out) == 0 && !ferror(out)) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT, "cannot write the plan: %s", strerror(errno));
}
