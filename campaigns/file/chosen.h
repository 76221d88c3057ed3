/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `fields:` of a campaign file: realizations whose fields a run writes at its end. */
#ifndef FRACAS_CAMPAIGNS_FILE_CHOSEN_H
#define FRACAS_CAMPAIGNS_FILE_CHOSEN_H

#include "campaigns/campaign.h"
#include "campaigns/file/file.h"

extern const fracas_section fracas_fields_section;

/* A realization of a point that did not FAIL. */
typedef struct {
    int64_t replica;
    double value; /* the number by which they are ordered; NaN: it has none */
} fracas_candidate;

/* The number of a realization by which `wanted` orders them; fragments where it says nothing. The
 * record has its fragments. */
double fracas_fields_number(const fracas_wanted_fields *wanted, const fracas_record *record);

bool fracas_fields_wanted(const fracas_wanted_fields *wanted);

/* The replicas wanted of a point's n candidates, each once; returns how many.
 * chosen: room for n. The candidates come by their replicas, and change their order. */
size_t fracas_fields_choose(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                            size_t n, int64_t *chosen);

/* FRACAS_USAGE, with its place, if `every` makes too many instants or belongs to no realization, or
 * a listed replica to no point. */
FRACAS_MUST_USE fracas_err fracas_fields_check(const fracas_file *file,
                                               const fracas_campaign *campaign);

#endif
