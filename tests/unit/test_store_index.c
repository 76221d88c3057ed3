/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The index: plan, lease, commit, its modes and its file. */
#include "campaigns/store/study.h"
#include "tests/support/study_fixture.h"

/* ---- planning and rows ---- */

static void plan_is_in_order_and_grows(void **state)
{
    fracas_index_row *row;
    size_t count;
    OK(fracas_index_rows(index_, &table, &row, &count));
    assert_int_equal(count, ALL);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(row[i].point, i / REPLICAS);
        assert_int_equal(row[i].replica, i % REPLICAS);
        assert_int_equal(row[i].status, FRACAS_PLANNED);
        assert_int_equal(row[i].attempts, 0);
    }
    free(row);
    point_row[1].replicas = REPLICAS + 2;
    FAILS(fracas_index_rows(index_, &table, &row, &count), FRACAS_DAMAGED, "replica 40 of point 1");
    OK(fracas_index_plan(index_, &table));
    OK(fracas_index_rows(index_, &table, &row, &count));
    assert_int_equal(count, ALL + 2);
    assert_int_equal(row[REPLICAS * 2 + 1].replica, REPLICAS + 1);
    free(row);
    fracas_point_table one = table;
    one.npoints = 1; /* a point that is not in the table any more stays */
    OK(fracas_index_plan(index_, &one));
    assert_int_equal(count_all().realizations, ALL + 2);
    fracas_index_counts counts, point[2];
    fracas_point_row some[2] = {point_row[1], point_row[0]}; /* whatever their order and number */
    one = (fracas_point_table){.npoints = 2, .point = some};
    OK(fracas_index_count_points(index_, &one, &counts, point));
    assert_int_equal(counts.realizations, ALL + 2);
    assert_int_equal(point[0].realizations, REPLICAS + 2);
    assert_int_equal(point[0].planned, REPLICAS + 2);
    assert_int_equal(point[1].realizations, REPLICAS);
    some[1].hash = fracas_hash_of("unknown", 7);
    FAILS(fracas_index_count_points(index_, &one, &counts, point), FRACAS_DAMAGED, "has no point");
}

static void note_failure(void *said, const fracas_index_row *row, const char *reason)
{
    size_t used = strlen(said);
    snprintf((char *)said + used, 100 - used, "point %zu replica %d attempts %d: %s;", row->point,
             (int)row->replica, (int)row->attempts, reason);
}

static void leases_end_with_the_next_plan(void **state)
{
    OK(fracas_index_lease(index_, &point_row[2].hash, 5, 10));
    assert_int_equal(count_all().leased, 10);
    OK(fracas_index_fail(index_, &point_row[2].hash, 6, "signal 11", false));
    OK(fracas_index_fail(index_, &point_row[2].hash, 7, "signal 9", true));
    fracas_index_counts counts = count_all();
    assert_int_equal(counts.leased, 8);
    assert_int_equal(counts.failed, 1);
    assert_int_equal(counts.outcome[FRACAS_FAILED], 1);
    OK(fracas_index_plan(index_, &table));
    counts = count_all();
    assert_int_equal(counts.leased, 0);
    assert_int_equal(counts.planned, ALL - 1);
    OWNED fracas_index_row *row;
    size_t count;
    OK(fracas_index_rows(index_, &table, &row, &count));
    assert_int_equal(row[2 * REPLICAS + 6].attempts, 1);
    assert_int_equal(row[2 * REPLICAS + 6].status, FRACAS_PLANNED);
    assert_int_equal(row[2 * REPLICAS + 7].status, FRACAS_FAILED_ROW);
    char said[100] = "";
    OK(fracas_index_failures(index_, &table, note_failure, said));
    assert_string_equal(said, "point 2 replica 7 attempts 1: signal 9;");
}

