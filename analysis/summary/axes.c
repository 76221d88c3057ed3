/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/study.h"

#include "analysis/data/format.h"
#include "analysis/data/words.h"
#include "base/own.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char rate_path[] = "derived.strain_rate";
static const double decades = 10; /* greatest by least value from which an axis is logarithmic */

void fracas_means_axes_clear(fracas_means_axes *axes)
{
    free(axes->value);
    free(axes->name);
    fracas_columns_clear(&axes->series);
    fracas_columns_clear(&axes->panels);
    fracas_columns_clear(&axes->drawings);
    fracas_columns_clear(&axes->all);
    *axes = (fracas_means_axes){0};
}

/* ---- errors ---- */

/* True for the column of strain rates that no parameter names, as those of rings by velocities. */
static bool has_rates(const fracas_point_table *table, size_t column)
{
    const size_t imposed = fracas_point_table_find(table, "loading.rate");
    bool differ = false;
    if (imposed != SIZE_MAX && fracas_point_table_varies(table, imposed)) return false;
    if (strcmp(table->column[column].path, "derived.strain_rate") != 0) return false;
    for (size_t p = 1; p < table->npoints; p++)
        differ |= table->point[p].value[column].real != table->point[0].value[column].real;
    return differ;
}

/* Names of parameters in which the points differ, "a, b", and of the strain rate. */
static void name_varying(const fracas_point_table *table, char *text, size_t size)
{
    text[0] = '\0';
    for (size_t c = 0; c < table->ncolumns; c++)
        if (fracas_point_table_varies(table, c) || has_rates(table, c))
            fracas_append(text, size, ", ", "%s", table->column[c].path);
    if (!*text) snprintf(text, size, "nothing");
}

static fracas_err unknown(const fracas_analysis *analysis, const char *what, const char *key,
                          bool statistics)
{
    char varying[512];
    name_varying(analysis->table, varying, sizeof varying);
    return fracas_fail(
        FRACAS_USAGE, "%s `%s`: no parameter of the points%s has this name; they differ in %s",
        what, key, statistics ? " and no statistic (summary.json has these)" : "", varying);
}

static fracas_err alike(const fracas_analysis *analysis, const char *what, const char *key)
{
    char varying[512];
    name_varying(analysis->table, varying, sizeof varying);
    return fracas_fail(FRACAS_USAGE, "%s `%s`: it is the same at all points; they differ in %s",
                       what, key, varying);
}

/* ---- the abscissa ---- */

static bool is_number(const fracas_value *value)
{
    return isfinite(value->real);
}

/* Whether two points differ in the column, derived or not. */
static bool varies(const fracas_point_table *table, size_t column)
{
    for (size_t p = 1; p < table->npoints; p++)
        if (!fracas_value_same(&table->point[0].value[column], &table->point[p].value[column]))
            return true;
    return false;
}

/* The rates of the points, in what they are above 0: the abscissa of scaling laws. */
static void take_rate(const fracas_analysis *analysis, fracas_means_axes *axes)
{
    axes->rate = axes->log = true;
    FRACAS_PRINT(axes->key, "%s", rate_path);
    FRACAS_PRINT(axes->words, "strain rate");
    FRACAS_PRINT(axes->label, "strain rate [1/s]");
    for (size_t p = 0; p < analysis->table->npoints; p++)
        axes->value[p] = analysis->point[p].rate > 0 ? analysis->point[p].rate : NAN;
}

/* The unit of the axis, and whether it is logarithmic, from SI values. */
static void scale(const char *unit, size_t npoints, fracas_means_axes *axes)
{
    double least = INFINITY, most = -INFINITY;
    for (size_t p = 0; p < npoints; p++) {
        least = fmin(least, axes->value[p]);
        most = fmax(most, axes->value[p]);
    }
    const double ends[] = {least, most};
    const fracas_prefix prefix = fracas_prefix_in(unit, ends, 2);
    const bool pure = !*unit || !strcmp(unit, "1");
    for (size_t p = 0; p < npoints; p++) axes->value[p] *= prefix.factor;
    axes->log = least > 0 && most >= decades * least;
    if (pure) FRACAS_PRINT(axes->label, "%s", axes->words);
    else FRACAS_PRINT(axes->label, "%.64s [%s%.16s]", axes->words, prefix.sign, unit);
}

