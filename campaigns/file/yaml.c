/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/node.h"

#include "base/file.h"
#include "base/own.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

/* Enough for the resolved file of the largest campaign, each point with values of its own. */
enum {
    MAX_BYTES = 16 << 20,
    MAX_NODES = 1000000,
    MAX_DEPTH = 16,
    MAX_TEXT = FRACAS_LONGEST_TEXT,
    MAX_KEYS = 500
};

typedef struct {
    const char *name; /* the file's */
    const unsigned char *bytes;
    size_t size;
    fracas_campaign_memory *memory;
    fracas_faults *faults;
    size_t nodes;
    yaml_parser_t parser;
} reading;

static FRACAS_PRINTF(3, 4) fracas_err
    fail_at(const reading *reader, yaml_mark_t mark, const char *format, ...)
{
    char text[600];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fracas_faults_place(reader->faults, (int)mark.line + 1, (int)mark.column + 1, false);
    return fracas_fail(FRACAS_USAGE, "%s:%zu:%zu: %s", reader->name, mark.line + 1, mark.column + 1,
                       text);
}

/* ---- from the file to bytes ---- */

/* Reads all of `in`; *bytes is freed by the caller, also after an error. */
static fracas_err load_open(const char *name, FILE *in, unsigned char **bytes, size_t *size)
{
    size_t room = 1 << 16;
    for (*size = 0; *size <= MAX_BYTES; room *= 2) {
        unsigned char *grown = realloc(*bytes, room);
        if (!grown) return fracas_no_memory("the campaign file");
        *bytes = grown;
        *size += fread(grown + *size, 1, room - *size, in);
        if (ferror(in))
            return fracas_fail(FRACAS_ENVIRONMENT, "cannot read the campaign file %s: %s", name,
                               strerror(errno));
        if (*size < room) break;
    }
    return FRACAS_OK;
}

static fracas_err load(const char *name, unsigned char **bytes, size_t *size)
{
    OWN(FILE) in = fracas_file_stream(fracas_file_open(name), "rb");
    if (in) return load_open(name, in, bytes, size);
    if (errno == ENOENT) return fracas_fail(FRACAS_USAGE, "there is no campaign file %s", name);
    if (errno == ENXIO)
        return fracas_fail(FRACAS_USAGE, "%s is no file; write the campaign into one", name);
    return fracas_fail(FRACAS_ENVIRONMENT, "cannot open the campaign file %s: %s", name,
                       strerror(errno));
}

/* ---- from bytes to events ---- */

/* Line and column of a byte; a column counts characters, as libyaml's marks do. */
static yaml_mark_t mark_of_byte(const reading *reader, size_t byte)
{
    yaml_mark_t mark = {0};
    for (size_t i = 0; i < byte && i < reader->size; i++) {
        if (reader->bytes[i] == '\n') {
            mark.line++;
            mark.column = 0;
        } else if ((reader->bytes[i] & 0xc0) != 0x80) {
            mark.column++;
        }
    }
    return mark;
}

/* The context of libyaml in the words of docs/formats/campaign-file.md. */
static const char *context_words(const char *context)
{
    static const char *const words[][2] = {
        {"flow sequence", "the list [...]"},    {"flow mapping", "the group {...}"},
        {"block mapping", "the group of keys"}, {"block collection", "the list"},
        {"quoted scalar", "the quoted text"},   {"simple key", "the line"},
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strstr(context, words[i][0])) return words[i][1];
    return "the text";
}

static fracas_err fail_parser(const reading *reader)
{
    const yaml_parser_t *parser = &reader->parser;
    const char *problem = parser->problem ? parser->problem : "not YAML";
    if (parser->error == YAML_MEMORY_ERROR) return fracas_no_memory("the campaign file");
    if (parser->error == YAML_READER_ERROR)
        return fail_at(reader, mark_of_byte(reader, parser->problem_offset),
                       "the file is not plain UTF-8 text (%s); save it as UTF-8", problem);
    const char found = parser->buffer.pointer && parser->unread > 0 ? (char)*parser->buffer.pointer
                                                                    : ' ';
    const bool no_token = strstr(problem, "cannot start any token") != NULL;
    if (strstr(problem, "tab character") || (no_token && found == '\t'))
        return fail_at(reader, parser->problem_mark,
                       "found a tab; indent with spaces, YAML does not allow tabs there");
    if (no_token)
        return fail_at(reader, parser->problem_mark,
                       "a value cannot start with `%c`; put it in quotes", found);
    if (!parser->context) return fail_at(reader, parser->problem_mark, "not YAML: %s", problem);
    return fail_at(reader, parser->problem_mark,
                   "not YAML: %s, in %s that begins at line %zu, column %zu", problem,
                   context_words(parser->context), parser->context_mark.line + 1,
                   parser->context_mark.column + 1);
}

static fracas_err next_event(reading *reader, yaml_event_t *event)
{
    return yaml_parser_parse(&reader->parser, event) ? FRACAS_OK : fail_parser(reader);
}

/* An event, deleted at the end of its scope. */
#define OWN_EVENT __attribute__((cleanup(yaml_event_delete))) yaml_event_t

