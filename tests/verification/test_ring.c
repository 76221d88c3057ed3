/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring against exact solutions, and against the bar. */
#include "tests/support/ring.h"

#include "engine/formulation/chain/ring_sweep.h"
#include "tests/support/test.h"

#define YOUNG 275e9

/* One realization, every interface of this strength unless `strength` is NaN: then it is replica 0
 * of 0.33 %. */
static one_run start(const fracas_spec *spec, double strength)
{
    one_run run = make(spec, isnan(strength) ? BAR_STRENGTH_MEAN : strength);
    if (isnan(strength)) bar_draw(run.batch, 0, 1.0 / 300, 0);
    OK(fracas_batch_begin(run.batch));
    return run;
}

static fracas_spec either(int stershic, int64_t elements, double rate, double end)
{
    return stershic ? ring_stershic(elements, rate, end) : ring_reference(elements, rate, end);
}

/* sigma = (E rate/w) sin(w t), w = c/R: 109.4355 ns at 1e4 /s. The polygon's own w is 1 -
 * (pi/n)^2/6 times that, which moves the onset by 2 x 3.15e-3 (pi/n)^2/6 = 1e-8. Central difference
 * starts with the velocity of t = 0 half a step later, so that displacements are (w dt)^2/6 too
 * large: 1e-8 with nitsche, 4.2e-6 with Stershic's 0.8 h/c, whose links on the other hand feel
 * cos(pi/n) of the stress: 4.9e-6 later. Nitsche's interface feels the chords' forces along its own
 * direction, cos(pi/n) of them, which its stiffness passes on as beta/(beta - 1) (pi/n)^2/2
 * = 6.6e-6 at most. */
static void a_free_ring_cracks_at_the_exact_time(void **unused)
{
    for (int stershic = 0; stershic < 2; stershic++) {
        const fracas_spec spec = either(stershic, 1000, 1e4, 1.2e-7);
        one_run run = start(&spec, 300e6);
        finish_run(&run);
        const double w = BAR_WAVE_SPEED / RING_RADIUS, exact = asin(300e6 * w / (YOUNG * 1e4)) / w;
        print_message("[  figures ] onset %.6f ns, exact %.6f: relative difference %.1e\n",
                      1e9 * run.record.onset_time, 1e9 * exact, run.record.onset_time / exact - 1);
        assert_true(fabs(1e9 * exact - 109.4355) < 5e-5);
        assert_true(fabs(run.record.onset_time / exact - 1) < (stershic ? 1.5e-6 : 6.7e-6));
        clear_run(&run);
    }
}

/* Below sigma_c c/(E R) = 1371 /s the ring swings back. The polygon's highest stress is R_n/R = 1 +
 * (pi/n)^2/6 times the ring's. */
static void a_ring_below_the_critical_rate_stays_whole(void **unused)
{
    const double critical = 300e6 * BAR_WAVE_SPEED / (YOUNG * RING_RADIUS),
                 quarter = 0.5 * 3.14159265358979 * RING_RADIUS / BAR_WAVE_SPEED;
    assert_true(fabs(critical - 1371) < 0.5);
    for (int stershic = 0; stershic < 2; stershic++)
        for (int above = 0; above < 2; above++) {
            const fracas_spec spec = either(stershic, 500, (above ? 1.0002 : 0.9998) * critical,
                                            1.2 * quarter);
            one_run run = start(&spec, 300e6);
            finish_run(&run);
            assert_int_equal(run.record.outcome == FRACAS_INTACT && run.record.cracked == 0,
                             !above);
            if (above)
                assert_true(fabs(run.record.onset_time / quarter - 1) <
                            0.02); /* near the crest: acos(1/1.0002)/(pi/2) */
            clear_run(&run);
        }
}

/* An uncracked ring breathes: radial displacement v sin(w t)/w. Central difference has it exactly,
 * with sin(w' t) dt/sin(w' dt) and sin(w' dt/2) = w dt/2; hoop strain is linear in it whatever its
 * size, so what is left is the play of the interfaces, whose energy is (pi/n)^4 of the ring's,
 * 1e-10. */
