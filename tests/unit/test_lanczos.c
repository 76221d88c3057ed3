/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lanczos' iteration against GSL's eigenvalues of symmetric pencils K x = lambda M x. */
#include "engine/integrator/lanczos.h"
#include "tests/support/test.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_matrix.h>

enum { MOST = 60 };

typedef struct {
    size_t n;
    double stiffness[MOST][MOST], mass[MOST][MOST], inverse[MOST][MOST]; /* M^-1 */
    double largest;                                                      /* eigenvalue */
    int applied;
} pencil;

static void multiply(const double m[MOST][MOST], size_t n, const double *w, double *result)
{
    for (size_t i = 0; i < n; i++) {
        result[i] = 0;
        for (size_t j = 0; j < n; j++) result[i] += m[i][j] * w[j];
    }
}

static void apply(void *context, const double *w, double *result)
{
    pencil *p = context;
    double force[MOST];
    multiply((const double(*)[MOST])p->stiffness, p->n, w, force);
    multiply((const double(*)[MOST])p->inverse, p->n, force, result);
    p->applied++;
}

static void mass(void *context, const double *w, double *result)
{
    const pencil *p = context;
    multiply(p->mass, p->n, w, result);
}

/* M = B B^T/n + 1/2, K = L Q diag(value) Q^T L^T with M = L L^T and Q orthogonal: its eigenvalues
 * are `value`; GSL says so too. */
static void make(pencil *p, size_t n, const double *value, bool unit_mass, uint64_t *seed)
{
    gsl_matrix *b = gsl_matrix_alloc(n, n), *m = gsl_matrix_alloc(n, n),
               *l = gsl_matrix_alloc(n, n), *k = gsl_matrix_alloc(n, n);
    gsl_matrix *q = gsl_matrix_alloc(n, n), *r = gsl_matrix_alloc(n, n);
    gsl_vector *tau = gsl_vector_alloc(n);
    p->n = n;
    p->applied = 0;
    for (size_t i = 0; i < n * n; i++) b->data[i] = 2 * random_noise(seed);
    gsl_matrix_set_identity(m);
    if (!unit_mass) gsl_blas_dgemm(CblasNoTrans, CblasTrans, 1.0 / (double)n, b, b, 0.5, m);
    gsl_matrix_memcpy(l, m);
    gsl_linalg_cholesky_decomp1(l);
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) gsl_matrix_set(l, i, j, 0);
    for (size_t i = 0; i < n * n; i++) b->data[i] = 2 * random_noise(seed);
    gsl_linalg_QR_decomp(b, tau);
    gsl_linalg_QR_unpack(b, tau, q, r);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1, l, q, 0, b); /* L Q */
    gsl_matrix_memcpy(r, b);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) gsl_matrix_set(r, i, j, gsl_matrix_get(b, i, j) * value[j]);
    gsl_blas_dgemm(CblasNoTrans, CblasTrans, 1, r, b, 0, k);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            p->mass[i][j] = gsl_matrix_get(m, i, j);
            p->stiffness[i][j] = 0.5 * (gsl_matrix_get(k, i, j) + gsl_matrix_get(k, j, i));
        }
    gsl_matrix_memcpy(l, m);
    gsl_linalg_cholesky_decomp1(l);
    gsl_linalg_cholesky_invert(l);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            p->inverse[i][j] = gsl_matrix_get(l, i, j);
            gsl_matrix_set(k, i, j, p->stiffness[i][j]);
        }
    gsl_eigen_gensymm_workspace *work = gsl_eigen_gensymm_alloc(n);
    assert_int_equal(gsl_eigen_gensymm(k, m, tau, work), 0);
    p->largest = gsl_vector_max(tau);
    gsl_eigen_gensymm_free(work);
    gsl_vector_free(tau);
    gsl_matrix *const used[] = {b, m, l, k, q, r};
    for (size_t i = 0; i < sizeof used / sizeof *used; i++) gsl_matrix_free(used[i]);
}

static double solve(pencil *p, uint64_t *seed)
{
    double start[MOST], largest = NAN;
    for (size_t i = 0; i < p->n; i++) start[i] = 2 * random_noise(seed);
    OK(fracas_lanczos(&(fracas_lanczos_problem){apply, mass, p, p->n}, start, &largest));
    return largest;
}

/* Random spectra. theta <= lambda by Rayleigh and Ritz, so that the result exceeds lambda by the
 * bound at most, 2e-3 theta. From below: the bound holds for some eigenvalue. The top one's share
 * of the start, 1/n at random, grows in k steps by cosh^2(2 k sqrt(gap)) at least of what the
 * others keep, and 20 steps are what the calm ones and those before them come to: 7e2 for a gap of
 * 1e-2, too much to go unseen; 2 for a gap of 1e-3, which may. Then the result is the second
 * eigenvalue: 2e-3. */
