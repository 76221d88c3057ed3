/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Descriptors of printed results. A result is a struct and a table of its fields: key, unit,
 * meaning, type, place. JSON, CSV, the schema of the data package and the reference page are
 * written by walking the table. */
#ifndef FRACAS_ANALYSIS_DATA_FIELD_H
#define FRACAS_ANALYSIS_DATA_FIELD_H

#include "analysis/data/text.h"
#include "base/json.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum {
    FRACAS_FIELD_INTEGER, /* int64_t */
    FRACAS_FIELD_INDEX,   /* size_t, SIZE_MAX: none */
    FRACAS_FIELD_NUMBER,  /* double, not finite: none */
    FRACAS_FIELD_TEXT,    /* const char *, NULL: none */
    FRACAS_FIELD_CHARS,   /* char[] */
    FRACAS_FIELD_REASON,  /* char[], "": none */
    FRACAS_FIELD_BOOLEAN, /* bool */
    FRACAS_FIELD_OBJECT,  /* the struct of `members` */
} fracas_field_type;

typedef struct fracas_field {
    const char *key;
    fracas_field_type type;
    const char *unit; /* for UDUNITS-2; "1": a pure number, "": text, NULL: that of its object */
    const char *doc;  /* in a member, "%s" stands for the meaning of its object */
    size_t offset;    /* in the struct [bytes] */
    const struct fracas_fields *members;
    bool outcome; /* the text is one of fracas_outcome_name */
} fracas_field;

typedef struct fracas_fields {
    const fracas_field *field;
    size_t count;
} fracas_fields;

/* A field in the struct `row`. */
#define FRACAS_FIELD(row, kind, key, unit, doc, member)            \
    {                                                              \
        key, FRACAS_FIELD_##kind, unit, doc, offsetof(row, member) \
    }
#define FRACAS_FIELD_OF(row, members, key, unit, doc, member)                  \
    {                                                                          \
        key, FRACAS_FIELD_OBJECT, unit, doc, offsetof(row, member), &(members) \
    }

/* The table of an array of fields. */
#define FRACAS_FIELDS(array)                      \
    {                                             \
        array, sizeof(array) / sizeof((array)[0]) \
    }

/* Takes the leaves of a table, one after the other; the leaf and its texts end with the call. */
typedef void fracas_field_visit(void *context, const fracas_field *leaf);

/* Every field except objects, in order. Keys of members follow the key of their object and the
 * separator: "size" and "mean" make "size.mean". */
void fracas_fields_walk(const fracas_fields *fields, const char *separator,
                        fracas_field_visit *visit, void *context);

/* The members of an open object: objects nested, or, `flat`, every leaf under its joined key. */
void fracas_fields_json(fracas_json *json, const fracas_fields *fields, const void *row);
void fracas_fields_json_flat(fracas_json *json, const fracas_fields *fields, const void *row);
/* The same as an object with this key. */
void fracas_fields_json_object(fracas_json *json, const char *key, const fracas_fields *fields,
                               const void *row);

/* A comma before every leaf of the row, numbers to 15 digits, nothing for a missing value. */
void fracas_fields_csv(const fracas_fields *fields, const void *row, FILE *out);
/* One leaf, without a comma. */
void fracas_field_csv(const fracas_field *leaf, const void *row, FILE *out);

/* A Markdown table: key, type, unit, meaning. A line a leaf, or, `nested`, a line a field. */
void fracas_fields_reference(const fracas_fields *fields, bool nested, FILE *out);

/* A comma and the value, to 15 digits. */
void fracas_csv_real(double value, FILE *out);
/* The text, in quotes where it needs them; behind an apostrophe where a spreadsheet would take it
 * for a formula: it begins with = + - @, a tab or a carriage return. */
void fracas_csv_text(const char *text, FILE *out);

#endif
