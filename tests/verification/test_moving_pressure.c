/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci */
/* A pressure that runs along a tube, below its critical speed: the steady wave
 * (docs/theory/loads.md). */
#include "tests/support/loads.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

enum { AHEAD = 2 }; /* length of tube before the front's first place and behind its last */
static const double travel = 1.5;

/* ---- the steady wave ---- */

/* w(xi) of D w'''' + rho h v^2 w'' + k w = p behind a front at xi = 0, 0 ahead of it: w - w0/2 is
 * odd, and w'' is 0 at the front. k = E h/R^2 without axial force but that of inertia along the
 * axis, N = rho h v^2 u', by which u' = -nu (w/R)/(1 - v^2/c^2). */
typedef struct {
    double speed, critical, still; /* v, its critical value, w0 */
    double alpha, beta, ratio;     /* e^(-alpha |xi|) w0/2 (cos beta xi + ratio sin beta |xi|) */
    double shrinks;                /* -u'/(w/R) */
} steady_wave;

static steady_wave wave_of(const fracas_spec *spec, double share)
{
    const double nu = spec->material.poisson, h = spec->geometry.thickness,
                 R = spec->geometry.radius, plane = spec->material.young / (1 - nu * nu),
                 rho = spec->material.density, D = plane * h * h * h / 12;
    steady_wave w = {
        .critical = sqrt(spec->material.young / rho * h / R / sqrt(3 * (1 - nu * nu)))};
    w.speed = share * w.critical;
    const double axial = 1 - w.speed * w.speed * rho / plane, /* 1 - v^2/c^2 */
        k = plane * h / (R * R) * (1 - nu * nu / axial), sum = sqrt(k / D),
                 difference = -rho * h * w.speed * w.speed / (2 * D);
    w.shrinks = nu / axial;
    w.still = load_value(&spec->loading, "pressure") / k;
    w.alpha = sqrt(0.5 * (sum + difference));
    w.beta = sqrt(0.5 * (sum - difference));
    w.ratio = difference / (2 * w.alpha * w.beta);
    return w;
}

/* w and w' at xi, and the integral of w from far ahead. */
static void profile(const steady_wave *w, double xi, double *value, double *slope, double *integral)
{
    const double x = fabs(xi), decay = 0.5 * w->still * exp(-w->alpha * x), c = cos(w->beta * x),
                 s = sin(w->beta * x), a = w->alpha, b = w->beta, q = w->ratio,
                 ahead = decay * (c + q * s), square = a * a + b * b,
                 area = decay * ((a + q * b) * c + (q * a - b) * s) / square; /* of x on */
    *slope = decay * ((q * b - a) * c - (b + q * a) * s);
    *value = xi >= 0 ? ahead : w->still - ahead;
    /* from far ahead to 0, then w0 x less the same area from 0 to x */
    const double half = 0.5 * w->still * (a + q * b) / square;
    *integral = xi >= 0 ? -area : -half - w->still * x + (half - area);
}

/* Radial and axial displacement [0], [1] and velocities [2], [3] at y, when the front is at
 * `front`. */
static void state_at(const steady_wave *w, double radius, double y, double front, double state[4])
{
    double value, slope, integral;
    profile(w, y - front, &value, &slope, &integral);
    state[0] = value;
    state[1] = -w->shrinks / radius * integral;
    state[2] = -w->speed * slope;
    state[3] = w->speed * w->shrinks / radius * value;
}

/* ---- the tube ---- */

static fracas_spec tube(int64_t divisions)
{
    fracas_spec spec = shell_spec(&fracas_shape_cylinder);
    spec.geometry.part = &fracas_part_quarter;
    spec.geometry.length = 2 * AHEAD + travel;
    spec.geometry.thickness = 0.05;
    spec.mesh.divisions = divisions;
    spec.loading = bare_load(&fracas_loading_pressure);
    *load_number(&spec.loading, "pressure") = 1e-3;
    spec.loading.front_along = &fracas_front_y;
    spec.loading.front_at = -0.5 * travel;
    return spec;
}

