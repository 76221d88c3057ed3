/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/design.h"

#include "campaigns/file/words.h"
#include "sampler/design/correlation.h"
#include "sampler/design/design.h"
#include "sampler/design/uncertain.h"

#include <stdio.h>
#include <string.h>

/* A design being read; arrays are over its parameters. */
typedef struct {
    const fracas_leaf **leaf;
    const fracas_node **node;
    fracas_uncertain *uncertain;
    uint64_t *name;
    double *correlation;
    fracas_design design;
} reading;

static fracas_err need(const fracas_file *file, const fracas_node *map, bool unknown,
                       const char *key, const char *remedy, const fracas_node **found)
{
    return fracas_file_need(file, map, key, unknown, found, "no `%s` is given; %s", key, remedy);
}

static fracas_err read_kind(const fracas_file *file, const fracas_node *map, bool unknown,
                            const char *key, const fracas_kind *const *kinds, size_t count,
                            const fracas_kind **kind)
{
    const fracas_node *node;
    fracas_words words;
    char remedy[500];
    fracas_words_init(&words, key);
    for (size_t k = 0; k < count; k++) fracas_words_add(&words, kinds[k]->name);
    snprintf(remedy, sizeof remedy, "%s can be: %s", key, words.list);
    TRY(need(file, map, unknown, key, remedy, &node));
    return fracas_setting_kind(file, key, node, kinds, count, kind);
}

/* ---- parameters ---- */

/* Only numbers can be drawn. */
static fracas_err check_number(const fracas_file *file, const fracas_node *key,
                               const fracas_target *target)
{
    const fracas_leaf *leaf = target->leaf;
    if (leaf && !fracas_leaf_is_text(leaf) && leaf->param->type != FRACAS_BOOLEAN) return FRACAS_OK;
    return fracas_file_error(
        file, key,
        "`%s` is %s, which cannot be drawn; give it an axis of its own beside the "
        "design, as `- %s: [...]`",
        key->text,
        !leaf         ? "a section"
        : leaf->param ? "no number"
                      : "a kind",
        key->text);
}

/* A number within the range of `param`, as if it were a key of the section. */
static fracas_err read_value(const fracas_file *file, const fracas_file_section *section,
                             const char *path, const fracas_param *param, const fracas_node *node,
                             double *value)
{
    const fracas_leaf leaf = {.section = section, .path = path, .key = param->name, .param = param};
    fracas_setting setting;
    TRY(fracas_setting_read_known(file, &leaf, node, &setting));
    *value = setting.value;
    return fracas_setting_check(file, &setting, param);
}

/* One number of a distribution, "mean: 370 GPa", in the unit of the parameter unless it has its
 * own.
 */
static fracas_err read_number(const fracas_file *file, const fracas_leaf *leaf,
                              const fracas_node *node, const fracas_param *param,
                              fracas_uncertain *uncertain)
{
    fracas_param own = *param;
    if (strcmp(own.unit, FRACAS_OWN_UNIT) == 0) own.unit = leaf->param->unit;
    double value;
    TRY(read_value(file, leaf->section, leaf->path, &own, node, &value));
    fracas_param_set(param, uncertain, value);
    return FRACAS_OK;
}

static fracas_err check_keys(const fracas_file *file, const fracas_node *node,
                             const fracas_kind *kind, bool *unknown)
{
    const char *keys[8] = {"distribution"};
    char subject[80];
    for (size_t i = 0; i < kind->nparams; i++) keys[i + 1] = kind->params[i].name;
    snprintf(subject, sizeof subject, "the distribution %s", kind->name);
    return fracas_file_check_keys(file, node, keys, subject, unknown);
}

static fracas_err read_distribution(const fracas_file *file, const fracas_leaf *leaf,
                                    const fracas_node *node, fracas_uncertain *uncertain)
{
    const fracas_section *table = &fracas_uncertain_section;
    const size_t before = fracas_file_noted(file);
    bool unknown;
    if (node->type != FRACAS_MAP)
        return fracas_file_expected(
            file, node, leaf->path,
            "a distribution, as {distribution: uniform, minimum: ..., maximum: ...}");
    TRY(read_kind(file, node, false, table->selector, table->kinds, table->nkinds,
                  &uncertain->kind));
    TRY(check_keys(file, node, uncertain->kind, &unknown));
    for (size_t i = 0; i < uncertain->kind->nparams; i++) {
        const fracas_param *param = &uncertain->kind->params[i];
        const fracas_node *number = fracas_node_find(node, param->name);
        if (number) TRY(fracas_file_note(file, read_number(file, leaf, number, param, uncertain)));
        else if (param->optional) fracas_param_clear(param, uncertain);
        else if (!isnan(param->fallback)) fracas_param_set(param, uncertain, param->fallback);
        else if (!unknown)
            TRY(fracas_file_note(
                file,
                fracas_file_error(file, node, "`%s` with distribution %s needs `%s` (%s)",
                                  leaf->path, uncertain->kind->name, param->name, param->doc)));
    }
    if (fracas_file_noted(file) > before) return FRACAS_OK;
    return fracas_uncertain_check(uncertain) ? fracas_file_error_within(file, node, leaf->path)
                                             : FRACAS_OK;
}

