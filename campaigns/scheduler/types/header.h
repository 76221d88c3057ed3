/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Header of the segments and of study.h5. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_HEADER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_HEADER_H

#include "base/version.h"
#include "campaigns/campaign.h"
#include "campaigns/store/datafile.h"

/* Header of a campaign's files, with the version of this program. */
static inline fracas_file_header fracas_campaign_header(const fracas_campaign *campaign)
{
    return (fracas_file_header){.campaign = campaign->hash,
                                .seed = campaign->seed,
                                .history = campaign->output.history,
                                .interfaces = campaign->output.interfaces,
                                .reactions = campaign->output.reactions != NULL,
                                .probes = campaign->probes,
                                .version = FRACAS_VERSION};
}

#endif
