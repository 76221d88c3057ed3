/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `replicas` of a campaign file: a number or a rule, what goes into
 * hashes, what extends what. */
#include "tests/support/campaign_text.h"

#include "campaigns/file/replicas.h"

#define RULE                                                                                \
    "{minimum: 16, maximum: 256, until: {quantity: mean-count, relative-half-width: 0.02, " \
    "confidence: 0.95}}"

static fracas_campaign *with_replicas(const char *replicas)
{
    char line[300];
    snprintf(line, sizeof line, "replicas: %s", replicas);
    OWNED char *text = replace(plain_campaign, "replicas: 3", line);
    fracas_campaign *campaign = read_text(text);
    return campaign;
}

static void a_rule_is_read(void **state)
{
    OWN(fracas_campaign) campaign = with_replicas(RULE);
    const fracas_point *point = &campaign->point[0];
    assert_int_equal(point->replicas, 16);
    assert_int_equal(point->rule.minimum, 16);
    assert_int_equal(point->rule.maximum, 256);
    assert_int_equal(fracas_point_most(point), 256);
    assert_int_equal(point->rule.quantity, FRACAS_MEAN_COUNT);
    assert_true(point->rule.relative_half_width == 0.02 && point->rule.confidence == 0.95);
    assert_int_equal(campaign->table.point[0].replicas, 16);
    assert_int_equal(campaign->table.point[0].most, 256);
    OWN(fracas_campaign) other = with_replicas(
        "{minimum: 8, maximum: 8, until: {quantity: dissipated, relative-half-width: 2 %}}");
    assert_int_equal(other->point[0].rule.quantity, FRACAS_DISSIPATED);
    assert_true(other->point[0].rule.relative_half_width == 0.02 &&
                other->point[0].rule.confidence == 0.95);
    OWN(fracas_campaign) fixed = with_replicas("3");
    assert_int_equal(fixed->point[0].rule.maximum, 0);
    assert_int_equal(fracas_point_most(&fixed->point[0]), 3);
    assert_int_equal(fixed->table.point[0].most, 0);
}

/* The resolved file says the same, and the hash of a campaign goes by the rule, that of a point
 * does not. */
static void a_rule_is_written_and_hashed(void **state)
{
    static const char *const other[] = {
        "16",
        "{minimum: 24, maximum: 256, until: {quantity: mean-count, relative-half-width: 0.02, "
        "confidence: 0.95}}",
        "{minimum: 16, maximum: 257, until: {quantity: mean-count, relative-half-width: 0.02, "
        "confidence: 0.95}}",
        "{minimum: 16, maximum: 256, until: {quantity: mean-size, relative-half-width: 0.02, "
        "confidence: 0.95}}",
        "{minimum: 16, maximum: 256, until: {quantity: mean-count, relative-half-width: 0.021, "
        "confidence: 0.95}}",
        "{minimum: 16, maximum: 256, until: {quantity: mean-count, relative-half-width: 0.02, "
        "confidence: 0.96}}",
    };
    OWN(fracas_campaign) campaign = with_replicas(RULE);
    OWNED char *text = write_text(campaign);
    assert_has(text, "\nreplicas: " RULE "\n");
    OWN(fracas_campaign) back = read_text(text);
    assert_true(fracas_hash_equal(&campaign->hash, &back->hash));
    assert_true(fracas_replicas_same(&campaign->point[0], &back->point[0]));
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        OWN(fracas_campaign) changed = with_replicas(other[i]);
        if (fracas_hash_equal(&campaign->hash, &changed->hash))
            fail_msg("the same campaign: %s", other[i]);
        assert_true(fracas_hash_equal(&campaign->point[0].hash, &changed->point[0].hash));
        assert_false(fracas_replicas_same(&campaign->point[0], &changed->point[0]));
    }
}

/* A case may have its own, a number beside rules. */
static void cases_have_their_own(void **state)
{
    char *text = replace(
        plain_campaign, "",
        "sweep:\n  - cases:\n      - {name: a, loading: {rate: 1e3}, replicas: " RULE "}\n"
        "      - {name: b, loading: {rate: 2e3}}\n");
    OWN(fracas_campaign) campaign = read_text(text);
    free(text);
    assert_int_equal(campaign->point[0].rule.maximum, 256);
    assert_int_equal(campaign->point[1].rule.maximum, 0);
    assert_int_equal(campaign->point[1].replicas, 3);
    text = write_text(campaign);
    OWN(fracas_campaign) back = read_text(text);
    assert_true(fracas_hash_equal(&campaign->hash, &back->hash));
    assert_true(fracas_replicas_same(&campaign->point[0], &back->point[0]) &&
                fracas_replicas_same(&campaign->point[1], &back->point[1]));
    free(text);
}

static void only_more_extends(void **state)
{
#define MADE(minimum, maximum, quantity, width, confidence)                    \
    "{minimum: " minimum ", maximum: " maximum ", until: {quantity: " quantity \
    ", relative-half-width: " width ", confidence: " confidence "}}"
    static const struct {
        const char *before, *now, *words; /* NULL: it extends */
    } table[] = {
        {RULE, RULE, NULL},
        {RULE, MADE("16", "300", "mean-count", "0.02", "0.95"), NULL},
        {RULE, MADE("16", "256", "mean-count", "0.01", "0.95"), NULL},
        {RULE, MADE("16", "256", "mean-count", "0.02", "0.99"), NULL},
        {RULE, MADE("16", "255", "mean-count", "0.02", "0.95"),
         "replicas.maximum is 256 in the study (its point 0), but 255"},
        {RULE, MADE("24", "256", "mean-count", "0.02", "0.95"),
         "replicas.minimum is 16 in the study (its point 0), but 24"},
        {RULE, MADE("8", "256", "mean-count", "0.02", "0.95"), "replicas.minimum is 16"},
        {RULE, MADE("16", "256", "mean-size", "0.02", "0.95"),
         "replicas.until.quantity is mean-count in the study (its point 0), but mean-size"},
        {RULE, MADE("16", "256", "mean-count", "0.03", "0.95"),
         "replicas.until.relative-half-width is 0.02"},
        {RULE, MADE("16", "256", "mean-count", "0.02", "0.9"), "replicas.until.confidence is 0.95"},
        {"16", RULE, NULL},
        {"3", RULE, NULL},
        {"17", RULE,
         "replicas is 17 in the study (its point 0), but 16 in this campaign file; "
         "replicas.minimum can only"},
        {RULE, "256", NULL},
        {RULE, "255", "replicas.maximum is 256 in the study (its point 0), but 255"},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        OWN(fracas_campaign) before = with_replicas(table[i].before),
                             *now = with_replicas(table[i].now);
        check_extends(now, before, (const char *const[3]){table[i].words});
    }
}

TESTS(a_rule_is_read, a_rule_is_written_and_hashed, cases_have_their_own, only_more_extends)
