/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/size.h"

#include "base/elementary.h"
#include "campaigns/plan/point_model.h"
#include "campaigns/plan/realize.h"
#include "campaigns/store/file/schema.h"
#include "engine/mesh/body.h"
#include "engine/solver/batch.h"

#include <math.h>

/* ---- rows of a realization ---- */

/* Size of fragments of equal strengths [m]  (scaling-laws.6). Where strengths scatter by 5 % or
 * more, pieces are 1/0.72 as long: so are those of bars and rings with Weibull strengths, and of
 * spheres, whose counts are the squares (docs/results). NaN without a strain rate. */
static double piece_size(const fracas_spec *spec, const fracas_forecast *forecast)
{
    const double E = spec->material.young, sigma = forecast->mean;
    const double energy = fracas_spec_fracture_energy(spec, sigma);
    const double wave = sqrt(E / spec->material.density);
    const double r = fabs(fracas_spec_strain_rate(spec)) * E * E * energy /
                     (wave * sigma * sigma * sigma);
    const double equal = 4.5 * E * energy / (sigma * sigma) / (1 + 4.5 * fracas_pow(r, 2.0 / 3));
    return equal / (1 - 0.28 * fmin(1, forecast->scatter / 0.05));
}

/* Length or area of all elements by the size of a piece. */
static double law(const fracas_spec *spec, const fracas_forecast *forecast)
{
    static const double of_edge = 0.42; /* area of a triangle by the square of its mean edge */
    const double each = forecast->element / piece_size(spec, forecast);
    return (double)forecast->elements *
           (fracas_spec_is_surface(spec) ? of_edge * each * each : each);
}

static double between(double fragments, const fracas_forecast *forecast)
{
    return fmax(1, fmin(fragments, (double)forecast->elements));
}

void fracas_rows_expect(const fracas_campaign *campaign, const fracas_spec *spec,
                        fracas_forecast *forecast)
{
    enum { FOR_EACH = 20 }; /* elements, where no law says anything */
    const double fragments = law(spec, forecast);
    forecast->fragments = between(
        isfinite(fragments) ? fragments : (double)forecast->elements / FOR_EACH, forecast);
    forecast->history = (double)campaign->output.history + 3; /* start, first onset, end */
}

/* Computes `count` replicas for their rows; their steps are added to *steps. */
static fracas_err compute(const fracas_campaign *campaign, size_t p, const fracas_model *model,
                          size_t count, int64_t *steps, fracas_forecast *forecast)
{
    static const int64_t replica[FRACAS_LANES_MAX] = {0, 1, 2, 3, 4, 5, 6, 7};
    const fracas_batch_options options = fracas_campaign_batch(campaign);
    OWN(fracas_field) field = NULL;
    fracas_record record[FRACAS_LANES_MAX];
    TRY(fracas_model_field(model, &campaign->point[p].strength, &field));
    const fracas_realizer realizer = {campaign, p, (fracas_model *)model, field};
    for (size_t l = 0; l < count; l++) fracas_record_init(&record[l]);
    const fracas_err err = fracas_realize(&realizer, replica, count, NULL, &options, record);
    double fragments = 0, history = 0;
    for (size_t l = 0; l < count; l++) {
        fragments += (double)record[l].nfragment / (double)count;
        history += (double)record[l].nhistory / (double)count;
        *steps += record[l].steps;
        forecast->intact += record[l].outcome == FRACAS_INTACT;
        forecast->lost += record[l].outcome == FRACAS_ENERGY_DRIFT ||
                          record[l].outcome == FRACAS_NONFINITE;
        fracas_record_clear(&record[l]);
    }
    if (err) return err;
    forecast->ratio = fragments / forecast->fragments;
    forecast->fragments = between(fragments, forecast);
    forecast->history = history;
    forecast->tried = (int)count;
    return FRACAS_OK;
}

fracas_err fracas_rows_try(const fracas_campaign *campaign, size_t p, const fracas_model *model,
                           double *budget, fracas_forecast *forecast)
{
    enum {
        PARTS = 4,  /* a point takes at most this part of the whole budget */
        SURFACE = 4 /* times as long as a chain's takes a surface's step for each byte */
    };
    const fracas_spec *spec = &campaign->point[p].spec;
    fracas_forecast *here = &forecast[p];
    const size_t count = fracas_forecast_lanes(&campaign->point[p]);
    const double step = fracas_model_lane_bytes(model) *
                        (fracas_spec_is_surface(spec) ? SURFACE : 1);
    const double most = step * (double)here->steps * (double)count;
    if (!here->estimated && most <= fmin(FRACAS_ROWS_BUDGET / PARTS, *budget)) {
        int64_t steps = 0;
        const fracas_err err = compute(campaign, p, model, count, &steps, here);
        *budget -= step * (double)steps;
        return err;
    }
    for (size_t q = p; q-- > 0;) {
        const fracas_spec *there = &campaign->point[q].spec;
        if (there->formulation != spec->formulation || !(forecast[q].ratio > 0)) continue;
        here->ratio = forecast[q].ratio;
        here->fragments = between(here->ratio * here->fragments, here);
        break;
    }
    return FRACAS_OK;
}

/* ---- bytes ---- */

/* Rows of reactions for each of the history: the edges that most bodies have. */
static double reactions_of(const fracas_campaign *campaign)
{
    return campaign->output.reactions ? 2 : 0;
}

