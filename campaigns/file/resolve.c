/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/resolve.h"

#include <stdio.h>
#include <string.h>

/* Settings of a point, or of the sections of the file alone. */
typedef enum { BASE, POINT } view;

static const fracas_setting *selected(const fracas_file *file, const fracas_draft *draft, view of,
                                      const fracas_file_section *section)
{
    const fracas_leaf *selector = fracas_catalog_key(file->catalog, section, NULL);
    if (!selector) return NULL;
    const size_t at = (size_t)(selector - file->catalog->leaf);
    return of == POINT && draft->swept[at] ? draft->swept[at] : draft->base[at];
}

/* The model, and the setting with its name (NULL: default). */
static const fracas_kind *model_of(const fracas_file *file, const fracas_draft *draft, view of,
                                   const fracas_setting **chosen)
{
    const fracas_file_section *section = file->catalog->section;
    *chosen = selected(file, draft, of, section);
    return *chosen ? (*chosen)->kind : section->table->kinds[0];
}

/* The kind of a section, and the setting with its name (NULL: default of the model). */
static const fracas_kind *kind_of(const fracas_file *file, const fracas_draft *draft, view of,
                                  const fracas_file_section *section, const fracas_setting **chosen)
{
    const fracas_setting *by;
    *chosen = selected(file, draft, of, section);
    if (*chosen) return (*chosen)->kind;
    if (section->table->nkinds == 0) return NULL;
    const fracas_kind *partner = fracas_kind_partner(model_of(file, draft, of, &by), section->table,
                                                     0);
    return partner ? partner : section->table->kinds[0];
}

/* Refuses a kind outside the model's list; `chosen` names it (NULL: the default, which fits). */
static fracas_err check_partner(const fracas_file *file, const fracas_draft *draft, view of,
                                const fracas_setting *chosen)
{
    if (!chosen) return FRACAS_OK;
    const fracas_section *table = chosen->leaf->section->table;
    const fracas_setting *by;
    const fracas_kind *model = model_of(file, draft, of, &by), *partner;
    char takes[200] = "", line[60] = "";
    size_t used = 0, i = 0;
    for (; (partner = fracas_kind_partner(model, table, i)); i++) {
        if (partner == chosen->kind) return FRACAS_OK;
        const bool last = !fracas_kind_partner(model, table, i + 1);
        int added = snprintf(takes + used, sizeof takes - used, "%s%s",
                             i == 0 ? ""
                             : last ? " or "
                                    : ", ",
                             partner->name);
        if (used + (size_t)added < sizeof takes) used += (size_t)added;
    }
    if (i == 0) return FRACAS_OK;
    if (by) snprintf(line, sizeof line, "; the model is chosen at line %d", by->node->line);
    return fracas_file_error(file, chosen->node,
                             "`%s`: %s cannot be combined with model %s, which takes %s%s",
                             chosen->leaf->key, chosen->kind->name, model->name, takes, line);
}

/* If only the sweep names models, its points are checked later. */
static fracas_err check_base_partners(const fracas_file *file, const fracas_draft *draft)
{
    const fracas_catalog *catalog = file->catalog;
    if (!selected(file, draft, BASE, catalog->section)) return FRACAS_OK;
    for (size_t s = 0; s < catalog->nsections; s++)
        TRY(check_partner(file, draft, BASE, selected(file, draft, BASE, &catalog->section[s])));
    return FRACAS_OK;
}

/* ---- misplaced keys ---- */

/* Names of kinds, "a or b". */
typedef struct {
    char text[200];
    size_t used;
} homes;

static void add_home(homes *names, const fracas_kind *kind)
{
    const size_t room = sizeof names->text - names->used;
    int added = snprintf(names->text + names->used, room, "%s%s", names->used ? " or " : "",
                         kind->name);
    if ((size_t)added < room) names->used += (size_t)added;
}

