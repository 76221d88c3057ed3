/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text in arrays and on pages. */
#ifndef FRACAS_ANALYSIS_DATA_TEXT_H
#define FRACAS_ANALYSIS_DATA_TEXT_H

#include "base/err.h"

#include <stddef.h>
#include <stdio.h>

/* Writes a formatted text into an array of characters, cut where it is too long. */
#define FRACAS_PRINT(array, ...) snprintf(array, sizeof(array), __VA_ARGS__)

/* The name of a point for a reader, "rate 1e4 1/s". */
typedef struct {
    char text[256];
} fracas_label;

/* Appends a formatted text, after the separator unless *text is empty. */
void fracas_append(char *text, size_t size, const char *separator, const char *format, ...)
    FRACAS_PRINTF(4, 5);

/* Writes `format` into HTML or SVG, with the texts for its %s escaped: &, <, > and ", and
 * hidden characters as fracas_text_show has them. It has no other directive. */
void fracas_markup(FILE *out, const char *format, ...) FRACAS_PRINTF(2, 3);

#endif
