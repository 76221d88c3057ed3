/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Covariances against GSL, and the covariances of normal fields, found from the factors and not by
 * sampling, against them.
 */
#include "sampler/field/circulant.h"
#include "sampler/field/correlation.h"
#include "sampler/field/dense_factor.h"
#include "sampler/field/order.h"
#include "sampler/field/sparse_factor.h"
#include "tests/support/sites.h"

#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_gamma.h>

/* What a product of some hundred roundings may be wrong by. */
#define ROUNDED 1e-12

enum { MOST = 4000 };
static double sites[MOST][3];
#define SITES ((const double(*)[3])sites)

static fracas_covariance *covariance_of(const fracas_strength *strength)
{
    fracas_covariance *covariance;
    OK(fracas_covariance_create(strength, &covariance));
    return covariance;
}

/* ---- covariances ---- */

static double exact(const fracas_strength *strength, double d)
{
    const double l = strength->correlation_length,
                 nu = strength->smoothness > 0 ? strength->smoothness : 1.5,
                 x = sqrt(2 * nu) * d / l;
    if (d == 0) return 1;
    if (strength->covariance == &fracas_covariance_exponential) return exp(-d / l);
    if (strength->covariance == &fracas_covariance_gaussian) return exp(-d * d / (2 * l * l));
    if (x > 700) return 0;
    return exp((1 - nu) * M_LN2 - gsl_sf_lngamma(nu) + nu * log(x) + gsl_sf_bessel_lnKnu(nu, x));
}

/* GSL's logarithms, of size up to some 100, round to 1e-14 times that. */
static void covariances_are_those_of_gsl(void **state)
{
    static const double smoothness[] = {0.1, 0.3, 0.5, 0.50001, 0.8, 1,   1.5, 1.9, 2,
                                        2.5, 3.3, 4.5, 6,       7.7, 9.5, 10,  NAN};
    double worst = 0;
    for (size_t s = 0; s < sizeof smoothness / sizeof *smoothness; s++) {
        const fracas_strength strength = correlated(&fracas_covariance_matern, 3e-3, smoothness[s]);
        OWN(fracas_covariance) covariance = covariance_of(&strength);
        double before = 1;
        assert_true(fracas_covariance_at(covariance, 0) == 1);
        for (double d = 3e-9; d < 3; d *= 1.013) {
            const double rho = fracas_covariance_at(covariance, d);
            worst = fmax(worst, fabs(rho - exact(&strength, d)));
            assert_true(rho <= before + 1e-15 && rho >= 0);
            before = rho;
        }
        assert_true(fracas_covariance_at(covariance, 1e-40) > 1 - 1e-5 &&
                    fracas_covariance_at(covariance, 1e40) == 0);
    }
    const fracas_kind *const others[] = {&fracas_covariance_exponential,
                                         &fracas_covariance_gaussian};
    for (size_t k = 0; k < 2; k++) {
        const fracas_strength strength = correlated(others[k], 3e-3, NAN);
        OWN(fracas_covariance) covariance = covariance_of(&strength);
        for (double d = 3e-9; d < 3; d *= 1.1)
            worst = fmax(worst, fabs(fracas_covariance_at(covariance, d) - exact(&strength, d)));
    }
    print_message("covariances: %.2e\n", worst);
    assert_true(worst < 1e-13);
}

/* Strengths that are given, or all the same, are not drawn from any field. */
static void only_strengths_that_are_drawn_are_correlated(void **state)
{
    static const struct {
        const char *distribution, *message;
    } table[] = {
        {"file", "`covariance` is of strengths that are drawn, and those of distribution `file` "
                 "are given: leave it out"},
        {"positions", "`covariance` is of strengths that are drawn, and those of distribution "
                      "`positions` are given: leave it out"},
        {"constant", "`covariance` changes nothing where all strengths are the same"},
    };
    const fracas_attachment file = attached("s.csv", "0 0 3\n");
    for (size_t t = 0; t < FRACAS_COUNT(table); t++)
        for (size_t k = 0; k < fracas_strength_section.nkinds; k++) {
            fracas_strength strength = {
                .distribution = fracas_strength_section.kinds[k], .file = &file, .value = 3e8};
            if (strcmp(strength.distribution->name, table[t].distribution) != 0) continue;
            OK(fracas_strength_check(&strength));
            strength.covariance = &fracas_covariance_exponential;
            strength.correlation_length = 1e-3;
            FAILS(fracas_strength_check(&strength), FRACAS_USAGE, table[t].message);
        }
}

