/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of text, also on terminals narrower than they are. */
#ifndef FRACAS_BASE_SHEET_H
#define FRACAS_BASE_SHEET_H

#include <stddef.h>
#include <stdio.h>

/* Cells of ASCII by a function of the caller; rows of the head are among them. */
typedef struct {
    size_t rows, columns;
    size_t keys;        /* columns that name a row */
    unsigned left;      /* bit c: column c is aligned left */
    const char *indent; /* before each line */
    const char *(*cell)(const void *of, size_t row, size_t column);
    const char *(*gap)(const void *of, size_t column); /* before a column, the first one's is "" */
    const void *of;
} fracas_sheet;

/* Prints all rows. Where they have more than `columns` characters (0: never) the columns stand in
 * several tables, one below the other, each with the keys; a last cell of words is broken into
 * lines. */
void fracas_sheet_print(const fracas_sheet *sheet, int columns, FILE *out);

/* Lines of a legend, up to a NULL; with `columns` as one text with lines of that length. */
void fracas_sheet_legend(const char *const *line, int columns, FILE *out);

/* "warning: ...", with `columns` in lines of that length; in colour on standard output only. */
void fracas_sheet_warning(const char *text, int columns, FILE *out);

#endif
