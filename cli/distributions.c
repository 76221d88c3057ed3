#include "cli/cli.h"

#include "base/units.h"
#include "sampler/strength.h"

#include <stdio.h>
#include <string.h>

static void print_param(const fracas_param *param)
{
    char name[80], fallback[FRACAS_NUMBER_TEXT] = "";
    const char *unit = strcmp(param->unit, "1") ? param->unit : "", *given = fallback;
    if (param->optional) given = "optional";
    else if (isnan(param->fallback)) given = "required";
    else if (param->type == FRACAS_CHOICE) given = param->choices[(size_t)param->fallback]->name;
    else fracas_number_write(param->fallback, fallback);
    snprintf(name, sizeof name, "%s%s%s%s", param->name, *unit ? " [" : "", unit, *unit ? "]" : "");
    printf("    %-26s %-9s %s\n", name, given, param->doc);
    for (size_t c = 0; c < param->nchoices; c++)
        printf("    %-26s %-9s   %s: %s\n", "", "", param->choices[c]->name, param->choices[c]->doc);
}

static fracas_err distributions(const fracas_arguments *arguments)
{
    (void)arguments;
    const fracas_section *section = &fracas_strength_section;
    for (size_t k = 0; k < section->nkinds; k++) {
        const fracas_kind *kind = section->kinds[k];
        printf("%s%s: %s\n", kind->name, k == 0 ? " (default)" : "", kind->doc);
        for (size_t p = 0; p < kind->nparams; p++) print_param(&kind->params[p]);
        printf("\n");
    }
    if (section->nparams == 0) return FRACAS_OK;
    printf("With any of them:\n");
    for (size_t p = 0; p < section->nparams; p++) print_param(&section->params[p]);
    return FRACAS_OK;
}

const fracas_command fracas_command_distributions = {
    .name = "distributions", .doc = "Lists the distributions of strengths, with their keys",
    .more = "\nWhat the section `strength` of a campaign file can say: each distribution, its keys with their SI units and defaults, and the\n"
            "keys that go with all of them.\n",
    .run = distributions,
};
