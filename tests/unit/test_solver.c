/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pieces of the solver: stop rules, histories, fragments, what a batch refuses. */
#include "tests/support/listed_laws.h"
#include "tests/support/bar.h"

#include "engine/fragments/fragments.h"

#define LANES 1
#include "base/lanes.h"
#include "engine/cohesive/kernels.h"

/* A batch of `n` realizations of the spec; the batch and its model end with their scope. */
static fracas_batch *batch_of(const fracas_spec *spec, size_t n, fracas_batch_options options,
                              fracas_model **model)
{
    fracas_batch *batch;
    options.isa = FRACAS_ISA_BEST;
    OK(fracas_model_create(spec, model));
    OK(fracas_batch_create(*model, n, &options, &batch));
    return batch;
}

/* Fragments of a lane with so many broken interfaces. */
static int64_t count_broken(const fracas_model *model, int64_t broken)
{
    fracas_step step = {.broken = {broken}};
    fracas_census census;
    OK(model->formulation->count(model, &step, 0, &census));
    assert_true(census.held == 0);
    return census.all;
}

/* State of a realization, and its end by the rule. */
enum { GOES_ON = FRACAS_NOUTCOMES };
typedef struct {
    double time, dissipated;
    int64_t cracked, broken, outcome;
} progress;

static void follow(const fracas_time *rule, const progress *at, size_t count)
{
    fracas_stop stop = {0};
    for (size_t i = 0; i < count; i++) {
        const fracas_progress now = {.time = at[i].time,
                                     .dissipated = at[i].dissipated,
                                     .cracked = at[i].cracked,
                                     .broken = at[i].broken};
        fracas_outcome outcome;
        const bool ends = fracas_stop_check(&stop, rule, &now, &outcome);
        assert_int_equal(ends ? (int)outcome : GOES_ON, at[i].outcome);
    }
}

static void stop_at_a_set_time(void **unused)
{
    static const progress at[] = {{0.999, 1, 5, 2, GOES_ON},
                                  {1.0, 1, 5, 2, FRACAS_FRAGMENTED},
                                  {1.0, 1, 5, 0, FRACAS_INTACT}};
    follow(&(fracas_time){.stop = &fracas_stop_time, .end = 1.0}, at, FRACAS_COUNT(at));
}

static void quiet_waits_after_the_first_onset(void **unused)
{
    static const progress settles[] = {
        {5, 0, 0, 0, GOES_ON}, /* not armed, however long it is quiet */
        {6, 1, 1, 0, GOES_ON}, /* onset */
        {6.9, 1.005, 1, 0, GOES_ON}, {6.95, 1.02, 1, 0, GOES_ON}, /* dissipates: starts again */
        {7.4, 1.02, 1, 0, GOES_ON},  {7.5, 1.02, 1, 1, GOES_ON},  /* a break: again */
        {8.4, 1.025, 1, 1, GOES_ON}, {8.5, 1.03, 1, 1, FRACAS_FRAGMENTED},
    };
    static const progress runs_on[] = {{9.5, 1, 1, 0, GOES_ON},
                                       {10, 1, 1, 0, FRACAS_TIME_LIMIT}}; /* the cap */
    static const progress never_cracks[] = {{10, 0, 0, 0, FRACAS_INTACT}};
    const fracas_time rule = {
        .stop = &fracas_stop_quiet, .end = 10, .quiet = 1, .quiet_fraction = 0.01};
    follow(&rule, settles, FRACAS_COUNT(settles));
    follow(&rule, runs_on, FRACAS_COUNT(runs_on));
    follow(&rule, never_cracks, FRACAS_COUNT(never_cracks));
}

/* Ten steps of time 0.1, 0.2 ...: rows at 0, 0.5 and 1.0 (first step at or after), onset at step 3,
 * peak at step 7; each with the two values of its own step. */
