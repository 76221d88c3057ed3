/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names and columns of points: hashes, repeated points, the table (docs/formats/campaign-file.md).
 */
#ifndef FRACAS_CAMPAIGNS_FILE_IDENTITY_H
#define FRACAS_CAMPAIGNS_FILE_IDENTITY_H

#include "campaigns/campaign.h"
#include "campaigns/file/catalog.h"

#include <stdio.h>

/* Writes the text for the point's hash: lines "path=value" sorted by path. */
void fracas_point_write(const fracas_catalog *catalog, const fracas_point *point, FILE *out);

/* Fills point->hash. */
FRACAS_MUST_USE fracas_err fracas_point_identify(const fracas_catalog *catalog,
                                                 fracas_point *point);

/* The first two points of equal hash, in plan order of the later one; *later is 0 if there is none.
 */
FRACAS_MUST_USE fracas_err fracas_points_repeated(const fracas_campaign *campaign, size_t *earlier,
                                                  size_t *later);

/* Fills campaign->table. `name`: of each point's case, "" for none. */
FRACAS_MUST_USE fracas_err fracas_campaign_tabulate(const fracas_catalog *catalog,
                                                    const char *const *name,
                                                    fracas_campaign *campaign);

/* Fills campaign->hash, from the table. */
FRACAS_MUST_USE fracas_err fracas_campaign_identify(const fracas_catalog *catalog,
                                                    fracas_campaign *campaign);

#endif
