/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON schema of campaign files, for editors, from the parameter tables. It refuses unknown
 * keys, kinds and ranges of bare numbers; units, expressions and rules between keys are the
 * reader's. */
#include "campaigns/campaign.h"

#include "base/json.h"
#include "base/version.h"
#include "campaigns/file/catalog.h"
#include "sampler/design/design.h"
#include "sampler/design/uncertain.h"

#include <math.h>
#include <string.h>

static void write_ref(fracas_json *json, const char *key, const char *name)
{
    char path[200];
    snprintf(path, sizeof path, "#/$defs/%s", name);
    fracas_json_object(json, key);
    fracas_json_text(json, "$ref", path);
    fracas_json_close(json);
}

static void begin_object(fracas_json *json, const char *key)
{
    fracas_json_object(json, key);
    fracas_json_text(json, "type", "object");
    fracas_json_boolean(json, "additionalProperties", false);
    fracas_json_object(json, "properties");
}

static void end_object(fracas_json *json)
{
    fracas_json_close(json);
    fracas_json_close(json);
}

static void write_type(fracas_json *json, const char *key, const char *type)
{
    fracas_json_object(json, key);
    fracas_json_text(json, "type", type);
    fracas_json_close(json);
}

static void write_names(fracas_json *json, const char *key, const fracas_kind *const *kind,
                        size_t count)
{
    fracas_json_array(json, key);
    for (size_t k = 0; k < count; k++) fracas_json_text(json, NULL, kind[k]->name);
    fracas_json_close(json);
}

/* ---- values ---- */

/* Every range that a kind of the section gives the key is within this one. */
static void widen(const fracas_param *params, size_t count, const char *key, fracas_param *widest)
{
    for (size_t p = 0; p < count; p++) {
        if (strcmp(params[p].name, key) != 0) continue;
        if (params[p].minimum == widest->minimum)
            widest->minimum_open = widest->minimum_open && params[p].minimum_open;
        if (params[p].minimum < widest->minimum) widest->minimum_open = params[p].minimum_open;
        widest->minimum = fmin(widest->minimum, params[p].minimum);
        widest->maximum = fmax(widest->maximum, params[p].maximum);
    }
}

static fracas_param widest_of(const fracas_leaf *leaf)
{
    const fracas_section *section = leaf->section->table;
    fracas_param widest = *leaf->param;
    widen(section->params, section->nparams, leaf->key, &widest);
    for (size_t k = 0; k < section->nkinds; k++)
        widen(section->kinds[k]->params, section->kinds[k]->nparams, leaf->key, &widest);
    return widest;
}

/* A bare number within the range, or a text: a number with a unit, or an expression. */
static void write_number(fracas_json *json, const fracas_param *param)
{
    fracas_json_array(json, "anyOf");
    fracas_json_object(json, NULL);
    fracas_json_text(json, "type", param->type == FRACAS_INTEGER ? "integer" : "number");
    if (isfinite(param->minimum))
        fracas_json_real(json, param->minimum_open ? "exclusiveMinimum" : "minimum",
                         param->minimum);
    if (isfinite(param->maximum)) fracas_json_real(json, "maximum", param->maximum);
    fracas_json_close(json);
    write_type(json, NULL, "string");
    fracas_json_close(json);
}

static void write_param(fracas_json *json, const fracas_param *param)
{
    char doc[1024];
    const bool unit = strcmp(param->unit, "1") != 0 && *param->unit;
    snprintf(doc, sizeof doc, "%s%s%s%s", param->doc, unit ? " [" : "", unit ? param->unit : "",
             unit ? "]" : "");
    fracas_json_text(json, "description", doc);
    if (param->type == FRACAS_BOOLEAN) fracas_json_text(json, "type", "boolean");
    else if (param->type == FRACAS_CHOICE)
        write_names(json, param->keys_of ? "examples" : "enum", param->choices, param->nchoices);
    else if (param->type == FRACAS_ATTACHMENT) fracas_json_text(json, "type", "string");
    else if (param->type == FRACAS_NUMBERS) {
        fracas_json_text(json, "type", "array");
        fracas_json_object(json, "items");
        fracas_json_text(json, "type", "integer");
        fracas_json_real(json, "minimum", param->minimum);
        fracas_json_close(json);
        fracas_json_integer(json, "minItems", 1);
    } else write_number(json, param);
    if (param->optional || fracas_param_is_object(param) || isnan(param->fallback)) return;
    if (param->type == FRACAS_BOOLEAN) fracas_json_boolean(json, "default", param->fallback != 0);
    else if (param->type == FRACAS_CHOICE)
        fracas_json_text(json, "default", param->choices[(size_t)param->fallback]->name);
    else fracas_json_real(json, "default", param->fallback);
}

