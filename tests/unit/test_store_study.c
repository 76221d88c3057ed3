/* The index, and a study as a whole: plan, commit, recover, merge, verify, lock. */
#include "tests/support/store_sample.h"

#include "campaigns/store/disk.h"
#include "campaigns/store/index.h"

#include <sys/wait.h>

enum { REPLICAS = 40, ALL = SAMPLE_POINTS * REPLICAS, MOST = 30 };

static char *study;
static fracas_point_row point_row[SAMPLE_POINTS];
static fracas_point_table table;
static fracas_index *index_;

static int set_up(void **state)
{
    (void)state;
    study = sample_folder();
    table = sample_table(point_row, REPLICAS);
    assert_int_equal(mkdir(sample_path(study, "segments"), 0777), 0);
    OK(fracas_index_open(study, true, &index_));
    OK(fracas_index_plan(index_, &table));
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    fracas_index_close(index_);
    sample_remove(study);
    return 0;
}

/* ---- helpers ---- */

/* Writes and commits one segment. */
static void commit_segment(const char *name, const sample_realization *what, size_t count)
{
    fracas_file_seal seal;
    fracas_segment_row row[ALL];
    sample_segment(study, name, &table, what, count, MOST, &seal, row);
    OK(fracas_index_commit(index_, name, &seal, row, count, "{\"host\": \"a\"}"));
}

/* Every realization in an order that `seed` shuffles, in segments of a size that it chooses. */
static void commit_everything(uint64_t seed)
{
    sample_realization what[ALL];
    for (size_t i = 0; i < ALL; i++) what[i] = (sample_realization){i / REPLICAS, (int64_t)(i % REPLICAS)};
    for (size_t i = ALL; seed && i > 1; i--) {
        size_t j = sample_bits(&seed) % i;
        sample_realization other = what[j];
        what[j] = what[i - 1];
        what[i - 1] = other;
    }
    for (size_t first = 0, number = 0; first < ALL; number++) {
        size_t size = seed ? 1 + sample_bits(&seed) % 40 : ALL, rest = ALL - first;
        char name[32];
        snprintf(name, sizeof name, "s%zu.h5", number);
        if (size > rest) size = rest;
        commit_segment(name, what + first, size);
        first += size;
    }
}

static fracas_index_counts count_all(void)
{
    fracas_index_counts counts;
    OK(fracas_index_count(index_, &counts));
    return counts;
}

static void merge(void)
{
    fracas_file_header header = sample_header();
    OK(fracas_study_merge(study, index_, &header, &table));
}

static void keep_problem(void *context, const char *problem)
{
    char *text = context;
    snprintf(text + strlen(text), 8192 - strlen(text), "%s\n", problem);
}

/* The index is closed meanwhile, as for `fracas verify`. *text: the problems, one a line. */
static int64_t verify(char text[8192])
{
    int64_t problems;
    text[0] = '\0';
    fracas_index_close(index_);
    OK(fracas_study_verify(study, keep_problem, text, &problems));
    OK(fracas_index_open(study, false, &index_));
    return problems;
}

static void verify_finds(int64_t wanted, const char *part)
{
    char text[8192];
    int64_t problems = verify(text);
    if (problems != wanted || !strstr(text, part)) print_error("%lld problems:\n%s", (long long)problems, text);
    assert_int_equal(problems, wanted);
    assert_non_null(strstr(text, part));
}

/* Its report must contain `part`. */
static void recover_says(const char *part)
{
    char *report;
    fracas_file_header header = sample_header();
    OK(fracas_study_recover(study, index_, &header, &table, &report));
    if (!strstr(report, part)) print_error("the report is:\n%s", report);
    assert_non_null(strstr(report, part));
    if (!*part) assert_string_equal(report, "");
    free(report);
}

static void flip_byte(const char *path, size_t at)
{
    size_t size;
    unsigned char *bytes = sample_slurp(path, &size);
    bytes[at % size] ^= 0x10;
    sample_spill(path, bytes, size);
    free(bytes);
}

/* ---- planning and rows ---- */

