/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/costs.h"

#include "campaigns/plan/plan.h"
#include "campaigns/plan/point_model.h"

#include <stdlib.h>

/* Checks the options, the same for all points, by one batch. */
static fracas_err try_batch(const fracas_campaign *campaign, const fracas_run_options *options)
{
    fracas_model *model;
    TRY(fracas_point_model_create(campaign, 0, &model));
    fracas_batch_options batch_options = {.width = options->width, .isa = options->isa};
    fracas_batch *batch;
    fracas_err err = fracas_batch_create(model, 1, &batch_options, &batch);
    if (!err) fracas_batch_destroy(batch);
    fracas_model_destroy(model);
    return err;
}

fracas_err fracas_costs_create(const fracas_campaign *campaign, const fracas_run_options *options,
                               double **cost, double **bytes)
{
    double *c = malloc((campaign->npoints + 1) * sizeof *c),
           *b = malloc((campaign->npoints + 1) * sizeof *b);
    fracas_err err = c && b ? FRACAS_OK : fracas_no_memory("the plan");
    if (!err && campaign->npoints) err = try_batch(campaign, options);
    for (size_t i = 0; !err && i < campaign->npoints; i++)
        err = fracas_plan_cost(campaign, i, &c[i], &b[i]);
    if (err || !bytes) free(b);
    else *bytes = b;
    if (err) free(c);
    else *cost = c;
    return err;
}
