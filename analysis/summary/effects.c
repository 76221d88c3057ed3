/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/effects.h"

#include "analysis/data/words.h"
#include "base/own.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CHANGE(key, doc, member) FRACAS_FIELD(fracas_change, NUMBER, key, "1", doc, member)
static const fracas_field change_field[] = {
    CHANGE("value", "geometric mean over the settings of %s at `to` / at `from`, less 1", value),
    CHANGE("low", "lower end of its 95 % interval", low),
    CHANGE("high", "upper end of its 95 % interval", high),
    CHANGE("least", "the least change in one setting", least),
    CHANGE("most", "the greatest change in one setting", most),
};
static const fracas_fields change_fields = FRACAS_FIELDS(change_field);

static const fracas_field effect_field[] = {
    FRACAS_FIELD(fracas_effect, CHARS, "parameter", "", "path of the parameter", key),
    FRACAS_FIELD(fracas_effect, CHARS, "from", "", "one of its values, with its unit", from),
    FRACAS_FIELD(fracas_effect, CHARS, "to", "", "the next one", to),
    FRACAS_FIELD(fracas_effect, CHARS, "at", "",
                 "setting: values of the other parameters; empty: all settings", at),
    FRACAS_FIELD(fracas_effect, INTEGER, "settings", "1",
                 "settings, each a pair of points that differ in nothing else", settings),
    FRACAS_FIELD_OF(fracas_effect, change_fields, "count_change", "1",
                    "the mean number of fragments", count),
    FRACAS_FIELD_OF(fracas_effect, change_fields, "size_change", "1", "the mean fragment size",
                    size),
};
const fracas_fields fracas_effect_fields = FRACAS_FIELDS(effect_field);

/* A parameter, its values by a point each, and the other parameters: those that stay the same in a
 * setting, and those that change with it at all points, as in a zipped sweep. */
typedef struct {
    const fracas_analysis *analysis;
    size_t column;
    size_t nlevels, level[FRACAS_MOST_LEVELS + 1];
    fracas_columns others, partners;
    size_t room, count;
    fracas_effect *effect;
} making;

/* ---- the other parameters ---- */

static const fracas_value *value_at(const making *of, size_t point)
{
    return &of->analysis->table->point[point].value[of->column];
}

/* A value that one of the points has not, as the parameter of another law, is no difference. */
static bool alike(const making *of, size_t column, size_t a, size_t b)
{
    const fracas_point_table *table = of->analysis->table;
    const fracas_value *x = &table->point[a].value[column], *y = &table->point[b].value[column];
    return fracas_value_absent(x) || fracas_value_absent(y) || fracas_value_same(x, y);
}

/* True if points alike in the parameter are alike in this column, and others are not: a column that
 * some points lack may be alike wherever it is. */
static bool goes_along(const making *of, size_t column)
{
    const size_t npoints = of->analysis->table->npoints;
    bool differs = false;
    for (size_t p = 0; p < npoints; p++)
        for (size_t q = 0; q < p; q++) {
            if (alike(of, column, p, q)) continue;
            if (fracas_value_same(value_at(of, p), value_at(of, q))) return false;
            differs = true;
        }
    return differs;
}

/* True of mesh and time, which serve the other parameters, where they do not name points. */
static bool serves(const making *of, size_t column)
{
    const char *path = of->analysis->table->column[column].path;
    const fracas_columns *shown = &of->analysis->shown;
    for (size_t i = 0; i < shown->count; i++)
        if (shown->column[i] == column) return false;
    return fracas_columns_serves(path);
}

static void part_others(making *of)
{
    const fracas_point_table *table = of->analysis->table;
    of->others.count = of->partners.count = 0;
    for (size_t c = 0; c < table->ncolumns; c++) {
        if (c == of->column || serves(of, c) || !fracas_point_table_varies(table, c)) continue;
        fracas_columns *to = goes_along(of, c) ? &of->partners : &of->others;
        to->column[to->count++] = c;
    }
}

static bool alike_in_others(const making *of, size_t a, size_t b)
{
    for (size_t i = 0; i < of->others.count; i++)
        if (!alike(of, of->others.column[i], a, b)) return false;
    return true;
}

/* "rate, with fracture energy" */
static void words_of(const making *of, char *text, size_t size)
{
    const fracas_point_table *table = of->analysis->table;
    snprintf(text, size, "%s", fracas_column_words(table, of->column).text);
    for (size_t i = 0; i < of->partners.count; i++)
        fracas_append(text, size, i ? ", " : ", with ", "%s",
                      fracas_column_words(table, of->partners.column[i]).text);
}

