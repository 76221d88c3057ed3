/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/format.h"
#include "analysis/export/tables.h"
#include "analysis/scaling/scaling.h"
#include "analysis/summary/effects.h"
#include "base/param.h"
#include "base/own.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const slope_legend[] = {
    "slope: of log(mean size) against log(strain rate), weighted least squares, each point by the "
    "standard error of its mean over replicas, from one relative variance pooled over the points "
    "that have less than eight; points where no body came apart are left out; after it the half "
    "width of its 95 % interval (Student's t with points - 2 degrees of freedom).",
    "chi2/dof: scatter of the points about the line over what their errors explain; where it is "
    "above 1 the interval is wider by its square root. Mott, Grady: exponents of the theories, of "
    "bars and rings.",
    "series mixed: the line is through points that differ in more than the strain rate.",
    NULL,
};
static const char *const count_slope_legend[] = {
    "slope: as above, of the mean number of fragments. Mott, Grady: minus the exponents of the "
    "size.",
    NULL,
};
static const char *const window_legend[] = {
    "slope: of log(mean size) against log(strain rate) between two neighbouring rates; after it "
    "the half width of its 95 % interval, from the standard errors of the two means (Student's t, "
    "degrees of freedom by Welch and Satterthwaite).",
    "from, to: the rates, and as parts of the characteristic rate edot0 of the material.",
    NULL,
};
static const char *const crossover_legend[] = {
    "s = s_q/(1 + (rate/crossover)^k), by least squares of log(mean size), weighted as slopes are: "
    "s_q is the size at low rates (exponent 0), -k the exponent at high rates. In brackets 95 % "
    "intervals by the parametric bootstrap: means drawn again by their standard errors, Student's. "
    "/s0, /edot0: as parts of the characteristic size and rate of the material.",
    "chi2/dof: scatter of the points about the curve over what their errors explain; where it is "
    "above 1 the intervals are wider by its square root. At least five rates with the bend among "
    "them are needed; else the last column says what is missing.",
    NULL,
};
static const char *const motion_legend[] = {
    "Velocities of the fragments' centres of mass at the end, each fragment weighed by its mass; "
    "means over replicas with their 95 % intervals, n: replicas with two fragments or more. "
    "outward: mean velocity along the direction from the centre of the ring. scatter: its standard "
    "deviation over fragments.",
    "along: root mean square of the velocity along the ring. spin: mean |angular velocity| about "
    "the centre of mass, with the moment of inertia of an arc.",
    NULL,
};

static const char *const effect_each_legend[] = {
    "From the first value of a parameter to the last (of texts, to the next), with all others as "
    "in "
    "`setting`: the 95 % interval of each change, too wide with common random numbers. Where two "
    "intervals lie apart, the effect depends on what differs in their settings.",
    NULL,
};

static const char *const effect_legend[] = {
    "From one value of a parameter to the next, and from the first to the last, with all other "
    "parameters the same: change of the mean number of fragments and of the mean size, with 95 % "
    "intervals: the geometric mean of the ratios in all settings of the others (Student's t, "
    "degrees of freedom by Welch and Satterthwaite). least to most: in single settings, by their "
    "scatter alone, too; effects.csv has each with its interval.",
    "An interval without 0 shows an effect. `with`: these change along, as in a zipped sweep, and "
    "share the effect; mesh and time may change along as well. Parameters of more than twelve "
    "values are left out. Settings with common random numbers are not independent: no interval "
    "over several.",
    NULL,
};

/* ---- columns ---- */

#define AT(member) offsetof(fracas_size_slope, member)
static const fracas_table_column slope_column[] = {
    {"slope", "", FRACAS_CELL_PLUS_MINUS, AT(slope.slope), 0, AT(slope.half_width)},
    {"Mott", "", FRACAS_CELL_NUMBER, AT(mott)},
    {"Grady", "", FRACAS_CELL_NUMBER, AT(grady), 3},
    {"points", "", FRACAS_CELL_INTEGER, AT(slope.n)},
    {"chi2/dof", "", FRACAS_CELL_NUMBER, AT(slope.chi2), 2, AT(slope.freedom)},
    {"series", "", FRACAS_CELL_TEXT, AT(name)},
};
#undef AT

static const char edot0[] = "/\u03b5\u0307\u2080";

#define AT(member) offsetof(fracas_size_window, member)
static const fracas_table_column window_column[] = {
    {"slope", "", FRACAS_CELL_PLUS_MINUS, AT(window.slope), 0, AT(window.half_width)},
    {"from", "[1/s]", FRACAS_CELL_NUMBER, AT(rate[0])},
    {"to", "[1/s]", FRACAS_CELL_NUMBER, AT(rate[1])},
    {"from", edot0, FRACAS_CELL_NUMBER, AT(normalised[0]), 3},
    {"to", edot0, FRACAS_CELL_NUMBER, AT(normalised[1]), 3},
    {"series", "", FRACAS_CELL_TEXT, AT(name)},
};
#undef AT

