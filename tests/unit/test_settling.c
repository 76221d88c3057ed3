/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* How final a count is: clock and growth from counts, energies of fragments from states made by
 * hand, the rule (docs/theory/settled.md). */
#include "engine/formulation/chain/bar_sweep.h"
#include "engine/formulation/chain/chain.h"
#include "engine/formulation/chain/ring_sweep.h"
#include "tests/support/membrane_cracks.h"
#include "tests/support/ring.h"

/* One fragment a step of 1 s: a look at each of 2^(j/8) s, or at the first step behind. */
static void growth_is_that_of_the_last_half(void **unused)
{
    const fracas_model model = {.time_step = 1, .wave_speed = 3};
    fracas_settling settling = {0};
    int64_t looks = 0;
    for (int64_t t = 1; t <= 1024; t++) {
        const fracas_census census = {.all = t + 7, .held = 7, .size = 0.5};
        if (!fracas_settling_due(&settling, (double)t, 1)) continue;
        fracas_settling_look(&settling, &model, (double)t, &census);
        looks++;
        if ((t & (t - 1)) == 0 && t > 1) assert_true(settling.growth == 0.5);
        assert_true(settling.transits == 6.0 * (double)t);
    }
    assert_true(looks > 50 && settling.looks == 81); /* 8 looks in each of ten doublings, and one */
    /* 1500/2 = 750: the last look until then was due at 2^9.5 = 724.08, at step 725 */
    fracas_settling_look(&settling, &model, 1448.2, &(fracas_census){1449, 0, 0.5});
    fracas_settling_look(&settling, &model, 1500, &(fracas_census){1500, 0, 0.5});
    assert_true(fabs(settling.growth - (1 - 725.0 / 1500)) < 1e-15);
    fracas_settling_look(&settling, &model, 1600, &(fracas_census){5, 5, NAN});
    assert_true(isnan(settling.growth) && isnan(settling.transits));
}

/* Two costs of 2 and 4 J against energies of 1 to 7 J; then parts flying apart. */
static void energies_pay_for_breaks(void **unused)
{
    fracas_rest rest = {0};
    double cost[] = {4, 2};
    fracas_rest_add(&rest, 1, cost, 2, 0.5);
    assert_true(rest.mean == 0 && rest.bound == 0);
    fracas_rest_add(&rest, 2.2, cost, 2, 0.5); /* it pays, and yet nothing breaks below 1.2 */
    assert_true(rest.mean == 0 && rest.bound == 1);
    rest.bound = 0;
    fracas_rest_add(&rest, 5, cost, 2, 0.5);
    const double first = 1 - exp(-(2.5 - 1.2) / 3.5), second = 1 - exp(-(3.5 - 1.2) / 3.5);
    assert_true(fabs(rest.mean - first) < 1e-15 && rest.bound == 1);
    fracas_rest_add(&rest, 7, cost, 2, 0.5);
    assert_true(fabs(rest.mean - first - second) < 1e-15 && rest.bound == 3);
    assert_true(fabs(rest.variance - first * (1 - first) - second * (1 - second)) < 1e-15);
    fracas_rest_add(&rest, 0, cost, 0, 0); /* a fragment of one element */
    fracas_rest_add(&rest, 1, cost, 2, 1.01);
    assert_true(fabs(rest.mean - first - second - 1) < 1e-15 && rest.bound == 3);
}

/* ---- chains ---- */

enum { N = 10 };
static const double rate = 1e4, later = 3e-5, thrown = 1000, damage = 0.75; /* 1/s, s, m/s, 1 */

/* A closed bar of two fragments, elements 0 to 4 and 5 to 9, which have flown off at `thrown` while
 * the background stretched by 0.3. Interface 2 has `damage`, its two sides part with `parting`, and
 * nodes of elements go to and fro with `shaking` [m/s]. Velocities of the laboratory are these. */