static void history_keeps_intervals_onset_peak_and_end(void **unused)
{
    FRACAS_CLEARED(fracas_history) history;
    RECORD(record);
    OK(fracas_history_init(&history, 2, 1.0, 2));
    for (int step = 0; step <= 12; step++) {
        fracas_history_row row = {.time = 0.09 * step, .elastic = step == 7 ? 5 : 1, .cohesive = 1};
        const double value[2] = {step, -step};
        const bool kept = step == 12 || fracas_history_keeps(&history, &row, step >= 3);
        fracas_history_observe(&history, step, &row, step >= 3, kept ? value : NULL);
    }
    OWNED double *value = NULL;
    OK(fracas_history_harvest(&history, &record, &value));
    const int expected[] = {0, 3, 6, 7, 12};
    assert_int_equal(record.nhistory, 5);
    for (int i = 0; i < 5; i++)
        assert_true(fabs(record.history[i].time - 0.09 * expected[i]) < 1e-15 &&
                    value[2 * i] == expected[i] && value[2 * i + 1] == -expected[i]);
}

/* Two steps by hand: work is the trapezoid of power, the residual holds every term with its sign.
 */
static void the_ledger_adds_every_term(void **unused)
{
    fracas_ledger ledger = {0};
    fracas_step step = {.width = 1,
                        .kinetic = {1},
                        .elastic = {2},
                        .cohesive = {4},
                        .dissipated = {8},
                        .power = {3}};
    fracas_ledger_update(&ledger, &step, 0, true);
    assert_true(ledger.residual == 0 && ledger.initial == 15 && ledger.work == 0);
    step = (fracas_step){.width = 1,
                         .drift = {0.5},
                         .kinetic = {16},
                         .elastic = {32},
                         .cohesive = {64},
                         .dissipated = {128},
                         .created = {256},
                         .power = {5}};
    fracas_ledger_update(&ledger, &step, 0, false);
    assert_true(ledger.work == 2); /* 0.5 (3 + 5)/2 */
    assert_true(ledger.residual == 240 - 256 - 2 - 15);
    assert_true(ledger.largest_residual == 33);
    step.created[0] = 223;
    fracas_ledger_update(&ledger, &step, 0, false);
    assert_true(ledger.residual == 240 - 223 - 4.5 - 15 && ledger.largest_residual == 33);
    step.dissipated_bending[0] = 100; /* in the dissipated 128 already */
    step.drift[0] = 0;
    fracas_ledger_update(&ledger, &step, 0, false);
    assert_true(ledger.dissipated_bending == 100 && ledger.residual == 240 - 223 - 4.5 - 15);
    step.friction[0] = 1024; /* a sink of its own */
    fracas_ledger_update(&ledger, &step, 0, false);
    assert_true(ledger.friction == 1024 && ledger.residual == 240 + 1024 - 223 - 4.5 - 15);
    step.damped[0] = 512; /* a term of the residual, and of nothing else */
    fracas_ledger_update(&ledger, &step, 0, false);
    assert_true(ledger.residual == 240 + 1024 + 512 - 223 - 4.5 - 15);
    assert_true(fracas_energy_lost(ledger.energy) == 128 + 1024);
    assert_true(fracas_energy_held(ledger.energy, 0) == 240 + 1024);
}

static void fragments_are_connected_elements(void **unused)
{
    FRACAS_CLEARED(fracas_partition) p;
    OK(fracas_partition_init(&p, 8));
    fracas_partition_unite(&p, 7, 2);
    fracas_partition_unite(&p, 2, 5);
    fracas_partition_unite(&p, 6, 1);
    fracas_partition_unite(&p, 5, 7);
    assert_int_equal(fracas_partition_label(&p), 5);
    const uint32_t expected[] = {0, 1, 2, 3, 4, 2, 1, 2};
    assert_memory_equal(p.label, expected, sizeof expected);
}

/* A closed bar of 10 elements broken at interfaces 2 and 6: elements 3-6, and 7-9 with 0-2 in one
 * piece across the end. */
