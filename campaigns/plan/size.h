/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows and bytes of a campaign's files before they are there. */
#ifndef FRACAS_CAMPAIGNS_PLAN_SIZE_H
#define FRACAS_CAMPAIGNS_PLAN_SIZE_H

#include "campaigns/plan/forecast.h"
#include "engine/engine.h"

/* Sets forecast->fragments and ->history, rows of a realization, without computing one: by a
 * scaling law, at most as many fragments as elements. */
void fracas_rows_expect(const fracas_campaign *campaign, const fracas_spec *spec,
                        fracas_forecast *forecast);

/* Sets them by computing the first replicas of point `p`, if that is a small part of *budget, which
 * it uses up; else by the earlier points of its model that were computed, as they compare to
 * Grady's size. */
FRACAS_MUST_USE fracas_err fracas_rows_try(const fracas_campaign *campaign, size_t p,
                                           const fracas_model *model, double *budget,
                                           fracas_forecast *forecast);

/* Bytes of a realization's rows. */
double fracas_realization_bytes(const fracas_campaign *campaign, const fracas_forecast *forecast);

/* Bytes of the campaign's text and files in study.h5; 0 without memory. */
double fracas_copy_bytes(const fracas_campaign *campaign);

typedef struct {
    double study;    /* study.h5 */
    double segments; /* all of them, written by `jobs` processes */
    double peak;     /* the study has while the merge writes study.h5 */
} fracas_sizes;

/* Files of the campaign: whole chunks, and what HDF5 needs for each dataset. With rules: of the
 * maximum, or the minimum with `least`. */
fracas_sizes fracas_campaign_sizes(const fracas_campaign *campaign, const fracas_forecast *forecast,
                                   int jobs, bool least);

#endif
