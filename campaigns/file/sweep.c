/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/sweep.h"

#include "base/elementary.h"
#include "campaigns/file/design.h"
#include "campaigns/file/names.h"
#include "campaigns/file/words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static fracas_err add_target(const fracas_file *file, const fracas_target *set,
                             const fracas_node *value, fracas_settings *settings)
{
    return set->section ? fracas_settings_add_section(file, set->section, value, settings)
                        : fracas_settings_read(file, set->leaf, value, settings);
}

/* ---- ranges ---- */

/* `{from, to, points, spacing}`: values at equal differences or equal ratios. */
typedef struct {
    double from, to;
    size_t points; /* at least 2 */
    bool logarithmic, whole;
} range;

static fracas_err need(const fracas_file *file, const fracas_node *node, bool unknown,
                       const char *key, const fracas_node **found)
{
    return fracas_file_need(file, node, key, unknown, found,
                            "a range without `%s`; expected {from: ..., to: ..., points: ...}",
                            key);
}

static fracas_err read_end(const fracas_file *file, const fracas_leaf *leaf,
                           const fracas_node *node, bool unknown, const char *key, double *value)
{
    const fracas_node *end;
    fracas_setting setting;
    TRY(need(file, node, unknown, key, &end));
    TRY(fracas_setting_read_known(file, leaf, end, &setting));
    *value = setting.value;
    return FRACAS_OK;
}

static fracas_err read_points(const fracas_file *file, const fracas_node *node, bool unknown,
                              range *made)
{
    const fracas_node *points;
    int64_t count;
    TRY(need(file, node, unknown, "points", &points));
    TRY(fracas_setting_integer(file, "points", points, 2, FRACAS_MAX_POINTS, &count));
    made->points = (size_t)count;
    return FRACAS_OK;
}

/* `ends`: both are known. */
static fracas_err read_spacing(const fracas_file *file, const fracas_node *node, bool ends,
                               range *made)
{
    const fracas_node *spacing = fracas_node_find(node, "spacing");
    if (!spacing) return FRACAS_OK;
    made->logarithmic = strcmp(fracas_node_text(spacing), "log") == 0;
    if (!made->logarithmic && strcmp(fracas_node_text(spacing), "lin") != 0)
        return fracas_file_expected(file, spacing, "spacing",
                                    "lin (equal differences) or log (equal ratios)");
    if (made->logarithmic && ends && (made->from <= 0.0 || made->to <= 0.0))
        return fracas_file_error(
            file, spacing, "spacing log needs `from` and `to` greater than 0; use spacing lin");
    return FRACAS_OK;
}

/* Reads the map `node` as a range of the leaf, a number. Errors in it are noted. */
static fracas_err read_range(const fracas_file *file, const fracas_leaf *leaf,
                             const fracas_node *node, range *made)
{
    static const char *const keys[] = {"from", "to", "points", "spacing", NULL};
    *made = (range){0};
    if (fracas_leaf_is_text(leaf) || leaf->param->type == FRACAS_BOOLEAN)
        return fracas_file_error(file, node,
                                 "`%s` is not a number, so it has no range; expected a list, [...]",
                                 leaf->path);
    made->whole = leaf->param->type == FRACAS_INTEGER;
    bool unknown;
    TRY(fracas_file_check_keys(file, node, keys, "a range", &unknown));
    const size_t before = fracas_file_noted(file);
    TRY(fracas_file_note(file, read_end(file, leaf, node, unknown, "from", &made->from)));
    TRY(fracas_file_note(file, read_end(file, leaf, node, unknown, "to", &made->to)));
    const bool ends = fracas_file_noted(file) == before;
    if (ends && made->from == made->to)
        return fracas_file_error(
            file, node, "a range whose `from` and `to` are equal; write the one value in a list");
    TRY(fracas_file_note(file, read_points(file, node, unknown, made)));
    return read_spacing(file, node, ends, made);
}

/* Value i of 0 .. n-1 with p = i/(n-1): from (1-p) + to p, or from^(1-p) to^p, rounded to 15
 * digits, or to the nearest whole number; exactly `from` and `to` at the ends. The same on every
 * CPU. */
