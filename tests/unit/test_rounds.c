/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rounds of a study: what the index makes of them, whatever order its realizations come in; what is
 * recorded, merged and found wrong. */
#include "tests/support/campaign_text.h"
#include "tests/support/study_fixture.h"

#include "campaigns/scheduler/session/rounds.h"
#include "campaigns/scheduler/worker/segment.h"

static const char rule[] = "sweep:\n  - loading.rate: [1e3, 1e4]\n";
static fracas_campaign *campaign;
static fracas_rounds rounds;
static fracas_decision *decision;

static fracas_campaign *make(const char *replicas)
{
    char line[300];
    snprintf(line, sizeof line, "replicas: %s", replicas);
    OWNED char *fixed = replace(plain_campaign, "replicas: 3", line),
               *text = replace(fixed, "", rule);
    fracas_campaign *made = read_text(text);
    return made;
}

static int begin(void **state)
{
    study = sample_folder();
    assert_int_equal(mkdir(sample_path(study, "segments"), 0777), 0);
    campaign = make(
        "{minimum: 8, maximum: 24, until: {quantity: dissipated, relative-half-width: 0.1}}");
    OK(fracas_index_open(study, true, &index_));
    OK(fracas_index_plan(index_, &campaign->table));
    OK(fracas_rounds_init(&rounds, campaign, index_));
    return 0;
}

static int end(void **state)
{
    fracas_rounds_clear(&rounds);
    fracas_campaign_destroy(campaign);
    free(decision);
    decision = NULL;
    return tear_down(state);
}

/* Commits replicas first to last of point p; what is dissipated alternates between 1 - spread and 1
 * + spread. */
static void commit(size_t p, int64_t first, int64_t last, double spread, int64_t outcome)
{
    static int number;
    fracas_segment_row row[32];
    char name[32];
    const fracas_file_seal seal = {100, (uint64_t)++number};
    for (int64_t r = first; r <= last; r++)
        row[r - first] = (fracas_segment_row){
            .point = campaign->point[p].hash,
            .replica = r,
            .row = r - first,
            .summary = {.outcome = outcome,
                        .fragments = 5,
                        .dissipated = 1 + (r % 2 ? spread : -spread),
                        .size = 0.01}};
    snprintf(name, sizeof name, "x%d.h5", number);
    OK(fracas_index_commit(index_, name, &seal, row, (size_t)(last - first + 1), "{}"));
}

/* The decisions about a point, until others are looked at. */
static void look(size_t p, size_t wanted)
{
    size_t count;
    free(decision);
    OK(fracas_index_decisions(index_, &campaign->point[p].hash, &decision, &count));
    assert_int_equal(count, wanted);
}

static int64_t rows_of(size_t p)
{
    fracas_index_counts counts, point;
    const fracas_point_table one = {.npoints = 1, .point = &campaign->table.point[p]};
    OK(fracas_index_count_points(index_, &one, &counts, &point));
    return point.realizations;
}

/* Half width with n values of 1 -+ spread: t spread sqrt(n/(n - 1))/sqrt(n). At 8 of 0.05 0.0447,
 * of 0.5 0.447; at 24 0.216. */
static void rounds_go_on_until_they_are_narrow(void **state)
{
    assert_int_equal(rounds.open, 2);
    commit(0, 0, 6, 0.05, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    assert_int_equal(rounds.open, 2); /* one is missing */
    look(0, 0);
    commit(0, 7, 7, 0.05, FRACAS_TIME_LIMIT);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    assert_int_equal(rounds.open, 1);
    assert_int_equal(rounds.point[0].replicas, 8);
    look(0, 1);
    assert_int_equal(decision[0].stop, FRACAS_PRECISE);
    assert_int_equal(decision[0].used, 8);
    assert_true(fabs(decision[0].mean - 1) < 1e-15);
    assert_true(fabs(decision[0].half_width - 2.3646242515927849 * 0.05 / sqrt(7)) < 1e-13);
    commit(1, 0, 7, 0.5, FRACAS_INTACT);
    OK(fracas_rounds_advance(&rounds, index_, 1));
    assert_int_equal(rounds.point[1].replicas, 16);
    assert_int_equal(rounds.round[1], 1);
    assert_int_equal(rows_of(1), 16);
    commit(1, 8, 15, 0.5, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 1));
    commit(1, 16, 23, 0.5, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 1));
    assert_int_equal(rounds.open, 0);
    look(1, 3);
    assert_int_equal(decision[0].stop, FRACAS_GO_ON);
    assert_int_equal(decision[1].replicas, 16);
    assert_int_equal(decision[2].stop, FRACAS_AT_MAXIMUM);
    OK(fracas_rounds_check(campaign, index_));
    FRACAS_CLEARED(fracas_rounds) again;
    OK(fracas_rounds_init(&again, campaign, index_));
    assert_int_equal(again.open, 0);
    assert_int_equal(again.point[0].replicas, 8);
    assert_int_equal(again.point[1].replicas, 24);
}

