/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Realizations that `fields:` of a campaign file chooses, by their numbers of fragments. */
#include "campaigns/file/chosen.h"
#include "tests/support/test.h"

#include <string.h>

static const fracas_candidate candidates[] = {{0, 7}, {2, 3}, {3, 9}, {4, 3}, {7, 9}, {8, 5}};

/* "2 3" for `of`, of the first n candidates. */
static void assert_chosen(const char *of, size_t n, const char *wanted)
{
    static const int64_t replicas[] = {8, 0, 5, 3};
    const fracas_numbers list = {FRACAS_COUNT(replicas), replicas};
    fracas_wanted_fields fields = {.replicas = &list};
    fracas_candidate copy[FRACAS_COUNT(candidates)];
    int64_t chosen[FRACAS_COUNT(candidates)];
    char text[64] = "";
    for (size_t k = 0; k < fracas_fields_section.nkinds; k++)
        if (!strcmp(fracas_fields_section.kinds[k]->name, of))
            fields.of = fracas_fields_section.kinds[k];
    assert_non_null(fields.of);
    memcpy(copy, candidates, sizeof copy);
    const size_t count = fracas_fields_choose(&fields, copy, n, chosen);
    for (size_t i = 0; i < count; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), " %d", (int)chosen[i]);
    assert_string_equal(text, wanted);
}

static void realizations_are_chosen(void **state)
{
    assert_chosen("first", 6, " 0");
    assert_chosen("listed", 6, " 0 3 8");
    assert_chosen("listed", 0, "");
    assert_chosen("median", 6, " 8"); /* 3 3 5 7 9 9 */
    assert_chosen("median", 5, " 0"); /* 3 3 7 9 9 */
    assert_chosen("median", 4, " 4"); /* 3 3 7 9: of equal ones the later is the larger */
    assert_chosen("extreme", 6, " 2 7");
    assert_chosen("extreme", 1, " 0"); /* both in one */
    assert_chosen("median", 0, "");
    assert_chosen("extreme", 0, "");
}

static void none_wants_none(void **state)
{
    const fracas_wanted_fields none = {.of = fracas_fields_section.kinds[0]},
                               first = {.of = fracas_fields_section.kinds[1]};
    assert_false(fracas_fields_wanted(&none));
    assert_true(fracas_fields_wanted(&first));
}

static void numbers_order_them(void **state)
{
    const fracas_fragment fragment[] = {{.mass = 2}, {.mass = 5}, {.mass = 3}};
    const fracas_record record = {.fragments = 3,
                                  .broken = 4,
                                  .dissipated = 5.5,
                                  .onset_time = 1e-6,
                                  .end_time = 2e-6,
                                  .nfragment = 3,
                                  .fragment = (fracas_fragment *)fragment};
    const fracas_kind *median = fracas_fields_section.kinds[2];
    const double wanted[] = {3, 5, 4, 5.5, 1e-6, 2e-6};
    fracas_wanted_fields fields = {.of = median};
    assert_true(fracas_fields_number(&fields, &record) == 3); /* unless it says another */
    assert_int_equal(median->params[0].nchoices, FRACAS_COUNT(wanted));
    for (size_t k = 0; k < FRACAS_COUNT(wanted); k++) {
        fields.by = median->params[0].choices[k];
        assert_true(fracas_fields_number(&fields, &record) == wanted[k]);
    }
}

static void those_without_a_number_are_left_out(void **state)
{
    const fracas_wanted_fields median = {.of = fracas_fields_section.kinds[2]},
                               extreme = {.of = fracas_fields_section.kinds[3]};
    fracas_candidate some[] = {{0, NAN}, {1, 8}, {2, 7}, {3, NAN}, {4, 9}}, none[] = {{3, NAN}};
    int64_t chosen[FRACAS_COUNT(some)];
    assert_int_equal(fracas_fields_choose(&median, some, FRACAS_COUNT(some), chosen), 1);
    assert_int_equal(chosen[0], 1);
    assert_int_equal(fracas_fields_choose(&extreme, some, FRACAS_COUNT(some), chosen), 2);
    assert_int_equal(chosen[0], 2);
    assert_int_equal(chosen[1], 4);
    assert_int_equal(fracas_fields_choose(&median, none, 1, chosen), 1);
    assert_int_equal(chosen[0], 3);
}

TESTS(numbers_order_them, those_without_a_number_are_left_out, realizations_are_chosen,
      none_wants_none)