static double value_of(const range *made, size_t i)
{
    if (i == 0) return made->from;
    if (i == made->points - 1) return made->to;
    double part = (double)i / (double)(made->points - 1);
    double value = made->logarithmic
                       ? fracas_pow(made->from, 1.0 - part) * fracas_pow(made->to, part)
                       : made->from * (1.0 - part) + made->to * part;
    return made->whole ? floor(value + 0.5) : fracas_number_round(value);
}

/* ---- axes ---- */

static fracas_err make_choices(const fracas_file *file, const fracas_node *node, size_t count,
                               fracas_axis *axis)
{
    if (count == 0)
        return fracas_file_error(file, node,
                                 "found no values to sweep; give at least one, or remove the axis");
    if (count > FRACAS_MAX_POINTS)
        return fracas_file_error(file, node, "%zu values; a campaign has at most %d points", count,
                                 FRACAS_MAX_POINTS);
    axis->nchoices = count;
    axis->choice = fracas_memory_take(file->memory, count, sizeof *axis->choice);
    return axis->choice ? FRACAS_OK : fracas_no_memory("the sweep");
}

/* Makes the choices for the first path of an axis; all paths have the same number of values. */
static fracas_err match_choices(const fracas_file *file, const fracas_node *values, size_t count,
                                fracas_axis *axis)
{
    if (axis->nchoices == 0) TRY(make_choices(file, values, count, axis));
    if (axis->nchoices == count) return FRACAS_OK;
    return fracas_file_error(file, values->key,
                             "`%s` has %zu values, the first path of this zip has %zu; all of a "
                             "zip need the same number",
                             values->key->text, count, axis->nchoices);
}

static fracas_err add_range(const fracas_file *file, const fracas_target *set,
                            const fracas_node *values, fracas_axis *axis)
{
    if (!set->leaf)
        return fracas_file_error(file, values,
                                 "`%s` is a section; expected a list of sections, [{...}, {...}]",
                                 values->key->text);
    range made;
    const size_t before = fracas_file_noted(file);
    TRY(read_range(file, set->leaf, values, &made));
    if (fracas_file_noted(file) > before) return FRACAS_OK; /* no value is known */
    TRY(match_choices(file, values, made.points, axis));
    for (size_t i = 0; i < made.points; i++) {
        fracas_choice *choice = &axis->choice[i];
        fracas_setting setting = {.leaf = set->leaf, .node = values, .value = value_of(&made, i)};
        if (!choice->node) choice->node = values;
        TRY(fracas_settings_add(file, &setting, &choice->settings));
    }
    return FRACAS_OK;
}

static fracas_err add_list(const fracas_file *file, const fracas_target *set,
                           const fracas_node *values, fracas_axis *axis)
{
    TRY(match_choices(file, values, values->count, axis));
    fracas_choice *choice = axis->choice;
    for (const fracas_node *value = values->first; value; value = value->next, choice++) {
        if (!choice->node) choice->node = value;
        TRY(add_target(file, set, value, &choice->settings));
    }
    return FRACAS_OK;
}

static fracas_err add_path(const fracas_file *file, const fracas_node *values, fracas_axis *axis)
{
    fracas_target set;
    static const char *const axes[] = {"zip", "cases", "design", NULL};
    TRY(fracas_target_find(file, values, axes, &set));
    if (values->type == FRACAS_LIST) return add_list(file, &set, values, axis);
    if (values->type == FRACAS_MAP) return add_range(file, &set, values, axis);
    return fracas_file_expected(
        file, values, values->key->text,
        "a list of values, [...], or a range, {from: ..., to: ..., points: ...}");
}

static fracas_err read_zip(const fracas_file *file, const fracas_node *zip, fracas_axis *axis)
{
    if (zip->type != FRACAS_MAP || zip->count == 0)
        return fracas_file_expected(file, zip, "zip",
                                    "paths with their values, below it and indented");
    fracas_file within = *file;
    within.within = zip;
    for (const fracas_node *values = zip->first; values; values = values->next)
        TRY(fracas_file_note(file, add_path(&within, values, axis)));
    return FRACAS_OK;
}

