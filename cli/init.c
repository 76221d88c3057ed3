/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command init: a campaign file to start from. */
#include "cli/cli.h"

#include "campaigns/campaign.h"

static fracas_err init(const fracas_arguments *arguments)
{
    return fracas_campaign_template(arguments->operand, stdout);
}

const fracas_command fracas_command_init = {
    .name = "init",
    .operand = "MODEL",
    .doc = "Prints a campaign file of MODEL that runs in seconds, with every key explained",
    .more = "\nMODEL is bar, ring, membrane or shell.\n\n"
            "  fracas init bar > my-bar.yaml\n"
            "  fracas run my-bar.yaml\n",
    .run = init,
};
