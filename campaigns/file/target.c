/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/target.h"

#include "campaigns/file/words.h"

#include <stdio.h>
#include <string.h>

/* The section named before the dot of a path, or NULL. */
static const fracas_file_section *section_before_dot(const fracas_catalog *catalog,
                                                     const char *path)
{
    const char *dot = strchr(path, '.');
    for (size_t s = 0; dot && s < catalog->nsections; s++) {
        const char *name = catalog->section[s].table->name;
        if (strlen(name) == (size_t)(dot - path) && strncmp(name, path, strlen(name)) == 0)
            return &catalog->section[s];
    }
    return NULL;
}

static fracas_err unknown_path(const fracas_file *file, const fracas_node *key,
                               const char *const *also)
{
    const fracas_catalog *catalog = file->catalog;
    const fracas_file_section *inside = section_before_dot(catalog, key->text);
    fracas_words words;
    fracas_words_init(&words, key->text);
    for (size_t i = 0; i < catalog->nleaves; i++)
        if (catalog->leaf[i].section->table->hashed &&
            (!inside || catalog->leaf[i].section == inside))
            fracas_words_add(&words, catalog->leaf[i].path);
    if (!inside) { /* all paths were compared; list the sections */
        words.used = 0;
        for (; *also; also++) fracas_words_add(&words, *also);
        for (size_t s = 0; s < catalog->nsections; s++)
            if (catalog->section[s].table->hashed)
                fracas_words_add(&words, catalog->section[s].table->name);
    }
    char hint[600], label[80];
    snprintf(label, sizeof label, inside ? "paths in %s" : "known are section.key, and",
             inside ? inside->table->name : "");
    return fracas_file_error(file, key, "unknown path `%s` in the sweep%s", key->text,
                             fracas_words_hint(&words, label, hint));
}

fracas_err fracas_target_find(const fracas_file *file, const fracas_node *key,
                              const char *const *also, fracas_target *found)
{
    *found = (fracas_target){.leaf = fracas_catalog_leaf(file->catalog, key->text)};
    if (!found->leaf) found->section = fracas_catalog_section(file->catalog, key->text);
    if (strcmp(key->text, "replicas") == 0)
        return fracas_file_error(
            file, key,
            "`replicas` is not a parameter to sweep; a case of `cases` may have its own");
    if (strcmp(key->text, "name") == 0 || strcmp(key->text, "seed") == 0)
        return fracas_file_error(file, key,
                                 "`%s` cannot be swept; a campaign has one, at the top of the file",
                                 key->text);
    if (!found->leaf && !found->section) return unknown_path(file, key, also);
    const fracas_section *table = (found->leaf ? found->leaf->section : found->section)->table;
    if (table->hashed) return FRACAS_OK;
    return fracas_file_error(file, key, "`%s` cannot be swept; it is one for the whole campaign",
                             key->text);
}
