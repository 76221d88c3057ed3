/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/batch.h"

#include "engine/solver/shapes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fracas_batch_width(size_t count)
{
    return count > 4 ? 8 : count > 1 ? 4 : 1;
}

static fracas_err choose_width(size_t count, int wanted, int *width)
{
    if (count < 1 || count > FRACAS_LANES_MAX)
        return fracas_fail(FRACAS_USAGE, "a batch of %zu realizations; 1 to %d fit", count,
                           FRACAS_LANES_MAX);
    *width = wanted ? wanted : fracas_batch_width(count);
    if ((*width != 1 && *width != 4 && *width != 8) || (size_t)*width < count)
        return fracas_fail(FRACAS_USAGE,
                           "%d lanes for %zu realizations; lanes are 1, 4 or 8 and no fewer",
                           *width, count);
    return FRACAS_OK;
}

/* Aligned for the widest lanes. */
static void *allocate(size_t doubles)
{
    size_t bytes = (doubles * sizeof(double) + 63) / 64 * 64;
    return aligned_alloc(64, bytes ? bytes : 64);
}

static fracas_err divide(const fracas_model *model, int parts, fracas_step *step)
{
    const fracas_formulation *f = model->formulation;
    step->division.parts = 1;
    step->division.fields = f->state_size(model);
    if (f->divide) TRY(f->divide(model, parts > 1 ? (size_t)parts : 1, &step->division));
    return fracas_team_create(step->division.parts, &step->team);
}

fracas_err fracas_batch_create(const fracas_model *model, size_t count,
                               const fracas_batch_options *options, fracas_batch **out)
{
    int width = 0;
    fracas_isa isa;
    TRY(choose_width(count, options->width, &width));
    TRY(fracas_isa_choose(options->isa, &isa));
    OWN(fracas_batch) batch = aligned_alloc(64, (sizeof *batch + 63) / 64 * 64);
    if (!batch) return fracas_no_memory("a batch");
    *batch = (fracas_batch){
        .model = model,
        .count = count,
        .watch = options->watch,
        .step = {.width = width, .lanes = fracas_isa_lanes(isa, width), .isa = isa}};
    const size_t lanes = (size_t)width;
    TRY(fracas_spots_find(model, options->probes, options->reactions, &batch->spots));
    batch->step.division.reactions = options->reactions;
    TRY(divide(model, options->parts, &batch->step));
    double **const array[] = {&batch->step.state, &batch->step.onset_time, &batch->step.break_time};
    for (int i = 0; i < (options->interfaces ? 3 : 1); i++) {
        *array[i] = allocate((i ? model->interfaces : batch->step.division.fields) * lanes);
        if (!*array[i]) return fracas_no_memory("a batch");
    }
    TRY(fracas_partition_init(&batch->step.partition, model->elements));
    for (size_t l = 0; l < lanes; l++)
        TRY(fracas_history_init(&batch->lane[l].history, options->history, model->spec.time.end,
                                fracas_spots_values(&batch->spots)));
    *out = batch;
    batch = NULL;
    return FRACAS_OK;
}

void fracas_batch_destroy(fracas_batch *batch)
{
    if (!batch) return;
    fracas_team_destroy(batch->step.team);
    if (batch->step.division.plan)
        batch->model->formulation->division_destroy(batch->step.division.plan);
    free(batch->step.state);
    free(batch->step.onset_time);
    free(batch->step.break_time);
    fracas_partition_clear(&batch->step.partition);
    for (int l = 0; l < FRACAS_LANES_MAX; l++) fracas_history_clear(&batch->lane[l].history);
    free(batch);
}

double *fracas_batch_strength(fracas_batch *batch, size_t lane, size_t *stride)
{
    return batch->model->formulation->strength(batch->model, &batch->step, (int)lane, stride);
}

/* A lane before its first step; `stop_at` stays. */
static void begin_lane(fracas_batch *batch, size_t l)
{
    fracas_lane *lane = &batch->lane[l];
    fracas_step *step = &batch->step;
    batch->model->formulation->lane_init(batch->model, step, (int)l);
    *lane = (fracas_lane){.history = lane->history,
                          .stop_at = lane->stop_at,
                          .running = l < batch->count,
                          .counted = -1};
    fracas_history_begin(&lane->history);
    for (int e = 0; e < FRACAS_ENERGIES; e++) step->energy[e][l] = 0;
    for (int m = 0; m < FRACAS_LOADINGS; m++) step->driven[m][l] = 0;
    step->first_onset[l] = NAN;
    step->cracked[l] = step->broken[l] = 0;
}

