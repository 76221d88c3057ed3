/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Correlated strengths: covariances and laws over realizations, and that a strength depends on its
 * name alone. Seeds are fixed; every bound is one that a right sampler exceeds with probability
 * ALPHA or less. */
#include "sampler/field/sparse_factor.h"
#include "sampler/api/sampler.h"
#include "tests/support/sites.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>
#include <inttypes.h>

#define ALPHA 1e-6

enum { N = FRACAS_DENSE_SITES + 100, LINE = 80, REALIZATIONS = 3000, WATCHED = 8 };
static double position[N][3], sigma_c[N];
static fracas_extent extent[N];

static fracas_field *field_over(const fracas_strength *strength, size_t n, size_t points,
                                double period)
{
    fracas_field *field;
    for (size_t i = 0; i < N; i++) extent[i] = (fracas_extent){1e-9 * (double)(1 + i % 7), 1e-6};
    const fracas_sites sites = {.n = n,
                                .points = points,
                                .extent = extent,
                                .position = (const double(*)[3])position,
                                .period = period};
    if (fracas_field_create(strength, &sites, &field)) fail_msg("%s", fracas_message());
    assert_int_equal(fracas_field_size(field), n * points);
    return field;
}

static fracas_stream stream(uint64_t replica)
{
    return (fracas_stream){
        .seed = 5, .purpose = FRACAS_PURPOSE_STRENGTH, .point = {11, 22}, .replica = replica};
}

static double of_covariance(const fracas_strength *strength, size_t i, size_t j, double period)
{
    OWN(fracas_covariance) covariance;
    double d2 = 0;
    for (int a = 0; a < 3; a++)
        d2 += (position[i][a] - position[j][a]) * (position[i][a] - position[j][a]);
    OK(fracas_covariance_create(strength, &covariance));
    return fracas_covariance_at(
        covariance, period > 0 ? period / M_PI * fabs(sin(M_PI * sqrt(d2) / period)) : sqrt(d2));
}

/* z_i z_j = ((z_i + z_j)^2 - (z_i - z_j)^2)/4, and the two squares are independent, 2 (1 + r) and 2
 * (1 - r) times chi^2 of one degree of freedom: their means over R realizations are chi^2_R/R,
 * within the quantiles of ALPHA/4 each but with probability ALPHA. r is within the field's error of
 * the covariance, and the squares change by less than 2.5 times that (|chi^2_R/R - 1| < 1/4). */
static void assert_correlated(double product, double rho, double error)
{
    const double low = gsl_cdf_chisq_Pinv(ALPHA / 4, REALIZATIONS) / REALIZATIONS,
                 high = gsl_cdf_chisq_Qinv(ALPHA / 4, REALIZATIONS) / REALIZATIONS;
    const double least = ((1 + rho) * low - (1 - rho) * high) / 2,
                 most = ((1 + rho) * high - (1 - rho) * low) / 2;
    if (product < least - 2.5 * error || product > most + 2.5 * error)
        fail_msg("mean of products %g, between %g and %g", product, least, most);
}

static void check_covariances(const fracas_strength *strength, size_t n, double period)
{
    OWN(fracas_field) field = field_over(strength, n, 1, period);
    double product[WATCHED][WATCHED] = {{0}};
    size_t site[WATCHED];
    for (size_t a = 0; a < WATCHED; a++)
        site[a] = n - 1 - a * a * (n / 70); /* near to each other, and far */
    for (uint64_t r = 0; r < REALIZATIONS; r++) {
        const fracas_stream named = stream(r);
        OK(fracas_field_sample(field, &named, 1, sigma_c));
        for (size_t a = 0; a < WATCHED; a++)
            for (size_t b = 0; b <= a; b++)
                product[a][b] += log(sigma_c[site[a]]) * log(sigma_c[site[b]]) / REALIZATIONS;
    }
    for (size_t a = 0; a < WATCHED; a++)
        for (size_t b = 0; b <= a; b++)
            assert_correlated(product[a][b], of_covariance(strength, site[a], site[b], period),
                              fracas_field_error(field));
}