/* Three that ended badly and one without a record are in the round, but not in the mean. */
static void what_failed_does_not_count(void **state)
{
    commit(0, 0, 3, 0.05, FRACAS_FRAGMENTED);
    commit(0, 4, 4, 7, FRACAS_NONFINITE);
    commit(0, 5, 5, 7, FRACAS_ENERGY_DRIFT);
    commit(0, 6, 6, 7, FRACAS_FAILED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    look(0, 0);
    OK(fracas_index_fail(index_, &campaign->point[0].hash, 7, "signal 11", true));
    OK(fracas_rounds_advance(&rounds, index_, 0));
    look(0, 1);
    assert_int_equal(decision[0].used, 4);
    assert_true(fabs(decision[0].mean - 1) < 1e-15);
}

/* Later rounds may be there first, as after the loss of the index: they wait until it is their
 * turn, and what is too much goes. */
static void rounds_that_are_there_already_are_decided_at_once(void **state)
{
    fracas_point_row all = campaign->table.point[1];
    all.replicas = 24;
    OK(fracas_index_plan_point(index_, &all));
    commit(1, 8, 23, 0.2, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 1));
    assert_int_equal(rounds.point[1].replicas, 8);
    commit(1, 0, 7, 0.2, FRACAS_FRAGMENTED); /* 0.18 at 8, 0.11 at 16, 0.086 at 24 */
    OK(fracas_rounds_advance(&rounds, index_, 1));
    look(1, 3);
    assert_int_equal(decision[2].stop, FRACAS_PRECISE);
    all = campaign->table.point[0];
    all.replicas = 24;
    OK(fracas_index_plan_point(index_, &all));
    assert_int_equal(rows_of(0), 24);
    commit(0, 0, 7, 0.05, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    assert_int_equal(rows_of(0), 8); /* it has stopped: the others are not asked for */
}

static void a_decision_that_does_not_follow_is_damage(void **state)
{
    fracas_rounds again;
    commit(0, 0, 7, 0.05, FRACAS_FRAGMENTED);
    commit(1, 0, 7, 0.05, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    FAILS(fracas_rounds_check(campaign, index_), FRACAS_DAMAGED,
          "lacks a decision on the replicas of point 1");
    OK(fracas_rounds_advance(&rounds, index_, 1));
    OK(fracas_rounds_check(campaign, index_));
    sql("CREATE TABLE kept AS SELECT * FROM decision");
    sql("UPDATE decision SET round = 1 WHERE point = 2");
    sql("INSERT INTO decision SELECT * FROM kept WHERE point = 2");
    FAILS(fracas_rounds_check(campaign, index_), FRACAS_DAMAGED, "or has one too many");
    sql("DELETE FROM decision WHERE round = 1");
    sql("UPDATE decision SET half_width = half_width * (1 + 1e-15) WHERE point = 2");
    FAILS(fracas_rounds_check(campaign, index_), FRACAS_DAMAGED, "round 0 of point 1");
    FAILS(fracas_rounds_init(&again, campaign, index_), FRACAS_DAMAGED, "round 0 of point 1");
    fracas_rounds_clear(&again);
    sql("UPDATE realization SET status = 'planned' WHERE point = 2 AND replica = 3"); /* its segment
                                                                                         was lost */
    OK(fracas_rounds_init(&again, campaign, index_)); /* nothing to compare with yet */
    assert_int_equal(again.open, 0);
    fracas_rounds_clear(&again);
    FAILS(fracas_rounds_check(campaign, index_), FRACAS_DAMAGED, "point 1");
    sql("UPDATE decision SET stop = 7 WHERE point = 2");
    fracas_decision *none;
    size_t count;
    FAILS(fracas_index_decisions(index_, &campaign->point[1].hash, &none, &count), FRACAS_DAMAGED,
          "`decision`");
}

/* Another rule takes up the realizations, not the decisions. */
static void a_stronger_rule_decides_again(void **state)
{
    FRACAS_CLEARED(fracas_rounds) again;
    commit(0, 0, 7, 0.05, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    OWN(fracas_campaign) now = make(
        "{minimum: 8, maximum: 100, until: {quantity: dissipated, relative-half-width: 0.01}}");
    OK(fracas_index_plan(index_, &now->table));
    OK(fracas_rounds_init(&again, now, index_));
    assert_int_equal(again.point[0].replicas, 16);
    look(0, 1);
    assert_int_equal(decision[0].stop, FRACAS_GO_ON);
    assert_int_equal(decision[0].maximum, 100);
}

/* A recorded decision counts for its own rule alone; that it is wrong is found only there. */
static void a_rule_that_differs_anywhere_decides_anew(void **state)
{
    static const char *const other[] = {
        "{minimum: 9, maximum: 24, until: {quantity: dissipated, relative-half-width: 0.1}}",
        "{minimum: 8, maximum: 25, until: {quantity: dissipated, relative-half-width: 0.1}}",
        "{minimum: 8, maximum: 24, until: {quantity: mean-size, relative-half-width: 0.1}}",
        "{minimum: 8, maximum: 24, until: {quantity: dissipated, relative-half-width: 0.2}}",
        ("{minimum: 8, maximum: 24, until: {quantity: dissipated, relative-half-width: 0.1, "
         "confidence: 0.9}}")};
    fracas_rounds again;
    for (size_t p = 0; p < 2; p++) commit(p, 0, 7, 0.05, FRACAS_FRAGMENTED);
    for (size_t i = 0; i < FRACAS_COUNT(other); i++) {
        sql("DELETE FROM decision");
        OK(fracas_rounds_init(&again, campaign, index_));
        fracas_rounds_clear(&again);
        sql("UPDATE decision SET half_width = 7");
        FAILS(fracas_rounds_init(&again, campaign, index_), FRACAS_DAMAGED, "round 0 of point 0");
        fracas_rounds_clear(&again);
        OWN(fracas_campaign) now = make(other[i]);
        OK(fracas_index_plan(index_, &now->table));
        OK(fracas_rounds_init(&again, now, index_));
        assert_int_equal(again.open, i == 0 ? 2 : 0); /* the first asks for one more */
        fracas_rounds_clear(&again);
        if (i > 0) OK(fracas_rounds_check(now, index_));
    }
}

static void mean_size_by_hand(void **state)
{
    fracas_fragment fragment[4] = {{.size = 1}, {.size = 2}, {.size = 3}, {.size = 6}};
    const fracas_record record = {.fragment = fragment,
                                  .nfragment = 4,
                                  .dissipated = 7,
                                  .residual = 8},
                        none = {.fragment = NULL};
    const fracas_summary whole = fracas_summary_of(&record);
    assert_true(whole.size == 3 && whole.dissipated == 7 && whole.residual == 8);
    assert_true(fracas_record_mean_size(&record) == 3);
    assert_true(isnan(fracas_record_mean_size(&none)));
}

/* A larger maximum alone goes on where the smaller one ended. */
static void a_larger_maximum_goes_on(void **state)
{
    FRACAS_CLEARED(fracas_rounds) again;
    commit(0, 0, 7, 0.5, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    commit(0, 8, 15, 0.5, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    commit(0, 16, 23, 0.5, FRACAS_FRAGMENTED);
    OK(fracas_rounds_advance(&rounds, index_, 0));
    assert_int_equal(rounds.open, 1); /* 0.216 is more than 0.1, but 24 is the maximum */
    OWN(fracas_campaign) now = make(
        "{minimum: 8, maximum: 25, until: {quantity: dissipated, relative-half-width: 0.1}}");
    OK(fracas_index_plan(index_, &now->table));
    OK(fracas_rounds_init(&again, now, index_));
    assert_int_equal(again.open, 2);
    assert_int_equal(again.point[0].replicas, 25);
    assert_int_equal(rows_of(0), 25);
}

/* Each quantity is its own column: fragments 5, size 0.01, dissipated 1 in the mean. */
static void a_rule_looks_at_its_quantity(void **state)
{
    static const char *const quantity[] = {"mean-count", "mean-size", "dissipated"};
    static const double mean[] = {5, 0.01, 1};
    commit(0, 0, 7, 0.05, FRACAS_FRAGMENTED);
    for (int q = 0; q < 3; q++) {
        char text[200];
        FRACAS_CLEARED(fracas_rounds) again;
        snprintf(text, sizeof text,
                 "{minimum: 8, maximum: 24, until: {quantity: %s, relative-half-width: 0.2}}",
                 quantity[q]);
        OWN(fracas_campaign) now = make(text);
        OK(fracas_rounds_init(&again, now, index_));
        look(0, 1);
        assert_int_equal(decision[0].quantity, q);
        assert_true(fabs(decision[0].mean / mean[q] - 1) < 1e-15);
    }
}

/* All values 0, as of what is dissipated where nothing breaks: known exactly; of no value nothing
 * is known. */
static void a_mean_of_nothing_is_known(void **state)
{
    commit(0, 0, 7, 0.05, FRACAS_INTACT);
    sql("UPDATE realization SET dissipated = 0 WHERE point = 1");
    commit(1, 0, 7, 0.05, FRACAS_ENERGY_DRIFT);
    for (size_t p = 0; p < 2; p++) OK(fracas_rounds_advance(&rounds, index_, p));
    look(0, 1);
    assert_int_equal(decision[0].stop, FRACAS_PRECISE);
    assert_true(fracas_decision_relative(&decision[0]) == 0);
    look(1, 1);
    assert_int_equal(decision[0].stop, FRACAS_GO_ON);
    assert_true(isnan(fracas_decision_relative(&decision[0])));
    const fracas_decision negative = {.mean = -4, .half_width = 1};
    assert_true(fracas_decision_relative(&negative) == 0.25);
    sql("CREATE TABLE said(n INTEGER CHECK (n = 1))");
    sql("INSERT INTO said SELECT count(*) FROM decision WHERE relative = 0 AND reason LIKE '% "
        "0 +- 0, 0 % of it%'");
}

/* All points of a segment in one transaction: a decision that cannot be kept takes the others with
 * it. */
static void points_of_a_segment_are_decided_together(void **state)
{
    const fracas_segment_row heard[] = {{.point = campaign->point[0].hash},
                                        {.point = campaign->point[0].hash, .replica = 1},
                                        {.point = campaign->point[1].hash}};
    commit(0, 0, 7, 0.05, FRACAS_FRAGMENTED);
    commit(1, 0, 7, 0.5, FRACAS_FRAGMENTED);
    sql("CREATE TRIGGER refuse BEFORE INSERT ON decision WHEN NEW.point = 2 BEGIN SELECT "
        "raise(ABORT, 'no'); END");
    assert_int_not_equal(fracas_rounds_commit(&rounds, index_, heard, 3), FRACAS_OK);
    assert_true(sqlite3_get_autocommit(index_->db));
    look(0, 0);
    sql("DROP TRIGGER refuse");
    FRACAS_CLEARED(fracas_rounds) again;
    OK(fracas_rounds_init(&again, campaign, index_));
    look(0, 1);
    assert_int_equal(again.point[1].replicas, 16);
    commit(1, 8, 15, 0.5, FRACAS_FRAGMENTED);
    OK(fracas_rounds_commit(&again, index_, heard, 3)); /* the first point has stopped */
    look(1, 2);
    assert_int_equal(again.point[0].replicas, 8);
    assert_int_equal(again.point[1].replicas, 24);
}

TESTS_EACH(begin, end, rounds_go_on_until_they_are_narrow, what_failed_does_not_count,
           rounds_that_are_there_already_are_decided_at_once,
           a_decision_that_does_not_follow_is_damage, a_stronger_rule_decides_again,
           a_rule_that_differs_anywhere_decides_anew, mean_size_by_hand, a_larger_maximum_goes_on,
           a_rule_looks_at_its_quantity, a_mean_of_nothing_is_known,
           points_of_a_segment_are_decided_together)
