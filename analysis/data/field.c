/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/field.h"

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* ---- walking ---- */

/* `pattern` with `text` in place of its "%s". */
static void substitute(const char *pattern, const char *text, char *to, size_t size)
{
    const char *at = strstr(pattern, "%s");
    if (at) snprintf(to, size, "%.*s%s%s", (int)(at - pattern), pattern, text, at + 2);
    else snprintf(to, size, "%s", pattern);
}

static void walk(const fracas_fields *fields, const fracas_field *object, const char *separator,
                 fracas_field_visit *visit, void *context)
{
    for (size_t i = 0; i < fields->count; i++) {
        fracas_field field = fields->field[i];
        char key[96], doc[320];
        if (object) {
            FRACAS_PRINT(key, "%s%s%s", object->key, separator, field.key);
            substitute(field.doc, object->doc, doc, sizeof doc);
            field.key = key;
            field.doc = doc;
            field.offset += object->offset;
            if (!field.unit) field.unit = object->unit;
        }
        if (field.type == FRACAS_FIELD_OBJECT)
            walk(field.members, &field, separator, visit, context);
        else visit(context, &field);
    }
}

void fracas_fields_walk(const fracas_fields *fields, const char *separator,
                        fracas_field_visit *visit, void *context)
{
    walk(fields, NULL, separator, visit, context);
}

/* ---- JSON ---- */

static const void *place_of(const fracas_field *field, const void *row)
{
    return (const char *)row + field->offset;
}

static void put_json(fracas_json *json, const fracas_field *field, const void *row)
{
    const void *at = place_of(field, row);
    switch (field->type) {
    case FRACAS_FIELD_INTEGER: fracas_json_integer(json, field->key, *(const int64_t *)at); break;
    case FRACAS_FIELD_NUMBER: fracas_json_real(json, field->key, *(const double *)at); break;
    case FRACAS_FIELD_BOOLEAN: fracas_json_boolean(json, field->key, *(const bool *)at); break;
    case FRACAS_FIELD_TEXT: fracas_json_text(json, field->key, *(const char *const *)at); break;
    case FRACAS_FIELD_CHARS: fracas_json_text(json, field->key, at); break;
    case FRACAS_FIELD_REASON:
        fracas_json_text(json, field->key, *(const char *)at ? at : NULL);
        break;
    case FRACAS_FIELD_INDEX:
        if (*(const size_t *)at == SIZE_MAX) fracas_json_text(json, field->key, NULL);
        else fracas_json_integer(json, field->key, (int64_t) * (const size_t *)at);
        break;
    case FRACAS_FIELD_OBJECT:
        fracas_fields_json_object(json, field->key, field->members, at);
        break;
    }
}

void fracas_fields_json(fracas_json *json, const fracas_fields *fields, const void *row)
{
    for (size_t i = 0; i < fields->count; i++) put_json(json, &fields->field[i], row);
}

void fracas_fields_json_object(fracas_json *json, const char *key, const fracas_fields *fields,
                               const void *row)
{
    fracas_json_object(json, key);
    fracas_fields_json(json, fields, row);
    fracas_json_close(json);
}

typedef struct {
    fracas_json *json;
    FILE *out;
    const void *row;
} emitter;

static void visit_json(void *context, const fracas_field *leaf)
{
    const emitter *to = context;
    put_json(to->json, leaf, to->row);
}

void fracas_fields_json_flat(fracas_json *json, const fracas_fields *fields, const void *row)
{
    fracas_fields_walk(fields, ".", visit_json, &(emitter){.json = json, .row = row});
}

/* ---- CSV ---- */

static void put_real(double value, FILE *out)
{
    if (value == 0 && !signbit(value)) putc('0', out); /* frequent, and %g is slow */
    else if (isfinite(value)) fprintf(out, "%.15g", value);
}

void fracas_csv_real(double value, FILE *out)
{
    putc(',', out);
    put_real(value, out);
}

void fracas_csv_text(const char *text, FILE *out)
{
    const bool formula = *text && strchr("=+-@\t\r", *text); /* to a spreadsheet */
    const bool quote = formula || strpbrk(text, ",\"\n\r");
    if (quote) putc('"', out);
    if (formula) putc('\'', out);
    for (; *text; text++) {
        if (*text == '"') putc('"', out);
        putc(*text, out);
    }
    if (quote) putc('"', out);
}

void fracas_field_csv(const fracas_field *leaf, const void *row, FILE *out)
{
    const void *at = place_of(leaf, row);
    switch (leaf->type) {
    case FRACAS_FIELD_INTEGER: fprintf(out, "%" PRId64, *(const int64_t *)at); break;
    case FRACAS_FIELD_NUMBER: put_real(*(const double *)at, out); break;
    case FRACAS_FIELD_BOOLEAN: putc(*(const bool *)at ? '1' : '0', out); break;
    case FRACAS_FIELD_TEXT:
        if (*(const char *const *)at) fracas_csv_text(*(const char *const *)at, out);
        break;
    case FRACAS_FIELD_CHARS:
    case FRACAS_FIELD_REASON: fracas_csv_text(at, out); break;
    case FRACAS_FIELD_INDEX:
        if (*(const size_t *)at != SIZE_MAX) fprintf(out, "%zu", *(const size_t *)at);
        break;
    case FRACAS_FIELD_OBJECT: break; /* no leaf */
    }
}

static void visit_csv(void *context, const fracas_field *leaf)
{
    const emitter *to = context;
    putc(',', to->out);
    fracas_field_csv(leaf, to->row, to->out);
}

void fracas_fields_csv(const fracas_fields *fields, const void *row, FILE *out)
{
    fracas_fields_walk(fields, ".", visit_csv, &(emitter){.out = out, .row = row});
}

/* ---- reference ---- */

static void put_reference(const char *key, const char *type, const char *unit, const char *doc,
                          FILE *out)
{
    fprintf(out, "| `%s` | %s | %s | ", key, type, unit);
    for (const char *c = doc; *c; c++)
        fprintf(out, *c == '|' ? "\\%c" : "%c", *c); /* |residual| is no column */
    fputs(" |\n", out);
}

static void visit_reference(void *out, const fracas_field *leaf)
{
    static const char *const type[] = {"integer", "integer", "number", "text",
                                       "text",    "text",    "boolean"};
    put_reference(leaf->key, type[leaf->type], leaf->unit, leaf->doc, out);
}

void fracas_fields_reference(const fracas_fields *fields, bool nested, FILE *out)
{
    char type[160];
    fputs("| key | type | unit | meaning |\n|---|---|---|---|\n", out);
    if (!nested) fracas_fields_walk(fields, ".", visit_reference, out);
    for (size_t i = 0; nested && i < fields->count; i++) {
        const fracas_field *field = &fields->field[i];
        if (field->type != FRACAS_FIELD_OBJECT) {
            visit_reference(out, field);
            continue;
        }
        *type = '\0'; /* "`value`, `low`, `high`" */
        for (size_t m = 0; m < field->members->count; m++)
            fracas_append(type, sizeof type, ", ", "`%s`", field->members->field[m].key);
        put_reference(field->key, type, field->unit, field->doc, out);
    }
}