static void a_fragment_across_the_end_is_in_one_piece(void **unused)
{
    fracas_spec spec = bar_reference(10, 1e4, 1);
    spec.geometry.length = 10 * 1e-4;
    OWN(fracas_model) model;
    OWN(fracas_batch) batch = batch_of(&spec, 1, (fracas_batch_options){.width = 1}, &model);
    for (size_t i = 0; i < 10; i++) bar_set_strength(batch, 0, i, 300e6);
    OK(fracas_batch_begin(batch));
    batch->step.state[2 * 7 + 4] = batch->step.state[6 * 7 + 4] =
        1.0;                    /* damage of interfaces 2 and 6 */
    batch->step.time[0] = 1e-5; /* stretched by 1.1 */
    RECORD(record);
    OK(model->formulation->harvest(model, &batch->step, 0, &record));
    assert_int_equal(record.nfragment, 2);
    assert_int_equal(record.fragment[0].elements, 6);
    assert_int_equal(record.fragment[1].elements, 4);
    /* centre of elements -3 .. 2 is 0, or the stretched length as rounding has it; of 3 .. 6 is 1.1
     * * 5e-4. Velocity of the background there, 1e4 x. Rounding of coordinates of 1e-3: 1e-18. */
    assert_true(fabs(record.fragment[0].position[0]) < 1e-17 ||
                fabs(record.fragment[0].position[0] - 1.1e-3) < 1e-17);
    assert_true(fabs(record.fragment[1].position[0] - 5.5e-4) < 1e-17);
    assert_true(fabs(record.fragment[1].velocity[0] - 5.0) < 1e-12);
    assert_true(fabs(record.fragment[0].mass / record.fragment[1].mass - 1.5) < 1e-12);
    assert_int_equal(count_broken(model, 2), 2);
    assert_int_equal(count_broken(model, 1), 1);
    assert_int_equal(count_broken(model, 0), 1);
}

enum { N = 12, FIELDS = 7 };

/* Sums over the piece that begins at element `first`, walking right until an interface that is
 * broken (or the end). */
static fracas_fragment walk(const fracas_batch *batch, size_t first, bool periodic)
{
    const fracas_spec *spec = &batch->model->spec;
    const double h = spec->geometry.length / N, time = batch->step.time[0],
                 rate = spec->loading.rate;
    fracas_fragment sum = {0};
    for (size_t k = 0; k < N; k++) {
        const double *at = batch->step.state + (first + k) % N * FIELDS;
        double x = h * ((double)(first + k) + 0.5);
        sum.elements++;
        sum.mass += spec->material.density * spec->geometry.area * h;
        sum.position[0] += x * (1 + rate * time) + 0.5 * (at[0] + at[1]);
        sum.velocity[0] += rate * x + 0.5 * (at[2] + at[3]);
        if (at[4] >= 1 || (!periodic && first + k == N - 1)) break;
    }
    sum.position[0] /= (double)sum.elements;
    sum.velocity[0] /= (double)sum.elements;
    return sum;
}

/* Random displacements, velocities and breaks (none, one, several) against sums along the bar. A
 * piece may be named one circumference away: then position and velocity are, together. Rounding of
 * 1e-3 m and 1e2 m/s: 1e-12 relative. */