static void plan_is_in_order_and_grows(void **state)
{
    (void)state;
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
    sample_fails(fracas_index_rows(index_, &table, &row, &count), FRACAS_DAMAGED, "replica 40 of point 1");
    OK(fracas_index_plan(index_, &table));
    OK(fracas_index_rows(index_, &table, &row, &count));
    assert_int_equal(count, ALL + 2);
    assert_int_equal(row[REPLICAS * 2 + 1].replica, REPLICAS + 1);
    free(row);
    fracas_point_table one = table;
    one.npoints = 1; /* a point that is not in the table any more stays */
    OK(fracas_index_plan(index_, &one));
    assert_int_equal(count_all().realizations, ALL + 2);
    fracas_index_counts counts;
    OK(fracas_index_count_point(index_, &point_row[1].hash, &counts));
    assert_int_equal(counts.realizations, REPLICAS + 2);
    fracas_hash unknown = fracas_hash_of("unknown", 7);
    sample_fails(fracas_index_count_point(index_, &unknown, &counts), FRACAS_DAMAGED, "has no point");
}

static void note_failure(void *said, const fracas_index_row *row, const char *reason)
{
    size_t used = strlen(said);
    snprintf((char *)said + used, 100 - used, "point %zu replica %d attempts %d: %s;", row->point, (int)row->replica,
             (int)row->attempts, reason);
}

static void leases_end_with_the_next_plan(void **state)
{
    (void)state;
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
    fracas_index_row *row;
    size_t count;
    OK(fracas_index_rows(index_, &table, &row, &count));
    assert_int_equal(row[2 * REPLICAS + 6].attempts, 1);
    assert_int_equal(row[2 * REPLICAS + 6].status, FRACAS_PLANNED);
    assert_int_equal(row[2 * REPLICAS + 7].status, FRACAS_FAILED_ROW);
    free(row);
    char said[100] = "";
    OK(fracas_index_failures(index_, &table, note_failure, said));
    assert_string_equal(said, "point 2 replica 7 attempts 1: signal 9;");
}

static void first_commit_stays(void **state)
{
    (void)state;
    sample_realization what[] = {{0, 3}, {1, 1}, {0, 4}};
    fracas_segment_row row[3];
    fracas_file_seal seal;
    fracas_place place;
    sample_segment(study, "a.h5", &table, what, 3, MOST, &seal, row);
    row[0].outcome = row[1].outcome = FRACAS_INTACT;
    row[2].outcome = FRACAS_FAILED;
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
    sample_fails(fracas_index_commit(index_, "a.h5", &seal, row, 3, "{}"), FRACAS_BUG, "another segment a.h5");
}

/* A commit of something unplanned leaves nothing behind. */
static void commits_are_whole(void **state)
{
    (void)state;
    sample_realization what[] = {{0, 3}, {1, 1}};
    fracas_segment_row row[2];
    fracas_file_seal seal;
    sample_segment(study, "a.h5", &table, what, 2, MOST, &seal, row);
    row[1].replica = REPLICAS;
    sample_fails(fracas_index_commit(index_, "a.h5", &seal, row, 2, "{}"), FRACAS_DAMAGED, "no replica 40");
    row[1].replica = 1;
    sample_fails(fracas_index_commit(index_, "a.h5", &seal, row, 2, "not json"), FRACAS_BUG, "CHECK");
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
    (void)state;
    fracas_index *other, *third;
    bool local;
    OK(fracas_disk_is_local("/proc", &local)); /* one we do not know: taken for a network */
    assert_false(local);
    sample_fails(fracas_index_open(sample_path(study, "segments"), false, &other), FRACAS_DAMAGED, "fracas run");
    OK(fracas_index_open_as(sample_path(study, "segments"), true, false, &other)); /* as on a network */
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
    assert_int_equal(sqlite3_exec(index_->db, "UPDATE meta SET value = '99'", NULL, NULL, NULL), SQLITE_OK);
    sample_fails(fracas_index_open(study, false, &other), FRACAS_DAMAGED, "format version 99");
    sample_spill(sample_path(study, "segments/index.sqlite"), "no database, but long enough to be looked at", 44);
    sample_fails(fracas_index_open(sample_path(study, "segments"), false, &other), FRACAS_DAMAGED, "remove it");
}

/* ---- what the study is of ---- */

/* Headers of another campaign or program whose points are the same, and what each differs in. */
enum { OTHERS = 4 };
static fracas_file_header other_header(int other)
{
    fracas_file_header header = sample_header();
    if (other == 0) strcpy(header.version, "0.2.0");
    if (other == 1) header.seed++;
    if (other == 2) header.history++;
    if (other == 3) header.interfaces = false;
    return header;
}

