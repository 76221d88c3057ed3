/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a campaign will compute, before it does. */
#ifndef FRACAS_CAMPAIGNS_PLAN_PLAN_H
#define FRACAS_CAMPAIGNS_PLAN_PLAN_H

#include "campaigns/campaign.h"

#include <stdio.h>

/* Relative cost of one realization of a point: elements times steps to time.end; *bytes (NULL: not
 * wanted): size of its rows as below. FRACAS_USAGE, naming the point, if its parameters do not go
 * together; FRACAS_ENVIRONMENT without memory. Builds the model (about 1 us an element). */
FRACAS_MUST_USE fracas_err fracas_plan_cost(const fracas_campaign *campaign, size_t point,
                                            double *cost, double *bytes);

/* Prints, for each point, its varied parameters, replicas, elements, time step, steps, predicted
 * time and size, and the totals; as JSON with `json`. `jobs`: processes that will compute, 0 for
 * one a core. replicas: where a rule decides them, the least and the most, and so time and size (as
 * JSON those of the most); time = elements * steps * replicas / (speed * jobs), at most, as a stop
 * rule may end a realization before time.end; speed: element-steps per second of one free core,
 * timed here on a short batch of the point's size; size: bytes of the rows of study.h5, with one
 * fragment for every FRACAS_PLAN_ELEMENTS_PER_FRAGMENT elements. Errors as fracas_plan_cost, and
 * FRACAS_ENVIRONMENT when `out` cannot be written. */
FRACAS_MUST_USE fracas_err fracas_plan_print(const fracas_campaign *campaign, int jobs, FILE *out,
                                             bool json);

#define FRACAS_PLAN_ELEMENTS_PER_FRAGMENT 20

#endif
