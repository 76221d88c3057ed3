/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Batches of any model, their strengths, and runs of them. */
#ifndef FRACAS_TESTS_SUPPORT_BATCH_H
#define FRACAS_TESTS_SUPPORT_BATCH_H

#include "engine/solver/batch.h"
#include "sampler/api/sampler.h"
#include "tests/support/test.h"

#define BAR_STRENGTH_MEAN 300e6 /* Pa */

static inline fracas_model *make_model(const fracas_spec *spec)
{
    fracas_model *model = NULL;
    OK(fracas_model_create(spec, &model));
    return model;
}

static inline fracas_batch *batch_with(const fracas_model *model, size_t count,
                                       fracas_batch_options options)
{
    fracas_batch *batch = NULL;
    OK(fracas_batch_create(model, count, &options, &batch));
    return batch;
}

/* Number of strengths of a realization. */
static inline size_t strengths_of(const fracas_model *model)
{
    return model->interfaces * model->strengths;
}

/* The strength at Gauss point g of an interface. */
static inline double strength_at(const fracas_batch *batch, size_t lane, size_t interface, size_t g)
{
    const size_t strengths = batch->model->strengths;
    size_t stride;
    const double *strength = fracas_batch_strength((fracas_batch *)batch, lane, &stride);
    return strength[(interface * strengths + (strengths > 1 ? g : 0)) * stride];
}

/* Strengths uniform in 300 MPa (1 +- scatter) for replica `replica`, in lane `lane`. */
static inline void bar_draw(fracas_batch *batch, size_t lane, double scatter, uint64_t replica)
{
    const fracas_stream stream = {
        .seed = 1, .purpose = FRACAS_PURPOSE_STRENGTH, .point = {2, 3}, .replica = replica};
    size_t stride;
    double *strength = fracas_batch_strength(batch, lane, &stride);
    for (size_t k = 0; k < strengths_of(batch->model); k++)
        strength[k * stride] = BAR_STRENGTH_MEAN *
                               (1 + scatter * (2 * fracas_stream_uniform(&stream, k) - 1));
}

/* Strength number k, which is interface k where each has one. */
static inline void bar_set_strength(fracas_batch *batch, size_t lane, size_t k, double sigma_c)
{
    size_t stride;
    double *strength = fracas_batch_strength(batch, lane, &stride);
    strength[k * stride] = sigma_c;
}

/* One lane with its interfaces kept; strengths of 300 MPa (1 +- scatter). */
static inline fracas_batch *lane_of(const fracas_model *model, double scatter, uint64_t replica,
                                    int64_t history)
{
    fracas_batch *batch = batch_with(
        model, 1,
        (fracas_batch_options){
            .history = history, .interfaces = true, .width = 1, .isa = FRACAS_ISA_BEST});
    bar_draw(batch, 0, scatter, replica);
    return batch;
}

static inline void run_to_end(fracas_batch *batch, fracas_record *record)
{
    size_t running = batch->count;
    while (running > 0) OK(fracas_batch_step(batch, record, &running));
}

/* One realization, step by step. */
typedef struct {
    fracas_model *model;
    fracas_batch *batch;
    fracas_record record;
    size_t n, running; /* elements; 1 until it is over */
    double h;          /* length of a chain's elements [m] */
} one_run;

/* All strengths alike [Pa], to be changed before begin_run; the model goes with the run. */
static inline one_run make_run(fracas_model *model, int width, double strength)
{
    one_run run = {
        .model = model,
        .batch = batch_with(
            model, 1,
            (fracas_batch_options){.width = width, .isa = FRACAS_ISA_BEST, .interfaces = true}),
        .n = model->elements,
        .running = 1,
        .h = model->element_size};
    for (size_t k = 0; k < strengths_of(model); k++) bar_set_strength(run.batch, 0, k, strength);
    fracas_record_init(&run.record);
    return run;
}

static inline one_run begin_run(fracas_model *model, int width, double strength)
{
    one_run run = make_run(model, width, strength);
    OK(fracas_batch_begin(run.batch));
    return run;
}

static inline void step_run(one_run *run)
{
    OK(fracas_batch_step(run->batch, &run->record, &run->running));
}

static inline void finish_run(one_run *run)
{
    while (run->running) step_run(run);
}

static inline void clear_run(one_run *run)
{
    fracas_record_clear(&run->record);
    fracas_batch_destroy(run->batch);
    fracas_model_destroy(run->model);
}

/* Runs replicas first, first + 1, ..., of strengths 300 MPa (1 +- scatter), to their ends; replica
 * r is in slot r - first. The caller clears the records. */
static inline void run_replicas(const fracas_model *model, uint64_t first, size_t count,
                                double scatter, fracas_batch_options options, fracas_record *record)
{
    OWN(fracas_batch) batch = batch_with(model, count, options);
    for (size_t l = 0; l < count; l++) {
        bar_draw(batch, l, scatter, first + l);
        fracas_record_init(&record[l]);
    }
    OK(fracas_batch_run(batch, record));
}

/* The ledgers of replicas that break up: the largest residual, created energy and work by what is
 * dissipated; the mean number of fragments, the sum of broken interfaces. */
typedef struct {
    double residual, created, work, fragments;
    int64_t broken;
} ledger_figures;

/* Replicas first .. first + count - 1, 8 at most; `look`, unless NULL, sees each record. */
static inline ledger_figures
break_up(const fracas_model *model, uint64_t first, size_t count, double scatter,
         void (*look)(const fracas_model *model, const fracas_record *record))
{
    ledger_figures f = {.residual = 0};
    fracas_record record[8];
    run_replicas(model, first, count, scatter, (fracas_batch_options){.isa = FRACAS_ISA_BEST},
                 record);
    for (size_t l = 0; l < count; l++) {
        const fracas_record *r = &record[l];
        assert_int_equal(r->outcome, FRACAS_FRAGMENTED);
        f.residual = fmax(f.residual, r->residual / r->dissipated);
        f.created = fmax(f.created, fabs(r->created) / r->dissipated);
        f.work = fmax(f.work, r->work / r->dissipated);
        f.fragments += (double)r->fragments / (double)count;
        f.broken += r->broken;
        for (int e = 0, whole = 0; e < FRACAS_ENERGIES; e++) { /* 1e-9: sums of other terms */
            if (fracas_energies[e].role != FRACAS_ROLE_PART) whole = e;
            assert_true(0 <= r->energy[e] || fracas_energies[e].role != FRACAS_ROLE_PART);
            assert_true(whole == e || r->energy[e] <= r->energy[whole] * (1 + 1e-9));
        }
        if (look) look(model, r);
        fracas_record_clear(&record[l]);
    }
    return f;
}

#endif
