/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/names.h"

#include "campaigns/file/attach.h"

#include <stdio.h>
#include <string.h>

/* ---- values in maps ---- */

/* The value that a map of the file or of a case gives a key: `section: {key: ...}`, or
 * `section.key`. */
static const fracas_node *value_in(const fracas_node *map, const char *section, const char *key)
{
    char path[200];
    snprintf(path, sizeof path, "%s.%s", section, key);
    const fracas_node *below = fracas_node_find(map, section),
                      *inside = below ? fracas_node_find(below, key) : NULL;
    return inside ? inside : fracas_node_find(map, path);
}

typedef struct {
    const fracas_file *file;
    const fracas_section *table;
    const fracas_node *own; /* a map of the section; NULL: none */
} scope;

/* The nearest value of a key; NULL: none. */
static const fracas_node *nearest_value(const scope *of, const char *key)
{
    const char *section = of->table->name;
    const fracas_node *value = of->own ? fracas_node_find(of->own, key) : NULL;
    if (!value && of->file->within) value = value_in(of->file->within, section, key);
    return value ? value : value_in(of->file->root, section, key);
}

/* The kind by the nearest selector; NULL: none is named, or several. */
static const fracas_kind *kind_of(const scope *of)
{
    const fracas_node *selector = nearest_value(of, fracas_section_selector(of->table));
    for (size_t k = 0; selector && k < of->table->nkinds; k++)
        if (strcmp(of->table->kinds[k]->name, fracas_node_text(selector)) == 0)
            return of->table->kinds[k];
    return NULL;
}

/* The parameter of the kind that is a file; NULL: it has none. */
static const fracas_param *file_param(const fracas_kind *kind)
{
    for (size_t p = 0; kind && p < kind->nparams; p++)
        if (kind->params[p].type == FRACAS_ATTACHMENT) return &kind->params[p];
    return NULL;
}

/* ---- files ---- */

typedef struct {
    const scope *scope;
    const char *key; /* whose value names a file */
    char path[200];  /* section.key */
    /* Called for each file. */
    fracas_err (*visit)(void *context, const fracas_attachment *of);
    void *context;
} visitor;

/* The file, or files of a list, that `value` names. An error of them is told where they are read.
 */
static fracas_err visit_value(const visitor *v, const fracas_node *value)
{
    const void *of;
    for (const fracas_node *one = value->type == FRACAS_LIST ? value->first : NULL; one;
         one = one->next)
        TRY(visit_value(v, one));
    if (value->type != FRACAS_SCALAR || !*value->text) return FRACAS_OK;
    const fracas_err err = fracas_attachment_read(v->scope->file, v->key, value, &of);
    if (err) return err == FRACAS_USAGE ? fracas_file_untold(v->scope->file) : err;
    return v->visit(v->context, of);
}

/* Those below `node`: values of section.key, and of the key in maps of the section. */
static fracas_err visit_below(const visitor *v, const fracas_node *node, bool inside)
{
    for (const fracas_node *entry = node->first; entry; entry = entry->next) {
        const char *key = entry->key ? entry->key->text : "";
        const bool named = strcmp(key, v->path) == 0 || (inside && strcmp(key, v->key) == 0),
                   within = entry->key ? strcmp(key, v->scope->table->name) == 0 : inside;
        TRY(named ? visit_value(v, entry) : visit_below(v, entry, within));
    }
    return FRACAS_OK;
}

/* The file beside the name, or else, or with `all`, all that the campaign names. */
static fracas_err visit_files(const scope *of, const fracas_param *param, bool all,
                              fracas_err (*visit)(void *, const fracas_attachment *), void *context)
{
    visitor v = {.scope = of, .key = param->name, .visit = visit, .context = context};
    const fracas_node *beside = of->own ? fracas_node_find(of->own, param->name) : NULL;
    snprintf(v.path, sizeof v.path, "%s.%s", of->table->name, param->name);
    if (!beside && of->file->within)
        beside = value_in(of->file->within, of->table->name, param->name);
    return beside && !all ? visit_value(&v, beside) : visit_below(&v, of->file->root, false);
}

/* ---- names ---- */

typedef struct {
    const scope *scope;
    const fracas_node *at;
    const char *name, *key;              /* NULL: no file has it so far */
    const fracas_attachment *has, *not ; /* a file that has it, and one that has it not */
} meaning;