static const char *const difference[OTHERS] = {"program_version 0.1.0, not 0.2.0",
                                               "seed 18446744073709551611, not 18446744073709551612",
                                               "history 100, not 101", "interfaces 1, not 0"};

static void a_study_is_of_one_program_and_campaign(void **state)
{
    (void)state;
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    OK(fracas_index_claim(index_, &header));
    for (int other = 0; other < OTHERS; other++) {
        header = other_header(other);
        sample_fails(fracas_index_claim(index_, &header), FRACAS_DAMAGED, difference[other]);
        assert_non_null(strstr(fracas_message(), "--study"));
    }
}

static void segments_of_another_are_left_and_not_merged(void **state)
{
    (void)state;
    commit_everything(5);
    fracas_index_close(index_);
    unlink(sample_path(study, "index.sqlite"));
    OK(fracas_index_open(study, true, &index_));
    for (int other = 0; other < OTHERS; other++) {
        fracas_file_header header = other_header(other);
        char *report;
        OK(fracas_study_recover(study, index_, &header, &table, &report));
        assert_non_null(strstr(report, difference[other]));
        assert_null(strstr(report, "adopted"));
        free(report);
        assert_int_equal(count_all().planned, ALL);
    }
    recover_says("adopted"); /* nothing was lost */
    assert_int_equal(count_all().planned, 0);
    for (int other = 0; other < OTHERS; other++) {
        fracas_file_header header = other_header(other);
        sample_fails(fracas_study_merge(study, index_, &header, &table), FRACAS_DAMAGED, difference[other]);
    }
    fracas_file_header header = other_header(2);
    OK(fracas_index_claim(index_, &header)); /* and verify compares with what the study was begun with */
    char text[8192];
    assert_true(verify(text) > 0);
    assert_non_null(strstr(text, "s0.h5: not of this study: history 100, not 101"));
}

/* ---- the file of the index ---- */

static void an_index_without_tables_is_none(void **state)
{
    (void)state;
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
        sample_spill(path, "", 0);
        if (!empty) { /* as a kill between the first page and the tables leaves it */
            assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
            assert_int_equal(sqlite3_exec(db, "PRAGMA journal_mode = WAL", NULL, NULL, NULL), SQLITE_OK);
            sqlite3_close(db);
            struct stat info;
            assert_int_equal(stat(path, &info), 0);
            assert_true(info.st_size > 0);
        }
        assert_false(fracas_index_exists(study));
        sample_fails(fracas_index_open(study, false, &other), FRACAS_DAMAGED, "`fracas run` makes one");
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
    sample_fails(fracas_index_open(study, true, &other), FRACAS_DAMAGED, "remove it: `fracas run` makes it anew");
    sample_spill(path, "no database, but long enough to be looked at", 44);
    assert_false(fracas_index_exists(study));
    sample_fails(fracas_index_open(study, true, &other), FRACAS_DAMAGED, "remove it: `fracas run` makes it anew");
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
    if (fracas_index_event(index_, "kind", "text") != FRACAS_ENVIRONMENT || !strstr(fracas_message(), "copy it")) _exit(6);
    fracas_index_close(index_);
    if (fracas_study_verify(study, keep_problem, text, &problems) || problems) _exit(7);
    if (fracas_index_open(study, true, &index_) != FRACAS_ENVIRONMENT || !strstr(fracas_message(), "copy it")) _exit(8);
    _exit(0);
}

static void a_study_that_cannot_be_written_can_be_read(void **state)
{
    (void)state;
    char *plain = study, *odd = NULL;
    commit_everything(2);
    merge();
    fracas_index_close(index_);
    index_ = NULL;
    assert_true(asprintf(&odd, "%s 50%%?#", plain) > 0); /* a name that a URI must not take for its own */
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
}

/* ---- merge ---- */

static void order_of_segments_changes_nothing(void **state)
{
    (void)state;
    commit_everything(0);
    merge();
    assert_int_equal(rename(sample_path(study, "study.h5"), sample_path(study, "first")), 0);
    for (uint64_t seed = 1; seed < 4; seed++) {
        fracas_index_close(index_);
        sample_remove_tree(sample_path(study, "segments"));
        unlink(sample_path(study, "index.sqlite"));
        assert_int_equal(mkdir(sample_path(study, "segments"), 0777), 0);
        OK(fracas_index_open(study, true, &index_));
        OK(fracas_index_plan(index_, &table));
        commit_everything(seed);
        merge();
        assert_true(sample_same_file(sample_path(study, "study.h5"), sample_path(study, "first")));
        verify_finds(0, "");
    }
}

