/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One realization of a shell that never cracks, step by step. */
#ifndef FRACAS_TESTS_SUPPORT_SHELL_RUN_H
#define FRACAS_TESTS_SUPPORT_SHELL_RUN_H

#include "tests/support/shell.h"

typedef struct {
    fracas_model *model;
    fracas_batch *batch;
    fracas_record record;
    size_t running;
} shell_run;

/* Before its first step, in a batch of this width, all strengths as given [Pa]; the model goes with
 * the run. */
static inline shell_run shell_begin(fracas_model *model, int width, double strength_value)
{
    shell_run run = {.model = model, .running = 1};
    const fracas_batch_options options = {.width = width, .isa = FRACAS_ISA_BEST};
    size_t stride;
    OK(fracas_batch_create(model, 1, &options, &run.batch));
    double *strength = fracas_batch_strength(run.batch, 0, &stride);
    for (size_t i = 0; i < model->interfaces; i++) strength[i * stride] = strength_value;
    OK(fracas_batch_begin(run.batch));
    fracas_record_init(&run.record);
    return run;
}

static inline void shell_step(shell_run *run)
{
    OK(fracas_batch_step(run->batch, &run->record, &run->running));
}

static inline void shell_clear(shell_run *run)
{
    fracas_record_clear(&run->record);
    fracas_batch_destroy(run->batch);
    fracas_model_destroy(run->model);
}

#endif
