/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/replicas.h"

#include "campaigns/file/identity.h"

#include <inttypes.h>
#include <string.h>

enum { MOST = 1000000000 };

#define FORM                                                     \
    "{minimum: 16, maximum: 256, until: {quantity: mean-count, " \
    "relative-half-width: 0.02, confidence: 0.95}}"

/* ---- reading ---- */

static fracas_err need(const fracas_file *file, const fracas_node *node, bool unknown,
                       const char *key, const fracas_node **found)
{
    return fracas_file_need(file, node, key, unknown, found, "`%s` has no `%s`; expected %s",
                            node->key->text, key, FORM);
}

static fracas_err read_quantity(const fracas_file *file, const fracas_node *node,
                                fracas_quantity *quantity)
{
    for (int q = 0; q < FRACAS_NQUANTITIES; q++)
        if (strcmp(fracas_node_text(node), fracas_quantity_name[q]) == 0) {
            *quantity = (fracas_quantity)q;
            return FRACAS_OK;
        }
    return fracas_file_expected(
        file, node, "quantity",
        "mean-count (of fragments), mean-size (of fragments) or dissipated (energy)");
}

/* A pure number from `minimum` (excluded if `open`) to `maximum`. */
static fracas_err read_fraction(const fracas_file *file, const fracas_node *node, double minimum,
                                bool open, double maximum, double *value)
{
    const char *key = node->key->text;
    if (node->type != FRACAS_SCALAR)
        return fracas_file_expected(file, node, key, "a number, as 0.02 or 2 %");
    fracas_err err = fracas_units_read(file->units, node->text, "1", value);
    if (err) return err == FRACAS_USAGE ? fracas_file_error_within(file, node, key) : err;
    if ((open ? *value > minimum : *value >= minimum) && *value <= maximum) return FRACAS_OK;
    return fracas_file_error(file, node, "`%s`: %s is out of range; allowed is %s %g to %g", key,
                             node->text, open ? "more than" : "from", minimum, maximum);
}

static fracas_err read_width(const fracas_file *file, const fracas_node *until, bool unknown,
                             double *width)
{
    const fracas_node *found;
    TRY(need(file, until, unknown, "relative-half-width", &found));
    return read_fraction(file, found, 0, true, 1, width);
}

static fracas_err read_until(const fracas_file *file, const fracas_node *node,
                             fracas_sequential_rule *rule)
{
    static const char *const keys[] = {"quantity", "relative-half-width", "confidence", NULL};
    const fracas_node *found;
    bool unknown;
    if (node->type != FRACAS_MAP) return fracas_file_expected(file, node, "until", FORM);
    TRY(fracas_file_check_keys(file, node, keys, "`until`", &unknown));
    TRY(fracas_file_note(file, need(file, node, unknown, "quantity", &found)));
    if (found) TRY(fracas_file_note(file, read_quantity(file, found, &rule->quantity)));
    TRY(fracas_file_note(file, read_width(file, node, unknown, &rule->relative_half_width)));
    rule->confidence = 0.95;
    found = fracas_node_find(node, "confidence");
    return found ? read_fraction(file, found, 0.5, false, 0.999, &rule->confidence) : FRACAS_OK;
}

static fracas_err read_bound(const fracas_file *file, const fracas_node *node, bool unknown,
                             const char *key, int64_t *bound)
{
    const fracas_node *found;
    TRY(need(file, node, unknown, key, &found));
    return fracas_setting_integer(file, key, found, FRACAS_ROUND_FIRST, MOST, bound);
}

static fracas_err read_rule(const fracas_file *file, const fracas_node *node,
                            fracas_sequential_rule *rule)
{
    static const char *const keys[] = {"minimum", "maximum", "until", NULL};
    const fracas_node *found;
    const size_t before = fracas_file_noted(file);
    bool unknown;
    TRY(fracas_file_check_keys(file, node, keys, "`replicas`", &unknown));
    TRY(fracas_file_note(file, read_bound(file, node, unknown, "minimum", &rule->minimum)));
    TRY(fracas_file_note(file, read_bound(file, node, unknown, "maximum", &rule->maximum)));
    if (rule->maximum < rule->minimum && fracas_file_noted(file) == before)
        TRY(fracas_file_note(file,
                             fracas_file_error(file, fracas_node_find(node, "maximum"),
                                               "`maximum`: %" PRId64
                                               " is less than `minimum`, %" PRId64 "; raise it",
                                               rule->maximum, rule->minimum)));
    TRY(need(file, node, unknown, "until", &found));
    return read_until(file, found, rule);
}

static fracas_err read_any(const fracas_file *file, const fracas_node *node,
                           fracas_replicas *replicas)
{
    if (node->type == FRACAS_LIST)
        return fracas_file_expected(file, node, "replicas", "a whole number or " FORM);
    if (node->type != FRACAS_MAP)
        return fracas_setting_integer(file, "replicas", node, 1, MOST, &replicas->count);
    TRY(read_rule(file, node, &replicas->rule));
    replicas->count = replicas->rule.minimum;
    return FRACAS_OK;
}

