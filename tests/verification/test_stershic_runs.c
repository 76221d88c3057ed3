/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stershic's algorithm (docs/theory/ring.md) in whole runs: isolated link, clock, bulk damage,
 * ledger, energy guard, momentum. */
#include "tests/support/lanes.h"
#include "tests/support/stershic.h"
#include "tests/support/test.h"

#define PI 3.14159265358979323846

typedef struct {
    double broke, opening; /* relative errors of break time and of the opening until then */
} crack_errors;

/* One weak link in a ring under held radial velocity; far from it the ring is the bar, whose
 * isolated crack opens as delta = 2 c rate t0^2 (e^x - 1 - x). The ring is longer than its release
 * waves run until the break, x_b s0. A full break costs G_c A, whichever of G_c and delta_c is
 * given. */
static crack_errors isolated_link(double rate, double x_b, int elements_per_s0, bool by_opening)
{
    const double sigma_c = 300e6, delta_c = 200 / sigma_c, onset = sigma_c / (YOUNG * rate);
    const int64_t n = (int64_t)ceil(1.2 * x_b * elements_per_s0) + 8;
    fracas_spec spec = ring_stershic(n, rate, onset + 1.2 * x_b * BAR_T0);
    spec.geometry.radius = (double)n * BAR_S0 / elements_per_s0 / (2 * PI);
    spec.cohesive.fracture_energy = by_opening ? 0 : 100;
    spec.cohesive.critical_opening = by_opening ? delta_c : 0;
    spec.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = rate};
    one_run run = make(&spec, 2.9e9);
    const size_t weak = (size_t)n / 3;
    bar_set_strength(run.batch, 0, weak, sigma_c);
    OK(fracas_batch_begin(run.batch));
    crack_errors errors = {0};
    while (run.running) {
        step_run(&run);
        const double x = (run.batch->step.time[0] - onset) / BAR_T0,
                     damage = *at(&run, weak, RING_DAMAGE);
        const double exact = 2 * BAR_WAVE_SPEED * rate * BAR_T0 * BAR_T0 * (exp(x) - 1 - x);
        /* relative to delta_c/10 where the opening is smaller than that: both vanish at onset */
        if (x > 0 && damage < 1)
            errors.opening = fmax(errors.opening,
                                  fabs(damage * delta_c - exact) / fmax(exact, 0.1 * delta_c));
    }
    assert_int_equal(run.record.cracked, 1);
    assert_int_equal(run.record.broken, 1);
    const fracas_interface_row *row = &run.record.interface[weak];
    /* stress is E rate t, the pull cos(pi/n) of it; within the step the onset is interpolated
     * without that factor */
    const double part = cos(PI / (double)n);
    assert_true(fabs(row->onset_time * part / onset - 1) <
                1e-9 + (1 - part) * run.model->time_step / onset);
    errors.broke = fabs((row->break_time - onset) / (x_b * BAR_T0) - 1);
    assert_true(fabs(run.record.dissipated / (spec.geometry.area * 100) - 1) <
                1e-15); /* sigma_c (2 G_c/sigma_c)/2: 2 roundings */
    clear_run(&run);
    return errors;
}

/* Both errors are second order (a link opens up to a time step late, when it has hardly any load to
 * miss): measured, a halving of h divides them by 2.7 to 3.7; 2 is asked. What a ring has beyond
 * the bar is smaller than that: with a thousandth of the strains (E and rho a thousand times as
 * large) the errors at h = s0/160 are the same to 6e-6. */
