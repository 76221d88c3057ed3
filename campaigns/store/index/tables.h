/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of index.sqlite, each column described once: the schema and docs/formats/study.md are
 * made of it. */
#ifndef FRACAS_CAMPAIGNS_STORE_INDEX_TABLES_H
#define FRACAS_CAMPAIGNS_STORE_INDEX_TABLES_H

#include "campaigns/store/summary.h"

#include <stdio.h>

/* ", outcome, fragments ...", and the same as assignments; each `?` takes the next number. */
#define FRACAS_SQL_NAME(key, type, value, meaning) ", " #key
#define FRACAS_SQL_SET(key, type, value, meaning) ", " #key " = ?"
#define FRACAS_SQL_UNSET(key, type, value, meaning) ", " #key " = NULL"

/* The columns of a fracas_place, and assignments to forget it. */
#define FRACAS_PLACE_COLUMNS "status, segment, row" FRACAS_EACH_SUMMARY(FRACAS_SQL_NAME)
#define FRACAS_UNSET_PLACE \
    "status = 'planned', segment = NULL, row = NULL" FRACAS_EACH_SUMMARY(FRACAS_SQL_UNSET)

/* Prints statements: to create missing tables, and to read every column of each. */
void fracas_index_print_schema(FILE *out);
void fracas_index_print_check(FILE *out);

#endif
