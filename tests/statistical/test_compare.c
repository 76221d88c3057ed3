/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparison of two studies: intervals hold the truth, p are uniform where nothing differs and
 * small where something does, points find their partners. Realizations are correlated within, as
 * real ones are. */
#include "analysis/compare/compare.h"
#include "analysis/compare/methods.h"
#include "analysis/summary/study.h"
#include "tests/support/test.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>

/* ---- differences ---- */

/* Two samples of six and four. The numbers are those of a script in Python with scipy: means 5
 * and 7.5, variances 3.2 and 13/3; Welch's standard error sqrt(3.2/6 + 13/12)
 * = 1.27148207485, 5.832747861305 degrees of freedom, t = 2.464020944024. */
static void welch_by_hand(void **state)
{
    const double a[] = {3, 4, 4, 5, 6, 8}, b[] = {5, NAN, 7, 8, 10};
    fracas_compared_value value;
    fracas_difference_of(a, 6, b, 5, 1, &value);
    assert_true(value.a.n == 6 && value.b.n == 4 && fabs(value.difference - 2.5) < 1e-15);
    assert_true(fabs(value.freedom - 5.832747861305) < 1e-11);
    const double half_width = (value.high - value.low) / 2, b_variance = 13.0 / 3,
                 error = 1.27148207485071;
    assert_true(fabs(value.relative - 0.5) < 1e-15);
    assert_true(fabs((value.high + value.low) / 2 - 2.5) < 1e-14);
    assert_true(fabs(half_width / error - 2.464020944024) < 1e-6);
    /* B/A = 1.5: standard error of the ratio sqrt(b + 1.5^2 a)/5. */
    const double ratio = sqrt(b_variance / 4 + 2.25 * 3.2 / 6) / 5;
    assert_true(fabs((value.relative_high - value.relative_low) / 2 / half_width - ratio / error) <
                1e-12);
    fracas_difference_of(a, 1, b, 5, 1, &value);
    assert_true(fabs(value.difference - 4.5) < 1e-15 && isnan(value.low) &&
                isnan(value.relative_high));
}

/* Differences 1, 2, NAN, 3, 2: mean 2, deviation sqrt(2/3), four pairs, t_(0.975, 3) = 3.182446. */
static void pairs_by_hand(void **state)
{
    const double a[] = {1, 5, NAN, 9, 2}, b[] = {2, 7, 3, 12, 4};
    fracas_compared_value value;
    fracas_difference_of_pairs(a, b, 5, 1, &value);
    assert_true(value.a.n == 4 && value.b.n == 4 && value.freedom == 3 &&
                fabs(value.difference - 2) < 1e-15);
    assert_true(fabs(value.high - 2 - 3.182446 * sqrt(2.0 / 3) / 2) < 1e-6);
    assert_true(fabs(value.relative - 2 / 4.25) < 1e-15);
    double squares = 0; /* of what is left of b beside its ratio to a, 6.25/4.25 */
    for (size_t i = 0; i < 5; i++)
        squares += i == 2 ? 0 : pow(b[i] - 6.25 - 6.25 / 4.25 * (a[i] - 4.25), 2);
    assert_true(fabs(value.relative_high - value.relative - 3.182446 * sqrt(squares / 12) / 4.25) <
                1e-6);
    const double equal[] = {3, 4, 5};
    fracas_difference_of_pairs(equal, equal, 3, 1, &value);
    assert_true(value.difference == 0 && value.low == 0 && value.high == 0);
}

static void holm_by_hand(void **state)
{
    const double p[] = {0.01, 0.04, NAN, 0.03, 0.005}, expected[] = {0.03, 0.06, NAN, 0.06, 0.02};
    double corrected[5];
    OK(fracas_holm(p, 5, 1, corrected));
    for (size_t i = 0; i < 5; i++)
        assert_true(isnan(expected[i]) ? isnan(corrected[i])
                                       : fabs(corrected[i] - expected[i]) < 1e-15);
    const double large[] = {0.6, 0.7};
    OK(fracas_holm(large, 2, 1, corrected));
    assert_true(corrected[0] == 1 && corrected[1] == 1);
}

/* 2000 repetitions know a coverage to 0.5 %. 8 realizations beside 20 of three times the deviation,
 * so that a common variance would not do; then 12 pairs with a correlation of 0.9. */
