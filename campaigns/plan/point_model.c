#include "campaigns/plan/point_model.h"

#include "engine/mesh/make.h"

#include <stdlib.h>

void fracas_point_mesh_noise(const fracas_campaign *campaign, size_t point, size_t count, double *noise)
{
    fracas_stream stream = {.seed = campaign->seed, .purpose = FRACAS_PURPOSE_MESH};
    fracas_hash_words(&campaign->point[point].hash, stream.point);
    for (size_t i = 0; i < count; i++) noise[i] = 2.0 * fracas_stream_uniform(&stream, i) - 1.0;
}

fracas_err fracas_point_model_like(const fracas_campaign *campaign, size_t point, const fracas_spec *spec,
                                   fracas_model **model)
{
    fracas_spec drawn = *spec;
    double *noise = NULL;
    size_t count;
    TRY(fracas_mesh_noise_count(spec, &count));
    if (count > 0) {
        noise = malloc(count * sizeof *noise);
        if (!noise) return fracas_no_memory("the mesh of a point");
        fracas_point_mesh_noise(campaign, point, count, noise);
    }
    drawn.mesh.noise = noise;
    drawn.mesh.nnoise = count;
    fracas_err err = fracas_model_create(&drawn, model); /* which keeps no noise */
    free(noise);
    return err;
}

fracas_err fracas_point_model_create(const fracas_campaign *campaign, size_t point, fracas_model **model)
{
    return fracas_point_model_like(campaign, point, &campaign->point[point].spec, model);
}