static void first_commit_stays(void **state)
{
    sample_realization what[] = {{0, 3}, {1, 1}, {0, 4}};
    fracas_segment_row row[3];
    fracas_file_seal seal;
    fracas_row_place place;
    sample_segment(study, "a.h5", &table, what, 3, MOST, &seal, row);
    row[0].summary.outcome = row[1].summary.outcome = FRACAS_INTACT;
    row[2].summary.outcome = FRACAS_FAILED;
    OK(fracas_index_commit(index_, "a.h5", &seal, row, 3, "{}"));
    fracas_index_counts counts = count_all();
    assert_int_equal(counts.done, 2);
    assert_int_equal(counts.failed, 1);
    assert_int_equal(counts.outcome[FRACAS_INTACT], 2);
    assert_int_equal(counts.segments, 1);
    assert_true(counts.bytes == (int64_t)seal.bytes);
    OK(fracas_index_commit(index_, "a.h5", &seal, row, 3, "{}")); /* again: nothing changes */
    fracas_index_counts again = count_all();
    assert_memory_equal(&again, &counts, sizeof counts);
    row[0].row = 7; /* another segment with the same realizations: those done stay where they are */
    OK(fracas_index_commit(index_, "b.h5", &seal, row, 3, "{}"));
    OK(fracas_index_place(index_, &point_row[0].hash, 3, &place));
    assert_int_equal(place.row, 0);
    OK(fracas_index_fail(index_, &point_row[0].hash, 3, "late", true));
    OK(fracas_index_place(index_, &point_row[0].hash, 3, &place));
    assert_int_equal(place.status, FRACAS_DONE);
    seal.checksum++;
    FAILS(fracas_index_commit(index_, "a.h5", &seal, row, 3, "{}"), FRACAS_BUG,
          "another segment a.h5");
}

/* A commit of something unplanned leaves nothing behind. */
static void commits_are_whole(void **state)
{
    sample_realization what[] = {{0, 3}, {1, 1}};
    fracas_segment_row row[2];
    fracas_file_seal seal;
    sample_segment(study, "a.h5", &table, what, 2, MOST, &seal, row);
    row[1].replica = REPLICAS;
    FAILS(fracas_index_commit(index_, "a.h5", &seal, row, 2, "{}"), FRACAS_DAMAGED,
          "no replica 40");
    row[1].replica = 1;
    FAILS(fracas_index_commit(index_, "a.h5", &seal, row, 2, "not json"), FRACAS_BUG, "CHECK");
    fracas_index_counts counts = count_all();
    assert_int_equal(counts.done + counts.segments, 0);
    OK(fracas_index_commit(index_, "a.h5", &seal, row, 2, "{}"));
}

