/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Somebody's own files in the folder of a report: its page names all of the report's. */
#ifndef FRACAS_ANALYSIS_REPORT_FOREIGN_H
#define FRACAS_ANALYSIS_REPORT_FOREIGN_H

#include "base/err.h"
#include "base/own.h"

#include <stdbool.h>
#include <stddef.h>

/* Names of them, sorted. */
typedef struct {
    char **name;
    size_t count, room;
} fracas_foreign;

/* Finds those that the page in the folder does not name; all, where nothing of fracas is; none,
 * where a report was cut off before its first page. The caller clears it, also after an error. */
FRACAS_MUST_USE fracas_err fracas_foreign_find(const char *folder, fracas_foreign *foreign);
void fracas_foreign_clear(fracas_foreign *foreign);

/* True if FOLDER/NAME is one. NULL: there are none. */
bool fracas_foreign_has(const fracas_foreign *foreign, const char *name);
/* Gives one, which the report is to replace, another name, and says so on stderr. */
FRACAS_MUST_USE fracas_err fracas_foreign_aside(const fracas_foreign *foreign, const char *folder,
                                                const char *name);

#endif