static one_run bar_of_two(double parting, double shaking)
{
    fracas_spec spec = bar_reference(N, rate, 1e-6);
    spec.geometry.length = 1e-4 * N;
    one_run run = make_run(make_model(&spec), 1, 300e6);
    OK(fracas_batch_begin(run.batch));
    fracas_step *step = &run.batch->step;
    const fracas_model *model = run.model;
    step->time[0] = later;
    for (size_t e = 0; e < N; e++) {
        const double fly = e < 5 ? thrown + (e > 2 ? parting : 0) : -thrown;
        *fracas_chain_field(model, step, e, BAR_DAMAGE, 0) = e == 2 ? damage : e == 4 || e == 9;
        for (int side = 0; side < 2; side++) {
            const double pulled = rate * 1e-4 * (double)(e + (size_t)side);
            *fracas_chain_field(model, step, e, BAR_V_LEFT + side,
                                0) = fly + (side ? shaking : -shaking) - pulled;
            *fracas_chain_field(model, step, e, BAR_W_LEFT + side, 0) = (fly - pulled) * later;
        }
    }
    step->broken[0] = 2;
    return run;
}

static fracas_rest rest_of(one_run *run, double *vibrating)
{
    const fracas_ledger ledger = {0};
    fracas_rest rest;
    OK(fracas_settling_energies(run->model, &run->batch->step, 0, &ledger, vibrating, &rest));
    return rest;
}

/* m per element, cost (1 - D) G_c A: with V^2 = 2 x cost/mu, mu = 6/5 m, the energy is x costs,
 * and 0.8 of them without the background between the parts for x = 1.2. Rounding: velocities of 1e3
 * m/s leave 1e-13 of those of 10 m/s. */
static void parts_that_fly_apart_will_break(void **unused)
{
    const double mass = 2750 * 1e-6 * 1e-4, cost = (1 - damage) * 100 * 1e-6;
    for (int apart = 0; apart < 2; apart++) {
        const double times = apart ? 1.2 : 0.9;
        one_run run = bar_of_two(sqrt(2 * times * cost / (1.2 * mass)), 0);
        double vibrating;
        const fracas_rest rest = rest_of(&run, &vibrating);
        assert_true(fabs(vibrating / (times * cost) - 1) < 1e-10);
        assert_true(rest.mean == apart && rest.bound == apart && rest.variance == 0);
        clear_run(&run);
    }
}

/* Parts that approach each other have energy to break with, as any vibration. */
static void parts_that_approach_may_break(void **unused)
{
    const double mass = 2750 * 1e-6 * 1e-4, cost = (1 - damage) * 100 * 1e-6;
    one_run run = bar_of_two(-sqrt(2 * 3 * cost / (1.2 * mass)), 0);
    double vibrating;
    assert_true(fabs(rest_of(&run, &vibrating).mean - (1 - exp(-(3 - 1.2) / 3.5))) < 1e-9);
    clear_run(&run);
}

/* The same energy as vibration: elements of both fragments shake, each with m u^2/2. */
static void parts_that_vibrate_may_break(void **unused)
{
    const double mass = 2750 * 1e-6 * 1e-4, cost = (1 - damage) * 100 * 1e-6, e = 3;
    one_run run = bar_of_two(0, sqrt(2 * e * cost / (5 * mass)));
    double vibrating;
    const fracas_rest rest = rest_of(&run, &vibrating);
    const double breaks = 1 - exp(-(e - 1.2) / 3.5);
    assert_true(fabs(vibrating / (2 * e * cost) - 1) < 1e-10);
    assert_true(fabs(rest.mean - breaks) < 1e-9 && rest.bound == 1); /* the other one's cost 4 */
    assert_true(fabs(rest.variance - breaks * (1 - breaks)) < 1e-9);
    clear_run(&run);
}

