/* The plan: what is printed, and that it is what the engine says. */
#include "campaigns/plan/plan.h"
#include "engine/engine.h"
#include "tests/unit/campaign_text.h"

#include <stdio.h>

static const char sweep[] = "sweep:\n  - loading.rate: [1e3, 1e4]\n  - strength.maximum: [300 MPa, 301 MPa]\n";

static char *print_plan(const fracas_campaign *campaign, bool json)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fracas_err err = fracas_plan_print(campaign, 2, out, json);
    if (err) fail_msg("%s", fracas_message());
    assert_int_equal(fclose(out), 0);
    return text;
}

static void expect(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("no \"%s\" in:\n%s", part, text);
}

static void test_cost(void **state)
{
    (void)state;
    fracas_campaign *campaign = read_text(plain_campaign);
    fracas_model *model;
    double cost = 0;
    assert_int_equal(fracas_model_create(&campaign->point[0].spec, &model), FRACAS_OK);
    assert_int_equal(fracas_plan_cost(campaign, 0, &cost), FRACAS_OK);
    assert_true(cost == 100.0 * (double)fracas_model_steps(model)); /* whole numbers: exact */
    assert_true(fracas_model_steps(model) > 1);
    fracas_model_destroy(model);
    fracas_campaign_destroy(campaign);
}

/* Rows end at the same column, as every cell is right-aligned. */
static void test_text(void **state)
{
    (void)state;
    fracas_campaign *campaign = read_replaced("", sweep);
    char *text = print_plan(campaign, false);
    expect(text, "Campaign test: 4 points, 12 realizations\n");
    expect(text, "for 2 processes");
    const char *head = strstr(text, "point  loading.rate  strength.maximum  replicas  elements  time step");
    if (!head) fail_msg("no head in:\n%s", text);
    size_t length = strcspn(head, "\n");
    for (int row = 0; row < 7; row++, head += length + 1) { /* head, units, four points, total */
        if (strcspn(head, "\n") != length) fail_msg("row %d is not as long as the head:\n%s", row, text);
        if (row == 1) assert_memory_equal(head, "                1/s                Pa", 37);
        if (row == 6) assert_memory_equal(head, "total", 5);
    }
    free(text);
    fracas_campaign_destroy(campaign);
}

static void test_json(void **state)
{
    (void)state;
    fracas_campaign *campaign = read_replaced("", sweep);
    char *text = print_plan(campaign, true);
    expect(text, "\"points\": 4,");
    expect(text, "\"realizations\": 12");
    expect(text, "\"loading.rate\": 10000");
    expect(text, "\"elements\": 100");
    /* Bytes: a record's scalars and, for each of 100/20 fragments and 10 + 4 history rows, its struct. */
    char bytes[64];
    snprintf(bytes, sizeof bytes, "\"bytes\": %zu",
             3 * (offsetof(fracas_record, nfragment) + 5 * sizeof(fracas_fragment) + 14 * sizeof(fracas_history_row)));
    expect(text, bytes);
    free(text);
    fracas_campaign_destroy(campaign);
}

/* What the engine refuses is refused here, with the point. */
static void test_refused(void **state)
{
    (void)state;
    fracas_campaign *campaign = read_replaced("", "sweep:\n  - cohesive.fracture_energy: [100, 1e-9]\n");
    FILE *out = fopen("/dev/null", "w");
    assert_non_null(out);
    assert_int_equal(fracas_plan_print(campaign, 1, out, false), FRACAS_USAGE);
    expect(fracas_message(), "point 2: ");
    fclose(out);
    fracas_campaign_destroy(campaign);
}

static void test_write_fails(void **state)
{
    (void)state;
    fracas_campaign *campaign = read_text(plain_campaign);
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    assert_int_equal(fracas_plan_print(campaign, 1, full, true), FRACAS_ENVIRONMENT);
    expect(fracas_message(), "No space left");
    fclose(full);
    fracas_campaign_destroy(campaign);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cost),    cmocka_unit_test(test_text),        cmocka_unit_test(test_json),
        cmocka_unit_test(test_refused), cmocka_unit_test(test_write_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
