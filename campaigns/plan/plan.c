#include "campaigns/plan/plan.h"

#include "base/json.h"
#include "base/units.h"
#include "campaigns/plan/forecast.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A campaign and what is said about it. */
typedef struct {
    const fracas_campaign *campaign;
    const fracas_point_table *table; /* of the campaign */
    int jobs;
    fracas_forecast *forecast;       /* of each point */
    size_t nvaried, *varied;         /* columns that tell points apart */
    int64_t realizations, most;      /* totals: as asked for, or at first and at most where rules decide */
    double least_time, time, least_bytes, bytes; /* of these */
    double slowest;                  /* element-steps per second */
} campaign_plan;

static void plan_clear(campaign_plan *plan)
{
    free(plan->forecast);
    free(plan->varied);
}

/* Replicas that a point gets in any case, as a share of the most. */
static double least_share(const fracas_point *point)
{
    return (double)point->replicas / (double)fracas_point_most(point);
}

/* The caller clears the plan, also after an error. */
static fracas_err plan_init(const fracas_campaign *campaign, int jobs, campaign_plan *made)
{
    const fracas_point_table *table = &campaign->table;
    *made = (campaign_plan){.campaign = campaign, .table = table, .jobs = jobs, .slowest = INFINITY};
    made->forecast = malloc(table->npoints * sizeof *made->forecast);
    made->varied = malloc(table->ncolumns * sizeof *made->varied);
    if (!made->forecast || !made->varied) return fracas_no_memory("the plan");
    TRY(fracas_forecast_all(campaign, jobs, made->forecast));
    for (size_t c = 0; c < table->ncolumns; c++)
        if (fracas_point_table_varies(table, c)) made->varied[made->nvaried++] = c;
    for (size_t p = 0; p < table->npoints; p++) {
        const double least = least_share(&campaign->point[p]);
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
    int *width; /* of each column */
} text_sheet;

static fracas_err sheet_init(size_t rows, size_t columns, text_sheet *sheet)
{
    *sheet = (text_sheet){rows, columns, calloc(rows * columns, CELL), calloc(columns, sizeof *sheet->width)};
    return sheet->cell && sheet->width ? FRACAS_OK : fracas_no_memory("the plan");
}

static void sheet_clear(text_sheet *sheet)
{
    free(sheet->cell);
    free(sheet->width);
}

static FRACAS_PRINTF(4, 5) void sheet_put(text_sheet *sheet, size_t row, size_t column, const char *format, ...)
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

enum { SHORT = 28 }; /* bytes of a number in a cell, of which it holds two */

static void write_duration(double time, char text[SHORT])
{
    if (time < 120.0) snprintf(text, SHORT, time < 1.0 ? "%.2g s" : "%.1f s", time);
    else if (time < 7200.0) snprintf(text, SHORT, "%.0f min", time / 60.0);
    else if (time < 172800.0) snprintf(text, SHORT, "%.1f h", time / 3600.0);
    else snprintf(text, SHORT, "%.1f days", time / 86400.0);
}

static void write_size(double bytes, char text[SHORT])
{
    static const char *const unit[] = {"kB", "MB", "GB", "TB"};
    size_t u = 0;
    for (bytes /= 1e3; bytes >= 1e3 && u < 3; u++) bytes /= 1e3;
    snprintf(text, SHORT, "%.1f %s", bytes, unit[u]);
}

/* "16-256": what it comes to at least and at most, or what it is. */
static void put_count(text_sheet *sheet, size_t row, size_t column, int64_t least, int64_t most)
{
    if (least == most) sheet_put(sheet, row, column, "%" PRId64, most);
    else sheet_put(sheet, row, column, "%" PRId64 "-%" PRId64, least, most);
}

static void put_range(text_sheet *sheet, size_t row, size_t column, double least, double most,
                      void (*write)(double value, char text[SHORT]))
{
    char from[SHORT], to[SHORT];
    write(least, from);
    write(most, to);
    if (least == most) sheet_put(sheet, row, column, "%s", to);
    else sheet_put(sheet, row, column, "%s - %s", from, to);
}

/* ---- what a reader should know before running it ---- */

/* The softening zone of a crack, some E G_c/sigma_c^2 long, should hold elements. */
#define COARSE 0.5
/* A ring turned further than this no longer opens along the directions of its start [rad]: 1 - cos of it is 5e-5. */
#define TURNED 0.01

/* What would crack more of a body whose stress stays below its strength. */
static const char *harder(const fracas_spec *spec, const fracas_forecast *forecast)
{
    if (spec->loading.type != &fracas_loading_initial_velocity) return "load it harder, or longer";
    return spec->time.end < forecast->turn ? "raise its velocity or time.end" : "a free ring swings back: raise its velocity";
}

/* What would resolve a crack's softening. */
static void finer(const fracas_spec *spec, const fracas_forecast *forecast, char *text, size_t size)
{
    const double times = forecast->coarseness / COARSE;
    if (!fracas_spec_is_surface(spec)) snprintf(text, size, "raise mesh.elements to %.0f", ceil((double)forecast->elements * times));
    else if (spec->mesh.spacing == &fracas_spacing_given) snprintf(text, size, "give a mesh with edges %.2g times shorter", times);
    else if (spec->mesh.size > 0) snprintf(text, size, "lower mesh.size to %.2g m", spec->mesh.size / times);
    else snprintf(text, size, "raise mesh.divisions to %.0f", ceil((double)spec->mesh.divisions * times));
}

/* Each writes what to know of a point; false if it does not apply. */
typedef bool warning(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size);

static bool warn_coarse(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    char remedy[80];
    finer(&point->spec, forecast, remedy, sizeof remedy);
    snprintf(text, size, "elements are %.3g E G_c/sigma_c^2 long, above %.1g a crack's softening is not resolved: %s",
             forecast->coarseness, COARSE, remedy);
    return forecast->coarseness > COARSE;
}

static bool warn_uniform(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    const char *distribution = point->strength.distribution->name;
    const bool all = strcmp(distribution, "constant") == 0;
    snprintf(text, size, "%s interfaces %sare equally strong and qualify at once; where the body breaks is then up to mesh and "
             "rounding: give the strength a scatter%s", all ? "all" : "half of the", all ? "" : "or more ",
             strcmp(distribution, "flaws") ? "" : ", here by a higher flaw_density");
    return forecast->uniform;
}

static bool warn_lines(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    (void)point;
    snprintf(text, size, "interfaces are equally strong and the mesh is regular, so that cracks follow its lines: give mesh.amplitude, "
             "for instance 0.2");
    return forecast->lines;
}

static bool warn_weak_load(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    snprintf(text, size, "until time.end the stress stays below %.3g MPa, the mean strength is %.3g MPa: the weakest interfaces will "
             "crack, or none: %s", 1e-6 * forecast->bound, 1e-6 * forecast->mean, harder(&point->spec, forecast));
    return forecast->bound < forecast->mean;
}

static bool warn_repeated(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    snprintf(text, size, "its strengths are those of a file, so all its %" PRId64 " replicas are equal: give it replicas: 1",
             point->replicas);
    return forecast->repeated;
}

static bool warn_folds(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    (void)point;
    snprintf(text, size, "the whole ring comes under compression, where it folds, as it has no bending stiffness: what breaks then "
             "means nothing: load it outward, and end a free ring that stays whole by %.3g s", 2 * forecast->turn);
    return forecast->folds;
}

static bool warn_lonely(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    (void)point;
    snprintf(text, size, "cohesive.zone is longer than half of the ring: once an interface opens, none else can: shorten it to less "
             "than a quarter of a fragment");
    return forecast->lonely;
}

/* Laws that leave the flux soften from what the step has reached: docs/decisions/onset-of-surfaces.md. */
static bool warn_passed(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    (void)point;
    snprintf(text, size, "one time step adds %.3g Pa of stress, and nearly all strengths lie within %.3g Pa: interfaces that a step passes "
             "together are equally strong; lower time.safety %.2g times", forecast->step_stress, forecast->spread,
             4 * forecast->step_stress / forecast->spread);
    return forecast->spread > 0 && forecast->step_stress > 0.25 * forecast->spread;
}

static bool warn_step(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    (void)point;
    snprintf(text, size, "one time step adds %.3g Pa of stress, more than the mean strength of %.3g Pa: is that in Pa? A bare number "
             "is SI", forecast->step_stress, forecast->mean);
    return forecast->step_stress > forecast->mean;
}

static bool warn_turned(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    (void)point;
    snprintf(text, size, "the ring turns by %.2g rad until time.end, and geometry.direction is initial: interfaces that open along "
             "directions it no longer has are off from %.2g rad on: leave direction out, for current", forecast->turned, TURNED);
    return forecast->turned > TURNED;
}

static bool warn_short(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    const double length = point->strength.correlation_length;
    snprintf(text, size, "strength.correlation_length is %.3g m, less than a third of an element of %.3g m: strengths are as good as "
             "independent: is that in m? A bare number is SI", length, forecast->element);
    return point->strength.covariance && length < forecast->element / 3;
}

static bool warn_long(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    const double length = point->strength.correlation_length;
    snprintf(text, size, "strength.correlation_length is %.3g m, more than the %.3g m of the body: strengths of a replica are much alike, "
             "and differ from replica to replica: is that in m? A bare number is SI", length, forecast->extent);
    return point->strength.covariance && length > forecast->extent;
}

static bool warn_flat(const fracas_point *point, const fracas_forecast *forecast, char *text, size_t size)
{
    snprintf(text, size, "strength.factor is the same at all interfaces: the body does not reach where %s changes along %s: are its "
             "coordinates in m?", forecast->flat ? point->strength.factor->path : "",
             forecast->flat ? point->strength.factor_along->name : "");
    return forecast->flat;
}

static warning *const warnings[] = {warn_coarse, warn_uniform, warn_lines, warn_weak_load, warn_repeated,
                                    warn_folds,  warn_lonely,  warn_step,  warn_turned,    warn_passed,
                                    warn_short,  warn_long,    warn_flat};
enum { WARNINGS = FRACAS_COUNT(warnings) };

/* Warning `which` of point p, with its number; false if it does not apply. */
static bool warning_of(const campaign_plan *plan, size_t p, int which, char *text, size_t size)
{
    int begin = snprintf(text, size, "point %zu: ", p);
    return warnings[which](&plan->campaign->point[p], &plan->forecast[p], text + begin, size - (size_t)begin);
}

/* ---- the plan as text ---- */

static const char *const own_heads[][2] = {{"replicas", ""}, {"elements", ""}, {"time step", "s"}, {"steps", "at most"},
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
        for (size_t r = 0; r < 2; r++) sheet_put(sheet, r, 1 + plan->nvaried + c, "%s", own_heads[c][r]);
}

enum { LONG = 9 }; /* characters of a number that is written as it is */

static void put_point(const campaign_plan *plan, size_t p, text_sheet *sheet)
{
    const fracas_point_row *point = &plan->table->point[p];
    const fracas_forecast *forecast = &plan->forecast[p];
    const size_t row = p + 2, own = 1 + plan->nvaried;
    sheet_put(sheet, row, 0, "%zu", p);
    for (size_t v = 0; v < plan->nvaried; v++) {
        const fracas_value *value = &point->value[plan->varied[v]];
        char number[FRACAS_NUMBER_TEXT];
        fracas_number_write(value->real, number);
        if (strlen(number) > LONG) snprintf(number, sizeof number, "%.6g", value->real); /* drawn; --json has all digits */
        const bool text = plan->table->column[plan->varied[v]].text;
        sheet_put(sheet, row, 1 + v, "%s", text ? value->text : isnan(value->real) ? "-" : number);
    }
    const double least = least_share(&plan->campaign->point[p]);
    put_count(sheet, row, own, point->replicas, fracas_point_most(&plan->campaign->point[p]));
    sheet_put(sheet, row, own + 1, "%" PRId64, forecast->elements);
    sheet_put(sheet, row, own + 2, "%.4g", forecast->time_step);
    sheet_put(sheet, row, own + 3, "%" PRId64, forecast->steps);
    put_range(sheet, row, own + 4, least * forecast->time, forecast->time, write_duration);
    put_range(sheet, row, own + 5, least * forecast->bytes, forecast->bytes, write_size);
}

static bool any_surface_field(const campaign_plan *plan)
{
    for (size_t p = 0; p < plan->table->npoints; p++)
        if (plan->campaign->point[p].strength.covariance && fracas_spec_is_surface(&plan->campaign->point[p].spec)) return true;
    return false;
}

/* The first few of each kind, and of the others how many there are: a design would have the same for most of its points. */
static void print_warnings(const campaign_plan *plan, FILE *out)
{
    enum { SHOWN = 4 };
    size_t said[WARNINGS] = {0}, last[WARNINGS] = {0};
    char text[400];
    for (size_t p = 0; p < plan->table->npoints; p++)
        for (int w = 0; w < WARNINGS; w++) {
            if (!warning_of(plan, p, w, text, sizeof text)) continue;
            if (++said[w] <= SHOWN) fprintf(out, "warning: %s\n", text);
            last[w] = p;
        }
    for (int w = 0; w < WARNINGS; w++) {
        if (said[w] <= SHOWN) continue;
        warning_of(plan, last[w], w, text, sizeof text);
        fprintf(out, "warning: the same at %zu more, which --json lists, the last being %s\n", said[w] - SHOWN, text);
    }
}

static fracas_err print_text(const campaign_plan *plan, FILE *out)
{
    const size_t points = plan->table->npoints, own = 1 + plan->nvaried, last = points + 2;
    text_sheet sheet;
    fracas_err err = sheet_init(last + 1, own + OWN_COLUMNS, &sheet);
    if (!err) {
        put_heads(plan, &sheet);
        for (size_t p = 0; p < points; p++) put_point(plan, p, &sheet);
        sheet_put(&sheet, last, 0, "total");
        put_count(&sheet, last, own, plan->realizations, plan->most);
        put_range(&sheet, last, own + 4, plan->least_time, plan->time, write_duration);
        put_range(&sheet, last, own + 5, plan->least_bytes, plan->bytes, write_size);
        fprintf(out, "Campaign %s: %zu point%s, %" PRId64, plan->campaign->name, points, points == 1 ? "" : "s", plan->realizations);
        if (plan->most > plan->realizations) fprintf(out, " to %" PRId64, plan->most);
        fprintf(out, " realization%s\n\n", plan->most == 1 ? "" : "s");
        sheet_print(&sheet, out);
        fprintf(out,
            "\nTimes are for %d process%s at %.2g element-steps per second each, timed just now, and for running to "
            "time.end;\na stop rule may end realizations earlier. Sizes count one fragment for every %d elements.\n",
            plan->jobs, plan->jobs == 1 ? "" : "es", plan->slowest, FRACAS_PLAN_ELEMENTS_PER_FRAGMENT);
        if (plan->most > plan->realizations)
            fprintf(out, "Replicas are added until replicas.until holds: from the least to the most, with their times and sizes.\n");
        if (any_surface_field(plan))
            fprintf(out, "Correlated fields of surfaces are made once a point by each process, which is not in these times: some seconds "
                         "for 10 000 interfaces.\n");
        print_warnings(plan, out);
    }
    sheet_clear(&sheet);
    return err;
}

/* ---- the plan as JSON ---- */

static void print_json_point(const campaign_plan *plan, size_t p, fracas_json *json)
{
    const fracas_point_row *point = &plan->table->point[p];
    const fracas_forecast *forecast = &plan->forecast[p];
    char hex[FRACAS_HASH_HEX];
    fracas_hash_hex(&point->hash, hex);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "hash", hex);
    fracas_json_object(json, "varied");
    for (size_t v = 0; v < plan->nvaried; v++) {
        const fracas_column *column = &plan->table->column[plan->varied[v]];
        const fracas_value *value = &point->value[plan->varied[v]];
        if (column->text) fracas_json_text(json, column->path, value->text);
        else fracas_json_real(json, column->path, value->real);
    }
    fracas_json_close_object(json);
    fracas_json_integer(json, "replicas", point->replicas);
    fracas_json_integer(json, "replicas_maximum", fracas_point_most(&plan->campaign->point[p]));
    fracas_json_integer(json, "elements", forecast->elements);
    fracas_json_real(json, "time_step", forecast->time_step);
    fracas_json_integer(json, "steps", forecast->steps);
    fracas_json_real(json, "element_steps_per_second", forecast->speed);
    fracas_json_real(json, "seconds", forecast->time);
    fracas_json_real(json, "bytes", forecast->bytes);
    fracas_json_close_object(json);
}

