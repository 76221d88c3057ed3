/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference page of the campaign file, from the parameter tables. */
#include "campaigns/campaign.h"

#include "campaigns/file/catalog.h"
#include "sampler/design/design.h"
#include "sampler/design/uncertain.h"

#include "base/units.h"

#include <string.h>

static void write_limits(const fracas_param *param, FILE *out)
{
    char minimum[FRACAS_NUMBER_TEXT], maximum[FRACAS_NUMBER_TEXT];
    fracas_number_write(param->minimum, minimum);
    fracas_number_write(param->maximum, maximum);
    const char *above = param->minimum_open ? "> " : "≥ ";
    if (param->type == FRACAS_BOOLEAN) fprintf(out, "true, false");
    else if (param->type == FRACAS_CHOICE)
        for (size_t c = 0; c < param->nchoices; c++)
            fprintf(out, "%s`%s`", c ? ", " : "", param->choices[c]->name);
    else if (param->type == FRACAS_ATTACHMENT) fprintf(out, "any file");
    else if (isinf(param->minimum) && isinf(param->maximum)) fprintf(out, "any number");
    else if (isinf(param->maximum)) fprintf(out, "%s%s", above, minimum);
    else if (isinf(param->minimum)) fprintf(out, "≤ %s", maximum);
    else fprintf(out, "%s%s, ≤ %s", above, minimum, maximum);
}

static void write_param(const fracas_section *model, const fracas_param *param, FILE *out)
{
    static const char *const types[] = {"number", "whole number",   "true or false",
                                        "name",   "path of a file", "list of whole numbers"};
    char fallback[FRACAS_NUMBER_TEXT];
    fracas_number_write(param->fallback, fallback);
    const char *given = param->optional          ? "none"
                        : isnan(param->fallback) ? "**required**"
                                                 : fallback;
    if (param->type == FRACAS_BOOLEAN) given = param->fallback != 0.0 ? "true" : "false";
    if (param->type == FRACAS_CHOICE && !param->optional && !isnan(param->fallback))
        given = param->choices[(size_t)param->fallback]->name;
    if (param->type == FRACAS_ATTACHMENT && !isnan(param->fallback)) given = "none";
    fprintf(out, "| `%s` | %s | %s | %s | ", param->name, types[param->type],
            strcmp(param->unit, "1") ? param->unit : "", given);
    write_limits(param, out);
    fprintf(out, " | %s", param->doc);
    for (size_t c = 0; c < param->nchoices; c++)
        fprintf(out, "%s`%s`: %s", c ? "; " : ". ", param->choices[c]->name,
                param->choices[c]->doc);
    for (size_t m = 0, written = 0; param->only && m < model->nkinds; m++)
        if (fracas_param_is_of(param, model->kinds[m]))
            fprintf(out, "%s`%s`", written++ ? " or " : ". Only with model ",
                    model->kinds[m]->name);
    fprintf(out, " |\n");
}

static void write_params(const fracas_section *model, const fracas_param *params, size_t count,
                         FILE *out)
{
    if (count == 0) return;
    fprintf(out,
            "\n| key | type | SI unit | default | range | meaning |\n|---|---|---|---|---|---|\n");
    for (size_t p = 0; p < count; p++) write_param(model, &params[p], out);
}

/* " (default)", with the models for which it is. */
static void write_default(const fracas_section *model, const fracas_section *section,
                          const fracas_kind *kind, FILE *out)
{
    size_t count = 0, restricting = 0;
    const fracas_kind *partner;
    for (size_t m = 0; m < model->nkinds; m++) {
        partner = fracas_kind_partner(model->kinds[m], section, 0);
        restricting += partner != NULL;
        count += (partner ? partner : section->kinds[0]) == kind;
    }
    if (count == 0) return;
    fprintf(out, " (default");
    for (size_t m = 0, written = 0; m < model->nkinds && count < model->nkinds && restricting;
         m++) {
        partner = fracas_kind_partner(model->kinds[m], section, 0);
        if ((partner ? partner : section->kinds[0]) != kind) continue;
        fprintf(out, "%s `%s`", written++ ? " and" : " with model", model->kinds[m]->name);
    }
    fprintf(out, ")");
}