static fracas_err read_case_entry(const fracas_file *file, const fracas_node *entry,
                                  fracas_choice *choice)
{
    static const char *const own[] = {"name", "replicas", NULL};
    fracas_target set;
    if (strcmp(entry->key->text, "name") == 0)
        return fracas_setting_case_name(file, entry, &choice->name);
    if (strcmp(entry->key->text, "replicas") == 0)
        return fracas_replicas_read(file, entry, &choice->replicas);
    TRY(fracas_target_find(file, entry, own, &set));
    return add_target(file, &set, entry, &choice->settings);
}

static fracas_err read_case(const fracas_file *file, const fracas_node *node, fracas_choice *choice)
{
    char found[256];
    *choice = (fracas_choice){.node = node};
    if (node->type != FRACAS_MAP || node->count == 0)
        return fracas_file_error(file, node,
                                 "a case: found %s; expected `name:`, `replicas:` or sections",
                                 fracas_node_found(node, found));
    fracas_file within = *file;
    within.within = node;
    for (const fracas_node *entry = node->first; entry; entry = entry->next)
        TRY(fracas_file_note(file, read_case_entry(&within, entry, choice)));
    return FRACAS_OK;
}

static fracas_err read_cases(const fracas_file *file, const fracas_node *cases, fracas_axis *axis)
{
    if (cases->type != FRACAS_LIST)
        return fracas_file_expected(file, cases, "cases", "a list, each case after `- `");
    TRY(make_choices(file, cases, cases->count, axis));
    fracas_choice *choice = axis->choice;
    for (const fracas_node *node = cases->first; node; node = node->next)
        TRY(fracas_file_note(file, read_case(file, node, choice++)));
    return FRACAS_OK;
}

static fracas_err read_axis(const fracas_file *file, const fracas_node *node, fracas_axis *axis)
{
    char found[256];
    if (node->type != FRACAS_MAP || node->count == 0)
        return fracas_file_error(
            file, node,
            "an axis of the sweep: found %s; expected `path: [values]`, `zip:`, "
            "`cases:` or `design:`",
            fracas_node_found(node, found));
    if (node->count > 1)
        return fracas_file_error(
            file, node->first->next->key,
            "a second path, `%s`, in one axis; put `- ` before it to combine every value with "
            "every other, or both under `zip:` to go through them together",
            node->first->next->key->text);
    if (strcmp(node->first->key->text, "zip") == 0) return read_zip(file, node->first, axis);
    if (strcmp(node->first->key->text, "cases") == 0) return read_cases(file, node->first, axis);
    if (strcmp(node->first->key->text, "design") == 0)
        return fracas_design_read(file, node->first, axis);
    return add_path(file, node->first, axis);
}

/* ---- axes with errors ---- */

/* Wrong settings for what `entry` names, in all choices of the axis without it. */
static fracas_err doubt_entry(const fracas_file *file, const fracas_node *entry, fracas_axis *axis)
{
    const fracas_leaf *leaf = fracas_catalog_leaf(file->catalog, entry->key->text);
    const fracas_file_section *section = fracas_catalog_section(file->catalog, entry->key->text);
    for (size_t c = 0; (leaf || section) && c < axis->nchoices; c++)
        TRY(fracas_settings_doubt(file, section, leaf, entry, &axis->choice[c].settings));
    return FRACAS_OK;
}

/* Makes the axis `node`, read with errors, one whose values are unknown where they are not read. */
static fracas_err doubt_axis(const fracas_file *file, const fracas_node *node, fracas_axis *axis)
{
    if (axis->nchoices == 0) TRY(make_choices(file, node, 1, axis));
    if (!axis->choice[0].node) axis->choice[0].node = node;
    if (node->type != FRACAS_MAP) fracas_file_doubt_section(file, NULL, true);
    for (const fracas_node *entry = node->type == FRACAS_MAP ? node->first : NULL; entry;
         entry = entry->next) {
        const fracas_node *parameters = fracas_node_find(entry, "parameters");
        const fracas_node *inside = strcmp(entry->key->text, "design") == 0 ? parameters : entry;
        TRY(doubt_entry(file, entry, axis));
        if (strcmp(entry->key->text, "cases") == 0 && entry->type != FRACAS_LIST)
            fracas_file_doubt_section(file, NULL, true);
        for (inside = inside && inside->type == FRACAS_MAP ? inside->first : NULL; inside;
             inside = inside->next)
            TRY(doubt_entry(file, inside, axis));
    }
    return FRACAS_OK;
}

/* ---- the sweep ---- */