/* ---- few sites: the whole factor ---- */

/* A, a row for each site, by its columns. */
static double *factor_of(const fracas_correlation *correlation, size_t n)
{
    const size_t count = fracas_correlation_normals(correlation);
    double *a = calloc(n * count + 1, sizeof *a);
    OWNED double *w = calloc(count + 1, sizeof *w), *z = calloc(n + 1, sizeof *z);
    for (size_t k = 0; k < count; k++) {
        w[k] = 1;
        OK(fracas_correlation_apply(correlation, w, z));
        w[k] = 0;
        for (size_t i = 0; i < n; i++) a[i * count + k] = z[i];
    }
    return a;
}

/* The largest error of A A^T; distances are those of the circle where there is a period. */
static double error_of(const fracas_strength *strength, size_t n, double period, const char *what)
{
    OWN(fracas_correlation) correlation;
    OK(fracas_correlation_create(strength, n, SITES, period, &correlation));
    const size_t count = fracas_correlation_normals(correlation);
    double *a = factor_of(correlation, n), worst = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            double product = 0;
            for (size_t k = 0; k < count; k++) product += a[i * count + k] * a[j * count + k];
            assert_true(isfinite(product)); /* fmax leaves out NaN */
            double d = fracas_distance(sites[i], sites[j]);
            if (period > 0) d = period / M_PI * fabs(sin(M_PI * d / period));
            worst = fmax(worst, fabs(product - exact(strength, d)));
        }
    if (worst >= ROUNDED)
        print_message("%s, %zu sites, %zu normals: %.1e\n", what, n, count, worst);
    assert_true(fracas_correlation_error(correlation) < ROUNDED);
    free(a);
    return worst;
}

static void few_sites_have_the_covariance(void **state)
{
    static const size_t counts[] = {0, 1, 2, 3, 4, 5, 7, 12, 61, 100};
    static const double lengths[] = {1e-9, 0.01, 0.3, 2};
    const fracas_kind *const kinds[] = {&fracas_covariance_exponential, &fracas_covariance_matern};
    for (size_t c = 0; c < 10; c++)
        for (size_t l = 0; l < 4; l++)
            for (size_t k = 0; k < 2; k++) {
                const fracas_strength strength = correlated(kinds[k], lengths[l], NAN);
                sites_on_circle(counts[c], 0.7, sites);
                assert_true(error_of(&strength, counts[c], 0, "circle") < ROUNDED);
                sites_on_line(counts[c], 1.0, sites);
                assert_true(error_of(&strength, counts[c], 0, "line") < ROUNDED);
                for (size_t i = 0; i < counts[c]; i++) sites[i][1] = sites[i][2] = 0;
                for (size_t i = 0; i < counts[c]; i++) sites[i][0] = (double)i / (double)counts[c];
                assert_true(error_of(&strength, counts[c], 1.0, "periodic bar") < ROUNDED);
                sites_scattered(counts[c], sites);
                assert_true(error_of(&strength, counts[c], 0, "scattered") < ROUNDED);
            }
}

/* Circles and lines of the right size are drawn as such, others are not. */
static size_t normals_of(size_t n, const fracas_kind *kind, double length)
{
    const fracas_strength strength = correlated(kind, length, NAN);
    OWN(fracas_correlation) correlation;
    OK(fracas_correlation_create(&strength, n, SITES, 0, &correlation));
    return fracas_correlation_normals(correlation);
}

static void lines_are_told_from_others(void **state)
{
    sites_on_line(100, 1.0, sites);
    assert_int_equal(normals_of(100, &fracas_covariance_exponential, 0.3), 256);
    assert_true(normals_of(100, &fracas_covariance_matern, 0.3) >=
                512); /* larger circles are tried */
    assert_int_equal(normals_of(100, &fracas_covariance_gaussian, 400),
                     100);      /* none does, and so few need none */
    sites[50][0] += 1e-7 / 100; /* of the spacing */
    assert_int_equal(normals_of(100, &fracas_covariance_exponential, 0.3), 100);
    for (size_t i = 0; i < 100; i++) sites[i][0] = sites[i][1] = sites[i][2] = 1;
    assert_int_equal(normals_of(100, &fracas_covariance_exponential, 0.3), 100);
}

