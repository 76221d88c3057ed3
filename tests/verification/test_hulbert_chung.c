/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The explicit scheme of Hulbert and Chung: its parameters and limits by its amplification matrix,
 * and the membrane's sweep against the scheme applied to one number, an eigenmode's amplitude.
 * Central difference likewise. */
#include "tests/support/membrane_elastic.h"

#include "engine/integrator/hulbert_chung.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

/* u, v dt, a dt^2 of u'' = -omega^2 u; `square` = (omega dt)^2. */
typedef struct {
    double u, v, a;
} motion;

/* (1 - am) a' + am a = -Omega^2 u, then u' = u + v + (1/2 - b) a + b a', v' = v + (1 - g) a + g a'.
 */
static motion advance(const fracas_hulbert_chung *h, double square, motion x)
{
    const double a = (-square * x.u - h->alpha_m * x.a) / (1 - h->alpha_m);
    return (motion){x.u + x.v + (0.5 - h->beta) * x.a + h->beta * a,
                    x.v + (1 - h->gamma) * x.a + h->gamma * a, a};
}

static void amplification(const fracas_hulbert_chung *h, double square, double m[3][3])
{
    for (int j = 0; j < 3; j++) {
        const motion y = advance(h, square, (motion){j == 0, j == 1, j == 2});
        m[0][j] = y.u;
        m[1][j] = y.v;
        m[2][j] = y.a;
    }
}

