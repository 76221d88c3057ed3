/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bar against closed forms: onset, isolated crack, waves, critical step. */
#include "tests/support/bar_state.h"
#include "tests/support/test.h"

/* sigma = E rate t: failure at sigma_c/(E rate), 109.0909 ns at 1e4 /s. S is linear in time until
 * onset, so that the interpolated time is exact up to round-off; 1e-6 is the figure promised. */
static void onset_time_is_strength_over_stress_rate(void **unused)
{
    const double rates[] = {1e3, 1e4, 1e5, 1e6};
    for (int law = 0; law < BAR_LAWS; law++)
        for (int r = 0; r < 4; r++)
            for (int held = 0; held < 2; held++) {
                double exact = 300e6 / (275e9 * rates[r]);
                fracas_spec spec = bar_reference(r < 3 ? 800 : 4000, rates[r], 1.5 * exact);
                set_listed_law(&spec, law);
                spec.geometry.ends = ends[held];
                one_run run = make_run(make_model(&spec), 1, 301e6);
                bar_set_strength(run.batch, 0, 37, 300e6);
                OK(fracas_batch_begin(run.batch));
                finish_run(&run);
                assert_true(run.record.cracked > 0);
                assert_true(fabs(run.record.onset_time / exact - 1) < 1e-6);
                clear_run(&run);
            }
}

typedef struct {
    double break_error, opening_error;
} crack_errors;

/* One weak link in a stretching bar (theory/bar.md, isolated crack): with x = (t - t_onset)/t0
 *   delta = 2 c rate t0^2 (e^x - 1 - x), broken when that is delta_c, e^x_b - 1 - x_b = rate0/rate.
 * The bar is long enough that the waves of its periodic images do not meet before: 1.2 x_b s0. */
static crack_errors isolated_crack(double rate, double x_b, int elements_per_s0)
{
    const double delta_c = 2 * 100 / 300e6;
    const double onset = 300e6 / (275e9 * rate), broken = onset + x_b * BAR_T0;
    int64_t elements = (int64_t)ceil(1.2 * x_b * elements_per_s0) + 8;
    fracas_spec spec = bar_reference(elements, rate, 1.2 * broken);
    spec.geometry.length = (double)elements * BAR_S0 / elements_per_s0;
    one_run run = make_run(make_model(&spec), 1, 2.9e9);
    const size_t weak = (size_t)elements / 3;
    bar_set_strength(run.batch, 0, weak, 300e6);
    OK(fracas_batch_begin(run.batch));
    crack_errors errors = {0, 0};
    while (run.running && run.batch->step.broken[0] == 0) {
        step_run(&run);
        double x = (run.batch->step.time[0] - onset) / BAR_T0,
               damage = *field(run.batch, weak, BAR_DAMAGE);
        double exact = 2 * 1e4 * rate * BAR_T0 * BAR_T0 * (exp(x) - 1 - x);
        /* relative to delta_c/10 where the opening is smaller than that: both vanish at onset */
        if (x > 0 && damage < 1)
            errors.opening_error = fmax(
                errors.opening_error, fabs(damage * delta_c - exact) / fmax(exact, 0.1 * delta_c));
    }
    finish_run(&run);
    assert_true(run.record.cracked >= 1);
    const fracas_interface_row *row = &run.record.interface[weak];
    errors.break_error = fabs((row->break_time - row->onset_time) / (x_b * BAR_T0) - 1);
    clear_run(&run);
    return errors;
}

static void isolated_crack_opens_as_the_closed_form(void **unused)
{
    /* x_b of theory: roots of e^x - 1 - x = rate0/rate for rate0 = 35 702.5 /s */
    static const struct {
        double rate, x_b, break_bound, opening_bound;
    } cases[] = {{1e3, 3.69886, 1e-3, 1e-3},
                 {1e4, 1.86120, 1e-3, 1e-3},
                 {1e5, 0.740993, 1e-3, 1e-3},
                 {1e6, 0.255828, 2e-3, 1.5e-2}};
    for (int i = 0; i < 4; i++) {
        double last_break = 1;
        for (int m = 20; m <= 80; m *= 2) {
            crack_errors e = isolated_crack(cases[i].rate, cases[i].x_b, m);
            print_message(
                "[  figures ] rate %.0e h = s0/%d: break time error %.2e, opening error %.2e\n",
                cases[i].rate, m, e.break_error, e.opening_error);
            /* Converging until the step's interpolation error is reached. */
            assert_true(e.break_error < fmax(last_break, 2e-4));
            last_break = e.break_error;
            if (m == 80) {
                assert_true(e.break_error < cases[i].break_bound);
                assert_true(e.opening_error < cases[i].opening_bound);
            }
        }
    }
}

/* The slope over two halvings must be 2 within 0.1; dropping consistency or symmetrisation loses
 * it.
 */
