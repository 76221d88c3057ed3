/* Which parameters tell the points of a study apart, and what to call them. */
#ifndef FRACAS_ANALYSIS_COLUMNS_H
#define FRACAS_ANALYSIS_COLUMNS_H

#include "base/err.h"
#include "campaigns/points.h"

/* A few columns of a point table. */
typedef struct {
    size_t count;
    size_t *column; /* indices in the table */
} fracas_columns;

/* Columns in the order loading.rate, loading, material, cohesive, strength, geometry, model, mesh, time, each kept
 * if it parts points that the columns before it do not part: for a zipped sweep its first column alone. Derived
 * columns are never among them. When no point differs from another: loading.rate if there is such a column. */
FRACAS_MUST_USE fracas_err fracas_columns_create(const fracas_point_table *table, fracas_columns *columns);
void fracas_columns_clear(fracas_columns *columns);

/* The columns without loading.rate, in the same order: what makes series of a figure against the rate. */
FRACAS_MUST_USE fracas_err fracas_columns_without_rate(const fracas_point_table *table, const fracas_columns *columns,
                                                       fracas_columns *others);

/* "rate" for loading.rate, the whole path if another of the columns ends the same. */
const char *fracas_columns_name(const fracas_point_table *table, const fracas_columns *columns, size_t i);

/* "rate 1e4 1/s, young 275e9 Pa": the point by the values of these columns; "" for none. */
void fracas_columns_label(const fracas_point_table *table, const fracas_columns *columns, size_t point, char *text,
                          size_t size);

/* The value of a column as a table shows it: text, or the shortest of plain and exponent notation to 6 digits. */
void fracas_columns_value(const fracas_point_table *table, size_t column, size_t point, char *text, size_t size);

/* True if both points have equal values in all of these columns. */
bool fracas_columns_same(const fracas_point_table *table, const fracas_columns *columns, size_t a, size_t b);

#endif