/* Texts become their numbers in the order in which they come first. */
static fracas_err take_texts(const fracas_analysis *analysis, size_t column,
                             fracas_means_axes *axes)
{
    const fracas_point_table *table = analysis->table;
    axes->name = calloc(table->npoints + 1, sizeof *axes->name);
    if (!axes->name) return fracas_no_memory("the axes of a figure");
    for (size_t p = 0; p < table->npoints; p++) {
        const char *text = table->point[p].value[column].text;
        size_t n = 0;
        if (!*text) continue;
        while (n < axes->nnames && strcmp(axes->name[n], text) != 0) n++;
        if (n == axes->nnames) axes->name[axes->nnames++] = text;
        axes->value[p] = (double)n + 1;
    }
    FRACAS_PRINT(axes->label, "%s", axes->words);
    return FRACAS_OK;
}

static fracas_err take_column(const fracas_analysis *analysis, size_t column,
                              fracas_means_axes *axes)
{
    const fracas_point_table *table = analysis->table;
    FRACAS_PRINT(axes->key, "%s", table->column[column].path);
    FRACAS_PRINT(axes->words, "%s", fracas_column_words(table, column).text);
    if (table->column[column].text) return take_texts(analysis, column, axes);
    for (size_t p = 0; p < table->npoints; p++) axes->value[p] = table->point[p].value[column].real;
    scale(table->column[column].unit, table->npoints, axes);
    return FRACAS_OK;
}

static void take_statistic(const fracas_analysis *analysis, const char *key,
                           const fracas_ordinate *of, fracas_means_axes *axes)
{
    double low, high;
    for (size_t p = 0; p < analysis->table->npoints; p++)
        axes->value[p] = fracas_ordinate_at(of, &analysis->point[p], &low, &high);
    FRACAS_PRINT(axes->key, "%s", key);
    FRACAS_PRINT(axes->words, "%s%.64s", of->over ? "mean over replicas of the " : "", of->words);
    scale(of->unit, analysis->table->npoints, axes);
}

static bool equals_rate(const fracas_analysis *analysis, size_t column)
{
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const double value = analysis->table->point[p].value[column].real,
                     rate = analysis->point[p].rate;
        if (value != rate && !(isnan(value) && isnan(rate))) return false;
    }
    return true;
}

static fracas_err take_key(const fracas_analysis *analysis, const char *key,
                           fracas_means_axes *axes)
{
    const size_t column = fracas_point_table_find(analysis->table, key);
    fracas_ordinate of;
    if (column == SIZE_MAX) {
        if (!fracas_ordinate_find(key, strlen(key), &of))
            return unknown(analysis, "x of the figures,", key, true);
        take_statistic(analysis, key, &of, axes);
        return FRACAS_OK;
    }
    if (!varies(analysis->table, column)) return alike(analysis, "x of the figures,", key);
    if (!equals_rate(analysis, column)) return take_column(analysis, column, axes);
    take_rate(analysis, axes);
    return FRACAS_OK;
}

/* Points with two rates above 0, or one at least. */
static size_t count_rates(const fracas_analysis *analysis)
{
    double first = NAN;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const double rate = analysis->point[p].rate;
        if (!(rate > 0) || !isfinite(rate)) continue;
        if (isnan(first)) first = rate;
        else if (rate != first) return 2;
    }
    return isnan(first) ? 0 : 1;
}