static void one_weak_link_opens_as_the_closed_form(void **unused)
{
    const struct {
        double rate, x_b, broke,
            opening; /* bounds at h = s0/160, about half as much again as measured */
    } cases[] = {{1e4, 1.86120, 1.1e-4, 7e-4}, {1e5, 0.740993, 1.5e-4, 1.5e-3}};
    for (int i = 0; i < 2; i++) {
        crack_errors last = {1, 1};
        for (int m = 20; m <= 160; m *= 2) {
            const crack_errors e = isolated_link(cases[i].rate, cases[i].x_b, m, false);
            const crack_errors other = isolated_link(cases[i].rate, cases[i].x_b, m, true);
            print_message(
                "[  figures ] rate %.0e, h = s0/%d: break time error %.2e, opening error %.2e\n",
                cases[i].rate, m, e.broke, e.opening);
            assert_true(e.broke < 0.5 * last.broke && e.opening < 0.5 * last.opening);
            assert_true(fabs(other.broke - e.broke) < 1e-10 &&
                        fabs(other.opening - e.opening) < 1e-10);
            last = e;
        }
        assert_true(last.broke < cases[i].broke && last.opening < cases[i].opening);
    }
}

/* With one strength for all, delta_c = 2 G_c/sigma_c is the same number either way: runs are the
 * same to the last bit. With several strengths they are not. */
static void one_strength_needs_no_choice_of_parameters(void **unused)
{
    for (int several = 0; several < 2; several++)
        for (int zone = 0; zone < 2; zone++) {
            one_run run[2];
            for (int by_opening = 0; by_opening < 2; by_opening++) {
                fracas_spec spec = ring_stershic(300, 1e4, 8e-7);
                spec.cohesive.own[ZONE] = zone * 3.5 * RING_CIRCUMFERENCE / 300;
                if (by_opening) {
                    spec.cohesive.fracture_energy = 0;
                    spec.cohesive.critical_opening = 2.0 * 100 / 300e6;
                }
                run[by_opening] = make(&spec, 300e6);
                if (several) bar_draw(run[by_opening].batch, 0, 0.05, 0);
                OK(fracas_batch_begin(run[by_opening].batch));
                finish_run(&run[by_opening]);
            }
            assert_true(run[0].record.broken > 20);
            if (several) assert_true(run[0].record.dissipated != run[1].record.dissipated);
            else assert_same_record(&run[0].record, &run[1].record);
            clear_run(&run[0]);
            clear_run(&run[1]);
        }
}

/* The time steps of a run are base xi^k, k = 0, 1, 2, all of which happen; the clock is their sum:
 * the solver's products of equal steps are good to an ulp each time the step changes, the sum in
 * long double to 1e-19. */
static void the_clock_adds_up(void **unused)
{
    fracas_spec spec = ring_stershic(1250, 1e4, 6e-7);
    spec.cohesive.own[REFINEMENT] = 0.3;
    one_run run = make(&spec, 300e6);
    bar_draw(run.batch, 0, 1.0 / 300, 0);
    OK(fracas_batch_begin(run.batch));
    const double base = run.model->time_step, steps[3] = {base, base * 0.3, base * 0.3 * 0.3};
    long double sum = 0;
    int64_t seen[3] = {0}, changes = 1;
    double planned = 0, last = 0;
    while (run.running) {
        step_run(&run);
        const double drift = run.batch->step.drift[0];
        assert_true(drift == planned);
        sum += (long double)drift;
        planned = run.batch->step.next[0];
        changes += planned != last;
        last = planned;
        int found = 0;
        for (int k = 0; k < 3; k++) {
            seen[k] += planned == steps[k];
            found += planned == steps[k];
        }
        assert_int_equal(found, 1);
        assert_true(fabs((double)(sum - (long double)run.batch->step.time[0])) <=
                    3e-16 * (double)changes * (double)sum);
    }
    print_message(
        "[  figures ] %ld steps of the base, %ld of xi, %ld of xi^2, in %ld runs of equal ones\n",
        (long)seen[0], (long)seen[1], (long)seen[2], (long)changes);
    assert_true(seen[0] > 0 && seen[1] > 0 && seen[2] > 0);
    assert_int_equal(seen[0] + seen[1] + seen[2],
                     run.record.steps + 1); /* the record counts from the first one, at t = 0 */
    assert_true(run.record.end_time == run.batch->step.time[0] &&
                run.record.end_time >= spec.time.end);
    assert_true(run.record.end_time - run.batch->step.drift[0] < spec.time.end);
    assert_true(run.record.time_step == base);
    clear_run(&run);
}