/* x^3 + c[2] x^2 + c[1] x + c[0], of which the eigenvalues are the roots. */
static void characteristic(const fracas_hulbert_chung *h, double square, double c[3])
{
    double m[3][3];
    amplification(h, square, m);
    c[2] = -(m[0][0] + m[1][1] + m[2][2]);
    c[1] = m[0][0] * m[1][1] - m[0][1] * m[1][0] + m[0][0] * m[2][2] - m[0][2] * m[2][0] +
           m[1][1] * m[2][2] - m[1][2] * m[2][1];
    c[0] = -(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
}

static double spectral_radius(const fracas_hulbert_chung *h, double square)
{
    double m[3][3], largest = 0;
    amplification(h, square, m);
    gsl_matrix_view view = gsl_matrix_view_array(&m[0][0], 3, 3);
    gsl_vector_complex *value = gsl_vector_complex_alloc(3);
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(3);
    gsl_eigen_nonsymm(&view.matrix, value, work);
    for (size_t i = 0; i < 3; i++) {
        const gsl_complex z = gsl_vector_complex_get(value, i);
        largest = fmax(largest, hypot(GSL_REAL(z), GSL_IMAG(z)));
    }
    gsl_eigen_nonsymm_free(work);
    gsl_vector_complex_free(value);
    return largest;
}

/* The numbers of the theory page to the digits given there. */
static void parameters_are_those_of_the_table(void **unused)
{
    static const double table[][6] = {/* r, am, b, g, Omega_b, Omega_c */
                                      {1.00, 0.500000, 0.500000, 1.000000, 2.000000, 2.00000},
                                      {0.95, 0.461538, 0.538493, 1.038462, 1.998155, 1.99837},
                                      {0.90, 0.421053, 0.579199, 1.078947, 1.992737, 1.99365},
                                      {0.50, 0.000000, 1.037037, 1.500000, 1.837117, 1.86651}};
    for (size_t i = 0; i < 4; i++) {
        const double *t = table[i], r = t[0];
        const fracas_hulbert_chung h = fracas_hulbert_chung_of(r);
        assert_true(fabs(h.alpha_m - t[1]) < 6e-7 && fabs(h.beta - t[2]) < 6e-7 &&
                    fabs(h.gamma - t[3]) < 6e-7);
        assert_true(fabs((1 + r) * sqrt(2 - r) - t[4]) < 6e-7 && fabs(h.limit - t[5]) < 6e-6);
    }
}

/* At Omega_b = (1 + r) sqrt(2 - r) the characteristic polynomial is (x + r)^3: coefficients to some
 * roundings of numbers below 10. At the limit a root is -1, and no root is outside the circle
 * below, one is above: P(-1) changes its sign there. */
static void roots_are_those_of_the_scheme(void **unused)
{
    for (int i = 0; i <= 100; i++) {
        const double r = i / 100.0, bifurcation = (1 + r) * sqrt(2 - r);
        const fracas_hulbert_chung h = fracas_hulbert_chung_of(r);
        double c[3];
        characteristic(&h, bifurcation * bifurcation, c);
        assert_true(fabs(c[2] - 3 * r) < 1e-13 && fabs(c[1] - 3 * r * r) < 1e-13 &&
                    fabs(c[0] - r * r * r) < 1e-13);
        characteristic(&h, h.limit * h.limit, c);
        assert_true(fabs(-1 + c[2] - c[1] + c[0]) < 1e-13);
        /* a root of multiplicity 3 at r = 1 (2 at Omega = 0) is found to eps^(1/3) = 6e-6
         * (eps^(1/2)) */
        for (int k = 0; k <= 200; k++) {
            const double omega = h.limit * (1 - 1e-4) * k / 200;
            assert_true(spectral_radius(&h, omega * omega) <= 1 + 2e-5);
            if (r < 0.99 && k > 0) assert_true(spectral_radius(&h, omega * omega) < 1);
        }
        assert_true(spectral_radius(&h, h.limit * h.limit * (1 + 2e-4)) > 1 + 1e-5);
    }
}

/* Errors of u and v after one time unit, of cos(2 t): a quarter for half the step, within what the
 * next order leaves, which is of the step itself: 2 dt omega = 2 % here. */
static void second_order(void **unused)
{
    const double radii[] = {1, 0.9, 0.5, 0.2};
    for (size_t i = 0; i < 4; i++) {
        const fracas_hulbert_chung h = fracas_hulbert_chung_of(radii[i]);
        double wrong[2][2];
        for (int fine = 0; fine < 2; fine++) {
            const int steps = 200 << fine;
            const double dt = 1.0 / steps, square = 4 * dt * dt;
            motion x = {1, 0, -square};
            for (int n = 0; n < steps; n++) x = advance(&h, square, x);
            wrong[fine][0] = fabs(x.u - cos(2));
            wrong[fine][1] = fabs(x.v / dt + 2 * sin(2));
        }
        for (int k = 0; k < 2; k++)
            assert_true(wrong[0][k] < 1e-3 && fabs(wrong[0][k] / wrong[1][k] - 4) < 0.16);
    }
}

/* Twice the kinetic energy beside the damped, times dt^2 by mass  (membrane.20). */
static double kinetic_of(const fracas_hulbert_chung *h, double square, motion x)
{
    const double change = advance(h, square, x).a - x.a, behind = x.v - 0.5 * x.a,
                 ahead = behind - square * x.u;
    return behind * ahead + h->excess * (x.a * x.a - 0.5 * (1 - h->alpha_m) * change * change);
}

/* Twice the energy damped over `steps`, likewise (membrane.21), of a start that is given as 1 and
 * 0.3. Kinetic, elastic and damped energy are constant to some roundings in each step. */
static double damped_over(const fracas_hulbert_chung *h, double square, int steps, double *first)
{
    motion x = {1, 0.3, -square};
    double damped = 0, size = *first = kinetic_of(h, square, x) + square;
    for (int n = 0; n < steps; n++) {
        const motion next = advance(h, square, x);
        const double change = advance(h, square, next).a - x.a;
        x = next;
        damped += 0.5 * h->damping * change * change;
        const double kinetic = kinetic_of(h, square, x), elastic = square * x.u * x.u;
        size = fmax(size, fabs(kinetic) + elastic);
        assert_true(fabs(kinetic + elastic + damped - *first) < 1e-15 * (n + 10) * size);
    }
    return damped;
}

/* At all spectral radii and frequencies; the highest is 0.999 of the limit, where energies grow
 * 1e5-fold for r = 1. */
static void an_oscillator_keeps_its_balance(void **unused)
{
    for (int i = 0; i <= 20; i++)
        for (int k = 1; k <= 40; k++) {
            const fracas_hulbert_chung h = fracas_hulbert_chung_of(i / 20.0);
            const double omega = 0.999 * h.limit * k / 40;
            double first;
            const double damped = damped_over(&h, omega * omega, 1000, &first);
            assert_true(i == 20 ? damped == 0 : damped > 0);
        }
}

/* An eigenmode loses 1 - rho^2 of its energy in a step, rho by the amplification matrix. The first
 * half period counts whole or not at all: pi/(2 omega dt steps) = 1.6e-3. For slow ones that is
 * ((1 - r)/(1 + r))^3 Omega^4 and a part Omega^2 = 2.5e-3 of it, by a number of the order of 1. */
static void an_oscillator_loses_what_its_root_says(void **unused)
{
    const double radii[] = {0.9, 0.5, 0.2}, omega = 0.05, square = omega * omega;
    for (size_t i = 0; i < 3; i++) {
        const fracas_hulbert_chung h = fracas_hulbert_chung_of(radii[i]);
        const double rho = spectral_radius(&h, square),
                     slow = pow((1 - radii[i]) / (1 + radii[i]), 3) * square * square;
        double first;
        const double damped = damped_over(&h, square, 20000, &first),
                     lost = 1 - pow(rho, 2 * 20000);
        print_message("r %.1f: %.4f of the closed form, %.4f of slow ones\n", radii[i],
                      damped / (first * lost), (1 - rho * rho) / slow);
        assert_true(fabs(damped / (first * lost) - 1) < 4e-3);
        assert_true(fabs((1 - rho * rho) / slow - 1) < 4 * square);
    }
}

/* ---- the membrane ---- */

/* A free plate at rest, 0.2 mm x 0.3 mm and 1 mm thick, E 70 GPa, nu 0.3, rho 2700; G_c 500 J/m2;
 * law nitsche, beta 4, half the critical step of central difference, masses lumped. */
static fracas_spec membrane_reference(int64_t divisions, int64_t order, double end)
{
    fracas_spec spec = surface_spec(&fracas_formulation_membrane, &fracas_shape_plate);
    spec.geometry.width = 2e-4;
    spec.geometry.height = 3e-4;
    spec.geometry.thickness = 1e-3;
    spec.mesh.divisions = divisions;
    spec.mesh.order = order;
    spec.material = (fracas_material){.young = 70e9, .density = 2700, .poisson = 0.3};
    spec.cohesive.fracture_energy = 500;
    spec.cohesive.beta = 4;
    spec.time.end = end;
    spec.time.spectral_radius = 0.9;
    return spec;
}

typedef struct {
    fracas_model *model;
    fracas_batch *batch;
    size_t n;      /* degrees of freedom */
    double *value; /* [n], eigenvalues of M^-1 K, largest first */
    double *mode;  /* [which][n], largest component 1 */
} body;

static body vibrating(const fracas_spec *spec)
{
    body b = {0};
    b.model = make_model(spec);
    b.n = unknowns_of(b.model);
    fracas_surface_operator *op = open_operator(b.model);
    gsl_matrix *matrix = gsl_matrix_alloc(b.n, b.n), *scaled = gsl_matrix_alloc(b.n, b.n);
    OWNED double *u = calloc(b.n, sizeof *u), *a = calloc(b.n, sizeof *a);
    for (size_t j = 0; j < b.n; j++) {
        u[j] = 1;
        fracas_surface_operator_apply(op, u, a);
        u[j] = 0;
        for (size_t i = 0; i < b.n; i++) gsl_matrix_set(matrix, i, j, -a[i]);
    }
    gsl_matrix_memcpy(scaled, matrix);
    gsl_vector_complex *value = gsl_vector_complex_alloc(b.n);
    gsl_matrix_complex *vector = gsl_matrix_complex_alloc(b.n, b.n);
    gsl_eigen_nonsymmv_workspace *work = gsl_eigen_nonsymmv_alloc(b.n);
    gsl_eigen_nonsymmv_params(1, work);
    assert_int_equal(gsl_eigen_nonsymmv(scaled, value, vector, work), 0);
    gsl_eigen_nonsymmv_sort(value, vector, GSL_EIGEN_SORT_ABS_DESC);
    b.value = calloc(b.n, sizeof *b.value);
    b.mode = calloc(b.n * b.n, sizeof *b.mode);
    for (size_t k = 0; k < b.n; k++) {
        double largest = 0;
        b.value[k] = GSL_REAL(gsl_vector_complex_get(value, k));
        for (size_t i = 0; i < b.n; i++) {
            const double part = GSL_REAL(gsl_matrix_complex_get(vector, i, k));
            b.mode[k * b.n + i] = part;
            if (fabs(part) > fabs(largest)) largest = part;
        }
        for (size_t i = 0; i < b.n; i++) b.mode[k * b.n + i] /= largest;
    }
    gsl_eigen_nonsymmv_free(work);
    gsl_matrix_complex_free(vector);
    gsl_vector_complex_free(value);
    gsl_matrix_free(matrix);
    gsl_matrix_free(scaled);
    fracas_surface_operator_close(op);
    return b;
}

static void body_end(body *b)
{
    free(b->value);
    free(b->mode);
    fracas_model_destroy(b->model);
}

/* A batch of which every lane starts with displacement u and velocity v times the mode. */
static void start(body *b, const double *mode, double u, double v)
{
    b->batch = lane_of(b->model, 0, 0, 0);
    for (size_t i = 0; i < b->model->interfaces; i++) bar_set_strength(b->batch, 0, i, 1e9);
    OK(fracas_batch_begin(b->batch));
    for (size_t i = 0; i < b->n; i++) {
        *value_of(b->batch, i, SURFACE_U) = u * mode[i];
        *value_of(b->batch, i, SURFACE_V) = v * mode[i];
    }
}

/* Largest difference of a field from `amplitude` times the mode. */
static double apart(const body *b, const double *mode, int field, double amplitude)
{
    double largest = 0;
    for (size_t i = 0; i < b->n; i++)
        largest = fmax(largest, fabs(*value_of(b->batch, i, field) - amplitude * mode[i]));
    return largest;
}

/* Follows one mode for 300 steps; also where the guard of the energy ends the lane's record, as one
 * coarse mode on its own has an energy v^2 + omega^2 u^2 that swings. GSL's modes are good to 1e-12
 * or so (their remainder is 1e-13 of the largest eigenvalue), and what is not of the mode grows at
 * most with the number of steps (drift of the body as a whole): 300 x 1e-12 and some roundings:
 * 1e-9 of the amplitudes. */
static void follow(body *b, size_t which, double omega_dt)
{
    const fracas_time *time = &b->model->spec.time;
    const bool alpha = time->integrator == &fracas_integrator_hulbert_chung;
    const fracas_hulbert_chung h = fracas_hulbert_chung_of(time->spectral_radius);
    const double *mode = b->mode + which * b->n,
                 dt = b->model->time_step = omega_dt / sqrt(b->value[0]),
                 square = b->value[which] * dt * dt;
    const double u = 1e-10, v = 0.3 * u / dt;
    RECORD(record);
    size_t running;
    double largest = 0, most = 0, start_energy = 0;
    start(b, mode, u, v);
    motion x = {u, v * dt, -square * u};
    for (int n = 0; n < 300; n++) {
        const double before = x.v;
        OK(fracas_batch_step(b->batch, &record, &running));
        double after = x.v;
        if (n > 0 && alpha) x = advance(&h, square, x), after = x.v;
        if (!alpha) {
            if (n > 0) x.u += before;
            x.a = -square * x.u;
            after = x.v = before + x.a;
        }
        /* bounded: by 306 for r = 1 at 0.999 of its limit, where three roots of size 1 lie close
         * together */
        largest = fmax(largest, fmax(fabs(x.u), fabs(x.v)));
        assert_true(largest < 400 * u);
        assert_true(apart(b, mode, SURFACE_U, x.u) < 1e-9 * largest);
        assert_true(apart(b, mode, SURFACE_V, x.v / dt) < 1e-9 * largest / dt);
        if (alpha) {
            const motion next = advance(&h, square, x);
            assert_true(apart(b, mode, SURFACE_A, x.a / (dt * dt)) < 1e-8 * largest / (dt * dt));
            assert_true(apart(b, mode, SURFACE_A_NEXT, next.a / (dt * dt)) <
                        1e-8 * largest / (dt * dt));
        }
        /* energies are those of the number, times the same mass */
        const double kinetic = alpha ? kinetic_of(&h, square, x) : before * after,
                     elastic = square * x.u * x.u;
        most = fmax(most, fabs(b->batch->step.kinetic[0]) + b->batch->step.elastic[0]);
        assert_true(fabs(b->batch->step.kinetic[0] * elastic -
                         b->batch->step.elastic[0] * kinetic) < 1e-8 * most * largest * largest);
        assert_true(b->batch->step.cracked[0] == 0 && b->batch->step.dissipated[0] == 0);
        const double damped =
            b->batch->step.damped[0]; /* in the first step no acceleration changes */
        assert_true(n > 0 && alpha && h.damping > 0 ? n < 3 || damped > 0 : damped == 0);
        /* the strain's own error at 300 steps: each rounds sums of some 30 terms */
        const double now = b->batch->step.kinetic[0] + b->batch->step.elastic[0] +
                           b->batch->step.damped[0];
        if (n == 0) start_energy = now;
        else assert_true(fabs(now - start_energy) < 1e-11 * most);
    }
    fracas_batch_destroy(b->batch);
}

static void the_sweep_is_the_scheme(void **unused)
{
    const double radii[] = {1, 0.95, 0.5, 0.1};
    for (int i = 0; i < 2 * 2 * 5; i++) {
        fracas_spec spec = membrane_reference(1, 1 + i % 2, 1e-3);
        if (i / 2 % 2) spec.time.mass = &fracas_mass_consistent;
        const int scheme = i / 4;
        if (scheme > 0) {
            spec.time.integrator = &fracas_integrator_hulbert_chung;
            spec.time.spectral_radius = radii[scheme - 1];
        }
        body b = vibrating(&spec);
        assert_true(b.model->elements == 2 && b.n == (spec.mesh.order == 1 ? 12 : 24));
        const double limit = scheme ? fracas_hulbert_chung_of(spec.time.spectral_radius).limit : 2;
        /* what the model takes for its critical step is at most its bound, 2e-3 of the square, from
         * the truth */
        const double critical = limit / sqrt(b.value[0]);
        assert_true(b.model->critical_closed < critical * (1 + 1e-6) &&
                    b.model->critical_closed > critical * (1 - 1.5e-3));
        for (size_t which = 0; which + 3 < b.n; which += 2) {
            follow(&b, which, 0.3 * limit);
            follow(&b, which, 0.9 * limit);
        }
        follow(&b, 0, 0.999 * limit);
        body_end(&b);
    }
}

/* The highest mode grows without end 1e-3 above the limit and not below it, in the batch too.
 * Growth by 1e4 or by a few times: above it the root is -(1 + some 1e-3), 20000 steps. */
static void the_batch_blows_up_above_the_limit_only(void **unused)
{
    const double radii[] = {0.9, 0.5};
    for (int i = 0; i < 4; i++) {
        fracas_spec spec = membrane_reference(1, 1, 1);
        spec.time.integrator = &fracas_integrator_hulbert_chung;
        spec.time.spectral_radius = radii[i / 2];
        body b = vibrating(&spec);
        const bool above = i % 2;
        b.model->time_step = (above ? 1.001 : 0.999) * fracas_hulbert_chung_of(radii[i / 2]).limit /
                             sqrt(b.value[0]);
        RECORD(record);
        start(&b, b.mode, 1e-16, 0);
        double largest = 0;
        size_t running = 1;
        for (int n = 0; n < 20000 && largest < 1e-12; n++) {
            OK(fracas_batch_step(b.batch, &record, &running));
            largest = apart(&b, b.mode, SURFACE_U, 0);
        }
        assert_true(above ? largest >= 1e-12 : largest < 1e-15);
        fracas_batch_destroy(b.batch);
        body_end(&b);
    }
}

TESTS(parameters_are_those_of_the_table, roots_are_those_of_the_scheme, second_order,
      an_oscillator_keeps_its_balance, an_oscillator_loses_what_its_root_says,
      the_sweep_is_the_scheme, the_batch_blows_up_above_the_limit_only)
