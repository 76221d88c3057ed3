/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bars with free ends, alone and between walls, against closed forms (docs/theory/bar.md). */
#include "tests/support/bar_state.h"
#include "tests/support/test.h"

/* ---- waves of a free bar ---- */

/* P(y), the integral of the even continuation V of velocities rate (y - L/2), of period 2 L. */
static double integral_of_start(double y, double length, double rate)
{
    y = remainder(y, 2 * length);
    return 0.5 * rate * y * (fabs(y) - length);
}

/* d'Alembert: u = (P(x + ct) - P(x - ct))/(2c) . The L2 error of that, relative. */
static double free_error(int64_t elements, double law_beta)
{
    const double rate = 100, length = 0.05, time = 0.6 * length / BAR_WAVE_SPEED;
    fracas_spec spec = bar_reference(elements, rate, 1);
    spec.cohesive.beta = law_beta;
    set_ends(&spec, ENDS_FREE, NAN);
    OWN(fracas_model) model = make_model(&spec);
    const double steps = ceil(time / model->time_step);
    model->time_step = time / steps;
    OWN(fracas_batch) batch = begun_with(model, 450e6);
    RECORD(record);
    for (int s = 0; s <= (int)steps; s++) step(batch, &record);
    double sum = 0, norm = 0;
    for (size_t e = 0; e < model->elements; e++)
        for (int g = 0; g < 2; g++) { /* two Gauss points */
            const double xi = 0.5 + (g ? 0.5 : -0.5) / sqrt(3),
                         x = ((double)e + xi) * model->element_size;
            const double is = rate * batch->step.time[0] * (x - 0.5 * length) +
                              (1 - xi) * *field(batch, e, BAR_W_LEFT) +
                              xi * *field(batch, e, BAR_W_RIGHT);
            const double exact = (integral_of_start(x + BAR_WAVE_SPEED * time, length, rate) -
                                  integral_of_start(x - BAR_WAVE_SPEED * time, length, rate)) /
                                 (2 * BAR_WAVE_SPEED);
            sum += (is - exact) * (is - exact);
            norm += exact * exact;
        }
    assert_int_equal(batch->step.cracked[0], 0);
    return sqrt(sum / norm);
}

/* Order 5/3: u has a kink in its slope, so that its spectrum falls as k^-3, and waves of k are off
 * by min(1, h^2 k^3 c t): the integral of k^-6 min(1, h^2 k^3)^2 is h^(10/3). 0.1 for meshes on
 * which the kink is at different places of an element. */
static void free_ends_send_the_waves_of_dalembert(void **unused)
{
    for (int b = 0; b < 2; b++) {
        double error[4];
        for (int finer = 0; finer < 4; finer++) error[finer] = free_error(100 << finer, b ? 10 : 4);
        const double slope = log2(error[0] / error[3]) / 3;
        print_message("[  figures ] beta %d: L2 errors %.2e %.2e %.2e %.2e, slope %.3f\n",
                      b ? 10 : 4, error[0], error[1], error[2], error[3], slope);
        assert_true(fabs(slope - 5.0 / 3) < 0.1 && error[3] < 1e-4);
    }
}

/* ---- the laboratory's frame ---- */

/* Elastic and stored energy, and the kinetic one of velocities rate (x - L/2) + v of leapfrog,
 * v_{n-1/2} v_{n+1/2} [J]. `before` has v_{n-1/2} of all nodes. */
static double energy_in_laboratory(const fracas_batch *batch, const double *before)
{
    const fracas_model *model = batch->model;
    const double rate = model->spec.loading.rate, middle = 0.5 * model->spec.geometry.length;
    double kinetic = 0, x = -middle;
    for (size_t e = 0; e < model->elements; e++) {
        const double h = length_of(model, e);
        for (int side = 0; side < 2; side++) {
            const double flow = rate * (x + side * h);
            kinetic += 0.25 * 2750 * 1e-6 * h * (flow + before[2 * e + (size_t)side]) *
                       (flow + *field(batch, e, BAR_V_LEFT + side));
        }
        x += h;
    }
    return batch->step.elastic[0] + batch->step.cohesive[0] + kinetic;
}

/* Left or right end to its wall [m], for walls at the ends at the start. */
static double to_wall(const fracas_batch *batch, int right)
{
    const fracas_spec *spec = &batch->model->spec;
    const double w = right ? -*field(batch, batch->model->elements - 1, BAR_W_RIGHT)
                           : *field(batch, 0, BAR_W_LEFT);
    return w - 0.5 * spec->loading.rate * spec->geometry.length * batch->step.time[0];
}

/* What a step misses where a wall is touched or left, K q0 q1/2 or less that  (balance.1). */
static double missed(const fracas_batch *batch, const double *q, int right)
{
    const double h = length_of(batch->model, right ? batch->model->elements - 1 : 0),
                 now = to_wall(batch, right), product = q[right] * now;
    if (!(product < 0)) return 0;
    return 1e-6 * batch->model->spec.cohesive.beta * 275e9 / h * 0.5 *
           (now < 0 ? product : -product);
}