fracas_err fracas_replicas_read(const fracas_file *file, const fracas_node *node,
                                fracas_replicas *replicas)
{
    const size_t before = fracas_file_noted(file);
    *replicas = (fracas_replicas){0};
    TRY(fracas_file_note(file, read_any(file, node, replicas)));
    if (fracas_file_noted(file) > before) replicas->count = 1; /* they are given, if wrong */
    return FRACAS_OK;
}

/* ---- writing and comparing ---- */

void fracas_replicas_write(const fracas_point *point, FILE *out)
{
    const fracas_sequential_rule *rule = &point->rule;
    char width[FRACAS_NUMBER_TEXT], confidence[FRACAS_NUMBER_TEXT];
    if (rule->maximum == 0) {
        fprintf(out, "%" PRId64, point->replicas);
        return;
    }
    fracas_number_write(rule->relative_half_width, width);
    fracas_number_write(rule->confidence, confidence);
    fprintf(out,
            "{minimum: %" PRId64 ", maximum: %" PRId64
            ", until: {quantity: %s, relative-half-width: %s, confidence: %s}}",
            rule->minimum, rule->maximum, fracas_quantity_name[rule->quantity], width, confidence);
}

bool fracas_replicas_same(const fracas_point *a, const fracas_point *b)
{
    return a->replicas == b->replicas && a->rule.maximum == b->rule.maximum &&
           a->rule.quantity == b->rule.quantity &&
           a->rule.relative_half_width == b->rule.relative_half_width &&
           a->rule.confidence == b->rule.confidence;
}

/* ---- given beside the file ---- */

fracas_err fracas_campaign_replicas(fracas_campaign *campaign, int64_t replicas)
{
    const fracas_catalog *catalog;
    fracas_point_row *row = (fracas_point_row *)campaign->table.point; /* our own memory */
    if (replicas < 1 || replicas > MOST)
        return fracas_fail(FRACAS_USAGE, "--replicas is %" PRId64 "; allowed is 1 to %d", replicas,
                           MOST);
    for (size_t p = 0; p < campaign->npoints; p++)
        if (campaign->point[p].rule.maximum > 0)
            return fracas_fail(
                FRACAS_USAGE,
                "--replicas %" PRId64
                ": a rule decides the replicas of point %zu (`replicas: {minimum: %" PRId64
                ", maximum: %" PRId64
                ", until: ...}`); change the rule in the file, or leave --replicas out",
                replicas, p, campaign->point[p].rule.minimum, campaign->point[p].rule.maximum);
    TRY(fracas_catalog_make(campaign->memory, &catalog));
    for (size_t p = 0; p < campaign->npoints; p++)
        campaign->point[p].replicas = row[p].replicas = replicas;
    return fracas_campaign_identify(catalog, campaign);
}

/* ---- extending ---- */

static fracas_err differs(const char *path, double was, double is, size_t b, const char *remedy)
{
    return fracas_fail(
        FRACAS_DAMAGED,
        "%s is %.15g in the study (its point %zu), but %.15g in this campaign file; %s", path, was,
        b, is, remedy);
}

static fracas_err extend_rule(const fracas_sequential_rule *now, const fracas_sequential_rule *was,
                              size_t b)
{
    if (now->quantity != was->quantity)
        return fracas_fail(FRACAS_DAMAGED,
                           "replicas.until.quantity is %s in the study (its point %zu), but %s in "
                           "this campaign file; it must stay",
                           fracas_quantity_name[was->quantity], b,
                           fracas_quantity_name[now->quantity]);
    if (now->minimum != was->minimum)
        return differs("replicas.minimum", (double)was->minimum, (double)now->minimum, b,
                       "it must stay");
    if (now->maximum < was->maximum)
        return differs("replicas.maximum", (double)was->maximum, (double)now->maximum, b,
                       "it can only grow");
    if (now->relative_half_width > was->relative_half_width)
        return differs("replicas.until.relative-half-width", was->relative_half_width,
                       now->relative_half_width, b, "it can only shrink");
    if (now->confidence < was->confidence)
        return differs("replicas.until.confidence", was->confidence, now->confidence, b,
                       "it can only grow");
    return FRACAS_OK;
}

fracas_err fracas_replicas_extend(const fracas_point *now, const fracas_point *before, size_t b)
{
    const bool decides = now->rule.maximum > 0, decided = before->rule.maximum > 0;
    if (decides && decided) return extend_rule(&now->rule, &before->rule, b);
    if (decided && now->replicas < before->rule.maximum)
        return differs("replicas.maximum", (double)before->rule.maximum, (double)now->replicas, b,
                       "it can only grow");
    if (now->replicas >= before->replicas) return FRACAS_OK;
    if (decides)
        return differs("replicas", (double)before->replicas, (double)now->replicas, b,
                       "replicas.minimum can only be as many or more");
    return differs("replicas", (double)before->replicas, (double)now->replicas, b,
                   "it can only grow");
}
