/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/setting.h"

#include "campaigns/file/attach.h"
#include "campaigns/file/expression.h"
#include "campaigns/file/names.h"
#include "campaigns/file/words.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* ---- one value ---- */

static fracas_err want_scalar(const fracas_file *file, const char *key, const fracas_node *node,
                              const char *expected)
{
    if (node->type == FRACAS_SCALAR && *node->text) return FRACAS_OK;
    return fracas_file_expected(file, node, key, expected);
}

/* The one of `count` kinds with this name, the text of `node` or what it stands for; `words`: other
 * names that are allowed. */
static fracas_err find_kind(const fracas_file *file, const char *key, const fracas_node *node,
                            const char *name, const fracas_kind *const *kinds, size_t count,
                            fracas_words *words, const fracas_kind **kind)
{
    for (size_t k = 0; k < count; k++) {
        *kind = kinds[k];
        if (strcmp(kinds[k]->name, name) == 0) return FRACAS_OK;
        fracas_words_add(words, kinds[k]->name);
    }
    return fracas_file_error(file, node, "unknown %s `%s`%s", key, node->text,
                             fracas_words_hint(words, "%s can be", key));
}

fracas_err fracas_setting_kind(const fracas_file *file, const char *key, const fracas_node *node,
                               const fracas_kind *const *kinds, size_t count,
                               const fracas_kind **kind)
{
    fracas_words words;
    TRY(want_scalar(file, key, node, "a name"));
    fracas_words_init(&words, node->text);
    return find_kind(file, key, node, node->text, kinds, count, &words, kind);
}

/* Kinds of a section may have other choices for the same key: one of any. A choice of keys of a
 * section takes the names of its files, too. */
static fracas_err read_choice(const fracas_file *file, const fracas_leaf *leaf,
                              const fracas_node *node, const fracas_kind **kind)
{
    const fracas_kind *choice[FRACAS_MOST_CHOICES];
    const size_t count = fracas_leaf_choices(leaf, choice);
    const char *of = leaf->param->keys_of, *name = fracas_node_text(node);
    const fracas_file_section *section = of ? fracas_catalog_section(file->catalog, of) : NULL;
    fracas_words words;
    TRY(want_scalar(file, leaf->key, node, "a name"));
    fracas_words_init(&words, node->text);
    if (section) TRY(fracas_name_to_key(file, section, NULL, node, &name));
    if (section) TRY(fracas_names_add(file, section, NULL, "", &words));
    return find_kind(file, leaf->key, node, name, choice, count, &words, kind);
}

static fracas_err read_boolean(const fracas_file *file, const char *key, const fracas_node *node,
                               double *value)
{
    TRY(want_scalar(file, key, node, "true or false"));
    *value = strcmp(node->text, "true") == 0;
    if (*value != 0.0 || strcmp(node->text, "false") == 0) return FRACAS_OK;
    return fracas_file_expected(file, node, key, "true or false");
}

static fracas_err read_integer(const fracas_file *file, const char *key, const fracas_node *node,
                               double *value)
{
    TRY(want_scalar(file, key, node, "a whole number"));
    if (fracas_number_read(node->text, value)) return fracas_file_error_within(file, node, key);
    if (*value == floor(*value) && fabs(*value) <= 1e15) return FRACAS_OK;
    return fracas_file_error(file, node, "`%s`: `%s` is not a whole number%s", key, node->text,
                             fabs(*value) > 1e15 ? " of at most 15 digits" : "");
}

/* A list, each number in the range of the leaf. */
static fracas_err read_numbers(const fracas_file *file, const fracas_leaf *leaf,
                               const fracas_node *node, const void **object)
{
    size_t n = 0;
    if (node->type != FRACAS_LIST || !node->first)
        return fracas_file_expected(file, node, leaf->key, "a list of whole numbers, as [0, 7]");
    for (const fracas_node *entry = node->first; entry; entry = entry->next) n++;
    fracas_numbers *numbers = fracas_memory_take(file->memory, 1, sizeof *numbers);
    int64_t *value = fracas_memory_take(file->memory, n, sizeof *value);
    if (!numbers || !value) return fracas_no_memory("the campaign's values");
    *numbers = (fracas_numbers){n, value};
    for (const fracas_node *entry = node->first; entry; entry = entry->next)
        TRY(fracas_setting_integer(file, leaf->key, entry, (int64_t)leaf->param->minimum,
                                   (int64_t)fmin(leaf->param->maximum, 1e15), value++));
    *object = numbers;
    return FRACAS_OK;
}