/* ---- bulk damage ---- */

/* What a test knows of one element. */
typedef struct {
    double strain, stress, largest, yield; /* eps_d < 0 before it is barred */
    double work,
        slack;    /* of its stress since then, by the trapezoid [J/m3]; what that may miss by */
    double start; /* energy when it was barred [J/m3] */
    int regime;
} watched;

/* (22) to (25) of the paper. */
static double bulk_stress(const watched *w)
{
    if (w->strain <= 0 || YOUNG * w->largest <= w->yield) return YOUNG * w->strain;
    return w->strain < w->largest ? w->yield / w->largest * w->strain : w->yield;
}

/* Strain from the places of the nodes, in long double. */
static double strain_of(const one_run *run, size_t e)
{
    const long double pi = 3.14159265358979323846264338L, h = run->h,
                      angle = pi * (long double)(2 * e + 1) / (long double)run->n;
    const long double x = (long double)*at(run, e, RING_U_RIGHT) - *at(run, e, RING_U_LEFT) -
                          h * sinl(angle);
    const long double y = (long double)*at(run, e, RING_U_RIGHT + 1) -
                          *at(run, e, RING_U_LEFT + 1) + h * cosl(angle);
    return (double)(sqrtl(x * x + y * y) / h - 1);
}

/* One element, one step on, from what the test knew of it. Stress is linear in the strain but for
 * one corner a step at most, where the trapezoid misses E (change of strain)^2/2 or less. */
static void watch_element(const one_run *run, size_t e, watched *w)
{
    const watched before = *w;
    w->strain = strain_of(run, e);
    w->largest = fmax(w->largest, w->strain);
    w->stress = bulk_stress(w);
    w->regime = w->strain <= 0                  ? 0
                : w->strain < w->largest        ? 1
                : YOUNG * w->strain <= w->yield ? 2
                                                : 3;
    const double moved = w->strain - before.strain;
    w->work += 0.5 * (w->stress + before.stress) * moved;
    w->slack += w->regime == before.regime ? 0 : 0.5 * YOUNG * moved * moved;
    /* 1e-19 of positions of 8 mm, by h = 0.25 mm; the engine's own 2e-16 of 1e-3: 1e-13 of the
     * yield strain leaves room */
    assert_true(fabs(*at(run, e, RING_STRAIN) - w->largest) < 1e-12 * w->yield / YOUNG);
    assert_true(fabs(*at(run, e, RING_STRESS) - w->stress) <
                1e-12 * w->yield + 1e-12 * YOUNG * fabs(w->strain));
}

enum { N = 200, WEAK = 50 };

/* Under imposed rate until its weak link has just opened and barred all others. */
static one_run barred_ring(void)
{
    fracas_spec spec = ring_stershic(N, 1e4, 3e-6);
    spec.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = 1e4};
    spec.cohesive.own[ZONE] = 1;
    spec.time.safety = 0.1;
    one_run run = make(&spec, 300e6);
    for (size_t i = 0; i < N; i++)
        bar_set_strength(run.batch, 0, i, i == WEAK ? 300e6 : 310e6 + 1e5 * (double)((i * 37) % N));
    OK(fracas_batch_begin(run.batch));
    while (!run.batch->step.cracked[0]) step_run(&run);
    return run;
}

/* A ring under imposed rate with one weak link, that bars every other one: elements yield, each at
 * the mean of its links' strengths, until the release wave of the weak link arrives. The test
 * follows each of them by the paper's equations. What the stress does on an element, integrated by
 * the test, is what it stores and dissipates (ring.17). */