static void samples_have_the_covariance(void **state)
{
    const fracas_strength exponential = correlated(&fracas_covariance_exponential, 0.2, NAN);
    const fracas_strength matern = correlated(&fracas_covariance_matern, 0.1, 2.2);
    sites_on_line(LINE, 1, position);
    check_covariances(&exponential, LINE, 0);
    sites_on_circle(LINE, 0.2, position);
    check_covariances(&matern, LINE, 0);
    for (size_t i = 0; i < LINE; i++)
        memcpy(position[i], (double[3]){(double)i / LINE, 0, 0}, sizeof position[i]);
    check_covariances(&exponential, LINE, 1);
    sites_scattered(N, position);
    check_covariances(&matern, N, 0);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* D = sup |F_n - F| exceeds sqrt(ln(2/alpha)/(2 n)) with a probability below alpha (Massart 1990).
 */
static void assert_uniform(double *u, size_t n)
{
    double distance = 0;
    qsort(u, n, sizeof *u, ascending);
    for (size_t i = 0; i < n; i++)
        distance = fmax(distance,
                        fmax(u[i] - (double)i / (double)n, (double)(i + 1) / (double)n - u[i]));
    print_message("D = %.2e\n", distance);
    assert_true(distance < sqrt(log(2 / ALPHA) / (2 * (double)n)));
}

/* Whatever the covariance, each strength alone has its own distribution, which depends on its
 * extent: of Weibull's law by the law, of flaws by their number there. */
static void each_strength_follows_its_law(void **state)
{
    static double u[2][WATCHED][REALIZATIONS];
    fracas_strength laws[2] = {correlated(&fracas_covariance_exponential, 0.3, NAN),
                               correlated(&fracas_covariance_matern, 5, NAN)};
    for (size_t k = 0; k < fracas_strength_section.nkinds; k++) {
        const fracas_kind *kind = fracas_strength_section.kinds[k];
        if (strcmp(kind->name, "weibull") == 0) laws[0].distribution = kind;
        if (strcmp(kind->name, "flaws") == 0) laws[1].distribution = kind;
    }
    laws[0].scale = 50e6, laws[0].shape = 2, laws[0].minimum = 264e6;
    laws[1].own[0] = 40e9, laws[1].minimum = 100e6, laws[1].maximum = 400e6,
    laws[1].own[1] = 4; /* 40 in 1e-9 m3: all but e^-40 below the maximum */
    sites_scattered(N, position);
    for (size_t law = 0; law < 2; law++) {
        OWN(fracas_field) field = field_over(&laws[law], N, 1, 0);
        for (uint64_t r = 0; r < REALIZATIONS; r++) {
            const fracas_stream named = stream(r);
            OK(fracas_field_sample(field, &named, 1, sigma_c));
            for (size_t a = 0; a < WATCHED; a++) {
                const size_t i = a * (N - 1) / (WATCHED - 1);
                const double s = sigma_c[i];
                u[law][a][r] = law == 0
                                   ? gsl_cdf_weibull_P(s - 264e6, 50e6, 2)
                                   : -expm1(-40e9 * extent[i].volume * pow((s - 100e6) / 300e6, 4));
            }
        }
        for (size_t a = 0; a < WATCHED; a++) assert_uniform(u[law][a], REALIZATIONS);
    }
}

static uint64_t digest(const double *value, size_t n, size_t stride)
{
    uint64_t sum = 14695981039346656037u; /* FNV-1a, by words */
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &value[i * stride], sizeof bits);
        sum = (sum ^ bits) * 1099511628211u;
    }
    return sum;
}

/* The same bits at any stride, asked in any order, from a field made anew; the digests notice a
 * compiler that disagrees. */
static void a_strength_depends_on_its_name_alone(void **state)
{
    static const uint64_t expected[4] = {0xd80c86043f5d360eu, 0xc60103191eff18b5u,
                                         0xa79f810e7f389460u, 0x410ac76c66bfac9fu};
    static double lanes[8 * N];
    for (int body = 0; body < 4; body++) {
        const fracas_strength strength = correlated(body % 2 ? &fracas_covariance_matern
                                                             : &fracas_covariance_exponential,
                                                    0.1, body == 1 ? 0.7 : NAN);
        const size_t n = body < 2 ? 77 : body == 2 ? N : 60;
        if (body == 0) sites_on_line(n, 1, position);
        else if (body == 1) sites_on_circle(n, 1, position);
        else sites_scattered(N, position);
        OWN(fracas_field) first = field_over(&strength, n, 1, 0),
                          *second = field_over(&strength, n, 1, 0);
        uint64_t of[3];
        for (uint64_t r = 0; r < 3; r++) {
            const fracas_stream named = stream(r);
            OK(fracas_field_sample(first, &named, 1, sigma_c));
            of[r] = digest(sigma_c, n, 1);
        }
        for (uint64_t r = 3; r-- > 0;) {
            const fracas_stream named = stream(r);
            memset(lanes, 0, sizeof lanes);
            OK(fracas_field_sample(second, &named, 8, lanes + r));
            assert_true(digest(lanes + r, n, 8) == of[r] && lanes[r + 1] == 0);
        }
        assert_true(of[0] != of[1] && of[1] != of[2]);
        print_message("body %d: 0x%" PRIx64 "\n", body, of[0]);
        assert_true(of[0] == expected[body]);
    }
}

/* The sites of a mesh with several Gauss points are those of a mesh with as many interfaces; only
 * the names of their uniform numbers differ, and extents are those of the interface. */
static void gauss_points_are_sites(void **state)
{
    const fracas_strength strength = correlated(&fracas_covariance_exponential, 1e9,
                                                NAN); /* all are alike */
    const fracas_stream named = stream(0);
    sites_scattered(60, position);
    fracas_field *field = field_over(&strength, 20, 3, 0);
    OK(fracas_field_sample(field, &named, 1, sigma_c));
    /* Increments have a variance 2 d/l < 3e-9 of which 10 standard deviations are 5e-4. */
    for (size_t k = 1; k < 60; k++) assert_true(fabs(log(sigma_c[k] / sigma_c[0])) < 1e-3);
    fracas_field_destroy(field);
    const fracas_strength apart = correlated(&fracas_covariance_exponential, 1e-12,
                                             NAN); /* all are independent: w itself */
    field = field_over(&apart, 20, 3, 0);
    OK(fracas_field_sample(field, &named, 1, sigma_c));
    for (size_t k = 0; k < 60;
         k++) { /* the logarithm of strengths of 1e-3 to 1e3 to 1e-14 of its size */
        const double u = fracas_stream_uniform(&named, fracas_stream_site(k / 3, k % 3));
        assert_true(fabs(log(sigma_c[k]) - gsl_cdf_ugaussian_Pinv(u)) < 1e-13);
    }
    assert_true(fracas_field_error(field) < 1e-15);
    fracas_field_destroy(field);
}

TESTS(samples_have_the_covariance, each_strength_follows_its_law,
      a_strength_depends_on_its_name_alone, gauss_points_are_sites)