static void an_uncracked_ring_breathes_as_a_sine(void **unused)
{
    fracas_spec spec = ring_reference(1000, 1e3, 3e-6);
    one_run run = start(&spec, 1e9);
    const double radius = run.model->element_size / (2 * sin(3.14159265358979323846 / 1000)),
                 w = BAR_WAVE_SPEED / radius;
    const double dt = run.model->time_step, v = 1e3 * radius, lower = 2 * asin(0.5 * w * dt) / dt;
    double worst = 0, drift = 0;
    while (run.running) {
        step_run(&run);
        const double *u = run.batch->step.state + RING_U_LEFT;
        const double exact = v * dt * sin(lower * run.batch->step.time[0]) / sin(lower * dt);
        worst = fmax(worst, fabs(u[0] - exact) * w / v); /* element 0 starts on the x axis */
        drift = fmax(drift, fabs(run.batch->lane[0].ledger.residual));
    }
    print_message(
        "[  figures ] displacement against the sine %.1e of its crest, ledger %.1e of the energy\n",
        worst, drift / run.record.kinetic);
    assert_true(worst < 1e-9);
    assert_true(drift < 1e-12 * run.batch->lane[0].ledger.initial);
    clear_run(&run);
}

/* The free ring's onset tends to the bar's as R^-2: t = (1/w) asin(w t_bar), so t/t_bar - 1 = (w
 * t_bar)^2/6 + 3 (w t_bar)^4/40. */
static void a_ring_tends_to_the_bar(void **unused)
{
    const double exact = 300e6 / (YOUNG * 1e4);
    double before = 0;
    for (int k = 0; k < 4; k++) {
        const double radius = RING_RADIUS * (1 << k);
        fracas_spec spec = ring_reference(1000 << k, 1e4, 1.2e-7);
        spec.geometry.radius = radius;
        spec.loading.radial = 1e4 * radius;
        one_run run = start(&spec, 300e6);
        finish_run(&run);
        const double excess = run.record.onset_time / exact - 1, order = log2(before / excess);
        print_message("[  figures ] R %6.3f mm: onset beyond the bar's by %.4e%s%.4f\n",
                      1e3 * radius, excess, k ? ", order " : "; ", k ? order : 0.0);
        if (k)
            assert_true(
                fabs(order - 2) <
                0.0095); /* the next term: 9/20 (w t)^2 of the first, 8.5e-3 less 2.1e-3, by ln 2 */
        before = excess;
        clear_run(&run);
    }
}

/* Under an imposed rate the ring is the periodic bar with the same strengths, but for terms of the
 * size of the strain, 1e-3, which a chaotic choice of who breaks can turn into a fragment or two:
 * interfaces crack at the same times to 2e-3, counts within 3. */
static void a_driven_ring_is_the_bar(void **unused)
{
    const int64_t n = 1250;
    fracas_spec ring = ring_reference(n, 1e5, 1e-7), bar = bar_reference(n, 1e5, 1e-7);
    ring.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = 1e5};
    one_run one = start(&ring, NAN), other = start(&bar, NAN);
    finish_run(&one);
    finish_run(&other);
    const fracas_record *a = &one.record, *b = &other.record;
    print_message(
        "[  figures ] ring: %ld fragments, dissipated %.6e J, work %.6e J; bar: %ld, %.6e, %.6e\n",
        (long)a->fragments, a->dissipated, a->work, (long)b->fragments, b->dissipated, b->work);
    assert_true(fabs(a->onset_time / b->onset_time - 1) < 1e-4);
    assert_true(labs((long)(a->fragments - b->fragments)) <= 3);
    assert_true(fabs(a->dissipated / b->dissipated - 1) < 5e-3);
    assert_true(fabs(a->work / b->work - 1) < 5e-3);
    clear_run(&one);
    clear_run(&other);
}

/* A force f per length on an uncracked ring at rest is a step load on an oscillator: strain f R/(E
 * A) (1 - cos w t), for a linear force f' R/(E A) (t - sin(w t)/w); along the circumference the
 * ring turns as a rigid body under it, at f/(rho A). The work of the force is what the ledger
 * closes with. The expansion itself turns R into R (1 + strain): 3e-5 here. */