/* The name of a section's kind. */
static void write_selector(fracas_json *json, const fracas_section *section)
{
    char doc[4096];
    size_t used = (size_t)snprintf(doc, sizeof doc, "%s.", section->doc);
    for (size_t k = 0; k < section->nkinds && used < sizeof doc; k++)
        used += (size_t)snprintf(doc + used, sizeof doc - used, " %s: %s.", section->kinds[k]->name,
                                 section->kinds[k]->doc);
    fracas_json_text(json, "description", doc);
    write_names(json, "enum", section->kinds, section->nkinds);
}

static void write_leaf(fracas_json *json, const fracas_leaf *leaf)
{
    fracas_json_object(json, leaf->path);
    if (leaf->param) {
        const fracas_kind *choice[FRACAS_MOST_CHOICES];
        fracas_param widest = widest_of(leaf);
        widest.choices = choice;
        widest.nchoices = fracas_leaf_choices(leaf, choice);
        write_param(json, &widest);
    } else write_selector(json, leaf->section->table);
    fracas_json_close(json);
}

/* ---- sections ---- */

static bool is_leaf(const fracas_catalog *catalog, const fracas_section *section)
{
    return fracas_catalog_leaf(catalog, section->name) != NULL;
}

/* The kind has a file, and names may be in it. */
static bool has_file(const fracas_kind *kind)
{
    for (size_t p = 0; p < kind->nparams; p++)
        if (kind->params[p].type == FRACAS_ATTACHMENT) return true;
    return false;
}

/* Other keys are names with the values of one key where the kind has a file, else mistakes. */
static void write_names_of_file(fracas_json *json, const fracas_catalog *catalog,
                                const fracas_file_section *section)
{
    const fracas_section *table = section->table;
    const char *selector = fracas_section_selector(table);
    write_ref(json, "additionalProperties",
              fracas_catalog_key(catalog, section, table->renamed)->path);
    fracas_json_object(json, "if");
    fracas_json_array(json, "required");
    fracas_json_text(json, NULL, selector);
    fracas_json_close(json);
    fracas_json_object(json, "properties");
    fracas_json_object(json, selector);
    fracas_json_array(json, "enum");
    for (size_t k = 0; k < table->nkinds; k++)
        if (has_file(table->kinds[k])) fracas_json_text(json, NULL, table->kinds[k]->name);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_object(json, "else");
    fracas_json_object(json, "propertyNames");
    fracas_json_array(json, "enum");
    for (size_t i = 0; i < catalog->nleaves; i++)
        if (catalog->leaf[i].section == section) fracas_json_text(json, NULL, catalog->leaf[i].key);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_close(json);
}

/* Unknown keys are mistakes, unless a file of the section may name them. */
static void begin_section(fracas_json *json, const fracas_catalog *catalog, const char *name,
                          const fracas_file_section *section)
{
    fracas_json_object(json, name);
    fracas_json_text(json, "type", "object");
    if (section->table->rename) write_names_of_file(json, catalog, section);
    else fracas_json_boolean(json, "additionalProperties", false);
    fracas_json_object(json, "properties");
}

/* The section, or a list: it first, then its followers. */
static void write_list(fracas_json *json, const fracas_catalog *catalog, const char *item,
                       const fracas_file_section *section)
{
    fracas_json_object(json, section->table->name);
    fracas_json_array(json, "anyOf");
    write_ref(json, NULL, item);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "type", "array");
    fracas_json_array(json, "prefixItems");
    write_ref(json, NULL, item);
    while ((section = fracas_catalog_next(catalog, section)))
        write_ref(json, NULL, section->table->name);
    fracas_json_close(json);
    fracas_json_boolean(json, "items", false);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_close(json);
}

static void write_section(fracas_json *json, const fracas_catalog *catalog,
                          const fracas_file_section *section)
{
    if (is_leaf(catalog, section->table)) return;
    const bool first = !section->table->follows && fracas_catalog_next(catalog, section);
    char item[80];
    snprintf(item, sizeof item, "%s%s", section->table->name, first ? "_1" : "");
    if (first) write_list(json, catalog, item, section);
    begin_section(json, catalog, item, section);
    for (size_t i = 0; i < catalog->nleaves; i++)
        if (catalog->leaf[i].section == section)
            write_ref(json, catalog->leaf[i].key, catalog->leaf[i].path);
    fracas_json_close(json);
    fracas_json_text(json, "description", section->table->doc);
    fracas_json_close(json);
}