static void a_barred_ring_yields(void **unused)
{
    one_run run = barred_ring();
    static watched element[N];
    for (size_t e = 0; e < N; e++) {
        watched *w = &element[e];
        *w = (watched){.strain = strain_of(&run, e), .regime = 2};
        const bool free = e == WEAK || e == WEAK + 1;
        w->yield = free ? INFINITY
                        : 0.5 * (*at(&run, e, RING_STRENGTH) + *at(&run, e + N - 1, RING_STRENGTH));
        w->stress = YOUNG * w->strain;
        w->largest = w->strain;
        assert_true(free ? *at(&run, e, RING_STRAIN) == -1
                         : fabs(*at(&run, e, RING_STRAIN) - w->largest) < 1e-15);
        w->start = 0.5 * w->stress * w->strain;
    }
    int64_t seen[4] = {0};
    double deepest = 0;
    while (run.running) {
        step_run(&run);
        for (size_t e = 0; e < N; e++) {
            if (e == WEAK || e == WEAK + 1) continue;
            watch_element(&run, e, &element[e]);
            const double d = 1 - element[e].yield / (YOUNG * element[e].largest);
            if (d > 0) seen[element[e].regime]++;
            if (d > 0 && element[e].regime == 1) deepest = fmax(deepest, d);
        }
    }
    const double area = run.model->spec.geometry.area, volume = area * run.h;
    double dissipated = area * 100 * *at(&run, WEAK, RING_DAMAGE), slackest = 0, missed = 0;
    for (size_t e = 0; e < N; e++) {
        const watched *w = &element[e];
        if (e == WEAK || e == WEAK + 1) continue;
        const double d = fmax(0, 1 - w->yield / (YOUNG * w->largest)),
                     lost = w->yield * w->yield / (2 * YOUNG) * d / (1 - d);
        dissipated += volume * lost;
        assert_true(fabs(w->stress * w->strain / 2 + lost - w->start - w->work) <
                    w->slack + 1e-10 * w->start);
        slackest = fmax(slackest, w->slack / (lost + w->start));
        missed = fmax(missed, fabs(w->stress * w->strain / 2 + lost - w->start - w->work) /
                                  (lost + w->start));
    }
    const fracas_record *r = &run.record;
    print_message("[  figures ] %ld element-steps yield, %ld unload, %ld in compression; D to "
                  "%.3f; dissipated %.4e J, work %.4e J, residual %.1e\n",
                  (long)seen[3], (long)seen[1], (long)seen[0], deepest, r->dissipated, r->work,
                  r->residual);
    print_message("[  figures ] stored and dissipated differ from the work of the stress by %.1e, "
                  "of %.1e allowed\n",
                  missed, slackest);
    assert_true(slackest < 0.05);
    assert_int_equal(r->cracked, 1);
    assert_true(r->created == 0);
    assert_true(seen[3] > 1000 && seen[1] > 1000 && deepest > 0.5);
    assert_true(fabs(r->dissipated / dissipated - 1) < 1e-11);
    assert_true(r->dissipated > 100 * area * 100); /* it is the bulk's, not the link's */
    assert_true(r->residual < 1e-4 * r->work);
    clear_run(&run);
}

/* ---- ledger, guard, momentum ---- */

/* |residual| by the largest energy, the largest of the steps that the guard looks at. */
static double residual_of(one_run *run)
{
    double worst = 0;
    while (run->running) {
        step_run(run);
        const fracas_ledger *ledger = &run->batch->lane[0].ledger;
        const double held = ledger->elastic + ledger->cohesive + ledger->dissipated;
        const double scale = fmax(fmax(ledger->kinetic, held), fabs(ledger->work));
        if (run->batch->lane[0].steps > FRACAS_GUARD_START)
            worst = fmax(worst, fabs(ledger->residual) / scale);
    }
    return worst;
}

static one_run scattered(const fracas_spec *spec, double scatter, uint64_t replica)
{
    one_run run = make(spec, 300e6);
    bar_draw(run.batch, 0, scatter, replica);
    OK(fracas_batch_begin(run.batch));
    return run;
}

