/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/store/store.h"

static const fracas_option options[] = {
    {"statistics", NULL, "every table of the JSON summary instead"},
    {"study", NULL, "every dataset of study.h5 and column of index.sqlite instead"},
    {0}};

static fracas_err reference(const fracas_arguments *arguments)
{
    if (fracas_given(arguments, "statistics")) fracas_analysis_reference(stdout);
    else if (!fracas_given(arguments, "study")) fracas_campaign_reference(stdout);
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