/* The values of the other parameters that name points; of one that a point has not, the other's. */
static void setting_text(const making *of, size_t from, size_t to, char *text, size_t size)
{
    const fracas_point_table *table = of->analysis->table;
    const fracas_columns *shown = &of->analysis->shown;
    text[0] = '\0';
    for (size_t i = 0; i < shown->count; i++)
        for (size_t j = 0; j < of->others.count; j++) {
            if (of->others.column[j] != shown->column[i]) continue;
            size_t column = shown->column[i];
            const fracas_columns one = {1, &column};
            const bool lacks = fracas_value_absent(&table->point[from].value[column]);
            char label[160];
            fracas_columns_label(table, &one, lacks ? to : from, label, sizeof label);
            fracas_append(text, size, ", ", "%s", label);
        }
}

/* ---- the values of a parameter ---- */

/* Takes the value of a point that no level has, in its place; no more than one above the most. */
static void take_level(making *of, size_t point)
{
    const fracas_value *value = value_at(of, point);
    size_t at = of->nlevels;
    if (fracas_value_absent(value)) return;
    for (size_t i = 0; i < of->nlevels; i++)
        if (fracas_value_same(value_at(of, of->level[i]), value)) return;
    if (of->nlevels > FRACAS_MOST_LEVELS) return;
    for (; at > 0 && value->real < value_at(of, of->level[at - 1])->real; at--)
        of->level[at] = of->level[at - 1];
    of->level[at] = point;
    of->nlevels++;
}

/* "2.5 mm": the point's label without the name of the parameter. */
static void value_text(const making *of, size_t point, char *text, size_t size)
{
    size_t column = of->column;
    const fracas_point_table *table = of->analysis->table;
    const fracas_columns one = {1, &column};
    char label[160];
    fracas_columns_label(table, &one, point, label, sizeof label);
    const size_t name = strlen(fracas_column_words(table, column).text);
    snprintf(text, size, "%.127s", strlen(label) > name ? label + name + 1 : label);
}

/* ---- changes ---- */

/* Sums over settings, and over their points, which may serve several. */
typedef struct {
    int64_t settings;
    double log;               /* sum of L */
    double variance, squares; /* sums of c^2 u and (c^2 u)^2/(n - 1) */
    fracas_change change;
} change_sums;

static const change_sums none = {.change = {NAN, NAN, NAN, NAN, NAN}};

/* Adds the relative variance of a mean that serves c settings  (estimators.29) */
static void add_error(const fracas_estimate *mean, size_t settings, change_sums *sums)
{
    if (settings == 0) return;
    const double n = (double)mean->n, relative = mean->deviation / mean->mean, c = (double)settings,
                 u = c * c * relative * relative / n;
    sums->variance += u;
    sums->squares += u * u / (n - 1);
}

/* False for a setting without both means. */
static bool add_setting(const fracas_estimate *from, const fracas_estimate *to, change_sums *sums)
{
    if (!(from->mean > 0) || !(to->mean > 0)) return false;
    fracas_change *change = &sums->change;
    const double one = to->mean / from->mean - 1;
    sums->settings++;
    sums->log += log1p(one);
    change->least = fmin(one, change->least); /* not NaN */
    change->most = fmax(one, change->most);
    return true;
}

/* Replicas that are all alike tell nothing of their scatter, and settings with common random
 * numbers are not independent: no interval  (estimators.30) */
static fracas_change change_of(const change_sums *sums, bool common)
{
    fracas_change change = sums->change;
    const double k = (double)sums->settings, log = sums->log / k,
                 freedom = sums->variance * sums->variance / sums->squares,
                 half = freedom > 0 && !(common && sums->settings > 1)
                            ? gsl_cdf_tdist_Pinv(0.975, freedom) * sqrt(sums->variance) / k
                            : NAN;
    if (sums->settings == 0) return change;
    change.value = expm1(log);
    change.low = expm1(log - half);
    change.high = expm1(log + half);
    return change;
}

static fracas_err add_row(making *of, size_t from, size_t to, const char *at,
                          const change_sums sums[2])
{
    if (sums[0].settings == 0 && sums[1].settings == 0) return FRACAS_OK;
    TRY(fracas_grow(&of->effect, sizeof *of->effect, of->count, &of->room, "the effects"));
    fracas_effect *row = &of->effect[of->count++];
    const bool common = of->analysis->common;
    *row = (fracas_effect){.count = change_of(&sums[0], common),
                           .size = change_of(&sums[1], common)};
    row->headline = of->analysis->table->column[of->column].text ||
                    (from == of->level[0] && to == of->level[of->nlevels - 1]);
    row->settings = sums[0].settings > sums[1].settings ? sums[0].settings : sums[1].settings;
    FRACAS_PRINT(row->key, "%s", of->analysis->table->column[of->column].path);
    words_of(of, row->words, sizeof row->words);
    FRACAS_PRINT(row->at, "%s", at);
    value_text(of, from, row->from, sizeof row->from);
    value_text(of, to, row->to, sizeof row->to);
    return FRACAS_OK;
}

