/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The estimate of a final count, from records made by hand (docs/theory/settled.md). */
#include "analysis/estimate/final.h"
#include "tests/support/test.h"

static fracas_record seen(int64_t fragments, double transits, double growth, double rest)
{
    fracas_record record;
    fracas_record_init(&record);
    record.fragments = fragments;
    record.transits = transits;
    record.growth = growth;
    record.rest = rest;
    record.rest_variance = rest / 2;
    record.rest_bound = 3 * rest;
    record.onset_time = 1;
    record.end_time = 3;
    record.vibrating = 0.1;
    record.dissipated = 1;
    return record;
}

static fracas_final final_of(const fracas_record *record, size_t count)
{
    fracas_final final = {0};
    for (size_t i = 0; i < count; i++) fracas_final_add(&final, &record[i]);
    fracas_final_count(&final);
    return final;
}

static bool near(double a, double b)
{
    return fabs(a - b) <= 1e-13 * fabs(b);
}

static void chains_by_their_energies(void **unused)
{
    fracas_record record[] = {seen(90, 30, 0, 2), seen(110, 40, 0.02, 1), seen(1, NAN, NAN, NAN)};
    fracas_final f = final_of(record, 3);
    assert_true(f.realizations == 2 && f.transits == 35 && f.seen == 100 && f.rest == 1.5);
    assert_true(near(f.growth, 0.02 * 110 / 200)); /* of the mean count */
    assert_true(f.count.value == 101.5 && f.count.low == 100);
    assert_true(near(f.count.high, 100 + 1.5 * 1.5 + 2 * sqrt(0.75 / 2))); /* 3.47 < B = 4.5 */
    assert_true(f.verdict == FRACAS_FINAL_YES && near(f.reach, 1 + 2.0 * 40 / 35));
    record[0].rest_bound = record[1].rest_bound = 1;
    assert_true(final_of(record, 2).count.high == 101);
    record[0].rest = 4; /* R = 2.5 > 2 % */
    assert_true(final_of(record, 2).verdict == FRACAS_FINAL_NO);
    record[0].rest = 2;
    record[1].transits = 9; /* k = 19.5 */
    assert_true(final_of(record, 2).verdict == FRACAS_FINAL_NO);
    record[1].transits = 40;
    record[0].growth = 0.06; /* 3.8 % of both */
    assert_true(final_of(record, 2).verdict == FRACAS_FINAL_NO);
    record[0].growth = 0;
    record[0].vibrating = 0.7; /* 0.4 of the dissipated, the mean */
    assert_true(final_of(record, 2).verdict == FRACAS_FINAL_CREEP);
    record[0].rest_bound = record[1].rest_bound = 0;
    record[0].rest = record[1].rest = 0;
    record[0].transits = record[1].transits = 5;
    assert_true(final_of(record, 2).verdict == FRACAS_FINAL_YES);
}

/* Below 15 fragments 0.3 of a break may come, not 2 % of them. */
static void few_fragments_by_a_third_of_a_break(void **unused)
{
    fracas_record record = seen(5, 30, 0, 0.29);
    assert_true(final_of(&record, 1).verdict == FRACAS_FINAL_YES);
    record = seen(5, 30, 0, 0.31);
    assert_true(final_of(&record, 1).verdict == FRACAS_FINAL_NO);
    record = seen(20, 30, 0, 0.39);
    assert_true(final_of(&record, 1).verdict == FRACAS_FINAL_YES);
}

static void surfaces_by_their_growth(void **unused)
{
    fracas_record record[] = {seen(110, 50, 0.025, NAN), seen(110, 70, 0.025, NAN)};
    record[0].fragments_held = record[1].fragments_held = 10;
    fracas_final f = final_of(record, 2);
    assert_true(f.seen == 100 && f.held == 10 && near(f.growth, 0.025) && isnan(f.rest));
    assert_true(near(f.count.value, 102.5) && f.count.low == 100 && near(f.count.high, 104.5));
    assert_true(f.verdict == FRACAS_FINAL_YES && near(f.reach, 5)); /* 1 + 2 2: twice as long */
    record[0].growth = record[1].growth = 0.035;
    assert_true(final_of(record, 2).verdict == FRACAS_FINAL_NO);
    record[0].growth = record[1].growth = 0.025;
    record[0].transits = 49; /* k = 59.5 */
    assert_true(final_of(record, 2).verdict == FRACAS_FINAL_NO);
    record[0].transits = record[1].transits = 20;
    f = final_of(record, 2);
    assert_true(near(f.count.high, 104.5) && near(f.reach, 7)); /* 1 + 2 60/20 */
    /* Before k = 20 by the shares of the table: at 10 from 0.64 to 0.84 are there, at 7.5 halfway
     * to those of 5, 0.37 to 0.71. */
    record[0].transits = record[1].transits = 10;
    f = final_of(record, 2);
    assert_true(f.verdict == FRACAS_FINAL_NO && near(f.count.value, 100 / 0.74));
    assert_true(near(f.count.low, 100 / 0.84) && near(f.count.high, 100 / 0.64));
    record[0].transits = record[1].transits = 7.5;
    f = final_of(record, 2);
    assert_true(near(f.count.low, 100 / 0.775) && near(f.count.high, 100 / 0.505));
}

/* Of 12 elements with 2 held ones there are at most 10 others: growth tells 1.5 times as many.
 * Where all are apart, nothing more can come, however early. */
static void never_more_than_elements(void **unused)
{
    fracas_fragment fragment[12];
    fracas_record record = seen(10, 30, 0.5, NAN);
    record.fragments_held = 2;
    record.fragment = fragment;
    record.nfragment = 10;
    for (size_t i = 0; i < 12; i++) fragment[i] = (fracas_fragment){.elements = i < 2 ? 2 : 1};
    fracas_final f = final_of(&record, 1);
    assert_true(f.count.value == 10 && f.count.low == 8 && f.count.high == 10);
    assert_true(f.verdict == FRACAS_FINAL_NO);
    record.fragments = 12;
    record.nfragment = 12;
    fragment[0].elements = fragment[1].elements = 1;
    record.transits = 5;
    f = final_of(&record, 1);
    assert_true(f.count.value == 10 && f.count.low == 10 && f.count.high == 10);
    assert_true(f.verdict == FRACAS_FINAL_YES);
}

static void a_whole_body_has_no_final_count(void **unused)
{
    const fracas_record record[] = {seen(1, NAN, NAN, NAN), seen(1, 3, 0, NAN)};
    for (size_t n = 0; n <= 2; n++) {
        const fracas_final f = final_of(record, n);
        assert_true(f.verdict == FRACAS_FINAL_NONE && isnan(f.count.value) && isnan(f.count.high));
    }
}

TESTS(chains_by_their_energies, few_fragments_by_a_third_of_a_break, surfaces_by_their_growth,
      never_more_than_elements, a_whole_body_has_no_final_count)