static fracas_err read_real(const fracas_file *file, const fracas_leaf *leaf,
                            const fracas_node *node, double *value)
{
    const char *form, *write_in;
    char expected[160];
    fracas_units_describe(leaf->param->unit, &form, &write_in);
    snprintf(expected, sizeof expected, "%s, in %s", form, write_in);
    TRY(want_scalar(file, leaf->key, node, expected));
    fracas_err err = fracas_units_read(file->units, node->text, leaf->param->unit, value);
    return err == FRACAS_USAGE ? fracas_file_error_within(file, node, leaf->key) : err;
}

/* True if `text` names a key of a section: an expression, no number with a unit. */
static bool names_a_key(const fracas_file *file, const char *text)
{
    for (const char *at = text; *at; at++) {
        const size_t length = fracas_expression_path(at);
        if (length == 0) continue;
        char name[200 + 1];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, "."), at);
        if (fracas_catalog_section(file->catalog, name)) return true;
        at += length - 1;
    }
    return false;
}

fracas_err fracas_setting_read_known(const fracas_file *file, const fracas_leaf *leaf,
                                     const fracas_node *node, fracas_setting *setting)
{
    TRY(fracas_setting_read(file, leaf, node, setting));
    if (!setting->expression) return FRACAS_OK;
    return fracas_file_error(file, node, "`%s`: an expression cannot stand here; give a number",
                             leaf->key);
}

fracas_err fracas_setting_read(const fracas_file *file, const fracas_leaf *leaf,
                               const fracas_node *node, fracas_setting *setting)
{
    *setting = (fracas_setting){.leaf = leaf, .node = node};
    if (node->type == FRACAS_LIST && leaf->section->table->hashed)
        return fracas_file_error(file, node,
                                 "`%s`: found a list; one value is expected here, several go under "
                                 "`sweep`, as `- %s: [...]`",
                                 leaf->key, leaf->path);
    const fracas_section *table = leaf->section->table;
    const fracas_param *param = leaf->param;
    if (!param)
        return fracas_setting_kind(file, leaf->key, node, table->kinds, table->nkinds,
                                   &setting->kind);
    const bool number = param->type == FRACAS_REAL || param->type == FRACAS_INTEGER;
    if (number && names_a_key(file, fracas_node_text(node))) {
        setting->expression = node->text;
        return FRACAS_OK;
    }
    switch (param->type) {
    case FRACAS_BOOLEAN: return read_boolean(file, leaf->key, node, &setting->value);
    case FRACAS_INTEGER: return read_integer(file, leaf->key, node, &setting->value);
    case FRACAS_CHOICE: return read_choice(file, leaf, node, &setting->kind);
    case FRACAS_ATTACHMENT:
        TRY(want_scalar(file, leaf->key, node, "the path of a file"));
        return fracas_attachment_read(file, leaf->key, node, &setting->object);
    case FRACAS_NUMBERS: return read_numbers(file, leaf, node, &setting->object);
    case FRACAS_REAL: break;
    }
    return read_real(file, leaf, node, &setting->value);
}

fracas_err fracas_setting_integer(const fracas_file *file, const char *key, const fracas_node *node,
                                  int64_t minimum, int64_t maximum, int64_t *value)
{
    double real;
    TRY(read_integer(file, key, node, &real));
    *value = (int64_t)real;
    if (*value >= minimum && *value <= maximum) return FRACAS_OK;
    return fracas_file_error(file, node,
                             "`%s`: %s is out of range; allowed is %" PRId64 " to %" PRId64, key,
                             node->text, minimum, maximum);
}

enum { LONGEST_NAME = 100 };

/* True of `length` characters fit for a name. */
static bool is_name(const char *text, size_t length)
{
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
    return length > 0 && length <= LONGEST_NAME && strspn(text, allowed) >= length &&
           !strchr("._-", *text);
}

