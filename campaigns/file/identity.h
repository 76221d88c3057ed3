/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hashes of points and campaigns (docs/formats/campaign-file.md), and the table of points. */
#ifndef FRACAS_CAMPAIGNS_FILE_IDENTITY_H
#define FRACAS_CAMPAIGNS_FILE_IDENTITY_H

#include "campaigns/campaign.h"
#include "campaigns/file/catalog.h"

/* Fills point->hash: of lines "path=value" sorted by path. */
FRACAS_MUST_USE fracas_err fracas_point_identify(const fracas_catalog *catalog,
                                                 fracas_point *point);

/* Fills campaign->table: a column for each value of any point, and derived ones. `name`: of each
 * point's case, "" for none. */
FRACAS_MUST_USE fracas_err fracas_campaign_tabulate(const fracas_catalog *catalog,
                                                    const char *const *name,
                                                    fracas_campaign *campaign);

/* Fills campaign->hash, from the table. */
FRACAS_MUST_USE fracas_err fracas_campaign_identify(const fracas_catalog *catalog,
                                                    fracas_campaign *campaign);

#endif