double fracas_realization_bytes(const fracas_campaign *campaign, const fracas_forecast *forecast)
{
    const double interfaces = campaign->output.interfaces ? (double)forecast->interfaces : 0;
    return fracas_row_bytes(FRACAS_SET_REALIZATION) +
           forecast->fragments * fracas_row_bytes(FRACAS_SET_FRAGMENT) +
           forecast->history *
               (fracas_row_bytes(FRACAS_SET_HISTORY) +
                (double)campaign->probes.count * fracas_row_bytes(FRACAS_SET_PROBE) +
                reactions_of(campaign) * fracas_row_bytes(FRACAS_SET_REACTION)) +
           interfaces * fracas_row_bytes(FRACAS_SET_INTERFACE);
}

static double replicas_of(const fracas_point *point, bool least)
{
    return (double)(least ? point->replicas : fracas_point_most(point));
}

/* Rows of the realizations, the n-th part of them. */
static void count_rows(const fracas_campaign *campaign, const fracas_forecast *forecast, bool least,
                       double n, double rows[FRACAS_NSETS])
{
    for (int s = 0; s < FRACAS_NSETS; s++) rows[s] = 0;
    for (size_t p = 0; p < campaign->npoints; p++) {
        const double count = replicas_of(&campaign->point[p], least) / n;
        rows[FRACAS_SET_REALIZATION] += count;
        rows[FRACAS_SET_FRAGMENT] += count * forecast[p].fragments;
        rows[FRACAS_SET_HISTORY] += count * forecast[p].history;
        rows[FRACAS_SET_PROBE] += count * forecast[p].history * (double)campaign->probes.count;
        rows[FRACAS_SET_REACTION] += count * forecast[p].history * reactions_of(campaign);
        if (campaign->output.interfaces)
            rows[FRACAS_SET_INTERFACE] += count * (double)forecast[p].interfaces;
    }
    rows[FRACAS_SET_FRAGMENT_OFFSET] = rows[FRACAS_SET_HISTORY_OFFSET] =
        rows[FRACAS_SET_REALIZATION] + 1;
    if (campaign->output.interfaces)
        rows[FRACAS_SET_INTERFACE_OFFSET] = rows[FRACAS_SET_REALIZATION] + 1;
    if (campaign->output.reactions)
        rows[FRACAS_SET_REACTION_OFFSET] = rows[FRACAS_SET_REALIZATION] + 1;
    if (campaign->probes.count > 0)
        rows[FRACAS_SET_PROBE_OFFSET] = rows[FRACAS_SET_REALIZATION] + 1;
}

/* Meshes of the surfaces, by their numbers of faces and interfaces alone: a triangle has three
 * edges, and V = E - F + 1 vertices. */
static void count_meshes(const fracas_campaign *campaign, const fracas_forecast *forecast,
                         double rows[FRACAS_NSETS])
{
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_spec *spec = &campaign->point[p].spec;
        if (!campaign->output.interfaces || !fracas_spec_is_surface(spec)) continue;
        const double elements = (double)forecast[p].elements,
                     interfaces = (double)forecast[p].interfaces;
        const double borders = 3 * elements - 2 * interfaces, edges = borders + interfaces;
        rows[FRACAS_SET_MESH_ELEMENT] += elements;
        rows[FRACAS_SET_MESH_INTERFACE] += interfaces;
        rows[FRACAS_SET_MESH_BORDER] += borders;
        rows[FRACAS_SET_MESH_NODE] += 2 * edges - elements + 1;
    }
    if (rows[FRACAS_SET_MESH_ELEMENT] > 0)
        for (int s = FRACAS_SET_MESH_NODE_OFFSET; s < FRACAS_NSETS; s += 2)
            rows[s] = (double)campaign->npoints + 1;
}

/* Segments that `jobs` processes write: one at each age, not more often than a batch ends, and at
 * each size; at least one each, and none without a realization. */
static double count_segments(const fracas_campaign *campaign, const fracas_forecast *forecast,
                             int jobs, bool least, double bytes)
{
    double time = 0, batches = 0, realizations = 0;
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_point *point = &campaign->point[p];
        const double replicas = replicas_of(point, least);
        time += forecast[p].time * replicas / replicas_of(point, false);
        realizations += replicas;
        batches += ceil(replicas / (double)fracas_forecast_lanes(point));
    }
    const double by_age = jobs * ceil(time / FRACAS_SEGMENT_AGE),
                 by_size = bytes / FRACAS_SEGMENT_BYTES;
    return fmin(realizations, fmax(jobs, fmax(fmin(batches, by_age), by_size)));
}

double fracas_copy_bytes(const fracas_campaign *campaign)
{
    FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
    if (fracas_campaign_copy_make(campaign, &copy)) return 0;
    double bytes = (double)copy.size;
    for (size_t i = 0; i < copy.nfiles; i++) bytes += (double)copy.file[i].size;
    return bytes;
}

fracas_sizes fracas_campaign_sizes(const fracas_campaign *campaign, const fracas_forecast *forecast,
                                   int jobs, bool least)
{
    double rows[FRACAS_NSETS];
    count_rows(campaign, forecast, least, 1, rows);
    const double whole = fracas_file_bytes(rows, &campaign->table);
    const double segments = count_segments(campaign, forecast, jobs, least, whole);
    count_meshes(campaign, forecast, rows);
    fracas_sizes sizes = {.study = fracas_file_bytes(rows, &campaign->table) +
                                   fracas_copy_bytes(campaign)};
    count_rows(campaign, forecast, least, segments, rows);
    sizes.segments = segments * fracas_file_bytes(rows, &campaign->table);
    sizes.peak = sizes.study + sizes.segments;
    return sizes;
}
