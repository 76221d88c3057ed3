/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a campaign a run computes: --replicas and --part. */
#include "tests/support/campaign_text.h"

#include "campaigns/scheduler/session/prepare.h"

static const char rule[] =
    "replicas: {minimum: 16, maximum: 64, until: {quantity: dissipated, relative-half-width: 0.1}}";

/* Reads the plain campaign with `find` replaced by `put` as a run with these options does. */
static fracas_err read_run(const char *find, const char *put, int64_t replicas, int part, int parts,
                           fracas_campaign **campaign)
{
    char path[40], *text = replace(plain_campaign, find, put);
    make_path(path);
    write_bytes(path, text, strlen(text));
    fracas_run_options options;
    fracas_run_options_init(&options);
    options.file = path;
    options.replicas = replicas;
    options.part = part;
    options.parts = parts;
    *campaign = NULL;
    fracas_err err = fracas_run_campaign(&options, campaign);
    unlink(path);
    free(text);
    return err;
}

/* The campaign is the one that the file with this number would be, hash, table and resolved file
 * included. */
static void replicas_are_as_if_the_file_said_so(void **state)
{
    static const char sweep[] = "sweep:\n  - cases:\n      - {name: a, loading.rate: 1e3}\n      - "
                                "{name: b, replicas: 5}\noutput:\n";
    static const char same[] = "sweep:\n  - cases:\n      - {name: a, loading.rate: 1e3, replicas: "
                               "8}\n      - {name: b, replicas: 8}\noutput:\n";
    fracas_campaign *given, *said;
    assert_int_equal(read_run("output:\n", sweep, 8, 0, 0, &given), FRACAS_OK);
    assert_int_equal(read_run("output:\n", same, 0, 0, 0, &said), FRACAS_OK);
    assert_true(fracas_hash_equal(&given->hash, &said->hash));
    for (size_t p = 0; p < 2; p++) {
        assert_int_equal(given->point[p].replicas, 8);
        assert_int_equal(given->table.point[p].replicas, 8);
    }
    OWNED char *a = write_text(given), *b = write_text(said);
    assert_string_equal(a, b);
    fracas_campaign_destroy(said);
    assert_int_equal(read_run("output:\n", sweep, 0, 0, 0, &said),
                     FRACAS_OK); /* without the option */
    assert_int_equal(said->point[0].replicas, 3);
    assert_int_equal(said->point[1].replicas, 5);
    OK(fracas_campaign_extends(given, said));
    assert_int_equal(fracas_campaign_extends(said, given),
                     FRACAS_DAMAGED); /* fewer than the study has */
    fracas_campaign_destroy(said);
    fracas_campaign_destroy(given);
}

static void assert_refused(const char *replicas, int64_t given, int part, int parts,
                           const char *one, const char *other)
{
    fracas_campaign *campaign;
    assert_int_equal(read_run("replicas: 3", replicas, given, part, parts, &campaign),
                     FRACAS_USAGE);
    assert_null(campaign);
    if (!strstr(fracas_message(), one) || !strstr(fracas_message(), other))
        fail_msg("%s", fracas_message());
}

static void a_rule_goes_with_neither(void **state)
{
    OWN(fracas_campaign) campaign;
    assert_refused(rule, 8, 0, 0, "--replicas 8: a rule", "replicas: {minimum: 16, maximum: 64");
    assert_refused(rule, 0, 1, 2, "--part 1/2:", "a rule decides the replicas of point 0");
    assert_refused("replicas: 3", -1, 0, 0, "--replicas is -1", "1 to 1000000000");
    assert_refused("replicas: 3", 1000000001, 0, 0, "--replicas is 1000000001", "1 to 1000000000");
    assert_int_equal(read_run("replicas: 3", rule, 0, 1, 1, &campaign),
                     FRACAS_OK); /* one part is all */
}

/* The parts are all of the rows, each row once. */
static void parts_share_the_plan(void **state)
{
    enum { ROWS = 23 };
    for (int parts = 0; parts <= ROWS + 2; parts++) {
        int found[ROWS] = {0};
        size_t most = 0, least = ROWS;
        for (int part = 1; part <= (parts ? parts : 1); part++) {
            fracas_index_row row[ROWS];
            for (size_t i = 0; i < ROWS; i++) row[i] = (fracas_index_row){.replica = (int64_t)i};
            const size_t count = fracas_run_part(parts ? part : 0, parts, row, ROWS);
            for (size_t i = 0; i < count; i++) found[row[i].replica]++;
            if (count && parts) assert_int_equal(row[0].replica, part - 1);
            if (count > most) most = count;
            if (count < least) least = count;
        }
        for (size_t i = 0; i < ROWS; i++) assert_int_equal(found[i], 1);
        assert_true(most <= least + 1);
    }
}

TESTS(replicas_are_as_if_the_file_said_so, a_rule_goes_with_neither, parts_share_the_plan)
