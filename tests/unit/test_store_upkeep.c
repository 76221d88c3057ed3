/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looking after a study: the index anew, garbage, failures again, older formats. Two studies made
 * one: test_store_join.c. */
#include "campaigns/store/study.h"
#include "tests/support/upkeep.h"

/* ---- reindex ---- */

static void the_index_is_made_anew(void **state)
{
    commit_all_but(left_out, 3);
    fail_some();
    const fracas_index_counts before = count_all();
    sql("UPDATE segment SET provenance = '{\"host\": \"b\"}' WHERE name = 'b.h5'");
    OK(reindex());
    says("3 segments read");
    const fracas_index_counts after = count_all();
    assert_memory_equal(&after, &before, sizeof after);
    failures_are("0:5 2 signal 9;");
    assert_int_equal(number("SELECT count(*) FROM event"), 2);
    assert_int_equal(number("SELECT count(*) FROM event WHERE kind = 'reindexed'"), 1);
    assert_int_equal(
        number("SELECT attempts FROM realization WHERE reason = 'signal 6' AND status = 'planned'"),
        1);
    assert_int_equal(number("SELECT count(*) FROM segment WHERE provenance LIKE '%\"b\"%'"), 1);
    assert_int_equal(number("SELECT count(*) FROM segment WHERE provenance LIKE '%\"a\"%'"), 2);
    assert_int_equal(sample_files(study, "before"), 0);
    assert_int_equal(sample_files(study, "reindex"), 0);
    verify_finds(0, "");
}

/* A lost one, and one that is no index: with its log, which must not come back. */
static void a_lost_or_damaged_index_is_made_anew(void **state)
{
    commit_all_but(left_out, 3);
    fail_some();
    fracas_index_counts before = count_all();
    OK(reindex());
    for (int damage = 0; damage < 4; damage++) {
        fracas_index_close(index_);
        index_ = NULL;
        char path[512];
        snprintf(path, sizeof path, "%s/index.sqlite", study);
        if (damage == 0) assert_int_equal(unlink(path), 0);
        if (damage == 1) write_bytes(path, "no database, but long enough to be looked at", 44);
        if (damage == 2) assert_int_equal(truncate(path, 5000), 0);
        if (damage == 3)
            for (size_t at = 4100; at < 4700; at += 3) flip_byte(path, at);
        if (damage == 1)
            write_bytes(sample_path(study, "index.sqlite-wal"), "a log of nothing", 16);
        OK(reindex());
        const fracas_index_counts after = count_all();
        assert_int_equal(after.done, before.done);
        assert_int_equal(after.planned, before.planned + 1);
        failures_are("");
        /* with the log of the second, and its -shm */
        assert_int_equal(sample_files(study, "index.sqlite.before"), damage ? damage + 2 : 0);
        if (damage) says("cannot be used");
        verify_finds(0, "");
    }
}

/* The process that wrote it was killed: what it committed is in the log. */
static void a_log_that_was_left_is_read(void **state)
{
    fracas_index_close(index_);
    index_ = NULL;
    pid_t child = fork();
    if (child == 0) {
        OK(fracas_index_open(study, true, &index_));
        OK(fracas_index_fail(index_, &point_row[0].hash, 5, "signal 9", true));
        kill(getpid(), SIGKILL);
    }
    waitpid(child, NULL, 0);
    struct stat info;
    assert_int_equal(stat(sample_path(study, "index.sqlite-wal"), &info), 0);
    assert_true(info.st_size > 0);
    OK(reindex());
    failures_are("0:5 1 signal 9;");
    assert_int_equal(sample_files(study, "before"), 0);
    verify_finds(0, "");
}

/* A done realization wins over the failure that the old index has of it. */
static void a_segment_wins_over_a_failure(void **state)
{
    sample_realization what[] = {{0, 5}, {1, 7}};
    fracas_file_seal seal;
    fracas_segment_row row[2];
    FRACAS_CLEARED(fracas_record) record;
    sample_segment(study, "a.h5", &table, what, 2, MOST, &seal, row);
    sample_record(0, 5, MOST, &record);
    assert_int_not_equal(record.outcome, FRACAS_FAILED);
    OK(fracas_index_fail(index_, &point_row[0].hash, 5, "signal 9", true));
    OK(reindex());
    failures_are("");
    assert_int_equal(
        number("SELECT count(*) FROM realization WHERE status = 'done' AND reason = 'signal 9'"),
        1);
    verify_finds(0, "");
}

static void segments_of_another_study_are_named(void **state)
{
    commit_all_but(left_out, 3);
    fracas_file_header other = sample_header();
    other.seed++;
    fracas_index_close(index_);
    index_ = NULL;
    said_text[0] = '\0';
    OK(fracas_study_reindex(study, &other, &table, &said));
    says("a.h5, which is not of this study: seed");
    says("not of this study: seed"); /* the index, too */
    says("0 segments read");
    assert_int_equal(sample_files(sample_path(study, "segments"), ".h5"), 3);
    OK(reindex());
    says("3 segments read");
    assert_int_equal(count_all().planned, 3);
}

/* ---- older formats ---- */