/* The merged file is what one writer would have written; failed rows are empty and make it incomplete. */
static void merged_is_as_if_written_in_order(void **state)
{
    (void)state;
    commit_everything(9);
    merge();
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    fracas_record record;
    OK(fracas_writer_create(sample_path(study, "direct.h5"), &header, &table, &writer));
    for (size_t i = 0; i < ALL; i++) {
        sample_record(i / REPLICAS, (int64_t)(i % REPLICAS), MOST, &record);
        OK(fracas_writer_append(writer, i / REPLICAS, (int64_t)(i % REPLICAS), &record));
        fracas_record_clear(&record);
    }
    OK(fracas_writer_finish(writer, false, &seal));
    assert_true(count_all().failed > 0);
    assert_true(sample_same_file(sample_path(study, "study.h5"), sample_path(study, "direct.h5")));
}

static void merge_refuses_what_is_not_whole(void **state)
{
    (void)state;
    fracas_file_header header = sample_header();
    sample_fails(fracas_study_merge(study, index_, &header, &table), FRACAS_INTERRUPTED, "run again");
    commit_everything(3);
    strcpy(header.version, "0.2.0");
    sample_fails(fracas_study_merge(study, index_, &header, &table), FRACAS_DAMAGED, "not of this study: program_version 0.1.0, not 0.2.0");
    header = sample_header();
    header.seed++;
    sample_fails(fracas_study_merge(study, index_, &header, &table), FRACAS_DAMAGED, "seed");
    flip_byte(sample_path(study, "segments/s2.h5"), 30000);
    header = sample_header();
    sample_fails(fracas_study_merge(study, index_, &header, &table), FRACAS_DAMAGED, "s2.h5: damaged");
    assert_int_equal(sample_files(study, "study.h5"), 0);
    unlink(sample_path(study, "segments/s2.h5")); /* the remedy of the message */
    recover_says("s2.h5 is missing");
    assert_true(count_all().planned > 0);
}

/* ---- recover ---- */

static void orphans_are_adopted(void **state)
{
    (void)state;
    commit_everything(4);
    merge();
    assert_int_equal(rename(sample_path(study, "study.h5"), sample_path(study, "first")), 0);
    fracas_index_counts before = count_all();
    fracas_index_close(index_);
    unlink(sample_path(study, "index.sqlite"));
    OK(fracas_index_open(study, true, &index_)); /* not planned: recover must not take the segments for foreign */
    recover_says("adopted");
    fracas_index_counts after = count_all();
    assert_memory_equal(&after, &before, sizeof after);
    merge();
    assert_true(sample_same_file(sample_path(study, "study.h5"), sample_path(study, "first")));
    recover_says("");
}

static void half_written_and_foreign_files_go(void **state)
{
    (void)state;
    sample_realization what[] = {{0, 0}, {0, 1}};
    fracas_segment_row row[2];
    fracas_file_seal seal;
    commit_segment("good.h5", what, 2);
    sample_spill(sample_path(study, "segments/.x.h5.tmp-123"), "abc", 3);
    sample_spill(sample_path(study, ".study.h5.tmp-99"), "abc", 3);
    sample_spill(sample_path(study, "segments/notes.txt"), "mine", 4);
    sample_spill(sample_path(study, "segments/torn.h5"), "\211HDF\r\n\032\n", 8);
    fracas_point_row foreign_row = {fracas_hash_of("foreign", 7), 9, sample_value[0]};
    fracas_point_table foreign = {3, sample_column, 1, &foreign_row};
    sample_segment(study, "foreign.h5", &foreign, what, 2, MOST, &seal, row);
    what[1].replica = REPLICAS; /* more replicas than planned here */
    fracas_point_row more_row[SAMPLE_POINTS];
    fracas_point_table more = sample_table(more_row, REPLICAS + 1);
    sample_segment(study, "more.h5", &more, what, 2, MOST, &seal, row);
    char *report;
    fracas_file_header header = sample_header();
    OK(fracas_study_recover(study, index_, &header, &table, &report));
    assert_int_equal(strstr(report, "good.h5") != NULL, 0);
    free(report);
    assert_int_equal(sample_files(sample_path(study, "segments"), ".h5"), 1);
    assert_int_equal(sample_files(sample_path(study, "segments"), "good.h5"), 1);
    assert_int_equal(sample_files(sample_path(study, "segments"), "notes.txt"), 1);
    assert_int_equal(sample_files(study, "tmp"), 0);
    assert_int_equal(count_all().segments, 1);
}

