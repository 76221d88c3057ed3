/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/models.h"

#include "campaigns/plan/point_model.h"

static void clear(fracas_kept_model *kept)
{
    fracas_field_destroy(kept->field);
    fracas_model_destroy(kept->model);
    *kept = (fracas_kept_model){0};
}

/* The slot of a point, else the least recently used one. */
static fracas_kept_model *find(fracas_models *models, size_t point)
{
    fracas_kept_model *oldest = models->slot;
    for (fracas_kept_model *slot = models->slot; slot < models->slot + FRACAS_MODELS_KEPT; slot++) {
        if (slot->model && slot->point == point) return slot;
        if (slot->used < oldest->used) oldest = slot;
    }
    return oldest;
}

static fracas_err fill(const fracas_campaign *campaign, size_t point, fracas_kept_model *kept)
{
    clear(kept);
    kept->point = point;
    TRY(fracas_point_model_create(campaign, point, &kept->model));
    return fracas_model_field(kept->model, &campaign->point[point].strength, &kept->field);
}

fracas_err fracas_models_get(fracas_models *models, fracas_computation *computation)
{
    const size_t point = (size_t)computation->lease->point;
    fracas_kept_model *kept = find(models, point);
    if (!kept->model || kept->point != point) {
        fracas_err err = fill(computation->campaign, point, kept);
        if (err) clear(kept);
        TRY(err);
    }
    kept->used = ++models->clock;
    computation->model = kept->model;
    computation->field = kept->field;
    return FRACAS_OK;
}

void fracas_models_clear(fracas_models *models)
{
    for (size_t i = 0; i < FRACAS_MODELS_KEPT; i++) clear(&models->slot[i]);
}
