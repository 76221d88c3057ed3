/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of a report: whole or not there. */
#ifndef FRACAS_ANALYSIS_DATA_OUTPUT_H
#define FRACAS_ANALYSIS_DATA_OUTPUT_H

#include "base/err.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    FILE *file;
    char *path;      /* final name */
    char *temporary; /* name until it is whole */
} fracas_output_file;

#define FRACAS_OUTPUT_PAGE "index.html"

/* True of a page of fracas; of a folder that has one. */
bool fracas_output_is_page(const char *path);
bool fracas_output_has_page(const char *folder);
/* The same, a package, or the remains of a report or an export cut off before these. */
bool fracas_output_is_ours(const char *folder);

/* Makes the folder, which may be there. FRACAS_USAGE if it is a file, FRACAS_ENVIRONMENT if it
 * cannot be made. */
FRACAS_MUST_USE fracas_err fracas_output_folder(const char *folder);

/* The same for `wanted`, or for STUDY/NAME where it is NULL; *folder is freed by the caller.
 * FRACAS_DAMAGED if STUDY/NAME is a link, which nobody named. */
FRACAS_MUST_USE fracas_err fracas_output_folder_in(const char *wanted, const char *study,
                                                   const char *name, char **folder);

/* FRACAS_USAGE if the folder has a file of this name that no report or export wrote: an index.html
 * or a datapackage.json of fracas beside it tells, or the remains of one cut off. */
FRACAS_MUST_USE fracas_err fracas_output_free(const char *folder, const char *const *name,
                                              size_t count);

/* FRACAS_USAGE for such a file. */
FRACAS_MUST_USE fracas_err fracas_output_refuse(const char *path);

/* FRACAS_USAGE if the folder has a file and neither index.html nor datapackage.json of fracas. */
FRACAS_MUST_USE fracas_err fracas_output_empty(const char *folder);

/* True if a program writes FOLDER/NAME, or was cut off while it did: .NAME.PID is there. */
bool fracas_output_begun(const char *folder, const char *name);

/* Starts folder/name under a temporary name beside it. FRACAS_ENVIRONMENT if it cannot. */
FRACAS_MUST_USE fracas_err fracas_output_open(const char *folder, const char *name,
                                              fracas_output_file *output);
/* With `err` FRACAS_OK renames the file, once all of it is written, to its final name; else removes
 * it and returns `err`. Frees the memory of `output`. */
FRACAS_MUST_USE fracas_err fracas_output_close(fracas_output_file *output, fracas_err err);

#endif
