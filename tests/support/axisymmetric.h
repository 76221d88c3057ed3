/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A disk with a hole in plane stress, turned by its own inertia: u(r, t) by linear finite elements
 * along the radius, and by the series of its free vibrations. Both know nothing of the engine. rho
 * u_tt = s_r,r + (s_r - s_t)/r + rho w^2 r,  s_r = C (u,r + nu u/r), s_t = C (u/r + nu u,r), C =
 * E/(1 - nu^2) and s_r = 0 at both edges. There s_t = E u/r. */
#ifndef FRACAS_TESTS_SUPPORT_AXISYMMETRIC_H
#define FRACAS_TESTS_SUPPORT_AXISYMMETRIC_H

#include "tests/support/test.h"

#include <assert.h>
#include <gsl/gsl_sf_bessel.h>

typedef struct {
    double young, poisson, density; /* Pa, 1, kg/m3 */
    double inner, outer;            /* m */
    double speed, ramp;             /* rad/s, s: w = speed min(1, t/ramp) */
} disk;

static inline double disk_modulus(const disk *d)
{
    return d->young / (1 - d->poisson * d->poisson);
}

/* Displacement at rest under w = speed, and its hoop stress at the hole: textbook. */
static inline double disk_static(const disk *d, double r)
{
    const double nu = d->poisson, a2 = d->inner * d->inner, b2 = d->outer * d->outer;
    return d->density * d->speed * d->speed / (8 * d->young) * r *
           ((3 + nu) * (1 - nu) * (a2 + b2) + (1 + nu) * (3 + nu) * a2 * b2 / (r * r) -
            (1 - nu * nu) * r * r);
}
static inline double disk_static_hoop(const disk *d)
{
    const double nu = d->poisson;
    return d->density * d->speed * d->speed / 4 *
           ((3 + nu) * d->outer * d->outer + (1 - nu) * d->inner * d->inner);
}

/* ---- finite elements ---- */

typedef struct {
    const disk *body;
    size_t n;          /* elements */
    double h, dt;      /* m, s */
    double *u, *v, *f; /* [n + 1]: m, m/s (half a step behind), N */
    double time;
} disk_run;

static inline disk_run disk_begin(const disk *body, size_t n)
{
    disk_run run = {.body = body, .n = n, .h = (body->outer - body->inner) / (double)n};
    run.dt = 0.5 * run.h / sqrt(disk_modulus(body) / body->density);
    run.u = calloc(n + 1, sizeof *run.u);
    run.v = calloc(n + 1, sizeof *run.v);
    run.f = calloc(n + 1, sizeof *run.f);
    assert(run.u && run.v && run.f);
    return run;
}

static inline void disk_end(disk_run *run)
{
    free(run->u);
    free(run->v);
    free(run->f);
}

/* Forces of a radian's sector of unit thickness at the time of `u`, by the middle of each element.
 */
static inline void disk_forces(disk_run *run)
{
    const disk *d = run->body;
    const double modulus = disk_modulus(d),
                 w = d->speed * (d->ramp > 0 ? fmin(1, run->time / d->ramp) : 1), h = run->h;
    for (size_t i = 0; i <= run->n; i++) run->f[i] = 0;
    for (size_t i = 0; i < run->n; i++) {
        const double r = d->inner + ((double)i + 0.5) * h, slope = (run->u[i + 1] - run->u[i]) / h;
        const double hoop = 0.5 * (run->u[i] + run->u[i + 1]) / r;
        const double s_r = modulus * (slope + d->poisson * hoop),
                     s_t = modulus * (hoop + d->poisson * slope);
        const double body = 0.5 * d->density * w * w * r * r * h;
        run->f[i] += s_r * r - 0.5 * s_t * h + body;
        run->f[i + 1] += -s_r * r - 0.5 * s_t * h + body;
    }
}