/* The point has `kind` instead, named by `selector`. */
static fracas_err misplaced(const fracas_file *file, const fracas_setting *setting,
                            const char *selector, const homes *names, const fracas_kind *kind,
                            const fracas_setting *chosen)
{
    const fracas_node *at = setting->node->key ? setting->node->key : setting->node;
    if (!chosen)
        return fracas_file_error(
            file, at, "`%s` belongs to %s %s; this is %s, the default, as no `%s` is given",
            setting->leaf->key, selector, names->text, kind->name, selector);
    return fracas_file_error(file, at, "`%s` belongs to %s %s; this is %s (line %d)",
                             setting->leaf->key, selector, names->text, kind->name,
                             chosen->node->line);
}

/* The key of `setting` does not belong to `kind`, named by `chosen` (NULL: default). */
static fracas_err of_other_kinds(const fracas_file *file, const fracas_setting *setting,
                                 const fracas_kind *kind, const fracas_setting *chosen)
{
    const fracas_section *table = setting->leaf->section->table;
    homes names = {.used = 0};
    for (size_t k = 0; k < table->nkinds; k++)
        if (fracas_section_param(table, table->kinds[k], NULL, setting->leaf->key))
            add_home(&names, table->kinds[k]);
    return misplaced(file, setting, fracas_section_selector(table), &names, kind, chosen);
}

/* The kind has the key, but not at points of this model. */
static fracas_err of_other_models(const fracas_file *file, const fracas_setting *setting,
                                  const fracas_param *param, const fracas_kind *model,
                                  const fracas_setting *chosen)
{
    homes names = {.used = 0};
    for (const fracas_kind *const *only = param->only; *only; only++) add_home(&names, *only);
    return misplaced(file, setting, file->catalog->section->table->name, &names, model, chosen);
}

/* ---- the sections of the file ---- */

fracas_err fracas_draft_check_base(const fracas_file *file, const fracas_draft *draft)
{
    TRY(check_base_partners(file, draft));
    for (size_t i = 0; i < file->catalog->nleaves; i++) {
        const fracas_leaf *leaf = &file->catalog->leaf[i];
        const fracas_setting *setting = draft->base[i], *chosen;
        if (!setting || !leaf->param) continue;
        const fracas_kind *kind = kind_of(file, draft, BASE, leaf->section, &chosen);
        const fracas_setting *model = selected(file, draft, BASE, file->catalog->section);
        const fracas_param *any = fracas_section_param(leaf->section->table, kind, NULL, leaf->key);
        const fracas_param *param =
            model ? fracas_section_param(leaf->section->table, kind, model->kind, leaf->key) : any;
        if (!any) return of_other_kinds(file, setting, kind, chosen);
        TRY(fracas_setting_check(file, setting, param ? param : any));
    }
    return FRACAS_OK;
}

static bool any_point_has(const fracas_campaign *campaign, const fracas_section *table,
                          const fracas_kind *kind, const char *key)
{
    for (size_t p = 0; p < campaign->npoints; p++)
        if (fracas_section_param(table, kind, campaign->point[p].spec.formulation, key))
            return true;
    return false;
}

fracas_err fracas_draft_check_models(const fracas_file *file, const fracas_draft *draft,
                                     const fracas_campaign *campaign)
{
    for (size_t i = 0; i < file->catalog->nleaves; i++) {
        const fracas_leaf *leaf = &file->catalog->leaf[i];
        const fracas_setting *chosen, *by;
        if (!draft->base[i] || !leaf->param) continue;
        const fracas_kind *kind = kind_of(file, draft, BASE, leaf->section, &chosen);
        if (any_point_has(campaign, leaf->section->table, kind, leaf->key)) continue;
        const fracas_param *param = fracas_section_param(leaf->section->table, kind, NULL,
                                                         leaf->key);
        const fracas_kind *model = model_of(file, draft, POINT, &by);
        return of_other_models(file, draft->base[i], param, model, by);
    }
    return FRACAS_OK;
}

/* ---- a point ---- */

/* The swept key of `setting` belongs to another kind or model. */
static fracas_err refuse_swept(const fracas_file *file, const fracas_draft *draft,
                               const fracas_setting *setting, const fracas_kind *kind,
                               const fracas_setting *chosen)
{
    const fracas_setting *by;
    const fracas_kind *model = model_of(file, draft, POINT, &by);
    const fracas_param *others = fracas_section_param(setting->leaf->section->table, kind, NULL,
                                                      setting->leaf->key);
    return others ? of_other_models(file, setting, others, model, by)
                  : of_other_kinds(file, setting, kind, chosen);
}

