/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Families of size distributions: each has the distribution of its density, written anew, what is
 * drawn from it is fitted again, and what cannot be fitted is said. */
#include "analysis/fit/point.h"
#include "tests/support/fit_sample.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sort.h>

/* Lengths in elements, of some 20 a fragment; power laws above and below an exponent of 1. */
static const synthetic law[] = {
    {.family = &fracas_family_exponential, .parameter = {20}},
    {.family = &fracas_family_mott, .parameter = {10}},
    {.family = &fracas_family_rayleigh, .parameter = {16}},
    {.family = &fracas_family_shifted_rayleigh, .parameter = {8, 9.6}},
    {.family = &fracas_family_weibull, .parameter = {20, 1.5}},
    {.family = &fracas_family_weibull3, .parameter = {6, 16, 1.6}},
    {.family = &fracas_family_lognormal, .parameter = {18, 0.5}},
    {.family = &fracas_family_gamma, .parameter = {5, 4}},
    {.family = &fracas_family_generalised_gamma, .parameter = {20, 0.5, 0.6}},
    {.family = &fracas_family_power_law, .parameter = {0.6, 20}, .from = 1.5},
    {.family = &fracas_family_power_law, .parameter = {1.4, 40}, .from = 1.5},
};
enum { LAWS = sizeof law / sizeof *law };

static double above(const synthetic *what, double x)
{
    double below, rest;
    what->family->tails(what->parameter, what->from, x, &below, &rest);
    assert_true(fabs(below + rest - 1) < 1e-12);
    return rest;
}

static double density(double x, void *context)
{
    const synthetic *what = context;
    const double *p = what->parameter;
    double weibull[3];
    synthetic_weibull(what, weibull);
    if (weibull[2] > 0) return gsl_ran_weibull_pdf(x - weibull[0], weibull[1], weibull[2]);
    if (what->family == &fracas_family_gamma) return gsl_ran_gamma_pdf(x, p[1], p[0]);
    if (what->family == &fracas_family_lognormal) return gsl_ran_lognormal_pdf(x, log(p[0]), p[1]);
    if (what->family == &fracas_family_power_law) {
        const double a = 1 - p[0], z = what->from / p[1], y = x / p[1];
        const double all = (gsl_sf_gamma_inc(a + 1, z) - pow(z, a) * exp(-z)) / a; /* Gamma(a, z) */
        return x < what->from ? 0 : pow(y, a - 1) * exp(-y) / (p[1] * all);
    }
    const double shape = 1 / (p[2] * p[2]), g = shape * pow(fmax(x, 0) / p[0], p[2] / p[1]);
    return x > 0 ? p[2] * g / (p[1] * x) * gsl_ran_gamma_pdf(g, shape, 1) : 0;
}

static double integral(const synthetic *what, double low, double high)
{
    double sum, error;
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(1000);
    gsl_function function = {density, (void *)(uintptr_t)what};
    assert_int_equal(
        gsl_integration_qags(&function, low, high, 1e-11, 1e-9, 1000, room, &sum, &error),
        GSL_SUCCESS);
    gsl_integration_workspace_free(room);
    return sum;
}

/* The integral is good to 1e-9; beyond the quantile of 1e-10 there is 1e-10. */
static void density_integrates_to_the_distribution(void **state)
{
    for (size_t i = 0; i < LAWS; i++) {
        const synthetic *what = &law[i];
        const fracas_family *family = what->family;
        const double shift = family->parameter[0].shift ? what->parameter[0] : what->from;
        const double far = synthetic_quantile(what, 1e-10);
        double at = shift, all = 0;
        for (int part = 9; part >= 0; part--) {
            const double next = part ? synthetic_quantile(what, 0.1 * part) : far;
            const double found = integral(what, at, next);
            if (!(fabs(found - (above(what, at) - above(what, next))) < 2e-9))
                fail_msg("%s from %g to %g: %.12g, not %.12g", family->name, at, next, found,
                         above(what, at) - above(what, next));
            all += found;
            at = next;
        }
        assert_true(fabs(all - 1) < 1e-8);
        assert_true(density(0.99 * shift - 1e-3, (void *)(uintptr_t)what) == 0);
    }
}

/* Tails to a relative 1e-9, as far out as 1e-12: the inverse of a distribution is no better than
 * its slope times rounding. */
static void quantiles_are_the_inverse(void **state)
{
    static const double p[] = {1 - 1e-6, 0.99, 0.5, 0.1, 1e-3, 1e-6, 1e-12};
    for (size_t i = 0; i < LAWS; i++)
        for (size_t k = 0; k < sizeof p / sizeof *p; k++) {
            const double x = synthetic_quantile(&law[i], p[k]);
            if (!(fabs(above(&law[i], x) - p[k]) < 1e-9 * p[k]))
                fail_msg("%s: P(size > %g) is %.12g instead of %g", law[i].family->name, x,
                         above(&law[i], x), p[k]);
        }
}

