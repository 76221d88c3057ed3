/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/compare/compare.h"
#include "base/param.h"
#include "campaigns/campaign.h"

#include <stdio.h>

static const fracas_option options[] = {
    {"by", "COLUMNS", "match points by these columns alone, as loading.rate,strength.shape"},
    {"points", "A,B",
     "compare points of one study instead: two as 3,17, ranges as 0-2,9-11, lists as 0,1:9,10"},
    {"json", NULL, "print it as JSON"},
    FRACAS_WIDE_OPTION,
    {0}};

/* study.h5 does not say whether random numbers are common: the campaign does. */
static fracas_err read_common(const char *study, bool *common)
{
    OWN(fracas_campaign) campaign = NULL;
    *common = false;
    TRY(fracas_cli_campaign_seen(study, &campaign));
    *common = campaign && campaign->common_random_numbers;
    return FRACAS_OK;
}

static fracas_err print(const fracas_arguments *arguments, const fracas_analysis *a,
                        const fracas_analysis *b)
{
    bool common_a, common_b = true;
    TRY(read_common(arguments->operand, &common_a));
    if (arguments->second) TRY(read_common(arguments->second, &common_b));
    const fracas_compare_options how = {.by = fracas_given(arguments, "by"),
                                        .points = fracas_given(arguments, "points"),
                                        .common = common_a && common_b};
    if (how.by && how.points)
        return fracas_fail(FRACAS_USAGE, "compare: --by matches points of two studies, --points "
                                         "names those of one: give one of them");
    FRACAS_CLEARED(fracas_comparison) comparison = {0};
    TRY(fracas_compare(a, b, &how, &comparison));
    if (!fracas_given(arguments, "json"))
        return fracas_comparison_print(&comparison, a, b, fracas_cli_columns(arguments), stdout);
    fracas_comparison_write_json(&comparison, a, b, stdout);
    return FRACAS_OK;
}

static fracas_err compare(const fracas_arguments *arguments)
{
    OWN(fracas_campaign) of_a = NULL;
    OWN(fracas_campaign) of_b = NULL;
    OWN(fracas_analysis) a = NULL;
    OWN(fracas_analysis) b = NULL;
    const char *second = arguments->second;
    if (second && !fracas_cli_alone(second)) TRY(fracas_cli_check_study(second));
    TRY(fracas_cli_analyse(arguments->operand, &of_a, &a));
    if (!second) return print(arguments, a, a);
    TRY(fracas_cli_analyse(second, &of_b, &b));
    return print(arguments, a, b);
}

const fracas_command fracas_command_compare = {
    .name = "compare",
    .operand = "A",
    .second = "B",
    .instead = "points",
    .doc = "Says in which numbers two studies differ, and how surely",
    .more = "\nA and B are folders, or study.h5 alone.\n"
            "Points are matched by their parameters, or are those of --points. For each pair: B - "
            "A of every mean over realizations with its 95 % interval,\n"
            "and p of tests that permute whole realizations. The status is 0 whatever they find.\n",
    .options = options,
    .run = compare,
};
