/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The headline table: cells of text, for a terminal and for the page. */
#ifndef FRACAS_ANALYSIS_EXPORT_TABLE_H
#define FRACAS_ANALYSIS_EXPORT_TABLE_H

#include "analysis/summary/study.h"

enum { FRACAS_CELL = 128, FRACAS_RESULT_TABLE_HEAD = 2 };

typedef struct {
    size_t rows, columns; /* the first FRACAS_RESULT_TABLE_HEAD rows are names and units; then a row
                             a point */
    size_t laws;          /* of the columns before the last, those that are of size laws */
    size_t first_law;     /* the first of them */
    char (*cell)[FRACAS_CELL]; /* rows x columns; the last column is text, the others numbers */
} fracas_result_table;

/* `unicode`: with a plus-minus and a micro sign, else ASCII. */
FRACAS_MUST_USE fracas_err fracas_result_table_create(const fracas_analysis *analysis, bool unicode,
                                                      fracas_result_table *table);
void fracas_result_table_clear(fracas_result_table *table);

static inline char *fracas_result_table_cell(const fracas_result_table *table, size_t row,
                                             size_t column)
{
    return table->cell[row * table->columns + column];
}

/* What the columns of the study's table mean, a line each; ends with NULL. */
const char *const *fracas_result_table_legend(const fracas_analysis *analysis);

/* "Points differ in material.young, too: points.csv has ...": what the table does not show; false
 * if that is nothing. */
bool fracas_result_table_beside(const fracas_analysis *analysis, char *text, size_t size);

#endif
