/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files and indexes that contradict themselves or each other, one fact at a time: each is named,
 * and nothing sound is. */
#include "tests/support/merged_study.h"

#include "base/version.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/study.h"

#include <sys/prctl.h>

static void note_nothing(void *context, const char *text)
{
    (void)context, (void)text;
}

static fracas_err read_all(const char *file_path)
{
    size_t count;
    OWN(fracas_reader) reader = NULL;
    OWNED fracas_decision *decision = NULL;
    TRY(fracas_reader_open(file_path, &reader));
    TRY(fracas_reader_each(reader, FRACAS_READ_ALL, count_result, &count));
    TRY(fracas_reader_decisions(reader, &decision, &count));
    return fracas_reader_check_meshes(reader, &meshes);
}

static void a_file_that_contradicts_itself_is_refused(void **state)
{
    static const contradiction wrong[] = {
        {"/realization/point", 1, -2, NULL, "of no point of the file"},
        {"/realization/point", 1, 100, NULL, "of no point of the file"},
        {"/realization/replica", 1, -100, NULL, "of no point of the file"},
        {"/realization/outcome", 1, -10, NULL, "an outcome or a count is out of range"},
        {"/realization/fragments", 1, -100, NULL, "an outcome or a count is out of range"},
        {"/realization/fragments_dust", 1, -100, NULL, "an outcome or a count is out of range"},
        {"/realization/fragments_dust", 1, 100, NULL, "an outcome or a count is out of range"},
        {"/realization/fragments", 1, 100, NULL, "not the number of rows in /fragment"},
        {"/fragment/offset", 0, 1, NULL, "does not go from 0"},
        {"/fragment/offset", -1, 1, NULL, "does not go from 0"},
        {"/fragment/offset", -1, -1000, NULL, "does not go from 0"},
        {"/history/offset", 2, -1000, NULL, "an offset is out of order"},
        {"/history/offset", 2, 1000, NULL, "an offset is out of order"},
        {"/decision/point", 0, -100, NULL, "a decision is of no point"},
        {"/decision/point", 0, 100, NULL, "a decision is of no point"},
        {"/decision/used", 0, 100, NULL, "a decision is of no point of the file, or out of range"},
        {"/point/replicas", 0, -100, NULL, "row 0 has no valid hash and replicas"},
        {"/mesh/border_tag", 0, 1, NULL, "the mesh of point 1 is not that of the campaign"},
        {"campaign of /", 0, 0, "0123456789abcdef0123456789abcdeX", "it is no hash"},
        {"campaign of /", 0, 0, "0123456789abcdef0123456789abcdef0", "it is too long"},
        {"interfaces of /", 0, 2, NULL, "neither 0 nor 1"},
        {"interfaces of /", 0, 0, NULL, "the group /interface is there when it must not be"},
        {"history of /", 0, INT64_C(1) << 40, NULL, "out of range"},
        {"columns of /point", 0, INT64_C(1) << 60, NULL, "more values than bytes"},
        {"columns of /point", 0, 300000, NULL, "more values than bytes"},
        {"columns of /point", 0, 2, NULL, "/point: damaged"},
        {"columns of /point", 0, 4, NULL, "has not the columns that it says"},
    };
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(merged, &size);
    OK(read_all(merged));
    for (size_t w = 0; w < FRACAS_COUNT(wrong); w++) {
        contradict(merged, &wrong[w]);
        FAILS(read_all(merged), FRACAS_DAMAGED, "study.h5", wrong[w].says);
        write_bytes(merged, bytes, size);
    }
}