static const char *first_value(fracas_index *index, const char *query)
{
    static char value[64];
    sqlite3_stmt *statement;
    assert_int_equal(sqlite3_prepare_v2(index->db, query, -1, &statement, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    snprintf(value, sizeof value, "%s", (const char *)sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    return value;
}

static void index_modes_and_versions(void **state)
{
    fracas_index *other, *third;
    bool local;
    OK(fracas_disk_is_local("/proc", &local)); /* one we do not know: taken for a network */
    assert_false(local);
    FAILS(fracas_index_open(sample_path(study, "segments"), false, &other), FRACAS_DAMAGED,
          "fracas run");
    OK(fracas_index_open_as(sample_path(study, "segments"), true, false,
                            &other)); /* as on a network */
    OK(fracas_index_plan(other, &table));
    OK(fracas_index_lease(other, &point_row[0].hash, 0, 3));
    assert_string_equal(first_value(other, "PRAGMA locking_mode"), "exclusive");
    assert_string_equal(first_value(other, "PRAGMA journal_mode"), "truncate");
    assert_string_equal(first_value(other, "PRAGMA synchronous"), "2");
    assert_string_equal(first_value(index_, "PRAGMA journal_mode"), "wal");
    OK(fracas_index_lease(index_, &point_row[0].hash, 0, 3));
    assert_string_equal(first_value(index_, "PRAGMA synchronous"), "2"); /* again, after a lease */
    assert_int_equal(access(sample_path(study, "segments/index.sqlite-wal"), F_OK), -1);
    assert_int_equal(access(sample_path(study, "segments/index.sqlite-journal"), F_OK), 0);
    fracas_index_close(other);
    OK(fracas_index_open(study, false, &third)); /* two at a time on a local filesystem */
    fracas_index_close(third);
    sql("UPDATE meta SET value = '99'");
    FAILS(fracas_index_open(study, false, &other), FRACAS_DAMAGED, "format version 99");
    write_bytes(sample_path(study, "segments/index.sqlite"),
                "no database, but long enough to be looked at", 44);
    FAILS(fracas_index_open(sample_path(study, "segments"), false, &other), FRACAS_DAMAGED,
          "cannot open: damaged");
    assert_has(fracas_message(), "reindex");
}

/* ---- statements ---- */

/* Whatever a lease meets, later commits wait for the disk. */
static void a_failed_lease_leaves_commits_durable(void **state)
{
    OK(fracas_sql_script(index_, "CREATE TRIGGER no BEFORE UPDATE ON realization BEGIN SELECT "
                                 "RAISE(ABORT, 'not now'); END"));
    FAILS(fracas_index_lease(index_, &point_row[0].hash, 0, 3), FRACAS_BUG, "not now");
    assert_string_equal(first_value(index_, "PRAGMA synchronous"), "2");
}

static void statements_are_as_many_as_are_used(void **state)
{
    enum { MANY = 200 };
    static char text[MANY][32];
    for (int64_t twice = 0; twice < 2; twice++)
        for (int64_t s = 0; s < MANY; s++) {
            int64_t found;
            snprintf(text[s], sizeof text[s], "SELECT %d + ?1", (int)s);
            OK(fracas_sql_numbers(index_, text[s], SQL_VALUES(SQL_INTEGER(twice)), &found, NULL));
            assert_int_equal(found, s + twice);
        }
}

/* Its rows would begin anew, without end. */
static void a_statement_is_not_started_within_itself(void **state)
{
    static const char text[] = "SELECT replica FROM realization ORDER BY replica";
    sqlite3_stmt *outer, *inner;
    fracas_err err;
    OK(fracas_sql_start(index_, text, NULL, 0, &outer));
    assert_true(fracas_sql_next(index_, outer, &err));
    FAILS(fracas_sql_start(index_, text, NULL, 0, &inner), FRACAS_BUG, "started twice");
    assert_null(inner);
    fracas_sql_end(outer);
    OK(fracas_sql_start(index_, text, NULL, 0, &inner));
    fracas_sql_end(inner);
}

/* ---- the file of the index ---- */

static void an_index_without_tables_is_none(void **state)
{
    fracas_index *other;
    sqlite3 *db;
    assert_true(fracas_index_exists(study));
    fracas_index_close(index_);
    index_ = NULL;
    char path[512];
    snprintf(path, sizeof path, "%s/index.sqlite", study);
    for (int empty = 0; empty < 2; empty++) {
        unlink(path);
        assert_false(fracas_index_exists(study));
        write_bytes(path, "", 0);
        if (!empty) { /* as a kill between the first page and the tables leaves it */
            assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
            assert_int_equal(sqlite3_exec(db, "PRAGMA journal_mode = WAL", NULL, NULL, NULL),
                             SQLITE_OK);
            sqlite3_close(db);
            struct stat info;
            assert_int_equal(stat(path, &info), 0);
            assert_true(info.st_size > 0);
        }
        assert_false(fracas_index_exists(study));
        FAILS(fracas_index_open(study, false, &other), FRACAS_DAMAGED, "`fracas run` makes one");
        OK(fracas_index_open(study, true, &index_));
        OK(fracas_index_plan(index_, &table));
        fracas_index_close(index_);
        index_ = NULL;
        assert_true(fracas_index_exists(study));
    }
    /* Of something else: not touched, and the way out is named. */
    unlink(path);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, "CREATE TABLE letters(text)", NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
    assert_false(fracas_index_exists(study));
    FAILS(fracas_index_open(study, true, &other), FRACAS_DAMAGED, "`fracas reindex` makes it anew");
    write_bytes(path, "no database, but long enough to be looked at", 44);
    assert_false(fracas_index_exists(study));
    FAILS(fracas_index_open(study, true, &other), FRACAS_DAMAGED, "`fracas reindex` makes it anew");
}

/* Reads the study as one who may not write it; the exit status says what went wrong. */
static void look_as_another(void)
{
    fracas_index_counts counts;
    char text[8192] = "";
    int64_t problems;
    bool sealed;
    if (geteuid() == 0 && (setgid(65534) || setuid(65534))) _exit(1);
    if (access(study, W_OK) == 0) _exit(2);
    if (!fracas_index_exists(study) || fracas_index_open(study, false, &index_)) _exit(3);
    if (fracas_index_count(index_, &counts) || counts.planned || !counts.done) _exit(4);
    if (fracas_study_sealed(study, index_, &sealed) || !sealed) _exit(5);
    fracas_index *remote; /* as on a network filesystem */
    if (fracas_index_open_as(study, false, false, &remote)) _exit(9);
    fracas_index_close(remote);
    if (fracas_index_event(index_, "kind", "text") != FRACAS_ENVIRONMENT ||
        !strstr(fracas_message(), "copy it"))
        _exit(6);
    fracas_index_close(index_);
    if (fracas_study_verify(
            study, &(fracas_verify_options){.full = true, .say = keep_problem, .context = text},
            &problems) ||
        problems)
        _exit(7);
    if (fracas_index_open(study, true, &index_) != FRACAS_ENVIRONMENT ||
        !strstr(fracas_message(), "copy it"))
        _exit(8);
    _exit(0);
}

/* What no reader can read without writing, it says. */
static void look_in_vain(void)
{
    static const struct {
        const char *log; /* beside the index, or NULL: in its place */
        fracas_err err;
        const char *says;
    } wrong[] = {{"index.sqlite-wal", FRACAS_ENVIRONMENT, "copy it to where you may write"},
                 {NULL, FRACAS_DAMAGED, "fracas reindex"}};
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        assert_int_equal(chmod(study, 0777), 0);
        const char *name = wrong[w].log ? wrong[w].log : "index.sqlite";
        write_bytes(sample_path(study, name), "no database, but long enough to be looked at", 44);
        assert_int_equal(chmod(sample_path(study, name), 0444) + chmod(study, 0555), 0);
        const pid_t child = fork();
        if (child == 0) {
            if (geteuid() == 0 && (setgid(65534) || setuid(65534))) _exit(1);
            if (fracas_index_open(study, false, &index_) != wrong[w].err) _exit(2);
            if (!strstr(fracas_message(), wrong[w].says)) _exit(3);
            _exit(fracas_index_exists(study) ? 4 : 0);
        }
        int status;
        waitpid(child, &status, 0);
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), 0);
        assert_int_equal(chmod(study, 0777) + unlink(sample_path(study, name)), 0);
    }
}

static void a_study_that_cannot_be_written_can_be_read(void **state)
{
    char *plain = study, *odd = NULL;
    commit_everything(2);
    merge();
    fracas_index_close(index_);
    index_ = NULL;
    assert_true(asprintf(&odd, "%s 50%%?#", plain) >
                0); /* a name that a URI must not take for its own */
    assert_int_equal(rename(plain, odd), 0);
    study = odd;
    assert_int_equal(chmod(sample_path(odd, "index.sqlite"), 0444) + chmod(odd, 0555), 0);
    pid_t child = fork();
    if (child == 0) look_as_another();
    int status;
    waitpid(child, &status, 0);
    assert_int_equal(chmod(odd, 0777) + rename(odd, plain), 0);
    study = plain;
    free(odd);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    look_in_vain();
}

TESTS_EACH(set_up, tear_down, plan_is_in_order_and_grows, leases_end_with_the_next_plan,
           first_commit_stays, commits_are_whole, index_modes_and_versions,
           a_failed_lease_leaves_commits_durable, statements_are_as_many_as_are_used,
           a_statement_is_not_started_within_itself, an_index_without_tables_is_none,
           a_study_that_cannot_be_written_can_be_read)