static void write_sections(fracas_json *json, const fracas_catalog *catalog)
{
    for (size_t s = 0; s < catalog->nsections; s++)
        if (!catalog->section[s].table->follows)
            write_ref(json, catalog->section[s].table->name, catalog->section[s].table->name);
}

static void write_replicas(fracas_json *json)
{
    fracas_json_object(json, "replicas");
    fracas_json_text(json, "description", "realizations of each point, or a rule for them");
    fracas_json_array(json, "anyOf");
    fracas_json_object(json, NULL);
    fracas_json_text(json, "type", "integer");
    fracas_json_integer(json, "minimum", 1);
    fracas_json_close(json);
    write_type(json, NULL, "string");
    begin_object(json, NULL);
    write_type(json, "minimum", "integer");
    write_type(json, "maximum", "integer");
    begin_object(json, "until");
    write_type(json, "quantity", "string");
    write_ref(json, "relative-half-width", "pure");
    write_ref(json, "confidence", "pure");
    end_object(json);
    end_object(json);
    fracas_json_close(json);
    fracas_json_close(json);
}

/* ---- the sweep ---- */

/* The key of an axis and its values: a list, or of numbers a range. */
static void write_axis_values(fracas_json *json, const char *name, bool number)
{
    fracas_json_object(json, name);
    fracas_json_array(json, "anyOf");
    fracas_json_object(json, NULL);
    fracas_json_text(json, "type", "array");
    write_ref(json, "items", name);
    fracas_json_close(json);
    if (number) write_ref(json, NULL, "range");
    fracas_json_close(json);
    fracas_json_close(json);
}

/* Closes an object whose keys are paths: names in the files of a section make others. */
static void end_paths(fracas_json *json, const fracas_catalog *catalog)
{
    char pattern[80];
    fracas_json_close(json);
    fracas_json_object(json, "patternProperties");
    for (size_t s = 0; s < catalog->nsections; s++) {
        if (!catalog->section[s].table->rename) continue;
        snprintf(pattern, sizeof pattern, "^%s\\.", catalog->section[s].table->name);
        fracas_json_boolean(json, pattern, true);
    }
    fracas_json_close(json);
    fracas_json_close(json);
}

static void write_axes(fracas_json *json, const fracas_catalog *catalog)
{
    for (size_t i = 0; i < catalog->nleaves; i++)
        write_axis_values(json, catalog->leaf[i].path, !fracas_leaf_is_text(&catalog->leaf[i]));
    for (size_t s = 0; s < catalog->nsections; s++)
        if (!is_leaf(catalog, catalog->section[s].table))
            write_axis_values(json, catalog->section[s].table->name, false);
}

static void write_list_of(fracas_json *json, const char *key, const char *items)
{
    fracas_json_object(json, key);
    fracas_json_text(json, "type", "array");
    write_ref(json, "items", items);
    fracas_json_close(json);
}

static void write_case(fracas_json *json, const fracas_catalog *catalog)
{
    begin_object(json, "case");
    fracas_json_object(json, "name");
    fracas_json_close(json);
    write_ref(json, "replicas", "replicas");
    for (size_t i = 0; i < catalog->nleaves; i++)
        write_ref(json, catalog->leaf[i].path, catalog->leaf[i].path);
    for (size_t s = 0; s < catalog->nsections; s++)
        if (!is_leaf(catalog, catalog->section[s].table))
            write_ref(json, catalog->section[s].table->name, catalog->section[s].table->name);
    end_paths(json, catalog);
}

/* Keys of all distributions of an uncertain parameter. */
static void write_uncertain(fracas_json *json)
{
    const fracas_section *section = &fracas_uncertain_section;
    begin_object(json, "uncertain");
    fracas_json_object(json, fracas_section_selector(section));
    write_names(json, "enum", section->kinds, section->nkinds);
    fracas_json_close(json);
    for (size_t k = 0; k < section->nkinds; k++)
        for (size_t p = 0; p < section->kinds[k]->nparams; p++) {
            const char *key = section->kinds[k]->params[p].name;
            bool written = false;
            for (size_t before = 0; before < k; before++)
                written = written ||
                          fracas_section_param(section, section->kinds[before], NULL, key);
            if (!written) write_ref(json, key, "pure");
        }
    end_object(json);
}

static void write_design(fracas_json *json)
{
    begin_object(json, "design");
    fracas_json_object(json, "type");
    write_names(json, "enum", fracas_design_types, FRACAS_COUNT(fracas_design_types));
    fracas_json_close(json);
    write_ref(json, "points", "pure");
    fracas_json_object(json, "parameters");
    fracas_json_text(json, "type", "object");
    write_ref(json, "additionalProperties", "uncertain");
    fracas_json_close(json);
    write_type(json, "correlation", "array");
    end_object(json);
    write_uncertain(json);
}