fracas_err fracas_setting_name(const fracas_file *file, const fracas_node *node, const char **name)
{
    TRY(want_scalar(file, "name", node, "a word"));
    *name = node->text;
    if (is_name(*name, strlen(*name))) return FRACAS_OK;
    return fracas_file_error(
        file, node,
        "`name`: found `%s`; a name is made of up to 100 letters a-z A-Z, digits, "
        "`.`, `_` and `-`, and starts with a letter or digit",
        *name);
}

fracas_err fracas_setting_case_name(const fracas_file *file, const fracas_node *node,
                                    const char **name)
{
    TRY(want_scalar(file, "name", node, "a word"));
    *name = node->text;
    for (const char *part = *name;; part++) {
        const size_t length = strcspn(part, "/");
        if (!is_name(part, length)) break;
        part += length;
        if (!*part) return FRACAS_OK;
    }
    return fracas_file_error(
        file, node,
        "`name`: found `%s`; the name of a case is made of up to 100 letters a-z A-Z, digits, "
        "`.`, `_` and `-`, and starts with a letter or digit; `/` joins the names of several axes",
        *name);
}

/* ---- many ---- */

static fracas_setting *find_setting(const fracas_settings *settings, const fracas_leaf *leaf)
{
    for (fracas_setting *one = *settings; one; one = one->next)
        if (one->leaf == leaf) return one;
    return NULL;
}

fracas_err fracas_settings_add(const fracas_file *file, const fracas_setting *setting,
                               fracas_settings *settings)
{
    const fracas_setting *earlier = find_setting(settings, setting->leaf);
    if (earlier)
        return fracas_file_error(
            file, setting->node,
            "`%s` is given twice; it is already at line %d, keep one of the two",
            setting->leaf->path, earlier->node->line);
    fracas_setting *copy = fracas_memory_take(file->memory, 1, sizeof *copy);
    if (!copy) return fracas_no_memory("the campaign's values");
    *copy = *setting;
    copy->next = *settings;
    *settings = copy;
    return FRACAS_OK;
}

fracas_err fracas_settings_read(const fracas_file *file, const fracas_leaf *leaf,
                                const fracas_node *node, fracas_settings *settings)
{
    fracas_setting setting;
    const size_t before = fracas_file_noted(file);
    TRY(fracas_file_note(file, fracas_setting_read(file, leaf, node, &setting)));
    setting.wrong = fracas_file_noted(file) > before;
    return fracas_file_note(file, fracas_settings_add(file, &setting, settings));
}

fracas_err fracas_settings_doubt(const fracas_file *file, const fracas_file_section *section,
                                 const fracas_leaf *leaf, const fracas_node *node,
                                 fracas_settings *settings)
{
    for (size_t i = 0; i < file->catalog->nleaves; i++) {
        const fracas_leaf *one = &file->catalog->leaf[i];
        if ((leaf ? one != leaf : one->section != section) || find_setting(settings, one)) continue;
        const fracas_setting wrong = {.leaf = one, .node = node, .wrong = true};
        TRY(fracas_settings_add(file, &wrong, settings));
    }
    return FRACAS_OK;
}

/* Doubts all that the unknown key of a section may mean: the nearest key, or that of another
 * section; if its value is the name of a kind, the kind; else any. */
static void doubt_key(const fracas_file *file, const fracas_file_section *section,
                      const fracas_node *entry, const char *nearest, bool elsewhere)
{
    const fracas_catalog *catalog = file->catalog;
    bool kind = entry->type == FRACAS_UNREADABLE;
    for (size_t k = 0; k < section->table->nkinds; k++)
        kind = kind || strcmp(section->table->kinds[k]->name, fracas_node_text(entry)) == 0;
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        const char *meant = elsewhere ? entry->key->text : nearest;
        if (meant && strcmp(leaf->key, meant) == 0 && (elsewhere || leaf->section == section))
            fracas_file_doubt(file, leaf);
    }
    if (kind || (!nearest && !elsewhere)) fracas_file_doubt_section(file, section, kind);
}

