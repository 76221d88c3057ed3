/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/header.h"

#include "base/version.h"

fracas_file_header fracas_campaign_header(const fracas_campaign *campaign)
{
    return (fracas_file_header){.campaign = campaign->hash,
                                .seed = campaign->seed,
                                .history = campaign->output.history,
                                .interfaces = campaign->output.interfaces,
                                .version = FRACAS_VERSION};
}
