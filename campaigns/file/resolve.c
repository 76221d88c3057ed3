#include "campaigns/file/resolve.h"

#include "campaigns/file/say.h"

#include <string.h>

/* The kind that the base gives to a section, and the setting that says so (NULL: it is the default). */
static const fracas_kind *kind_of(const fracas_file *file, const fracas_setting *const *settings,
                                  const fracas_file_section *section, const fracas_setting **chosen)
{
    const fracas_leaf *selector = fracas_catalog_selector(file->catalog, section);
    *chosen = selector ? settings[selector - file->catalog->leaf] : NULL;
    if (*chosen) return (*chosen)->kind;
    return selector ? section->table->kinds[0] : NULL;
}

fracas_err fracas_draft_check_base(const fracas_file *file, const fracas_draft *draft)
{
    for (size_t i = 0; i < file->catalog->nleaves; i++) {
        const fracas_leaf *leaf = &file->catalog->leaf[i];
        const fracas_setting *setting = draft->base[i], *chosen;
        if (!setting || !leaf->param) continue;
        const fracas_kind *kind = kind_of(file, draft->base, leaf->section, &chosen);
        bool common;
        const fracas_param *param = fracas_section_param(leaf->section->table, kind, leaf->key, &common);
        if (!param) return fracas_setting_misplaced(file, setting, kind, chosen);
        TRY(fracas_setting_check(file, setting, param));
    }
    return FRACAS_OK;
}

/* A value that the point needs and nothing gives; its place is where the kind was chosen, the section, or the file. */
static fracas_err missing(const fracas_file *file, const fracas_leaf *leaf, const fracas_param *param, bool common,
                          const fracas_kind *kind, const fracas_setting *chosen)
{
    const fracas_section *table = leaf->section->table;
    const fracas_node *section = fracas_node_find(file->root, table->name);
    const char *what, *write_in;
    fracas_units_describe(param->unit, &what, &write_in);
    if (param->type == FRACAS_INTEGER) what = "a whole number";
    const char *unit = strcmp(param->unit, "1") == 0 ? "" : ", in ";
    if (!*unit) write_in = "";
    const fracas_node *at = !common && chosen ? chosen->node : section ? section->key : file->root;
    if (common || !kind)
        return fracas_say(file->name, at, "%s needs `%s` (%s): %s%s%s", table->name, leaf->key, param->doc, what, unit,
                          write_in);
    return fracas_say(file->name, at, "%s with %s %s%s needs `%s` (%s): %s%s%s", table->name,
                      table->selector ? table->selector : table->name, kind->name, chosen ? "" : " (the default)",
                      leaf->key, param->doc, what, unit, write_in);
}

fracas_err fracas_draft_resolve(const fracas_file *file, const fracas_draft *draft, const fracas_file_section *section,
                                void *owner)
{
    const fracas_catalog *catalog = file->catalog;
    const fracas_section *table = section->table;
    const fracas_setting *chosen, *swept;
    const fracas_kind *base_kind = kind_of(file, draft->base, section, &chosen);
    const fracas_kind *swept_kind = kind_of(file, draft->swept, section, &swept);
    const fracas_kind *kind = swept ? swept_kind : base_kind;
    if (swept) chosen = swept;
    char *values = fracas_section_at(section, owner);
    const fracas_node *last = chosen ? chosen->node : file->root; /* the value that a contradiction is told at */
    if (kind) memcpy(values + table->kind_offset, &kind, sizeof kind);
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        if (leaf->section != section || !leaf->param) continue;
        bool common;
        const fracas_param *param = fracas_section_param(table, kind, leaf->key, &common);
        if (!param && draft->swept[i]) return fracas_setting_misplaced(file, draft->swept[i], kind, chosen);
        if (!param) continue;
        const fracas_setting *setting = draft->swept[i];
        if (!setting && (common || kind == base_kind)) setting = draft->base[i];
        if (setting) last = setting->node;
        if (setting) TRY(fracas_setting_check(file, setting, param));
        else if (isnan(param->fallback)) return missing(file, leaf, param, common, kind, chosen);
        fracas_param_set(param, values, setting ? setting->value : fracas_number_round(param->fallback));
    }
    if (table->check && table->check(values)) return fracas_say_within(file->name, last, table->name);
    return FRACAS_OK;
}