/* Kolmogorov's distance of 20000 numbers: above 2.69/sqrt(n) once in 1e6. */
static void samples_have_the_distribution(void **state)
{
    enum { N = 20000 };
    static double x[N];
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t i = 0; i < LAWS; i++) {
        double distance = 0;
        for (size_t k = 0; k < N; k++) x[k] = synthetic_size(&law[i], gsl_ran_ugaussian(random));
        gsl_sort(x, 1, N);
        for (size_t k = 0; k < N; k++) {
            const double below = 1 - above(&law[i], x[k]);
            distance = fmax(distance,
                            fmax(fabs(below - (double)k / N), fabs(below - (double)(k + 1) / N)));
        }
        assert_true(distance < 2.69 / sqrt(N));
    }
    gsl_rng_free(random);
}

/* The fit is as likely as the truth or more, to rounding (1e-6 of a search that has arrived), and
 * by Wilks' theorem 2 log of the ratio is chi-squared: above its quantile of 1e-6 once in a
 * million. On a lattice and without. */
static void fits_recover_the_truth(void **state)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t i = 0; i < 2 * LAWS; i++) {
        synthetic what = law[i / 2];
        what.lattice = (double)(i % 2);
        what.realizations = 100;
        what.fragments = 100;
        FRACAS_CLEARED(fracas_ensemble) ensemble;
        FRACAS_CLEARED(fracas_fit_sample) sample;
        fracas_fit fit;
        double truth[FRACAS_FAMILY_PARAMETERS];
        OK(synthetic_ensemble(&what, random, &ensemble));
        OK(fracas_fit_sample_create(&ensemble, &sample));
        fracas_fit_of(what.family, &sample, &fit);
        if (*fit.why) fail_msg("%s: %s", what.family->name, fit.why);
        for (size_t p = 0; p < what.family->nparameters; p++)
            truth[p] = what.parameter[p] / (what.family->parameter[p].length ? sample.mean : 1);
        const double gain = 2 *
                            (fit.log_likelihood -
                             fracas_fit_log_likelihood(what.family, &sample, sample.count, truth));
        print_message("%-18s lattice %.0f, %3zu cells: 2 log ratio to the truth %.2f\n",
                      what.family->name, what.lattice, sample.ncells, gain);
        assert_true(gain > -1e-6 &&
                    gain < gsl_cdf_chisq_Qinv(1e-6, (double)what.family->nparameters));
    }
    gsl_rng_free(random);
}

static fracas_fit fit_of(const synthetic *what, const fracas_family *family, unsigned long seed)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, seed);
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    FRACAS_CLEARED(fracas_fit_sample) sample;
    fracas_fit fit;
    OK(synthetic_ensemble(what, random, &ensemble));
    OK(fracas_fit_sample_create(&ensemble, &sample));
    fracas_fit_of(family, &sample, &fit);
    gsl_rng_free(random);
    return fit;
}

static void what_is_no_fit_says_why(void **state)
{
    synthetic what = law[0];
    what.lattice = 1;
    what.realizations = 100;
    what.fragments = 40;
    assert_string_equal(fit_of(&what, &fracas_family_exponential, 1).why, "");
    assert_string_equal(fit_of(&what, &fracas_family_shifted_rayleigh, 1).why,
                        "x0 goes to its bound, 0");
    what.family = &fracas_family_gamma;
    what.parameter[0] = 5;
    what.parameter[1] = 4;
    fracas_fit fit = fit_of(&what, &fracas_family_power_law, 1);
    assert_string_equal(fit.why, "alpha goes to its bound, 0");
    assert_true(isfinite(fit.log_likelihood)); /* what it is at the bound is known */
    what.realizations = 2;
    what.fragments = 5;
    fit = fit_of(&what, &fracas_family_gamma, 1);
    assert_has(fit.why, "fragments above the cut, 30 are needed");
    assert_true(isnan(fit.log_likelihood) && isnan(fit.parameter[0]));
    what.realizations = 0;
    assert_has(fit_of(&what, &fracas_family_gamma, 1).why, "0 fragments above the cut");
    what = law[2];
    what.parameter[0] = 1e-4; /* every size is one element */
    what.lattice = 1;
    what.realizations = 10;
    what.fragments = 20;
    assert_has(fit_of(&what, &fracas_family_rayleigh, 1).why, "fragments above the cut");
}

/* Dust is below the cut; cells hold whole sizes, every fragment above is in one, and a resample of
 * each realization once is the sample. */