/* Flying and spinning fragments of a ring have nothing to break with. */
static void rigid_motion_is_no_energy(void **unused)
{
    fracas_spec spec = ring_reference(N, 1e4, 1e-6);
    spec.geometry.radius = 1e-3;
    one_run run = make_run(make_model(&spec), 1, 300e6);
    OK(fracas_batch_begin(run.batch));
    fracas_step *step = &run.batch->step;
    const double radius = run.model->element_size / (2 * sin(M_PI / N)); /* of the nodes */
    for (size_t e = 0; e < N; e++) {
        *fracas_chain_field(run.model, step, e, RING_DAMAGE, 0) = e == 3 ? 0.5 : e == 1 || e == 6;
        for (size_t side = 0; side < 2; side++) {
            const double *table = run.model->table + (e + side) % N * RING_TABLE;
            const double spin = e > 1 && e < 7 ? 1e6 : 0;
            double *v = fracas_chain_field(run.model, step, e, RING_V_LEFT + 2 * (int)side, 0);
            v[0] = 100 - spin * radius * table[RING_SIN];
            v[step->lanes] = -50 + spin * radius * table[RING_COS];
        }
    }
    step->broken[0] = 2;
    double vibrating;
    const fracas_rest rest = rest_of(&run, &vibrating);
    /* velocities are rounded to 1e-16 of radius spin, energies to its square and more for sums */
    const double kinetic = 0.5 * run.model->mass * 1e12 * radius * radius;
    assert_true(fabs(vibrating) < 1e-25 * kinetic && rest.mean == 0 && rest.bound == 0);
    clear_run(&run);
}

/* A ring of two fragments that shake; its zone bars all interfaces but one, which is broken. */
static void barred_interfaces_never_break(void **unused)
{
    for (int barred = 0; barred < 2; barred++) {
        fracas_spec spec = ring_stershic(N, 1e4, 1e-6);
        one_run run = make_run(make_model(&spec), 1, 300e6);
        OK(fracas_batch_begin(run.batch));
        fracas_step *step = &run.batch->step;
        for (size_t e = 0; e < N; e++) {
            *fracas_chain_field(run.model, step, e, RING_DAMAGE, 0) = e == 1 || e == 6;
            *fracas_chain_field(run.model, step, e, RING_LAW, 0) = e == 1 || e == 6 ? RING_LINK_OPEN
                                                                   : barred ? RING_LINK_BARRED
                                                                            : RING_LINK_CLOSED;
            const double *table = run.model->table + e * RING_TABLE;
            for (size_t side = 0; side < 2; side++) {
                double *v = fracas_chain_field(run.model, step, e, RING_V_LEFT + 2 * (int)side, 0);
                v[0] = (e % 2 ? 1e3 : -1e3) * table[RING_COS];
                v[step->lanes] = (e % 2 ? 1e3 : -1e3) * table[RING_SIN];
            }
        }
        step->broken[0] = 2;
        double vibrating;
        const fracas_rest rest = rest_of(&run, &vibrating);
        assert_true(vibrating > 0 && (barred ? rest.mean == 0 && rest.bound == 0
                                             : rest.mean > 0.9 && rest.bound > 1));
        clear_run(&run);
    }
}

static void nothing_is_known_before_a_break(void **unused)
{
    const fracas_spec spec = bar_reference(N, rate, 1e-6);
    one_run run = make_run(make_model(&spec), 1, 100e6);
    OK(fracas_batch_begin(run.batch));
    double vibrating;
    assert_true(isnan(rest_of(&run, &vibrating).mean));
    clear_run(&run);
}

/* ---- the rule ---- */

