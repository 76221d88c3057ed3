/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/catalog.h"

#include "base/units.h"
#include "campaigns/file/chosen.h"
#include "engine/record.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const fracas_kind reactions_of_edges =
                             {.name = "edges",
                              .doc = "of each held edge of a surface, at the times of the history"},
                         *const reactions[] = {&reactions_of_edges};
static const fracas_param output_params[] = {
    {"history", FRACAS_INTEGER, "1",
     "equal intervals of time.end at which energies are kept; 0: only at onset, energy peak and "
     "end",
     100, 0, FRACAS_MOST_HISTORY, false, offsetof(fracas_output, history)},
    {"interfaces", FRACAS_BOOLEAN, "1",
     "keep strength, damage, onset and break time of every interface", 0, 0, 1, false,
     offsetof(fracas_output, interfaces)},
    {FRACAS_ONE_OF("reactions", reactions, offsetof(fracas_output, reactions),
                   "forces to be kept over time"),
     .optional = true},
};
static const fracas_section output_section = {
    .name = "output",
    .doc = "What is kept beside the results of every realization",
    .params = output_params,
    .nparams = FRACAS_COUNT(output_params),
};

enum { MOST_PARTS = 1024 };
static const fracas_param parallel_params[] = {
    {"parts", FRACAS_INTEGER, "1",
     "parts of a surface, each computed by a thread of its own; 0: 1, or more where fewer "
     "realizations are left than jobs",
     0, 0, MOST_PARTS, false, offsetof(fracas_parallel, parts)},
};
static const fracas_section parallel_section = {
    .name = "parallel",
    .doc = "How a run uses the cores; the results are the same",
    .params = parallel_params,
    .nparams = FRACAS_COUNT(parallel_params),
    .run = true,
};

/* ---- the list of leaves ---- */

static fracas_err make_sections(fracas_campaign_memory *memory, fracas_catalog *catalog)
{
    size_t count = fracas_engine_nsections + 4;
    fracas_file_section *section = fracas_memory_take(memory, count, sizeof *section);
    if (!section) return fracas_no_memory("the list of sections");
    for (size_t i = 0; i < fracas_engine_nsections; i++)
        section[i] = (fracas_file_section){
            fracas_engine_sections[i],
            offsetof(fracas_point, spec) + fracas_engine_sections[i]->offset};
    section[count - 4] = (fracas_file_section){&fracas_strength_section,
                                               offsetof(fracas_point, strength)};
    section[count - 3] = (fracas_file_section){&output_section, offsetof(fracas_campaign, output)};
    section[count - 2] = (fracas_file_section){&fracas_fields_section,
                                               offsetof(fracas_campaign, fields)};
    section[count - 1] = (fracas_file_section){&parallel_section,
                                               offsetof(fracas_campaign, parallel)};
    catalog->section = section;
    catalog->nsections = count;
    return FRACAS_OK;
}

/* Upper bound of a section's leaves. */
static size_t most_leaves(const fracas_section *section)
{
    size_t count = (section->nkinds > 0) + section->nparams;
    for (size_t k = 0; k < section->nkinds; k++) count += section->kinds[k]->nparams;
    return count;
}

typedef struct {
    fracas_campaign_memory *memory;
    fracas_leaf *leaf;
    size_t count;
} leaf_list;

static fracas_err add_leaf(leaf_list *list, const fracas_file_section *section, const char *key,
                           const fracas_param *param)
{
    for (size_t i = 0; i < list->count; i++)
        if (list->leaf[i].section == section && strcmp(list->leaf[i].key, key) == 0)
            return FRACAS_OK;
    const char *name = section->table->name;
    size_t size = strlen(name) + 1 + strlen(key) + 1;
    char *path = fracas_memory_take(list->memory, size, 1);
    if (!path) return fracas_no_memory("the list of keys");
    if (key == name) snprintf(path, size, "%s", name);
    else snprintf(path, size, "%s.%s", name, key);
    list->leaf[list->count++] = (fracas_leaf){section, path, key, param};
    return FRACAS_OK;
}

