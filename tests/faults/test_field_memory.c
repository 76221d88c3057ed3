/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making a strength field and drawing from it when the k-th allocation fails, for every k: an
 * error, never a crash, and nothing left. */
#include "sampler/field/sparse_factor.h"
#include "sampler/api/sampler.h"
#include "tests/support/sites.h"

#ifdef __SANITIZE_ADDRESS__
/* AddressSanitizer owns malloc; this program has nothing to do there. */
int fracas_test(void)
{
    return 0;
}
#else

#include "tests/support/fail_each.h"

#include <limits.h>

enum { MOST = FRACAS_DENSE_SITES + 20 };
static double position[MOST][3], sigma_c[MOST], usual[MOST];
static fracas_extent extent[MOST];

typedef struct {
    fracas_strength strength;
    size_t n;
} body;

static fracas_err make_and_draw(const void *context)
{
    const body *b = context;
    const fracas_sites sites = {
        .n = b->n, .points = 1, .extent = extent, .position = (const double(*)[3])position};
    OWN(fracas_field) field = NULL;
    TRY(fracas_field_create(&b->strength, &sites, &field));
    fracas_err err = fracas_field_sample(field, &(fracas_stream){.seed = 1}, 1, sigma_c);
    return err;
}

/* The same, and the strengths are the usual ones wherever there are any. */
static fracas_err make_and_compare(const void *context)
{
    TRY(make_and_draw(context));
    assert_memory_equal(sigma_c, usual, ((const body *)context)->n * sizeof *usual);
    return FRACAS_OK;
}

static void fail_each(fracas_strength strength, size_t n, long each)
{
    const body b = {strength, n};
    assert_int_equal(make_and_draw(&b), FRACAS_OK);
    memcpy(usual, sigma_c, sizeof usual);
    fail_each_of(make_and_compare, &b, each);
}

static void test_circle(void **state)
{
    sites_on_circle(20, 1.0, position);
    fail_each(correlated(&fracas_covariance_matern, 0.3, 0.8), 20,
              LONG_MAX); /* with a table of the covariance */
}

/* Larger circles are tried, and for the second covariance none will do. */
static void test_line(void **state)
{
    sites_on_line(20, 1.0, position);
    fail_each(correlated(&fracas_covariance_matern, 2.0, NAN), 20, LONG_MAX);
    fail_each(correlated(&fracas_covariance_gaussian, 100.0, NAN), 20, LONG_MAX);
}

/* Up to FRACAS_DENSE_SITES are factorised as a whole. Of more, all that makes the factor is tried,
 * and some of what measures its error. */
static void test_scattered(void **state)
{
    sites_scattered(MOST, position);
    fail_each(correlated(&fracas_covariance_exponential, 0.3, NAN), 20, LONG_MAX);
    fail_each(correlated(&fracas_covariance_exponential, 0.3, NAN), MOST, 40);
}

/* Measured strengths, graded along x, correlated. */
static void test_tables(void **state)
{
    const fracas_attachment measured = {.path = "s.csv", .text = "3e8\n4e8\n3.5e8\n", .size = 14};
    const fracas_attachment factor = {.path = "f.csv", .text = "0 1\n0.5 2\n1 1\n", .size = 14};
    fracas_strength strength = correlated(&fracas_covariance_exponential, 0.3, NAN);
    strength.distribution = kind_of(&fracas_strength_section, "empirical");
    strength.file = &measured;
    strength.factor = &factor;
    strength.factor_along = &fracas_along_x;
    sites_scattered(10, position);
    fail_each(strength, 10, LONG_MAX);
}

TESTS(test_circle, test_line, test_scattered, test_tables)

#endif