fracas_err fracas_batch_begin(fracas_batch *batch)
{
    const fracas_model *model = batch->model;
    fracas_step *step = &batch->step;
    const size_t width = (size_t)step->width, strengths = model->interfaces * model->strengths;
    for (size_t l = 0; l < width; l++) {
        size_t stride;
        double *strength = fracas_batch_strength(batch, l, &stride);
        const double *first = fracas_batch_strength(batch, 0, &stride);
        for (size_t k = 0; k < strengths; k++) {
            if (l >= batch->count) strength[k * stride] = first[k * stride];
            fracas_err code = fracas_model_check_strength(model, strength[k * stride]);
            if (code)
                return fracas_fail_within(code, "realization %zu of the batch, interface %zu", l,
                                          k / model->strengths);
        }
        begin_lane(batch, l);
        for (size_t i = 0; step->onset_time && i < model->interfaces; i++)
            step->onset_time[i * width + l] = step->break_time[i * width + l] = NAN;
        for (size_t n = 0; step->break_time && n < model->nnotch; n++)
            step->break_time[model->notch[n] * width + l] = 0;
    }
    return FRACAS_OK;
}

/* Counts the fragments of a lane, again only when something has broken since. */
static fracas_err count_fragments(fracas_batch *batch, size_t l)
{
    const fracas_model *model = batch->model;
    fracas_lane *lane = &batch->lane[l];
    if (lane->counted == batch->step.broken[l]) return FRACAS_OK;
    lane->counted = batch->step.broken[l];
    return model->formulation->count(model, &batch->step, (int)l, &lane->census);
}

/* The numbers of docs/theory/settled.md, of a finished lane with its fragments counted. */
static fracas_err record_settling(fracas_batch *batch, size_t l, fracas_record *record)
{
    fracas_lane *lane = &batch->lane[l];
    fracas_rest rest;
    TRY(fracas_settling_energies(batch->model, &batch->step, (int)l, &lane->ledger,
                                 &record->vibrating, &rest));
    record->fragments_held = lane->census.held;
    if (!(batch->step.cracked[l] > 0)) return FRACAS_OK;
    fracas_settling_look(&lane->settling, batch->model,
                         batch->step.time[l] - batch->step.first_onset[l], &lane->census);
    record->transits = lane->settling.transits;
    record->growth = lane->settling.growth;
    record->rest = rest.mean;
    record->rest_variance = rest.variance;
    record->rest_bound = rest.bound;
    return FRACAS_OK;
}

/* The record of a lane that is over. */
static fracas_err finish_lane(fracas_batch *batch, size_t l, fracas_outcome outcome,
                              fracas_record *record)
{
    const fracas_lane *lane = &batch->lane[l];
    const fracas_ledger *ledger = &lane->ledger;
    fracas_record_init(record);
    record->outcome = outcome;
    record->broken = batch->step.broken[l];
    record->cracked = batch->step.cracked[l];
    record->steps = lane->steps;
    record->onset_time = batch->step.first_onset[l];
    record->end_time = batch->step.time[l];
    record->time_step = batch->model->time_step;
    record->mass = batch->model->mass;
    record->residual = ledger->largest_residual;
    record->residual_end = ledger->residual;
    memcpy(record->energy, ledger->energy, sizeof record->energy);
    TRY(record_settling(batch, l, record));
    OWNED double *seen = NULL;
    TRY(fracas_history_harvest(&lane->history, record, &seen));
    TRY(fracas_spots_take(&batch->spots, seen, record));
    TRY(batch->model->formulation->harvest(batch->model, &batch->step, (int)l, record));
    return fracas_shapes_take(batch->model, &batch->step, (int)l, record);
}

