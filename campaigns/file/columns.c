/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/identity.h"

#include "campaigns/file/extent.h"
#include "engine/cohesive/law.h"
#include "engine/mesh/body.h"

#include <stdlib.h>
#include <string.h>

/* ---- derived columns ---- */

/* Columns derived from the values of a point. No hash depends on them. A new one is one line of
 * the table, and its function. */

/* A point, the mean extent of its interfaces (0 where no strength needs it), the mean of its
 * strengths there and their standard deviation [Pa]. */
typedef struct {
    const fracas_point *point;
    fracas_extent extent;
    double strength, deviation;
} derivation;

typedef struct {
    fracas_column column;
    double (*value)(const derivation *of); /* NaN where the point has none */
    bool rare; /* a column where some point has it alone, from the spec */
} derived_column;

static double surface(const derivation *of)
{
    return fracas_spec_is_surface(&of->point->spec);
}

static double length(const derivation *of)
{
    return fracas_spec_length(&of->point->spec);
}

static double radius(const derivation *of)
{
    const fracas_spec *spec = &of->point->spec;
    return fracas_shape_of(spec)->round ? spec->geometry.radius : NAN;
}

/* Elements of equal length make every fragment a multiple of it. */
static double lattice(const derivation *of)
{
    const fracas_spec *spec = &of->point->spec;
    return fracas_spacing_of(spec)->uniform ? length(of) / (double)spec->mesh.elements : 0;
}

static double strain_rate(const derivation *of)
{
    return fracas_spec_strain_rate(&of->point->spec);
}

static double strength_deviation(const derivation *of)
{
    return of->deviation;
}

static double strength_mean(const derivation *of)
{
    return of->strength;
}

static double strength_modulus(const derivation *of)
{
    return fracas_strength_modulus(&of->point->strength, of->extent);
}

static double fracture_energy(const derivation *of)
{
    return fracas_spec_fracture_energy(&of->point->spec, of->strength);
}

static double open_ledger(const derivation *of)
{
    return fracas_law_of(&of->point->spec)->open_ledger ? 1 : NAN;
}

static const derived_column derived_columns[] = {
    {{"derived.fracture_energy", "J/m2",
      "fracture energy G_c of the interfaces, at their mean strength", false},
     fracture_energy},
    {{"derived.lattice", "m",
      "length of which every fragment size is a multiple; 0 if there is none", false},
     lattice},
    {{"derived.length", "m", "length of a bar, circumference of a ring; NaN for a surface", false},
     length},
    {{"derived.open_ledger", "1",
      "1 if the law gains or loses energy on mixed paths; no column where no point has such a law",
      false},
     open_ledger,
     true},
    {{"derived.radius", "m", "radius of a ring; NaN for other bodies", false}, radius},
    {{"derived.strain_rate", "1/s", "strain rate that the loading begins with", false},
     strain_rate},
    {{"derived.strength_deviation", "Pa", "standard deviation of the distribution of strengths",
      false},
     strength_deviation},
    {{"derived.strength_mean", "Pa", "mean of the distribution of strengths", false},
     strength_mean},
    {{"derived.strength_modulus", "1", "modulus M of the strengths in Mott's law; NaN without one",
      false},
     strength_modulus},
    {{"derived.surface", "1", "1 if the body is a surface, else 0", false}, surface},
};

void fracas_derived_reference(FILE *out)
{
    fputs("| dataset | unit | meaning |\n|---|---|---|\n", out);
    for (size_t d = 0; d < FRACAS_COUNT(derived_columns); d++) {
        const fracas_column *column = &derived_columns[d].column;
        fprintf(out, "| `/point/%s` | %s | %s |\n", column->path, column->unit, column->doc);
    }
}

/* ---- the table ---- */

/* Source of a column's values: a leaf, a derivation, or neither for the name of the case. */
typedef struct {
    fracas_column column;
    const fracas_leaf *leaf;
    const derived_column *derived;
} source;

static bool any_point_has(const fracas_campaign *campaign, const fracas_leaf *leaf)
{
    fracas_value value;
    for (size_t p = 0; p < campaign->npoints; p++)
        if (fracas_leaf_get(leaf, &campaign->point[p], &value)) return true;
    return false;
}

static bool is_listed(const fracas_campaign *campaign, const derived_column *derived)
{
    if (!derived->rare) return true;
    for (size_t p = 0; p < campaign->npoints; p++)
        if (!isnan(derived->value(&(derivation){.point = &campaign->point[p]}))) return true;
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
    for (size_t d = 0; d < FRACAS_COUNT(derived_columns); d++)
        if (is_listed(campaign, &derived_columns[d]))
            sources[count++] = (source){derived_columns[d].column, NULL, &derived_columns[d]};
    if (named) sources[count++] = (source){{"case", "", "name of the case", true}, NULL, NULL};
    qsort(sources, count, sizeof *sources, by_path);
    return count;
}

static fracas_err derive(const fracas_campaign *campaign, size_t p, fracas_known_extent *known,
                         derivation *of)
{
    const fracas_point *point = &campaign->point[p];
    fracas_err err = fracas_extent_find(point, known);
    if (err) return fracas_fail_within(err, "point %zu", p);
    *of = (derivation){point, known->extent, fracas_strength_mean(&point->strength, known->extent),
                       fracas_strength_deviation(&point->strength, known->extent)};
    return FRACAS_OK;
}

static fracas_value value_of(const source *from, const derivation *of, const char *name)
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
    source *from = fracas_memory_take(
        campaign->memory, catalog->nleaves + FRACAS_COUNT(derived_columns) + 1, sizeof *from);
    if (!from) return fracas_no_memory("the table of points");
    size_t ncolumns = list_sources(catalog, campaign, named, from);
    fracas_column *column = fracas_memory_take(campaign->memory, ncolumns, sizeof *column);
    fracas_point_row *row = fracas_memory_take(campaign->memory, campaign->npoints, sizeof *row);
    fracas_value *value = fracas_memory_take(campaign->memory, campaign->npoints * ncolumns,
                                             sizeof *value);
    if (!column || !row || !value) return fracas_no_memory("the table of points");
    for (size_t c = 0; c < ncolumns; c++) column[c] = from[c].column;
    fracas_known_extent known = {0};
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_point *point = &campaign->point[p];
        derivation of;
        TRY(derive(campaign, p, &known, &of));
        for (size_t c = 0; c < ncolumns; c++)
            value[p * ncolumns + c] = value_of(&from[c], &of, name[p]);
        row[p] = (fracas_point_row){point->hash, point->replicas, value + p * ncolumns,
                                    point->rule.maximum};
    }
    campaign->table = (fracas_point_table){ncolumns, column, campaign->npoints, row};
    return FRACAS_OK;
}