/* Nothing works on a free bar, nor do walls that it presses on, although the ledger counts the
 * background's work on the peculiar motion: the energy is the ledger's, to 1e-12 as in
 * test_bar_ledger. Walls are touched and left again in the first steps; the balance keeps all but a
 * hundredth of what these miss. The momentum of a free bar is 0 to as many roundings of the sum of
 * |m v| as there are steps. */
static void nothing_works_on_free_bars(void **unused)
{
    for (int i = 0; i < 4; i++) {
        fracas_spec spec = bar_reference(200, 100, 1);
        const char *name = set_ends(&spec, ENDS_FREE + i % 2, 0);
        spec.geometry.length = 0.02;
        spec.cohesive.beta = 6;
        OWN(fracas_model) model = model_on(&spec, i / 2 ? 2 : UNIFORM);
        OWN(fracas_batch) batch = begun_with(model, 450e6);
        double first = 0, worst = 0, kinks = 0, momentum = 0, scale = 0, q[2] = {0};
        RECORD(record);
        while (batch->step.time[0] < 0.02 / BAR_WAVE_SPEED) {
            double before[400];
            for (size_t k = 0; k < 400; k++)
                before[k] = *field(batch, k / 2, BAR_V_LEFT + (int)(k % 2));
            step(batch, &record);
            const double energy = energy_in_laboratory(batch, before);
            for (int side = 0; side < 2; side++) {
                if (i % 2) kinks += fabs(missed(batch, q, side));
                q[side] = to_wall(batch, side);
            }
            if (first == 0) first = energy;
            worst = fmax(worst, fabs((energy - batch->lane[0].ledger.residual) / first - 1));
        }
        for (size_t k = 0; k < 400; k++) {
            const double each = 0.5 * 2750 * 1e-6 * length_of(model, k / 2) *
                                *field(batch, k / 2, BAR_V_LEFT + (int)(k % 2));
            momentum += each;
            scale += fabs(each);
        }
        const fracas_ledger *ledger = &batch->lane[0].ledger;
        print_message("[  figures ] %s, %s: energy off by %.1e of %.3g J, kinks %.1e J, ledger "
                      "%.1e J (work on the peculiar motion %.3g J), momentum %.1e of %.1e kg m/s\n",
                      name, i / 2 ? "perturbed" : "uniform", worst, first, kinks, ledger->residual,
                      ledger->work, momentum, scale);
        assert_int_equal(batch->step.cracked[0], 0);
        assert_true(worst < 1e-12 && fabs(ledger->work) > 0.1 * first);
        assert_true(ledger->largest_residual < 0.01 * kinks + 1e-12 * first);
        assert_true((kinks != 0) == (i % 2 == 1));
        if (i % 2 == 0) assert_true(fabs(momentum) < 1e-16 * (double)batch->lane[0].steps * scale);
    }
}

/* ---- a rod thrown against a wall ---- */

typedef struct {
    double contact, rebound, energy; /* s, m/s, 1: energy after by that before, less 1 */
    int times;                       /* it touched */
} bounce;

static bounce throw_rod(int64_t elements, double beta, double speed)
{
    const double length = 0.01, gap = 1e-6;
    fracas_spec spec = bar_reference(elements, 0, 1);
    spec.geometry.length = length;
    spec.cohesive.beta = beta;
    set_ends(&spec, ENDS_WALLS, gap);
    OWN(fracas_model) model = make_model(&spec);
    model->tolerance = INFINITY;
    OWN(fracas_batch) batch = begun_with(model, 2.9e8);
    for (size_t e = 0; e < model->elements; e++)
        *field(batch, e, BAR_V_LEFT) = *field(batch, e, BAR_V_RIGHT) = -speed;
    RECORD(record);
    bounce seen = {0};
    double first = 0, touched = NAN, q = gap, kept = 0;
    while (!(batch->step.time[0] > gap / speed + 2.2 * length / BAR_WAVE_SPEED)) {
        step(batch, &record);
        const fracas_step *at = &batch->step;
        const double before = q;
        q = gap + *field(batch, 0, BAR_W_LEFT);
        const double crossed = at->time[0] - at->drift[0] * q / (q - before);
        if (before > 0 && q <= 0 && !(touched > 0)) touched = crossed;
        if (before <= 0 && q > 0) {
            seen.contact = crossed - touched;
            seen.times++;
        }
        kept = at->kinetic[0] + at->elastic[0] + at->cohesive[0];
        if (first == 0) first = kept;
    }
    assert_int_equal(batch->step.cracked[0], 0);
    double momentum = 0;
    for (size_t e = 0; e < model->elements; e++)
        momentum += *field(batch, e, BAR_V_LEFT) + *field(batch, e, BAR_V_RIGHT);
    seen.rebound = momentum / (2 * (double)model->elements);
    seen.energy = kept / first - 1;
    return seen;
}