/* Each leaf has one axis: the order of the axes does not matter. */
static fracas_err check_axes_apart(const fracas_file *file, const fracas_sweep *sweep,
                                   const fracas_setting **owner, size_t *owner_axis)
{
    for (size_t a = 0; a < sweep->naxes; a++)
        for (size_t c = 0; c < sweep->axis[a].nchoices; c++)
            for (const fracas_setting *s = sweep->axis[a].choice[c].settings; s; s = s->next) {
                size_t leaf = (size_t)(s->leaf - file->catalog->leaf);
                if (owner[leaf] && owner_axis[leaf] != a)
                    TRY(fracas_file_note(
                        file, fracas_file_error(
                                  file, s->node,
                                  "`%s` is swept by two axes, here and at line %d; keep one",
                                  s->leaf->path, owner[leaf]->node->line)));
                owner[leaf] = s;
                owner_axis[leaf] = a;
            }
    return FRACAS_OK;
}

static fracas_err check_list(const fracas_file *file, const fracas_node *node)
{
    if (node->type != FRACAS_LIST)
        return fracas_file_expected(
            file, node, "sweep",
            "a list of axes, each after `- `, as `- loading.rate: [1e3 1/s, 1e4 1/s]`");
    if (node->count > 0) return FRACAS_OK;
    return fracas_file_error(file, node,
                             "`sweep`: found no axis; give at least one, or remove `sweep`");
}

fracas_err fracas_sweep_read(const fracas_file *file, const fracas_node *node, fracas_sweep *sweep)
{
    *sweep = (fracas_sweep){.npoints = 1};
    if (!node) return FRACAS_OK;
    const size_t noted = fracas_file_noted(file);
    TRY(fracas_file_note(file, check_list(file, node)));
    if (fracas_file_noted(file) > noted) {
        fracas_file_doubt_section(file, NULL, true);
        return FRACAS_OK;
    }
    sweep->axis = fracas_memory_take(file->memory, node->count, sizeof *sweep->axis);
    if (!sweep->axis) return fracas_no_memory("the sweep");
    for (const fracas_node *axis = node->first; axis; axis = axis->next) {
        fracas_axis *read = &sweep->axis[sweep->naxes++];
        const size_t before = fracas_file_noted(file);
        TRY(fracas_file_note(file, read_axis(file, axis, read)));
        if (fracas_file_noted(file) > before) TRY(doubt_axis(file, axis, read));
        sweep->npoints *= read->nchoices;
        if (sweep->npoints > FRACAS_MAX_POINTS)
            return fracas_file_error(
                file, axis,
                "the sweep makes more than %d points, the product of its axes; sweep "
                "fewer values, or several together with `zip:`",
                FRACAS_MAX_POINTS);
    }
    const fracas_setting **owner = fracas_memory_take(file->memory, file->catalog->nleaves,
                                                      sizeof *owner);
    size_t *owner_axis = fracas_memory_take(file->memory, file->catalog->nleaves,
                                            sizeof *owner_axis);
    if (!owner || !owner_axis) return fracas_no_memory("the sweep");
    return check_axes_apart(file, sweep, owner, owner_axis);
}

const fracas_choice *fracas_sweep_choice(const fracas_sweep *sweep, size_t point, size_t axis)
{
    size_t slower = 1; /* points per step of this axis */
    for (size_t a = axis + 1; a < sweep->naxes; a++) slower *= sweep->axis[a].nchoices;
    return &sweep->axis[axis].choice[point / slower % sweep->axis[axis].nchoices];
}

/* ---- targets ---- */

/* The section named before the dot of a path, or NULL. */
static const fracas_file_section *section_before_dot(const fracas_catalog *catalog,
                                                     const char *path)
{
    const char *dot = strchr(path, '.');
    if (dot && strchr("0123456789", dot[1])) return NULL; /* an item of a list, guessed */
    for (size_t s = 0; dot && s < catalog->nsections; s++) {
        const char *name = catalog->section[s].table->name;
        if (strlen(name) == (size_t)(dot - path) && strncmp(name, path, strlen(name)) == 0)
            return &catalog->section[s];
    }
    return NULL;
}

