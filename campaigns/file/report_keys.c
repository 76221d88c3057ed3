/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/report_keys.h"

#include "campaigns/file/words.h"

#include <string.h>

static const char *const key_names[] = {"x", "series", NULL};

static fracas_err read_key(const fracas_file *file, const fracas_node *node, const char *key,
                           const char **value)
{
    const fracas_node *found = fracas_node_find(node, key);
    if (!found) return FRACAS_OK;
    const char *text = fracas_node_text(found);
    if (!*text || text[strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_.")])
        return fracas_file_expected(file, found, key,
                                    "the path of a parameter, as strength.shape, or of `x` the key "
                                    "of a statistic, as size.mean");
    *value = text;
    return FRACAS_OK;
}

fracas_err fracas_report_keys_read(const fracas_file *file, const fracas_node *node,
                                   fracas_report_keys *keys)
{
    if (node->type != FRACAS_MAP)
        return fracas_file_expected(file, node, "report",
                                    "{x: strength.shape, series: loading.rate}, or one of them");
    bool unknown;
    TRY(fracas_file_check_keys(file, node, key_names, "`report`", &unknown));
    TRY(fracas_file_note(file, read_key(file, node, "x", &keys->x)));
    return read_key(file, node, "series", &keys->series);
}

/* True of "strength.shape", a key of a section. */
static bool is_of_section(const fracas_catalog *catalog, const char *path)
{
    for (size_t s = 0; s < catalog->nsections; s++) {
        const char *name = catalog->section[s].table->name;
        const size_t length = strlen(name);
        if (!strncmp(path, name, length) && (path[length] == '.' || !path[length])) return true;
    }
    return false;
}

static fracas_err check_key(const fracas_file *file, const char *key, const char *path,
                            bool statistics, const fracas_point_table *table)
{
    if (!path) return FRACAS_OK;
    const size_t column = fracas_point_table_find(table, path);
    const bool parameter = column != SIZE_MAX || is_of_section(file->catalog, path);
    if (column != SIZE_MAX && fracas_point_table_varies(table, column)) return FRACAS_OK;
    if (column != SIZE_MAX && !strncmp(path, "derived.", 8)) return FRACAS_OK;
    if (!parameter && statistics) return FRACAS_OK;
    fracas_words words;
    fracas_words_init(&words, path);
    for (size_t c = 0; c < table->ncolumns; c++)
        if (fracas_point_table_varies(table, c)) fracas_words_add(&words, table->column[c].path);
    const fracas_node *node = fracas_node_find(fracas_node_find(file->root, "report"), key);
    return fracas_file_error(
        file, node, "`%s` of `report`: the points do not differ in `%s`%s", key, path,
        *words.list ? fracas_words_hint(&words, "they differ in") : "; they differ in nothing");
}

fracas_err fracas_report_keys_check(const fracas_file *file, const fracas_report_keys *keys,
                                    const fracas_point_table *table)
{
    TRY(fracas_file_note(file, check_key(file, "x", keys->x, true, table)));
    return check_key(file, "series", keys->series, false, table);
}

void fracas_report_keys_write(const fracas_report_keys *keys, FILE *out)
{
    if (!keys->x && !keys->series) return;
    fprintf(out, "report: {%s%s%s%s%s}\n", keys->x ? "x: " : "", keys->x ? keys->x : "",
            keys->x && keys->series ? ", " : "", keys->series ? "series: " : "",
            keys->series ? keys->series : "");
}
