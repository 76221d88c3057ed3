/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/part.h"

#include <stdio.h>

/* The replicas of a part must not depend on other runs. */
static fracas_err check_part(const fracas_run_options *options, const fracas_campaign *campaign)
{
    for (size_t p = 0; options->parts > 1 && p < campaign->npoints; p++)
        if (campaign->point[p].rule.maximum > 0)
            return fracas_fail(FRACAS_USAGE,
                               "--part %d/%d: in %s a rule decides the replicas of point %zu "
                               "(`replicas: {minimum: ..., until: ...}`) by all that are there, "
                               "which no part has; give a number of replicas, or leave --part out",
                               options->part, options->parts, options->file, p);
    return FRACAS_OK;
}

fracas_err fracas_run_campaign(const fracas_run_options *options, fracas_campaign **campaign)
{
    TRY(fracas_campaign_read(options->file, campaign));
    fracas_err err = options->replicas ? fracas_campaign_replicas(*campaign, options->replicas)
                                       : FRACAS_OK;
    if (err) err = fracas_fail_within(err, "%s", options->file);
    else err = check_part(options, *campaign);
    if (err) {
        fracas_campaign_destroy(*campaign);
        *campaign = NULL;
    }
    return err;
}

size_t fracas_run_part(int part, int parts, fracas_index_row *row, size_t count)
{
    if (parts < 2) return count;
    size_t mine = 0;
    for (size_t i = (size_t)part - 1; i < count; i += (size_t)parts) row[mine++] = row[i];
    return mine;
}
