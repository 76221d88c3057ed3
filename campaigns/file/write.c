/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a campaign back to a file: SI, every default spelled out. */
#include "campaigns/campaign.h"

#include "campaigns/file/catalog.h"
#include "campaigns/file/probes.h"
#include "campaigns/file/replicas.h"
#include "campaigns/file/report_keys.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

static const void *owner_of(const fracas_leaf *leaf, const fracas_campaign *campaign, size_t point)
{
    return leaf->section->table->hashed ? (const void *)&campaign->point[point] : campaign;
}

/* The value as text, a file by the path of its copy; false if the point has none. */
static bool write_value(const fracas_leaf *leaf, const fracas_campaign *campaign, size_t point,
                        char text[FRACAS_LEAF_TEXT])
{
    fracas_value value;
    if (!fracas_leaf_get(leaf, owner_of(leaf, campaign, point), &value)) return false;
    const bool file = leaf->param && leaf->param->type == FRACAS_ATTACHMENT;
    if (file) snprintf(text, FRACAS_LEAF_TEXT, FRACAS_ATTACHMENTS "/%s", value.text);
    else fracas_leaf_write(leaf, &value, text);
    return !file || *value.text;
}

static bool kind_varies(const fracas_file_section *section, const fracas_campaign *campaign)
{
    if (!section->table->hashed) return false;
    const fracas_kind *kind = fracas_section_kind(section, &campaign->point[0]);
    for (size_t p = 1; p < campaign->npoints; p++)
        if (fracas_section_kind(section, &campaign->point[p]) != kind) return true;
    return false;
}

/* True if the value is inherited when the section's kind changes: at points of every model in the
 * campaign, and of the default model. */
static bool is_common(const fracas_leaf *leaf, const fracas_kind *unnamed,
                      const fracas_campaign *campaign)
{
    if (!leaf->param || leaf->section->table->follows) return false;
    const fracas_kind *first = campaign->point[0].spec.formulation;
    bool common = fracas_section_common(leaf->section->table, first, leaf->key);
    for (size_t p = 1; p < campaign->npoints && common; p++) {
        const fracas_kind *model = campaign->point[p].spec.formulation;
        if (model != first)
            common = fracas_section_common(leaf->section->table, model, leaf->key) &&
                     fracas_section_common(leaf->section->table, unnamed, leaf->key);
    }
    return common;
}

/* True if the leaf is written once, in its section: its value is the same at all points. Keys of a
 * kind stay with the kind's name, since a sweep of the kind drops base keys of another kind. */
static bool is_base(const fracas_leaf *leaf, const fracas_kind *unnamed,
                    const fracas_campaign *campaign)
{
    if (kind_varies(leaf->section, campaign) && !is_common(leaf, unnamed, campaign)) return false;
    char first[FRACAS_LEAF_TEXT], other[FRACAS_LEAF_TEXT];
    if (!write_value(leaf, campaign, 0, first)) return false;
    for (size_t p = 1; p < campaign->npoints && leaf->section->table->hashed; p++)
        if (!write_value(leaf, campaign, p, other) || strcmp(first, other) != 0) return false;
    return true;
}

/* ---- the sections ---- */

/* The leaf to write after `leaf` (NULL: the first): the kind's name, then the values; NULL at the
 * end. */
static const fracas_leaf *next_leaf(const fracas_catalog *catalog,
                                    const fracas_file_section *section, const fracas_leaf *leaf)
{
    const fracas_leaf *selector = fracas_catalog_key(catalog, section, NULL),
                      *end = catalog->leaf + catalog->nleaves;
    if (!leaf && selector) return selector;
    for (leaf = leaf && leaf != selector ? leaf + 1 : catalog->leaf; leaf < end; leaf++)
        if (leaf->section == section && leaf != selector) return leaf;
    return NULL;
}

static void write_unit(const fracas_leaf *leaf, FILE *out)
{
    bool pure = !leaf->param || strcmp(leaf->param->unit, "1") == 0;
    fprintf(out, "%s%s\n", pure ? "" : " # ", pure ? "" : leaf->param->unit);
}

/* True if a later item of the section's list is in the base. */
static bool is_followed(const fracas_catalog *catalog, const bool *base,
                        const fracas_file_section *section)
{
    while ((section = fracas_catalog_next(catalog, section)))
        for (size_t i = 0; i < catalog->nleaves; i++)
            if (catalog->leaf[i].section == section && base[i]) return true;
    return false;
}

/* An item of a list, if the section follows another or is followed by one: `- {}` without values.
 */