/* ---- from events to nodes ---- */

static fracas_err make_node(reading *reader, yaml_mark_t mark, fracas_node_type type,
                            fracas_node **node)
{
    if (++reader->nodes > MAX_NODES)
        return fail_at(reader, mark, "more than %d values; write long lists as ranges", MAX_NODES);
    fracas_node *made = fracas_memory_take(reader->memory, 1, sizeof *made);
    if (!made) return fracas_no_memory("the campaign file");
    made->type = type;
    made->line = (int)mark.line + 1;
    made->column = (int)mark.column + 1;
    *node = made;
    return FRACAS_OK;
}

/* Refuses a scalar that is too long, or not on one line. */
static fracas_err check_text(const reading *reader, const yaml_event_t *event)
{
    const unsigned char *text = event->data.scalar.value;
    const size_t length = event->data.scalar.length;
    if (length > MAX_TEXT)
        return fail_at(reader, event->start_mark, "a text of %zu bytes; at most %d are allowed",
                       length, MAX_TEXT);
    for (size_t i = 0; i < length; i++)
        if (text[i] < 0x20 || text[i] == 0x7f)
            return fail_at(reader, event->start_mark,
                           "a text with a line break or control character; write it on one line");
    return FRACAS_OK;
}

static fracas_err read_scalar(reading *reader, const yaml_event_t *event, fracas_node **node)
{
    const size_t length = event->data.scalar.length;
    TRY(make_node(reader, event->start_mark, FRACAS_SCALAR, node));
    char *copy = fracas_memory_take(reader->memory, length + 1, 1);
    if (!copy) return fracas_no_memory("the campaign file");
    memcpy(copy, event->data.scalar.value, length);
    (*node)->text = copy;
    return FRACAS_OK;
}

/* With anchors and aliases a small file could stand for a huge one; tags could change values. */
static fracas_err check_plain(const reading *reader, const yaml_event_t *event)
{
    const yaml_char_t *anchor = NULL, *tag = NULL;
    switch (event->type) {
    case YAML_ALIAS_EVENT: anchor = event->data.alias.anchor; break;
    case YAML_SCALAR_EVENT:
        anchor = event->data.scalar.anchor;
        tag = event->data.scalar.tag;
        break;
    case YAML_SEQUENCE_START_EVENT:
        anchor = event->data.sequence_start.anchor;
        tag = event->data.sequence_start.tag;
        break;
    case YAML_MAPPING_START_EVENT:
        anchor = event->data.mapping_start.anchor;
        tag = event->data.mapping_start.tag;
        break;
    default: break;
    }
    if (anchor)
        return fail_at(reader, event->start_mark,
                       "anchors and aliases (`&`, `*`) are not allowed; write the value out");
    if (tag)
        return fail_at(reader, event->start_mark,
                       "tags (`!`) are not allowed; write the value alone");
    return FRACAS_OK;
}

static fracas_err read_value(reading *reader, const yaml_event_t *event, int depth,
                             fracas_node *earlier, fracas_node **node);

/* `earlier`: the entry of the map that has the key already; NULL: none. */
static fracas_err read_key(reading *reader, const yaml_event_t *event, const fracas_node *map,
                           fracas_node **key, fracas_node **earlier)
{
    TRY(fracas_faults_note(reader->faults, check_plain(reader, event)));
    if (event->type != YAML_SCALAR_EVENT)
        return fail_at(reader, event->start_mark,
                       "a list or map where a key is expected; write `key: value`");
    TRY(check_text(reader, event));
    TRY(read_scalar(reader, event, key));
    if (map->count == MAX_KEYS)
        return fail_at(reader, event->start_mark, "more than %d keys in one place", MAX_KEYS);
    *earlier = fracas_node_find(map, (*key)->text);
    if (!*earlier) return FRACAS_OK;
    return fracas_faults_note(
        reader->faults,
        fail_at(reader, event->start_mark,
                "key `%s` is given twice; it is already at line %d, keep one of the two",
                (*key)->text, (*earlier)->key->line));
}

/* Takes the entries of a list or map up to its end, behind those that it has. */
static fracas_err read_entries(reading *reader, int depth, fracas_node *parent)
{
    fracas_node **end = &parent->first;
    while (*end) end = &(*end)->next;
    for (;;) {
        OWN_EVENT event = {0};
        OWN_EVENT after = {0};
        TRY(next_event(reader, &event));
        if (event.type == YAML_SEQUENCE_END_EVENT || event.type == YAML_MAPPING_END_EVENT)
            return FRACAS_OK;
        fracas_node *key = NULL, *value = NULL, *earlier = NULL;
        const bool map = parent->type == FRACAS_MAP;
        if (map) TRY(read_key(reader, &event, parent, &key, &earlier));
        if (map) TRY(next_event(reader, &after));
        TRY(read_value(reader, map ? &after : &event, depth, earlier, &value));
        if (earlier) continue;
        value->key = key;
        *end = value;
        end = &value->next;
        parent->count++;
    }
}

