/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables beside the headline one: slopes and crossover of mean size, motion of a ring's fragments.
 */
#ifndef FRACAS_ANALYSIS_EXPORT_SIDE_TABLES_H
#define FRACAS_ANALYSIS_EXPORT_SIDE_TABLES_H

#include "analysis/fit/fits.h"
#include "analysis/export/table.h"

/* A row for all points and for each series with a slope, with the exponents of Mott and Grady; no
 * row, only the head, for a study without enough points. */
FRACAS_MUST_USE fracas_err fracas_slope_table_create(const fracas_analysis *analysis, bool unicode,
                                                     fracas_result_table *table);

/* A row for every two neighbouring rates of a series. */
FRACAS_MUST_USE fracas_err fracas_window_table_create(const fracas_analysis *analysis, bool unicode,
                                                      fracas_result_table *table);

/* A row a series: its crossover, or why there is none. */
FRACAS_MUST_USE fracas_err fracas_crossover_table_create(const fracas_analysis *analysis,
                                                         bool unicode, fracas_result_table *table);

/* A row a ring: mean velocity outward, its scatter, rms velocity along the ring, mean |angular
 * velocity|. */
FRACAS_MUST_USE fracas_err fracas_motion_table_create(const fracas_analysis *analysis, bool unicode,
                                                      fracas_result_table *table);

/* A row a fitted family of a point, by rank: distances, their p-values, parameters. */
FRACAS_MUST_USE fracas_err fracas_fit_table_create(const fracas_analysis *analysis,
                                                   const fracas_fits *fits, bool unicode,
                                                   fracas_result_table *table);

/* Meaning of the columns, a line each; ends with NULL. */
extern const char *const fracas_fit_table_legend[];
extern const char *const fracas_slope_table_legend[], *const fracas_window_table_legend[],
                                                          *const fracas_crossover_table_legend[],
                                                              *const fracas_motion_table_legend[];

#endif
