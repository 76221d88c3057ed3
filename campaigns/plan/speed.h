/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of a point's realizations, measured. */
#ifndef FRACAS_CAMPAIGNS_PLAN_SPEED_H
#define FRACAS_CAMPAIGNS_PLAN_SPEED_H

#include "campaigns/plan/forecast.h"
#include "engine/engine.h"

/* Processor time of this process [s], as on a free core. */
double fracas_processor_time(void);

/* Element-steps per second of one core, into forecast->speed: times batches of the point until the
 * clock has seen enough, at most 50. A surface is weak, and all its interfaces crack at once:
 * broken ones take twice the time of whole ones. `forecast` has the strength. */
FRACAS_MUST_USE fracas_err fracas_speed_measure(const fracas_campaign *campaign, size_t index,
                                                const fracas_model *model,
                                                fracas_forecast *forecast);

/* Speed of an earlier similar point with the same lanes and half to twice the elements; 0: none. */
double fracas_speed_of_similar(const fracas_campaign *campaign, const fracas_forecast *forecast,
                               size_t point);

#endif
