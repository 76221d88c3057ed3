/* The reference page of the campaign file, from the parameter tables. */
#include "campaigns/campaign.h"

#include "campaigns/file/catalog.h"

#include "base/units.h"

#include <string.h>

static void write_limits(const fracas_param *param, FILE *out)
{
    char minimum[FRACAS_NUMBER_TEXT], maximum[FRACAS_NUMBER_TEXT];
    fracas_number_write(param->minimum, minimum);
    fracas_number_write(param->maximum, maximum);
    const char *above = param->minimum_open ? "> " : "≥ ";
    if (param->type == FRACAS_BOOLEAN) fprintf(out, "true, false");
    else if (isinf(param->minimum) && isinf(param->maximum)) fprintf(out, "any");
    else if (isinf(param->maximum)) fprintf(out, "%s%s", above, minimum);
    else if (isinf(param->minimum)) fprintf(out, "≤ %s", maximum);
    else fprintf(out, "%s%s, ≤ %s", above, minimum, maximum);
}

static void write_param(const fracas_param *param, FILE *out)
{
    static const char *const types[] = {"number", "whole number", "true or false"};
    char fallback[FRACAS_NUMBER_TEXT];
    fracas_number_write(param->fallback, fallback);
    const char *given = isnan(param->fallback) ? "**required**" : fallback;
    if (param->type == FRACAS_BOOLEAN) given = param->fallback != 0.0 ? "true" : "false";
    fprintf(out, "| `%s` | %s | %s | %s | ", param->name, types[param->type],
            strcmp(param->unit, "1") ? param->unit : "", given);
    write_limits(param, out);
    fprintf(out, " | %s |\n", param->doc);
}

static void write_params(const fracas_param *params, size_t count, FILE *out)
{
    if (count == 0) return;
    fprintf(out, "\n| key | type | SI unit | default | range | meaning |\n|---|---|---|---|---|---|\n");
    for (size_t p = 0; p < count; p++) write_param(&params[p], out);
}

static void write_section(const fracas_section *section, FILE *out)
{
    const char *selector = section->selector ? section->selector : section->name;
    fprintf(out, "\n## `%s`\n\n%s.\n", section->name, section->doc);
    if (!section->hashed)
        fprintf(out, "One for the whole campaign: it cannot be swept and is not part of a point's hash.\n");
    write_params(section->params, section->nparams, out);
    if (section->nkinds == 0) return;
    fprintf(out, "\n| `%s:` | meaning |\n|---|---|\n", selector);
    for (size_t k = 0; k < section->nkinds; k++)
        fprintf(out, "| `%s`%s | %s |\n", section->kinds[k]->name, k == 0 ? " (default)" : "", section->kinds[k]->doc);
    for (size_t k = 0; k < section->nkinds; k++) {
        if (section->kinds[k]->nparams == 0) continue;
        fprintf(out, "\nWith `%s: %s`:\n", selector, section->kinds[k]->name);
        write_params(section->kinds[k]->params, section->kinds[k]->nparams, out);
    }
}

void fracas_campaign_reference(FILE *out)
{
    fprintf(out,
            "# Keys of a campaign file\n\n"
            "Written by `fracas reference` from the tables that read the file; how a file is built: "
            "[campaign-file.md](campaign-file.md).\nA bare number is in the SI unit given here; any other unit of the "
            "same dimension may follow it after a space.\n");
    fracas_campaign_memory *memory = fracas_memory_create();
    const fracas_catalog *catalog;
    if (memory && fracas_catalog_make(memory, &catalog) == FRACAS_OK)
        for (size_t s = 0; s < catalog->nsections; s++) write_section(catalog->section[s].table, out);
    fracas_memory_destroy(memory);
}
