/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/json.h"

#include "base/text.h"

#include <inttypes.h>
#include <math.h>

/* UTF-8, whatever the text has: any other byte becomes "\\xNN". Control characters, which a
 * terminal might obey, are escaped as JSON has it. */
static void write_text(FILE *out, const char *text)
{
    putc('"', out);
    for (size_t length; *text; text += length) {
        int32_t code;
        length = fracas_text_character(text, &code);
        if (code < 0) fprintf(out, "\\\\x%02x", (unsigned char)*text);
        else if (code == '"' || code == '\\') fprintf(out, "\\%c", *text);
        else if (code < 0x20 || fracas_text_is_hidden(code)) fprintf(out, "\\u%04" PRIx32, code);
        else fwrite(text, 1, length, out);
    }
    putc('"', out);
}

static void before_value(fracas_json *json, const char *key)
{
    if (!json->first[json->depth]) putc(',', json->out);
    json->first[json->depth] = false;
    if (json->depth > 0 && !json->line) fprintf(json->out, "\n%*s", 2 * json->depth, "");
    if (key) {
        write_text(json->out, key);
        fputs(": ", json->out);
    }
}

static void open_level(fracas_json *json, const char *key, char bracket)
{
    before_value(json, key);
    putc(bracket, json->out);
    json->first[++json->depth] = true;
    json->end[json->depth] = bracket == '{' ? '}' : ']';
}

void fracas_json_close(fracas_json *json)
{
    const char end = json->end[json->depth];
    bool empty = json->first[json->depth--];
    if (!empty && !json->line) fprintf(json->out, "\n%*s", 2 * json->depth, "");
    putc(end, json->out);
}

void fracas_json_begin(fracas_json *json, FILE *out)
{
    *json = (fracas_json){.out = out, .first = {true}};
    open_level(json, NULL, '{');
}

void fracas_json_end(fracas_json *json)
{
    while (json->depth > 0) fracas_json_close(json);
    putc('\n', json->out);
}

void fracas_json_object(fracas_json *json, const char *key)
{
    open_level(json, key, '{');
}
void fracas_json_array(fracas_json *json, const char *key)
{
    open_level(json, key, '[');
}

void fracas_json_real(fracas_json *json, const char *key, double value)
{
    before_value(json, key);
    if (isfinite(value)) fprintf(json->out, "%.17g", value);
    else fputs("null", json->out);
}

void fracas_json_integer(fracas_json *json, const char *key, int64_t value)
{
    before_value(json, key);
    fprintf(json->out, "%" PRId64, value);
}

void fracas_json_boolean(fracas_json *json, const char *key, bool value)
{
    before_value(json, key);
    fputs(value ? "true" : "false", json->out);
}

void fracas_json_text(fracas_json *json, const char *key, const char *value)
{
    before_value(json, key);
    if (value) write_text(json->out, value);
    else fputs("null", json->out);
}