static void forces_do_what_they_say(void **unused)
{
    const double f = 1e3, end = 2e-6, rho_a = 2750 * 1e-6;
    for (int i = 0; i < 8; i++) {
        const bool linear = i & 1, around = i & 2;
        fracas_spec spec = either(i >> 2, 500, 1e3, end);
        spec.loading = (fracas_loading){.type = &fracas_loading_force,
                                        .direction = around ? &fracas_axis_circumferential
                                                            : &fracas_axis_radial,
                                        .force = linear ? 0 : f,
                                        .force_rate = linear ? f / end : 0};
        if (i >> 2)
            spec.time.safety = 0.1; /* velocities at whole steps: energy wobbles by (omega dt)^2 */
        one_run run = start(&spec, 1e9);
        finish_run(&run);
        const double t = run.record.end_time,
                     radius = run.model->element_size / (2 * sin(3.14159265358979323846 / 500));
        const double w = BAR_WAVE_SPEED / radius, slope = f / end;
        const double *state = run.batch->step.state;
        double exact, found, work;
        if (around) { /* velocity half a step ahead, or (Newmark) as far ahead as the next half step
                       */
            const double ahead = t + 0.5 * run.batch->step.next[0];
            exact = (linear ? 0.5 * slope * ahead * ahead : f * ahead) / rho_a;
            found = state[RING_V_LEFT + 1] * cos(state[RING_U_LEFT + 1] / radius) -
                    state[RING_V_LEFT] * sin(state[RING_U_LEFT + 1] / radius);
            const double v = (linear ? 0.5 * slope * t * t : f * t) / rho_a;
            work = 0.5 * run.model->mass * v * v;
        } else {
            exact = radius * radius / (YOUNG * 1e-6) *
                    (linear ? slope * (t - sin(w * t) / w) : f * (1 - cos(w * t)));
            found = state[RING_U_LEFT];
            work = NAN;
        }
        print_message("[  figures ] %s %s %s force: %.8e, exact %.8e; work %.8e, residual %.1e\n",
                      i >> 2 ? "stershic," : "nitsche,", linear ? "linear" : "constant",
                      around ? "circumferential" : "radial", found, exact, run.record.work,
                      run.record.residual);
        assert_true(fabs(found / exact - 1) < 2e-4);
        if (around) assert_true(fabs(run.record.work / work - 1) < 1e-4);
        assert_true(run.record.work > 0 && run.record.residual < 2e-5 * run.record.work);
        clear_run(&run);
    }
}

/* Held velocities: the radius is R + V t + a t^2/2 exactly (sums of the midpoint), the hoop stress
 * follows, and the work is what the kinetic and elastic energies gained. */
static void held_velocities_are_held(void **unused)
{
    const double v = 5, a = 2e6, end = 1e-6;
    for (int i = 0; i < 4; i++) {
        const bool around = i & 1;
        fracas_spec spec = either(i >> 1, 400, 1e3, end);
        spec.loading = (fracas_loading){.type = &fracas_loading_held_velocity,
                                        .velocity = v,
                                        .acceleration = a,
                                        .direction = around ? &fracas_axis_circumferential
                                                            : &fracas_axis_radial};
        if (i >> 1) spec.time.safety = 0.1;
        one_run run = start(&spec, 1e9);
        finish_run(&run);
        const double t = run.record.end_time, swell = run.model->element_size /
                                                      (2 * sin(3.14159265358979323846 / 400)) /
                                                      RING_RADIUS;
        const double gain = swell * (v * t + 0.5 * a * t * t), *state = run.batch->step.state;
        const double now = swell * (v + a * t), strain = gain / (swell * RING_RADIUS);
        const double kinetic = 0.5 * run.model->mass * (now * now - swell * swell * v * v);
        const double elastic = around ? 0
                                      : 0.5 * YOUNG * strain * strain * 1e-6 * RING_CIRCUMFERENCE;
        print_message("[  figures ] held: displacement %.10e, exact %.10e; work %.8e, exact %.8e\n",
                      state[around], gain, run.record.work, kinetic + elastic);
        assert_true(fabs(state[around] / gain - 1) <
                    (around ? 1e-6 : 1e-12)); /* around: sin of the angle, 1 - 7e-7 */
        /* the trapezoid over dt: (dt/t)^2; centripetal forces on the ring that turns: (V t/R)^2 =
         * 6e-7 */
        assert_true(fabs(run.record.work / (kinetic + elastic) - 1) < 2e-4);
        assert_true(run.record.residual < 1e-5 * run.record.work);
        clear_run(&run);
    }
}

TESTS(a_free_ring_cracks_at_the_exact_time, a_ring_below_the_critical_rate_stays_whole,
      an_uncracked_ring_breathes_as_a_sine, a_ring_tends_to_the_bar, a_driven_ring_is_the_bar,
      forces_do_what_they_say, held_velocities_are_held)