static fracas_err read_parameter(const fracas_file *file, const fracas_node *node, reading *read)
{
    static const char *const none[] = {NULL};
    const size_t j = read->design.parameters;
    uint64_t word[2];
    fracas_target target;
    TRY(fracas_target_find(file, node, none, &target));
    TRY(check_number(file, node->key, &target));
    read->leaf[j] = target.leaf;
    read->node[j] = node;
    read->design.parameters++;
    const fracas_hash hash = fracas_hash_of(target.leaf->path, strlen(target.leaf->path));
    fracas_hash_words(&hash, word);
    read->name[j] = word[0];
    return read_distribution(file, target.leaf, node, &read->uncertain[j]);
}

static fracas_err read_parameters(const fracas_file *file, const fracas_node *map, reading *read)
{
    if (map->type != FRACAS_MAP || map->count == 0)
        return fracas_file_expected(file, map, "parameters",
                                    "paths with their distributions, below it and indented");
    const size_t d = map->count;
    const size_t most = read->design.type ? fracas_design_most_parameters(read->design.type) : d;
    if (d > most)
        return fracas_file_error(
            file, map->key, "%zu parameters; %s has at most %zu: use another type, or two designs",
            d, read->design.type->name, most);
    read->leaf = fracas_memory_take(file->memory, d, sizeof *read->leaf);
    read->node = fracas_memory_take(file->memory, d, sizeof *read->node);
    read->uncertain = fracas_memory_take(file->memory, d, sizeof *read->uncertain);
    read->name = fracas_memory_take(file->memory, d, sizeof *read->name);
    if (!read->leaf || !read->node || !read->uncertain || !read->name)
        return fracas_no_memory("a design");
    for (const fracas_node *node = map->first; node; node = node->next)
        TRY(fracas_file_note(file, read_parameter(file, node, read)));
    read->design.name = read->name;
    return FRACAS_OK;
}

/* ---- correlation ---- */

static fracas_err find_parameter(const fracas_file *file, const reading *read,
                                 const fracas_node *node, size_t *j)
{
    fracas_words words;
    char found[256];
    fracas_words_init(&words, fracas_node_text(node));
    for (*j = 0; *j < read->design.parameters; ++*j) {
        if (strcmp(words.found, read->leaf[*j]->path) == 0) return FRACAS_OK;
        fracas_words_add(&words, read->leaf[*j]->path);
    }
    return fracas_file_error(file, node, "%s is no parameter of this design%s",
                             fracas_node_found(node, found),
                             fracas_words_hint(&words, "parameters"));
}

static fracas_err read_pair(const fracas_file *file, const fracas_node *node, reading *read)
{
    static const char *const keys[] = {"between", "coefficient", NULL};
    static const fracas_param coefficient = {"coefficient", FRACAS_REAL, "1", .minimum = -1,
                                             .maximum = 1};
    bool unknown;
    const fracas_node *between = fracas_node_find(node, "between"),
                      *number = fracas_node_find(node, "coefficient");
    double value;
    size_t j, k;
    if (!between || !number || between->type != FRACAS_LIST || between->count != 2)
        return fracas_file_error(
            file, node, "a correlation is {between: [PARAMETER, PARAMETER], coefficient: NUMBER}");
    TRY(fracas_file_check_keys(file, node, keys, "a correlation", &unknown));
    TRY(find_parameter(file, read, between->first, &j));
    TRY(find_parameter(file, read, between->first->next, &k));
    TRY(read_value(file, read->leaf[0]->section, coefficient.name, &coefficient, number, &value));
    double *pair[2] = {&read->correlation[j * read->design.parameters + k],
                       &read->correlation[k * read->design.parameters + j]};
    if (j == k)
        return fracas_file_error(file, between,
                                 "`%s` twice; a correlation is between two parameters",
                                 read->leaf[j]->path);
    if (!isnan(*pair[0]))
        return fracas_file_error(
            file, between,
            "the correlation between `%s` and `%s` is given twice; keep one of the two",
            read->leaf[j]->path, read->leaf[k]->path);
    if (fabs(value) == 1)
        return fracas_file_error(
            file, number,
            "`coefficient`: %.15g is out of range; allowed is more than -1 and less than 1: of two "
            "exactly tied parameters, one is not uncertain",
            value);
    *pair[0] = *pair[1] = value;
    return FRACAS_OK;
}

