/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading many campaign files with one unit database. */
#ifndef FRACAS_CAMPAIGNS_FILE_READ_H
#define FRACAS_CAMPAIGNS_FILE_READ_H

#include "base/units.h"
#include "campaigns/campaign.h"

/* fracas_campaign_read with a loaded unit database, whose loading takes longer than reading a file.
 */
FRACAS_MUST_USE fracas_err fracas_campaign_read_with(const fracas_units *units, const char *path,
                                                     fracas_campaign **campaign);

#endif
