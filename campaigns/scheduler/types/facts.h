/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Facts of a run. The process that the user starts finds them once; ranks that it forks inherit
 * them, and those that mpirun starts find them again. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_FACTS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_FACTS_H

#include "campaigns/campaign.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
    fracas_campaign *campaign; /* owned; NULL: not read yet */
    char study[4096];          /* folder of the study */
    double *cost;              /* owned; fracas_costs_create; NULL: not known yet */
    bool ran;                  /* false: the study was complete before */
} fracas_run_facts;

typedef struct {
    char text[sizeof(fracas_hash_text) + 4096];
} fracas_run_name;

/* "HASH FOLDER" of campaign and study. */
static inline fracas_run_name fracas_run_name_of(const fracas_run_facts *facts)
{
    fracas_run_name name;
    snprintf(name.text, sizeof name.text, "%s %s", fracas_hash_hex(&facts->campaign->hash).text,
             facts->study);
    return name;
}

static inline void fracas_run_facts_clear(fracas_run_facts *facts)
{
    fracas_campaign_destroy(facts->campaign);
    free(facts->cost);
    *facts = (fracas_run_facts){0};
}

#endif