static void intervals_cover(void **state)
{
    enum { REPETITIONS = 2000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int held[4] = {0};
    for (int round = 0; round < REPETITIONS; round++) {
        double a[20], b[20];
        fracas_compared_value value;
        for (size_t i = 0; i < 20; i++)
            a[i] = 10 + gsl_ran_gaussian(random, 1.5), b[i] = 12 + gsl_ran_gaussian(random, 0.5);
        fracas_difference_of(a, 8, b, 20, 1, &value);
        held[0] += value.low <= 2 && 2 <= value.high;
        held[1] += value.relative_low <= 0.2 && 0.2 <= value.relative_high;
        for (size_t i = 0; i < 12; i++) b[i] = 1.2 * a[i] + gsl_ran_gaussian(random, 0.7);
        fracas_difference_of_pairs(a, b, 12, 1, &value);
        held[2] += value.low <= 2 && 2 <= value.high;
        held[3] += value.relative_low <= 0.2 && 0.2 <= value.relative_high;
    }
    gsl_rng_free(random);
    print_message("coverage of %d: difference %.4f, relative %.4f; of pairs %.4f, relative %.4f\n",
                  (int)REPETITIONS, held[0] / (double)REPETITIONS, held[1] / (double)REPETITIONS,
                  held[2] / (double)REPETITIONS, held[3] / (double)REPETITIONS);
    for (int i = 0; i < 4; i++)
        assert_true(held[i] > 0.93 * REPETITIONS && held[i] < 0.97 * REPETITIONS);
}

/* ---- permutations ---- */

enum { CUTS = 24, MOST = 40 };

/* Realizations of one sample: a number, and the sizes of some 20 fragments, all of which share a
 * factor of the realization: a test over fragments would find differences in every other pair of
 * samples. */
typedef struct {
    double value[MOST], below[MOST][CUTS], fragments[MOST];
} sample;

static void draw_realization(sample *of, size_t i, double shift, double spread, double factor,
                             gsl_rng *random)
{
    const unsigned n = 15 + (unsigned)gsl_rng_uniform_int(random, 11);
    memset(of->below[i], 0, sizeof of->below[i]);
    of->value[i] = shift + factor;
    of->fragments[i] = n;
    for (unsigned f = 0; f < n; f++) {
        const double size = exp(0.5 * (factor + shift) + gsl_ran_gaussian(random, spread));
        for (size_t c = 0; c < CUTS; c++) of->below[i][c] += size <= 0.2 * exp(0.15 * (double)c);
    }
}

static void test_samples(const sample *of, size_t na, size_t nb, bool paired, int64_t permutations,
                         uint64_t seed, fracas_permuted result[2], int64_t *count, bool *exact)
{
    const fracas_two_samples samples = {.na = na,
                                        .nb = nb,
                                        .paired = paired,
                                        .nvalues = 1,
                                        .value = of->value,
                                        .ncuts = CUTS,
                                        .below = of->below[0],
                                        .fragments = of->fragments};
    OK(fracas_permutation_test(&samples, permutations, seed, result, count, exact));
}

static void all_assignments(void **state)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    sample of;
    fracas_permuted result[2];
    int64_t count;
    bool exact;
    for (size_t i = 0; i < 6; i++)
        draw_realization(&of, i, i < 3 ? 0 : 10, 0.1, 0.01 * (double)i, random);
    test_samples(&of, 3, 3, false, 9999, 1, result, &count, &exact);
    assert_true(
        exact &&
        count == 20); /* of 6 over 3; the observed one and its mirror image are the most extreme */
    assert_true(fabs(result[0].p - 0.1) < 1e-15 && fabs(result[1].p - 0.1) < 1e-15 &&
                result[1].distance == 1);
    test_samples(&of, 3, 3, true, 9999, 1, result, &count, &exact);
    assert_true(exact && count == 8 && fabs(result[0].p - 0.25) < 1e-15);
    test_samples(&of, 3, 3, false, 10, 1, result, &count, &exact);
    assert_true(!exact && count == 11 && result[0].p >= 1.0 / 11);
    test_samples(&of, 1, 5, false, 9999, 1, result, &count, &exact);
    assert_true(count == 6 && isnan(result[0].p));
    test_samples(&of, 0, 5, false, 9999, 1, result, &count, &exact);
    assert_true(count == 0 && isnan(result[0].p) && isnan(result[1].p));
    for (size_t i = 0; i < 6; i++) of.value[i] = 7; /* nothing differs */
    test_samples(&of, 3, 3, false, 9999, 1, result, &count, &exact);
    assert_true(result[0].p == 1);
    for (size_t i = 0; i < 6; i++) of.value[i] = i < 3 ? 7 : 8; /* without scatter */
    test_samples(&of, 3, 3, false, 9999, 1, result, &count, &exact);
    assert_true(fabs(result[0].p - 0.1) < 1e-15);
    gsl_rng_free(random);
}

