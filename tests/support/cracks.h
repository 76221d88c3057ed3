/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRACAS_TESTS_SUPPORT_CRACKS_H
#define FRACAS_TESTS_SUPPORT_CRACKS_H

#include "engine/solver/batch.h"
#include "tests/support/test.h"

/* Runs one realization in which every interface has this strength; true if any cracks. */
static inline bool cracks(const fracas_model *model, double strength)
{
    OWN(fracas_batch) batch;
    FRACAS_CLEARED(fracas_record) record;
    const fracas_batch_options options = {.isa = FRACAS_ISA_BEST};
    OK(fracas_batch_create(model, 1, &options, &batch));
    size_t stride;
    double *sigma_c = fracas_batch_strength(batch, 0, &stride);
    for (size_t i = 0; i < fracas_model_interfaces(model); i++) sigma_c[i * stride] = strength;
    fracas_record_init(&record);
    OK(fracas_batch_run(batch, &record));
    return record.cracked > 0;
}

#endif
