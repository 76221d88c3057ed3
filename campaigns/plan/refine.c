/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/refine.h"

#include "base/units.h"
#include "campaigns/file/catalog.h"
#include "campaigns/file/identity.h"
#include "campaigns/plan/plan.h"

#include <stdlib.h>
#include <string.h>

const char *const fracas_refinement_name[FRACAS_NREFINEMENTS] = {"base", "mesh", "step", "beta",
                                                                 "end"};
const char *const fracas_refinement_doc[FRACAS_NREFINEMENTS] = {
    "as it is",       "half the element size", "half the time step", "interfaces twice as stiff",
    "twice the time",
};

/* Every value of a point except 0, which means "not given" for mesh.size and mesh.divisions. */
static const struct {
    fracas_refinement by;
    const char *path;
    double factor;
} values[] = {
    {FRACAS_REFINE_MESH, "mesh.elements", 2},  {FRACAS_REFINE_MESH, "mesh.size", 0.5},
    {FRACAS_REFINE_MESH, "mesh.divisions", 2}, {FRACAS_REFINE_STEP, "time.safety", 0.5},
    {FRACAS_REFINE_BETA, "cohesive.beta", 2},  {FRACAS_REFINE_BETA, "cohesive.beta_shear", 2},
    {FRACAS_REFINE_END, "time.end", 2},        {FRACAS_REFINE_END, "time.transits", 2},
    {FRACAS_REFINE_END, "time.quiet", 2},      {FRACAS_REFINE_END, "time.multiple", 2},
};

/* A finer mesh has other interfaces: with the same seed some would share numbers without meaning.
 */
static const uint64_t mesh_seed = 0x6d657368; /* "mesh" */

/* The parameter of a leaf at a point. */
static const fracas_param *param_of(const fracas_leaf *leaf, const fracas_point *point)
{
    const fracas_file_section *section = leaf->section;
    return fracas_section_param(section->table, fracas_section_kind(section, point),
                                point->spec.formulation, leaf->key);
}

/* Refines one value; *done if the point has it. FRACAS_USAGE if the result is out of range. */
static fracas_err refine_value(const fracas_leaf *leaf, double factor, fracas_point *point,
                               bool *done)
{
    fracas_value value;
    if (!fracas_leaf_get(leaf, point, &value) || value.real == 0) return FRACAS_OK;
    const fracas_param *param = param_of(leaf, point);
    const double fine = fracas_number_round(factor * value.real);
    if (fine < param->minimum || fine > param->maximum)
        return fracas_fail(FRACAS_USAGE, "%s is %g already, and its range ends at %g", leaf->path,
                           value.real, factor < 1 ? param->minimum : param->maximum);
    fracas_param_set(param, fracas_section_at(leaf->section, point), fine);
    *done = true;
    return FRACAS_OK;
}

static fracas_err refine_point(const fracas_catalog *catalog, fracas_refinement what,
                               fracas_point *point)
{
    bool done = what == FRACAS_REFINE_NOTHING;
    for (size_t v = 0; v < FRACAS_COUNT(values); v++)
        if (values[v].by == what)
            TRY(refine_value(fracas_catalog_leaf(catalog, values[v].path), values[v].factor, point,
                             &done));
    if (done) return FRACAS_OK;
    if (what == FRACAS_REFINE_MESH)
        return fracas_fail(
            FRACAS_USAGE,
            "its mesh is from a file: give the campaign one with half the element size");
    return fracas_fail(FRACAS_USAGE, "its interfaces have no cohesive.beta");
}

/* Refines point p as the next point of the new campaign, or leaves it out, the first one with the
 * reason. */
static fracas_err take_point(const fracas_catalog *catalog, fracas_refinement what, size_t p,
                             size_t *next, fracas_refined *refined)
{
    fracas_campaign *campaign = refined->campaign;
    fracas_point *point = &campaign->point[p];
    double cost = 0;
    fracas_err err = refine_point(catalog, what, point);
    if (err) err = fracas_fail_within(err, "point %zu", p);
    if (!err) err = fracas_point_identify(catalog, point);
    if (!err) err = fracas_plan_cost(campaign, p, &cost, NULL);
    if (err && (err != FRACAS_USAGE || what == FRACAS_REFINE_NOTHING)) return err;
    if (err) {
        if (refined->left++ == 0)
            snprintf(refined->why, sizeof refined->why, "%s", fracas_message());
        return FRACAS_OK;
    }
    refined->from[*next] = p;
    refined->cost[*next] = cost * (double)fracas_point_most(point);
    campaign->point[(*next)++] = *point;
    return FRACAS_OK;
}

static fracas_err refine_points(const fracas_catalog *catalog, fracas_refinement what,
                                fracas_refined *refined)
{
    fracas_campaign *campaign = refined->campaign;
    const fracas_point_table before = campaign->table;
    const size_t npoints = campaign->npoints, named = fracas_point_table_find(&before, "case");
    const char **name = fracas_memory_take(campaign->memory, npoints, sizeof *name);
    refined->from = calloc(npoints, sizeof *refined->from);
    refined->cost = calloc(npoints, sizeof *refined->cost);
    if (!name || !refined->from || !refined->cost) return fracas_no_memory("the refined campaign");
    size_t left = 0;
    for (size_t p = 0; p < npoints; p++) TRY(take_point(catalog, what, p, &left, refined));
    campaign->npoints = left;
    for (size_t p = 0; p < campaign->npoints; p++)
        name[p] = named == SIZE_MAX ? "" : before.point[refined->from[p]].value[named].text;
    if (campaign->npoints == 0) {
        fracas_campaign_destroy(campaign);
        refined->campaign = NULL;
        return FRACAS_OK;
    }
    TRY(fracas_campaign_tabulate(catalog, name, campaign));
    return fracas_campaign_identify(catalog, campaign);
}

/* A name has at most 100 letters. */
static fracas_err rename_campaign(fracas_refinement what, fracas_campaign *campaign)
{
    enum { MOST = 100 };
    char *name = fracas_memory_take(campaign->memory, MOST + 1, 1);
    if (!name) return fracas_no_memory("the campaign's name");
    snprintf(name, MOST + 1, "%.*s-%s", MOST - 1 - (int)strlen(fracas_refinement_name[what]),
             campaign->name, fracas_refinement_name[what]);
    campaign->name = name;
    return FRACAS_OK;
}

fracas_err fracas_refined_create(const char *path, int64_t replicas, fracas_refinement what,
                                 fracas_refined *refined)
{
    const fracas_catalog *catalog;
    *refined = (fracas_refined){0};
    TRY(fracas_campaign_read(path, &refined->campaign));
    fracas_campaign *campaign = refined->campaign;
    if (replicas > 0) TRY(fracas_campaign_replicas(campaign, replicas));
    TRY(fracas_catalog_make(campaign->memory, &catalog));
    TRY(rename_campaign(what, campaign));
    campaign->common_random_numbers = true;
    if (what == FRACAS_REFINE_MESH) campaign->seed ^= mesh_seed;
    fracas_err err = refine_points(catalog, what, refined);
    return err ? fracas_fail_within(err, "%s", path) : FRACAS_OK;
}

void fracas_refined_clear(fracas_refined *refined)
{
    fracas_campaign_destroy(refined->campaign);
    free(refined->from);
    free(refined->cost);
    *refined = (fracas_refined){0};
}
