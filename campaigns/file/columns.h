/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of points: a column for each value of any point, and derived ones. */
#ifndef FRACAS_CAMPAIGNS_FILE_COLUMNS_H
#define FRACAS_CAMPAIGNS_FILE_COLUMNS_H

#include "campaigns/campaign.h"
#include "campaigns/file/catalog.h"

/* Fills campaign->table. `name`: of each point's case, "" for none. */
FRACAS_MUST_USE fracas_err fracas_campaign_tabulate(const fracas_catalog *catalog,
                                                    const char *const *name,
                                                    fracas_campaign *campaign);

#endif
