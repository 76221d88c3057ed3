/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/models.h"

#include "campaigns/plan/point_model.h"

static void clear(fracas_models *models, size_t slot)
{
    fracas_field_destroy(models->slot[slot].field);
    fracas_model_destroy(models->slot[slot].model);
    models->slot[slot].field = NULL;
    models->slot[slot].model = NULL;
}

/* The slot of a point, else the least recently used one. */
static size_t find(const fracas_models *models, size_t point)
{
    size_t oldest = 0;
    for (size_t i = 0; i < FRACAS_MODELS_KEPT; i++) {
        if (models->slot[i].model && models->slot[i].point == point) return i;
        if (models->slot[i].used < models->slot[oldest].used) oldest = i;
    }
    return oldest;
}

static fracas_err fill(fracas_models *models, size_t slot, const fracas_campaign *campaign,
                       size_t point)
{
    clear(models, slot);
    models->slot[slot].point = point;
    TRY(fracas_point_model_create(campaign, point, &models->slot[slot].model));
    return fracas_model_field(models->slot[slot].model, &campaign->point[point].strength,
                              &models->slot[slot].field);
}

fracas_err fracas_models_get(fracas_models *models, const fracas_campaign *campaign, size_t point,
                             const fracas_model **model, const fracas_field **field)
{
    const size_t slot = find(models, point);
    if (!models->slot[slot].model || models->slot[slot].point != point) {
        fracas_err err = fill(models, slot, campaign, point);
        if (err) clear(models, slot);
        TRY(err);
    }
    models->slot[slot].used = ++models->clock;
    *model = models->slot[slot].model;
    *field = models->slot[slot].field;
    return FRACAS_OK;
}

void fracas_models_clear(fracas_models *models)
{
    for (size_t i = 0; i < FRACAS_MODELS_KEPT; i++) clear(models, i);
    *models = (fracas_models){0};
}
