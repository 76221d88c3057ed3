/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A campaign as text with its files, for study.h5. */
#include "campaigns/campaign.h"

#include <stdlib.h>
#include <string.h>

fracas_attachment_name fracas_attachment_named(const fracas_attachment *attachment)
{
    fracas_attachment_name name;
    snprintf(name.text, sizeof name.text, FRACAS_ATTACHMENTS "/%s", attachment->digest);
    return name;
}

bool fracas_campaign_names(const char *text, const fracas_attachment *attachment)
{
    return strstr(text, fracas_attachment_named(attachment).text) != NULL;
}

fracas_err fracas_campaign_text(const fracas_campaign *campaign, char **text, size_t *size)
{
    OWNED char *made = NULL;
    FILE *out = open_memstream(&made, size);
    if (!out) return fracas_no_memory("the resolved campaign");
    fracas_err err = fracas_campaign_write(campaign, out);
    if ((fclose(out) || !made) && !err) err = fracas_no_memory("the resolved campaign");
    TRY(err);
    *text = made;
    made = NULL;
    return FRACAS_OK;
}

static int by_digest(const void *a, const void *b)
{
    return strcmp(((const fracas_attachment *)a)->digest, ((const fracas_attachment *)b)->digest);
}

/* A file that the user's text names and the resolved one does not is none of the copy's, and two of
 * one content are one. */
static fracas_err list_files(const fracas_campaign *campaign, fracas_campaign_copy *copy)
{
    size_t most = 0, kept = 0;
    for (const fracas_attached *a = campaign->attached; a; a = a->next) most++;
    copy->file = calloc(most + 1, sizeof *copy->file);
    if (!copy->file) return fracas_no_memory("the files that the campaign names");
    for (const fracas_attached *a = campaign->attached; a; a = a->next)
        if (fracas_campaign_names(copy->text, &a->attachment))
            copy->file[copy->nfiles++] = a->attachment;
    qsort(copy->file, copy->nfiles, sizeof *copy->file, by_digest);
    for (size_t i = 0; i < copy->nfiles; i++)
        if (!kept || by_digest(&copy->file[kept - 1], &copy->file[i]))
            copy->file[kept++] = copy->file[i];
    copy->nfiles = kept;
    for (size_t i = 0; i < kept; i++) copy->file[i].path = NULL;
    return FRACAS_OK;
}

fracas_err fracas_campaign_copy_make(const fracas_campaign *campaign, fracas_campaign_copy *copy)
{
    *copy = (fracas_campaign_copy){0};
    TRY(fracas_campaign_text(campaign, &copy->text, &copy->size));
    return list_files(campaign, copy);
}
