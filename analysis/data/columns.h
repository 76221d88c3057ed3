/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters that tell the points of a study apart, and their names. */
#ifndef FRACAS_ANALYSIS_DATA_COLUMNS_H
#define FRACAS_ANALYSIS_DATA_COLUMNS_H

#include "base/err.h"
#include "campaigns/points.h"

/* A few columns of a point table. */
typedef struct {
    size_t count;
    size_t *column; /* indices in the table */
} fracas_columns;

/* The value of the column with this path, NaN if there is none or the point has none. */
double fracas_columns_real(const fracas_point_table *table, size_t point, const char *path);

/* True if the body of the point is a surface. */
bool fracas_columns_surface(const fracas_point_table *table, size_t point);

/* Columns in the order loading.rate, geometry.radius, case, loading, material, cohesive, strength,
 * geometry, model, mesh, time. Each is kept if it separates points equal in the columns before it;
 * of a zipped sweep only the first. Derived columns are never among them. If all points are equal:
 * the first column that makes the strain rate, if there is one. Cleared by the caller, after an
 * error too. */
FRACAS_MUST_USE fracas_err fracas_columns_create(const fracas_point_table *table,
                                                 fracas_columns *columns);
void fracas_columns_clear(fracas_columns *columns);

/* The columns without those that make the strain rate (loading.rate, loading.radial,
 * loading.velocity), in the same order; then the model, if points alike in these differ in it. They
 * make the series of a figure against the rate. */
FRACAS_MUST_USE fracas_err fracas_columns_without_rate(const fracas_point_table *table,
                                                       const fracas_columns *columns,
                                                       fracas_columns *others);

/* The columns, followed by derived.strain_rate if the points differ in a velocity or in the radius
 * alone. For a table. */
FRACAS_MUST_USE fracas_err fracas_columns_with_rate(const fracas_point_table *table,
                                                    const fracas_columns *columns,
                                                    fracas_columns *with);

/* "rate" for loading.rate, the whole path if another of the columns ends the same; "strain rate"
 * for the derived one. */
const char *fracas_columns_name(const fracas_point_table *table, const fracas_columns *columns,
                                size_t i);

/* True if points alike in all of the columns differ in this one. */
bool fracas_columns_part(const fracas_point_table *table, size_t column,
                         const fracas_columns *columns);

/* class[p], for each point: the number of its values in these columns, in the order in which such
 * values come first. Returns how many classes there are. */
size_t fracas_columns_classes(const fracas_point_table *table, const fracas_columns *columns,
                              size_t *class);

/* "rate 1e4 1/s, Weibull modulus 5": the values of the point in these columns; with dashes if it
 * has none. */
void fracas_columns_label(const fracas_point_table *table, const fracas_columns *columns,
                          size_t point, char *text, size_t size);

/* The value of a column as a table shows it: text, or the shortest of plain and exponent notation
 * to 6 digits of `factor` times the number. */
void fracas_columns_value(const fracas_point_table *table, size_t column, size_t point,
                          double factor, char *text, size_t size);

/* "cohesive.fracture_energy, material.young": further parameters in which the points differ, apart
 * from mesh and time; "" for none. */
void fracas_columns_beside(const fracas_point_table *table, const fracas_columns *columns,
                           char *text, size_t size);

/* True of parameters of mesh and time, which serve the others. */
bool fracas_columns_serves(const char *path);

/* True if both points have equal values in all of these columns. */
bool fracas_columns_same(const fracas_point_table *table, const fracas_columns *columns, size_t a,
                         size_t b);

#endif
