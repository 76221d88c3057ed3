/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A walk through the lines of a text file, empty lines and remarks left out. */
#ifndef FRACAS_BASE_LINES_H
#define FRACAS_BASE_LINES_H

#include "base/err.h"
#include "base/param.h"

#include <stdbool.h>
#include <stdint.h>

#define FRACAS_FIELD 64 /* bytes of a field, its end included: more than any number of use */

typedef struct {
    const fracas_attachment *file;
    const char *at, *end;     /* bytes left of the file */
    const char *start, *stop; /* the line without outer blanks; fracas_lines_field shortens it */
    int64_t line;             /* its number, from 1 */
    bool first;               /* it is the first one: it may be a line of headings */
    size_t headings;          /* columns that a first line names between commas; 0: none */
} fracas_lines;

fracas_lines fracas_lines_begin(const fracas_attachment *file);

/* False at the end of the file. */
bool fracas_lines_next(fracas_lines *lines);
/* The line is one of headings: counts those between commas. */
void fracas_lines_name(fracas_lines *lines);
/* The next one, without a first line whose first field is a heading. */
bool fracas_lines_next_row(fracas_lines *lines);

/* The line's last field; the next from its start. Fields end at a comma or a blank. "" if there is
 * none, or if it holds bytes that no text has. */
void fracas_lines_last_field(const fracas_lines *lines, char field[FRACAS_FIELD]);
void fracas_lines_field(fracas_lines *lines, char field[FRACAS_FIELD]);
/* True of a line that may hold decimal commas: one stands between digits, next to no decimal point,
 * and what it parts are `numbers` numbers (1: of which the last one counts) or more; where no line
 * of headings names as many columns. */
bool fracas_lines_is_decimal_comma(const fracas_lines *lines, size_t numbers);
/* FRACAS_USAGE for such a line. */
FRACAS_MUST_USE fracas_err fracas_lines_check_commas(const fracas_lines *lines, size_t numbers,
                                                     const char *headings);
/* FRACAS_USAGE: "FILE:LINE: found `found`; expected ...". */
FRACAS_MUST_USE fracas_err fracas_lines_refuse(const fracas_lines *lines, const char *found,
                                               const char *expected);
/* The next field as a number. FRACAS_USAGE if it is none: "... as `name`; a line begins with
 * `form`". */
FRACAS_MUST_USE fracas_err fracas_lines_number(fracas_lines *lines, const char *name,
                                               const char *form, double *value);

/* Doubts about a file with a line of headings, for warnings: nothing is refused by them. */
typedef struct {
    char unit[FRACAS_FIELD]; /* "mm" in brackets in a heading, where numbers are SI; "": none */
    int64_t line; /* whose `interface` is not one more than on the line before; 0: none */
} fracas_lines_doubts;

/* Looks at all columns, or at the last alone. */
fracas_lines_doubts fracas_lines_doubt(const fracas_attachment *file, bool last);

/* Headings are words. A mistyped number is no heading, nor is a number that C writes as a word. */
bool fracas_lines_is_heading(const char *field);

#endif