/* A key with one of two words. */
static void write_either(fracas_json *json, const char *key, const char *one, const char *other)
{
    fracas_json_object(json, key);
    fracas_json_array(json, "enum");
    fracas_json_text(json, NULL, one);
    fracas_json_text(json, NULL, other);
    fracas_json_close(json);
    fracas_json_close(json);
}

static void write_sweep(fracas_json *json, const fracas_catalog *catalog)
{
    begin_object(json, "range");
    write_ref(json, "from", "pure");
    write_ref(json, "to", "pure");
    write_ref(json, "points", "pure");
    write_either(json, "spacing", "lin", "log");
    end_object(json);
    write_case(json, catalog);
    write_design(json);
    begin_object(json, "zip");
    write_axes(json, catalog);
    end_paths(json, catalog);
    begin_object(json, "axis");
    write_ref(json, "zip", "zip");
    write_list_of(json, "cases", "case");
    write_ref(json, "design", "design");
    write_axes(json, catalog);
    end_paths(json, catalog);
    write_list_of(json, "sweep", "axis");
}

/* ---- the whole ---- */

static void write_report(fracas_json *json)
{
    begin_object(json, "report");
    write_type(json, "x", "string");
    write_type(json, "series", "string");
    write_type(json, "panels", "string");
    fracas_json_object(json, "y");
    fracas_json_array(json, "anyOf");
    write_type(json, NULL, "string");
    fracas_json_object(json, NULL);
    fracas_json_text(json, "type", "array");
    write_type(json, "items", "string");
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_text(json, "description", "keys of the figures of means in the report; in no hash");
    fracas_json_close(json);
}

static void write_probes(fracas_json *json)
{
    fracas_json_object(json, "probes");
    fracas_json_text(json, "description",
                     "points whose displacement and velocity are kept: places [m] by name");
    fracas_json_text(json, "type", "object");
    fracas_json_integer(json, "minProperties", 1);
    fracas_json_integer(json, "maxProperties", FRACAS_MOST_PROBES);
    fracas_json_object(json, "additionalProperties");
    fracas_json_text(json, "type", "array");
    write_ref(json, "items", "pure");
    fracas_json_integer(json, "minItems", 1);
    fracas_json_integer(json, "maxItems", 3);
    fracas_json_close(json);
    fracas_json_close(json);
}

static void write_heading(fracas_json *json)
{
    fracas_json_text(json, "$schema", "https://json-schema.org/draft/2020-12/schema");
    fracas_json_text(json, "title", "Campaign file of fracas " FRACAS_VERSION);
    fracas_json_text(json, "type", "object");
    fracas_json_boolean(json, "additionalProperties", false);
    fracas_json_array(json, "required");
    fracas_json_text(json, NULL, "name");
    fracas_json_text(json, NULL, "seed");
    fracas_json_close(json);
}

static void write_schema(fracas_json *json, const fracas_catalog *catalog)
{
    write_heading(json);
    fracas_json_object(json, "properties");
    fracas_json_object(json, "name");
    fracas_json_text(json, "description", "name of the campaign, and of the folder of its study");
    fracas_json_close(json);
    write_ref(json, "seed", "pure");
    write_either(json, "random_numbers", "independent", "common");
    write_ref(json, "replicas", "replicas");
    write_ref(json, "sweep", "sweep");
    write_report(json);
    write_probes(json);
    write_sections(json, catalog);
    fracas_json_close(json);
    fracas_json_object(json, "$defs");
    fracas_json_object(json, "pure");
    fracas_json_array(json, "type");
    fracas_json_text(json, NULL, "number");
    fracas_json_text(json, NULL, "string");
    fracas_json_close(json);
    fracas_json_close(json);
    write_replicas(json);
    for (size_t i = 0; i < catalog->nleaves; i++) write_leaf(json, &catalog->leaf[i]);
    for (size_t s = 0; s < catalog->nsections; s++)
        write_section(json, catalog, &catalog->section[s]);
    write_sweep(json, catalog);
    fracas_json_close(json);
}

fracas_err fracas_campaign_schema(FILE *out)
{
    OWN(fracas_campaign_memory) memory = fracas_memory_create();
    const fracas_catalog *catalog;
    fracas_json json;
    if (!memory) return fracas_no_memory("the list of keys");
    TRY(fracas_catalog_make(memory, &catalog));
    fracas_json_begin(&json, out);
    write_schema(&json, catalog);
    fracas_json_end(&json);
    return FRACAS_OK;
}
