/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of one lane as bytes: all that a later step reads, and no more. */
#include "engine/solver/batch.h"

#include <math.h>

/* Doubles of one lane, `stride` apart, through a block. */
static fracas_err transfer_doubles(double *first, size_t count, size_t stride, bool load,
                                   fracas_transfer *transfer, void *context)
{
    enum { BLOCK = 4096 };
    double block[BLOCK];
    for (size_t from = 0; from < count; from += BLOCK) {
        const size_t size = count - from < BLOCK ? count - from : BLOCK;
        double *at = first + from * stride;
        for (size_t i = 0; i < size; i++) block[i] = at[i * stride];
        TRY(transfer(context, block, size * sizeof *block));
        for (size_t i = 0; load && i < size; i++) at[i * stride] = block[i];
    }
    return FRACAS_OK;
}

static fracas_err transfer_history(fracas_history *history, bool load, fracas_transfer *transfer,
                                   void *context)
{
    fracas_history copy = *history;
    copy.entry = NULL;
    copy.value = NULL;
    TRY(transfer(context, &copy, sizeof copy));
    /* Each interval has been passed before it left a row: no count runs out of its memory. */
    if (load && (copy.intervals != history->intervals || copy.width != history->width ||
                 copy.next < 0 || copy.next > copy.intervals + 1 || copy.count > (size_t)copy.next))
        return fracas_fail(FRACAS_DAMAGED, "a state with a history of other intervals or probes");
    copy.entry = history->entry;
    copy.value = history->value;
    if (load) *history = copy;
    TRY(transfer(context, history->entry, history->count * sizeof *history->entry));
    return history->width ? transfer(context, history->value,
                                     fracas_history_values(history) * sizeof *history->value)
                          : FRACAS_OK;
}

static fracas_err transfer_lane(fracas_batch *batch, size_t l, bool load, fracas_transfer *transfer,
                                void *context)
{
    const fracas_model *model = batch->model;
    fracas_step *step = &batch->step;
    fracas_lane *lane = &batch->lane[l], copy = *lane;
    copy.history = (fracas_history){0};
    TRY(transfer(context, &copy, sizeof copy));
    if (load) {
        copy.history = lane->history;
        *lane = copy;
    }
    TRY(transfer_history(&lane->history, load, transfer, context));
    double *const one[] = {step->time, step->drift, step->kick,
                           step->next, step->power, step->first_onset};
    for (size_t i = 0; i < sizeof one / sizeof *one; i++)
        TRY(transfer(context, &one[i][l], sizeof **one));
    for (int m = 0; m < FRACAS_LOADINGS; m++)
        TRY(transfer(context, &step->driven[m][l], sizeof **step->driven));
    for (int e = 0; e < FRACAS_ENERGIES; e++)
        TRY(transfer(context, &step->energy[e][l], sizeof **step->energy));
    TRY(transfer(context, &step->cracked[l], sizeof *step->cracked));
    TRY(transfer(context, &step->broken[l], sizeof *step->broken));
    const size_t lanes = (size_t)step->lanes, size = model->formulation->state_size(model);
    double *const state = step->state + l / lanes * lanes * step->division.fields + l % lanes;
    TRY(transfer_doubles(state, size, lanes, load, transfer, context));
    double *const times[] = {step->onset_time, step->break_time};
    for (size_t i = 0; step->onset_time && i < 2; i++)
        TRY(transfer_doubles(times[i] + l, model->interfaces, (size_t)step->width, load, transfer,
                             context));
    return FRACAS_OK;
}

fracas_err fracas_batch_save(fracas_batch *batch, size_t lane, fracas_transfer *put, void *context)
{
    return transfer_lane(batch, lane, false, put, context);
}

fracas_err fracas_batch_load(fracas_batch *batch, size_t lane, fracas_transfer *get, void *context)
{
    return transfer_lane(batch, lane, true, get, context);
}

fracas_lane_progress fracas_batch_progress(const fracas_batch *batch, size_t lane)
{
    return (fracas_lane_progress){batch->lane[lane].running, batch->lane[lane].steps,
                                  batch->step.time[lane], batch->model->spec.time.end};
}