enum { TESTS = 2000, PERMUTATIONS = 199, NA = 8, NB = 14, PAIRS = 15 };

/* p of TESTS pairs of samples; `shift` in deviations of a realization. */
static void many_tests(bool paired, double shift, int tests, double *means, double *sizes,
                       unsigned long seed)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, seed);
    for (int k = 0; k < tests; k++) {
        sample of;
        fracas_permuted result[2];
        int64_t count;
        bool exact;
        const size_t na = paired ? PAIRS : NA, nb = paired ? PAIRS : NB;
        double common[PAIRS];
        for (size_t i = 0; i < PAIRS; i++) common[i] = gsl_ran_gaussian(random, 1);
        for (size_t i = 0; i < na + nb; i++) {
            const double own = gsl_ran_gaussian(random, 1),
                         factor = paired ? 0.9 * common[i % PAIRS] + 0.436 * own : own;
            draw_realization(&of, i, i < na ? 0 : shift, 0.4, factor, random);
        }
        test_samples(&of, na, nb, paired, PERMUTATIONS, (uint64_t)k + 1, result, &count, &exact);
        assert_true(!exact && count == PERMUTATIONS + 1);
        means[k] = result[0].p;
        sizes[k] = result[1].p;
    }
    gsl_rng_free(random);
}

static double distance_to_uniform(double *p, int n)
{
    double most = 0;
    gsl_sort(p, 1, (size_t)n);
    for (int i = 0; i < n; i++)
        most = fmax(most, fmax(fabs(p[i] - (double)i / n), fabs(p[i] - (i + 1.0) / n)));
    return most;
}

/* p are multiples of 1/200 and at most 1/200 above a uniform variable; the limit of Kolmogorov and
 * Smirnov at 1e-6 is sqrt(ln(2e6)/(2 n)) = 0.0602 for n = 2000. */
static void null_is_uniform(void **state)
{
    static double means[TESTS], sizes[TESTS];
    const double limit = sqrt(log(2e6) / (2 * TESTS)) + 1.0 / (PERMUTATIONS + 1);
    for (int paired = 0; paired < 2; paired++) {
        many_tests(paired, 0, TESTS, means, sizes, 5 + (unsigned long)paired);
        const double of_means = distance_to_uniform(means, TESTS),
                     of_sizes = distance_to_uniform(sizes, TESTS);
        print_message(
            "%s, %d tests: distance of p to uniform %.4f (means), %.4f (sizes), limit %.4f\n",
            paired ? "pairs" : "independent", (int)TESTS, of_means, of_sizes, limit);
        assert_true(of_means < limit && of_sizes < limit);
    }
}

/* Equal means, but three times the deviation in the smaller sample: at 5 % T finds 4.5 to 6.5 %
 * (1000 tests know it to 0.7 %), the plain difference of means, which takes all values as alike,
 * some 20 %. */
