/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two studies of one campaign made one. */
#include "tests/support/upkeep.h"

static char *other_study;
static fracas_index *other_index;

/* A second study, with `commit` done to it instead of the first. */
static void in_other(void (*commit)(void))
{
    char *kept = study;
    fracas_index *kept_index = index_;
    set_up(NULL);
    commit();
    other_study = study;
    other_index = index_;
    study = kept;
    index_ = kept_index;
}

static void leave_other(void)
{
    fracas_index_close(other_index);
    sample_remove(other_study);
}

static void commit_part(int part, const char *name)
{
    sample_realization what[ALL];
    size_t n = 0;
    for (size_t i = 0; i < ALL; i++)
        if ((int)(i % 2) == part)
            what[n++] = (sample_realization){i / REPLICAS, (int64_t)(i % REPLICAS)};
    commit_segment(name, what, n / 2);
    char second[32];
    snprintf(second, sizeof second, "x%s", name);
    commit_segment(second, what + n / 2, n - n / 2);
}

static void commit_odd(void)
{
    commit_part(1, "b.h5");
}

static fracas_err compare(int64_t *both)
{
    fracas_file_header header = sample_header();
    return fracas_study_compare(study, index_, other_study, other_index, &header, &table, both);
}

static void two_halves_are_one_study(void **state)
{
    fracas_joined joined;
    int64_t both;
    commit_everything(0); /* what it must come to */
    merge();
    assert_int_equal(rename(sample_path(study, "study.h5"), sample_path(study, "whole")), 0);
    fracas_index_close(index_);
    unlink(sample_path(study, "index.sqlite"));
    unlink(sample_path(study, "segments/s0.h5"));
    OK(fracas_index_open(study, true, &index_));
    OK(fracas_index_plan(index_, &table));
    commit_part(0, "b.h5"); /* of the same name as the other's */
    in_other(commit_odd);
    OK(compare(&both));
    assert_int_equal(both, 0);
    OK(fracas_study_join(study, index_, other_study, other_index, &table, &joined));
    assert_int_equal(joined.realizations, ALL / 2);
    assert_int_equal(joined.segments, 2);
    assert_int_equal(count_all().planned, 0);
    assert_int_equal(sample_files(sample_path(study, "segments"), ".h5"), 4);
    OK(fracas_study_join(study, index_, other_study, other_index, &table,
                         &joined)); /* again: nothing is new */
    assert_int_equal(joined.realizations + joined.segments + joined.failed, 0);
    OK(compare(&both));
    assert_true(both > ALL / 3); /* but those of outcome FAILED */
    merge();
    assert_true(sample_same_file(sample_path(study, "study.h5"), sample_path(study, "whole")));
    verify_finds(0, "");
    assert_int_equal(number("SELECT count(*) FROM event WHERE kind = 'joined'"), 1);
    leave_other();
}

/* The same realizations, but one that is not the same. */
static void commit_different(void)
{
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    fracas_segment_row row[10];
    OK(fracas_writer_create(sample_path(study, "segments/d.h5"), &header, &table, &writer));
    for (int64_t r = 0; r < 10; r++) {
        FRACAS_CLEARED(fracas_record) record;
        sample_record(1, r, MOST, &record);
        if (r == 3) record.momentum[1] = 0.125;
        row[r] = (fracas_segment_row){point_row[1].hash, r, r, fracas_summary_of(&record)};
        OK(fracas_writer_append(writer, 1, r, &record));
    }
    OK(fracas_writer_finish(writer, false, &seal));
    OK(fracas_index_commit(index_, "d.h5", &seal, row, 10, "{}"));
}

static void a_difference_is_named(void **state)
{
    int64_t both;
    commit_all_but(left_out, 3);
    in_other(commit_different);
    FAILS(compare(&both), FRACAS_DAMAGED, "replica 3 of point 1 (");
    assert_has(fracas_message(), other_study);
    flip_byte(sample_path(other_study, "segments/d.h5"), 30000);
    FAILS(compare(&both), FRACAS_DAMAGED, "d.h5: damaged");
    leave_other();
}

static void commit_and_fail(void)
{
    sample_realization what[] = {{0, 5}, {0, 6}};
    commit_segment("e.h5", what, 2);
    OK(fracas_index_fail(index_, &point_row[1].hash, 7, "theirs", true));
    OK(fracas_index_fail(index_, &point_row[2].hash, 39, "theirs", true));
    OK(fracas_index_fail(index_, &point_row[0].hash, 1, "theirs", true));
}

static void done_wins_over_failed(void **state)
{
    fracas_joined joined;
    commit_all_but(left_out, 3);
    OK(fracas_index_fail(index_, &point_row[0].hash, 5, "ours", true));
    OK(fracas_index_fail(index_, &point_row[1].hash, 7, "ours", true));
    decide(0, 0, 5);
    decide(0, 1, 6);
    OK(fracas_index_seal_study(index_, &(fracas_file_seal){1, 2}));
    in_other(commit_and_fail);
    OK(fracas_study_join(study, index_, other_study, other_index, &table, &joined));
    assert_int_equal(joined.realizations, 1);
    assert_int_equal(joined.failed, 1);
    failures_are("1:7 1 ours;2:39 1 theirs;");
    assert_int_equal(number("SELECT count(*) FROM decision"), 1); /* not the one with replica 5 */
    fracas_file_seal seal;
    bool sealed;
    OK(fracas_index_study_seal(index_, &sealed, &seal)); /* study.h5 has it as failed */
    assert_false(sealed);
    assert_int_equal(count_all().planned, 0);
    leave_other();
}

TESTS_EACH(set_up, tear_down, two_halves_are_one_study, a_difference_is_named,
           done_wins_over_failed)