static void cells_of_a_lattice(void **state)
{
    synthetic what = law[0];
    what.lattice = 0.001;
    what.parameter[0] = 0.02;
    what.realizations = 30;
    what.fragments = 50;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    FRACAS_CLEARED(fracas_fit_sample) sample;
    uint32_t once[30];
    double count[FRACAS_FIT_CELLS], mean, cv, total = 0, expected = 0;
    OK(synthetic_ensemble(&what, random, &ensemble));
    OK(fracas_fit_sample_create(&ensemble, &sample));
    for (size_t f = 0; f < ensemble.nfragments; f++) expected += !ensemble.dust[f];
    assert_true(expected < (double)ensemble.nfragments && sample.total == expected);
    assert_true(fabs(sample.cut - 0.0015) < 1e-15 &&
                fabs(sample.edge[0] * sample.mean - 0.0015) < 1e-15);
    for (size_t k = 0; k + 1 < sample.ncells; k++) {
        const double steps = sample.edge[k + 1] * sample.mean / 0.001 - 0.5;
        assert_true(fabs(steps - round(steps)) < 1e-9 && sample.edge[k + 1] > sample.edge[k]);
    }
    for (size_t i = 0; i < 30; i++) once[i] = 1;
    fracas_fit_sample_count(&sample, once, count);
    fracas_fit_sample_moments(&sample, once, &mean, &cv);
    for (size_t k = 0; k < sample.ncells; k++) {
        assert_true(count[k] == sample.count[k]);
        total += count[k];
    }
    assert_true(total == expected && fabs(mean / sample.mean - 1) < 1e-14 &&
                fabs(cv / sample.cv - 1) < 1e-12);
    gsl_rng_free(random);
}

static void add(fracas_ensemble *ensemble, const double *size, size_t count)
{
    fracas_fragment fragment[80];
    const fracas_replica_values value = {0};
    fracas_record record;
    fracas_record_init(&record);
    for (size_t f = 0; f < count; f++)
        fragment[f] = (fracas_fragment){.size = size[f], .mass = size[f], .elements = 100};
    record.fragment = fragment;
    record.nfragment = count;
    OK(fracas_ensemble_add(ensemble, ensemble->nrealizations, (int64_t)ensemble->nrealizations,
                           &value, &record));
}

/* Bodies that stay whole are atoms of the distribution of sizes. Among 20 of exponential fragments
 * they change no bit of sample and fit but their own number, in whatever order they come; where
 * nothing else is, there is nothing to fit. */