/* Names the first parameter in contradiction with earlier ones, and its strongest correlation. */
static fracas_err check_correlation(const fracas_file *file, const fracas_node *list,
                                    const reading *read)
{
    const size_t d = read->design.parameters;
    double *factor = fracas_memory_take(file->memory, d * d, sizeof *factor), rest;
    size_t j, most = 0;
    if (!factor) return fracas_no_memory("a design");
    if (fracas_correlation_factor(d, read->correlation, factor, &j, &rest)) return FRACAS_OK;
    for (size_t k = 1; k < j; k++)
        if (fabs(read->correlation[j * d + k]) > fabs(read->correlation[j * d + most])) most = k;
    return fracas_file_error(
        file, list,
        "these coefficients contradict each other: those of `%s` with the parameters "
        "before it leave it %.3g of its variance, which must be more than 0; bring "
        "them nearer to 0, that with `%s` first (%.15g)",
        read->leaf[j]->path, rest, read->leaf[most]->path, read->correlation[j * d + most]);
}

static fracas_err read_correlation(const fracas_file *file, const fracas_node *list, reading *read)
{
    const size_t d = read->design.parameters;
    if (!list) return FRACAS_OK;
    if (list->type != FRACAS_LIST || list->count == 0)
        return fracas_file_expected(
            file, list, "correlation",
            "a list, as `- {between: [PARAMETER, PARAMETER], coefficient: 0.5}`");
    read->correlation = fracas_memory_take(file->memory, d * d, sizeof *read->correlation);
    if (!read->correlation) return fracas_no_memory("a design");
    for (size_t i = 0; i < d * d; i++) read->correlation[i] = i % (d + 1) == 0 ? 1.0 : NAN;
    const size_t before = fracas_file_noted(file);
    for (const fracas_node *node = list->first; node; node = node->next)
        TRY(fracas_file_note(file, read_pair(file, node, read)));
    for (size_t i = 0; i < d * d; i++)
        if (isnan(read->correlation[i])) read->correlation[i] = 0.0;
    read->design.correlation = read->correlation;
    return fracas_file_noted(file) > before ? FRACAS_OK : check_correlation(file, list, read);
}

/* ---- values ---- */

static fracas_err draw(const fracas_file *file, const fracas_node *node, const reading *read,
                       fracas_axis *axis)
{
    const size_t d = read->design.parameters, n = read->design.points;
    fracas_probability *p = fracas_memory_take(file->memory, n * d, sizeof *p);
    axis->choice = fracas_memory_take(file->memory, n, sizeof *axis->choice);
    if (!p || !axis->choice) return fracas_no_memory("a design");
    axis->nchoices = n;
    TRY(fracas_design_fill(&read->design, p));
    for (size_t i = 0; i < n * d; i++) {
        const size_t j = i % d, number = i / d + 1;
        fracas_choice *choice = &axis->choice[i / d];
        fracas_setting setting = {.leaf = read->leaf[j], .node = read->node[j], .drawn = number};
        const double drawn = fracas_uncertain_quantile(&read->uncertain[j], p[i]);
        if (!fracas_setting_computable(drawn))
            return fracas_file_error(
                file, setting.node,
                "`%s`: point %zu of the design is beyond all numbers; narrow its distribution",
                setting.leaf->path, number);
        setting.value = setting.leaf->param->type == FRACAS_INTEGER ? floor(drawn + 0.5)
                                                                    : fracas_number_round(drawn);
        choice->node = node;
        TRY(fracas_settings_add(file, &setting, &choice->settings));
    }
    return FRACAS_OK;
}

static fracas_err read_count(const fracas_file *file, const fracas_node *node, bool unknown,
                             size_t *points)
{
    const fracas_node *count;
    int64_t value;
    TRY(need(file, node, unknown, "points", "give a design its number of points, as `points: 64`",
             &count));
    TRY(fracas_setting_integer(file, "points", count, 1, FRACAS_MAX_POINTS, &value));
    *points = (size_t)value;
    return FRACAS_OK;
}

fracas_err fracas_design_read(const fracas_file *file, const fracas_node *node, fracas_axis *axis)
{
    static const char *const keys[] = {"type", "points", "parameters", "correlation", NULL};
    reading read = {.design = {.seed = file->campaign->seed}};
    const size_t before = fracas_file_noted(file);
    bool unknown;
    if (node->type != FRACAS_MAP)
        return fracas_file_expected(file, node, "design",
                                    "`type:`, `points:` and `parameters:`, below it and indented");
    TRY(fracas_file_check_keys(file, node, keys, "a design", &unknown));
    TRY(fracas_file_note(file, read_kind(file, node, unknown, "type", fracas_design_types,
                                         FRACAS_COUNT(fracas_design_types), &read.design.type)));
    const fracas_node *parameters;
    TRY(fracas_file_note(file, read_count(file, node, unknown, &read.design.points)));
    TRY(need(file, node, unknown, "parameters", "give each uncertain path with its distribution",
             &parameters));
    const size_t parameters_before = fracas_file_noted(file);
    TRY(fracas_file_note(file, read_parameters(file, parameters, &read)));
    if (fracas_file_noted(file) == parameters_before)
        TRY(read_correlation(file, fracas_node_find(node, "correlation"), &read));
    return fracas_file_noted(file) > before ? FRACAS_OK : draw(file, node, &read, axis);
}
