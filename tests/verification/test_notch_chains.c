/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bars and rings with an interface that is broken from the start (docs/theory/meshes.md). */
#include "tests/support/bar_state.h"
#include "tests/support/ring.h"
#include "tests/support/test.h"

static fracas_spec free_bar(int64_t elements, double length, int law)
{
    fracas_spec spec = bar_reference(elements, 2e4, 1);
    set_ends(&spec, ENDS_FREE, NAN);
    spec.geometry.length = length;
    set_listed_law(&spec, law);
    return spec;
}

/* Strengths by their place in the half: the same in both. */
static void strengthen(fracas_batch *batch, size_t half)
{
    for (size_t i = 0; i < batch->model->interfaces; i++)
        bar_set_strength(batch, 0, i, 300e6 + 1e6 * (double)((i % half) * 7 % 13));
}

/* A free bar cut in the middle is two free bars of half its length: energies, crack for crack. Both
 * halves fly apart, so that they never touch. Round-off: the halves' elements are displaced by the
 * rigid motion of their halves, rate t L/4, besides; relative to their stretch that is 40 in 1e3
 * steps: 1e-11. */
static void a_cut_bar_is_two_bars(void **unused)
{
    enum { HALF = 100 };
    for (int law = 0; law < BAR_LAWS; law++) {
        fracas_spec of_whole = free_bar(2 * HALF, 0.05, law), of_half = free_bar(HALF, 0.025, law);
        of_whole.notch = (fracas_notch){.from = {0.0249}, .to = {0.0251, NAN, NAN}};
        OWN(fracas_model) whole = make_model(&of_whole);
        OWN(fracas_model) half = make_model(&of_half);
        assert_int_equal(whole->nnotch, 1);
        assert_int_equal(whole->notch[0], HALF - 1);
        whole->time_step = half->time_step;
        whole->spec.time.end = half->spec.time.end = 800 * half->time_step;
        OWN(fracas_batch) both = lane_of(whole, 0, 0, 0);
        OWN(fracas_batch) one = lane_of(half, 0, 0, 0);
        strengthen(both, HALF);
        strengthen(one, HALF);
        OK(fracas_batch_begin(both));
        OK(fracas_batch_begin(one));
        RECORD(two_halves);
        RECORD(single);
        double worst = 0;
        while (both->lane[0].running && one->lane[0].running) {
            step(both, &two_halves);
            step(one, &single);
            if (both->step.cracked[0] == 0)
                worst = fmax(worst, fabs(both->step.elastic[0] / 2 - one->step.elastic[0]) /
                                        (one->step.elastic[0] + 1e-9));
        }
        print_message("[  figures ] %s: elastic energy within %.1e until the first onset, %d "
                      "breaks, %d fragments\n",
                      of_whole.cohesive.law->name, worst, (int)two_halves.broken,
                      (int)two_halves.fragments);
        assert_true(worst < 1e-11 && single.broken > 2);
        assert_int_equal(two_halves.broken, 2 * single.broken);
        assert_int_equal(two_halves.cracked, 2 * single.cracked);
        assert_int_equal(two_halves.fragments, 2 * single.fragments);
        assert_close(two_halves.onset_time, single.onset_time, 1e-11);
        assert_close(two_halves.dissipated, 2 * single.dissipated, 1e-9);
        assert_close(two_halves.growth, single.growth, 1e-12);
        const fracas_interface_row *cut = &two_halves.interface[HALF - 1];
        assert_true(cut->damage == 1 && isnan(cut->onset_time) && cut->break_time == 0);
    }
}

/* Less than two steps after its first onset a cut bar has as many fragments as at the start: no
 * growth, and the load has broken nothing. */
static void parts_of_the_start_are_no_growth(void **unused)
{
    fracas_spec spec = free_bar(200, 0.05, 0);
    spec.notch = (fracas_notch){.from = {0.0249}, .to = {0.0251, NAN, NAN}};
    double onset = NAN;
    for (int again = 0; again < 2; again++) {
        OWN(fracas_model) model = make_model(&spec);
        OWN(fracas_batch) batch = begun_with(model, 300e6);
        model->spec.time.end = again ? onset + 0.5 * model->time_step : 400 * model->time_step;
        RECORD(record);
        while (batch->lane[0].running) step(batch, &record);
        onset = record.onset_time;
        if (!again) continue;
        assert_int_equal(record.outcome, FRACAS_INTACT);
        assert_int_equal(record.fragments, 2);
        assert_true(record.cracked > 0 && record.broken == 0 && record.growth == 0);
    }
}

/* Residual by the dissipated energy of a ring, cut at the angle 0 or whole. */
static double open_ring(fracas_spec spec, bool cut)
{
    if (cut)
        spec.notch = (fracas_notch){.from = {0.9 * RING_RADIUS},
                                    .to = {1.1 * RING_RADIUS, NAN, NAN}};
    one_run run = make_run(make_model(&spec), 1, 300e6);
    const size_t last = run.model->interfaces - 1;
    bar_draw(run.batch, 0, 0.2, 1);
    OK(fracas_batch_begin(run.batch));
    step_run(&run);
    assert_true(run.batch->lane[0].ledger.dissipated == 0);
    finish_run(&run);
    const fracas_record *r = &run.record;
    const double residual = r->residual / r->dissipated;
    print_message("[  figures ] %s: %d breaks, %d fragments, residual %.1e of the dissipated\n",
                  spec.cohesive.law->name, (int)r->broken, (int)r->fragments, residual);
    assert_true(r->broken > 10 && r->onset_time > 0);
    assert_int_equal(r->fragments, r->broken + cut);
    if (cut) {
        assert_int_equal(run.model->nnotch, 1);
        assert_int_equal(run.model->notch[0], last);
        assert_true(r->interface[last].break_time == 0 && isnan(r->interface[last].onset_time));
    }
    clear_run(&run);
    return residual;
}

/* A cut ring has a fragment more than breaks, and the ledger leaves the cut out: it is as good as
 * that of the whole ring, whose breaks are others. */
static void a_cut_ring_opens(void **unused)
{
    for (int which = 0; which < 2; which++) {
        const fracas_spec spec = which ? ring_stershic(1000, 1e4, 2e-6)
                                       : ring_reference(1000, 1e4, 2e-6);
        const double whole = open_ring(spec, false), cut = open_ring(spec, true);
        assert_true(cut < 2 * whole);
    }
}

TESTS(a_cut_bar_is_two_bars, parts_of_the_start_are_no_growth, a_cut_ring_opens)
