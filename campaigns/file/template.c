/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaign files to start from, one for each model: the values below, with all that the parameter
 * tables say. */
#include "campaigns/campaign.h"

#include "base/units.h"
#include "campaigns/file/catalog.h"
#include "campaigns/file/words.h"

#include <string.h>

typedef struct {
    const char *model, *path, *value;
} given;

/* Bodies that break into tens of pieces in seconds. */
static const given values[] = {
    {"bar", "geometry.length", "40 mm"},
    {"bar", "mesh.elements", "4000"},
    {"bar", "loading.rate", "1e4 1/s"},
    {"bar", "strength.reference_volume", "0.01 mm3"},
    {"ring", "strength.reference_volume", "0.01 mm3"},
    {"ring", "geometry.radius", "6 mm"},
    {"ring", "mesh.elements", "3750"},
    {"ring", "loading.type", "initial-velocity"},
    {"ring", "loading.radial", "60 m/s"},
    {"membrane", "geometry.width", "8 mm"},
    {"membrane", "geometry.height", "4 mm"},
    {"membrane", "geometry.thickness", "0.1 mm"},
    {"membrane", "mesh.divisions", "24"},
    {"membrane", "mesh.amplitude", "0.2"},
    {"membrane", "loading.rate", "1e4 1/s"},
    {"shell", "geometry.part", "octant"},
    {"shell", "geometry.radius", "4 mm"},
    {"shell", "geometry.thickness", "0.2 mm"},
    {"shell", "mesh.divisions", "24"},
    {"shell", "mesh.amplitude", "0.1"},
    {"shell", "loading.rate", "1e4 1/s"},
    {NULL, "material.young", "370 GPa"},
    {NULL, "material.density", "3900 kg/m3"},
    {"membrane", "material.poisson", "0.22"},
    {"shell", "material.poisson", "0.22"},
    {NULL, "cohesive.fracture_energy", "50 J/m2"},
    {NULL, "strength.distribution", "weibull"},
    {NULL, "strength.scale", "300 MPa"},
    {NULL, "strength.shape", "10"},
    {NULL, "time.stop", "settled"},
    {"bar", "output.interfaces", "true"}, /* for `fracas picture` */
    {"ring", "output.interfaces", "true"},
    {"membrane", "output.interfaces", "true"},
    {"shell", "output.interfaces", "true"},
};

/* NULL: the key keeps its default. */
static const char *value_of(const fracas_kind *model, const char *section, const char *key)
{
    char path[128];
    snprintf(path, sizeof path, "%s.%s", section, key);
    for (size_t v = 0; v < FRACAS_COUNT(values); v++)
        if (!strcmp(values[v].path, path) &&
            (!values[v].model || !strcmp(values[v].model, model->name)))
            return values[v].value;
    return NULL;
}

/* The kind that the values name, else the model's default. */
static const fracas_kind *kind_of(const fracas_kind *model, const fracas_section *section)
{
    if (section->nkinds == 0) return NULL;
    const char *name = value_of(model, section->name, fracas_section_selector(section));
    for (size_t k = 0; name && k < section->nkinds; k++)
        if (!strcmp(section->kinds[k]->name, name)) return section->kinds[k];
    const fracas_kind *partner = fracas_kind_partner(model, section, 0);
    return partner ? partner : section->kinds[0];
}

/* Every kind of the section that goes with the model. */
static void write_kinds(const fracas_kind *model, const fracas_section *section,
                        const fracas_kind *kind, FILE *out)
{
    fprintf(out, "  %s: %-30s # ", fracas_section_selector(section), kind->name);
    const bool restricted = fracas_kind_partner(model, section, 0) != NULL;
    const fracas_kind *one;
    size_t others = 0;
    for (size_t k = 0; (one = restricted            ? fracas_kind_partner(model, section, k)
                              : k < section->nkinds ? section->kinds[k]
                                                    : NULL);
         k++)
        if (one != kind) fprintf(out, "%s%s", others++ ? ", " : "or ", one->name);
    fprintf(out, "%s\n", others ? "" : "the only kind here");
}

static void write_default(const fracas_param *param, char text[FRACAS_NUMBER_TEXT])
{
    if (param->optional || fracas_param_is_object(param) || isnan(param->fallback))
        strcpy(text, "...");
    else if (param->type == FRACAS_BOOLEAN) strcpy(text, param->fallback != 0 ? "true" : "false");
    else fracas_number_write(param->fallback, text);
}

static void write_param(const fracas_kind *model, const fracas_section *section,
                        const fracas_param *param, FILE *out)
{
    char fallback[FRACAS_NUMBER_TEXT];
    const char *value = value_of(model, section->name, param->name), *shown = fallback;
    if (!fracas_param_is_of(param, model)) return;
    if (!value) write_default(param, fallback);
    if (value) shown = value;
    else if (param->type == FRACAS_CHOICE && !param->optional && !isnan(param->fallback))
        shown = param->choices[(size_t)param->fallback]->name;
    char entry[160];
    const bool pure = !strcmp(param->unit, "1");
    snprintf(entry, sizeof entry, "%s%s: %s", value ? "" : "# ", param->name, shown);
    fprintf(out, "  %-40s # %s%s%s%s\n", entry, param->doc, pure ? "" : " [",
            pure ? "" : param->unit, pure ? "" : "]");
}

static void write_section(const fracas_kind *model, const fracas_section *section, FILE *out)
{
    const fracas_kind *kind = kind_of(model, section);
    bool any = kind != NULL, known = any;
    for (size_t p = 0; p < section->nparams; p++) {
        any = any || value_of(model, section->name, section->params[p].name);
        known = known || fracas_param_is_of(&section->params[p], model);
    }
    if (!known) return; /* the model has none of its keys */
    fprintf(out, "\n# %s.\n", section->doc);
    fprintf(out, "%s%s:\n", any ? "" : "# ", section->name); /* an empty section is none */
    if (kind) write_kinds(model, section, kind, out);
    for (size_t p = 0; p < section->nparams; p++)
        write_param(model, section, &section->params[p], out);
    for (size_t p = 0; kind && p < kind->nparams; p++)
        write_param(model, section, &kind->params[p], out);
}

fracas_err fracas_campaign_template(const char *name, FILE *out)
{
    OWN(fracas_campaign_memory) memory = fracas_memory_create();
    const fracas_catalog *catalog;
    const fracas_kind *model = NULL;
    fracas_words words;
    if (!memory) return fracas_no_memory("the list of keys");
    TRY(fracas_catalog_make(memory, &catalog));
    fracas_words_init(&words, name);
    const fracas_section *models = catalog->section->table;
    for (size_t m = 0; m < models->nkinds; m++) {
        if (!strcmp(models->kinds[m]->name, name)) model = models->kinds[m];
        fracas_words_add(&words, models->kinds[m]->name);
    }
    if (!model)
        return fracas_fail(FRACAS_USAGE, "unknown model `%s`%s", name,
                           fracas_words_hint(&words, "there are"));
    fprintf(out,
            "# yaml-language-server: $schema=campaign.schema.json\n"
            "# The schema is printed by `fracas reference --schema`. Lines that begin with # give "
            "defaults.\n"
            "name: my-%s\nseed: 1\nreplicas: 4\nmodel: %s # %s\n",
            model->name, model->name, model->doc);
    for (size_t s = 1; s < catalog->nsections; s++)
        if (!catalog->section[s].table->follows)
            write_section(model, catalog->section[s].table, out);
    fprintf(out, "\n# Points: every combination of the values of each axis.\n# sweep:\n"
                 "#   - strength.shape: [5, 10, 20]\n");
    return FRACAS_OK;
}