/* The reference ring at 1e4 /s, free and driven, with the paper's time step and with halves of it.
 * At 0.8 h/c the residual is 0.2 % of the kinetic energy, as links that close again on steep
 * secants are in neither critical zone; with a quarter of the step it is less than 1e-4 of the
 * dissipated energy, measured 2e-5. */
static void the_ledger_closes_as_the_time_step_falls(void **unused)
{
    for (int driven = 0; driven < 2; driven++) {
        double last = INFINITY;
        for (double safety = 0.8; safety > 0.15; safety *= 0.5) {
            fracas_spec spec = ring_stershic(1250, 1e4, 5e-7);
            spec.time.safety = safety;
            if (driven)
                spec.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = 1e4};
            one_run run = scattered(&spec, 1.0 / 300, 0);
            const double worst = residual_of(&run);
            const fracas_record *r = &run.record;
            print_message("[  figures ] %s, safety %.1f: residual %.1e J, %.1e of the largest "
                          "energy, %.1e of the dissipated\n",
                          driven ? "driven" : "free", safety, r->residual, worst,
                          r->residual / r->dissipated);
            assert_int_equal(r->outcome, FRACAS_FRAGMENTED);
            assert_true(worst < 5e-3 && r->residual < 0.5 * last);
            if (safety < 0.3) assert_true(r->residual < 1e-4 * r->dissipated);
            last = r->residual;
            clear_run(&run);
        }
    }
}

/* Contact a hundred times as stiff as an element, at a time step that is not refined, 0.8 h/c: 8
 * times beyond the stability of such a contact. The realization ends as ENERGY_DRIFT. So does one
 * without refinement on a mesh so coarse that all links open in one step, far beyond their
 * strengths: its residual is below 5 % of the largest energy, the expansion's, and above that of
 * the energy that breaks it. Refined, it goes on. */
static void the_energy_guard_ends_what_has_drifted(void **unused)
{
    double highest = 0;
    for (uint64_t replica = 0; replica < 8; replica++) {
        fracas_spec spec = ring_stershic(400, 1e4, 1.2e-6);
        spec.cohesive.own[REFINEMENT] = 1;
        spec.cohesive.own[PENALTY] = 100;
        one_run run = scattered(&spec, 1.0 / 30, replica);
        finish_run(&run);
        assert_int_equal(run.record.outcome, FRACAS_ENERGY_DRIFT);
        assert_true(run.record.end_time < 0.5 * spec.time.end);
        clear_run(&run);
        for (int refined = 0; refined < 2; refined++) {
            fracas_spec coarse = ring_stershic(refined ? 400 : 100, 1e4, 1.2e-6);
            if (!refined) coarse.cohesive.own[REFINEMENT] = 1;
            run = scattered(&coarse, 1.0 / 30, replica);
            highest = fmax(highest, residual_of(&run));
            assert_int_equal(run.record.outcome, refined ? FRACAS_FRAGMENTED : FRACAS_ENERGY_DRIFT);
            clear_run(&run);
        }
    }
    print_message("[  figures ] residual by the largest energy at most %.4f\n", highest);
    assert_true(highest < 0.05);
}

/* The paper's critical zones leave out links that close again on steep secants: with strengths from
 * 240 to 360 MPa some runs drift at its 0.8 h/c; none at a fourth of that, or with those links in
 * the first zone, where residuals stay below 1 % of the dissipated energy. */
