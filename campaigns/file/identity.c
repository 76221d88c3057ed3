/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/identity.h"

#include "campaigns/file/derived.h"
#include "campaigns/file/replicas.h"
#include "engine/mesh/make.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- hashes ---- */

void fracas_point_write(const fracas_catalog *catalog, const fracas_point *point, FILE *out)
{
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        fracas_value value;
        if (!leaf->section->table->hashed || !fracas_leaf_get(leaf, point, &value)) continue;
        char text[FRACAS_LEAF_TEXT];
        fracas_leaf_write(leaf, &value, text);
        fprintf(out, "%s=%s\n", leaf->path, text);
    }
}

static void write_campaign(const fracas_catalog *catalog, const fracas_campaign *campaign,
                           FILE *out)
{
    fprintf(out, "seed=%" PRIu64 "\n", campaign->seed);
    if (campaign->common_random_numbers) fprintf(out, "random_numbers=common\n");
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        fracas_value value;
        if (leaf->section->table->hashed || !fracas_leaf_get(leaf, &campaign->output, &value))
            continue;
        char text[FRACAS_LEAF_TEXT];
        fracas_leaf_write(leaf, &value, text);
        fprintf(out, "%s=%s\n", leaf->path, text);
    }
    size_t named = fracas_point_table_find(&campaign->table, "case");
    for (size_t p = 0; p < campaign->npoints; p++) {
        char hex[FRACAS_HASH_HEX];
        fracas_hash_hex(&campaign->point[p].hash, hex);
        const char *name = named == SIZE_MAX ? "" : campaign->table.point[p].value[named].text;
        fprintf(out, "point=%s replicas=", hex);
        fracas_replicas_write(&campaign->point[p], out);
        fprintf(out, "%s%s\n", *name ? " case=" : "", name);
    }
}

/* A text written only for its hash. */
typedef struct {
    FILE *out;
    char *text;
    size_t size;
} memo;

static fracas_err memo_open(memo *text)
{
    *text = (memo){0};
    text->out = open_memstream(&text->text, &text->size);
    return text->out ? FRACAS_OK : fracas_no_memory("the hash of a point");
}

static fracas_err memo_hash(memo *text, fracas_hash *hash)
{
    bool written = !ferror(text->out);
    written = fclose(text->out) == 0 && written;
    if (written) *hash = fracas_hash_of(text->text, text->size);
    free(text->text);
    return written ? FRACAS_OK : fracas_no_memory("the hash of a point");
}

fracas_err fracas_point_identify(const fracas_catalog *catalog, fracas_point *point)
{
    memo text;
    TRY(memo_open(&text));
    fracas_point_write(catalog, point, text.out);
    return memo_hash(&text, &point->hash);
}

fracas_err fracas_campaign_identify(const fracas_catalog *catalog, fracas_campaign *campaign)
{
    memo text;
    TRY(memo_open(&text));
    write_campaign(catalog, campaign, text.out);
    return memo_hash(&text, &campaign->hash);
}

/* ---- repeated points ---- */

typedef struct {
    fracas_hash hash;
    size_t point;
} numbered_hash;

static int by_hash(const void *a, const void *b)
{
    const numbered_hash *x = a, *y = b;
    int order = memcmp(x->hash.byte, y->hash.byte, sizeof x->hash.byte);
    return order ? order : (x->point > y->point) - (x->point < y->point);
}

fracas_err fracas_points_repeated(const fracas_campaign *campaign, size_t *earlier, size_t *later)
{
    numbered_hash *sorted = malloc(campaign->npoints * sizeof *sorted);
    if (!sorted) return fracas_no_memory("the points of the campaign");
    for (size_t p = 0; p < campaign->npoints; p++)
        sorted[p] = (numbered_hash){campaign->point[p].hash, p};
    qsort(sorted, campaign->npoints, sizeof *sorted, by_hash);
    *earlier = *later = 0;
    for (size_t i = 1; i < campaign->npoints; i++) {
        if (!fracas_hash_equal(&sorted[i].hash, &sorted[i - 1].hash)) continue;
        if (*later > 0 && sorted[i].point > *later) continue;
        *earlier = sorted[i - 1].point;
        *later = sorted[i].point;
    }
    free(sorted);
    return FRACAS_OK;
}

/* ---- columns ---- */

/* Source of a column's values: a leaf, a derivation, or neither for the name of the case. */
typedef struct {
    fracas_column column;
    const fracas_leaf *leaf;
    const fracas_derived *derived;
} source;