static void fragments_are_sums_over_their_elements(void **unused)
{
    uint64_t seed = 5;
    for (int trial = 0; trial < 60; trial++) {
        const bool periodic = trial % 2 == 0;
        fracas_spec spec = bar_reference(N, 1e4, 1);
        spec.geometry.ends = periodic ? &fracas_ends_periodic : &fracas_ends_held;
        spec.geometry.length = N * 1e-4;
        OWN(fracas_model) model;
        OWN(fracas_batch) batch = batch_of(&spec, 1, (fracas_batch_options){.width = 1}, &model);
        for (size_t i = 0; i < model->interfaces; i++) bar_set_strength(batch, 0, i, 300e6);
        OK(fracas_batch_begin(batch));
        batch->step.time[0] = 2e-5;
        double momentum = 0;
        size_t broken = 0, last = N - 1;
        for (size_t e = 0; e < N; e++) {
            double *at = batch->step.state + e * FIELDS;
            for (int f = 0; f < 4; f++)
                at[f] = f < 2 ? 2e-4 * random_noise(&seed) : 20 * random_noise(&seed);
            at[4] = random_noise(&seed) + 0.5 < 0.05 * (trial / 10) ? 1.0 : 0.99;
            if (trial / 10 == 1) at[4] = e == (size_t)trial % N ? 1.0 : 0.0; /* exactly one */
            if (e < model->interfaces && at[4] >= 1) broken++, last = e;
            momentum += 0.5 * 2750 * 1e-6 * 1e-4 * (at[2] + at[3]);
        }
        RECORD(record);
        record.fragments_dust = 0;
        OK(model->formulation->harvest(model, &batch->step, 0, &record));
        assert_int_equal(record.nfragment, count_broken(model, (int64_t)broken));
        assert_true(fabs(record.momentum[0] - momentum) < 1e-12 * 1e-6);
        const double length = spec.geometry.length,
                     stretched = length * (1 + spec.loading.rate * 2e-5);
        /* in order along the bar: from the element after the last break, which holds element 0
         * unless that is cut off */
        size_t first = periodic ? (broken ? (last + 1) % N : 0) : 0;
        int64_t dust = 0;
        for (size_t f = 0; f < record.nfragment; f++) {
            fracas_fragment expected = walk(batch, first, periodic);
            const fracas_fragment *found = &record.fragment[f];
            assert_int_equal(found->elements, expected.elements);
            assert_true(fabs(found->mass / expected.mass - 1) < 1e-12);
            assert_true(fabs(found->size - (double)expected.elements * 1e-4) < 1e-15);
            double turns = round((expected.position[0] - found->position[0]) / stretched);
            assert_true(fabs(expected.position[0] - found->position[0] - turns * stretched) <
                        1e-15);
            assert_true(fabs(expected.velocity[0] - found->velocity[0] -
                             turns * spec.loading.rate * length) < 1e-10);
            assert_true(found->position[0] >
                        -1e-4); /* named where it is; half an element of play for w */
            assert_int_equal(found->dust, expected.elements == 1);
            dust += found->dust;
            first = (first + (size_t)expected.elements) % N;
        }
        assert_int_equal(record.fragments_dust, dust);
    }
}

/* T(S, D) of the law in the form with the largest opening and the secant stiffness,
 * theory/cohesive.md; 1e-12 of the larger of S and sigma_c for a handful of roundings, divided by 1
 * - D of 1e-2 at least. */
static void nitsche_is_the_secant_law(void **unused)
{
    uint64_t seed = 3;
    int loading = 0, unloading = 0, contact = 0, open = 0;
    for (int i = 0; i < 20000; i++) {
        const double sigma_c = 300e6 * (1 + random_noise(&seed)), delta_c = 200 / sigma_c;
        const double spring = sigma_c / delta_c * (1.5 + 50 * (random_noise(&seed) + 0.5)),
                     mean = 4e8 * random_noise(&seed);
        const double damage = i % 3 == 0 ? 0 : i % 7 == 0 ? 1 : 0.98 * (random_noise(&seed) + 0.5);
        const double q = 2.5 * delta_c * random_noise(&seed), opened = damage * delta_c;
        const double trial = damage >= 1 ? spring * q : mean + spring * q;
        double traction, now = opened;
        if (damage >= 1) {
            traction = fmin(0, trial);
            open++;
        } else if (trial <= 0) {
            traction = trial;
            contact++;
        } else {
            double reached = (trial - sigma_c) / (spring - sigma_c / delta_c);
            if (reached > opened) {
                now = fmin(reached, delta_c);
                traction = sigma_c * (1 - now / delta_c);
                loading++;
            } else if (damage == 0) {
                traction = trial;
            } else {
                double secant = sigma_c * (1 - damage) / opened;
                traction = secant * (trial / (spring + secant));
                unloading++;
            }
        }
        const line_result it = line_nitsche(&(line_input){.mean = mean,
                                                          .jump = q,
                                                          .damage = damage,
                                                          .sigma_c = sigma_c,
                                                          .constant = spring * delta_c - sigma_c,
                                                          .stiffness = spring,
                                                          .compliance = 1 / spring});
        const double scale = fmax(fabs(trial), sigma_c);
        assert_true(fabs(it.traction - traction) < 1e-12 * scale);
        assert_true(fabs(it.damage - now / delta_c) < 1e-12 * fmax(1, scale / sigma_c));
        double slip = it.damage >= 1 ? 0 : (traction - mean) / spring;
        assert_true(fabs(it.slip - slip) < 1e-12 * (scale + fabs(mean)) / spring);
    }
    assert_true(loading > 500 && unloading > 500 && contact > 500 && open > 500);
}