/* `node`: the map of the section, with the entry. */
static fracas_err unknown_key(const fracas_file *file, const fracas_file_section *section,
                              const fracas_node *node, const fracas_node *entry)
{
    const fracas_catalog *catalog = file->catalog;
    const fracas_node *key = entry->key;
    fracas_words words;
    fracas_names_question ask = {""};
    fracas_words_init(&words, key->text);
    TRY(fracas_names_add(file, section, node, "", &words));
    const char *name = words.nearest, *home = NULL; /* another section with this key */
    for (size_t i = 0; i < catalog->nleaves; i++) {
        if (catalog->leaf[i].section == section) fracas_words_add(&words, catalog->leaf[i].key);
        else if (strcmp(catalog->leaf[i].key, key->text) == 0 &&
                 !catalog->leaf[i].section->table->follows)
            home = catalog->leaf[i].section->table->name;
    }
    if (!home) TRY(fracas_names_ask_for_file(file, section, node, entry, &words, &ask));
    const char *nearest = words.nearest;
    if (nearest == name) nearest = NULL; /* a name, of any key */
    if (home) words.nearest = nearest = NULL;
    doubt_key(file, section, entry, nearest, home != NULL);
    if (entry->type == FRACAS_UNREADABLE) return fracas_file_untold(file);
    if (*key->text && strchr("0123456789", *key->text) && !*fracas_node_text(entry))
        return fracas_file_error(file, key,
                                 "unknown key `%s` in %s: the end of a number with a comma? Write "
                                 "a decimal point, and nothing between thousands",
                                 key->text, section->table->name);
    return fracas_file_error(file, key, "unknown key `%s` in %s%s%s%s%s", key->text,
                             section->table->name, ask.text,
                             home ? "; it belongs to the section " : "", home ? home : "",
                             fracas_words_hint(&words, "keys of %s", section->table->name));
}

static fracas_err no_section(const fracas_file *file, const fracas_file_section *section,
                             const fracas_node *node)
{
    char found[256];
    fracas_words words;
    fracas_words_init(&words, "");
    for (size_t i = 0; i < file->catalog->nleaves; i++)
        if (file->catalog->leaf[i].section == section)
            fracas_words_add(&words, file->catalog->leaf[i].key);
    return fracas_file_error(file, node, "`%s` is a section, but found %s%s", section->table->name,
                             fracas_node_found(node, found),
                             fracas_words_hint(&words, "write its keys below it, indented"));
}

/* The leaf of an entry; a key unknown to the kind may be a name in a file of the section. */
static fracas_err leaf_of(const fracas_file *file, const fracas_file_section *section,
                          const fracas_node *node, const fracas_node *entry,
                          const fracas_leaf **leaf)
{
    const char *key = entry->key->text;
    TRY(fracas_name_to_key(file, section, node, entry->key, &key));
    *leaf = fracas_catalog_key(file->catalog, section, key);
    return *leaf ? FRACAS_OK : unknown_key(file, section, node, entry);
}

static fracas_err add_one(const fracas_file *file, const fracas_file_section *section,
                          const fracas_node *node, fracas_settings *settings)
{
    if (node->type != FRACAS_MAP) {
        TRY(fracas_file_note(file, no_section(file, section, node)));
        return fracas_settings_doubt(file, section, NULL, node, settings);
    }
    for (const fracas_node *entry = node->first; entry; entry = entry->next) {
        const fracas_leaf *leaf = NULL;
        TRY(fracas_file_note(file, leaf_of(file, section, node, entry, &leaf)));
        if (leaf) TRY(fracas_settings_read(file, leaf, entry, settings));
    }
    return FRACAS_OK;
}

/* The items of a list: this section, then its followers. */
static fracas_err add_list(const fracas_file *file, const fracas_file_section *section,
                           const fracas_node *node, fracas_settings *settings)
{
    size_t most = 0;
    const fracas_node *item = node->first;
    const fracas_file_section *one = section;
    for (; item && one; item = item->next, most++) {
        TRY(add_one(file, one, item, settings));
        one = fracas_catalog_next(file->catalog, one);
    }
    if (!item) return FRACAS_OK;
    return fracas_file_note(file, fracas_file_error(file, item,
                                                    "`%s` has %zu items; a list of it has at most "
                                                    "%zu",
                                                    section->table->name, node->count, most));
}