/* The first column in the names of points, SIZE_MAX if there is none. */
static size_t first_shown(const fracas_analysis *analysis, bool text)
{
    const fracas_point_table *table = analysis->table;
    for (size_t i = 0; i < analysis->shown.count; i++) {
        const size_t column = analysis->shown.column[i];
        size_t numbers = 0;
        if (table->column[column].text != text || !varies(table, column)) continue;
        for (size_t p = 0; p < table->npoints && !text; p++)
            numbers += is_number(&table->point[p].value[column]);
        if (text || numbers > 1) return column;
    }
    return SIZE_MAX;
}

static fracas_err choose(const fracas_analysis *analysis, fracas_means_axes *axes)
{
    const size_t rates = count_rates(analysis), number = first_shown(analysis, false),
                 text = first_shown(analysis, true);
    if (rates > 1 || (rates > 0 && number == SIZE_MAX && text == SIZE_MAX))
        take_rate(analysis, axes);
    else if (number != SIZE_MAX) return take_column(analysis, number, axes);
    else if (text != SIZE_MAX) return take_column(analysis, text, axes);
    return FRACAS_OK;
}

/* ---- series, panels and drawings ---- */

/* True if points of one abscissa, alike in the columns, differ in this one. */
static bool parts(const fracas_analysis *analysis, const fracas_means_axes *axes, size_t column,
                  const fracas_columns *columns)
{
    const fracas_point_table *table = analysis->table;
    for (size_t p = 0; p < table->npoints; p++)
        for (size_t q = 0; q < p; q++)
            if (axes->value[p] == axes->value[q] &&
                !fracas_value_same(&table->point[p].value[column],
                                   &table->point[q].value[column]) &&
                fracas_columns_same(table, columns, p, q))
                return true;
    return false;
}

static fracas_err with_room(const fracas_analysis *analysis, fracas_columns *columns)
{
    *columns = (fracas_columns){
        .column = malloc((analysis->table->ncolumns + 1) * sizeof *columns->column)};
    return columns->column ? FRACAS_OK : fracas_no_memory("the series of a figure");
}

/* Columns by keys of a user; SIZE_MAX: none. */
typedef struct {
    size_t series, panels;
} wanted;

static void add_column(size_t column, fracas_columns *to)
{
    if (column != SIZE_MAX) to->column[to->count++] = column;
}

/* How many combinations of values the columns have. */
static size_t classes_of(const fracas_analysis *analysis, const fracas_columns *columns,
                         size_t *class)
{
    return fracas_columns_classes(analysis->table, columns, class);
}

static size_t values_of(const fracas_analysis *analysis, size_t column, size_t *class)
{
    const fracas_columns one = {1, &column};
    return classes_of(analysis, &one, class);
}

/* All columns that make series, panels or drawings. */
static fracas_err find_columns(const fracas_analysis *analysis, const wanted *by,
                               fracas_means_axes *axes)
{
    if (axes->rate && by->series == SIZE_MAX && by->panels == SIZE_MAX)
        return fracas_columns_without_rate(analysis->table, &analysis->shown, &axes->all);
    TRY(with_room(analysis, &axes->all));
    add_column(by->series, &axes->all);
    add_column(by->panels, &axes->all);
    for (size_t i = 0; i < analysis->shown.count; i++) {
        const size_t column = analysis->shown.column[i];
        if (column != by->series && column != by->panels &&
            parts(analysis, axes, column, &axes->all))
            add_column(column, &axes->all);
    }
    return FRACAS_OK;
}

/* The first of all columns with 2 to `most` values, other than this one; SIZE_MAX: none. */
static size_t few_values(const fracas_analysis *analysis, const fracas_means_axes *axes,
                         size_t other, size_t most, size_t *class)
{
    for (size_t i = 0; i < axes->all.count; i++) {
        const size_t column = axes->all.column[i];
        const size_t n = column == other ? 0 : values_of(analysis, column, class);
        if (n > 1 && n <= most) return column;
    }
    return SIZE_MAX;
}