/* As a file of format version 1 begins: nothing else of it is looked at. */
static void make_old(const char *path)
{
    const int32_t one = 1;
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT),
          attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT32, &one) >= 0);
    H5Aclose(attribute);
    H5Fclose(file);
}

static const char refusal[] = "has format version 1; this program reads 6: use the program version "
                              "that wrote it, or compute the study again in another folder";

static void version_1_is_refused_by_name(void **state)
{
    commit_all_but(NULL, 0);
    merge();
    make_old(sample_path(study, "segments/a.h5"));
    make_old(sample_path(study, "segments/b.h5"));
    OK(reindex()); /* some are ours: those go on */
    says("segments/a.h5, which has format version 1, not 6; move it away");
    says("1 segments read");
    assert_int_equal(count_all().planned, 60);
    make_old(sample_path(study, "segments/c.h5"));
    FAILS(reindex(), FRACAS_DAMAGED, refusal);
    assert_has(fracas_message(), "/segments/");
    assert_int_equal(sample_files(sample_path(study, "segments"), ".h5"), 3);
    assert_int_equal(sample_files(study, "before"), 0);
    fracas_reader *reader;
    make_old(sample_path(study, "study.h5"));
    FAILS(fracas_reader_open(sample_path(study, "study.h5"), &reader), FRACAS_DAMAGED, refusal);
    OK(fracas_index_open(study, true, &index_));
    sql("UPDATE meta SET value = '1' WHERE key = 'format_version'");
    fracas_index_close(index_);
    fracas_index *other;
    char text[8192] = "";
    int64_t problems;
    FAILS(fracas_index_open(study, false, &other), FRACAS_DAMAGED, refusal);
    FAILS(fracas_index_open(study, true, &other), FRACAS_DAMAGED, refusal);
    OK(fracas_study_verify(study, &(fracas_verify_options){.say = keep_problem, .context = text},
                           &problems));
    assert_int_equal(problems, 1);
    assert_has(text, refusal);
    FAILS(fracas_study_reindex(study, &(fracas_file_header){.version = "0.1.0"}, &table, &said),
          FRACAS_DAMAGED, refusal);
    index_ = NULL;
}

static void an_index_without_a_column_is_made_anew(void **state)
{
    commit_all_but(left_out, 3);
    const fracas_index_counts before = count_all();
    sql("ALTER TABLE realization DROP COLUMN size");
    fracas_index_close(index_);
    FAILS(fracas_index_open(study, false, &index_), FRACAS_DAMAGED, "fracas reindex");
    OK(reindex());
    const fracas_index_counts after = count_all();
    assert_memory_equal(&after, &before, sizeof after);
    assert_true(number("SELECT count(*) FROM realization WHERE size IS NOT NULL") > 0);
    verify_finds(0, "");
}

/* ---- retry ---- */

static void failures_are_forgotten(void **state)
{
    int64_t rows;
    fail_some();
    OK(fracas_index_fail(index_, &point_row[1].hash, 20, "signal 7", true));
    for (int64_t round = 0; round < 3; round++)
        decide(1, round, 10 + 8 * round); /* of 10, 18 and 26 replicas */
    decide(0, 0, 5);
    OK(fracas_index_retry(index_, &point_row[2].hash, &rows));
    assert_int_equal(rows, 0);
    assert_int_equal(number("SELECT count(*) FROM event WHERE kind = 'retried'"), 0);
    OK(fracas_index_retry(index_, &point_row[1].hash, &rows));
    assert_int_equal(rows, 1);
    failures_are("0:5 2 signal 9;");
    assert_int_equal(number("SELECT count(*) FROM decision"),
                     3); /* not the one that had replica 20 */
    OK(fracas_index_retry(index_, NULL, &rows));
    assert_int_equal(rows, 1);
    failures_are("");
    assert_int_equal(number("SELECT count(*) FROM decision"),
                     3); /* the one of replicas 0 to 4 had not replica 5 */
    assert_int_equal(number("SELECT sum(attempts) FROM realization"),
                     1); /* of one that is not failed */
    assert_int_equal(number("SELECT count(*) FROM event WHERE kind = 'retried'"), 2);
    assert_int_equal(count_all().planned, ALL);
    assert_int_equal(count_all().outcome[FRACAS_FAILED], 0);
}

/* ---- gc ---- */

static char found_text[8192];

static void keep_found(void *context, const fracas_collected *item)
{
    char line[1024];
    snprintf(line, sizeof line, "%s %s %d", item->removed ? "-" : "=", strrchr(item->path, '/') + 1,
             (int)item->bytes);
    keep_problem(found_text, line);
}

static uint64_t collect(bool dry)
{
    static const char *const named[] = {"00000000000000000000000000000001"};
    uint64_t freed;
    found_text[0] = '\0';
    OK(fracas_study_collect(study, index_,
                            &(fracas_collect_options){named, 1, dry, keep_found, NULL}, &freed));
    return freed;
}

static void found(const char *part)
{
    assert_has(found_text, part);
}

