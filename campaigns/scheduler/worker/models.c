/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/models.h"

/* The slot of a point, else the least recently used one. */
static fracas_kept_model *find(fracas_models *models, size_t point)
{
    fracas_kept_model *oldest = models->slot;
    for (fracas_kept_model *slot = models->slot; slot < models->slot + FRACAS_MODELS_KEPT; slot++) {
        if (slot->realizer.model && slot->realizer.point == point) return slot;
        if (slot->used < oldest->used) oldest = slot;
    }
    return oldest;
}

fracas_err fracas_models_get(fracas_models *models, fracas_computation *computation)
{
    const size_t point = (size_t)computation->lease->point;
    fracas_kept_model *kept = find(models, point);
    if (!kept->realizer.model || kept->realizer.point != point) {
        fracas_realizer_clear(&kept->realizer);
        kept->used = 0;
        TRY(fracas_realizer_init(computation->campaign, point, &kept->realizer));
    }
    kept->used = ++models->clock;
    computation->realizer = &kept->realizer;
    return FRACAS_OK;
}

void fracas_models_clear(fracas_models *models)
{
    for (size_t i = 0; i < FRACAS_MODELS_KEPT; i++) {
        fracas_realizer_clear(&models->slot[i].realizer);
        models->slot[i].used = 0;
    }
}
