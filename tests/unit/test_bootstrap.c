/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Intervals by resampling realizations, and the cut-off of what a mesh resolves. */
#include "analysis/estimate/bootstrap.h"
#include "analysis/data/ensemble.h"
#include "tests/support/test.h"

typedef struct {
    size_t n;
    const double *x;
    size_t calls;
    bool whole; /* weights have always summed to n, but for the first n calls after the first, which
                   leave realizations out */
} sample;

/* Mean and variance (divisor n) of the weighted values. */
static void moments(void *context, const uint32_t *weight, double *value)
{
    sample *s = context;
    double n = 0, sum = 0, squares = 0;
    for (size_t i = 0; i < s->n; i++) n += weight[i], sum += weight[i] * s->x[i];
    for (size_t i = 0; i < s->n; i++)
        squares += weight[i] * (s->x[i] - sum / n) * (s->x[i] - sum / n);
    s->calls++;
    s->whole = s->whole && (n == (double)s->n ||
                            (s->calls > 1 && s->calls <= 1 + s->n && n == (double)s->n - 1));
    value[0] = sum / n;
    value[1] = squares / n;
}

/* Efron and Tibshirani 1993, tables 14.1 and 14.2: the variance of the 26 spatial test scores A is
 * 171.5; its 90 % BCa interval from 2000 resamples is 115.8 to 259.6 (the percentile interval is
 * 100.8 to 233.9, the ABC method's, without random numbers, 116.7 to 260.9). Each end is the order
 * statistic of some 3 % (of the resamples, low) and 3 % (high) of them, known to sqrt(0.03/20000)
 * = 1.2e-3 of probability, over a density of about 0.02 a standard error there: 1.2e-3/(0.07/41) =
 * 0.7, and theirs, of a tenth of our resamples, to 2.2: four of these together are 9, well below
 * the 15 and 26 to the percentile interval. */
static void interval_of_a_published_example(void **state)
{
    static const double score[26] = {48, 36, 20, 29, 42, 42, 20, 42, 22, 41, 45, 14, 6,
                                     0,  33, 28, 34, 4,  32, 24, 47, 41, 24, 26, 30, 41};
    sample s = {.n = 26, .x = score, .whole = true};
    fracas_interval interval[2];
    const fracas_bootstrap_options options = {
        .resamples = 20000, .confidence = 0.9, .seed = 1, .plain = true};
    OK(fracas_bootstrap(26, 2, moments, &s, &options, interval));
    assert_true(fabs(interval[1].value - 171.5) < 0.05);
    assert_true(fabs(interval[1].low - 115.8) < 9 && fabs(interval[1].high - 259.6) < 9);
    assert_true(fabs(interval[1].low - 116.7) < 3 && fabs(interval[1].high - 260.9) < 3);
    assert_true(s.whole && s.calls == 1 + 20000 + 26);
    assert_int_equal(interval[1].resamples, 20000);
    /* Expanded by sqrt(26/25) t_(0.95, 25) = 1.0198 x 1.7081 = 1.7419, of which the normal
     * distribution has 0.91849 between its negative and it. */
    fracas_interval wide[2], longer[2];
    OK(fracas_bootstrap(26, 2, moments, &s, &(fracas_bootstrap_options){.confidence = 0.9}, wide));
    OK(fracas_bootstrap(26, 2, moments, &s,
                        &(fracas_bootstrap_options){.confidence = 0.91849, .plain = true}, longer));
    assert_true(fabs(wide[1].low - longer[1].low) < 1e-3 &&
                fabs(wide[1].high - longer[1].high) < 1e-2); /* equal resamples */
    /* Of a resample the variance is (1 - 1/n) of it in the mean, and the mean's standard error
     * sqrt(variance/n): each known to 1/sqrt(2 x 20000). */
    assert_true(fabs(interval[0].standard_error / sqrt(interval[1].value / 26) - 1) <
                4.9 / sqrt(40000));
}

/* Equal seeds, equal intervals; another seed, others; a longer confidence, longer. */
static void options_are_heard(void **state)
{
    const double x[] = {1, 2, 4, 3, 7, 2, 9, 3, 4, 5};
    fracas_interval a[2], b[2];
    sample s = {.n = 10, .x = x};
    OK(fracas_bootstrap(10, 2, moments, &s, &(fracas_bootstrap_options){.seed = 5}, a));
    assert_int_equal(a[0].resamples, 2000);
    OK(fracas_bootstrap(10, 2, moments, &s, &(fracas_bootstrap_options){.seed = 5}, b));
    assert_memory_equal(a, b, sizeof a);
    OK(fracas_bootstrap(10, 2, moments, &s, &(fracas_bootstrap_options){.seed = 6}, b));
    assert_true(a[0].standard_error != b[0].standard_error && a[0].value == b[0].value);
    OK(fracas_bootstrap(10, 2, moments, &s,
                        &(fracas_bootstrap_options){.seed = 5, .confidence = 0.99}, b));
    assert_true(b[0].low < a[0].low && b[0].high > a[0].high && a[0].low < 4 && a[0].high > 4);
}

/* The value of the second realization, once, or nothing where it was not drawn. */
static void second(void *context, const uint32_t *weight, double *value)
{
    value[0] = weight[1] ? 3 : NAN;
    value[1] = 8;
}

/* Resamples without a value are not counted, (1 - 1/8)^8 = 0.344 of them, known to 0.0047 of
 * 10000: 4.9 of these. Where nothing differs, the interval is a point. None: nothing. */
