/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/columns.h"

#include "analysis/data/format.h"
#include "analysis/data/words.h"
#include "base/own.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char strain_rate_path[] = "derived.strain_rate", imposed_rate_path[] = "loading.rate";
static const char radius_path[] = "geometry.radius";

/* Columns from which the strain rate is made, each with its type of loading. The radius divides
 * velocities, but it makes series: the size over v/R may or may not be one curve. */
static bool makes_rate(const char *path)
{
    static const char *const maker[] = {imposed_rate_path, "loading.radial", "loading.velocity"};
    for (size_t i = 0; i < sizeof maker / sizeof *maker; i++)
        if (!strcmp(path, maker[i])) return true;
    return false;
}

double fracas_columns_real(const fracas_point_table *table, size_t point, const char *path)
{
    size_t column = fracas_point_table_find(table, path);
    return column == SIZE_MAX ? NAN : table->point[point].value[column].real;
}

bool fracas_columns_surface(const fracas_point_table *table, size_t point)
{
    return fracas_columns_real(table, point, "derived.surface") == 1;
}

/* Causes come before numerics: a zipped sweep is named by its physical parameter, cases by their
 * names. The radius comes before the velocities: of both swept together the radius stays, and makes
 * series. */
static int rank_of(const char *path)
{
    static const char *const order[] = {imposed_rate_path, radius_path, "case",     "loading",
                                        "material",        "cohesive",  "strength", "geometry",
                                        "model",           "mesh",      "time"};
    const int n = (int)(sizeof order / sizeof *order);
    for (int i = 0; i < n; i++) {
        size_t length = strlen(order[i]);
        if (!strncmp(path, order[i], length) && strchr("._", path[length])) return i;
    }
    return strncmp(path, "derived.", strlen("derived.")) ? n : -1;
}

static bool same_value(const fracas_point_table *table, size_t column, size_t a, size_t b)
{
    return fracas_value_same(&table->point[a].value[column], &table->point[b].value[column]);
}

bool fracas_columns_same(const fracas_point_table *table, const fracas_columns *columns, size_t a,
                         size_t b)
{
    for (size_t i = 0; i < columns->count; i++)
        if (!same_value(table, columns->column[i], a, b)) return false;
    return true;
}

/* True if some two points of one class differ in the column. class[p] is the first point of p's
 * class. */
static bool refine(const fracas_point_table *table, size_t column, size_t *class, size_t *scratch)
{
    bool parted = false;
    for (size_t p = 0; p < table->npoints; p++) {
        scratch[p] = p;
        for (size_t q = class[p]; q < p; q++) {
            if (class[q] != class[p] || !same_value(table, column, p, q)) continue;
            scratch[p] = scratch[q];
            break;
        }
        if (scratch[p] != class[p]) parted = true;
    }
    memcpy(class, scratch, table->npoints * sizeof *class);
    return parted;
}

static void select_columns(const fracas_point_table *table, size_t *class, size_t *scratch,
                           fracas_columns *columns)
{
    int last = 0;
    for (size_t c = 0; c < table->ncolumns; c++)
        if (rank_of(table->column[c].path) > last) last = rank_of(table->column[c].path);
    /* Within a section names come first: a law's name tells points apart better than a parameter of
     * one law. */
    for (int place = 0; place < 2 * (last + 1); place++)
        for (size_t c = 0; c < table->ncolumns; c++)
            if (rank_of(table->column[c].path) == place / 2 &&
                table->column[c].text == (place % 2 == 0) && refine(table, c, class, scratch))
                columns->column[columns->count++] = c;
    for (size_t c = 0; c < table->ncolumns && columns->count == 0 && table->npoints > 0; c++)
        if (makes_rate(table->column[c].path) && isfinite(table->point[0].value[c].real))
            columns->column[columns->count++] = c;
}

fracas_err fracas_columns_create(const fracas_point_table *table, fracas_columns *columns)
{
    OWNED size_t *class = calloc(2 * table->npoints + 1, sizeof *class); /* all of class 0 */
    *columns = (fracas_columns){.column = malloc((table->ncolumns + 1) * sizeof *columns->column)};
    if (!columns->column || !class) return fracas_no_memory("the columns of the table");
    select_columns(table, class, class + table->npoints, columns);
    return FRACAS_OK;
}

bool fracas_columns_part(const fracas_point_table *table, size_t column,
                         const fracas_columns *columns)
{
    for (size_t p = 0; p < table->npoints; p++)
        for (size_t q = 0; q < p; q++)
            if (!same_value(table, column, p, q) && fracas_columns_same(table, columns, p, q))
                return true;
    return false;
}

size_t fracas_columns_classes(const fracas_point_table *table, const fracas_columns *columns,
                              size_t *class)
{
    size_t count = 0;
    for (size_t p = 0; p < table->npoints; p++) {
        size_t like = 0;
        while (like < p && !fracas_columns_same(table, columns, p, like)) like++;
        class[p] = like < p ? class[like] : count++;
    }
    return count;
}