/* At the critical step itself the energy runs away: the realization says so. */
static void a_run_that_gains_energy_ends_as_drift(void **unused)
{
    for (int unstable = 0; unstable < 2; unstable++) {
        fracas_spec spec = bar_reference(800, 1e5, 2e-7);
        spec.geometry.length = 5e-3;
        spec.time.safety = unstable ? 1 : 0.25;
        OWN(fracas_model) model;
        OWN(fracas_batch) batch = batch_of(&spec, 1, (fracas_batch_options){.history = 10}, &model);
        bar_draw(batch, 0, 1.0 / 300, 1);
        RECORD(record);
        OK(fracas_batch_run(batch, &record));
        assert_int_equal(record.outcome, unstable ? FRACAS_ENERGY_DRIFT : FRACAS_FRAGMENTED);
        assert_true(record.end_time == (double)record.steps * record.time_step);
        assert_true(unstable
                        ? record.end_time < 2e-7
                        : record.end_time >= 2e-7 && record.end_time < 2e-7 + record.time_step);
        const fracas_history_row *end = &record.history[record.nhistory - 1];
        assert_true(end->time == record.end_time && end->residual == record.residual_end &&
                    record.residual_end != 0);
        assert_true(record.residual >= fabs(record.residual_end));
    }
}

/* Rows of the interfaces agree with the counts, and times of events lie inside steps: one at a
 * step's end would be a clamped one, and of hundreds hardly any falls there by chance. */
static void events_are_counted_and_timed_inside_their_steps(void **unused)
{
    for (int law = 0; law < BAR_LAWS; law++) {
        fracas_spec spec = bar_reference(1000, 1e5, 1.5e-7);
        spec.geometry.length = 1e-2;
        set_listed_law(&spec, law);
        spec.time.safety = 0.1;
        OWN(fracas_model) model;
        OWN(fracas_batch) batch = batch_of(&spec, 1, (fracas_batch_options){.interfaces = true},
                                           &model);
        bar_draw(batch, 0, 0.02, 1);
        RECORD(record);
        OK(fracas_batch_run(batch, &record));
        int64_t cracked = 0, broken = 0, at_step = 0;
        double first = INFINITY;
        for (size_t i = 0; i < record.ninterface; i++) {
            const fracas_interface_row *row = &record.interface[i];
            const double times[] = {row->onset_time, row->break_time};
            cracked += !isnan(row->onset_time);
            broken += !isnan(row->break_time);
            first = fmin(first, row->onset_time);
            assert_int_equal(row->damage >= 1, !isnan(row->break_time));
            if (row->damage > 0) assert_false(isnan(row->onset_time));
            if (!isnan(row->break_time)) assert_true(row->break_time > row->onset_time);
            for (int k = 0; k < 2; k++)
                at_step += !isnan(times[k]) && fabs(times[k] / record.time_step -
                                                    round(times[k] / record.time_step)) < 1e-6;
        }
        assert_int_equal(record.cracked, cracked);
        assert_int_equal(record.broken, broken);
        assert_true(record.onset_time == first && broken > 20 && cracked > broken);
        assert_true(at_step * 20 < cracked + broken);
    }
}

static void advance_as_if_bent(const fracas_model *model, fracas_step *step)
{
    fracas_formulation_bar.advance(model, step);
    for (int l = 0; l < step->width; l++)
        step->dissipated_bending[l] = (l + 1) * 0.25 * step->dissipated[l];
}

/* The part of bending comes from the formulation into every row of the history and the record of
 * its lane, and is part of no balance; a bar on its own has none. */