static void lost_segments_are_planned_again(void **state)
{
    (void)state;
    commit_everything(6);
    merge();
    assert_int_equal(rename(sample_path(study, "study.h5"), sample_path(study, "first")), 0);
    fracas_index_counts before = count_all();
    assert_int_equal(truncate(sample_path(study, "segments/s1.h5"), 5000), 0);
    unlink(sample_path(study, "segments/s0.h5"));
    recover_says("planned again");
    fracas_index_counts after = count_all();
    assert_true(after.planned > 0);
    assert_int_equal(after.segments, before.segments - 2);
    assert_int_equal(after.planned + after.done + after.failed, ALL);
    assert_int_equal(access(sample_path(study, "segments/s1.h5"), F_OK), -1);
    fracas_index_row *row; /* compute again what is planned */
    size_t count, missing = 0;
    sample_realization what[ALL];
    OK(fracas_index_rows(index_, &table, &row, &count));
    for (size_t i = 0; i < count; i++)
        if (row[i].status == FRACAS_PLANNED) what[missing++] = (sample_realization){row[i].point, row[i].replica};
    free(row);
    commit_segment("again.h5", what, missing);
    after = count_all();
    assert_int_equal(after.done, before.done);
    merge();
    assert_true(sample_same_file(sample_path(study, "study.h5"), sample_path(study, "first")));
    verify_finds(0, "");
}

/* ---- verify ---- */

static void verify_names_what_is_wrong(void **state)
{
    (void)state;
    verify_finds(0, "");
    commit_everything(7);
    verify_finds(1, "every realization is computed");
    merge();
    verify_finds(0, "");
    flip_byte(sample_path(study, "segments/s1.h5"), 50001);
    verify_finds(1, "s1.h5: damaged");
    flip_byte(sample_path(study, "segments/s1.h5"), 50001);
    verify_finds(0, "");
    assert_int_equal(sqlite3_exec(index_->db, "UPDATE realization SET steps = steps - 1 WHERE point = 1 AND replica = "
                                  "(SELECT min(replica) FROM realization WHERE point = 1 AND status = 'done')", NULL,
                                  NULL, NULL), SQLITE_OK);
    verify_finds(1, "differs from its record");
}

static bool is_sealed(void)
{
    bool sealed;
    OK(fracas_study_sealed(study, index_, &sealed));
    return sealed;
}

static void every_byte_of_the_merged_file_is_sealed(void **state)
{
    (void)state;
    commit_everything(8);
    assert_false(is_sealed());
    merge();
    assert_true(is_sealed());
    struct stat info;
    char *path = sample_path(study, "study.h5"), *segment = sample_path(study, "segments/s1.h5");
    assert_int_equal(stat(path, &info), 0);
    uint64_t random = 6;
    for (int i = 0; i < 15; i++) { /* free space, too, of which HDF5 says nothing */
        size_t at = i < 10 ? (size_t)i * 5 : sample_bits(&random) % (size_t)info.st_size;
        flip_byte(path, at);
        verify_finds(1, "study.h5: damaged");
        flip_byte(path, at);
    }
    verify_finds(0, "");
    assert_int_equal(truncate(path, info.st_size - 1), 0);
    assert_false(is_sealed());
    verify_finds(1, "study.h5: damaged");
    merge();
    assert_true(is_sealed());
    assert_int_equal(stat(segment, &info), 0);
    assert_int_equal(truncate(segment, info.st_size - 1), 0);
    assert_false(is_sealed());
    assert_int_equal(unlink(segment), 0);
    assert_false(is_sealed());
    assert_int_equal(unlink(path), 0);
    assert_false(is_sealed());
}