/* Contact for 2 L/c + 1.67835 t_w, rebound at (1 - 0.05171 t_w c/L) of the speed, t_w = h/(beta c).
 * The rod's waves disperse: the shock comes back as wide as d = (2 h^2 L)^(1/3), so that the
 * contact ends within d/2 of its time, and an impulse is missing of a quarter of d out of 2 L at
 * both ends of the pulse. The latter falls with the power 2/3 of h, 0.1 for its ripples. Energy: a
 * step that touches misses K (v dt)^2/8 at most, by the kinetic energy beta/(1 + beta) h/(64 L)
 * with dt of a quarter of h/(c sqrt(1 + beta)); the balance leaves a tenth of one, of 10 to 2000.
 */
static void a_rod_bounces_off_a_wall(void **unused)
{
    const double length = 0.01, speed = 5;
    for (int b = 0; b < 2; b++) {
        const double beta = b ? 10 : 4;
        double slow[3];
        for (int finer = 0; finer < 3; finer++) {
            const int64_t n = 100 << (2 * finer);
            const double h = length / (double)n, lag = h / (beta * BAR_WAVE_SPEED);
            const bounce rod = throw_rod(n, beta, speed);
            const double contact = 2 * length / BAR_WAVE_SPEED + 1.67835 * lag,
                         rebound = speed * (1 - 0.05171 * lag * BAR_WAVE_SPEED / length),
                         wide = cbrt(2 * h * h * length);
            slow[finer] = 1 - rod.rebound / rebound;
            print_message("[  figures ] beta %g, %ld elements: contact %.6g ns (%.6g), rebound "
                          "%.6f m/s (%.6f), energy %.1e, touched %d times\n",
                          beta, (long)n, 1e9 * rod.contact, 1e9 * contact, rod.rebound, rebound,
                          rod.energy, rod.times);
            assert_true(fabs(rod.contact - contact) * BAR_WAVE_SPEED < 0.5 * wide);
            assert_true(fabs(slow[finer]) < 0.25 * wide / length);
            assert_true(fabs(rod.energy) < 0.1 * beta / (1 + beta) * h / (64 * length));
        }
        const double order = log2(slow[0] / slow[2]) / 4;
        print_message("[  figures ] beta %g: impulse missing with order %.2f\n", beta, order);
        assert_true(fabs(order - 2.0 / 3) < 0.1);
    }
}

/* ---- fragments ---- */

/* A free bar as a whole stays where it is: to the roundings of one sum over its 500 elements, and
 * of momentum in every step, 1e-16 each of the sum of |m v|. */
static void check_middle(const fracas_model *model, const fracas_record *record)
{
    double middle = 0, momentum = 0, scale = 0;
    for (size_t f = 0; f < record->nfragment; f++) {
        const fracas_fragment *of = &record->fragment[f];
        middle += of->mass / record->mass * of->position[0];
        momentum += of->mass * of->velocity[0];
        scale += of->mass * fabs(of->velocity[0]);
    }
    const double rounding = 1e-16 * (double)record->steps * scale;
    assert_true(fabs(middle / model->spec.geometry.length - 0.5) < 1e-12);
    assert_true(fabs(momentum) < rounding && fabs(record->momentum[0]) < rounding);
}

/* As residual_stays_small_and_is_second_order of test_bar_ledger. Walls are met at 0.2 us, and
 * there the whole energy of the start is beside the dissipated one, A rho rate^2 L^3/24. */
static void free_bars_break_up(void **unused)
{
    for (int end = ENDS_FREE; end <= ENDS_WALLS; end++) {
        ledger_figures at[2];
        for (int half = 0; half < 2; half++) {
            fracas_spec spec = bar_reference(500, 1e4, 0.6e-6);
            spec.geometry.length = 0.01;
            spec.time.safety = half ? 0.125 : 0.25;
            const char *name = set_ends(&spec, end, 1e-5);
            OWN(fracas_model) model = make_model(&spec);
            at[half] = break_up(model, 0, 8, 1.0 / 300, end == ENDS_FREE ? check_middle : NULL);
            print_message("[  figures ] %s: %.4g fragments, residual/dissipated %.2e\n", name,
                          at[half].fragments, at[half].residual);
        }

        const double start = 2750 * 1e4 * 1e4 * 1e-6 / 24 * 1e-6,
                     beside = end == ENDS_FREE ? 1 : start / (100 * 1e-6 * at[0].fragments);
        assert_true(at[0].residual < 1e-3 * fmax(1, beside) && at[0].fragments > 10);
        assert_true(at[1].residual < at[0].residual / 2.5);
    }
}

TESTS(free_ends_send_the_waves_of_dalembert, nothing_works_on_free_bars, a_rod_bounces_off_a_wall,
      free_bars_break_up)
