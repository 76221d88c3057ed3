/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /point in a file: the point table, one dataset a column. Private to the store. */
#ifndef FRACAS_CAMPAIGNS_STORE_FILE_TABLE_H
#define FRACAS_CAMPAIGNS_STORE_FILE_TABLE_H

#include "campaigns/store/file/h5.h"
#include "campaigns/points.h"

/* A point table as read, with the memory it points to. */
typedef struct {
    fracas_point_table table;
    fracas_column *column;
    fracas_point_row *point;
    fracas_value *value; /* [point][column] */
    char **text;         /* one block of texts a column, NULL if real */
} fracas_stored_table;

/* Bytes of a value in column `c`, one of text: those of the longest, at least 1. */
size_t fracas_table_text_width(const fracas_point_table *table, size_t c);

FRACAS_MUST_USE fracas_err fracas_table_write(const fracas_h5 *h5, const fracas_point_table *table);
/* *stored must be all zero; cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_table_read(const fracas_h5 *h5, fracas_stored_table *stored);
/* The same without columns: only hash and replicas of each point. */
FRACAS_MUST_USE fracas_err fracas_table_read_points(const fracas_h5 *h5,
                                                    fracas_stored_table *stored);
void fracas_table_clear(fracas_stored_table *stored);

#endif