static void write_section(const fracas_catalog *catalog, const bool *base,
                          const fracas_file_section *section, const fracas_campaign *campaign,
                          FILE *out)
{
    const bool later = is_followed(catalog, base, section), first = !section->table->follows,
               item = later || !first;
    bool begun = false;
    for (const fracas_leaf *leaf = NULL; (leaf = next_leaf(catalog, section, leaf));) {
        char text[FRACAS_LEAF_TEXT];
        if (!base[leaf - catalog->leaf] || !write_value(leaf, campaign, 0, text)) continue;
        const bool whole = strcmp(leaf->path, section->table->name) == 0;
        if (!begun && !whole && first) fprintf(out, "%s:\n", section->table->name);
        fprintf(out, "%s%s: %s",
                whole   ? ""
                : !item ? "  "
                : begun ? "    "
                        : "  - ",
                leaf->key, text);
        begun = true;
        write_unit(leaf, out);
    }
    if (begun || !later) return;
    if (first) fprintf(out, "%s:\n", section->table->name);
    fprintf(out, "  - {}\n");
}

/* ---- the cases ---- */

/* Writes "- key: " before the first entry of a case and "  key: " before the others. */
static void begin_entry(bool *first, const char *key, FILE *out)
{
    fprintf(out, "      %s %s: ", *first ? "-" : " ", key);
    *first = false;
}

/* Writes values of this point outside the base as "section: {key: value}". */
static void write_case_section(const fracas_catalog *catalog, const bool *base,
                               const fracas_file_section *section, const fracas_campaign *campaign,
                               size_t point, bool *first, FILE *out)
{
    bool begun = false;
    for (const fracas_leaf *leaf = NULL; (leaf = next_leaf(catalog, section, leaf));) {
        char text[FRACAS_LEAF_TEXT];
        if (base[leaf - catalog->leaf] || !write_value(leaf, campaign, point, text)) continue;
        if (!begun) begin_entry(first, section->table->name, out);
        if (strcmp(leaf->path, section->table->name) == 0) {
            fprintf(out, "%s\n", text);
            return;
        }
        fprintf(out, "%s%s: %s", begun ? ", " : "{", leaf->key, text);
        begun = true;
    }
    if (begun) fprintf(out, "}\n");
}

static void write_cases(const fracas_catalog *catalog, const bool *base,
                        const fracas_campaign *campaign, bool own_replicas, FILE *out)
{
    size_t named = fracas_point_table_find(&campaign->table, "case");
    if (campaign->npoints == 1 && named == SIZE_MAX) return;
    fprintf(out, "sweep:\n  - cases:\n");
    for (size_t p = 0; p < campaign->npoints; p++) {
        bool first = true;
        const char *name = named == SIZE_MAX ? "" : campaign->table.point[p].value[named].text;
        if (*name) {
            begin_entry(&first, "name", out);
            fprintf(out, "%s\n", name);
        }
        for (size_t s = 0; s < catalog->nsections; s++)
            if (catalog->section[s].table->hashed)
                write_case_section(catalog, base, &catalog->section[s], campaign, p, &first, out);
        if (own_replicas) {
            begin_entry(&first, "replicas", out);
            fracas_replicas_write(&campaign->point[p], out);
            putc('\n', out);
        }
    }
}

/* ---- the file ---- */

static void write_file(const fracas_catalog *catalog, const bool *base,
                       const fracas_campaign *campaign, FILE *out)
{
    bool own_replicas = false;
    for (size_t p = 1; p < campaign->npoints; p++)
        own_replicas = own_replicas ||
                       !fracas_replicas_same(&campaign->point[p], &campaign->point[0]);
    fprintf(out, FRACAS_RESOLVED "name: %s\nseed: %" PRIu64 "\n", campaign->name, campaign->seed);
    if (campaign->common_random_numbers) fprintf(out, "random_numbers: common\n");
    for (size_t s = 0; s < catalog->nsections; s++)
        if (catalog->section[s].table->hashed)
            write_section(catalog, base, &catalog->section[s], campaign, out);
    write_cases(catalog, base, campaign, own_replicas, out);
    if (!own_replicas) {
        fprintf(out, "replicas: ");
        fracas_replicas_write(&campaign->point[0], out);
        putc('\n', out);
    }
    for (size_t s = 0; s < catalog->nsections; s++)
        if (!catalog->section[s].table->hashed && !catalog->section[s].table->run)
            write_section(catalog, base, &catalog->section[s], campaign, out);
    fracas_campaign_probes_write(&campaign->probes, out);
    fracas_report_keys_write(&campaign->report, out);
}

fracas_err fracas_campaign_write(const fracas_campaign *campaign, FILE *out)
{
    OWN(fracas_campaign_memory) memory = fracas_memory_create();
    if (!memory) return fracas_no_memory("the resolved campaign");
    const fracas_catalog *catalog;
    TRY(fracas_catalog_make(memory, &catalog));
    bool *base = fracas_memory_take(memory, catalog->nleaves, sizeof *base);
    if (!base) return fracas_no_memory("the resolved campaign");
    const fracas_kind *unnamed = catalog->section->table->kinds[0];
    for (size_t i = 0; i < catalog->nleaves; i++)
        base[i] = is_base(&catalog->leaf[i], unnamed, campaign);
    write_file(catalog, base, campaign, out);
    if (fflush(out) == 0 && !ferror(out)) return FRACAS_OK;
    return fracas_fail_system(errno, "cannot write the resolved campaign %s", campaign->name);
}
