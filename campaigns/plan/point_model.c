/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/point_model.h"

#include "engine/mesh/make.h"
#include "sampler/field/grading.h"

#include <math.h>
#include <stdlib.h>

fracas_stream fracas_point_stream(const fracas_campaign *campaign, size_t point, uint64_t purpose,
                                  uint64_t replica)
{
    fracas_stream stream = {.seed = campaign->seed, .purpose = purpose, .replica = replica};
    if (!campaign->common_random_numbers)
        fracas_hash_words(&campaign->point[point].hash, stream.point);
    return stream;
}

void fracas_point_mesh_noise(const fracas_campaign *campaign, size_t point, size_t count,
                             double *noise)
{
    const fracas_stream stream = fracas_point_stream(campaign, point, FRACAS_PURPOSE_MESH, 0);
    for (size_t i = 0; i < count; i++) noise[i] = 2.0 * fracas_stream_uniform(&stream, i) - 1.0;
}

fracas_err fracas_point_model_like(const fracas_campaign *campaign, size_t point,
                                   const fracas_spec *spec, fracas_model **model)
{
    fracas_spec drawn = *spec;
    OWNED double *noise = NULL;
    size_t count;
    TRY(fracas_mesh_noise_count(spec, &count));
    if (count > 0) {
        noise = malloc(count * sizeof *noise);
        if (!noise) return fracas_no_memory("the mesh of a point");
        fracas_point_mesh_noise(campaign, point, count, noise);
    }
    drawn.mesh.noise = noise;
    drawn.mesh.nnoise = count;
    drawn.frequencies = campaign->frequencies;
    drawn.strength_per_point = fracas_strength_is_per_point(&campaign->point[point].strength);
    return fracas_model_create(&drawn, model);
}

fracas_err fracas_point_model_create(const fracas_campaign *campaign, size_t point,
                                     fracas_model **model)
{
    return fracas_point_model_like(campaign, point, &campaign->point[point].spec, model);
}

/* (grading.5) */
fracas_extent fracas_model_extent(const fracas_model *model, size_t interface)
{
    const double share = (double)fracas_model_strengths_per_interface(model);
    return (fracas_extent){fracas_model_interface_volume(model, interface) / share,
                           fracas_model_interface_area(model, interface) / share};
}

size_t fracas_model_strengths(const fracas_model *model)
{
    return fracas_model_interfaces(model) * fracas_model_strengths_per_interface(model);
}

fracas_err fracas_model_field(const fracas_model *model, const fracas_strength *strength,
                              fracas_field **field)
{
    const size_t n = fracas_model_interfaces(model);
    OWNED fracas_extent *extent = malloc(n * sizeof *extent);
    OWNED double(*position)[3] = malloc(fracas_model_strengths(model) * sizeof *position);
    if (n > 0 && (!extent || !position)) return fracas_no_memory("the interfaces of a mesh");
    for (size_t i = 0; i < n; i++) extent[i] = fracas_model_extent(model, i);
    fracas_model_interface_positions(model, position);
    const fracas_sites sites = {.n = n,
                                .points = fracas_model_strengths_per_interface(model),
                                .extent = extent,
                                .position = (const double(*)[3])position,
                                .period = fracas_model_period(model)};
    return fracas_field_create(strength, &sites, field);
}

fracas_err fracas_model_factors(const fracas_model *model, const fracas_strength *strength,
                                fracas_factor_range *range)
{
    const size_t n = fracas_model_strengths(model);
    *range = (fracas_factor_range){1, 1, 1};
    if (!strength->factor || n == 0) return FRACAS_OK;
    OWNED double(*position)[3] = malloc(n * sizeof *position);
    OWNED double *factor = NULL;
    if (!position) return fracas_no_memory("the interfaces of a mesh");
    fracas_model_interface_positions(model, position);
    TRY(fracas_grading_create(strength, n, (const double(*)[3])position, &factor));
    *range = (fracas_factor_range){.least = INFINITY};
    for (size_t k = 0; k < n; k++) {
        range->mean += factor[k];
        range->least = fmin(range->least, factor[k]);
        range->most = fmax(range->most, factor[k]);
    }
    range->mean /= (double)n;
    return FRACAS_OK;
}

fracas_extents fracas_extents_of(const fracas_model *model)
{
    const size_t count = fracas_model_interfaces(model);
    fracas_extents of = {.least = {INFINITY, INFINITY}};
    for (size_t i = 0; i < count; i++) {
        const fracas_extent one = fracas_model_extent(model, i);
        of.mean.volume += one.volume;
        of.mean.area += one.area;
        of.least = (fracas_extent){fmin(of.least.volume, one.volume),
                                   fmin(of.least.area, one.area)};
    }
    of.mean.volume /= (double)count;
    of.mean.area /= (double)count;
    return of;
}
