#include "cli/cli.h"

#include "campaigns/campaign.h"

static fracas_err reference(const fracas_arguments *arguments)
{
    (void)arguments;
    fracas_campaign_reference(stdout);
    return FRACAS_OK;
}

const fracas_command fracas_command_reference = {
    .name = "reference", .doc = "Prints every key of a campaign file: unit, default, range, meaning",
    .more = "", .run = reference,
};
