/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/resolve.h"

#include "campaigns/file/expression.h"

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

/* False where an error tells of the setting's value already. */
static bool is_known(const fracas_file *file, const fracas_draft *draft,
                     const fracas_setting *setting)
{
    const bool base = setting == draft->base[setting->leaf - file->catalog->leaf];
    return !setting->wrong && !(base && fracas_file_doubts(file, setting->leaf));
}

/* False where errors leave unknown which kind the section has. */
static bool is_kind_known(const fracas_file *file, const fracas_draft *draft, view of,
                          const fracas_file_section *section)
{
    const fracas_leaf *selector = fracas_catalog_key(file->catalog, section, NULL);
    const fracas_setting *chosen = selected(file, draft, of, section);
    if (chosen) return is_known(file, draft, chosen);
    if (!selector) return true;
    const fracas_file_section *model = file->catalog->section;
    return !fracas_file_doubts(file, selector) &&
           (section == model || is_kind_known(file, draft, of, model));
}

static bool are_kinds_known(const fracas_file *file, const fracas_draft *draft, view of,
                            const fracas_file_section *section)
{
    return is_kind_known(file, draft, of, section) &&
           is_kind_known(file, draft, of, file->catalog->section);
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
    if (section->table->nkinds == 0 || section->table->follows) return NULL;
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
    if (i == 0 && !table->follows) return FRACAS_OK;
    if (by) snprintf(line, sizeof line, "; the model is chosen at line %d", by->node->line);
    return fracas_file_error(file, chosen->node,
                             "`%s`: %s cannot be combined with model %s, which takes %s%s",
                             table->follows ? table->name : chosen->leaf->key, chosen->kind->name,
                             model->name, i == 0 ? "one of its list alone" : takes, line);
}

/* If only the sweep names models, its points are checked later. */
static fracas_err check_base_partners(const fracas_file *file, const fracas_draft *draft)
{
    const fracas_catalog *catalog = file->catalog;
    const fracas_setting *model = selected(file, draft, BASE, catalog->section);
    if (!model || !is_known(file, draft, model)) return FRACAS_OK;
    for (size_t s = 0; s < catalog->nsections; s++) {
        const size_t before = fracas_file_noted(file);
        const fracas_setting *chosen = selected(file, draft, BASE, &catalog->section[s]);
        if (chosen && !is_known(file, draft, chosen)) continue;
        TRY(fracas_file_note(file, check_partner(file, draft, BASE, chosen)));
        if (fracas_file_noted(file) > before) fracas_file_doubt(file, chosen->leaf);
    }
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
    if (!kind)
        return fracas_file_error(file, at, "`%s` belongs to %s %s, and %s has no `%s`: give it one",
                                 setting->leaf->path, selector, names->text,
                                 setting->leaf->section->table->name, selector);
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
    const fracas_section *models = file->catalog->section->table;
    for (size_t m = 0; m < models->nkinds; m++)
        if (fracas_param_is_of(param, models->kinds[m])) add_home(&names, models->kinds[m]);
    return misplaced(file, setting, models->name, &names, model, chosen);
}

/* ---- the sections of the file ---- */

/* A key of another kind may mean that the kind is wrong: nothing is missing in the section then. */
static fracas_err check_base_value(const fracas_file *file, const fracas_draft *draft,
                                   const fracas_setting *setting)
{
    const fracas_leaf *leaf = setting->leaf;
    const fracas_setting *chosen;
    const fracas_kind *kind = kind_of(file, draft, BASE, leaf->section, &chosen);
    const fracas_setting *model = selected(file, draft, BASE, file->catalog->section);
    const fracas_param *any = fracas_section_param(leaf->section->table, kind, NULL, leaf->key);
    const fracas_param *param = model && is_known(file, draft, model)
                                    ? fracas_section_param(leaf->section->table, kind, model->kind,
                                                           leaf->key)
                                    : any;
    if (!any) fracas_file_doubt_section(file, leaf->section, false);
    if (!any) return of_other_kinds(file, setting, kind, chosen);
    if (setting->expression) return FRACAS_OK;
    return fracas_setting_check(file, setting, param ? param : any);
}

