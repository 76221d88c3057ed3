/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/costs.h"

#include "campaigns/plan/plan.h"
#include "campaigns/plan/point_model.h"

#include <stdlib.h>

/* Checks the options, the same for all points, by one batch. */
static fracas_err try_batch(const fracas_campaign *campaign, const fracas_run_options *options)
{
    OWN(fracas_model) model = NULL;
    OWN(fracas_batch) batch = NULL;
    fracas_batch_options batch_options = {.width = options->width, .isa = options->isa};
    TRY(fracas_point_model_create(campaign, 0, &model));
    return fracas_batch_create(model, 1, &batch_options, &batch);
}

fracas_err fracas_costs_create(const fracas_campaign *campaign, const fracas_run_options *options,
                               double **cost, double **bytes)
{
    OWNED double *c = malloc((campaign->npoints + 1) * sizeof *c);
    OWNED double *b = malloc((campaign->npoints + 1) * sizeof *b);
    if (!c || !b) return fracas_no_memory("the plan");
    if (campaign->npoints) TRY(try_batch(campaign, options));
    for (size_t i = 0; i < campaign->npoints; i++) TRY(fracas_plan_cost(campaign, i, &c[i], &b[i]));
    *cost = c;
    c = NULL;
    if (!bytes) return FRACAS_OK;
    *bytes = b;
    b = NULL;
    return FRACAS_OK;
}