/* A study.h5 whose every byte is sound, but of another run. */
static void verify_compares_every_record(void **state)
{
    (void)state;
    commit_everything(0);
    merge();
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    OK(fracas_writer_create(sample_path(study, "study.h5"), &header, &table, &writer));
    for (size_t i = 0; i < ALL; i++) {
        fracas_record record;
        sample_record(i / REPLICAS, (int64_t)(i % REPLICAS), MOST, &record);
        if (i == 77) record.end_time = 1.5;
        if (i == 78 && record.nhistory) record.history[0].work = 2.5;
        OK(fracas_writer_append(writer, i / REPLICAS, (int64_t)(i % REPLICAS), &record));
        fracas_record_clear(&record);
    }
    OK(fracas_writer_finish(writer, false, &seal));
    OK(fracas_index_seal_study(index_, &seal)); /* as if a merge had written it */
    verify_finds(2, "row 77 differs");
}

/* Flipped bytes of the index: nothing crashes, and none is taken for a bug of ours or another run. What lies in free
 * space or in a text for people cannot be found. */
static void verify_bears_a_damaged_index(void **state)
{
    (void)state;
    commit_everything(0);
    merge();
    fracas_index_close(index_);
    char path[512];
    snprintf(path, sizeof path, "%s/index.sqlite", study);
    size_t size;
    int found = 0;
    uint64_t random = 8;
    unsigned char *bytes = sample_slurp(path, &size);
    for (int i = 0; i < 300; i++) {
        size_t at = i < 100 ? (size_t)i : sample_bits(&random) % size;
        char text[8192] = "";
        int64_t problems;
        unsigned char kept = bytes[at];
        bytes[at] ^= (unsigned char)(1 + sample_bits(&random) % 255);
        sample_spill(path, bytes, size);
        bytes[at] = kept;
        OK(fracas_study_verify(study, keep_problem, text, &problems));
        found += problems > 0;
        unlink(sample_path(study, "index.sqlite-wal"));
        unlink(sample_path(study, "index.sqlite-shm"));
    }
    assert_true(found > 30); /* this small database is mostly free space */
    sample_spill(path, bytes, size);
    free(bytes);
    OK(fracas_index_open(study, false, &index_));
    verify_finds(0, "");
}

/* ---- lock ---- */

static void second_run_is_refused(void **state)
{
    (void)state;
    int lock = -1, ready[2], stop[2];
    char byte, pid[32];
    assert_int_equal(pipe(ready) + pipe(stop), 0);
    pid_t child = fork();
    if (child == 0) {
        fracas_err err = fracas_study_lock(study, &lock);
        pid_t grandchild = fork(); /* inherits the file, must not keep the lock */
        if (grandchild == 0) {
            close(ready[1]);
            (void)!read(stop[0], &byte, 1);
            _exit(0);
        }
        (void)!write(ready[1], err ? "n" : "y", 1);
        pause();
        _exit(1);
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    assert_int_equal(byte, 'y');
    sample_fails(fracas_study_lock(study, &lock), FRACAS_IN_USE, "another run uses this study");
    snprintf(pid, sizeof pid, "pid %ld;", (long)child);
    assert_non_null(strstr(fracas_message(), pid));
    char host[257] = "";
    gethostname(host, sizeof host - 1);
    assert_non_null(strstr(fracas_message(), host));
    assert_int_equal(lock, -1);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    OK(fracas_study_lock(study, &lock)); /* the grandchild still lives */
    close(lock);
    assert_int_equal(write(stop[1], "x", 1), 1);
    for (int i = 0; i < 2; i++) close(ready[i]), close(stop[i]);
    sample_fails(fracas_study_lock("/nowhere/at/all", &lock), FRACAS_ENVIRONMENT, "/nowhere/at/all/lock");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(plan_is_in_order_and_grows),
        TEST(leases_end_with_the_next_plan),
        TEST(first_commit_stays),
        TEST(commits_are_whole),
        TEST(index_modes_and_versions),
        TEST(a_study_is_of_one_program_and_campaign),
        TEST(segments_of_another_are_left_and_not_merged),
        TEST(an_index_without_tables_is_none),
        TEST(a_study_that_cannot_be_written_can_be_read),
        TEST(order_of_segments_changes_nothing),
        TEST(merged_is_as_if_written_in_order),
        TEST(merge_refuses_what_is_not_whole),
        TEST(orphans_are_adopted),
        TEST(half_written_and_foreign_files_go),
        TEST(lost_segments_are_planned_again),
        TEST(verify_names_what_is_wrong),
        TEST(every_byte_of_the_merged_file_is_sealed),
        TEST(verify_compares_every_record),
        TEST(verify_bears_a_damaged_index),
        TEST(second_run_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