fracas_err fracas_settings_add_section(const fracas_file *file, const fracas_file_section *section,
                                       const fracas_node *node, fracas_settings *settings)
{
    const bool list = node->type == FRACAS_LIST && node->first && !section->table->follows &&
                      fracas_catalog_next(file->catalog, section);
    return list ? add_list(file, section, node, settings) : add_one(file, section, node, settings);
}

/* ---- ranges ---- */

/* Range of a parameter, "more than 0 Pa, at most 1 Pa". */
static void write_range(const fracas_param *param, char *text, size_t size)
{
    char minimum[FRACAS_NUMBER_TEXT], maximum[FRACAS_NUMBER_TEXT];
    const bool pure = strcmp(param->unit, "1") == 0;
    const char *blank = pure ? "" : " ", *unit = pure ? "" : param->unit;
    fracas_number_write(param->minimum, minimum);
    fracas_number_write(param->maximum, maximum);
    const bool low = isfinite(param->minimum), high = isfinite(param->maximum);
    int used = low ? snprintf(text, size, "%s %s%s%s",
                              param->minimum_open ? "more than" : "at least", minimum, blank, unit)
                   : snprintf(text, size, "any number");
    if (high)
        snprintf(text + used, size - (size_t)used, "%s at most %s%s%s", low ? "," : "", maximum,
                 blank, unit);
}

bool fracas_setting_computable(double value)
{
    const double size = fabs(value);
    return size == 0 || (size <= FRACAS_GREATEST && size >= 1 / FRACAS_GREATEST);
}

double fracas_setting_number(const fracas_setting *setting, const fracas_param *param)
{
    if (param->type != FRACAS_CHOICE) return setting->value;
    for (size_t c = 0; c < param->nchoices; c++)
        if (param->choices[c] == setting->kind) return (double)c;
    return NAN;
}

/* A choice that only other kinds of the section have. */
static fracas_err check_choice(const fracas_file *file, const fracas_setting *setting,
                               const fracas_param *param)
{
    fracas_words words;
    if (!isnan(fracas_setting_number(setting, param))) return FRACAS_OK;
    fracas_words_init(&words, setting->kind->name);
    for (size_t c = 0; c < param->nchoices; c++) fracas_words_add(&words, param->choices[c]->name);
    return fracas_file_error(file, setting->node, "`%s` cannot be `%s` here%s", param->name,
                             setting->kind->name,
                             fracas_words_hint(&words, "%s can be", param->name));
}

fracas_err fracas_setting_check(const fracas_file *file, const fracas_setting *setting,
                                const fracas_param *param)
{
    double value = setting->value;
    if (param->type == FRACAS_CHOICE) return check_choice(file, setting, param);
    if (fracas_param_is_text(param) || fracas_param_is_object(param)) return FRACAS_OK;
    if (!fracas_setting_computable(value))
        return fracas_file_error(file, setting->node,
                                 "`%s`: %g%s%s is beyond what can be computed with: 0, or 1e-100 "
                                 "to 1e100 in SI units",
                                 setting->leaf->key, value, strcmp(param->unit, "1") ? " " : "",
                                 strcmp(param->unit, "1") ? param->unit : "");
    if ((param->minimum_open ? value > param->minimum : value >= param->minimum) &&
        value <= param->maximum)
        return FRACAS_OK;
    char range[160], number[FRACAS_NUMBER_TEXT];
    const bool pure = strcmp(param->unit, "1") == 0;
    write_range(param, range, sizeof range);
    fracas_number_write(value, number);
    if (setting->drawn)
        return fracas_file_error(
            file, setting->node,
            "`%s`: point %zu of the design draws %s%s%s, which is out of range; "
            "allowed is %s; choose a distribution that stays within",
            setting->leaf->path, setting->drawn, number, pure ? "" : " ", pure ? "" : param->unit,
            range);
    const char *written = setting->node->type == FRACAS_SCALAR ? setting->node->text : number;
    return fracas_file_error(file, setting->node, "`%s`: %s is out of range; allowed is %s",
                             setting->leaf->key, written, range);
}
