/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/realize.h"

#include "campaigns/plan/point_model.h"

fracas_err fracas_realizer_init(const fracas_campaign *campaign, size_t point,
                                fracas_realizer *realizer)
{
    *realizer = (fracas_realizer){.campaign = campaign, .point = point};
    fracas_err err = fracas_point_model_create(campaign, point, &realizer->model);
    if (!err)
        err = fracas_model_field(realizer->model, &campaign->point[point].strength,
                                 &realizer->field);
    if (err) fracas_realizer_clear(realizer);
    return err;
}

void fracas_realizer_clear(fracas_realizer *realizer)
{
    fracas_field_destroy(realizer->field);
    fracas_model_destroy(realizer->model);
    *realizer = (fracas_realizer){0};
}

fracas_batch_options fracas_campaign_batch(const fracas_campaign *campaign)
{
    return (fracas_batch_options){.history = campaign->output.history,
                                  .interfaces = campaign->output.interfaces,
                                  .reactions = campaign->output.reactions != NULL,
                                  .probes = &campaign->probes};
}

fracas_err fracas_realizer_sample(const fracas_realizer *realizer, int64_t replica, size_t stride,
                                  double *strength)
{
    const fracas_stream stream = fracas_point_stream(realizer->campaign, realizer->point,
                                                     FRACAS_PURPOSE_STRENGTH, (uint64_t)replica);
    return fracas_field_sample(realizer->field, &stream, stride, strength);
}

fracas_err fracas_realize(const fracas_realizer *realizer, const int64_t *replica, size_t count,
                          const double *strength, const fracas_batch_options *options,
                          fracas_record *record)
{
    const size_t n = fracas_model_strengths(realizer->model);
    OWN(fracas_batch) batch = NULL;
    TRY(fracas_batch_create(realizer->model, count, options, &batch));
    for (size_t lane = 0; lane < count; lane++) {
        size_t stride;
        double *of = fracas_batch_strength(batch, lane, &stride);
        if (strength)
            for (size_t k = 0; k < n; k++) of[k * stride] = strength[lane * n + k];
        else TRY(fracas_realizer_sample(realizer, replica[lane], stride, of));
    }
    return fracas_batch_run(batch, record);
}
