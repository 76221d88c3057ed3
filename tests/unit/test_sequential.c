/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Student's t, the rounds, and the decision of a round. */
#include "sampler/sequential/sequential.h"
#include "sampler/special/student.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>

/* GSL solves for its own distribution function to some 1e-14 where that is flat. Ours halves until
 * no double lies between: what is left is the rounding of the sum, nu terms of 1e-16, over the
 * density times t, 1e-3 at least for these confidences; and that of 1 - confidence, 1e-16 over
 * 1e-3. Both stay below 5e-13. */
static void quantiles_are_those_of_gsl(void **state)
{
    static const double confidence[] = {0.5, 0.8, 0.9, 0.95, 0.99, 0.999};
    for (size_t c = 0; c < sizeof confidence / sizeof *confidence; c++)
        for (int64_t nu = 1; nu < 40000;
             nu += nu < 60     ? 1
                   : nu < 2000 ? 37
                               : 3331) { /* across the change to the expansion */
            const double found = fracas_student_quantile(confidence[c], nu);
            const double wanted = gsl_cdf_tdist_Pinv(0.5 * (1 + confidence[c]), (double)nu);
            if (!(fabs(found / wanted - 1) < 1e-12))
                fail_msg("nu %d, confidence %g: %.17g, not %.17g", (int)nu, confidence[c], found,
                         wanted);
        }
}

static void quantiles_in_closed_form(void **state)
{
    /* nu = 1: tan(pi c/2); nu = 2: c sqrt(2/(1 - c^2)). At c = 0.5 all is a few roundings. */
    assert_true(fabs(fracas_student_quantile(0.5, 1) - 1) < 1e-15);
    assert_true(fabs(fracas_student_quantile(0.5, 2) - 0.5 * sqrt(2 / 0.75)) < 1e-15);
    assert_true(isnan(fracas_student_quantile(0, 5)) && isnan(fracas_student_quantile(1, 5)));
    assert_true(isnan(fracas_student_quantile(NAN, 5)) && isnan(fracas_student_quantile(0.9, 0)));
    for (int64_t nu = 1; nu < 50; nu++) { /* the function that it inverts */
        assert_true(fracas_student_within(0, nu) == 0);
        assert_true(fabs(fracas_student_within(0.5, nu) - 1) < 1e-14); /* nu roundings at most */
        for (double t = 0.25; t < 8; t *= 2) {
            const double x = atan(t / sqrt((double)nu)) / M_PI;
            assert_true(fabs(fracas_student_within(x, nu) -
                             (1 - 2 * gsl_cdf_tdist_Q(t, (double)nu))) < 1e-14);
        }
    }
}

static void rounds_grow_by_half_in_batches(void **state)
{
    static const int64_t wanted[][12] = {{16, 24, 40, 64, 96, 144, 216, 256},
                                         {8, 16, 24, 40, 64, 96, 100},
                                         {9, 17, 33, 57, 60},
                                         {20}};
    static const int64_t maximum[] = {256, 100, 60, 20};
    for (int r = 0; r < 4; r++) {
        const fracas_sequential_rule rule = {.minimum = wanted[r][0], .maximum = maximum[r]};
        int64_t replicas = 0;
        for (int k = 0; wanted[r][k]; k++) {
            replicas = fracas_sequential_next(&rule, replicas);
            assert_int_equal(replicas, wanted[r][k]);
        }
        assert_int_equal(replicas, maximum[r]);
    }
    const fracas_sequential_rule huge = {.minimum = 8, .maximum = 1000000000};
    int rounds = 0;
    for (int64_t n = 0; n < huge.maximum; rounds++) {
        const int64_t next = fracas_sequential_next(&huge, n);
        assert_true(next > n && next <= huge.maximum);
        n = next;
    }
    assert_true(rounds < 60); /* log(1e9/8)/log(1.5) = 46 */
}

static const fracas_sequential_rule rule = {.minimum = 8,
                                            .maximum = 40,
                                            .quantity = FRACAS_MEAN_COUNT,
                                            .relative_half_width = 0.1,
                                            .confidence = 0.95};

/* 1 to 8 around 100: mean 104.5, deviation sqrt(6), t of 7 degrees of freedom 2.364624..., as
 * tables have it. */
static void a_decision_by_hand(void **state)
{
    const double value[8] = {101, 102, 103, 104, 105, 106, 107, 108};
    fracas_sequential_rule narrow = rule;
    fracas_sequential_decision made = fracas_sequential_decide(&rule, value, 8);
    assert_int_equal(made.used, 8);
    assert_true(made.mean == 104.5);
    const double half = 2.3646242515927849 * sqrt(6) / sqrt(8);
    assert_true(fabs(made.half_width / half - 1) < 1e-12); /* that of t */
    assert_int_equal(made.stop, FRACAS_PRECISE);
    narrow.relative_half_width = made.half_width / 104.5 *
                                 (1 + 1e-15); /* the bound itself is narrow enough */
    assert_int_equal(fracas_sequential_decide(&narrow, value, 8).stop, FRACAS_PRECISE);
    narrow.relative_half_width *= 1 - 1e-14;
    assert_int_equal(fracas_sequential_decide(&narrow, value, 8).stop, FRACAS_GO_ON);
    narrow.maximum = 8;
    assert_int_equal(fracas_sequential_decide(&narrow, value, 8).stop, FRACAS_AT_MAXIMUM);
    narrow.relative_half_width = 0.1;
    assert_int_equal(fracas_sequential_decide(&narrow, value, 8).stop,
                     FRACAS_PRECISE); /* both: it is precise */
    double below[8];
    for (int i = 0; i < 8; i++) below[i] = -value[i];
    assert_int_equal(fracas_sequential_decide(&rule, below, 8).stop,
                     FRACAS_PRECISE); /* of |mean| */
}

static void what_does_not_count_is_left_out(void **state)
{
    const double value[10] = {NAN, 101, 102, 103, 104, NAN, 105, 106, 107, 108},
                 none[8] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    const double plain[8] = {101, 102, 103, 104, 105, 106, 107, 108};
    const fracas_sequential_decision with = fracas_sequential_decide(&rule, value, 10),
                                     without = fracas_sequential_decide(&rule, plain, 8);
    assert_int_equal(with.used, 8);
    assert_true(with.mean == without.mean && with.half_width == without.half_width);
    fracas_sequential_decision made = fracas_sequential_decide(&rule, none, 8);
    assert_true(made.used == 0 && isnan(made.mean) && isnan(made.half_width) &&
                made.stop == FRACAS_GO_ON);
    double one[8];
    memcpy(one, none, sizeof one);
    one[3] = 5;
    made = fracas_sequential_decide(&rule, one, 8);
    assert_true(made.used == 1 && made.mean == 5 && isnan(made.half_width) &&
                made.stop == FRACAS_GO_ON);
    const double zero[8] = {0}, equal[8] = {3, 3, 3, 3, 3, 3, 3, 3};
    assert_int_equal(fracas_sequential_decide(&rule, zero, 8).stop,
                     FRACAS_PRECISE); /* 0 <= 0: nothing dissipates, and surely so */
    assert_int_equal(fracas_sequential_decide(&rule, equal, 8).stop, FRACAS_PRECISE);
}

TESTS(quantiles_are_those_of_gsl, quantiles_in_closed_form, rounds_grow_by_half_in_batches,
      a_decision_by_hand, what_does_not_count_is_left_out)