/* True if a base value holds at points of this model whatever their kind. */
static bool is_inherited(const fracas_file *file, const fracas_draft *draft,
                         const fracas_section *table, const fracas_kind *model, const char *key)
{
    const fracas_setting *before = selected(file, draft, BASE, file->catalog->section);
    if (fracas_section_param(table, NULL, NULL, key)) return true; /* the section's own */
    return fracas_section_common(table, model, key) &&
           (!before || fracas_section_common(table, before->kind, key));
}

/* A missing value; its place is the choice of the kind, the section, or the file. */
static fracas_err missing(const fracas_file *file, const fracas_leaf *leaf,
                          const fracas_param *param, bool common, const fracas_kind *kind,
                          const fracas_setting *chosen)
{
    const fracas_section *table = leaf->section->table;
    const fracas_node *section = fracas_node_find(file->root, table->name);
    const char *form, *write_in;
    fracas_units_describe(param->unit, &form, &write_in);
    if (param->type == FRACAS_INTEGER) form = "a whole number";
    if (param->type == FRACAS_CHOICE) form = "a name";
    if (param->type == FRACAS_ATTACHMENT) form = "the path of a file";
    const char *unit = strcmp(param->unit, "1") == 0 ? "" : ", in ";
    if (!*unit) write_in = "";
    const fracas_node *at = !common && chosen ? chosen->node : section ? section->key : file->root;
    if (common || !kind)
        return fracas_file_error(file, at, "%s needs `%s` (%s): %s%s%s", table->name, leaf->key,
                                 param->doc, form, unit, write_in);
    return fracas_file_error(file, at, "%s with %s %s%s needs `%s` (%s): %s%s%s", table->name,
                             fracas_section_selector(table), kind->name,
                             chosen ? "" : " (the default)", leaf->key, param->doc, form, unit,
                             write_in);
}

fracas_err fracas_draft_resolve(const fracas_file *file, const fracas_draft *draft,
                                const fracas_file_section *section, void *owner)
{
    const fracas_catalog *catalog = file->catalog;
    const fracas_section *table = section->table;
    const fracas_setting *chosen, *before, *by;
    const fracas_kind *model = model_of(file, draft, POINT, &by);
    const fracas_kind *kind = kind_of(file, draft, POINT, section, &chosen);
    const fracas_kind *base_kind = kind_of(file, draft, BASE, section, &before);
    TRY(check_partner(file, draft, POINT, chosen));
    char *values = fracas_section_at(section, owner);
    const fracas_node *last = chosen ? chosen->node : file->root; /* place of a contradiction */
    if (kind) memcpy(values + table->kind_offset, &kind, sizeof kind);
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        if (leaf->section != section || !leaf->param) continue;
        const fracas_param *param = fracas_section_param(table, kind, model, leaf->key);
        if (!param && draft->swept[i])
            return refuse_swept(file, draft, draft->swept[i], kind, chosen);
        if (!param) continue;
        const bool common = is_inherited(file, draft, table, model, leaf->key);
        const fracas_setting *setting = draft->swept[i];
        if (!setting && (common || kind == base_kind)) setting = draft->base[i];
        if (setting) last = setting->node;
        if (setting) TRY(fracas_setting_check(file, setting, param));
        else if (param->optional) fracas_param_clear(param, values);
        else if (isnan(param->fallback)) return missing(file, leaf, param, common, kind, chosen);
        if (!setting && param->optional) continue;
        if (param->type == FRACAS_ATTACHMENT)
            fracas_param_attach(param, values, setting ? setting->attachment : NULL);
        else
            fracas_param_set(param, values,
                             setting ? setting->value : fracas_number_round(param->fallback));
    }
    if (table->check && table->check(values))
        return fracas_file_error_within(file, last, table->name);
    return FRACAS_OK;
}
