/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The results of a study: study.h5 or segments, whichever is of everything; the same records from
 * both. */
#include "tests/support/study_fixture.h"

#include "campaigns/store/results.h"
#include "campaigns/store/upkeep.h"

static fracas_results *open_results(const fracas_point_table *of)
{
    fracas_results *results;
    const fracas_file_header header = sample_header();
    OK(fracas_results_open(study, &header.campaign, of, &results));
    return results;
}

/* ---- a walk that knows what it must meet ---- */

typedef struct {
    fracas_results *results;
    const fracas_point_table *table;
    unsigned parts;
    size_t count, next; /* visited; the least row that may follow */
    size_t shift;       /* our point p is that of sample_record(p - shift) */
} walk;

static void cut(fracas_record *record, unsigned parts)
{
    if (!(parts & FRACAS_READ_FRAGMENTS))
        free(record->fragment), record->fragment = NULL, record->nfragment = 0;
    if (!(parts & FRACAS_READ_HISTORY))
        free(record->history), record->history = NULL, record->nhistory = 0;
    if (!(parts & FRACAS_READ_INTERFACES))
        free(record->interface), record->interface = NULL, record->ninterface = 0;
}

static void check_record(const walk *w, size_t point, int64_t replica, const fracas_record *record)
{
    FRACAS_CLEARED(fracas_record) wanted;
    sample_record(point - w->shift, replica, MOST, &wanted);
    sample_make_canonical(&wanted);
    cut(&wanted, w->parts);
    assert_true(sample_equal(record, &wanted));
}

static fracas_err look(void *context, fracas_result *result)
{
    walk *w = context;
    assert_true(result->row >= w->next && result->row < fracas_results_realizations(w->results));
    assert_true(result->point < w->table->npoints);
    w->next = result->row + 1;
    w->count++;
    check_record(w, result->point, result->replica, &result->record);
    return FRACAS_OK;
}

static size_t walk_all(fracas_results *results, const fracas_point_table *of, unsigned parts,
                       size_t shift)
{
    walk w = {.results = results, .table = of, .parts = parts, .shift = shift};
    OK(fracas_results_walk(results, parts, look, &w));
    return w.count;
}

static int64_t missing_of(const fracas_results *results)
{
    int64_t missing = 0;
    for (size_t p = 0; p < fracas_results_points(results)->npoints; p++)
        missing += fracas_results_missing(results, p);
    return missing;
}

/* ---- which of the two ---- */

static void every_order_of_segments_gives_the_records_of_the_study(void **state)
{
    commit_everything(3);
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    for (int merged = 0; merged < 2; merged++) {
        if (merged) merge();
        fracas_results *results = open_results(&table);
        assert_int_equal(fracas_results_partial(results), !merged);
        assert_int_equal(fracas_results_realizations(results), ALL);
        assert_memory_equal(&fracas_results_header(results)->campaign, &header.campaign,
                            sizeof header.campaign);
        assert_int_equal(fracas_results_header(results)->seed, header.seed);
        assert_int_equal(fracas_results_header(results)->history, header.history);
        assert_true(fracas_results_header(results)->interfaces);
        assert_string_equal(fracas_results_header(results)->version, header.version);
        for (unsigned parts = 0; parts <= FRACAS_READ_ALL; parts++)
            assert_int_equal(walk_all(results, &table, parts, 0), ALL);
        for (size_t row = ALL; row-- > 0;) { /* against the order */
            walk w = {.parts = FRACAS_READ_ALL};
            fracas_record record;
            size_t point;
            int64_t replica;
            fracas_record_init(&record);
            OK(fracas_results_record(results, row, FRACAS_READ_ALL, &point, &replica, &record));
            assert_int_equal(point * REPLICAS + (size_t)replica, row);
            check_record(&w, point, replica, &record);
            fracas_record_clear(&record);
        }
        assert_int_equal(fracas_results_notes(results), 0);
        fracas_results_close(results);
    }
}

static void a_merged_study_counts_while_it_is_of_everything(void **state)
{
    fracas_results *results;
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    commit_everything(0);
    merge();
    OK(fracas_index_seal_study(index_, NULL)); /* a merge that was killed */
    results = open_results(&table);
    assert_true(fracas_results_partial(results));
    fracas_results_close(results);
    merge();
    int64_t again;
    OK(fracas_index_retry(index_, NULL,
                          &again)); /* study.h5 has those that FAILED, the index plans them */
    assert_true(again > 0);
    results = open_results(&table);
    assert_true(fracas_results_partial(results));
    assert_int_equal(walk_all(results, &table, FRACAS_READ_ALL, 0), ALL - (size_t)again);
    fracas_results_close(results);
    compute_planned("again.h5");
    merge();
    table = sample_table(point_row, REPLICAS + 1); /* extended by a replica */
    OK(fracas_index_plan(index_, &table));
    results = open_results(&table);
    assert_true(fracas_results_partial(results));
    assert_int_equal(walk_all(results, &table, FRACAS_READ_ALL, 0), ALL);
    assert_int_equal(fracas_results_points(results)->point[0].replicas, REPLICAS + 1);
    fracas_results_close(results);
    OK(fracas_results_open(study, NULL, NULL, &results)); /* as it is */
    assert_false(fracas_results_partial(results));
    fracas_results_close(results);
}