static void set_state(const one_run *run, const steady_wave *w, double front)
{
    const fracas_model *model = run->model;
    const double R = model->spec.geometry.radius;
    for (size_t u = 0; u < unknowns_of(model); u++) {
        const double *x = place_of(model, u);
        const size_t size = element_unknowns(model), i = u % size % 3;
        double state[4];
        state_at(w, R, x[1], front, state);
        const double share = i == 1 ? 1 : x[i] / R;
        for (int f = 0; f < 2; f++)
            *surface_value(model, &run->batch->step, u / size, f ? SURFACE_V : SURFACE_U,
                           (int)(u % size), 0) = state[2 * f + (i == 1)] * share;
    }
}

/* Largest |w - steady w| within the middle of the tube by w0, and the largest w by w0. */
static double error_of(const one_run *run, const steady_wave *w, double front, double *peak)
{
    const fracas_model *model = run->model;
    double error = 0;
    *peak = 0;
    for (size_t e = 0; e < model->elements; e++)
        for (size_t k = 0; k < model->surface->corners; k++) {
            const double *x = node_at(model, e, k);
            double state[4], radial = 0;
            state_at(w, 1, x[1], front, state);
            for (size_t i = 0; i < 3; i += 2)
                radial += x[i] * *surface_value(model, &run->batch->step, e, SURFACE_U,
                                                (int)(3 * k + i), 0);
            if (fabs(x[1]) > 0.5 * travel + 1) continue;
            error = fmax(error, fabs(radial - state[0]) / w->still);
            *peak = fmax(*peak, radial / w->still);
        }
    return error;
}

/* Highest w by w0 of the steady wave. */
static double highest(const steady_wave *w)
{
    double most = 0;
    for (double x = 0; x < AHEAD; x += 1e-3) {
        double value, slope, integral;
        profile(w, -x, &value, &slope, &integral);
        most = fmax(most, value / w->still);
    }
    return most;
}

static double run_wave(double share, int64_t divisions)
{
    fracas_spec spec = tube(divisions);
    const steady_wave w = wave_of(&spec, share);
    double peak, error;
    spec.loading.front = w.speed;
    one_run run = begin_run(distorted_model(spec, 0, 1), 1, 1e6);
    set_state(&run, &w, spec.loading.front_at);
    while (run.batch->step.time[0] < travel / w.speed) step_run(&run);
    error = error_of(&run, &w, spec.loading.front_at + w.speed * run.batch->step.time[0], &peak);
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    print_message("%zu elements, v = %.2f of critical: w within %.2e of w0, peak %.4f (%.4f), "
                  "residual %.1e of the work\n",
                  run.model->elements, share, error, peak, highest(&w),
                  ledger->largest_residual / ledger->work);
    assert_true(fabs(ledger->largest_residual) < 1e-12 * ledger->work);
    assert_true(fabs(peak / highest(&w) - 1) < error);
    clear_run(&run);
    return error;
}

/* Begun with the steady wave, the tube keeps it: another would radiate. The load arrives at all of
 * an element of length l at once, as if smeared over it: of waves of number beta it has the share
 * 1 - (beta l)^2/24, 2 % less at l = 0.098, of second order; what comes of it grows with
 * 1/(1 - v^2/v_c^2). */
static void a_front_keeps_its_wave(void **unused)
{
    const double coarse = run_wave(0.7, 8);
    assert_true(coarse < 4 * 0.02);
#ifndef __SANITIZE_ADDRESS__ /* fine tubes take a minute there, and show no other fault of memory \
                              */
    const double fine = run_wave(0.7, 16);
    assert_true(fine < 0.02 && fine < 0.5 * coarse);
    assert_true(run_wave(0.9, 16) < 0.02 * 5.3 / 2);
#endif
}

TESTS(a_front_keeps_its_wave)