static const fracas_estimate *estimate_of(const making *of, size_t point, int which)
{
    const fracas_point_statistics *at = &of->analysis->point[point];
    return which == 0 ? &at->count : &at->size;
}

static bool has_level(const making *of, size_t point, size_t level)
{
    return fracas_value_same(value_at(of, point), value_at(of, level));
}

/* Adds all settings, and the errors of the points of `from`; `backwards`: these of `to`, alone. */
static void add_whole(const making *of, size_t from, size_t to, bool backwards,
                      change_sums whole[2])
{
    const size_t npoints = of->analysis->table->npoints;
    for (size_t p = 0; p < npoints; p++) {
        if (!has_level(of, p, backwards ? to : from)) continue;
        for (int which = 0; which < 2; which++) {
            change_sums only = none, *sums = backwards ? &only : &whole[which];
            const int64_t before = sums->settings;
            for (size_t q = 0; q < npoints; q++)
                if (has_level(of, q, backwards ? from : to) && alike_in_others(of, p, q))
                    (void)add_setting(estimate_of(of, p, which), estimate_of(of, q, which), sums);
            add_error(estimate_of(of, p, which), (size_t)(sums->settings - before), &whole[which]);
        }
    }
}

/* A row for each setting. */
static fracas_err add_each(making *of, size_t from, size_t to)
{
    const size_t npoints = of->analysis->table->npoints;
    for (size_t p = 0; p < npoints; p++) {
        if (!has_level(of, p, from)) continue;
        for (size_t q = 0; q < npoints; q++) {
            if (!has_level(of, q, to) || !alike_in_others(of, p, q)) continue;
            change_sums one[2] = {none, none};
            char at[sizeof of->effect->at];
            for (int which = 0; which < 2; which++) {
                const fracas_estimate *a = estimate_of(of, p, which),
                                      *b = estimate_of(of, q, which);
                const bool both = add_setting(a, b, &one[which]);
                add_error(a, both, &one[which]);
                add_error(b, both, &one[which]);
            }
            setting_text(of, p, q, at, sizeof at);
            TRY(add_row(of, from, to, at, one));
        }
    }
    return FRACAS_OK;
}

/* From one value to another: all settings, then each. */
static fracas_err add_step(making *of, size_t from, size_t to)
{
    change_sums whole[2] = {none, none};
    add_whole(of, from, to, false, whole);
    add_whole(of, from, to, true, whole);
    TRY(add_row(of, from, to, "", whole));
    const bool several = whole[0].settings > 1 || whole[1].settings > 1;
    return several ? add_each(of, from, to) : FRACAS_OK;
}

static fracas_err add_parameter(making *of)
{
    const bool texts = of->analysis->table->column[of->column].text;
    for (size_t p = 0; p < of->analysis->table->npoints; p++) take_level(of, p);
    if (of->nlevels > FRACAS_MOST_LEVELS) return FRACAS_OK;
    for (size_t l = 0; l + 1 < of->nlevels; l++) TRY(add_step(of, of->level[l], of->level[l + 1]));
    if (of->nlevels < 3 || texts) return FRACAS_OK;
    return add_step(of, of->level[0], of->level[of->nlevels - 1]);
}

bool fracas_effects_shown(const fracas_analysis *analysis)
{
    return !(analysis->axes.rate && analysis->shown.count < 2);
}

fracas_err fracas_effects(const fracas_analysis *analysis, fracas_effect **effect, size_t *count)
{
    const fracas_columns *shown = &analysis->shown;
    const size_t ncolumns = analysis->table->ncolumns;
    OWNED size_t *room = calloc(2 * ncolumns + 1, sizeof *room);
    making of = {.analysis = analysis, .others = {0, room}, .partners = {0, room + ncolumns}};
    *effect = NULL;
    *count = 0;
    if (!room) return fracas_no_memory("the effects");
    fracas_err err = FRACAS_OK;
    for (size_t i = 0; i < shown->count && !err; i++) {
        of.column = shown->column[i];
        of.nlevels = 0;
        part_others(&of);
        err = add_parameter(&of);
    }
    if (err) free(of.effect);
    else {
        *effect = of.effect;
        *count = of.count;
    }
    return err;
}