static void settled_asks_for_all_three_at_a_look(void **unused)
{
    const fracas_time rule = {
        .stop = &fracas_stop_settled, .end = 10, .transits = 20, .growth = 0.03, .rest = 0.02};
    const fracas_progress met = {.time = 1,
                                 .cracked = 3,
                                 .broken = 2,
                                 .look = true,
                                 .transits = 20,
                                 .growth = 0.03,
                                 .rest = 0.02};
    fracas_progress now = met;
    fracas_stop stop = {0};
    fracas_outcome outcome;
    assert_true(fracas_stop_check(&stop, &rule, &now, &outcome) && outcome == FRACAS_FRAGMENTED);
    const fracas_progress missed[] = {
        {1, 0, 0, 3, 0, true, 20, 0.03, 0.02},   {1, 0, 0, 3, 2, false, 20, 0.03, 0.02},
        {1, 0, 0, 3, 2, true, 19.9, 0.03, 0.02}, {1, 0, 0, 3, 2, true, 20, 0.031, 0.02},
        {1, 0, 0, 3, 2, true, 20, 0.03, 0.021},  {1, 0, 0, 3, 2, true, NAN, 0.03, 0.02},
        {1, 0, 0, 3, 2, true, 20, NAN, 0.02},
    };
    for (size_t i = 0; i < FRACAS_COUNT(missed); i++) {
        now = missed[i];
        assert_false(fracas_stop_check(&stop, &rule, &now, &outcome));
        now.time = 10;
        assert_true(fracas_stop_check(&stop, &rule, &now, &outcome) &&
                    outcome == FRACAS_TIME_LIMIT);
    }
}

/* ---- held fragments ---- */

/* A plate of single elements: an edge moved by the load holds its own, a sliding edge only where
 * its normal velocity, rate x, is not 0. */
static void pieces_of_a_moving_edge_are_held(void **unused)
{
    const fracas_kind *const edges[] = {&fracas_edge_held, &fracas_edge_sliding, &fracas_edge_fixed,
                                        &fracas_edge_free};
    for (int kind = 0; kind < 4; kind++) {
        fracas_spec spec = brittle_plate(1, 5, 1e4, 1e-6);
        hold_edges(&spec, edges[kind]);
        one_run run = begin_run(make_model(&spec), 1, 300e6);
        const fracas_surface *mesh = run.model->surface;
        fracas_step *step = &run.batch->step;
        fracas_census census;
        OK(run.model->formulation->count(run.model, step, 0, &census));
        assert_true(census.all == 1 && census.held == 0);
        for (size_t i = 0; i < run.model->interfaces; i++) break_interface(run.batch, i);
        step->broken[0] = (int64_t)run.model->interfaces;
        OWNED bool *held = zeroed(mesh->nelements, 1);
        for (size_t b = 0; b < mesh->nborders; b++) {
            const uint32_t e = mesh->border[b].element, k = mesh->border[b].edge;
            const int normal = mesh->border[b].tag <= 2 ? 0 : 1; /* x, y */
            const bool pulled = fracas_surface_node(mesh, e, k)[normal] != 0 ||
                                fracas_surface_node(mesh, e, (k + 1) % 3)[normal] != 0;
            held[e] = held[e] || kind == 0 || (kind == 1 && pulled);
        }
        double area = 0;
        int64_t count = 0;
        for (size_t e = 0; e < mesh->nelements; e++) {
            count += held[e];
            area += held[e] ? 0 : mesh->area[e];
        }
        OK(run.model->formulation->count(run.model, step, 0, &census));
        assert_true(census.all == (int64_t)mesh->nelements && census.held == count);
        assert_true(fabs(census.size / sqrt(area / (double)(census.all - count)) - 1) < 1e-12);
        assert_true((count > 0) == (kind < 2) && count < census.all);
        clear_run(&run);
    }
}

/* ---- runs ---- */

/* Eight bars ended by the rule meet it by their records; without the limit of the rest some end
 * earlier. */