static void waves_converge_with_order_two(void **unused)
{
    const double betas[] = {2, 4, 30};
    for (int i = 0; i < 6; i++) {
        fracas_spec spec = bar_reference(32, 1e-9, 1);
        spec.geometry.ends = ends[i / 3];
        spec.cohesive.beta = betas[i % 3];
        check_waves(spec, UNIFORM, 2 * M_PI / 0.05, 0.1);
    }
}

/* Largest omega h/c of the closed DG bar by Bloch's theorem: for wave number theta the 2 x 2 matrix
 * of (left, right) nodes, maximised over theta. Written from the energy, independently of the
 * engine's operator. */
static double bloch_top(double beta)
{
    double top = 0;
    for (int i = 0; i <= 2000; i++) {
        double theta = M_PI * i / 2000, c = cos(theta), s = sin(theta);
        /* unknowns a (left), b (right); next element's times e^{i theta}; energy per element, E = h
         * = 1: 1/2 |b-a|^2 + Re(conj(m) q) + beta/2 |q|^2, m = (b-a)(1+z)/2, q = a z - b, z = e^{i
         * theta} */
        double aa, bb, re, im; /* Hermitian matrix [aa, re + i im; ., bb] */
        /* q = z a - b: |q|^2 -> [1, -conj(z); -z, 1] */
        aa = 1 + beta;
        bb = 1 + beta;
        re = -1 - beta * c;
        im = beta * s;
        /* Re(conj(m) q): sesquilinear form 1/2 (conj(m) q + m conj(q)), m = p (b - a), p = (1+z)/2;
         * conj(p) z = p and conj(p) = p conj(z):  conj(m) q = conj(p)(conj(b) - conj(a))(z a - b)
         *   coefficient of |a|^2: -conj(p) z = -p -> real part; of |b|^2: -conj(p) */
        double pr = 0.5 * (1 + c), pi = 0.5 * s;
        aa += -2 * pr;
        bb += -2 * pr;
        /* twice the form's cross term conj(a) b: from conj(m) q: +conj(p); from m conj(q): p b
         * (conj(z) conj(a)) -> p conj(z) = conj(p) */
        re += 2 * pr;
        im += -2 * pi;
        double mean = 0.5 * (aa + bb),
               half = sqrt(0.25 * (aa - bb) * (aa - bb) + re * re + im * im);
        top = fmax(top, mean + half);
    }
    return sqrt(2 * top); /* nodal mass 1/2 */
}

typedef struct {
    double closed, cracked, step;
} critical_steps;

/* In units of h/c. */
static critical_steps critical(const fracas_kind *law, double beta)
{
    fracas_spec spec = bar_reference(200, 1e4, 1e-6);
    spec.cohesive.law = law;
    spec.cohesive.beta = beta;
    OWN(fracas_model) model = make_model(&spec);
    const double unit = model->element_size / BAR_WAVE_SPEED;
    critical_steps steps = {model->critical_closed / unit, model->critical_cracked / unit,
                            model->critical_step / unit};
    return steps;
}

static void critical_step_is_that_of_the_spectrum(void **unused)
{
    /* theory: 0.500 h/c closed, 0.447 cracked, at beta 4. Cracked and in contact every wave number
     * has omega^2 <= (c/h)^2 4 (1 + beta): the two springs of a node both stretch.  */
    assert_true(fabs(2 / bloch_top(4) - 0.5) < 1e-6);
    assert_true(fabs(critical(&fracas_law_nitsche.kind, 4).step - 0.4472) < 5e-5);
    const double betas[] = {1.5, 2, 4, 10, 30};
    for (int i = 0; i < 5; i++) {
        const double exact[2] = {2 / bloch_top(betas[i]), 1 / sqrt(1 + betas[i])};
        critical_steps found = critical(&fracas_law_nitsche.kind, betas[i]);
        /* the iteration comes from below: the step from above, by 1e-7 at most */
        assert_true(found.closed >= exact[0] * (1 - 1e-9) && found.closed <= exact[0] * (1 + 1e-7));
        assert_true(found.cracked >= exact[1] * (1 - 1e-9) &&
                    found.cracked <= exact[1] * (1 + 1e-7));
        assert_true(found.step <= found.closed && found.step <= found.cracked);
    }
    /* rigid links: 2-node elements, h/c while closed; in contact with k = E/h as beta = 1 */
    critical_steps rigid = critical(&fracas_law_rigid_link.kind, 4);
    assert_true(fabs(rigid.closed - 1) < 1e-5 && fabs(rigid.cracked - 1 / sqrt(2)) < 1e-5);
}

TESTS(onset_time_is_strength_over_stress_rate, isolated_crack_opens_as_the_closed_form,
      waves_converge_with_order_two, critical_step_is_that_of_the_spectrum)
