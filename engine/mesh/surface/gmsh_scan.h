/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of a Gmsh file, one after the other: the same calls for text and binary. */
#ifndef FRACAS_ENGINE_MESH_SURFACE_GMSH_SCAN_H
#define FRACAS_ENGINE_MESH_SURFACE_GMSH_SCAN_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FRACAS_GMSH_WORD = 64 };

typedef struct {
    const char *text;
    size_t size, at;
    bool is_binary, is_swapped; /* numbers, once the format is known */
} fracas_gmsh_scan;

/* FRACAS_USAGE with "line 3: " or "byte 120: " before the message. */
FRACAS_MUST_USE fracas_err fracas_gmsh_fail(const fracas_gmsh_scan *scan, const char *format, ...)
    FRACAS_PRINTF(2, 3);

/* Passes over blanks and newlines; true at the end of the file. */
bool fracas_gmsh_at_end(fracas_gmsh_scan *scan);
/* The next word of text. */
FRACAS_MUST_USE fracas_err fracas_gmsh_word(fracas_gmsh_scan *scan, char word[FRACAS_GMSH_WORD]);
/* A word that must be `expected`. */
FRACAS_MUST_USE fracas_err fracas_gmsh_expect(fracas_gmsh_scan *scan, const char *expected);
/* The rest of the line, which must be blank: numbers of a binary file follow it. */
FRACAS_MUST_USE fracas_err fracas_gmsh_line_end(fracas_gmsh_scan *scan);
/* Goes behind the next `$End` of the section `name`. */
FRACAS_MUST_USE fracas_err fracas_gmsh_skip(fracas_gmsh_scan *scan, const char *name);

/* A whole number of 4 or 8 bytes; of text one that would fit them. */
FRACAS_MUST_USE fracas_err fracas_gmsh_integer(fracas_gmsh_scan *scan, size_t bytes,
                                               int64_t *value);
/* `count` numbers, of an `int` or a `double` each. */
FRACAS_MUST_USE fracas_err fracas_gmsh_ints(fracas_gmsh_scan *scan, size_t count, int32_t *value);
FRACAS_MUST_USE fracas_err fracas_gmsh_reals(fracas_gmsh_scan *scan, size_t count, double *value);
/* Refuses `count` things of `numbers` numbers each, more than the rest of the file can hold: what
 * is allocated for them stays in proportion. */
FRACAS_MUST_USE fracas_err fracas_gmsh_fits(const fracas_gmsh_scan *scan, int64_t count,
                                            size_t numbers);

#endif
