/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A small JSON writer, for `--json` and provenance. Output only; commas and escapes are its job. */
#ifndef FRACAS_BASE_JSON_H
#define FRACAS_BASE_JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *out;
    int depth;
    bool line;      /* set after the beginning: everything in one line */
    bool first[16]; /* nothing written yet at this depth */
    char end[16];   /* closing bracket of this depth */
} fracas_json;

/* Opens an object; the end closes it, with every level open in it, and writes a newline. */
void fracas_json_begin(fracas_json *json, FILE *out);
void fracas_json_end(fracas_json *json);

/* `key` is NULL inside an array. Numbers are written with 17 digits; NaN and
 * infinities as null. */
void fracas_json_object(fracas_json *json, const char *key);
void fracas_json_array(fracas_json *json, const char *key);
void fracas_json_close(fracas_json *json); /* the innermost of them */
void fracas_json_real(fracas_json *json, const char *key, double value);
void fracas_json_integer(fracas_json *json, const char *key, int64_t value);
void fracas_json_boolean(fracas_json *json, const char *key, bool value);
/* NULL is null; a byte outside UTF-8 becomes the four characters \xNN. */
void fracas_json_text(fracas_json *json, const char *key, const char *value);

#endif