static fracas_err look_up(void *context, const fracas_attachment *of)
{
    meaning *m = context;
    const fracas_file *file = m->scope->file;
    const char *key = m->name;
    const fracas_err err = m->scope->table->rename(of, &key);
    if (err) return err == FRACAS_USAGE ? fracas_file_error_within(file, m->at, m->name) : err;
    if (key == m->name) {
        m->not = of;
    } else if (m->key && strcmp(m->key, key) != 0) {
        return fracas_file_error(file, m->at,
                                 "`%s` is %s in %s, and %s in %s: name it beside each file, in "
                                 "`cases`, or let it be one in both",
                                 m->name, m->key, m->has->path, key, of->path);
    } else {
        m->key = key;
        m->has = of;
    }
    return FRACAS_OK;
}

fracas_err fracas_name_to_key(const fracas_file *file, const fracas_file_section *section,
                              const fracas_node *own, const fracas_node *at, const char **key)
{
    const fracas_section *table = section->table;
    const scope of = {file, table, own};
    const fracas_kind *kind = table->rename ? kind_of(&of) : NULL;
    const fracas_param *param = file_param(kind);
    meaning m = {.scope = &of, .at = at, .name = *key};
    if (!param || strcmp(*key, fracas_section_selector(table)) == 0 ||
        fracas_section_param(table, kind, NULL, *key))
        return FRACAS_OK;
    TRY(visit_files(&of, param, false, look_up, &m));
    if (m.key && m.not )
        return fracas_file_error(file, at,
                                 "%s has the name `%s`, and %s has not: name it beside each file "
                                 "that has it, in `cases`",
                                 m.has->path, m.name, m.not ->path);
    if (m.key && own && own == fracas_node_find(file->root, table->name))
        TRY(visit_files(&of, param, true, look_up, &m)); /* points with other files have it, too */
    if (m.key) *key = m.key;
    return FRACAS_OK;
}

typedef struct {
    const scope *scope;
    const char *before;
    fracas_words *words;
} listing;

static fracas_err add_names(void *context, const fracas_attachment *of)
{
    listing *list = context;
    char name[FRACAS_RENAMED];
    for (size_t i = 0; i < 16 && list->scope->table->renames(of, i, name); i++) {
        const size_t size = strlen(list->before) + sizeof name;
        char *word = fracas_memory_take(list->scope->file->memory, size, 1);
        if (!word) return fracas_no_memory("the names in a file");
        snprintf(word, size, "%s%s", list->before, name);
        fracas_words_add(list->words, word);
    }
    return FRACAS_OK;
}

fracas_err fracas_names_add(const fracas_file *file, const fracas_file_section *section,
                            const fracas_node *own, const char *before, fracas_words *words)
{
    const scope of = {file, section->table, own};
    const fracas_param *param = section->table->rename ? file_param(kind_of(&of)) : NULL;
    listing list = {&of, before, words};
    return param ? visit_files(&of, param, false, add_names, &list) : FRACAS_OK;
}

/* ---- no file ---- */

static fracas_err count_file(void *context, const fracas_attachment *of)
{
    (void)of;
    ++*(size_t *)context;
    return FRACAS_OK;
}

enum { NEAR = 2 }; /* letters between a misspelt key and a known one */

/* True if the key that names stand for takes the value, or the first of a list. */
static bool is_value_of_name(const fracas_file *file, const fracas_file_section *section,
                             const fracas_node *value)
{
    const fracas_kind *choice[FRACAS_MOST_CHOICES];
    const char *renamed = section->table->renamed;
    const fracas_leaf *leaf = renamed ? fracas_catalog_key(file->catalog, section, renamed) : NULL;
    const size_t count = leaf ? fracas_leaf_choices(leaf, choice) : 0;
    const fracas_node *first = value->type == FRACAS_LIST ? value->first : value;
    for (size_t c = 0; first && c < count; c++)
        if (strcmp(choice[c]->name, fracas_node_text(first)) == 0) return true;
    return false;
}

fracas_err fracas_names_ask_for_file(const fracas_file *file, const fracas_file_section *section,
                                     const fracas_node *own, const fracas_node *value,
                                     fracas_words *words, fracas_names_question *ask)
{
    const fracas_section *table = section->table;
    const scope of = {file, table, own};
    const fracas_param *param = table->rename ? file_param(kind_of(&of)) : NULL;
    size_t files = 0;
    *ask->text = 0;
    const bool misspelt = words->nearest && words->distance <= NEAR;
    if (misspelt || !is_value_of_name(file, section, value)) return FRACAS_OK;
    if (param) TRY(visit_files(&of, param, false, count_file, &files));
    if (files) return FRACAS_OK;
    words->nearest = NULL;
    for (size_t k = 0; k < table->nkinds; k++)
        if (file_param(table->kinds[k]))
            snprintf(ask->text, sizeof ask->text,
                     "; if it is a name in a file, give that file: `%s: {%s: %s, %s: ...}`",
                     table->name, fracas_section_selector(table), table->kinds[k]->name,
                     file_param(table->kinds[k])->name);
    return FRACAS_OK;
}