static void the_papers_time_step_is_too_long_for_some(void **unused)
{
    const fracas_kind *zones[] = {&fracas_zone_softening, &fracas_zone_softening,
                                  &fracas_zone_steep};
    int drifted[3] = {0};
    double worst[3] = {0};
    for (int way = 0; way < 3; way++)
        for (uint64_t i = 0; i < 16; i++) {
            fracas_spec spec = ring_stershic(200, 2e4, 4e-7);
            spec.geometry.radius = 6e-3 / (2 * PI);
            spec.loading.radial = 2e4 * spec.geometry.radius;
            spec.loading.circumferential = 20;
            spec.cohesive.own[REFINEMENT] = 0.3;
            spec.cohesive.own_choice = zones[way];
            spec.cohesive.own[ZONE] = i % 2 ? 3.5 * 6e-3 / 200 : 0;
            spec.time.safety = way == 1 ? 0.2 : 0.8;
            one_run run = scattered(&spec, 0.2, i / 2);
            finish_run(&run);
            drifted[way] += run.record.outcome == FRACAS_ENERGY_DRIFT;
            worst[way] = fmax(worst[way], run.record.residual / run.record.dissipated);
            clear_run(&run);
        }
    print_message("[  figures ] of 16 runs at 0.8 h/c %d drift; at 0.2 %d, residuals to %.1e of "
                  "the dissipated energy; with steep links watched %d, %.1e\n",
                  drifted[0], drifted[1], worst[1], drifted[2], worst[2]);
    assert_true(drifted[0] > 0 && drifted[1] == 0 && drifted[2] == 0);
    assert_true(worst[1] < 1e-2 && worst[2] < 1e-2);
}

/* Linear momentum is that of the start, 0, and a ring that turns keeps its moment of momentum, but
 * for what open links of a radial jump p pass on, T p: less than 1e-7 of the momenta of the parts
 * times R, unless links keep the directions of the start while the ring turns, by 6e-4 here:
 * contact then pushes at that angle. */
static void momentum_is_kept(void **unused)
{
    for (int k = 0; k < 8; k++) {
        fracas_spec spec = ring_stershic(1250, 1e4, 5e-7);
        if (k & 1) spec.geometry.direction = &fracas_direction_initial;
        if (k & 2) spec.cohesive.own[ZONE] = 5.5 * RING_CIRCUMFERENCE / 1250;
        if (k & 4) spec.loading.circumferential = 10;
        one_run run = scattered(&spec, 1.0 / 300, 0);
        finish_run(&run);
        const double radius = run.h / (2 * sin(PI / 1250)), start = run.model->mass *
                                                                    spec.loading.circumferential *
                                                                    radius / RING_RADIUS * radius;
        double moment = 0, scale = 0, radial = 0;
        for (const fracas_fragment *f = run.record.fragment;
             f < run.record.fragment + run.record.nfragment; f++) {
            moment += f->angular_momentum[2] +
                      f->mass * (f->position[0] * f->velocity[1] - f->position[1] * f->velocity[0]);
            scale += f->mass * hypot(f->velocity[0], f->velocity[1]);
            radial += f->mass * hypot(f->position[0], f->position[1]);
        }
        const double momentum = hypot(run.record.momentum[0], run.record.momentum[1]),
                     drift = fabs(moment - start) / (scale * RING_RADIUS);
        print_message(
            "[  figures ] %s%s%s: %ld fragments, momentum %.1e, moment of momentum off by %.1e\n",
            k & 1 ? "initial" : "current", k & 2 ? ", zone" : "", k & 4 ? ", turning" : "",
            (long)run.record.fragments, momentum / scale, drift);
        assert_true(run.record.fragments > 20 && radial > 0.9 * run.record.mass * RING_RADIUS);
        /* 3000 steps of 2500 nodes, a rounding of 1e-16 each, in random directions */
        assert_true(momentum < 1e-14 * scale);
        assert_true(drift < (k == 5 || k == 7 ? 1e-5 : 1e-7));
        clear_run(&run);
    }
}

TESTS(one_weak_link_opens_as_the_closed_form, one_strength_needs_no_choice_of_parameters,
      the_clock_adds_up, a_barred_ring_yields, the_ledger_closes_as_the_time_step_falls,
      the_energy_guard_ends_what_has_drifted, the_papers_time_step_is_too_long_for_some,
      momentum_is_kept)