/* True if each value of a column comes with each of the others. */
static bool combined(const fracas_analysis *analysis, const fracas_means_axes *axes, size_t *class)
{
    size_t product = 1;
    for (size_t i = 0; i < axes->all.count && product <= analysis->table->npoints; i++)
        product *= values_of(analysis, axes->all.column[i], class);
    return product == classes_of(analysis, &axes->all, class);
}

/* Completes what a user wants; false: all columns make series. */
static bool choose_parts(const fracas_analysis *analysis, const fracas_means_axes *axes,
                         size_t *class, wanted *by)
{
    const size_t count = axes->all.count;
    const bool few = count == 0 || classes_of(analysis, &axes->all, class) <= FRACAS_MEANS_SERIES,
               asked = by->series != SIZE_MAX || by->panels != SIZE_MAX;
    if (!asked && few && (count < 2 || !combined(analysis, axes, class))) return false;
    if (count == 1 && by->panels == SIZE_MAX && !few) {
        *by = (wanted){SIZE_MAX, axes->all.column[0]};
        return true;
    }
    if (by->series == SIZE_MAX)
        by->series = few_values(analysis, axes, by->panels, FRACAS_MEANS_SERIES, class);
    if (by->series == SIZE_MAX) /* in several drawings */
        by->series = few_values(analysis, axes, by->panels, SIZE_MAX, class);
    if (by->panels == SIZE_MAX)
        by->panels = few_values(analysis, axes, by->series, FRACAS_MEANS_PANELS, class);
    return true;
}

static fracas_err part_columns(const fracas_analysis *analysis, wanted by, size_t *class,
                               fracas_means_axes *axes)
{
    const bool apart = choose_parts(analysis, axes, class, &by);
    TRY(with_room(analysis, &axes->series));
    TRY(with_room(analysis, &axes->panels));
    TRY(with_room(analysis, &axes->drawings));
    for (size_t i = 0; i < axes->all.count; i++) {
        const size_t column = axes->all.column[i];
        add_column(column, !apart || column == by.series ? &axes->series
                           : column == by.panels         ? &axes->panels
                                                         : &axes->drawings);
    }
    return FRACAS_OK;
}

static fracas_err find_wanted(const fracas_analysis *analysis, const char *what, const char *key,
                              size_t *column)
{
    *column = SIZE_MAX;
    if (!key) return FRACAS_OK;
    *column = fracas_point_table_find(analysis->table, key);
    if (*column == SIZE_MAX) return unknown(analysis, what, key, false);
    return varies(analysis->table, *column) ? FRACAS_OK : alike(analysis, what, key);
}

fracas_err fracas_analysis_check_axes(const char *x, const char *series, const char *panels)
{
    const struct {
        const char *a, *b, *names;
    } pair[] = {{x, series, "x and series"},
                {x, panels, "x and panels"},
                {series, panels, "series and panels"}};
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++)
        if (pair[i].a && pair[i].b && !strcmp(pair[i].a, pair[i].b))
            return fracas_fail(FRACAS_USAGE, "`%s` is both %s of the figures; give another",
                               pair[i].a, pair[i].names);
    return FRACAS_OK;
}

fracas_err fracas_means_axes_create(const fracas_analysis *analysis, const char *x,
                                    const char *series, const char *panels, fracas_means_axes *axes)
{
    wanted by;
    const size_t npoints = analysis->table->npoints;
    *axes = (fracas_means_axes){.value = calloc(npoints + 1, sizeof *axes->value)};
    OWNED size_t *class = calloc(npoints + 1, sizeof *class);
    if (!axes->value || !class) return fracas_no_memory("the axes of a figure");
    for (size_t p = 0; p < npoints; p++) axes->value[p] = NAN;
    TRY(find_wanted(analysis, "series of the figures,", series, &by.series));
    TRY(find_wanted(analysis, "panels of the figures,", panels, &by.panels));
    TRY(fracas_analysis_check_axes(x, series, panels));
    TRY(x ? take_key(analysis, x, axes) : choose(analysis, axes));
    TRY(find_columns(analysis, &by, axes));
    return part_columns(analysis, by, class, axes);
}
