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
    bool first[16]; /* nothing written yet at this depth */
} fracas_json;

void fracas_json_begin(fracas_json *json, FILE *out);
void fracas_json_end(fracas_json *json); /* closes with a newline */

/* `key` is NULL inside an array and at the top. Numbers are written with 17 digits; NaN and
 * infinities as null. */
void fracas_json_object(fracas_json *json, const char *key);
void fracas_json_array(fracas_json *json, const char *key);
void fracas_json_close_object(fracas_json *json);
void fracas_json_close_array(fracas_json *json);
void fracas_json_real(fracas_json *json, const char *key, double value);
void fracas_json_integer(fracas_json *json, const char *key, int64_t value);
void fracas_json_boolean(fracas_json *json, const char *key, bool value);
void fracas_json_text(fracas_json *json, const char *key,
                      const char *value); /* UTF-8; NULL is null */

#endif