static fracas_err add_params(leaf_list *list, const fracas_file_section *section,
                             const fracas_param *params, size_t count)
{
    for (size_t p = 0; p < count; p++) TRY(add_leaf(list, section, params[p].name, &params[p]));
    return FRACAS_OK;
}

static fracas_err add_leaves(leaf_list *list, const fracas_file_section *section)
{
    const fracas_section *table = section->table;
    if (table->nkinds > 0) TRY(add_leaf(list, section, fracas_section_selector(table), NULL));
    TRY(add_params(list, section, table->params, table->nparams));
    for (size_t k = 0; k < table->nkinds; k++)
        TRY(add_params(list, section, table->kinds[k]->params, table->kinds[k]->nparams));
    return FRACAS_OK;
}

static int by_path(const void *a, const void *b)
{
    return strcmp(((const fracas_leaf *)a)->path, ((const fracas_leaf *)b)->path);
}

fracas_err fracas_catalog_make(fracas_campaign_memory *memory, const fracas_catalog **catalog)
{
    fracas_catalog *made = fracas_memory_take(memory, 1, sizeof *made);
    if (!made) return fracas_no_memory("the list of keys");
    TRY(make_sections(memory, made));
    size_t most = 0;
    for (size_t s = 0; s < made->nsections; s++) most += most_leaves(made->section[s].table);
    leaf_list list = {.memory = memory,
                      .leaf = fracas_memory_take(memory, most, sizeof *list.leaf)};
    if (!list.leaf) return fracas_no_memory("the list of keys");
    for (size_t s = 0; s < made->nsections; s++) TRY(add_leaves(&list, &made->section[s]));
    qsort(list.leaf, list.count, sizeof *list.leaf, by_path);
    made->leaf = list.leaf;
    made->nleaves = list.count;
    *catalog = made;
    return FRACAS_OK;
}

/* ---- look-up ---- */

const fracas_file_section *fracas_catalog_section(const fracas_catalog *catalog, const char *name)
{
    for (size_t s = 0; s < catalog->nsections; s++)
        if (strcmp(catalog->section[s].table->name, name) == 0) return &catalog->section[s];
    return NULL;
}

const fracas_file_section *fracas_catalog_next(const fracas_catalog *catalog,
                                               const fracas_file_section *section)
{
    for (size_t s = 0; s < catalog->nsections; s++)
        if (catalog->section[s].table->follows == section->table) return &catalog->section[s];
    return NULL;
}

const fracas_leaf *fracas_catalog_leaf(const fracas_catalog *catalog, const char *path)
{
    for (size_t i = 0; i < catalog->nleaves; i++)
        if (strcmp(catalog->leaf[i].path, path) == 0) return &catalog->leaf[i];
    return NULL;
}

const fracas_leaf *fracas_catalog_key(const fracas_catalog *catalog,
                                      const fracas_file_section *section, const char *key)
{
    for (size_t i = 0; i < catalog->nleaves; i++)
        if (catalog->leaf[i].section == section &&
            (key ? strcmp(catalog->leaf[i].key, key) == 0 : !catalog->leaf[i].param))
            return &catalog->leaf[i];
    return NULL;
}

/* The parameter `key` at points of `model` (NULL: any model). */
static const fracas_param *find_param(const fracas_param *params, size_t count,
                                      const fracas_kind *model, const char *key)
{
    for (size_t p = 0; p < count; p++)
        if (strcmp(params[p].name, key) == 0 && (!model || fracas_param_is_of(&params[p], model)))
            return &params[p];
    return NULL;
}

const fracas_param *fracas_section_param(const fracas_section *section, const fracas_kind *kind,
                                         const fracas_kind *model, const char *key)
{
    const fracas_param *param = find_param(section->params, section->nparams, model, key);
    return param || !kind ? param : find_param(kind->params, kind->nparams, model, key);
}

