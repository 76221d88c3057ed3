/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `replicas` of a campaign file: a number or a rule, what is said about a wrong one, what goes into
 * hashes, what extends what. */
#include "tests/support/campaign_text.h"

#include "campaigns/file/replicas.h"
#include "tests/support/test.h"

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
    fracas_campaign *campaign = with_replicas(RULE);
    const fracas_point *point = &campaign->point[0];
    assert_int_equal(point->replicas, 16);
    assert_int_equal(point->rule.minimum, 16);
    assert_int_equal(point->rule.maximum, 256);
    assert_int_equal(fracas_point_most(point), 256);
    assert_int_equal(point->rule.quantity, FRACAS_MEAN_COUNT);
    assert_true(point->rule.relative_half_width == 0.02 && point->rule.confidence == 0.95);
    assert_int_equal(campaign->table.point[0].replicas, 16);
    assert_int_equal(campaign->table.point[0].most, 256);
    fracas_campaign_destroy(campaign);
    campaign = with_replicas(
        "{minimum: 8, maximum: 8, until: {quantity: dissipated, relative-half-width: 2 %}}");
    assert_int_equal(campaign->point[0].rule.quantity, FRACAS_DISSIPATED);
    assert_true(campaign->point[0].rule.relative_half_width == 0.02 &&
                campaign->point[0].rule.confidence == 0.95);
    fracas_campaign_destroy(campaign);
    campaign = with_replicas("3");
    assert_int_equal(campaign->point[0].rule.maximum, 0);
    assert_int_equal(fracas_point_most(&campaign->point[0]), 3);
    assert_int_equal(campaign->table.point[0].most, 0);
    fracas_campaign_destroy(campaign);
}

static void wrong_rules_are_refused(void **state)
{
#define UNTIL "until: {quantity: mean-count, relative-half-width: 0.02}"
    static const struct {
        const char *replicas, *words[3];
    } table[] = {
        {"[1, 2]", {"found a list", "expected a whole number or {minimum"}},
        {"0", {"out of range", "1 to 1000000000"}},
        {"{minimum: 16, maximum: 256}", {"`replicas` has no `until`", "expected {minimum"}},
        {"{maximum: 256, " UNTIL "}", {"has no `minimum`"}},
        {"{minimum: 16, " UNTIL "}", {"has no `maximum`"}},
        {"{minimum: 7, maximum: 256, " UNTIL "}", {"`minimum`: 7 is out of range", "8 to"}},
        {"{minimum: 16.5, maximum: 256, " UNTIL "}", {"`minimum`", "not a whole number"}},
        {"{minimum: 16, maximum: 15, " UNTIL "}", {"`maximum`: 15 is less than `minimum`, 16"}},
        {"{minimum: 16, maximum: 2000000000, " UNTIL "}", {"`maximum`", "out of range"}},
        {"{minimum: 16, maximun: 20, " UNTIL "}",
         {"unknown key `maximun` in `replicas`", "did you mean `maximum`?"}},
        {"{minimum: 16, maximum: 20, until: precise}",
         {"`until`: found `precise`", "expected {minimum"}},
        {"{minimum: 16, maximum: 20, until: {relative-half-width: 0.02}}",
         {"`until` has no `quantity`"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count}}",
         {"`until` has no `relative-half-width`"}},
        {"{minimum: 16, maximum: 20, until: {quantity: count, relative-half-width: 0.02}}",
         {"`quantity`: found `count`", "mean-count", "mean-size"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count, relative_half_width: 0.02}}",
         {"unknown key `relative_half_width` in `until`", "did you mean `relative-half-width`?"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count, relative-half-width: 0}}",
         {"out of range", "more than 0 to 1"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count, relative-half-width: 2}}",
         {"out of range", "to 1"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count, relative-half-width: 1 m}}",
         {"`relative-half-width`"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count, relative-half-width: [1]}}",
         {"found a list", "2 %"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count, relative-half-width: 0.02, "
         "confidence: 95}}",
         {"`confidence`: 95 is out of range", "0.5 to 0.999"}},
        {"{minimum: 16, maximum: 20, until: {quantity: mean-count, relative-half-width: 0.02, "
         "confidence: 0.4}}",
         {"out of range"}},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char line[300], path[40];
        snprintf(line, sizeof line, "replicas: %s", table[i].replicas);
        OWNED char *text = replace(plain_campaign, "replicas: 3", line);
        fracas_campaign *campaign = NULL;
        make_path(path);
        write_bytes(path, text, strlen(text));
        const fracas_err err = fracas_campaign_read(path, &campaign);
        unlink(path);
        if (err != FRACAS_USAGE || campaign) fail_msg("accepted: %s", line);
        if (!strstr(fracas_message(), ":25:")) fail_msg("no place: %s", fracas_message());
        for (int w = 0; w < 3 && table[i].words[w]; w++)
            if (!strstr(fracas_message(), table[i].words[w]))
                fail_msg("no \"%s\" in: %s", table[i].words[w], fracas_message());
    }
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
    assert_non_null(strstr(text, "\nreplicas: " RULE "\n"));
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
        const fracas_err err = fracas_campaign_extends(now, before);
        if (err != (table[i].words ? FRACAS_DAMAGED : FRACAS_OK))
            fail_msg("%s -> %s: %d", table[i].before, table[i].now, err);
        if (err && !strstr(fracas_message(), table[i].words))
            fail_msg("no \"%s\" in: %s", table[i].words, fracas_message());
    }
}

TESTS(a_rule_is_read, wrong_rules_are_refused, a_rule_is_written_and_hashed, cases_have_their_own,
      only_more_extends)