static void intervals_of_what_is_not_always_there(void **state)
{
    fracas_interval interval[2];
    const fracas_bootstrap_options options = {.resamples = 10000};
    OK(fracas_bootstrap(3, 2, second, NULL, &options,
                        interval)); /* of few: none without the second */
    assert_true(interval[0].value == 3 && isnan(interval[0].low) && isnan(interval[0].high) &&
                interval[0].resamples == 0);
    assert_true(interval[1].value == 8 && interval[1].low == 8 && interval[1].high == 8 &&
                interval[1].resamples == 3);
    OK(fracas_bootstrap(8, 2, second, NULL, &options, interval));
    assert_true(fabs((double)interval[0].resamples / 1e4 - (1 - 0.3436)) < 4.9 * 0.0047);
    assert_true(interval[0].low == 3 && interval[0].high == 3 && interval[1].low == 8 &&
                interval[1].high == 8);
    OK(fracas_bootstrap(0, 2, second, NULL, &options, interval));
    assert_true(isnan(interval[0].value) && isnan(interval[0].low) && interval[0].resamples == 0);
}

/* Of few realizations the interval of a mean is Student's: of 1 2 4 5 9 mean 4.2, squares about
 * it 38.8, t_(0.975, 4) = 2.776445 and t_(0.95, 4) = 2.131847 (tabulated to seven digits). Of the
 * variance (divisor n) 7.76, without one of the five: leaving out x makes it (38.8 - 5/4 (x
 * - 4.2)^2)/4, deviations from 7.76 of 1.94 - 5/16 (x - 4.2)^2. Eight are resampled, one has no
 * interval. */
static void intervals_of_few_are_students(void **state)
{
    const double x[] = {1, 2, 4, 5, 9, 1, 1, 1};
    fracas_interval interval[2];
    sample s = {.n = 5, .x = x};
    OK(fracas_bootstrap(5, 2, moments, &s, &(fracas_bootstrap_options){.seed = 1}, interval));
    const double error = sqrt(38.8 / 4 / 5);
    assert_true(s.calls == 6 && interval[0].resamples == 5);
    assert_true(fabs(interval[0].value - 4.2) < 1e-14 &&
                fabs(interval[0].standard_error - error) < 1e-14);
    assert_true(fabs(interval[0].low - (4.2 - 2.776445 * error)) < 1e-6 &&
                fabs(interval[0].high - (4.2 + 2.776445 * error)) < 1e-6);
    double squares = 0;
    for (int i = 0; i < 5; i++) {
        const double d = 1.94 - 5.0 / 16 * (x[i] - 4.2) * (x[i] - 4.2);
        squares += d * d;
    }
    assert_true(fabs(interval[1].standard_error - sqrt(0.8 * squares)) < 1e-13);
    OK(fracas_bootstrap(5, 2, moments, &s, &(fracas_bootstrap_options){.confidence = 0.9},
                        interval));
    assert_true(fabs(interval[0].high - (4.2 + 2.131847 * error)) < 1e-6);
    s = (sample){.n = 8, .x = x};
    OK(fracas_bootstrap(8, 2, moments, &s, &(fracas_bootstrap_options){.seed = 1}, interval));
    assert_true(s.calls == 1 + 8 + 2000 && interval[0].resamples == 2000);
    s = (sample){.n = 1, .x = x};
    OK(fracas_bootstrap(1, 2, moments, &s, &(fracas_bootstrap_options){.seed = 1}, interval));
    assert_true(interval[0].value == 1 && isnan(interval[0].low) &&
                isnan(interval[0].standard_error));
}

static void ensemble_of(fracas_ensemble *ensemble, const fracas_fragment *fragment, size_t count)
{
    const fracas_replica_values value = {0};
    fracas_record record;
    fracas_record_init(&record);
    record.fragment = (fracas_fragment *)fragment;
    record.nfragment = count;
    OK(fracas_ensemble_add(ensemble, 0, 0, &value, &record));
}

/* A lattice has its own step; without one it is the mean element: 10 um/4 and 40 um2/8, of
 * which 1.5, and sqrt(2.5) of its root. */
static void cut_off_of_each_mesh(void **state)
{
    static const fracas_fragment piece[] = {{.size = 3e-6, .elements = 1},
                                            {.size = 7e-6, .elements = 3}};
    static const fracas_fragment shard[] = {{.size = 2e-6, .elements = 1},
                                            {.size = 6e-6, .elements = 7}};
    fracas_ensemble ensemble;
    fracas_ensemble_init(&ensemble, 0);
    assert_true(fracas_ensemble_cut(&ensemble) == 0);
    ensemble_of(&ensemble, piece, 2);
    ensemble_of(&ensemble, piece, 2);
    assert_true(fabs(fracas_ensemble_cut(&ensemble) / 3.75e-6 - 1) < 1e-14);
    fracas_ensemble_clear(&ensemble);
    ensemble.surface = true;
    ensemble_of(&ensemble, shard, 2);
    assert_true(fabs(fracas_ensemble_cut(&ensemble) / sqrt(2.5 * 40e-12 / 8) - 1) < 1e-14);
    fracas_ensemble_clear(&ensemble);
    assert_true(ensemble.surface);
    fracas_ensemble_init(&ensemble, 2e-6);
    assert_false(ensemble.surface);
    ensemble_of(&ensemble, piece, 2);
    assert_true(fracas_ensemble_cut(&ensemble) == 1.5 * 2e-6);
    fracas_ensemble_clear(&ensemble);
}

TESTS(interval_of_a_published_example, options_are_heard, intervals_of_what_is_not_always_there,
      intervals_of_few_are_students, cut_off_of_each_mesh)
