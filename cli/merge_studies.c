/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/upkeep.h"

#include <inttypes.h>
#include <stdio.h>

static void print_joined(fracas_cli_upkeep *upkeep, const char *from, const fracas_joined *joined,
                         int64_t both)
{
    if (upkeep->with_json) {
        fracas_json_text(&upkeep->json, "from", from);
        fracas_json_integer(&upkeep->json, "taken_realizations", joined->realizations);
        fracas_json_integer(&upkeep->json, "taken_segments", joined->segments);
        fracas_json_integer(&upkeep->json, "taken_failures", joined->failed);
        fracas_json_integer(&upkeep->json, "in_both", both);
        return;
    }
    printf("from %s: %" PRId64 " realizations in %" PRId64 " segments, %" PRId64
           " failures; %" PRId64 " realizations are in both, and the same\n",
           from, joined->realizations, joined->segments, joined->failed, both);
}

static fracas_err merge_studies(const fracas_arguments *arguments)
{
    const char *into = arguments->operand, *from = arguments->second;
    fracas_cli_upkeep upkeep;
    fracas_joined joined;
    fracas_upkeep end;
    int64_t both;
    TRY(fracas_cli_check_study(into));
    TRY(fracas_cli_check_study(from));
    fracas_cli_upkeep_begin(&upkeep, into, fracas_given(arguments, "json"));
    fracas_err code = fracas_upkeep_join(into, from, &upkeep.said, &joined, &both, &end);
    if (!code) {
        fracas_cli_upkeep_counts(&upkeep, &end);
        print_joined(&upkeep, from, &joined, both);
        fracas_cli_upkeep_next(&upkeep, &end);
    }
    fracas_cli_upkeep_end(&upkeep);
    return code;
}

const fracas_command fracas_command_merge_studies = {
    .name = "merge-studies",
    .operand = "A",
    .second = "B",
    .doc = "Adds to study A what study B has of the same campaign",
    .more = "\nFor a campaign that was computed in two places, as by `fracas run FILE --part 1/2` "
            "and `--part 2/2`. The campaign of one may\n"
            "be an extension of the other's; program version, seed and output options must be the "
            "same. What both have is compared\n"
            "bit for bit before anything is copied: status 5 names the first difference. B stays "
            "as it is, but for damaged\n"
            "segments, which are set aside.\n",
    .options = fracas_json_option,
    .run = merge_studies,
};
