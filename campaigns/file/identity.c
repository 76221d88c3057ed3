/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/identity.h"

#include "campaigns/file/replicas.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Lines "path=value" of the sections in a point's hash, or outside it, sorted by path. */
static void write_values(const fracas_catalog *catalog, bool hashed, const void *owner, FILE *out)
{
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        fracas_value value;
        char text[FRACAS_LEAF_TEXT];
        if (leaf->section->table->hashed != hashed || leaf->section->table->run ||
            !fracas_leaf_get(leaf, owner, &value))
            continue;
        fracas_leaf_write(leaf, &value, text);
        fprintf(out, "%s=%s\n", leaf->path, text);
    }
}

static void write_campaign(const fracas_catalog *catalog, const fracas_campaign *campaign,
                           FILE *out)
{
    fprintf(out, "seed=%" PRIu64 "\n", campaign->seed);
    if (campaign->common_random_numbers) fprintf(out, "random_numbers=common\n");
    write_values(catalog, false, campaign, out);
    if (campaign->probes.count) {
        char text[FRACAS_PROBES_TEXT];
        fracas_probes_write(&campaign->probes, text);
        fprintf(out, "probes=%s\n", text);
    }
    size_t named = fracas_point_table_find(&campaign->table, "case");
    for (size_t p = 0; p < campaign->npoints; p++) {
        const char *name = named == SIZE_MAX ? "" : campaign->table.point[p].value[named].text;
        fprintf(out, "point=%s replicas=", fracas_hash_hex(&campaign->point[p].hash).text);
        fracas_replicas_write(&campaign->point[p], out);
        fprintf(out, "%s%s\n", *name ? " case=" : "", name);
    }
}

/* The hash of the point's text, or, without a point, of the campaign's. */
static fracas_err hash_of(const fracas_catalog *catalog, const fracas_point *point,
                          const fracas_campaign *campaign, fracas_hash *hash)
{
    OWNED char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return fracas_no_memory("the hash of a point");
    if (point) write_values(catalog, true, point, out);
    else write_campaign(catalog, campaign, out);
    const bool written = !ferror(out);
    if (fclose(out) || !written || !text) return fracas_no_memory("the hash of a point");
    *hash = fracas_hash_of(text, size);
    return FRACAS_OK;
}

fracas_err fracas_point_identify(const fracas_catalog *catalog, fracas_point *point)
{
    return hash_of(catalog, point, NULL, &point->hash);
}

fracas_err fracas_campaign_identify(const fracas_catalog *catalog, fracas_campaign *campaign)
{
    return hash_of(catalog, NULL, campaign, &campaign->hash);
}
