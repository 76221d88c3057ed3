/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One statement, used once. Private to the store. */
#ifndef FRACAS_CAMPAIGNS_STORE_INDEX_QUERY_H
#define FRACAS_CAMPAIGNS_STORE_INDEX_QUERY_H

#include "campaigns/store/index/index.h"

/* Prepares; the caller finalizes *statement with sqlite3_finalize, after an error too (it is NULL
 * then). */
FRACAS_MUST_USE fracas_err fracas_query_begin(fracas_index *index, const char *text,
                                              sqlite3_stmt **statement);
/* Binds argument `n` (from 1) of a statement that was begun. */
FRACAS_MUST_USE fracas_err fracas_query_bind_text(fracas_index *index, sqlite3_stmt *statement,
                                                  int n, const char *text);
FRACAS_MUST_USE fracas_err fracas_query_bind_hash(fracas_index *index, sqlite3_stmt *statement,
                                                  int n, const fracas_hash *hash);
FRACAS_MUST_USE fracas_err fracas_query_bind(fracas_index *index, sqlite3_stmt *statement, int n,
                                             int64_t value);
/* *row: one is there to be read. */
FRACAS_MUST_USE fracas_err fracas_query_step(fracas_index *index, sqlite3_stmt *statement,
                                             bool *row);
/* Steps to its end, for a statement that gives no rows, and resets it. */
FRACAS_MUST_USE fracas_err fracas_query_do(fracas_index *index, sqlite3_stmt *statement);

/* Several statements without arguments. */
FRACAS_MUST_USE fracas_err fracas_query_all(fracas_index *index, const char *text);
/* First column of the first row, 0 if there is none. */
FRACAS_MUST_USE fracas_err fracas_query_number(fracas_index *index, const char *text,
                                               int64_t *number);

/* Puts the write-ahead log back into the database and empties it; nothing is done where there is
 * none. */
FRACAS_MUST_USE fracas_err fracas_query_checkpoint(fracas_index *index);

#endif