static void print_json(const campaign_plan *plan, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_object(&json, NULL);
    fracas_json_text(&json, "name", plan->campaign->name);
    fracas_json_integer(&json, "jobs", plan->jobs);
    fracas_json_integer(&json, "points", (int64_t)plan->table->npoints);
    fracas_json_integer(&json, "realizations", plan->realizations);
    fracas_json_integer(&json, "realizations_maximum", plan->most);
    fracas_json_real(&json, "seconds", plan->time);
    fracas_json_real(&json, "bytes", plan->bytes);
    fracas_json_array(&json, "point");
    for (size_t p = 0; p < plan->table->npoints; p++) print_json_point(plan, p, &json);
    fracas_json_close_array(&json);
    fracas_json_array(&json, "warnings");
    char text[400];
    for (size_t p = 0; p < plan->table->npoints; p++)
        for (int w = 0; w < WARNINGS; w++)
            if (warning_of(plan, p, w, text, sizeof text)) fracas_json_text(&json, NULL, text);
    fracas_json_close_array(&json);
    fracas_json_close_object(&json);
    fracas_json_end(&json);
}

/* ---- the door ---- */

fracas_err fracas_plan_print(const fracas_campaign *campaign, int jobs, FILE *out, bool json)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (jobs <= 0) jobs = cores > 0 ? (int)cores : 1;
    campaign_plan plan;
    fracas_err err = plan_init(campaign, jobs, &plan);
    if (!err && json) print_json(&plan, out);
    else if (!err) err = print_text(&plan, out);
    if (!err && (fflush(out) != 0 || ferror(out)))
        err = fracas_fail(FRACAS_ENVIRONMENT, "cannot write the plan: %s", strerror(errno));
    plan_clear(&plan);
    return err;
}