/* Doubts all that an unknown path may mean: the nearest, or any of its section, or any at all. */
static void doubt_path(const fracas_file *file, const fracas_file_section *inside,
                       const char *nearest)
{
    const fracas_leaf *leaf = nearest ? fracas_catalog_leaf(file->catalog, nearest) : NULL;
    if (leaf) fracas_file_doubt(file, leaf);
    else fracas_file_doubt_section(file, inside, false);
}

/* The path of the one parameter with this key, else `other`. */
static const char *path_of_key(const fracas_catalog *catalog, const char *key, const char *other)
{
    const char *path = NULL;
    size_t found = 0;
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        const fracas_section *table = leaf->section->table;
        if (!table->hashed || table->follows || strcmp(leaf->key, key) != 0) continue;
        path = leaf->path;
        found++;
    }
    return found == 1 ? path : other;
}

/* The paths that names in files of the section make. */
static fracas_err add_names(const fracas_file *file, const fracas_file_section *section,
                            fracas_words *words)
{
    char before[80];
    snprintf(before, sizeof before, "%s.", section->table->name);
    return fracas_names_add(file, section, NULL, before, words);
}

/* The leaf of section.name; NULL: it is unknown. */
static fracas_err find_leaf(const fracas_file *file, const fracas_node *key,
                            const fracas_leaf **leaf)
{
    const fracas_file_section *section = section_before_dot(file->catalog, key->text);
    *leaf = fracas_catalog_leaf(file->catalog, key->text);
    if (!section) return FRACAS_OK;
    const char *name = strchr(key->text, '.') + 1, *means = name;
    TRY(fracas_name_to_key(file, section, NULL, key, &means));
    if (means != name) *leaf = fracas_catalog_key(file->catalog, section, means);
    return FRACAS_OK;
}

static fracas_err unknown_path(const fracas_file *file, const fracas_node *entry,
                               const char *const *also)
{
    const fracas_catalog *catalog = file->catalog;
    const fracas_node *key = entry->key;
    const fracas_file_section *inside = section_before_dot(catalog, key->text);
    fracas_words words;
    fracas_names_question ask = {""};
    fracas_words_init(&words, key->text);
    if (inside) TRY(add_names(file, inside, &words));
    for (size_t i = 0; i < catalog->nleaves; i++)
        if (catalog->leaf[i].section->table->hashed &&
            (!inside || catalog->leaf[i].section == inside))
            fracas_words_add(&words, catalog->leaf[i].path);
    if (inside) TRY(fracas_names_ask_for_file(file, inside, NULL, entry, &words, &ask));
    if (!inside) words.nearest = path_of_key(catalog, key->text, words.nearest);
    doubt_path(file, inside, words.nearest);
    if (!inside) { /* all paths were compared; list the sections */
        words.used = 0;
        for (; *also; also++) fracas_words_add(&words, *also);
        for (size_t s = 0; s < catalog->nsections; s++)
            if (catalog->section[s].table->hashed)
                fracas_words_add(&words, catalog->section[s].table->name);
    }
    return fracas_file_error(file, key, "unknown path `%s` in the sweep%s%s", key->text, ask.text,
                             inside ? fracas_words_hint(&words, "paths in %s", inside->table->name)
                                    : fracas_words_hint(&words, "known are section.key, and"));
}

fracas_err fracas_target_find(const fracas_file *file, const fracas_node *entry,
                              const char *const *also, fracas_target *found)
{
    const fracas_node *key = entry->key;
    *found = (fracas_target){0};
    TRY(find_leaf(file, key, &found->leaf));
    if (!found->leaf) found->section = fracas_catalog_section(file->catalog, key->text);
    if (strcmp(key->text, "replicas") == 0)
        return fracas_file_error(
            file, key,
            "`replicas` is not a parameter to sweep; a case of `cases` may have its own");
    if (strcmp(key->text, "name") == 0 || strcmp(key->text, "seed") == 0)
        return fracas_file_error(file, key,
                                 "`%s` cannot be swept; a campaign has one, at the top of the file",
                                 key->text);
    if (!found->leaf && !found->section) return unknown_path(file, entry, also);
    const fracas_section *table = (found->leaf ? found->leaf->section : found->section)->table;
    if (table->hashed) return FRACAS_OK;
    return fracas_file_error(file, key, "`%s` cannot be swept; it is one for the whole campaign",
                             key->text);
}