static void whole_bodies_are_left_out(void **state)
{
    enum { BROKEN = 20, PIECES = 50 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    FRACAS_CLEARED(fracas_ensemble) with, without, alone;
    FRACAS_CLEARED(fracas_fit_sample) a, b, c;
    fracas_fit fit_a, fit_b, fit_c;
    fracas_ensemble_init(&with, 0);
    fracas_ensemble_init(&without, 0);
    fracas_ensemble_init(&alone, 0);
    const double body = 1000;
    for (int i = 0; i < BROKEN; i++) {
        double size[PIECES];
        for (int f = 0; f < PIECES; f++) size[f] = 20 + gsl_ran_exponential(random, 20);
        if (i % 3 == 0) add(&with, &body, 1);
        if (i % 3 == 0) add(&alone, &body, 1);
        add(&with, size, PIECES);
        add(&without, size, PIECES);
    }
    OK(fracas_fit_sample_create(&with, &a));
    OK(fracas_fit_sample_create(&without, &b));
    OK(fracas_fit_sample_create(&alone, &c));
    assert_true(a.whole == 7 && b.whole == 0 && a.nrealizations == BROKEN &&
                a.fragments == BROKEN * PIECES + 7 && a.total == BROKEN * PIECES);
    a.cut = b.cut; /* of mean elements, which are larger with whole bodies; both below 20 */
    a.edge[0] = b.edge[0];
    assert_true(a.mean == b.mean && a.cv == b.cv && a.ncells == b.ncells);
    assert_memory_equal(a.count, b.count, b.ncells * sizeof *b.count);
    assert_memory_equal(a.first, b.first, (BROKEN + 1) * sizeof *b.first);
    assert_memory_equal(a.kept, b.kept, BROKEN * sizeof *b.kept);
    fracas_fit_of(&fracas_family_exponential, &a, &fit_a);
    fracas_fit_of(&fracas_family_exponential, &b, &fit_b);
    fracas_fit_of(&fracas_family_exponential, &c, &fit_c);
    assert_true(fit_a.parameter[0] == fit_b.parameter[0] &&
                fit_a.log_likelihood == fit_b.log_likelihood && !*fit_a.why);
    assert_true(c.whole == 7 && c.total == 0 && strstr(fit_c.why, "0 fragments above the cut"));
    gsl_rng_free(random);
}

/* Sizes 1 -+ 1e-6 in turn: mean 1, deviation/mean 1e-6. Each size is rounded to 1.1e-16, and so is
 * the mean (of sums of 2000 to some ten of these): of the deviation that is 2e-9 at most. Squares
 * of the sizes themselves would be rounded to 1e-16 of 1, in a variance of 1e-12: wrong in the
 * fourth digit at best. A resample of the first realization alone, twice: the same. */
static void sizes_that_are_nearly_alike(void **state)
{
    enum { REALIZATIONS = 40, PIECES = 50 };
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    FRACAS_CLEARED(fracas_fit_sample) sample;
    uint32_t weight[REALIZATIONS] = {2};
    double size[PIECES], mean, cv;
    fracas_ensemble_init(&ensemble, 0);
    for (int f = 0; f < PIECES; f++) size[f] = 1 + (f % 2 ? 1e-6 : -1e-6);
    for (int i = 0; i < REALIZATIONS; i++) add(&ensemble, size, PIECES);
    OK(fracas_fit_sample_create(&ensemble, &sample));
    assert_true(fabs(sample.mean - 1) < 2e-15 && fabs(sample.cv / 1e-6 - 1) < 2e-9);
    fracas_fit_sample_moments(&sample, weight, &mean, &cv);
    assert_true(fabs(mean - 1) < 2e-15 && fabs(cv / 1e-6 - 1) < 2e-9);
}

/* Every fragment is carried, each realization keeps as many, and together they have the law: cells
 * to one fragment. Order is kept. */
static void carried_samples_have_the_law(void **state)
{
    synthetic what = law[3];
    what.lattice = 1;
    what.realizations = 30;
    what.fragments = 50;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    FRACAS_CLEARED(fracas_fit_sample) sample, carried;
    fracas_fit fit;
    double probability[FRACAS_FIT_CELLS], seen = 0, law_below = 0;
    OK(synthetic_ensemble(&what, random, &ensemble));
    OK(fracas_fit_sample_create(&ensemble, &sample));
    fracas_fit_of(&fracas_family_exponential, &sample, &fit); /* a law of other sizes */
    assert_true(
        fracas_fit_probabilities(&fracas_family_exponential, &sample, fit.parameter, probability));
    OK(fracas_fit_carry(&sample, probability, 1, &carried));
    for (size_t k = 0; k < sample.ncells; k++) {
        seen += carried.count[k];
        law_below += probability[k];
        assert_true(fabs(seen - law_below * sample.total) <= 0.5 + 1e-6);
    }
    assert_true(seen == sample.total);
    for (size_t i = 0; i < sample.nrealizations; i++) {
        double kept = 0;
        for (size_t c = carried.first[i]; c < carried.first[i + 1]; c++) {
            kept += carried.times[c];
            assert_true(c == carried.first[i] || carried.cell[c] > carried.cell[c - 1]);
        }
        assert_true(kept == sample.kept[i]);
    }
    gsl_rng_free(random);
}

/* Four cells with shares 1/4, counts 2 1 0 1: distribution functions 1/2, 3/4, 3/4 beside 1/4, 1/2,
 * 3/4. D = 1/4; A2/N = 1/4 (1/16/(3/16) + 1/16/(1/4) + 0) = 7/48. */
static void distances(void **state)
{
    const double count[4] = {2, 1, 0, 1}, probability[4] = {0.25, 0.25, 0.25, 0.25};
    const fracas_fit_distance found = fracas_fit_distance_of(4, count, probability);
    assert_true(fabs(found.ks - 0.25) < 1e-15 && fabs(found.ad - 7.0 / 48) < 1e-15);
}

static void special_cases(void **state)
{
    assert_true(fracas_family_within(&fracas_family_rayleigh, &fracas_family_shifted_rayleigh));
    assert_true(fracas_family_within(&fracas_family_gamma, &fracas_family_generalised_gamma));
    assert_false(fracas_family_within(&fracas_family_generalised_gamma, &fracas_family_gamma));
    assert_false(fracas_family_within(&fracas_family_mott,
                                      &fracas_family_gamma)); /* not by the end of a longer name */
    assert_ptr_equal(fracas_family_find("weibull-3"), &fracas_family_weibull3);
    assert_null(fracas_family_find("weibull-4"));
}

int fracas_test(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(density_integrates_to_the_distribution),
        cmocka_unit_test(quantiles_are_the_inverse),
        cmocka_unit_test(samples_have_the_distribution),
        cmocka_unit_test(fits_recover_the_truth),
        cmocka_unit_test(what_is_no_fit_says_why),
        cmocka_unit_test(cells_of_a_lattice),
        cmocka_unit_test(carried_samples_have_the_law),
        cmocka_unit_test(distances),
        cmocka_unit_test(special_cases),
        cmocka_unit_test(whole_bodies_are_left_out),
        cmocka_unit_test(sizes_that_are_nearly_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