/* A series of one rate has nothing to cross over from. */
static bool has_rates(const void *row)
{
    return ((const fracas_size_crossover *)row)->n > 1;
}

static void series_text(const fracas_analysis *analysis, size_t index, const void *row, char *text)
{
    const fracas_size_crossover *of = row;
    (void)analysis, (void)index;
    snprintf(text, FRACAS_CELL, "%.60s%s%.60s", of->name, *of->reason ? ": " : "", of->reason);
}

#define AT(member) offsetof(fracas_size_crossover, member)
static const fracas_table_column crossover_column[] = {
    {"crossover", "[1/s]", FRACAS_CELL_INTERVAL, AT(rate)},
    {"crossover", edot0, FRACAS_CELL_INTERVAL, AT(rate_normalised)},
    {"s_q", "m", FRACAS_CELL_INTERVAL, AT(size), .prefixed = true},
    {"s_q", "/s\u2080", FRACAS_CELL_INTERVAL, AT(size_normalised)},
    {"exponent", "", FRACAS_CELL_INTERVAL, AT(exponent)},
    {"points", "", FRACAS_CELL_INTEGER, AT(n)},
    {"chi2/dof", "", FRACAS_CELL_NUMBER, AT(chi2), 2, AT(freedom)},
    {"series", "", FRACAS_CELL_FORMAT, .format = series_text},
};
#undef AT

static bool is_ring(const void *row)
{
    return ((const fracas_point_statistics *)row)->radius > 0;
}

#define AT(member) offsetof(fracas_point_statistics, member)
static const fracas_table_column motion_column[] = {
    {"n", "", FRACAS_CELL_INTEGER, AT(radial_velocity.n)},
    {"outward", "[m/s]", FRACAS_CELL_ESTIMATE, AT(radial_velocity)},
    {"scatter", "[m/s]", FRACAS_CELL_ESTIMATE, AT(radial_scatter)},
    {"along", "[m/s]", FRACAS_CELL_ESTIMATE, AT(circumferential_velocity)},
    {"spin", "rad/s", FRACAS_CELL_ESTIMATE, AT(angular_velocity), .prefixed = true},
    {"point", "", FRACAS_CELL_FORMAT, .format = fracas_cell_label},
};
#undef AT

/* "-3.9 % (-6.8 to -0.9)" */
static void change_text(const fracas_change *change, char *text)
{
    if (isnan(change->value)) snprintf(text, FRACAS_CELL, "-");
    else if (isnan(change->low)) snprintf(text, FRACAS_CELL, "%+.1f %%", 100 * change->value);
    else
        snprintf(text, FRACAS_CELL, "%+.1f %% (%+.1f to %+.1f)", 100 * change->value,
                 100 * change->low, 100 * change->high);
}

static void range_text(const fracas_change *change, int64_t settings, char *text)
{
    if (settings < 2 || isnan(change->least)) snprintf(text, FRACAS_CELL, "-");
    else snprintf(text, FRACAS_CELL, "%+.1f to %+.1f %%", 100 * change->least, 100 * change->most);
}

#define EFFECT_TEXT(name, print)                                                                 \
    static void name(const fracas_analysis *analysis, size_t index, const void *row, char *text) \
    {                                                                                            \
        const fracas_effect *of = row;                                                           \
        (void)analysis, (void)index;                                                             \
        print;                                                                                   \
    }
EFFECT_TEXT(count_text, change_text(&of->count, text))
EFFECT_TEXT(count_range, range_text(&of->count, of->settings, text))
EFFECT_TEXT(size_text, change_text(&of->size, text))
EFFECT_TEXT(size_range, range_text(&of->size, of->settings, text))

/* Rows of single settings are in effects.csv. */
static bool is_whole(const void *row)
{
    return !*((const fracas_effect *)row)->at;
}

static bool is_each(const void *row)
{
    return !is_whole(row) && ((const fracas_effect *)row)->headline;
}

#define AT(member) offsetof(fracas_effect, member)
static const fracas_table_column effect_each_column[] = {
    {"parameter", "", FRACAS_CELL_TEXT, AT(words)},
    {"from", "", FRACAS_CELL_TEXT, AT(from)},
    {"to", "", FRACAS_CELL_TEXT, AT(to)},
    {"count", "", FRACAS_CELL_FORMAT, .format = count_text},
    {"size", "", FRACAS_CELL_FORMAT, .format = size_text},
    {"setting", "", FRACAS_CELL_TEXT, AT(at)},
};
static const fracas_table_column effect_column[] = {
    {"parameter", "", FRACAS_CELL_TEXT, AT(words)},
    {"from", "", FRACAS_CELL_TEXT, AT(from)},
    {"to", "", FRACAS_CELL_TEXT, AT(to)},
    {"settings", "", FRACAS_CELL_INTEGER, AT(settings)},
    {"count", "", FRACAS_CELL_FORMAT, .format = count_text},
    {"least to most", "", FRACAS_CELL_FORMAT, .format = count_range},
    {"size", "", FRACAS_CELL_FORMAT, .format = size_text},
    {"least to most", "", FRACAS_CELL_FORMAT, .format = size_range},
};
#undef AT