/* Leapfrog from t to t + dt. A run at rest starts with half a kick. */
static inline void disk_step(disk_run *run)
{
    const disk *d = run->body;
    disk_forces(run);
    for (size_t i = 0; i <= run->n; i++) {
        const double r = d->inner + (double)i * run->h, share = i == 0 || i == run->n ? 0.5 : 1;
        /* half of each element next to it, at its own middle: r h -+ h^2/4 */
        const double ring = share == 1
                                ? r * run->h
                                : 0.5 * run->h * (i == 0 ? r + 0.25 * run->h : r - 0.25 * run->h);
        const double kick = run->time > 0 ? run->dt : 0.5 * run->dt;
        run->v[i] += kick * run->f[i] / (d->density * ring);
        run->u[i] += run->dt * run->v[i];
    }
    run->time += run->dt;
}

/* ---- free vibrations ---- */

/* u = J1(k r) + c Y1(k r) with s_r = 0 at the hole; what is left of s_r at the rim, by C. */
typedef struct {
    double k, c;
} disk_mode;

static inline double disk_mode_stress(const disk *d, double k, double c, double r)
{
    const double x = k * r, j = gsl_sf_bessel_J1(x), y = gsl_sf_bessel_Y1(x);
    return k * (gsl_sf_bessel_J0(x) + c * gsl_sf_bessel_Y0(x)) -
           (1 - d->poisson) * (j + c * y) / r; /* J1' = J0 - J1/x */
}

static inline double disk_mode_miss(const disk *d, double k, double *c)
{
    const double j = disk_mode_stress(d, k, 0, d->inner);
    *c = -j / (disk_mode_stress(d, k, 1, d->inner) - j);
    return disk_mode_stress(d, k, *c, d->outer);
}

static inline double disk_mode_value(const disk_mode *m, double r)
{
    return gsl_sf_bessel_J1(m->k * r) + m->c * gsl_sf_bessel_Y1(m->k * r);
}

/* The first `count` modes: changes of sign of what is missed at the rim (its poles, where the
 * stress of Y1 at the hole vanishes, change it too, but it is large there), bisected. */
static inline void disk_modes(const disk *d, disk_mode *mode, size_t count)
{
    const double step = 1e-3 / d->outer;
    size_t found = 0;
    for (double k = step, c, before = disk_mode_miss(d, k, &c); found < count; k += step) {
        const double now = disk_mode_miss(d, k + step, &c);
        if (before * now < 0) {
            double low = k, high = k + step, at_low = before;
            for (int i = 0; i < 60; i++) {
                const double middle = 0.5 * (low + high), value = disk_mode_miss(d, middle, &c);
                if (value * at_low > 0) low = middle, at_low = value;
                else high = middle;
            }
            if (fabs(disk_mode_miss(d, low, &c)) < 1e-3 * (fabs(before) + fabs(now)))
                mode[found++] = (disk_mode){low, c};
        }
        before = now;
    }
}

/* u(r, t) for t <= ramp: static deformation times (t/ramp)^2 less vibrations that its second
 * derivative starts, q'' + w_n^2 q = -(2/ramp^2) c_n, c_n = int u_s U_n r dr / int U_n^2 r dr
 * (Simpson) */
static inline double disk_series(const disk *d, const disk_mode *mode, size_t count, double r,
                                 double time)
{
    enum { PANELS = 2000 };
    double sum = disk_static(d, r) * (time / d->ramp) * (time / d->ramp);
    for (size_t m = 0; m < count; m++) {
        double with = 0, own = 0;
        for (int i = 0; i <= PANELS; i++) {
            const double x = d->inner + (d->outer - d->inner) * i / PANELS,
                         u = disk_mode_value(&mode[m], x);
            const double weight = (i == 0 || i == PANELS ? 1 : i % 2 ? 4 : 2) * x;
            with += weight * disk_static(d, x) * u;
            own += weight * u * u;
        }
        const double w = mode[m].k * sqrt(disk_modulus(d) / d->density);
        sum -= 2 / (d->ramp * d->ramp) * (with / own) / (w * w) * (1 - cos(w * time)) *
               disk_mode_value(&mode[m], r);
    }
    return sum;
}

#endif