/* A look at how final the count is, where one is due. */
static fracas_err look_at_count(fracas_batch *batch, size_t l, fracas_progress *progress)
{
    fracas_lane *lane = &batch->lane[l];
    fracas_step *step = &batch->step;
    const fracas_model *model = batch->model;
    const double since = step->time[l] - step->first_onset[l];
    progress->look = fracas_settling_due(&lane->settling, since, model->time_step);
    if (!progress->look) return FRACAS_OK;
    TRY(count_fragments(batch, l));
    fracas_settling_look(&lane->settling, model, since, &lane->census);
    progress->transits = lane->settling.transits;
    progress->growth = lane->settling.growth;
    if (!model->formulation->rest || !fracas_stop_needs_rest(&model->spec.time)) return FRACAS_OK;
    double vibrating;
    fracas_rest rest;
    TRY(fracas_settling_energies(model, step, (int)l, &lane->ledger, &vibrating, &rest));
    progress->rest = rest.mean / fmax((double)lane->census.all, FRACAS_REST_FEWEST);
    return FRACAS_OK;
}

/* *running: the lane is not over. */
static fracas_err check_end(fracas_batch *batch, size_t l, fracas_outcome *outcome, bool *running)
{
    fracas_lane *lane = &batch->lane[l];
    fracas_step *step = &batch->step;
    const fracas_ledger *ledger = &lane->ledger;
    fracas_progress progress = {.time = step->time[l],
                                .elastic = ledger->elastic,
                                .dissipated = fracas_energy_lost(ledger->energy),
                                .cracked = step->cracked[l],
                                .broken = step->broken[l]};
    TRY(look_at_count(batch, l, &progress));
    bool drifts,
        over = fracas_stop_check(&lane->stop, &batch->model->spec.time, &progress, outcome);
    *running = false;
    if (!isfinite(ledger->residual)) {
        *outcome = FRACAS_NONFINITE;
        return FRACAS_OK;
    }
    TRY(fracas_guard_check(&lane->guard, ledger, batch->model, step, (int)l, lane->steps, over,
                           &drifts));
    if (drifts) *outcome = FRACAS_ENERGY_DRIFT;
    else if (lane->stop_at > 0 && lane->steps == lane->stop_at) *outcome = FRACAS_TIME_LIMIT;
    else *running = !over;
    return FRACAS_OK;
}

/* A notch is no result of the load: takes its interfaces out of the dissipated energy. */
static fracas_err leave_out_notch(fracas_batch *batch, size_t l)
{
    fracas_lane *lane = &batch->lane[l];
    double *dissipated = &batch->step.dissipated[l];
    if (batch->model->nnotch == 0) return FRACAS_OK;
    if (lane->steps == 0) {
        lane->notched = *dissipated;
        TRY(count_fragments(batch, l));
        lane->settling.parted = lane->census.all - lane->census.held - 1;
    }
    *dissipated -= lane->notched;
    return FRACAS_OK;
}

/* One lane after a step: ledger, history, stop. */
static fracas_err observe_lane(fracas_batch *batch, size_t l, fracas_record *record)
{
    fracas_lane *lane = &batch->lane[l];
    const fracas_step *step = &batch->step;
    fracas_ledger *ledger = &lane->ledger;
    const bool cracked = step->cracked[l] > 0;
    fracas_outcome outcome;
    TRY(leave_out_notch(batch, l));
    fracas_ledger_update(ledger, step, (int)l, lane->steps == 0);
    fracas_history_row row = {
        .time = step->time[l], .residual = ledger->residual, .broken = step->broken[l]};
    memcpy(row.energy, ledger->energy, sizeof row.energy);
    TRY(check_end(batch, l, &outcome, &lane->running));
    double seen[FRACAS_SPOTS_VALUES];
    const bool kept = !lane->running || fracas_history_keeps(&lane->history, &row, cracked);
    if (kept) {
        TRY(count_fragments(batch, l));
        row.fragments = lane->census.all;
        fracas_spots_look(&batch->spots, batch->model, step, (int)l, seen);
    }
    fracas_history_observe(&lane->history, lane->steps, &row, cracked, kept ? seen : NULL);
    return lane->running ? FRACAS_OK : finish_lane(batch, l, outcome, record);
}

