/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/report_keys.h"

#include "campaigns/file/words.h"

#include <string.h>

static const char *const key_names[] = {"x", "series", "panels", "y", NULL};

static bool is_key(const char *text)
{
    return *text && !text[strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_.")];
}

static fracas_err read_key(const fracas_file *file, const fracas_node *node, const char *key,
                           const char **value)
{
    const fracas_node *found = fracas_node_find(node, key);
    if (!found) return FRACAS_OK;
    const char *text = fracas_node_text(found);
    if (!is_key(text))
        return fracas_file_expected(file, found, key,
                                    "the path of a parameter, as strength.shape, or of `x` the key "
                                    "of a statistic, as size.mean");
    *value = text;
    return FRACAS_OK;
}

/* A key, or a list of them, as "a,b". */
static fracas_err read_statistics(const fracas_file *file, const fracas_node *node,
                                  const char **value)
{
    const fracas_node *found = fracas_node_find(node, "y");
    size_t size = 1;
    if (!found) return FRACAS_OK;
    const fracas_node *first = found->type == FRACAS_LIST ? found->first : found;
    for (const fracas_node *one = first; one; one = one == found ? NULL : one->next) {
        if (!is_key(fracas_node_text(one)))
            return fracas_file_expected(
                file, one, "y", "the key of a statistic, as aspect, or [aspect, onset_time]");
        size += strlen(one->text) + 1;
    }
    char *text = fracas_memory_take(file->memory, size, 1);
    if (!text) return fracas_no_memory("the campaign file");
    if (first) *value = text;
    for (const fracas_node *one = first; one; one = one == found ? NULL : one->next)
        text += sprintf(text, "%s%s", one == first ? "" : ",", one->text);
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
    TRY(fracas_file_note(file, read_key(file, node, "series", &keys->series)));
    TRY(fracas_file_note(file, read_key(file, node, "panels", &keys->panels)));
    return read_statistics(file, node, &keys->y);
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
    TRY(fracas_file_note(file, check_key(file, "series", keys->series, false, table)));
    return check_key(file, "panels", keys->panels, false, table);
}

void fracas_report_keys_write(const fracas_report_keys *keys, FILE *out)
{
    const char *between = "report: {";
    if (keys->x) fprintf(out, "%sx: %s", between, keys->x), between = ", ";
    if (keys->series) fprintf(out, "%sseries: %s", between, keys->series), between = ", ";
    if (keys->panels) fprintf(out, "%spanels: %s", between, keys->panels), between = ", ";
    for (const char *y = keys->y; y; y = strchr(y, ',') ? strchr(y, ',') + 1 : NULL) {
        fprintf(out, "%s%s%.*s", y == keys->y ? between : ", ", y == keys->y ? "y: [" : "",
                (int)strcspn(y, ","), y);
    }
    if (keys->x || keys->series || keys->panels || keys->y) fputs(keys->y ? "]}\n" : "}\n", out);
}