static bool any_point_has(const fracas_campaign *campaign, const fracas_leaf *leaf)
{
    fracas_value value;
    for (size_t p = 0; p < campaign->npoints; p++)
        if (fracas_leaf_get(leaf, &campaign->point[p], &value)) return true;
    return false;
}

static int by_path(const void *a, const void *b)
{
    return strcmp(((const source *)a)->column.path, ((const source *)b)->column.path);
}

static size_t list_sources(const fracas_catalog *catalog, const fracas_campaign *campaign,
                           bool named, source *sources)
{
    size_t count = 0;
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        const fracas_section *table = leaf->section->table;
        if (!table->hashed || !any_point_has(campaign, leaf)) continue;
        const bool text = fracas_leaf_is_text(leaf);
        fracas_column column = {leaf->path, text ? "" : leaf->param->unit,
                                leaf->param ? leaf->param->doc : table->doc, text};
        sources[count++] = (source){column, leaf, NULL};
    }
    for (int d = 0; d < FRACAS_DERIVED; d++)
        sources[count++] = (source){fracas_derived_columns[d].column, NULL,
                                    &fracas_derived_columns[d]};
    if (named) sources[count++] = (source){{"case", "", "name of the case", true}, NULL, NULL};
    qsort(sources, count, sizeof *sources, by_path);
    return count;
}

/* The latest mesh made for the extent of an interface. */
typedef struct {
    const fracas_spec *spec; /* NULL: none yet */
    fracas_extent extent;
} known_mesh;

static bool is_same_mesh(const fracas_spec *a, const fracas_spec *b)
{
    return memcmp(&a->geometry, &b->geometry, sizeof a->geometry) == 0 &&
           memcmp(&a->mesh, &b->mesh, sizeof a->mesh) == 0;
}

/* Makes the slow mesh only if the strength needs it and it is not the mesh of the last point. */
static fracas_err derive(const fracas_campaign *campaign, size_t p, known_mesh *mesh,
                         fracas_derivation *of)
{
    const fracas_point *point = &campaign->point[p];
    const bool needed = fracas_strength_has_size_effect(&point->strength);
    if (needed && !(mesh->spec && is_same_mesh(mesh->spec, &point->spec))) {
        fracas_err err = fracas_mesh_interface_extent(&point->spec, &mesh->extent.volume,
                                                      &mesh->extent.area);
        if (err) return fracas_fail_within(err, "point %zu", p);
        mesh->spec = &point->spec;
    }
    *of = (fracas_derivation){point, mesh->extent,
                              fracas_strength_mean(&point->strength, mesh->extent)};
    return FRACAS_OK;
}

static fracas_value value_of(const source *from, const fracas_derivation *of, const char *name)
{
    fracas_value value = {.real = NAN, .text = ""};
    if (from->leaf) fracas_leaf_get(from->leaf, of->point, &value);
    else if (from->derived) value.real = from->derived->value(of);
    else value.text = name;
    return value;
}

fracas_err fracas_campaign_tabulate(const fracas_catalog *catalog, const char *const *name,
                                    fracas_campaign *campaign)
{
    bool named = false;
    for (size_t p = 0; p < campaign->npoints; p++) named = named || *name[p];
    source *from = fracas_memory_take(campaign->memory, catalog->nleaves + FRACAS_DERIVED + 1,
                                      sizeof *from);
    if (!from) return fracas_no_memory("the table of points");
    size_t ncolumns = list_sources(catalog, campaign, named, from);
    fracas_column *column = fracas_memory_take(campaign->memory, ncolumns, sizeof *column);
    fracas_point_row *row = fracas_memory_take(campaign->memory, campaign->npoints, sizeof *row);
    fracas_value *value = fracas_memory_take(campaign->memory, campaign->npoints * ncolumns,
                                             sizeof *value);
    if (!column || !row || !value) return fracas_no_memory("the table of points");
    for (size_t c = 0; c < ncolumns; c++) column[c] = from[c].column;
    known_mesh mesh = {0};
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_point *point = &campaign->point[p];
        fracas_derivation of;
        TRY(derive(campaign, p, &mesh, &of));
        for (size_t c = 0; c < ncolumns; c++)
            value[p * ncolumns + c] = value_of(&from[c], &of, name[p]);
        row[p] = (fracas_point_row){point->hash, point->replicas, value + p * ncolumns,
                                    point->rule.maximum};
    }
    campaign->table = (fracas_point_table){ncolumns, column, campaign->npoints, row};
    return FRACAS_OK;
}
