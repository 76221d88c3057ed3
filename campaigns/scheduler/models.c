#include "campaigns/scheduler/models.h"

#include "campaigns/plan/point_model.h"

fracas_err fracas_models_get(fracas_models *models, const fracas_campaign *campaign, size_t point,
                             const fracas_model **model)
{
    size_t oldest = 0;
    models->clock++;
    for (size_t i = 0; i < FRACAS_MODELS_KEPT; i++) {
        if (models->slot[i].model && models->slot[i].point == point) {
            models->slot[i].used = models->clock;
            *model = models->slot[i].model;
            return FRACAS_OK;
        }
        if (models->slot[i].used < models->slot[oldest].used) oldest = i;
    }
    fracas_model *created;
    TRY(fracas_point_model_create(campaign, point, &created));
    fracas_model_destroy(models->slot[oldest].model);
    models->slot[oldest].point = point;
    models->slot[oldest].model = created;
    models->slot[oldest].used = models->clock;
    *model = created;
    return FRACAS_OK;
}

void fracas_models_clear(fracas_models *models)
{
    for (size_t i = 0; i < FRACAS_MODELS_KEPT; i++) fracas_model_destroy(models->slot[i].model);
    *models = (fracas_models){0};
}