/* The value of a key or an entry of a list. A map goes into `earlier`, if that is one. */
static fracas_err read_value(reading *reader, const yaml_event_t *event, int depth,
                             fracas_node *earlier, fracas_node **node)
{
    const size_t before = fracas_faults_noted(reader->faults);
    const bool scalar = event->type == YAML_SCALAR_EVENT,
               map = event->type == YAML_MAPPING_START_EVENT;
    TRY(fracas_faults_note(reader->faults, check_plain(reader, event)));
    const bool told = fracas_faults_noted(reader->faults) > before;
    if (scalar) TRY(fracas_faults_note(reader->faults, check_text(reader, event)));
    if (event->type == YAML_ALIAS_EVENT ||
        (scalar && fracas_faults_noted(reader->faults) > before + told)) {
        TRY(make_node(reader, event->start_mark, FRACAS_UNREADABLE, node));
    } else if (scalar) {
        TRY(read_scalar(reader, event, node));
    } else if (depth == MAX_DEPTH) {
        return fail_at(reader, event->start_mark,
                       "nested deeper than %d levels; a campaign file needs four", MAX_DEPTH);
    } else if (map && earlier && earlier->type == FRACAS_MAP) {
        *node = earlier;
        return read_entries(reader, depth + 1, earlier);
    } else {
        TRY(make_node(reader, event->start_mark, map ? FRACAS_MAP : FRACAS_LIST, node));
        TRY(read_entries(reader, depth + 1, *node));
    }
    (*node)->told = told || (*node)->type == FRACAS_UNREADABLE;
    return FRACAS_OK;
}

/* ---- the document ---- */

/* Reads events up to and including one of `type`, which must come next. */
static fracas_err skip_event(reading *reader, yaml_event_type_t type, const char *otherwise)
{
    OWN_EVENT event = {0};
    TRY(next_event(reader, &event));
    return event.type == type ? FRACAS_OK : fail_at(reader, event.start_mark, "%s", otherwise);
}

static fracas_err read_document(reading *reader, fracas_node **root)
{
    static const char *const empty =
        "the file is empty; a campaign file starts with `name:`, see docs/formats/campaign-file.md";
    TRY(skip_event(reader, YAML_STREAM_START_EVENT, empty));
    TRY(skip_event(reader, YAML_DOCUMENT_START_EVENT, empty));
    OWN_EVENT event = {0};
    TRY(next_event(reader, &event));
    TRY(read_value(reader, &event, 0, NULL, root));
    TRY(skip_event(reader, YAML_DOCUMENT_END_EVENT, "more after the end"));
    TRY(skip_event(reader, YAML_STREAM_END_EVENT,
                   "a second document; a campaign file is one document, remove `---`"));
    if ((*root)->type == FRACAS_MAP) return FRACAS_OK;
    fracas_faults_place(reader->faults, (*root)->line, (*root)->column, (*root)->told);
    return fracas_fail(
        FRACAS_USAGE,
        "%s:%d:%d: found %s; a campaign file is made of lines `key: value` and of sections",
        reader->name, (*root)->line, (*root)->column,
        (*root)->type == FRACAS_LIST ? "a list" : "a single value");
}

fracas_err fracas_node_read(const char *name, fracas_campaign_memory *memory, fracas_faults *faults,
                            fracas_node **root)
{
    OWNED unsigned char *bytes = NULL;
    size_t size = 0;
    TRY(load(name, &bytes, &size));
    return fracas_node_parse(name, bytes, size, memory, faults, root);
}

fracas_err fracas_node_parse(const char *name, const void *text, size_t size,
                             fracas_campaign_memory *memory, fracas_faults *faults,
                             fracas_node **root)
{
    static const unsigned char mark[] = {0xEF, 0xBB, 0xBF};
    const unsigned char *bytes = text;
    fracas_faults_place(faults, 1, 1, false);
    if (size > MAX_BYTES)
        return fracas_fail(FRACAS_USAGE,
                           "%s:1:1: the file is larger than %d MiB; write long lists of values as "
                           "ranges, {from: ..., to: ..., points: ...}",
                           name, MAX_BYTES >> 20);
    reading reader = {
        .name = name, .bytes = bytes, .size = size, .memory = memory, .faults = faults};
    if (!yaml_parser_initialize(&reader.parser)) return fracas_no_memory("the campaign file");
    yaml_parser_set_encoding(&reader.parser, YAML_UTF8_ENCODING);
    /* Editors on Windows write a byte-order mark. libyaml does not skip it in a given encoding. */
    const bool marked = size >= sizeof mark && memcmp(bytes, mark, sizeof mark) == 0;
    const size_t skipped = marked ? sizeof mark : 0;
    yaml_parser_set_input_string(&reader.parser, bytes + skipped, size - skipped);
    fracas_err err = read_document(&reader, root);
    yaml_parser_delete(&reader.parser);
    return err;
}

fracas_node *fracas_node_find(const fracas_node *map, const char *key)
{
    for (fracas_node *entry = map->first; entry; entry = entry->next)
        if (map->type == FRACAS_MAP && strcmp(entry->key->text, key) == 0) return entry;
    return NULL;
}
