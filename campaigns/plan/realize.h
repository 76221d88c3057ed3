/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Realizations of a point, alone or side by side: in a run, in a replay, in libfracas. */
#ifndef FRACAS_CAMPAIGNS_PLAN_REALIZE_H
#define FRACAS_CAMPAIGNS_PLAN_REALIZE_H

#include "campaigns/campaign.h"
#include "engine/engine.h"

/* A point ready to be computed. All zero: none. */
typedef struct fracas_realizer {
    const fracas_campaign *campaign; /* must outlive it */
    size_t point;
    fracas_model *model; /* owned ... */
    fracas_field *field; /* ... with the field of its strengths */
} fracas_realizer;

/* Makes model and strength field of a point of the campaign. Errors as fracas_point_model_create
 * and fracas_field_create; *realizer is all zero then. */
FRACAS_MUST_USE fracas_err fracas_realizer_init(const fracas_campaign *campaign, size_t point,
                                                fracas_realizer *realizer);
void fracas_realizer_clear(fracas_realizer *realizer); /* all zero is allowed */

/* Options of a batch with the parts of a record as the campaign asks for them; all others are 0. */
fracas_batch_options fracas_campaign_batch(const fracas_campaign *campaign);

/* The draw of `replica`: strength k [Pa] is strength[k*stride]. */
FRACAS_MUST_USE fracas_err fracas_realizer_sample(const fracas_realizer *realizer, int64_t replica,
                                                  size_t stride, double *strength);

/* Computes `count` replicas (1 to 8, any from 0 on) side by side into record[0] ... record[count -
 * 1], which the caller has initialised and clears. A record depends on the campaign, its point and
 * replica alone. `strength` NULL draws the strengths of each replica; else strength[l*n + k] is
 * strength k of realization l, n = fracas_model_strengths. Errors as fracas_batch_create and
 * fracas_batch_run. */
FRACAS_MUST_USE fracas_err fracas_realize(const fracas_realizer *realizer, const int64_t *replica,
                                          size_t count, const double *strength,
                                          const fracas_batch_options *options,
                                          fracas_record *record);

#endif