static void runs_end_by_the_rule(void **unused)
{
    int64_t steps[2] = {0, 0};
    for (int ignore = 0; ignore < 2; ignore++) {
        fracas_spec spec = bar_reference(800, 1e5, 4e-6);
        spec.geometry.length = 4e-3;
        spec.time.stop = &fracas_stop_settled;
        spec.time.transits = 20;
        spec.time.growth = 0.03;
        spec.time.rest = ignore ? 1 : 0.02;
        OWN(fracas_model) model = make_model(&spec);
        fracas_record record[8];
        for (int l = 0; l < 8; l++) fracas_record_init(&record[l]);
        run_replicas(model, 0, 8, 0.1, (fracas_batch_options){.isa = FRACAS_ISA_BEST}, record);
        for (int l = 0; l < 8; l++) {
            const fracas_record *of = &record[l];
            steps[ignore] += of->steps;
            assert_true(of->rest_bound == floor(of->rest_bound) && of->rest_bound >= of->rest);
            assert_true(of->rest_variance <= of->rest && of->vibrating > of->elastic);
            if (of->outcome != FRACAS_TIME_LIMIT) {
                assert_true(of->outcome == FRACAS_FRAGMENTED && of->transits >= 20);
                assert_true(of->growth <= 0.03);
                assert_true(of->rest <= spec.time.rest * fmax(15, (double)of->fragments));
            }
            fracas_record_clear(&record[l]);
        }
    }
    assert_true(steps[1] < steps[0]);
}

/* Bars of some seven fragments may still expect 0.3 of one, where 2 % would be half as many. */
static void few_fragments_may_expect_a_third(void **unused)
{
    fracas_spec spec = bar_reference(300, 3e3, 20e-6);
    spec.geometry.length = 6e-3;
    spec.time.stop = &fracas_stop_settled;
    spec.time.transits = 20;
    spec.time.growth = 0.03;
    spec.time.rest = 0.02;
    OWN(fracas_model) model = make_model(&spec);
    fracas_record record[16];
    int more = 0;
    for (int l = 0; l < 16; l++) fracas_record_init(&record[l]);
    for (int l = 0; l < 16; l += 8)
        run_replicas(model, l, 8, 0.1, (fracas_batch_options){.isa = FRACAS_ISA_BEST}, record + l);
    for (int l = 0; l < 16; l++) {
        const double count = (double)record[l].fragments;
        assert_true(count < 15);
        if (record[l].outcome == FRACAS_FRAGMENTED) assert_true(record[l].rest <= 0.3);
        more += record[l].outcome == FRACAS_FRAGMENTED && record[l].rest > 0.02 * count;
        fracas_record_clear(&record[l]);
    }
    assert_true(more > 0);
}

/* Looks are a factor 2^(1/8) of time apart; the count only grows, and k with it. A break between
 * the last two looks moves k by its share of the count, at most 2 % here. */
static void transits_end_runs_at_a_stated_k(void **unused)
{
    const double wanted[] = {10, 40};
    fracas_record record[2][8];
    for (int w = 0; w < 2; w++) {
        fracas_spec spec = bar_reference(800, 1e5, 4e-6);
        spec.geometry.length = 4e-3;
        spec.time.stop = &fracas_stop_transits;
        spec.time.transits = wanted[w];
        OWN(fracas_model) model = make_model(&spec);
        for (int l = 0; l < 8; l++) fracas_record_init(&record[w][l]);
        run_replicas(model, 0, 8, 0.1, (fracas_batch_options){.isa = FRACAS_ISA_BEST}, record[w]);
        for (int l = 0; l < 8; l++) {
            const double k = record[w][l].transits;
            assert_int_equal(record[w][l].outcome, FRACAS_FRAGMENTED);
            assert_true(k >= wanted[w] && k < wanted[w] * pow(2, 0.125) * 1.02);
        }
    }
    for (int l = 0; l < 8; l++) {
        assert_true(record[1][l].end_time > 3 * record[0][l].end_time);
        for (int w = 0; w < 2; w++) fracas_record_clear(&record[w][l]);
    }
}

TESTS(growth_is_that_of_the_last_half, energies_pay_for_breaks, parts_that_fly_apart_will_break,
      parts_that_approach_may_break, parts_that_vibrate_may_break, rigid_motion_is_no_energy,
      barred_interfaces_never_break, nothing_is_known_before_a_break,
      settled_asks_for_all_three_at_a_look, pieces_of_a_moving_edge_are_held, runs_end_by_the_rule,
      few_fragments_may_expect_a_third, transits_end_runs_at_a_stated_k)