fracas_err fracas_draft_check_base(const fracas_file *file, const fracas_draft *draft)
{
    TRY(check_base_partners(file, draft));
    for (size_t i = 0; i < file->catalog->nleaves; i++) {
        const fracas_leaf *leaf = &file->catalog->leaf[i];
        const fracas_setting *setting = draft->base[i];
        const size_t before = fracas_file_noted(file);
        if (!setting || !leaf->param || setting->wrong) continue;
        if (!is_kind_known(file, draft, BASE, leaf->section)) continue;
        TRY(fracas_file_note(file, check_base_value(file, draft, setting)));
        if (fracas_file_noted(file) > before) fracas_file_doubt(file, leaf);
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
        if (!draft->base[i] || !leaf->param || !is_known(file, draft, draft->base[i])) continue;
        if (!is_kind_known(file, draft, BASE, leaf->section)) continue;
        const fracas_kind *kind = kind_of(file, draft, BASE, leaf->section, &chosen);
        if (any_point_has(campaign, leaf->section->table, kind, leaf->key)) continue;
        const fracas_param *param = fracas_section_param(leaf->section->table, kind, NULL,
                                                         leaf->key);
        const fracas_kind *model = model_of(file, draft, POINT, &by);
        TRY(fracas_file_note(file, of_other_models(file, draft->base[i], param, model, by)));
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
    if (param->type == FRACAS_NUMBERS) form = "a list of whole numbers";
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

/* The setting of a leaf that holds at the point; NULL: none. */
static const fracas_setting *setting_of(const fracas_file *file, const fracas_draft *draft,
                                        const fracas_leaf *leaf)
{
    const fracas_section *table = leaf->section->table;
    const fracas_setting *chosen, *before, *by;
    const size_t at = (size_t)(leaf - file->catalog->leaf);
    const fracas_kind *kind = kind_of(file, draft, POINT, leaf->section, &chosen);
    if (draft->swept[at]) return draft->swept[at];
    const bool common = is_inherited(file, draft, table, model_of(file, draft, POINT, &by),
                                     leaf->key);
    return common || kind == kind_of(file, draft, BASE, leaf->section, &before) ? draft->base[at]
                                                                                : NULL;
}

/* ---- expressions ---- */

typedef struct evaluation {
    const fracas_file *file;
    const fracas_draft *draft;
    const fracas_setting *setting;   /* whose expression is evaluated */
    const struct evaluation *within; /* the one that asked for it */
} evaluation;

static fracas_err evaluate(const evaluation *of, const fracas_param *param, double *value);

/* The value of a number of the point: as set, else its default. */
static fracas_err value_of(const evaluation *asker, const fracas_leaf *leaf,
                           fracas_param const **param, double *value)
{
    const fracas_setting *chosen, *by;
    const fracas_file *file = asker->file;
    const fracas_kind *kind = kind_of(file, asker->draft, POINT, leaf->section, &chosen);
    if (!is_kind_known(file, asker->draft, POINT, leaf->section)) return fracas_file_untold(file);
    *param = fracas_section_param(leaf->section->table, kind,
                                  model_of(file, asker->draft, POINT, &by), leaf->key);
    const fracas_setting *setting = setting_of(file, asker->draft, leaf);
    if (*param && ((*param)->type == FRACAS_REAL || (*param)->type == FRACAS_INTEGER)) {
        *value = setting ? setting->value : (*param)->fallback;
        if (setting && !is_known(file, asker->draft, setting)) return fracas_file_untold(file);
        if (setting && setting->expression)
            return evaluate(&(evaluation){file, asker->draft, setting, asker}, *param, value);
        if (setting && fracas_setting_check(file, setting, *param)) return fracas_file_untold(file);
        if (!isnan(*value)) return FRACAS_OK;
        if (!(*param)->optional && file->faults)
            return fracas_file_untold(file); /* it is missing */
    }
    return fracas_fail(FRACAS_USAGE, "`%s` uses %s, which %s", asker->setting->expression,
                       leaf->path,
                       *param ? "has no number: give it one" : "does not belong to this point");
}

static fracas_err look_up(void *context, const char *path, size_t length,
                          fracas_magnitude *quantity)
{
    const evaluation *asker = context;
    char name[200 + 1];
    snprintf(name, sizeof name, "%.*s", (int)length, path);
    const fracas_leaf *leaf = fracas_catalog_leaf(asker->file->catalog, name);
    if (!leaf || !leaf->param || !leaf->section->table->hashed)
        return fracas_fail(FRACAS_USAGE, "`%s` uses %s, which is no number of a point",
                           asker->setting->expression, name);
    const fracas_param *param = NULL;
    double factor;
    TRY(value_of(asker, leaf, &param, &quantity->value));
    return fracas_units_parse(asker->file->units, param->unit, &factor, &quantity->dimension);
}

/* Value of the expression for `param`. */
static fracas_err evaluate(const evaluation *of, const fracas_param *param, double *value)
{
    const char *expression = of->setting->expression, *what, *write_in;
    for (const evaluation *outer = of->within; outer; outer = outer->within)
        if (outer->setting == of->setting)
            return fracas_fail(FRACAS_USAGE, "`%s` needs its own value: break the circle",
                               expression);
    fracas_magnitude quantity, expected = {0};
    TRY(fracas_expression_evaluate(of->file->units, expression, look_up, (void *)of, &quantity));
    TRY(fracas_units_parse(of->file->units, param->unit, &expected.value, &expected.dimension));
    fracas_units_describe(param->unit, &what, &write_in);
    if (!fracas_magnitude_same(&quantity, &expected))
        return fracas_fail(FRACAS_USAGE, "`%s` is not %s", expression, what);
    *value = fracas_number_round(quantity.value);
    if (param->type != FRACAS_INTEGER || *value == floor(*value)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "`%s` is %.15g, no whole number: use ceil, floor or round",
                       expression, *value);
}

/* Gives *setting, which has an expression, its value, in `known`. */
static fracas_err take_value(const fracas_file *file, const fracas_draft *draft,
                             const fracas_param *param, const fracas_setting **setting,
                             fracas_setting *known)
{
    *known = **setting;
    fracas_err err = evaluate(&(evaluation){file, draft, *setting, NULL}, param, &known->value);
    *setting = known;
    return err == FRACAS_USAGE ? fracas_file_error_within(file, known->node, known->leaf->key)
                               : err;
}

/* A section at a point. */
typedef struct {
    const fracas_file *file;
    const fracas_draft *draft;
    const fracas_section *table;
    const fracas_kind *model, *kind;
    const fracas_setting *chosen; /* names the kind; NULL: default */
    char *values;
    const fracas_node *last; /* place of a contradiction */
    bool misplaced;          /* a key of another kind or model is swept */
} resolving;

/* Notes the swept keys of other kinds or models, each for one of its values. */
static fracas_err check_swept(resolving *r, const fracas_file_section *section)
{
    for (size_t i = 0; i < r->file->catalog->nleaves; i++) {
        const fracas_leaf *leaf = &r->file->catalog->leaf[i];
        const fracas_setting *swept = r->draft->swept[i];
        if (leaf->section != section || !leaf->param || !swept || swept->wrong) continue;
        if (fracas_section_param(r->table, r->kind, r->model, leaf->key)) continue;
        r->misplaced = true;
        if (fracas_file_doubts(r->file, leaf)) continue;
        TRY(fracas_file_note(r->file, refuse_swept(r->file, r->draft, swept, r->kind, r->chosen)));
        fracas_file_doubt(r->file, leaf);
    }
    return FRACAS_OK;
}

/* True if the kind of the base needs no such key. */
static bool can_be_left_out(const resolving *r, const fracas_leaf *leaf)
{
    const fracas_setting *chosen;
    const fracas_kind *kind = kind_of(r->file, r->draft, BASE, leaf->section, &chosen);
    const fracas_param *param = fracas_section_param(r->table, kind, r->model, leaf->key);
    return param && param->optional;
}

/* A value that nothing sets: its default, or nothing. */
static fracas_err resolve_unset(const resolving *r, const fracas_leaf *leaf,
                                const fracas_param *param)
{
    if (param->optional) {
        fracas_param_clear(param, r->values);
    } else if (isnan(param->fallback)) {
        if (r->misplaced || fracas_file_doubts(r->file, leaf)) return FRACAS_OK;
        return missing(r->file, leaf, param,
                       !can_be_left_out(r, leaf) &&
                           is_inherited(r->file, r->draft, r->table, r->model, leaf->key),
                       r->kind, r->chosen);
    } else if (fracas_param_is_object(param)) {
        fracas_param_place(param, r->values, NULL);
    } else {
        fracas_param_set(param, r->values, fracas_number_round(param->fallback));
    }
    return FRACAS_OK;
}

static fracas_err resolve_value(resolving *r, const fracas_leaf *leaf, const fracas_param *param)
{
    const fracas_setting *setting = setting_of(r->file, r->draft, leaf);
    fracas_setting known;
    if (!setting) return resolve_unset(r, leaf, param);
    r->last = setting->node;
    if (!is_known(r->file, r->draft, setting)) return FRACAS_OK;
    if (setting->expression) TRY(take_value(r->file, r->draft, param, &setting, &known));
    TRY(fracas_setting_check(r->file, setting, param));
    if (fracas_param_is_object(param)) fracas_param_place(param, r->values, setting->object);
    else fracas_param_set(param, r->values, fracas_setting_number(setting, param));
    return FRACAS_OK;
}

/* True if an error may be about a value of the section. */
static bool is_doubtful(const resolving *r, const fracas_file_section *section)
{
    for (size_t i = 0; i < r->file->catalog->nleaves; i++) {
        const fracas_leaf *leaf = &r->file->catalog->leaf[i];
        const fracas_setting *swept = r->draft->swept[i], *base = r->draft->base[i];
        if (leaf->section != section) continue;
        if (fracas_file_doubts(r->file, leaf) || (swept && swept->wrong) || (base && base->wrong))
            return true;
    }
    return false;
}

fracas_err fracas_draft_resolve(const fracas_file *file, const fracas_draft *draft,
                                const fracas_file_section *section, void *owner)
{
    const fracas_catalog *catalog = file->catalog;
    const fracas_setting *by;
    const size_t before = fracas_file_noted(file);
    resolving r = {.file = file, .draft = draft, .table = section->table};
    if (!are_kinds_known(file, draft, POINT, section) ||
        !are_kinds_known(file, draft, BASE, section))
        return FRACAS_OK; /* values of the base hold at the point if its kinds do */
    r.model = model_of(file, draft, POINT, &by);
    r.kind = kind_of(file, draft, POINT, section, &r.chosen);
    TRY(check_partner(file, draft, POINT, r.chosen));
    r.values = fracas_section_at(section, owner);
    r.last = r.chosen ? r.chosen->node : file->root;
    if (r.kind) memcpy(r.values + r.table->kind_offset, &r.kind, sizeof r.kind);
    TRY(check_swept(&r, section));
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        if (leaf->section != section || !leaf->param) continue;
        const fracas_param *param = fracas_section_param(r.table, r.kind, r.model, leaf->key);
        if (param) TRY(fracas_file_note(file, resolve_value(&r, leaf, param)));
    }
    if (fracas_file_noted(file) > before || is_doubtful(&r, section)) return FRACAS_OK;
    if (r.table->check && r.table->check(r.values))
        return fracas_file_error_within(file, r.last, r.table->name);
    return FRACAS_OK;
}