/* A function of scaling.h as the `list` of a table. */
#define LIST(name, type, made)                                                                 \
    static fracas_err list_##name(const fracas_analysis *analysis, void **rows, size_t *count) \
    {                                                                                          \
        type *list = NULL;                                                                     \
        const fracas_err err = made;                                                           \
        *rows = list;                                                                          \
        return err;                                                                            \
    }
LIST(slopes, fracas_size_slope, fracas_size_slopes(analysis, &list, count))
LIST(count_slopes, fracas_size_slope, fracas_count_slopes(analysis, true, &list, count))
LIST(count_large_slopes, fracas_size_slope, fracas_count_slopes(analysis, false, &list, count))
LIST(windows, fracas_size_window, fracas_size_windows(analysis, &list, count))
LIST(crossovers, fracas_size_crossover, fracas_size_crossovers(analysis, true, &list, count))
LIST(effects, fracas_effect, fracas_effects(analysis, &list, count))

#define COLUMNS(name) name##_legend, name##_column, FRACAS_COUNT(name##_column)
const fracas_side_table fracas_side_tables[FRACAS_SIDE_TABLES] = {
    {"slopes", "Slope of log(mean size) against log(strain rate)", COLUMNS(slope),
     sizeof(fracas_size_slope), NULL, list_slopes},
    {"count-slopes", "Slope of log(mean number of fragments) against log(strain rate)",
     count_slope_legend, slope_column, FRACAS_COUNT(slope_column), sizeof(fracas_size_slope), NULL,
     list_count_slopes},
    {"count-large-slopes",
     "Slope of log(mean number of fragments without dust) against log(strain rate)",
     count_slope_legend, slope_column, FRACAS_COUNT(slope_column), sizeof(fracas_size_slope), NULL,
     list_count_large_slopes},
    {"windows", "Slope from each strain rate to the next", COLUMNS(window),
     sizeof(fracas_size_window), NULL, list_windows},
    {"crossovers", "Crossover from the quasi-static to the dynamic regime", COLUMNS(crossover),
     sizeof(fracas_size_crossover), has_rates, list_crossovers},
    {"motion", "Velocities of the fragments of rings at the end", COLUMNS(motion),
     sizeof(fracas_point_statistics), is_ring, NULL},
    {"effects", "Change of the means with each parameter", COLUMNS(effect), sizeof(fracas_effect),
     is_whole, list_effects},
    {"effects-each", "Change of the means over the range of each parameter, in each setting",
     COLUMNS(effect_each), sizeof(fracas_effect), is_each, list_effects},
};

fracas_err fracas_side_table_create(const fracas_analysis *analysis, fracas_side_table_name name,
                                    fracas_result_table *table)
{
    const fracas_side_table *of = &fracas_side_tables[name];
    OWNED void *list = NULL;
    fracas_table_rows rows = {analysis->point, analysis->table->npoints, of->size, analysis,
                              of->keep};
    if (of->list) {
        TRY(of->list(analysis, &list, &rows.count));
        rows.first = list;
    }
    return fracas_table_make(of->column, of->columns, &rows, true, table);
}

/* "; in single settings +51.0 to +119.5 %" */
static void range_words(const fracas_change *change, int64_t settings, char *text, size_t size)
{
    char range[FRACAS_CELL];
    range_text(change, settings, range);
    if (strcmp(range, "-") == 0) text[0] = '\0';
    else snprintf(text, size, ", in single settings %s", range);
}

fracas_err fracas_effects_say(const fracas_analysis *analysis, fracas_effect_line *say,
                              void *context)
{
    OWNED fracas_effect *effect = NULL;
    size_t count;
    if (!fracas_effects_shown(analysis)) return FRACAS_OK;
    TRY(fracas_effects(analysis, &effect, &count));
    for (size_t i = 0; i < count; i++) {
        const fracas_effect *of = &effect[i];
        char number[FRACAS_CELL], size[FRACAS_CELL], range[2][2 * FRACAS_CELL], line[2048];
        if (!of->headline || !is_whole(of)) continue;
        change_text(&of->count, number);
        change_text(&of->size, size);
        range_words(&of->count, of->settings, range[0], sizeof range[0]);
        range_words(&of->size, of->settings, range[1], sizeof range[1]);
        snprintf(line, sizeof line, "%s, %s to %s: count %s%s; size %s%s", of->words, of->from,
                 of->to, number, range[0], size, range[1]);
        say(context, line);
    }
    return FRACAS_OK;
}