fracas_err fracas_columns_without_rate(const fracas_point_table *table,
                                       const fracas_columns *columns, fracas_columns *others)
{
    *others = (fracas_columns){.column = malloc((columns->count + 1) * sizeof *others->column)};
    if (!others->column) return fracas_no_memory("the series of a figure");
    for (size_t i = 0; i < columns->count; i++)
        if (!makes_rate(table->column[columns->column[i]].path))
            others->column[others->count++] = columns->column[i];
    const size_t model = fracas_point_table_find(table, "model");
    if (model != SIZE_MAX && fracas_columns_part(table, model, others))
        others->column[others->count++] = model;
    return FRACAS_OK;
}

fracas_err fracas_columns_with_rate(const fracas_point_table *table, const fracas_columns *columns,
                                    fracas_columns *with)
{
    *with = (fracas_columns){.column = malloc((columns->count + 1) * sizeof *with->column)};
    if (!with->column) return fracas_no_memory("the columns of the table");
    bool imposed = false, radius = false, velocity = false;
    for (size_t i = 0; i < columns->count; i++) {
        const char *path = table->column[columns->column[i]].path;
        if (!strcmp(path, imposed_rate_path)) imposed = true;
        else if (!strcmp(path, radius_path)) radius = true;
        else if (makes_rate(path)) velocity = true;
        with->column[with->count++] = columns->column[i];
    }
    size_t rate = fracas_point_table_find(table, strain_rate_path);
    if (rate != SIZE_MAX && (velocity || (radius && !imposed))) with->column[with->count++] = rate;
    return FRACAS_OK;
}

void fracas_columns_clear(fracas_columns *columns)
{
    free(columns->column);
    *columns = (fracas_columns){0};
}

static const char *last_part(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot ? dot + 1 : path;
}

const char *fracas_columns_name(const fracas_point_table *table, const fracas_columns *columns,
                                size_t i)
{
    const char *path = table->column[columns->column[i]].path;
    if (!strcmp(path, strain_rate_path)) return "strain rate";
    for (size_t j = 0; j < columns->count; j++)
        if (j != i && !strcmp(last_part(path), last_part(table->column[columns->column[j]].path)))
            return path;
    return last_part(path);
}

void fracas_columns_value(const fracas_point_table *table, size_t column, size_t point,
                          double factor, char *text, size_t size)
{
    const fracas_value *value = &table->point[point].value[column];
    if (table->column[column].text) snprintf(text, size, "%s", *value->text ? value->text : "-");
    else fracas_format_short(value->real * factor, text, size);
}

static bool is_absent(const fracas_point_table *table, size_t column, size_t point)
{
    return fracas_value_absent(&table->point[point].value[column]);
}

static bool takes_prefix(const char *unit)
{
    static const char *const plain[] = {"m", "s", "Pa", "J"};
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (!strcmp(unit, plain[i])) return true;
    return false;
}

/* The column in words, or its path where another of the columns has the same words. */
static fracas_parameter_words words_of(const fracas_point_table *table,
                                       const fracas_columns *columns, size_t i)
{
    fracas_parameter_words words = fracas_column_words(table, columns->column[i]);
    for (size_t j = 0; j < columns->count; j++)
        if (j != i && !strcmp(words.text, fracas_column_words(table, columns->column[j]).text)) {
            FRACAS_PRINT(words.text, "%.95s", table->column[columns->column[i]].path);
            break;
        }
    return words;
}

/* A point is named by the values it has, unless it has none: a load by its own keys, not by the
 * lack of others. */
void fracas_columns_label(const fracas_point_table *table, const fracas_columns *columns,
                          size_t point, char *text, size_t size)
{
    size_t present = 0;
    text[0] = '\0';
    for (size_t i = 0; i < columns->count; i++)
        present += !is_absent(table, columns->column[i], point);
    for (size_t i = 0; i < columns->count; i++) {
        const fracas_column *column = &table->column[columns->column[i]];
        const bool absent = is_absent(table, columns->column[i], point);
        if (absent && present > 0) continue;
        char value[64];
        fracas_prefix prefix = {1, "", ""};
        if (takes_prefix(column->unit))
            prefix = fracas_prefix_for(&table->point[point].value[columns->column[i]].real, 1);
        fracas_columns_value(table, columns->column[i], point, prefix.factor, value, sizeof value);
        bool unit = !column->text && !absent && strcmp(column->unit, "1");
        fracas_append(text, size, ", ", "%s %s%s%s%s", words_of(table, columns, i).text, value,
                      unit ? " " : "", prefix.symbol, unit ? column->unit : "");
    }
}

/* True if two points have different values. A missing value, as of another law, is no difference.
 */
static bool differs(const fracas_point_table *table, size_t column)
{
    size_t first = 0;
    while (first < table->npoints && is_absent(table, column, first)) first++;
    for (size_t p = first + 1; p < table->npoints; p++)
        if (!is_absent(table, column, p) && !same_value(table, column, p, first)) return true;
    return false;
}

bool fracas_columns_serves(const char *path)
{
    return !strncmp(path, "mesh.", 5) || !strncmp(path, "time.", 5);
}

void fracas_columns_beside(const fracas_point_table *table, const fracas_columns *columns,
                           char *text, size_t size)
{
    text[0] = '\0';
    for (size_t c = 0; c < table->ncolumns; c++) {
        const char *path = table->column[c].path;
        bool known = fracas_columns_serves(path) || rank_of(path) < 0;
        for (size_t i = 0; i < columns->count; i++) known = known || columns->column[i] == c;
        if (!known && differs(table, c)) fracas_append(text, size, ", ", "%s", path);
    }
}
