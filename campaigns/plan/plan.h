/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Predicted cost of a campaign. */
#ifndef FRACAS_CAMPAIGNS_PLAN_PLAN_H
#define FRACAS_CAMPAIGNS_PLAN_PLAN_H

#include "campaigns/campaign.h"
#include "engine/engine.h"

#include <stdio.h>

/* cost = elements x steps to time.end of one realization of a point; *bytes (NULL: not wanted):
 * size of its rows as below. FRACAS_USAGE, naming the point, for conflicting parameters;
 * FRACAS_ENVIRONMENT without memory. Builds the model (about 1 us an element). */
FRACAS_MUST_USE fracas_err fracas_plan_cost(const fracas_campaign *campaign, size_t point,
                                            double *cost, double *bytes);
/* Words of a run on its points, before it begins. */
typedef struct {
    FILE *out;       /* gets the first FRACAS_RUN_WARNINGS of the plan's warnings, ... */
    int columns;     /* ... in lines of so many; 0: a line each */
    size_t unbroken; /* points whose interfaces crack and never break, counted */
    char first[440]; /* "point P: ..." of the first of these */
} fracas_plan_words;
/* Writes "fracas: warning: ..." to `out`. */
void fracas_plan_words_say(const fracas_plan_words *words, const char *text);
/* fracas_plan_cost with the point's model. words: adds to them; NULL: says nothing. */
FRACAS_MUST_USE fracas_err fracas_plan_cost_with(const fracas_campaign *campaign, size_t point,
                                                 const fracas_model *model,
                                                 fracas_plan_words *words, double *cost,
                                                 double *bytes);

/* Fields that the run writes at its end. */
typedef struct {
    size_t realizations;
    double bytes; /* until time.end */
} fracas_planned_fields;

typedef struct {
    int jobs;    /* processes of the run; 0: 1 */
    int columns; /* the terminal's; 0: as wide as the table is */
    bool quick, json;
    bool points; /* print every point, however many there are */
    fracas_planned_fields fields;
} fracas_plan_options;

/* Prints, for each point, its varied parameters, replicas, elements, time step, steps, predicted
 * time and size, and the totals; of more than FRACAS_PLAN_LISTED points the least and most of each;
 * as JSON with `json`.
 *   replicas  with a rule, minimum and maximum; so for time and size (as JSON: of the maximum)
 *   time      elements x steps x replicas / (speed x jobs), an upper bound, since a stop rule may
 *             end a realization before time.end
 *   speed     element-steps per second of one free core, timed on a short batch of the point's size
 *   size      bytes of the point's rows in study.h5; in total of the files (campaigns/plan/size.h).
 *             Fragments are counted in realizations computed now, where that takes little
 *   memory    model + lanes x a lane's state, of the largest point, from 100 MB on
 * With `quick` large surfaces are estimated (fracas_forecast_all), without warnings, and it says
 * so. Errors as fracas_plan_cost, and FRACAS_ENVIRONMENT when `out` cannot be written. */
FRACAS_MUST_USE fracas_err fracas_plan_print(const fracas_campaign *campaign,
                                             const fracas_plan_options *options, FILE *out);

enum { FRACAS_PLAN_LISTED = 100 };

enum { FRACAS_SIZE_TEXT = 28 };
/* "12.3 MB" */
const char *fracas_size_write(double bytes, char text[FRACAS_SIZE_TEXT]);

#endif