/* Sites that move off a circle, or are visited in another order, are not one: the correlations stay
 * right. */
static void broken_circles_are_scattered(void **state)
{
    const fracas_strength strength = correlated(&fracas_covariance_exponential, 0.3, NAN);
    for (int way = 0; way < 6; way++) {
        sites_on_circle(30, 0.7, sites);
        if (way == 0) sites[17][2] += 1e-3;
        for (size_t i = 0; i < 30 && way == 1; i++) sites[i][1] *= 1.01;
        for (size_t i = 0; i < 30 && way == 2; i++) sites[i][0] = sites[i * 7 % 30][0];
        if (way == 3)
            for (int a = 0; a < 3; a++) sites[5][a] = sites[6][a]; /* two at one place */
        for (size_t i = 0; i < 30 && way == 4; i++)
            sites[i][0] = sites[i][1] = sites[i][2] = 0.1; /* all are */
        for (int a = 0; a < 3 && way == 5; a++) {          /* two change places */
            const double x = sites[11][a];
            sites[11][a] = sites[20][a];
            sites[20][a] = x;
        }
        assert_true(error_of(&strength, 30, 0, "broken circle") < ROUNDED);
    }
}

/* A covariance that is singular takes as many normals as it has rank: all sites are at a few
 * places, or a field is so smooth that few of its eigenvalues are no rounding. */
static void singular_covariances_are_factorised(void **state)
{
    enum { N = 120, PLACES = 7 };
    for (int way = 0; way < 2; way++) {
        const fracas_strength strength = correlated(
            way ? &fracas_covariance_gaussian : &fracas_covariance_exponential, way ? 3 : 0.3, NAN);
        OWN(fracas_covariance) covariance = covariance_of(&strength);
        FRACAS_CLEARED(fracas_dense_factor) factor;
        uint32_t order[N];
        sites_scattered(N, sites);
        for (size_t i = 0; i < N; i++) {
            order[i] = (uint32_t)i;
            for (int a = 0; a < 3 && way == 0; a++) sites[i][a] = sites[i % PLACES][a];
        }
        OK(fracas_dense_factor_init(covariance, SITES, N, order, &factor));
        print_message("%d sites, rank %zu\n", N, factor.rank);
        assert_true(way ? factor.rank > PLACES && factor.rank < N / 2 : factor.rank == PLACES);
        assert_true(error_of(&strength, N, 0, "singular") < ROUNDED);
    }
}

/* A smooth covariance of a long length on many sites has no circle: the error is stated. A cosine
 * is an eigenvector of the circle, so what the factor makes of it at site 0 is the root of the
 * eigenvalue. Those of more than 60 waves together are what lacks in the variance, 1, and change no
 * correlation by more. */
static void no_circle_is_long_enough(void **state)
{
    enum { N = 1200, WAVES = 60 };
    const fracas_strength strength = correlated(&fracas_covariance_gaussian, 1.6e4, NAN);
    OWN(fracas_covariance) covariance = covariance_of(&strength);
    OWN(fracas_circulant) circulant;
    OK(fracas_circulant_line(covariance, N, 1.0, &circulant));
    const size_t size = fracas_circulant_normals(circulant);
    assert_int_equal(size, 1 << 17); /* no larger one is tried */
    double *w = malloc(size * sizeof *w), z[N], rho[N] = {0}, worst = 0;
    for (size_t m = 0; m <= WAVES; m++) {
        for (size_t k = 0; k < size; k++)
            w[k] = cos(2 * M_PI * (double)(m * k % size) / (double)size);
        OK(fracas_circulant_apply(circulant, w, z));
        for (size_t i = 0; i < N; i++)
            rho[i] += (m ? 2 : 1) * z[0] * z[0] / (double)size *
                      cos(2 * M_PI * (double)(m * i % size) / (double)size);
    }
    for (size_t i = 0; i < N; i++) worst = fmax(worst, fabs(rho[i] - exact(&strength, (double)i)));
    const double lacks = 1 - rho[0], stated = fracas_circulant_error(circulant);
    print_message("clipped: %zu normals, error %.3e, stated %.3e, %.1e is lacking\n", size, worst,
                  stated, lacks);
    assert_true(lacks > -ROUNDED && lacks < 0.25 * stated &&
                fabs(worst - stated) < lacks + ROUNDED);
    free(w);
}

