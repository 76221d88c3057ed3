/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands reference and distributions: every key of a campaign file and value of a study. */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "base/param.h"
#include "base/units.h"
#include "campaigns/campaign.h"
#include "campaigns/store/datafile.h"
#include "sampler/strength.h"

#include <stdio.h>
#include <string.h>

static const fracas_option options[] = {
    {"schema", NULL, "a JSON schema of the same instead, for editors"},
    {"statistics", NULL, "every table of the JSON summary instead"},
    {"study", NULL, "every dataset of study.h5 and column of index.sqlite instead"},
    {0}};

static fracas_err reference(const fracas_arguments *arguments)
{
    if (fracas_given(arguments, "schema")) return fracas_campaign_schema(stdout);
    if (fracas_given(arguments, "statistics")) fracas_analysis_reference(stdout);
    else if (!fracas_given(arguments, "study")) return fracas_campaign_reference(stdout);
    else {
        fracas_study_reference(stdout);
        fputs("\n<!-- generated: derived -->\n", stdout);
        fracas_derived_reference(stdout);
        fputs("<!-- end of generated -->\n", stdout);
    }
    return FRACAS_OK;
}

const fracas_command fracas_command_reference = {
    .name = "reference",
    .doc = "Prints every key of a campaign file: unit, default, range, meaning",
    .more = "",
    .options = options,
    .run = reference,
};

/* ---- distributions ---- */

/* `pair`: 1 or 2, the alternative pair of keys with this one; 0: no alternatives. */
static void print_param(const fracas_param *param, size_t pair)
{
    char name[80], fallback[FRACAS_NUMBER_TEXT] = "";
    const char *unit = strcmp(param->unit, "1") ? param->unit : "", *given = fallback;
    if (pair > 0) given = pair == 1 ? "pair 1" : "pair 2";
    else if (param->optional) given = "optional";
    else if (isnan(param->fallback)) given = "required";
    else if (param->type == FRACAS_CHOICE) given = param->choices[(size_t)param->fallback]->name;
    else fracas_number_write(param->fallback, fallback);
    snprintf(name, sizeof name, "%s%s%s%s", param->name, *unit ? " [" : "", unit, *unit ? "]" : "");
    printf("    %-26s %-9s %s\n", name, given, param->doc);
    for (size_t c = 0; c < param->nchoices; c++)
        printf("    %-26s %-9s   %s: %s\n", "", "", param->choices[c]->name,
               param->choices[c]->doc);
}

/* A distribution has no optional keys, or four: a pair of its own and an alternative pair. */
static void print_kind(const fracas_kind *kind)
{
    size_t optional = 0, before = 0;
    for (size_t p = 0; p < kind->nparams; p++) optional += kind->params[p].optional;
    for (size_t p = 0; p < kind->nparams; p++) {
        const bool of_pair = optional == 4 && kind->params[p].optional;
        print_param(&kind->params[p], of_pair ? 1 + before / 2 : 0);
        before += of_pair;
    }
}

static fracas_err distributions(const fracas_arguments *arguments)
{
    (void)arguments;
    const fracas_section *section = &fracas_strength_section;
    for (size_t k = 0; k < section->nkinds; k++) {
        const fracas_kind *kind = section->kinds[k];
        printf("%s%s: %s\n", kind->name, k == 0 ? " (default)" : "", kind->doc);
        print_kind(kind);
        printf("\n");
    }
    if (section->nparams == 0) return FRACAS_OK;
    printf("With any of them:\n");
    for (size_t p = 0; p < section->nparams; p++) print_param(&section->params[p], 0);
    printf("\npair 1, pair 2: one of the two pairs, whole, and nothing of the other.\n");
    return FRACAS_OK;
}

const fracas_command fracas_command_distributions = {
    .name = "distributions",
    .doc = "Lists the distributions of strengths, with their keys",
    .more = "\nWhat the section `strength` of a campaign file can say: each distribution, its keys "
            "with their SI units and defaults, and the\n"
            "keys that go with all of them.\n",
    .run = distributions,
};
