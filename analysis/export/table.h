/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The headline table: cells of text, for a terminal and for the page. */
#ifndef FRACAS_ANALYSIS_EXPORT_TABLE_H
#define FRACAS_ANALYSIS_EXPORT_TABLE_H

#include "analysis/export/cells.h"

/* A row a point. The last column is text, the others numbers.
`unicode`: with a plus-minus and a micro sign, else ASCII. */
FRACAS_MUST_USE fracas_err fracas_result_table_create(const fracas_analysis *analysis, bool unicode,
                                                      fracas_result_table *table);

/* Meaning of the columns of the study's table, a line each; ends with NULL. */
const char *const *fracas_result_table_legend(const fracas_analysis *analysis);

/* "Points differ in material.young, too: points.csv has ...": parameters missing in the table;
 * false if there are none. */
bool fracas_result_table_beside(const fracas_analysis *analysis, char *text, size_t size);

#endif