static int64_t entries(void)
{
    char command[600], text[32] = "";
    snprintf(command, sizeof command, "find %s | wc -l", study);
    FILE *in = popen(command, "r");
    assert_non_null(fgets(text, sizeof text, in));
    pclose(in);
    return atoi(text);
}

/* Replicas of point 0 that are done in every study that has them: a record of outcome FAILED gives
 * way to any other. */
static void choose_done(sample_realization *what, size_t count)
{
    int64_t replica = 6;
    for (size_t i = 0; i < count; replica++) {
        FRACAS_CLEARED(fracas_record) record;
        sample_record(0, replica, MOST, &record);
        if (record.outcome != FRACAS_FAILED) what[i++] = (sample_realization){0, replica};
    }
}

static void what_nobody_needs_goes(void **state)
{
    sample_realization twice[3];
    choose_done(twice, 3);
    commit_all_but(left_out, 3);
    commit_segment("late.h5", twice, 3); /* all done already */
    fracas_file_seal seal;
    fracas_segment_row row[3];
    sample_segment(study, "orphan.h5", &table, twice, 3, MOST, &seal, row);
    assert_int_equal(mkdir(sample_path(study, "attachments"), 0777) |
                         mkdir(sample_path(study, ".reindex"), 0777),
                     0);
    static const char *const spilt[] = {"segments/.x.h5.tmp-12",
                                        "segments/old.damaged",
                                        ".study.h5.tmp-9",
                                        "campaign.yaml.tmp",
                                        "index.sqlite.before-20260101T000000Z-7",
                                        "index.sqlite.before-20260101T000000.000000007-wal",
                                        ".reindex/index.sqlite",
                                        ".reindex/index.sqlite-wal",
                                        "attachments/00000000000000000000000000000002",
                                        "attachments/00000000000000000000000000000002.tmp",
                                        "attachments/00000000000000000000000000000001",
                                        "attachments/readme",
                                        "notes.txt",
                                        "campaign.yaml",
                                        "segments/mine.txt",
                                        "lock",
                                        "study.h5"};
    for (size_t i = 0; i < FRACAS_COUNT(spilt); i++)
        write_bytes(sample_path(study, spilt[i]), "1234567", 7);
    const fracas_index_counts before = count_all();
    const int64_t all = entries();
    const uint64_t promised = collect(true);
    assert_int_equal(entries(), all);
    assert_int_equal(count_all().segments, before.segments);
    found("- late.h5");
    const uint64_t freed = collect(false);
    assert_true(freed >= 9 * 7 && promised >= 9 * 7);
    found("- late.h5");
    found("- .x.h5.tmp-12 7");
    found("- old.damaged 7");
    found("- 00000000000000000000000000000002 7");
    found("- 00000000000000000000000000000002.tmp 7");
    found("- .reindex 0");
    found("= orphan.h5");
    found("= notes.txt 7");
    found("= mine.txt 7");
    found("= readme 7");
    assert_null(strstr(found_text, " a.h5"));
    assert_int_equal(all - entries(), 12);
    fracas_index_counts after = count_all();
    assert_int_equal(after.segments, before.segments - 1);
    after.segments = before.segments, after.bytes = before.bytes;
    assert_memory_equal(&after, &before, sizeof after);
    found_text[0] = '\0';
    assert_int_equal(collect(false), 0);
    assert_null(strstr(found_text, "- "));
    unlink(sample_path(study, "study.h5"));
    verify_finds(0, "");
}

/* Killed after the index has forgotten a segment and before its file went: it is an orphan like
 * others, and goes the next time. */
static void a_forgotten_segment_is_known_again(void **state)
{
    sample_realization twice[1];
    choose_done(twice, 1);
    commit_all_but(left_out, 3);
    commit_segment("late.h5", twice, 1);
    sql("DELETE FROM segment WHERE name = 'late.h5'");
    verify_finds(0, "");
    collect(false);
    found("= late.h5");
    recover_says("adopted");
    collect(false);
    found("- late.h5");
    assert_int_equal(count_all().segments, 3);
}

/* Pages that nobody uses any more. */
static void the_index_gives_pages_back(void **state)
{
    struct stat large, small;
    sql("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 20000) INSERT "
        "INTO event(time, kind, text) SELECT 'now', 'kind', 'a text of some length, again and "
        "again' FROM n; DELETE FROM event");
    open_again();
    assert_int_equal(stat(sample_path(study, "index.sqlite"), &large), 0);
    const uint64_t promised = collect(true), freed = collect(false);
    found("- index.sqlite");
    open_again();
    assert_int_equal(stat(sample_path(study, "index.sqlite"), &small), 0);
    assert_true(small.st_size < large.st_size / 4);
    assert_true(freed >= (uint64_t)(large.st_size - small.st_size) && promised > freed / 2);
}

TESTS_EACH(set_up, tear_down, the_index_is_made_anew, a_lost_or_damaged_index_is_made_anew,
           a_log_that_was_left_is_read, a_segment_wins_over_a_failure,
           segments_of_another_study_are_named, version_1_is_refused_by_name,
           an_index_without_a_column_is_made_anew, failures_are_forgotten, what_nobody_needs_goes,
           a_forgotten_segment_is_known_again, the_index_gives_pages_back)