/* The kinds for a model in each restricted section. */
static void write_partners(const fracas_catalog *catalog, const fracas_kind *model, FILE *out)
{
    if (model->ngoes_with == 0) return;
    fprintf(out, "\nWith `%s: %s`, only these kinds go, the first of each being the default:\n\n",
            fracas_section_selector(catalog->section->table), model->name);
    for (size_t s = 0; s < catalog->nsections; s++) {
        const fracas_section *section = catalog->section[s].table;
        const fracas_kind *partner;
        if (section->follows) continue;
        for (size_t i = 0; (partner = fracas_kind_partner(model, section, i)); i++) {
            if (i == 0)
                fprintf(out, "- `%s.%s`: `%s`", section->name, fracas_section_selector(section),
                        partner->name);
            else fprintf(out, ", `%s`", partner->name);
        }
        if (fracas_kind_partner(model, section, 0)) fprintf(out, "\n");
    }
}

/* The kinds of a section, and the parameters of each. */
static void write_kinds(const fracas_catalog *catalog, const fracas_section *section, FILE *out)
{
    const fracas_section *model = catalog->section->table;
    const char *selector = fracas_section_selector(section);
    fprintf(out, "\n| `%s:` | meaning |\n|---|---|\n", selector);
    for (size_t k = 0; k < section->nkinds; k++) {
        fprintf(out, "| `%s`", section->kinds[k]->name);
        if (section == model) fprintf(out, "%s", k == 0 ? " (default)" : "");
        else if (section != &fracas_uncertain_section)
            write_default(model, section, section->kinds[k], out);
        fprintf(out, " | %s |\n", section->kinds[k]->doc);
    }
    for (size_t k = 0; k < section->nkinds; k++) {
        write_partners(catalog, section->kinds[k], out);
        if (section->kinds[k]->nparams == 0) continue;
        fprintf(out, "\nWith `%s: %s`:\n", selector, section->kinds[k]->name);
        write_params(model, section->kinds[k]->params, section->kinds[k]->nparams, out);
    }
}

/* A section that is an item of a list has kinds of the list's first, with their keys. */
static void write_item(const fracas_section *section, FILE *out)
{
    const fracas_section *first = section;
    size_t place = 1;
    for (; first->follows; first = first->follows) place++;
    fprintf(out, "Item %zu of a list `%s: [{...}, {...}]`, `%s.KEY` in a sweep. `%s:` is ", place,
            first->name, section->name, fracas_section_selector(section));
    for (size_t k = 0; k < section->nkinds; k++)
        fprintf(out, "%s`%s`",
                k == 0                    ? ""
                : k + 1 < section->nkinds ? ", "
                                          : " or ",
                section->kinds[k]->name);
    fprintf(out, ", with the keys of `%s`.\n", first->name);
}

static void write_section(const fracas_catalog *catalog, const fracas_section *section, FILE *out)
{
    fprintf(out, "\n## `%s`\n\n%s.\n", section->name, section->doc);
    if (section->follows) {
        write_item(section, out);
        return;
    }
    if (section->run)
        fprintf(out, "It cannot be swept, is in no hash, and may change from run to run.\n");
    else if (!section->hashed)
        fprintf(
            out,
            "One for the whole campaign: it cannot be swept and is not part of a point's hash.\n");
    write_params(catalog->section->table, section->params, section->nparams, out);
    if (section->nkinds > 0) write_kinds(catalog, section, out);
}

/* Types and distributions of designs. */
static void write_designs(const fracas_catalog *catalog, FILE *out)
{
    fprintf(out, "\n## Designs of the sweep\n\nAxes whose values are drawn: "
                 "[campaign-file.md](campaign-file.md#designs). A number whose unit is called its "
                 "own has that of its parameter.\n\n| `type:` | meaning |\n|---|---|\n");
    for (size_t t = 0; t < FRACAS_COUNT(fracas_design_types); t++)
        fprintf(out, "| `%s` | %s |\n", fracas_design_types[t]->name, fracas_design_types[t]->doc);
    write_kinds(catalog, &fracas_uncertain_section, out);
}

fracas_err fracas_campaign_reference(FILE *out)
{
    OWN(fracas_campaign_memory) memory = fracas_memory_create();
    const fracas_catalog *catalog;
    if (!memory) return fracas_no_memory("the list of keys");
    TRY(fracas_catalog_make(memory, &catalog));
    fprintf(out, "# Keys of a campaign file\n\n"
                 "Written by `fracas reference` from the tables that read the file; how a file is "
                 "built: [campaign-file.md](campaign-file.md).\nA bare number is in the SI unit "
                 "given here; any other unit of the same dimension may follow it after a space.\n");
    for (size_t s = 0; s < catalog->nsections; s++)
        write_section(catalog, catalog->section[s].table, out);
    write_designs(catalog, out);
    return FRACAS_OK;
}