bool fracas_section_common(const fracas_section *section, const fracas_kind *model, const char *key)
{
    if (fracas_section_param(section, NULL, model, key)) return true;
    const bool restricts = fracas_kind_partner(model, section, 0) != NULL;
    for (size_t k = 0;
         restricts ? fracas_kind_partner(model, section, k) != NULL : k < section->nkinds; k++) {
        const fracas_kind *kind = restricts ? fracas_kind_partner(model, section, k)
                                            : section->kinds[k];
        if (!fracas_section_param(section, kind, model, key)) return false;
    }
    return section->nkinds > 0;
}

/* ---- values ---- */

void *fracas_section_at(const fracas_file_section *section, void *owner)
{
    return (char *)owner + section->offset;
}

static const void *section_in(const fracas_file_section *section, const void *owner)
{
    return (const char *)owner + section->offset;
}

const fracas_kind *fracas_section_kind(const fracas_file_section *section, const void *owner)
{
    if (section->table->nkinds == 0) return NULL;
    const char *at = section_in(section, owner);
    return *(const fracas_kind *const *)(const void *)(at + section->table->kind_offset);
}

/* Model of the section's point; NULL for sections of the campaign. */
static const fracas_kind *model_in(const fracas_file_section *section, const void *owner)
{
    return section->table->hashed ? ((const fracas_point *)owner)->spec.formulation : NULL;
}

bool fracas_leaf_get(const fracas_leaf *leaf, const void *owner, fracas_value *value)
{
    const fracas_kind *kind = fracas_section_kind(leaf->section, owner);
    *value = (fracas_value){.real = NAN, .text = ""};
    if (!leaf->param) {
        value->text = kind ? kind->name : "";
        return kind != NULL;
    }
    const fracas_kind *model = model_in(leaf->section, owner);
    const fracas_param *param = fracas_section_param(leaf->section->table, kind, model, leaf->key);
    const void *section = section_in(leaf->section, owner);
    if (!param || !fracas_param_is_given(param, section)) return false;
    if (fracas_param_is_text(param)) value->text = fracas_param_text(param, section);
    else value->real = fracas_param_get(param, section);
    return true;
}

static size_t add_choices(const fracas_param *params, size_t nparams, const char *key,
                          const fracas_kind *choice[FRACAS_MOST_CHOICES], size_t count)
{
    for (size_t p = 0; p < nparams; p++)
        for (size_t c = 0; c < params[p].nchoices && strcmp(params[p].name, key) == 0; c++) {
            size_t at = 0;
            while (at < count && choice[at] != params[p].choices[c]) at++;
            if (at == count && count < FRACAS_MOST_CHOICES) choice[count++] = params[p].choices[c];
        }
    return count;
}

size_t fracas_leaf_choices(const fracas_leaf *leaf, const fracas_kind *choice[FRACAS_MOST_CHOICES])
{
    const fracas_section *table = leaf->section->table;
    size_t count = add_choices(table->params, table->nparams, leaf->key, choice, 0);
    for (size_t k = 0; k < table->nkinds; k++)
        count = add_choices(table->kinds[k]->params, table->kinds[k]->nparams, leaf->key, choice,
                            count);
    return count;
}

bool fracas_leaf_is_text(const fracas_leaf *leaf)
{
    return !leaf->param || fracas_param_is_text(leaf->param);
}

void fracas_leaf_write(const fracas_leaf *leaf, const fracas_value *value,
                       char text[FRACAS_LEAF_TEXT])
{
    if (fracas_leaf_is_text(leaf)) snprintf(text, FRACAS_LEAF_TEXT, "%s", value->text);
    else if (leaf->param->type == FRACAS_BOOLEAN)
        snprintf(text, FRACAS_LEAF_TEXT, "%s", value->real != 0.0 ? "true" : "false");
    else fracas_number_write(value->real, text);
}