/* Crossings are balanced from BALANCE_SPANS spans after the first onset on, a span being from there
 * to the first break: short runs do not pay  (balance.5). */
static void set_balance(fracas_batch *batch, int l)
{
    enum { BALANCE_SPANS = 6 };
    fracas_step *step = &batch->step;
    fracas_lane *lane = &batch->lane[l];
    if (lane->first_break == 0 && step->broken[l] > 0) lane->first_break = step->time[l];
    const double onset = step->first_onset[l];
    const bool on = lane->first_break > 0 &&
                    step->time[l] - onset > BALANCE_SPANS * (lane->first_break - onset);
    step->balance[l] = on;
    step->balanced |= on;
}

/* The clock of a lane at the next step. */
static void advance_clock(fracas_batch *batch, int l)
{
    fracas_step *step = &batch->step;
    fracas_lane *lane = &batch->lane[l];
    const double base = batch->model->time_step;
    step->drift[l] = lane->steps == 0 ? 0.0 : step->next[l];
    step->kick[l] = step->next[l] = base;
    if (lane->steps == 0) {
        lane->pace = base;
    } else if (step->drift[l] == lane->pace) {
        lane->paces++;
    } else {
        lane->since = step->time[l];
        lane->pace = step->drift[l];
        lane->paces = 1;
    }
    step->time[l] = lane->since + (double)lane->paces * lane->pace;
}

fracas_err fracas_batch_step(fracas_batch *batch, fracas_record *record, size_t *running)
{
    fracas_step *step = &batch->step;
    step->balanced = false;
    for (int l = 0; l < step->width; l++) {
        set_balance(batch, l);
        advance_clock(batch, l);
    }
    batch->model->formulation->advance(batch->model, step);
    *running = 0;
    for (size_t l = 0; l < batch->count; l++) {
        if (batch->lane[l].running) TRY(observe_lane(batch, l, &record[l]));
        *running += batch->lane[l].running;
    }
    for (int l = 0; l < step->width; l++) batch->lane[l].steps++;
    return FRACAS_OK;
}

/* The look of whoever watches. */
static fracas_err look(fracas_batch *batch, const fracas_record *record)
{
    const fracas_batch_watch *watch = batch->watch;
    if (!watch || (watch->due && !watch->due(watch->context))) return FRACAS_OK;
    return watch->pause(watch->context, batch, record);
}

/* Computes all lanes until they are over. */
static fracas_err run_lanes(fracas_batch *batch, fracas_record *record)
{
    enum { BETWEEN = 64 }; /* steps */
    const fracas_batch_watch *watch = batch->watch;
    const int between = watch && watch->every > 0 ? watch->every : BETWEEN;
    size_t running = 0;
    for (size_t l = 0; l < batch->count; l++) running += batch->lane[l].running;
    for (int n = 1; running > 0; n++) {
        TRY(fracas_batch_step(batch, record, &running));
        if (running > 0 && n % between == 0) TRY(look(batch, record));
    }
    return watch && watch->end ? watch->end(watch->context, batch, record) : FRACAS_OK;
}

/* Computes lanes with final fragments before their drift once more, until their balance was last
 * sound: no state of then is in memory. */
static fracas_err run_again(fracas_batch *batch, fracas_record *record)
{
    bool again = false, drifted[FRACAS_LANES_MAX] = {false};
    for (size_t l = 0; l < batch->count; l++) {
        fracas_lane *lane = &batch->lane[l];
        if (record[l].outcome == FRACAS_ENERGY_DRIFT && lane->guard.final && !lane->stop_at) {
            lane->stop_at = lane->guard.sound;
            fracas_record_clear(&record[l]);
            again = drifted[l] = true;
        }
    }
    if (!again) return FRACAS_OK;
    TRY(fracas_batch_begin(batch));
    for (size_t l = 0; l < batch->count; l++) batch->lane[l].running = drifted[l];
    return run_lanes(batch, record);
}

fracas_err fracas_batch_run(fracas_batch *batch, fracas_record *record)
{
    TRY(fracas_batch_begin(batch));
    if (batch->watch && batch->watch->begin)
        TRY(batch->watch->begin(batch->watch->context, batch, record));
    TRY(run_lanes(batch, record));
    return run_again(batch, record);
}
