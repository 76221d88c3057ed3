/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaigns and their points, for libfracas. */
#include "library/fracas.h"

#include "base/version.h"
#include "campaigns/campaign.h"

_Static_assert(FRACAS_STATUS_USAGE == (int)FRACAS_USAGE &&
                   FRACAS_STATUS_ENVIRONMENT == (int)FRACAS_ENVIRONMENT &&
                   FRACAS_STATUS_BUG == (int)FRACAS_BUG,
               "statuses are those of the program");

const char *fracas_error(void)
{
    return fracas_message();
}

const char *fracas_version(void)
{
    return FRACAS_VERSION;
}

int fracas_campaign_open(const char *path, fracas_campaign **campaign)
{
    return fracas_campaign_read(path, campaign);
}

int fracas_campaign_open_text(const char *text, size_t size, const char *name,
                              fracas_campaign **campaign)
{
    return fracas_campaign_read_text(text, size, name, campaign);
}

void fracas_campaign_close(fracas_campaign *campaign)
{
    fracas_campaign_destroy(campaign);
}

const char *fracas_campaign_name(const fracas_campaign *campaign)
{
    return campaign->name;
}

int fracas_campaign_resolved(const fracas_campaign *campaign, char **text)
{
    OWNED char *made = NULL;
    size_t size;
    FILE *out = open_memstream(&made, &size);
    if (!out) return fracas_no_memory("the text of a campaign");
    fracas_err err = fracas_campaign_write(campaign, out);
    const int bad = ferror(out);
    if ((fclose(out) || bad) && !err) err = fracas_no_memory("the text of a campaign");
    if (err) return err;
    *text = made;
    made = NULL;
    return 0;
}

void fracas_text_close(char *text)
{
    free(text);
}

size_t fracas_campaign_points(const fracas_campaign *campaign)
{
    return campaign->npoints;
}

int64_t fracas_campaign_point_replicas(const fracas_campaign *campaign, size_t point)
{
    return point < campaign->npoints ? fracas_point_most(&campaign->point[point]) : 0;
}

size_t fracas_campaign_columns(const fracas_campaign *campaign)
{
    return campaign->table.ncolumns;
}

static fracas_err check_column(const fracas_campaign *campaign, size_t i)
{
    if (i < campaign->table.ncolumns) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "points have no column %zu; they have %zu, from 0 on", i,
                       campaign->table.ncolumns);
}

int fracas_campaign_column_at(const fracas_campaign *campaign, size_t i,
                              fracas_table_column *column)
{
    TRY(check_column(campaign, i));
    const fracas_column *of = &campaign->table.column[i];
    *column = (fracas_table_column){.name = of->path,
                                    .type = of->text ? "text" : "float64",
                                    .unit = of->unit,
                                    .meaning = of->doc,
                                    .width = 1,
                                    .bytes = of->text ? 0 : sizeof(double)};
    return 0;
}

int fracas_campaign_value(const fracas_campaign *campaign, size_t point, size_t i, double *number,
                          const char **text)
{
    TRY(check_column(campaign, i));
    TRY(fracas_campaign_has(campaign, point));
    const fracas_value *value = &campaign->table.point[point].value[i];
    *number = value->real;
    *text = value->text;
    return 0;
}