/* ---- many sites ---- */

static fracas_sparse_factor *sparse_of(const fracas_strength *strength, size_t n)
{
    OWN(fracas_covariance) covariance = covariance_of(strength);
    fracas_sparse_factor *factor;
    OK(fracas_sparse_factor_create(covariance, n, SITES, &factor));
    return factor;
}

/* The largest error of the pairs of every `step`-th site with all, and that of its variance. */
static double error_of_pairs(const fracas_strength *strength, const fracas_sparse_factor *factor,
                             size_t n, size_t step, double *of_variance)
{
    double *rho = malloc(n * sizeof *rho), worst = 0;
    *of_variance = 0;
    for (size_t i = 0; i < n; i += step) {
        OK(fracas_sparse_factor_correlation(factor, i, rho));
        for (size_t j = 0; j < n; j++) {
            assert_true(isfinite(rho[j])); /* fmax leaves out NaN */
            worst = fmax(worst,
                         fabs(rho[j] - exact(strength, fracas_distance(sites[i], sites[j]))));
        }
        *of_variance = fmax(*of_variance, fabs(rho[i] - 1));
    }
    free(rho);
    return worst;
}

/* The error is a maximum that is searched for: it may miss the largest, but not by half of it. */
static void errors_are_stated(void **state)
{
    enum { N = 1300 };
    static const struct {
        const fracas_kind *kind;
        double length, smoothness, most;
        size_t step;
    } cases[] = {
        {&fracas_covariance_exponential, 0.4, NAN, 5e-3, 1},
        {&fracas_covariance_matern, 0.05, 1.5, 5e-3, 1},
        {&fracas_covariance_matern, 0.4, 0.8, 5e-3, 1},
        {&fracas_covariance_gaussian, 0.2, NAN, 1e-4, 10},
        {&fracas_covariance_exponential, 1e-9, NAN, 0, 10},
        {&fracas_covariance_exponential, 1e9, NAN, 1e-6, 10},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const fracas_strength strength = correlated(cases[c].kind, cases[c].length,
                                                    cases[c].smoothness);
        double of_variance;
        sites_scattered(N, sites);
        OWN(fracas_sparse_factor) factor = sparse_of(&strength, N);
        const double stated = fracas_sparse_factor_error(factor),
                     worst = error_of_pairs(&strength, factor, N, cases[c].step, &of_variance);
        print_message("%s, length %g: error %.2e, stated %.2e, of a variance %.1e\n",
                      cases[c].kind->name, cases[c].length, worst, stated, of_variance);
        assert_true(worst <= 1.5 * stated + ROUNDED &&
                    (cases[c].step > 1 || stated <= worst + ROUNDED) &&
                    worst <= cases[c].most + ROUNDED);
        assert_true(of_variance < ROUNDED);
    }
}

/* A row of A A^T as the factor finds it, and from the columns of A. */
static void correlations_are_those_of_the_factor(void **state)
{
    enum { N = FRACAS_DENSE_SITES + 200, ROWS = 6 };
    const fracas_strength strength = correlated(&fracas_covariance_matern, 0.1, NAN);
    static double w[N], z[N], rho[ROWS][N], product[ROWS][N];
    sites_scattered(N, sites);
    OWN(fracas_sparse_factor) factor = sparse_of(&strength, N);
    for (size_t k = 0; k < N; k++) {
        w[k] = 1;
        OK(fracas_sparse_factor_apply(factor, w, z));
        w[k] = 0;
        for (size_t r = 0; r < ROWS; r++)
            for (size_t i = 0; i < N; i++) product[r][i] += z[r * N / ROWS] * z[i];
    }
    for (size_t r = 0; r < ROWS; r++) {
        OK(fracas_sparse_factor_correlation(factor, r * N / ROWS, rho[r]));
        for (size_t i = 0; i < N; i++) assert_true(fabs(rho[r][i] - product[r][i]) < ROUNDED);
    }
}