static void unequal_variances(void **state)
{
    enum { ROUNDS = 1000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int found = 0;
    for (int k = 0; k < ROUNDS; k++) {
        sample of = {0};
        fracas_permuted result[2];
        int64_t count;
        bool exact;
        for (size_t i = 0; i < 32; i++) of.value[i] = gsl_ran_gaussian(random, i < 8 ? 3 : 1);
        test_samples(&of, 8, 24, false, PERMUTATIONS, (uint64_t)k + 1, result, &count, &exact);
        assert_true(isnan(result[1].p)); /* there is no fragment */
        found += result[0].p <= 0.05;
    }
    gsl_rng_free(random);
    print_message("unequal variances: %.3f found at 0.05\n", found / (double)ROUNDS);
    assert_true(found > 0.03 * ROUNDS && found < 0.09 * ROUNDS);
}

/* A shift of 1.5 deviations beside 8 and 14 realizations: Student's test at 5 % finds it in 89.6 %
 * (noncentral t, 3.38 with 20 degrees of freedom); pairs whose difference has the deviation 0.617
 * find a third of it, 0.5, in 83.1 % (3.14 with 14). Four standard deviations of 400 are 6 and 7.5
 * %. */
static void shift_is_found(void **state)
{
    enum { SHIFTED = 400 };
    static double means[SHIFTED], sizes[SHIFTED];
    for (int paired = 0; paired < 2; paired++) {
        int found = 0, found_sizes = 0;
        many_tests(paired, paired ? 0.5 : 1.5, SHIFTED, means, sizes, 7);
        for (int k = 0; k < SHIFTED; k++)
            found += means[k] <= 0.05, found_sizes += sizes[k] <= 0.05;
        print_message("%s: a shift is found in %.3f by means, %.3f by sizes\n",
                      paired ? "pairs" : "independent", found / (double)SHIFTED,
                      found_sizes / (double)SHIFTED);
        assert_true(found > (paired ? 0.75 : 0.83) * SHIFTED);
        assert_true(found_sizes > 0.5 * SHIFTED);
    }
}

/* ---- points ---- */

enum { NPOINTS = 4, NCOLUMNS = 3 };

typedef struct {
    fracas_column column[NCOLUMNS];
    fracas_value value[NPOINTS][NCOLUMNS];
    fracas_point_row row[NPOINTS];
    fracas_point_table table;
    fracas_point_statistics point[NPOINTS];
    fracas_analysis analysis;
} study;

/* Rates 1e3, 1e4, ... with so many elements; `replicas` realizations of 4 fragments, or 5 for every
 * third. */
static void make(study *of, size_t npoints, double first_rate, double elements, const char *third,
                 double third_value, int replicas, uint64_t seed)
{
    memset(of, 0, sizeof *of);
    of->column[0] = (fracas_column){"loading.rate", "1/s", "", false};
    of->column[1] = (fracas_column){"mesh.elements", "1", "", false};
    of->column[2] = (fracas_column){third, "1", "", false};
    for (size_t p = 0; p < npoints; p++) {
        const double real[NCOLUMNS] = {first_rate * pow(10, (double)p), elements * (double)(p + 1),
                                       third_value};
        for (size_t c = 0; c < NCOLUMNS; c++) of->value[p][c] = (fracas_value){real[c], ""};
        of->row[p] = (fracas_point_row){
            .hash = fracas_hash_of(real, sizeof real), .replicas = replicas, .value = of->value[p]};
        fracas_ensemble_init(&of->point[p].ensemble, 0);
        for (int r = 0; r < replicas; r++) {
            const size_t n = (uint64_t)(r + 1) * (seed + 1) % 3 ? 4 : 5;
            fracas_fragment fragment[5] = {0};
            for (size_t f = 0; f < n; f++)
                fragment[f] = (fracas_fragment){.size = 1 / (double)n, .mass = 1, .elements = 1};
            const fracas_record record = {
                .fragments = (int64_t)n, .nfragment = n, .fragment = fragment};
            const fracas_replica_values value = {
                .count = (double)n, .size = 1 / (double)n, .dissipated = 3, .onset_time = NAN};
            OK(fracas_ensemble_add(&of->point[p].ensemble, (size_t)r, r, &value, &record));
        }
    }
    of->table = (fracas_point_table){
        .ncolumns = NCOLUMNS, .column = of->column, .npoints = npoints, .point = of->row};
    of->analysis = (fracas_analysis){.name = "study", .table = &of->table, .point = of->point};
    of->analysis.header.seed = seed;
    OK(fracas_columns_create(&of->table, &of->analysis.shown));
}

static void drop(study *of)
{
    for (size_t p = 0; p < of->table.npoints; p++) fracas_ensemble_clear(&of->point[p].ensemble);
    fracas_columns_clear(&of->analysis.shown);
}

static void points_and_partners(void **state)
{
    study a, b;
    fracas_comparison found;
    fracas_compare_options how = {.permutations = 99};
    make(&a, 4, 1e3, 100, "cohesive.beta", 4, 6, 1);  /* rates 1e3 to 1e6 */
    make(&b, 3, 1e4, 100, "cohesive.gamma", 7, 7, 2); /* rates 1e4 to 1e6, other elements at each */
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(found.npoints == 0 && found.nonly_a == 4 && found.nonly_b == 3);
    assert_string_equal(found.how, "loading.rate, mesh.elements");
    fracas_comparison_clear(&found);
    how.by = "loading.rate";
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(found.npoints == 3 && found.nonly_a == 1 && found.only_a[0] == 0 &&
                found.nonly_b == 0);
    assert_true(found.point[0].a == 1 && found.point[0].b == 0 && !found.point[0].paired);
    assert_string_equal(found.point[0].differs,
                        "mesh.elements 200 | 100, cohesive.beta 4 | -, cohesive.gamma - | 7");
    const fracas_compared_value *count = &found.point[0].value[0],
                                *onset = &found.point[0].value[5];
    assert_true(count->a.n == 6 && count->b.n == 7 && found.point[0].used_a == 6);
    assert_true(count->p > 0 && count->p <= 1 && count->p_holm >= count->p &&
                count->low <= count->high);
    assert_true(onset->a.n == 0 && isnan(onset->p) && isnan(onset->p_holm));
    assert_true(found.point[0].value[3].p == 1 &&
                found.point[0].value[3].difference == 0); /* dissipated: 3 everywhere */
    fracas_comparison_clear(&found);
    how.by = "cohesive.beta";
    assert_int_equal(fracas_compare(&a.analysis, &b.analysis, &how, &found),
                     FRACAS_USAGE); /* B lacks it */
    how.by = ",";
    assert_int_equal(fracas_compare(&a.analysis, &b.analysis, &how, &found), FRACAS_USAGE);
    drop(&b);
    make(&b, 3, 1e4, 100, "cohesive.beta", 4, 7, 2);
    for (size_t p = 0; p < 3; p++) b.value[p][1].real = 100; /* elements vary in A alone */
    how.by = NULL;
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_string_equal(found.how, "loading.rate");
    assert_int_equal(found.npoints, 3);
    fracas_comparison_clear(&found);
    how.by = "cohesive.beta"; /* alike at all points */
    assert_int_equal(fracas_compare(&a.analysis, &b.analysis, &how, &found), FRACAS_USAGE);
    drop(&b);
    make(&b, 1, 1e5, 300, "cohesive.beta", 9, 7, 2); /* one point: rates and elements vary in A */
    how.by = NULL;
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(found.npoints == 1 && found.point[0].a == 2);
    assert_string_equal(found.point[0].differs, "cohesive.beta 4 | 9");
    fracas_comparison_clear(&found);
    drop(&a);
    drop(&b);
}

/* Equal seeds with equal hashes, or common random numbers, name the same numbers: replica by
 * replica, those alone that both have. */
static void partners_of_replicas(void **state)
{
    study a, b;
    fracas_comparison found;
    fracas_compare_options how = {.permutations = 99};
    make(&a, 2, 1e3, 100, "cohesive.beta", 4, 9, 1);
    make(&b, 2, 1e3, 100, "cohesive.beta", 4, 6, 1);
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(found.npoints == 2 && found.point[1].paired && found.point[1].used_a == 6 &&
                found.point[1].used_b == 6);
    assert_true(found.point[0].value[0].difference == 0 && found.point[0].value[0].p == 1);
    assert_true(found.point[0].p == 1 && found.point[0].distance == 0);
    assert_true(found.point[0].value[0].low == 0 && *found.how == '\0' &&
                *found.point[0].differs == '\0');
    fracas_comparison_clear(&found);
    for (size_t r = 0; r < 6; r++)
        b.point[0].ensemble.value[r].dissipated =
            3 * (1 + 1e-15 * (double)(1 + r)); /* another order of summation */
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(found.point[0].value[3].difference == 0 && found.point[0].value[3].p == 1);
    fracas_comparison_clear(&found);
    b.analysis.header.seed = 2;
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(!found.point[0].paired && found.point[0].used_a == 9);
    fracas_comparison_clear(&found);
    drop(&b);
    make(&b, 2, 1e3, 100, "cohesive.beta", 5, 6, 1); /* another point, the same seed */
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(found.npoints == 2 && !found.point[0].paired);
    fracas_comparison_clear(&found);
    how.common = true;
    OK(fracas_compare(&a.analysis, &b.analysis, &how, &found));
    assert_true(found.npoints == 2 && found.point[0].paired && found.point[0].value[0].a.n == 6);
    fracas_comparison_clear(&found);
    drop(&a);
    drop(&b);
}

TESTS(welch_by_hand, pairs_by_hand, holm_by_hand, intervals_cover, all_assignments, null_is_uniform,
      unequal_variances, shift_is_found, points_and_partners, partners_of_replicas)