/* In place of a column one of another shape, or of other chunks. */
static void remake(const char *column, int rank, const hsize_t shape[2], const hsize_t chunk[2])
{
    hid_t file = H5Fopen(merged, H5F_ACC_RDWR, H5P_DEFAULT),
          space = H5Screate_simple(rank, shape, (const hsize_t[]){H5S_UNLIMITED, shape[1]}),
          list = H5Pcreate(H5P_DATASET_CREATE);
    assert_true(H5Pset_chunk(list, rank, chunk) >= 0 && H5Pset_shuffle(list) >= 0 &&
                H5Pset_fletcher32(list) >= 0);
    assert_true(H5Ldelete(file, column, H5P_DEFAULT) >= 0);
    hid_t made = H5Dcreate2(file, column, H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    assert_true(made >= 0 && H5Dclose(made) >= 0);
    H5Pclose(list);
    H5Sclose(space);
    assert_true(H5Fclose(file) >= 0);
}

static void a_file_of_another_shape_is_refused(void **state)
{
    static const struct {
        const char *column;
        int rank;
        hsize_t shape[2], chunk[2];
    } wrong[] = {{"/realization/momentum", 1, {ALL}, {1024}},
                 {"/realization/momentum", 2, {ALL, 2}, {1024, 2}},
                 {"/realization/momentum", 2, {ALL, 3}, {1024, 2}},
                 {"/realization/mass", 1, {ALL}, {7}},
                 {"/realization/mass", 2, {ALL, 1}, {1024, 1}},
                 {"/realization/mass", 1, {1000000}, {1024}}};
    size_t size;
    int64_t replica;
    size_t point;
    RECORD(record);
    OWNED unsigned char *bytes = whole_bytes(merged, &size);
    for (size_t w = 0; w < FRACAS_COUNT(wrong); w++) {
        remake(wrong[w].column, wrong[w].rank, wrong[w].shape, wrong[w].chunk);
        FAILS(read_all(merged), FRACAS_DAMAGED, wrong[w].column);
        write_bytes(merged, bytes, size);
    }
    hid_t file = H5Fopen(merged, H5F_ACC_RDWR, H5P_DEFAULT),
          group = H5Gcreate2(file, "/point/more", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(group);
    assert_true(H5Fclose(file) >= 0);
    FAILS(read_all(merged), FRACAS_DAMAGED, "/point: damaged");
    write_bytes(merged, bytes, size);
    file = H5Fopen(merged, H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t dataset = H5Dopen2(file, "/fragment/offset", H5P_DEFAULT);
    assert_true(H5Dset_extent(dataset, &(hsize_t){ALL + 2}) >= 0);
    H5Dclose(dataset);
    assert_true(H5Fclose(file) >= 0);
    FAILS(read_all(merged), FRACAS_DAMAGED, "/fragment/offset", "one value more");
    write_bytes(merged, bytes, size);
    OWN(fracas_reader) reader = NULL;
    add_to_row(merged, "/history/offset", 2, -1000);
    OK(fracas_reader_open(merged, &reader));
    FAILS(fracas_reader_record(reader, 2, FRACAS_READ_ALL, &point, &replica, &record),
          FRACAS_DAMAGED, "out of order");
}

/* The seal at the end of a segment is of its bytes, and of their number. */
static void a_seal_of_other_bytes_is_refused(void **state)
{
    uint64_t version;
    size_t size;
    OWNED char *path = NULL;
    OK(fracas_disk_segment(study, "a.h5", &path));
    OWNED unsigned char *bytes = whole_bytes(path, &size);
    OK(fracas_file_version(path, &version));
    for (size_t at = 1; at <= 16; at += 8) { /* checksum, number */
        bytes[size - at] ^= 1;
        write_bytes(path, bytes, size);
        bytes[size - at] ^= 1;
        FAILS(fracas_file_version(path, &version), FRACAS_DAMAGED, "is not of its bytes");
    }
}

/* No point, no interfaces. */
static void an_empty_file_is_sound(void **state)
{
    fracas_file_header header = sample_header();
    const fracas_point_table none = {3, sample_column, 0, point_row};
    fracas_file_seal seal;
    fracas_writer *writer;
    OWN(fracas_reader) reader = NULL;
    header.interfaces = false;
    OK(fracas_writer_create(merged, &header, &none, &writer));
    OK(fracas_writer_finish(writer, true, &seal));
    OK(fracas_reader_open(merged, &reader));
    assert_int_equal(fracas_reader_points(reader)->ncolumns, 3);
    assert_int_equal(fracas_reader_points(reader)->npoints, 0);
    OK(fracas_reader_check_meshes(reader, &meshes));
    OK(fracas_reader_check_points(reader, &table));
}

/* Columns of a file against those of a campaign, of this version of the program and of another. */
static void columns_are_those_of_the_campaign(void **state)
{
    static const fracas_column column[] = {{"cohesive.law", "", "Law of the interfaces", true},
                                           {"derived.speed", "m/s", "Speed", false}};
    static const fracas_value value[] = {{NAN, "linear"}, {5000, ""}};
    static const char *const says[] = {
        "", "/point/derived.speed: the value of point 0", "/point/cohesive.law: its type",
        "/point/cohesive.law: its type", "/point/derived.speed: the value of point 0"};
    fracas_point_row row[2] = {{fracas_hash_of("a", 1), 0, value},
                               {fracas_hash_of("b", 1), 0, value}};
    for (int same = 0; same < 2; same++)
        for (int c = 0; c < 5; c++) {
            fracas_file_header header = sample_header();
            fracas_writer *writer;
            fracas_file_seal seal;
            OWN(fracas_reader) reader = NULL;
            fracas_column other[2];
            fracas_value others[2];
            snprintf(header.version, sizeof header.version, "%s", same ? FRACAS_VERSION : "0.0.1");
            OK(fracas_writer_create(merged, &header, &(fracas_point_table){2, column, 2, row},
                                    &writer));
            OK(fracas_writer_finish(writer, false, &seal));
            OK(fracas_reader_open(merged, &reader));
            memcpy(other, column, sizeof other);
            memcpy(others, value, sizeof others);
            fracas_point_row theirs = {row[0].hash, 0, others};
            if (c == 2) other[0].text = false;
            if (c == 3) other[0].unit = "m";
            if (c == 4) others[1].real = 6000;
            /* 1: without the derived one; of the second point nothing is asked */
            const fracas_point_table wanted = {c == 1 ? 1 : 2, other, 1, &theirs};
            const bool sound = c == 0 || (!same && (c == 1 || c == 4));
            if (sound) OK(fracas_reader_check_points(reader, &wanted));
            else FAILS(fracas_reader_check_points(reader, &wanted), FRACAS_DAMAGED, says[c]);
        }
}

static void study_h5_at_odds_with_the_study_is_named(void **state)
{
    static const contradiction wrong[] = {
        {"/realization/replica", 1, 1, NULL, "row 1 is not in plan order"},
        {"/realization/point", 1, 1, NULL, "row 1 is not in plan order"},
        {"/realization/steps", 1, 1, NULL, "row 1 differs from its segment"},
        {"/point/replicas", 0, 1, NULL, "has 12 realizations, but 13 in its /point/replicas"},
        {"/decision/point", 1, -1, NULL, "decisions are not in plan order"},
        {"/decision/minimum", 0, 1, NULL, ""}, /* by another rule: of before an extension */
        {"/decision/maximum", 0, 1, NULL, ""},
        {"/decision/quantity", 0, 1, NULL, ""},
        {"/decision/used", 0, -1, NULL, "decisions on the replicas of point 2 are not those"},
        {"/decision/stop", 1, -1, NULL, "decisions on the replicas of point 2 are not those"},
        {"/decision/replicas", 1, 1, NULL, "decisions on the replicas of point 2 are not those"},
        {"complete of /", 0, 0, NULL, "attribute `complete` is wrong"},
        {"program_version of /", 0, 0, "0.0.1", "not of this study: program_version 0.0.1"},
    };
    char text[8192];
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(merged, &size);
    verify_finds(0, "");
    for (size_t w = 0; w < FRACAS_COUNT(wrong); w++) {
        contradict(merged, &wrong[w]);
        seal_merged();
        const int64_t problems = verify(text);
        if ((problems > 0) != (*wrong[w].says != '\0')) fail_msg("%s: %s", wrong[w].column, text);
        assert_has(text, wrong[w].says);
        write_bytes(merged, bytes, size);
        seal_merged();
    }
    verify_finds(0, "");
}

/* Statements on the index of a sound study, and what verify says then; "" where it has nothing to
 * say. */
static void an_index_at_odds_with_the_study_is_named(void **state)
{
    static const struct {
        const char *change, *says;
    } wrong[] = {
        {"DELETE FROM decision", "decisions on the replicas of point 2 are not those"},
        {"DELETE FROM decision WHERE round = 1",
         "decisions on the replicas of point 2 are not those"},
        {"UPDATE decision SET mean = 2 WHERE round = 0",
         "decisions on the replicas of point 2 are not those"},
        {"UPDATE decision SET relative_half_width = 0.2", ""},
        {"UPDATE decision SET confidence = 0.5", ""},
        {"UPDATE decision SET replicas = -1 WHERE round = 0",
         "row of its table `decision` is damaged"},
        {"UPDATE meta SET value = '' WHERE key = 'study_seal'", "has no seal"},
        {"UPDATE meta SET value = '0.0.1' WHERE key = 'program_version'",
         "study.h5: not of this study: program_version 0.1.0, not 0.0.1"},
        {"UPDATE realization SET status = 'leased', segment = NULL, row = NULL, outcome = NULL "
         "WHERE point = 1 AND replica = 1",
         "row 1 is in no segment any more"},
        {"UPDATE realization SET segment = 77 WHERE point = 1 AND replica = 1",
         "has no segment 77"},
        {"UPDATE realization SET row = -1 WHERE point = 1 AND replica = 1", "a.h5 has no row -1"},
        {"UPDATE realization SET row = 1000000 WHERE point = 1 AND replica = 1",
         "a.h5 has no row 1000000"},
        {"DELETE FROM realization WHERE point = 1", "replica 0 of point"},
        {"UPDATE point SET hash = 'x' WHERE id = 1", "a point has no valid hash"},
        {"UPDATE segment SET name = 'a/b' WHERE id = 1", "`segment` is damaged"},
        {"UPDATE segment SET checksum = '123' WHERE id = 1", "`segment` is damaged"},
        {"UPDATE segment SET checksum = '00000000000zzzzz' WHERE id = 1", "`segment` is damaged"},
        {"UPDATE segment SET rows = -1 WHERE id = 1", "`segment` is damaged"},
    };
    char text[8192], statement[300];
    sql("PRAGMA wal_checkpoint(TRUNCATE)");
    fracas_index_close(index_);
    const char *path = sample_path(study, "index.sqlite");
    size_t size;
    OWNED char *kept = strdup(path);
    OWNED unsigned char *bytes = whole_bytes(kept, &size);
    for (size_t w = 0; w < FRACAS_COUNT(wrong); w++) {
        OK(fracas_index_open(study, true, &index_));
        snprintf(statement, sizeof statement,
                 "PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; %s",
                 wrong[w].change);
        sql(statement);
        const int64_t problems = verify(text);
        if ((problems > 0) != (*wrong[w].says != '\0')) fail_msg("%s: %s", wrong[w].change, text);
        if (!strstr(text, wrong[w].says)) fail_msg("%s: %s", wrong[w].change, text);
        fracas_index_close(index_);
        write_bytes(kept, bytes, size);
    }
    OK(fracas_index_open(study, true, &index_));
    verify_finds(0, "");
}

/* A segment whose bytes have their seal, and that contradicts itself all the same. */
static void a_segment_that_says_it_is_complete_is_named(void **state)
{
    char statement[200];
    fracas_file_seal seal;
    put_number(sample_path(study, "segments/a.h5"), "/", "complete", 1);
    OK(fracas_disk_seal_path(sample_path(study, "segments/a.h5"), &seal));
    snprintf(statement, sizeof statement,
             "UPDATE segment SET bytes = %llu, checksum = '%016llx' WHERE name = 'a.h5'",
             (unsigned long long)seal.bytes, (unsigned long long)seal.checksum);
    sql(statement);
    verify_finds(1, "as no segment is");
}

/* The same, of a row. */
static void a_sealed_segment_with_a_wrong_row_is_named(void **state)
{
    char statement[200], text[8192];
    fracas_file_seal seal;
    add_to_row(sample_path(study, "segments/a.h5"), "/realization/point", 1, 100);
    OK(fracas_disk_seal_path(sample_path(study, "segments/a.h5"), &seal));
    snprintf(statement, sizeof statement,
             "UPDATE segment SET bytes = %llu, checksum = '%016llx' WHERE name = 'a.h5'",
             (unsigned long long)seal.bytes, (unsigned long long)seal.checksum);
    sql(statement);
    assert_true(verify(text) > 0);
    assert_has(text, "of no point of the file");
    assert_has(text, "move it away and run again");
}

/* Decisions on which file and index agree, and which end too early, or at other replicas. */
static void decisions_that_decide_nothing_are_named(void **state)
{
    static const struct {
        contradiction merged;
        const char *index;
    } wrong[] = {{{"/decision/stop", 1, -1, NULL, NULL}, "UPDATE decision SET stop = 0"},
                 {{"/decision/replicas", 1, -1, NULL, NULL},
                  "UPDATE decision SET replicas = 3, failed = 0 WHERE round = 1"}};
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(merged, &size);
    for (size_t w = 0; w < FRACAS_COUNT(wrong); w++) {
        sql("CREATE TABLE kept AS SELECT * FROM decision");
        contradict(merged, &wrong[w].merged);
        seal_merged();
        sql(wrong[w].index);
        verify_finds(1, "decisions on the replicas of point 2 are not those");
        sql("DELETE FROM decision; INSERT INTO decision SELECT * FROM kept; DROP TABLE kept");
        write_bytes(merged, bytes, size);
        seal_merged();
        verify_finds(0, "");
    }
}

/* ---- verify while a run has the study ---- */

/* A child that takes the lock and waits, until it is killed. */
static pid_t hold_lock(void)
{
    int ready[2], lock;
    char byte;
    assert_int_equal(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (fracas_study_lock(study, true, &lock) || write(ready[1], "y", 1) != 1) _exit(1);
        pause();
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    close(ready[0]), close(ready[1]);
    return child;
}

static void what_a_run_may_be_writing_is_not_damaged(void **state)
{
    char text[8192];
    int64_t problems;
    const fracas_verify_options how = {
        .full = true, .table = &table, .say = keep_problem, .note = note_nothing, .context = text};
    for (int step = 0; step < 4; step++) {
        text[0] = '\0';
        if (step == 1) flip_byte(merged, 20000);
        if (step == 2) OK(fracas_index_seal_study(index_, NULL));
        if (step == 3) assert_int_equal(unlink(merged), 0);
        const pid_t child = hold_lock();
        const fracas_err err = fracas_study_verify(study, &how, &problems);
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
        const bool in_use = step == 1 || step == 2;
        if (in_use) FAILS(err, FRACAS_IN_USE, "verify again when it has ended");
        else OK(err);
        assert_int_equal(problems, 0);
        assert_string_equal(text, "");
    }
    verify_as(true, true, text); /* and when it has died */
    assert_has(text, "left by a run that died");
    assert_has(text, "study.h5 is not there or older");
}

static void a_study_without_realizations_is_sound(void **state)
{
    begin_study_again();
    sql("DELETE FROM realization; UPDATE point SET replicas = 0");
    unlink(merged);
    verify_finds(0, "");
}

TESTS_EACH(set_up_merged, tear_down_merged, a_file_that_contradicts_itself_is_refused,
           a_file_of_another_shape_is_refused, a_seal_of_other_bytes_is_refused,
           an_empty_file_is_sound, columns_are_those_of_the_campaign,
           a_sealed_segment_with_a_wrong_row_is_named, decisions_that_decide_nothing_are_named,
           study_h5_at_odds_with_the_study_is_named, an_index_at_odds_with_the_study_is_named,
           a_segment_that_says_it_is_complete_is_named, what_a_run_may_be_writing_is_not_damaged,
           a_study_without_realizations_is_sound)