/* On a line, values of an exponential covariance given those at the next site on either side depend
 * on no other: the factor is exact but for rounding. So it is for sites that are there twice. */
static void markov_fields_are_exact(void **state)
{
    const fracas_strength strength = correlated(&fracas_covariance_exponential, 0.02, NAN);
    enum { LINE = 1400 };
    for (size_t copies = 1; copies <= 2; copies++) {
        double of_variance;
        for (size_t i = 0; i < LINE; i++) {
            sites[i][0] = fmod((double)(i / copies) * 0.6180339887498949, 1.0);
            sites[i][1] = sites[i][2] = 0;
        }
        OWN(fracas_sparse_factor) factor = sparse_of(&strength, LINE);
        const double worst = error_of_pairs(&strength, factor, LINE, 10, &of_variance);
        print_message("sites on a line: %.1e\n", worst);
        assert_true(worst < 1e-11 && of_variance < ROUNDED);
    }
}

/* As many sites at one place as a site is drawn from and more: all but one of them are left out. */
static void sites_may_be_at_one_place(void **state)
{
    enum { N = 2 * FRACAS_DENSE_SITES + 500, COPIES = 4 * FRACAS_NEAR_SITES };
    const fracas_strength strength = correlated(&fracas_covariance_matern, 0.1, NAN);
    double of_variance;
    sites_scattered(N, sites);
    for (size_t i = 0; i < N; i++) /* a cluster of COPIES, and the rest by twos */
        for (int a = 0; a < 3; a++) sites[i][a] = sites[i < COPIES ? 0 : i / 2 * 2][a];
    OWN(fracas_sparse_factor) factor = sparse_of(&strength, N);
    const double stated = fracas_sparse_factor_error(factor),
                 worst = error_of_pairs(&strength, factor, N, 10, &of_variance);
    print_message("sites at one place: %.1e, stated %.1e\n", worst, stated);
    assert_true(worst <= 5e-3 && worst <= 1.5 * stated + ROUNDED && of_variance < ROUNDED);
}

/* ---- the order ---- */

static void orders_go_from_coarse_to_fine(void **state)
{
    enum { N = 3000, FIRST = 100, M = 20 };
    static uint32_t order[N], near[(N - FIRST) * M];
    static bool seen[N];
    double spacing = INFINITY;
    sites_scattered(N, sites);
    OK(fracas_order_sites(N, SITES, FIRST, M, order, near));
    for (size_t k = 0; k < N; k++) {
        double d[N];
        assert_true(order[k] < N && !seen[order[k]]);
        seen[order[k]] = true;
        double nearest = INFINITY;
        for (size_t j = 0; j < k; j++)
            nearest = fmin(nearest, d[j] = fracas_distance(sites[order[k]], sites[order[j]]));
        if (k > 0)
            assert_true(nearest < spacing / 0.79); /* a level's spacing is 0.8 of that before, and
                                                      its sites are further apart */
        spacing = fmin(spacing, nearest);
        if (k < FIRST) continue;
        for (size_t a = 0; a < M; a++) { /* as many are nearer as come before it, but for ties */
            const uint32_t place = near[(k - FIRST) * M + a];
            size_t nearer = 0, as_near = 0;
            assert_true(place < k);
            for (size_t j = 0; j < k; j++) {
                nearer += d[j] < d[place] * (1 - 1e-14);
                as_near += d[j] <= d[place] * (1 + 1e-14);
            }
            assert_true(nearer <= a && a < as_near);
        }
    }
}

TESTS(covariances_are_those_of_gsl, only_strengths_that_are_drawn_are_correlated,
      few_sites_have_the_covariance, lines_are_told_from_others, broken_circles_are_scattered,
      singular_covariances_are_factorised, no_circle_is_long_enough, errors_are_stated,
      correlations_are_those_of_the_factor, markov_fields_are_exact, sites_may_be_at_one_place,
      orders_go_from_coarse_to_fine)
