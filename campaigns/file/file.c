/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/file.h"

#include "campaigns/file/words.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

fracas_err fracas_file_error(const fracas_file *file, const fracas_node *at, const char *format,
                             ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (file->faults) fracas_faults_place(file->faults, at->line, at->column, at->told);
    return fracas_fail(FRACAS_USAGE, "%s:%d:%d: %s", file->name, at->line, at->column, text);
}

fracas_err fracas_file_error_within(const fracas_file *file, const fracas_node *at, const char *key)
{
    if (file->faults)
        fracas_faults_place(file->faults, at->line, at->column,
                            at->told || fracas_faults_is_told(file->faults));
    return fracas_fail_within(FRACAS_USAGE, "%s:%d:%d: `%s`", file->name, at->line, at->column,
                              key);
}

fracas_err fracas_file_expected(const fracas_file *file, const fracas_node *at, const char *key,
                                const char *form)
{
    char found[256];
    return fracas_file_error(file, at, "`%s`: found %s; expected %s", key,
                             fracas_node_found(at, found), form);
}

const char *fracas_node_found(const fracas_node *node, char text[256])
{
    if (node->type == FRACAS_SCALAR ? !*node->text : node->count == 0) return "nothing";
    if (node->type == FRACAS_LIST) return "a list";
    if (node->type == FRACAS_MAP) return "a section";
    snprintf(text, 256, "`%s`", node->text);
    return text;
}

/* ---- going on after an error ---- */

fracas_err fracas_file_note(const fracas_file *file, fracas_err err)
{
    return file->faults ? fracas_faults_note(file->faults, err) : err;
}

size_t fracas_file_noted(const fracas_file *file)
{
    return file->faults ? fracas_faults_noted(file->faults) : 0;
}

fracas_err fracas_file_untold(const fracas_file *file)
{
    if (file->faults) fracas_faults_place(file->faults, 0, 0, true);
    return FRACAS_USAGE;
}

void fracas_file_doubt(const fracas_file *file, const fracas_leaf *leaf)
{
    if (file->doubtful) file->doubtful[leaf - file->catalog->leaf] = true;
}

bool fracas_file_doubts(const fracas_file *file, const fracas_leaf *leaf)
{
    return file->doubtful && file->doubtful[leaf - file->catalog->leaf];
}

void fracas_file_doubt_section(const fracas_file *file, const fracas_file_section *section,
                               bool kind)
{
    for (size_t i = 0; i < file->catalog->nleaves; i++) {
        const fracas_leaf *leaf = &file->catalog->leaf[i];
        if ((!section || leaf->section == section) && (kind || leaf->param))
            fracas_file_doubt(file, leaf);
    }
}

/* ---- maps of few keys ---- */

fracas_err fracas_file_need(const fracas_file *file, const fracas_node *map, const char *key,
                            bool unknown, const fracas_node **found, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    *found = fracas_node_find(map, key);
    if (*found) return FRACAS_OK;
    if (unknown) return fracas_file_untold(file);
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return fracas_file_error(file, map, "%s", text);
}

fracas_err fracas_file_check_keys(const fracas_file *file, const fracas_node *map,
                                  const char *const *keys, const char *subject, bool *unknown)
{
    *unknown = false;
    for (const fracas_node *entry = map->first; entry; entry = entry->next) {
        fracas_words words;
        fracas_words_init(&words, entry->key->text);
        bool known = false;
        for (const char *const *key = keys; *key; key++) {
            fracas_words_add(&words, *key);
            known = known || strcmp(*key, entry->key->text) == 0;
        }
        if (known) continue;
        *unknown = true;
        TRY(fracas_file_note(
            file, fracas_file_error(file, entry->key, "unknown key `%s` in %s%s", entry->key->text,
                                    subject, fracas_words_hint(&words, "keys of %s", subject))));
    }
    return FRACAS_OK;
}