static void points_are_those_of_the_campaign(void **state)
{
    fracas_point_row more[SAMPLE_POINTS + 1];
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    commit_everything(5);
    memcpy(more + 1, point_row,
           sizeof point_row); /* a new point before those that the segments know */
    more[0] = (fracas_point_row){fracas_hash_of("new", 3), 2, sample_value[0]};
    const fracas_point_table extended = {3, sample_column, SAMPLE_POINTS + 1, more};
    for (int planned = 0; planned < 2; planned++) { /* killed before the index had it, and after */
        if (planned) OK(fracas_index_plan(index_, &extended));
        fracas_results *results = open_results(&extended);
        assert_true(fracas_results_partial(results));
        assert_int_equal(fracas_results_points(results)->npoints, SAMPLE_POINTS + 1);
        assert_int_equal(walk_all(results, &extended, FRACAS_READ_ALL, 1), ALL);
        fracas_results_close(results);
    }
}

/* ---- what is lost ---- */

static void lost_segments_are_named_once_and_left_out(void **state)
{
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    commit_everything(7);
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    OK(fracas_index_segments_by_id(index_, &known));
    assert_true(known.count > 4);
    assert_int_equal(unlink(sample_path(study, "segments/s1.h5")), 0);
    flip_byte(sample_path(study, "segments/s3.h5"), 3000);
    int64_t lost = 0;
    fracas_row_place place;
    for (size_t i = 0; i < ALL; i++) { /* what failed needs no segment */
        OK(fracas_index_place(index_, &table.point[i / REPLICAS].hash, (int64_t)(i % REPLICAS),
                              &place));
        for (size_t s = 1; s <= 3; s += 2)
            lost += place.status == FRACAS_DONE && place.segment == known.segment[s].id;
    }
    assert_true(lost > 2);
    fracas_results *results = open_results(&table);
    for (int again = 0; again < 2; again++) {
        assert_int_equal(walk_all(results, &table, FRACAS_READ_FRAGMENTS, 0), ALL - (size_t)lost);
        assert_int_equal(missing_of(results), lost);
        assert_int_equal(fracas_results_notes(results), 2);
    }
    const char *one = fracas_results_note(results, 0), *two = fracas_results_note(results, 1);
    assert_has(one, "segment s1.h5 is left out (`fracas verify` checks the study)");
    assert_has(one, "s1.h5 is not there");
    assert_has(two, "segment s3.h5 is left out");
    assert_has(two, "the index says");
    fracas_results_close(results);
}

static void without_an_index_study_h5_must_be_of_the_campaign(void **state)
{
    fracas_results *results;
    fracas_hash other = fracas_hash_of("other", 5);
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    commit_everything(0);
    merge();
    fracas_index_close(index_);
    index_ = NULL;
    assert_int_equal(unlink(sample_path(study, "index.sqlite")), 0);
    results = open_results(&table);
    assert_false(fracas_results_partial(results));
    assert_int_equal(fracas_results_notes(results), 1);
    assert_has(fracas_results_note(results, 0), "study.h5 is taken as it is");
    fracas_results_close(results);
    FAILS(fracas_results_open(study, &other, &table, &results), FRACAS_DAMAGED,
          "is of another campaign than");
    assert_has(fracas_message(), "fracas reindex");
    assert_int_equal(unlink(sample_path(study, "study.h5")), 0);
    FAILS(fracas_results_open(study, &header.campaign, &table, &results), FRACAS_DAMAGED,
          "and there is no");
    FAILS(fracas_results_open(study, NULL, NULL, &results), FRACAS_DAMAGED,
          "`fracas run` makes it");
}

static void nothing_done_is_said(void **state)
{
    fracas_results *results;
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    FAILS(fracas_results_open(study, &header.campaign, &table, &results), FRACAS_INTERRUPTED,
          "of 120: there is nothing to report");
    OK(fracas_index_fail(index_, &table.point[0].hash, 0, "crashed",
                         true)); /* a FAILED one is a result */
    results = open_results(&table);
    assert_int_equal(fracas_results_realizations(results), 1);
    fracas_record record;
    size_t point;
    int64_t replica;
    fracas_record_init(&record);
    OK(fracas_results_record(results, 0, FRACAS_READ_ALL, &point, &replica, &record));
    assert_int_equal(record.outcome, FRACAS_FAILED);
    assert_true(isnan(record.dissipated));
    fracas_results_close(results);
}

static void an_index_that_is_held_is_named(void **state)
{
    fracas_results *results;
    fracas_index *holder;
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    fracas_index_close(index_);
    index_ = NULL;
    OK(fracas_index_open_as(study, true, false, &holder)); /* as on a network filesystem */
    OK(fracas_index_plan(holder, &table));
    FAILS(fracas_results_open(study, &header.campaign, &table, &results), FRACAS_IN_USE,
          "on a network filesystem nobody else can");
    fracas_index_close(holder);
}

TESTS_EACH(set_up, tear_down, every_order_of_segments_gives_the_records_of_the_study,
           a_merged_study_counts_while_it_is_of_everything, points_are_those_of_the_campaign,
           lost_segments_are_named_once_and_left_out,
           without_an_index_study_h5_must_be_of_the_campaign, nothing_done_is_said,
           an_index_that_is_held_is_named)
