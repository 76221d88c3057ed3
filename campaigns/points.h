/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The points of a campaign as a table of columns, for the store (/point) and the analysis. */
#ifndef FRACAS_CAMPAIGNS_POINTS_H
#define FRACAS_CAMPAIGNS_POINTS_H

#include "base/hash.h"
#include "base/param.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* One resolved scalar (`material.young`) or enum (`cohesive.law`) over all points. */
typedef struct {
    const char *path; /* dotted */
    const char *unit; /* SI, "1" for a pure number, "" for text */
    const char *doc;
    bool text; /* enum: values are text */
} fracas_column;

typedef struct {
    double real;      /* NaN if the point lacks the value, or the column is text */
    const char *text; /* "" if the point lacks the value, or the column is real */
} fracas_value;

typedef struct {
    fracas_hash hash;
    int64_t replicas;
    const fracas_value *value; /* one per column */
    int64_t most;              /* maximum of replicas by its rule; 0: no rule */
} fracas_point_row;

/* Columns of all points, sorted by path (byte order). Values missing at a point are NaN or "".
 * Booleans and integers are reals. */
typedef struct {
    size_t ncolumns;
    const fracas_column *column;
    size_t npoints;
    const fracas_point_row *point;
} fracas_point_table;

/* The text of a campaign as resolved, and the files that it names, as attachments/DIGEST: all that
 * a study has of its campaign. */
typedef struct {
    char *text; /* owned; `size` bytes and a NUL */
    size_t size, nfiles;
    fracas_attachment *file; /* owned, by digest, each once; without a path */
    char *content;           /* owned, of all files; NULL: it belongs to the campaign */
} fracas_campaign_copy;

static inline void fracas_campaign_copy_clear(fracas_campaign_copy *copy)
{
    free(copy->text);
    free(copy->file);
    free(copy->content);
    *copy = (fracas_campaign_copy){0};
}

/* Index of the column, or SIZE_MAX. Inline, for store and analysis alike. */
static inline size_t fracas_point_table_find(const fracas_point_table *table, const char *path)
{
    for (size_t c = 0; c < table->ncolumns; c++)
        if (!strcmp(table->column[c].path, path)) return c;
    return SIZE_MAX;
}

/* Both none, or equal. */
static inline bool fracas_value_same(const fracas_value *a, const fracas_value *b)
{
    return !strcmp(a->text, b->text) && (a->real == b->real || (isnan(a->real) && isnan(b->real)));
}

/* The point has no such value. */
static inline bool fracas_value_absent(const fracas_value *value)
{
    return isnan(value->real) && !*value->text;
}

/* True if a column, not a derived one, varies over the points. */
static inline bool fracas_point_table_varies(const fracas_point_table *table, size_t column)
{
    if (!strncmp(table->column[column].path, "derived.", 8)) return false;
    for (size_t p = 1; p < table->npoints; p++)
        if (!fracas_value_same(&table->point[0].value[column], &table->point[p].value[column]))
            return true;
    return false;
}

/* True if all points have a text in the column `name`, and those of one text one value of another
 * column. */
static inline bool fracas_point_table_follows(const fracas_point_table *table, size_t name,
                                              size_t column)
{
    for (size_t p = 0, q; p < table->npoints && column != name; p++) {
        const fracas_value *value = table->point[p].value;
        for (q = 0; strcmp(table->point[q].value[name].text, value[name].text) != 0; q++) {}
        if (!*value[name].text ||
            !fracas_value_same(&table->point[q].value[column], &value[column]))
            return false;
    }
    return column != name;
}

/* Share of the count that a bar or ring loses where its elements are halved, of strengths without a
 * least value and a size effect, by scatter = deviation/mean and e = rate/edot0 (scaling-laws.3),
 * NaN without a rate. Two interfaces in place of one: the weaker has mean - deviation/sqrt(pi) of
 * normal strengths (Weibull's: 0.56 deviations as well), and counts follow the strength^(1.3/(1 +
 * 4.5 e^(2/3))), with the form of (scaling-laws.6). Right to a
 * factor of 1.6, beside 1 %, for Weibull's of moduli 5 to 40; normal, lognormal and gamma ones of
 * 10 % lose up to as much (docs/results/sampling.md). */
static inline double fracas_mesh_effect(double scatter, double e)
{
    const double usual = 0.3;
    return 0.75 * scatter / (1 + 4.5 * pow(e >= 0 ? e : usual, 2.0 / 3));
}
/* The same, up or down, of strengths with a least value above 0, at most (there). */
#define FRACAS_MESH_EFFECT_BOUNDED 0.05
/* Share of the count from which a plan and a report name it: deviation/mean of 4.0 %, modulus 30,
 * at e = 0.3; above a least value that scatter. */
#define FRACAS_MESH_EFFECT_NOTABLE 0.01
#define FRACAS_SCATTER_NOTABLE 0.036

#endif