static void the_part_of_bending_is_kept(void **unused)
{
    fracas_formulation bent = fracas_formulation_bar;
    bent.advance = advance_as_if_bent;
    for (int with = 0; with < 2; with++) {
        fracas_spec spec = bar_reference(800, 1e5, 2e-7);
        spec.geometry.length = 5e-3;
        OWN(fracas_model) model;
        OWN(fracas_batch) batch;
        OK(fracas_model_create(&spec, &model));
        if (with) model->formulation = &bent;
        const fracas_batch_options options = {.history = 10, .isa = FRACAS_ISA_BEST};
        OK(fracas_batch_create(model, 2, &options, &batch));
        for (size_t l = 0; l < 2; l++) bar_draw(batch, l, 1.0 / 300, 1 + l);
        fracas_record record[2];
        for (size_t l = 0; l < 2; l++) fracas_record_init(&record[l]);
        OK(fracas_batch_run(batch, record));
        for (size_t l = 0; l < 2; l++) {
            const double part = with ? 0.25 * (double)(l + 1) : 0;
            const fracas_history_row *end = &record[l].history[record[l].nhistory - 1];
            assert_true(record[l].outcome == FRACAS_FRAGMENTED && record[l].dissipated > 0);
            assert_true(record[l].dissipated_bending == part * record[l].dissipated);
            for (const fracas_history_row *row = record[l].history; row <= end; row++)
                assert_true(row->dissipated_bending == part * row->dissipated);
            assert_true(fabs(end->kinetic + end->elastic + end->cohesive + end->dissipated -
                             end->created - end->work - end->residual) <
                        1e-13 * end->work); /* at rest at first: E(0) is 0; a few roundings */
            fracas_record_clear(&record[l]);
        }
    }
}

static void a_batch_refuses_what_it_cannot_run(void **unused)
{
    fracas_spec spec = bar_reference(50, 1e4, 1e-6); /* h = 1 mm: too long for 300 MPa at G_c 100 */
    fracas_model *model;
    OWN(fracas_batch) batch;
    OK(fracas_model_create(&spec, &model));
    fracas_batch_options options = {.width = 4, .isa = FRACAS_ISA_BEST};
    FAILS(fracas_batch_create(model, 5, &options, &batch), FRACAS_USAGE,
          "4 lanes for 5 realizations");
    options.width = 3;
    assert_int_equal(fracas_batch_create(model, 2, &options, &batch), FRACAS_USAGE);
    assert_int_equal(fracas_batch_create(model, 9, &(fracas_batch_options){0}, &batch),
                     FRACAS_USAGE);
    options.width = 0;
    OK(fracas_batch_create(model, 2, &options, &batch));
    for (size_t i = 0; i < 50; i++)
        for (size_t l = 0; l < 2; l++) bar_set_strength(batch, l, i, l == 1 && i == 30 ? 5e8 : 1e8);
    FAILS(fracas_batch_begin(batch), FRACAS_USAGE, "realization 1 of the batch, interface 30",
          "raise mesh.elements above 57"); /* L sigma_c^2/(2 beta E G_c) = 56.8 */
    bar_set_strength(batch, 1, 30, -1);
    assert_int_equal(fracas_batch_begin(batch), FRACAS_USAGE);
    bar_set_strength(batch, 1, 30, 1e-200); /* its square is 0 */
    OK(fracas_batch_begin(batch));
    fracas_model_destroy(model);
    spec.time.end = 1e20;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "time steps");
    spec.loading.type = &fracas_loading_centrifugal; /* has no answers for a chain */
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE,
          "model bar does not go with centrifugal");
}

TESTS(stop_at_a_set_time, quiet_waits_after_the_first_onset,
      history_keeps_intervals_onset_peak_and_end, the_ledger_adds_every_term,
      fragments_are_connected_elements, a_fragment_across_the_end_is_in_one_piece,
      fragments_are_sums_over_their_elements, nitsche_is_the_secant_law,
      a_run_that_gains_energy_ends_as_drift, events_are_counted_and_timed_inside_their_steps,
      the_part_of_bending_is_kept, a_batch_refuses_what_it_cannot_run)