static void random_pencils(void **unused)
{
    static pencil p;
    uint64_t seed = 1;
    for (int i = 0; i < 600; i++) {
        const size_t n = 1 + (size_t)i % MOST;
        double value[MOST], second = 0, top = 0;
        const double skew =
            i / 60 %
            5; /* dense at the top (0), or at the bottom: as meshes with small elements have it */
        for (size_t j = 0; j < n; j++) {
            value[j] = 1e10 * pow(0.5 * (1 + 2 * random_noise(&seed)), 1 + skew);
            if (j < n / 6) value[j] = 0; /* motions of the body as a whole */
            second = fmax(second, fmin(top, value[j]));
            top = fmax(top, value[j]);
        }
        make(&p, n, value, i % 2, &seed);
        if (top > 0) assert_true(fabs(p.largest / top - 1) < 1e-10);
        const double result = solve(&p, &seed), gap = (top - second) / top;
        assert_true(result <= top * (1 + 2e-3) + 1e-12 * top);
        assert_true(result >= top * (1 - 2e-3));
        if (gap > 1e-2) assert_true(result >= top * (1 - 1e-9));
        assert_true(p.applied <= 200);
    }
}

/* Eigenvalues that occur two, three, n times: the iteration has fewer steps than n. Of distinct
 * ones of which the smallest gap is a fifth, the invariant subspace is found and the result is
 * theirs to round-off: 1e-12 is where it stops, 60 roundings beside; with the bound where it stops
 * before. */
static void multiple_eigenvalues(void **unused)
{
    static pencil p;
    uint64_t seed = 2;
    for (int i = 0; i < 240; i++) {
        const size_t n = 1 + (size_t)i % MOST, distinct = 1 + (size_t)i / MOST;
        double value[MOST];
        for (size_t j = 0; j < n; j++) value[j] = 3e8 * (double)(1 + j % distinct);
        const double top = 3e8 * (double)(n < distinct ? n : distinct);
        make(&p, n, value, i % 3 == 0, &seed);
        const double result = solve(&p, &seed);
        assert_true(fabs(result / top - 1) < 1e-10);
        assert_true(p.applied <= (int)distinct + 1);
    }
}

/* One degree of freedom; nothing at all; a start that has nothing of the largest mode: the largest
 * of the others. */
static void small_ones(void **unused)
{
    static pencil p;
    double largest;
    p = (pencil){.n = 1, .stiffness = {{6}}, .mass = {{2}}, .inverse = {{0.5}}};
    OK(fracas_lanczos(&(fracas_lanczos_problem){apply, mass, &p, 1}, (double[]){-0.3}, &largest));
    assert_true(fabs(largest - 3) < 1e-14 && p.applied == 1);
    p.stiffness[0][0] = 0;
    OK(fracas_lanczos(&(fracas_lanczos_problem){apply, mass, &p, 1}, (double[]){1}, &largest));
    assert_true(largest == 0);
    p = (pencil){.n = 3,
                 .stiffness = {{5}, {0, 2}, {0, 0, 1}},
                 .mass = {{1}, {0, 1}, {0, 0, 1}},
                 .inverse = {{1}, {0, 1}, {0, 0, 1}}};
    OK(fracas_lanczos(&(fracas_lanczos_problem){apply, mass, &p, 3}, (double[]){0, 1, 1},
                      &largest));
    assert_true(fabs(largest - 2) < 1e-12);
    OK(fracas_lanczos(&(fracas_lanczos_problem){apply, mass, &p, 3}, (double[]){1e-8, 1, 1},
                      &largest));
    assert_true(fabs(largest - 5) < 1e-9);
}

/* A start all of whose parts are alike in the modes of a chain, 2 - 2 cos(pi k/(n + 1)): the
 * densest top a mesh has. It stops by its bound, or has found every mode. */
static void the_top_of_a_chain(void **unused)
{
    static pencil p;
    for (size_t n = 2; n <= MOST; n++) {
        p = (pencil){.n = n};
        double start[MOST], largest;
        for (size_t i = 0; i < n; i++) {
            p.stiffness[i][i] = 2;
            p.mass[i][i] = p.inverse[i][i] = 1;
            if (i > 0) p.stiffness[i][i - 1] = p.stiffness[i - 1][i] = -1;
            start[i] = 0;
            for (size_t k = 1; k <= n; k++)
                start[i] += sin(3.14159265358979323846 * (double)(k * (i + 1)) / (double)(n + 1));
        }
        OK(fracas_lanczos(&(fracas_lanczos_problem){apply, mass, &p, n}, start, &largest));
        const double top = 2 + 2 * cos(3.14159265358979323846 / (double)(n + 1)),
                     second = 2 + 2 * cos(2 * 3.14159265358979323846 / (double)(n + 1));
        assert_true(largest <= top * (1 + 2e-3) &&
                    largest >= fmin(top, fmax(second, top * (1 - 2e-3))) - 1e-12);
    }
}

TESTS(random_pencils, multiple_eigenvalues, small_ones, the_top_of_a_chain)
