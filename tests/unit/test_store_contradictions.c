/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files and indexes that contradict themselves or each other, one fact at a time: each is named,
 * and nothing sound is. */
#define STUDY_REPLICAS 4
#define STUDY_ROWS 5
#include "tests/support/upkeep.h"

#include "base/version.h"
#include "campaigns/store/file/schema.h"
#include "campaigns/store/results.h"
#include "campaigns/store/study/segments.h"
#include "tests/support/stored_mesh.h"

#include <fcntl.h>
#include <sys/prctl.h>

enum { SURFACE = 1, RULED = 2 /* points */, MOST_REPLICAS = 8 };

static fracas_err get_mesh(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    if (point == SURFACE) grid_make(&(grid_shape){2, 1}, mesh);
    (void)context;
    return FRACAS_OK;
}

static const fracas_mesh_source meshes = {get_mesh, NULL};

/* Records of the sample, whose interfaces are those of no mesh: so without any. */
static void commit_bare(const char *name, size_t point)
{
    const fracas_file_header header = sample_header();
    fracas_segment_row row[REPLICAS];
    fracas_writer *writer;
    fracas_file_seal seal;
    OWNED char *path = NULL;
    OK(fracas_disk_segment(study, name, &path));
    OK(fracas_writer_create(path, &header, &table, &writer));
    OK(fracas_writer_provenance(writer, SAMPLE_PROVENANCE));
    for (int64_t r = 0; r < REPLICAS; r++) {
        FRACAS_CLEARED(fracas_record) record;
        sample_record(point, r + 50, MOST, &record);
        if (record.outcome == FRACAS_FAILED) record.outcome = FRACAS_INTACT;
        record.ninterface = 0;
        row[r] = (fracas_segment_row){point_row[point].hash, r, r, fracas_summary_of(&record)};
        OK(fracas_writer_append(writer, point, r, &record));
    }
    OK(fracas_writer_finish(writer, false, &seal));
    OK(fracas_index_commit(index_, name, &seal, row, REPLICAS, SAMPLE_PROVENANCE));
}

static char *merged; /* STUDY/study.h5 */

/* All computed and merged: three segments, two decisions on one point, a mesh of another. */
static int set_up_merged(void **state)
{
    const fracas_file_header header = sample_header();
    set_up(state);
    OK(fracas_index_claim(index_, &header));
    for (size_t p = 0; p < SAMPLE_POINTS; p++)
        commit_bare((const char *const[]){"a.h5", "b.h5", "c.h5"}[p], p);
    point_row[RULED].most = MOST_REPLICAS;
    OK(fracas_index_begin(index_));
    fracas_err err = FRACAS_OK;
    for (int round = 0; !err && round < 2; round++) {
        const fracas_decision decision = {.round = round,
                                          .replicas = 2 + 2 * round,
                                          .used = 2 + round,
                                          .mean = 1,
                                          .half_width = 0.01,
                                          .stop = round,
                                          .minimum = 2,
                                          .maximum = MOST_REPLICAS,
                                          .relative_half_width = 0.1,
                                          .confidence = 0.95};
        err = fracas_index_decide(index_, &point_row[RULED], &decision, "reason");
    }
    OK(fracas_index_end(index_, err));
    OK(fracas_study_merge(study, index_, &header, &table, &meshes));
    OK(fracas_disk_join(study, "study.h5", &merged));
    return 0;
}

static int tear_down_merged(void **state)
{
    free(merged);
    return tear_down(state);
}

/* ---- one number or text of a file, changed ---- */

static void put_text(const char *file_path, const char *name, const char *text)
{
    hid_t file = H5Fopen(file_path, H5F_ACC_RDWR, H5P_DEFAULT), type = H5Tcopy(H5T_C_S1),
          space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text));
    assert_true(file >= 0 && H5Adelete(file, name) >= 0);
    hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, type, text) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    assert_true(H5Fclose(file) >= 0);
}

static void put_number(const char *file_path, const char *object, const char *name, int64_t value)
{
    hid_t file = H5Fopen(file_path, H5F_ACC_RDWR, H5P_DEFAULT),
          opened = H5Oopen(file, object, H5P_DEFAULT),
          attribute = H5Aopen(opened, name, H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT64, &value) >= 0);
    H5Aclose(attribute);
    H5Oclose(opened);
    assert_true(H5Fclose(file) >= 0);
}

/* Adds to row `row` of a column, from the end if it is negative. */
static void add_to_row(const char *file_path, const char *column, int64_t row, int64_t add)
{
    hid_t file = H5Fopen(file_path, H5F_ACC_RDWR, H5P_DEFAULT),
          dataset = H5Dopen2(file, column, H5P_DEFAULT);
    int64_t value[64];
    assert_true(dataset >= 0);
    hid_t space = H5Dget_space(dataset);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    assert_true(count > 0 && count <= 64);
    assert_true(H5Dread(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    value[row < 0 ? row + count : row] += add;
    assert_true(H5Dwrite(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    H5Sclose(space);
    H5Dclose(dataset);
    assert_true(H5Fclose(file) >= 0);
}

typedef struct {
    const char *column; /* or "attribute of OBJECT" */
    int64_t row, add;   /* an attribute's value */
    const char *text;   /* of an attribute, in place of a number */
    const char *says;   /* "": nothing is wrong */
} contradiction;

static void contradict(const char *file_path, const contradiction *c)
{
    const char *of = strstr(c->column, " of ");
    if (!of) {
        add_to_row(file_path, c->column, c->row, c->add);
        return;
    }
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)(of - c->column), c->column);
    if (c->text) put_text(file_path, name, c->text);
    else put_number(file_path, of + 4, name, c->add);
}

static void note_nothing(void *context, const char *text)
{
    (void)context, (void)text;
}

static fracas_err count_result(void *context, fracas_result *result)
{
    ++*(size_t *)context;
    (void)result;
    return FRACAS_OK;
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

/* As if a merge had written it. */
static void seal_merged(void)
{
    fracas_file_seal seal;
    OK(fracas_disk_seal_path(merged, &seal));
    OK(fracas_index_seal_study(index_, &seal));
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

/* ---- results ---- */

static fracas_err open_results(fracas_results **results)
{
    const fracas_hash campaign = sample_header().campaign;
    return fracas_results_open(study, &campaign, &table, results);
}

static void results_are_of_what_the_index_and_the_file_agree_on(void **state)
{
    static const contradiction other[] = {
        {"campaign of /", 0, 0, "0123456789abcdef0123456789abcdef", ""},
        {"interfaces of /", 0, 1, NULL, NULL},
    };
    FRACAS_CLEARED(fracas_record) record;
    size_t point, count = 0;
    int64_t replica;
    fracas_record_init(&record);
    for (size_t o = 0; o < FRACAS_COUNT(other); o++) {
        OWN(fracas_results) results = NULL;
        contradict(merged, &other[o]);
        seal_merged();
        OK(open_results(&results));
        assert_true(fracas_results_partial(results)); /* of another campaign: from the segments */
        OK(fracas_results_walk(results, FRACAS_READ_ALL, count_result, &count));
        assert_true(fracas_results_decided(results, RULED));
        FAILS(fracas_results_record(results, ALL, 0, &point, &replica, &record), FRACAS_BUG,
              "row 12 was asked for");
    }
    assert_int_equal(count, 2 * ALL);
}

static void a_study_h5_of_another_plan_is_not_taken(void **state)
{
    OWN(fracas_results) results = NULL;
    size_t count = 0;
    point_row[0].most = MOST_REPLICAS;
    sql("PRAGMA foreign_keys = OFF; DELETE FROM realization WHERE point = 1 AND replica = 3");
    sql("UPDATE realization SET segment = 77 WHERE point = 2 AND replica = 3");
    OK(open_results(&results));
    assert_true(fracas_results_partial(results));
    OK(fracas_results_walk(results, FRACAS_READ_ALL, count_result, &count));
    assert_int_equal(count, ALL - 2);
    assert_int_equal(fracas_results_notes(results), 1);
    assert_has(fracas_results_note(results, 0), "has no segment 77");
    assert_false(fracas_results_decided(results, 0)); /* only the other rule has decided */
    assert_true(fracas_results_decided(results, RULED));
}

static void rows_of_the_index_beyond_the_campaign_are_no_results(void **state)
{
    static const char *const history[] = {"-1", "99999999999"};
    OWN(fracas_results) results = NULL;
    OWN(fracas_results) none = NULL;
    char statement[100];
    sql("PRAGMA foreign_keys = OFF; INSERT INTO realization(point, replica, status) VALUES (1, -1, "
        "'done'), (1, 99, 'done'), (2, 50, 'leased'); UPDATE decision SET stop = 0");
    sql("UPDATE realization SET status = 'failed', outcome = 5 WHERE point = 1 AND replica = 2");
    OK(open_results(&results));
    assert_true(fracas_results_partial(results));
    assert_int_equal(fracas_results_realizations(results), ALL);
    assert_false(fracas_results_decided(results, RULED));
    for (size_t h = 0; h < FRACAS_COUNT(history); h++) {
        snprintf(statement, sizeof statement, "UPDATE meta SET value = '%s' WHERE key = 'history'",
                 history[h]);
        sql(statement);
        FAILS(open_results(&none), FRACAS_DAMAGED, "its history", history[h], "fracas reindex");
    }
}

/* ---- small things ---- */

static void decisions_out_of_range_are_none(void **state)
{
    const fracas_decision sound = {.round = 1, .replicas = 8, .used = 7, .stop = 1, .quantity = 2};
    assert_true(fracas_decision_valid(&sound));
    for (int k = 0; k < 8; k++) {
        fracas_decision d = sound;
        int64_t *const member[] = {&d.round, &d.replicas, &d.used,     &d.used,
                                   &d.stop,  &d.stop,     &d.quantity, &d.quantity};
        static const int64_t wrong[] = {-1, 0, -1, 9, -1, 3, -1, 3};
        *member[k] = wrong[k];
        assert_false(fracas_decision_valid(&d));
    }
}

static void meshes_differ_by_any_number(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    grid_make(&(grid_shape){2, 1}, &mesh);
    for (int k = 0; k <= 8; k++) {
        FRACAS_CLEARED(fracas_stored_mesh) other;
        grid_make(&(grid_shape){2, 1}, &other);
        switch (k) {
        case 0: other.nnodes--; break;
        case 1: other.nelements--; break;
        case 2: other.ninterfaces--; break;
        case 3: other.nborders--; break;
        case 4: other.node[1].position[0] += 1; break;
        case 5: other.element[1].node[0]++; break;
        case 6: other.interface[1].node[0]++; break;
        case 7: other.border[1].tag++; break;
        default: break;
        }
        assert_int_equal(fracas_stored_mesh_same(&mesh, &other), k == 8);
    }
}

/* An interface is an edge of both of its elements, whichever vertices they share. */
static void an_interface_belongs_to_two_elements(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    grid_make(&(grid_shape){2, 1}, &mesh);
    for (size_t i = 0; i < mesh.ninterfaces; i++)
        for (size_t e = 0; e < mesh.nelements; e++) {
            int64_t *of = mesh.interface[i].element;
            const int64_t kept = of[1];
            of[1] = (int64_t)e;
            const char *fault = fracas_stored_mesh_fault(&mesh);
            assert_int_equal(fault == NULL, of[1] == kept || of[1] == of[0]);
            of[1] = kept;
        }
}

static void records_that_contradict_themselves_are_not_written(void **state)
{
    const fracas_file_header header = sample_header();
    const fracas_stored_mesh none = {0};
    fracas_file_seal seal;
    fracas_writer *writer;
    OK(fracas_writer_create(sample_path(study, "x.h5"), &header, &table, &writer));
    for (int k = 0; k < 4; k++) {
        fracas_record record;
        fracas_record_init(&record);
        record.outcome = k == 0 ? -1 : FRACAS_INTACT;
        record.fragments_dust = k == 1 ? -1 : k == 2 ? 1 : 0;
        FAILS(fracas_writer_append(writer, 0, k == 3 ? -1 : 0, &record), FRACAS_BUG, "contradicts");
    }
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    grid_make(&(grid_shape){2, 1}, &mesh);
    OK(fracas_writer_mesh(writer, &mesh));
    FAILS(fracas_writer_finish(writer, false, &seal), FRACAS_BUG,
          "1 of 3 points have had their mesh");
    OK(fracas_writer_create(sample_path(study, "x.h5"), &header, &table, &writer));
    for (int p = 0; p < SAMPLE_POINTS; p++) OK(fracas_writer_mesh(writer, &none));
    FAILS(fracas_writer_mesh(writer, &none), FRACAS_BUG, "every point has had its mesh");
    static char longest[5000];
    memset(longest, 'x', sizeof longest - 1);
    FAILS(fracas_writer_provenance(writer, longest), FRACAS_BUG, "longer than 4096 bytes");
    OK(fracas_writer_provenance(writer, "{}"));
    FAILS(fracas_writer_provenance(writer, "{}"), FRACAS_BUG, "HDF5 refuses");
    fracas_writer_abandon(writer);
}

static void columns_cannot_have_names_of_ours(void **state)
{
    static char longest[300];
    const fracas_file_header header = sample_header();
    const char *const name[] = {"hash", "replicas", "a/b",
                                memset(longest, 'x', sizeof longest - 1)};
    fracas_column column[3];
    const fracas_point_table bad = {3, column, SAMPLE_POINTS, point_row};
    for (size_t n = 0; n < FRACAS_COUNT(name); n++) {
        fracas_writer *writer;
        memcpy(column, sample_column, sizeof column);
        column[1].path = name[n];
        FAILS(fracas_writer_create(sample_path(study, "x.h5"), &header, &bad, &writer), FRACAS_BUG,
              "cannot be named", n < 3 ? name[n] : "xxx");
        assert_int_equal(sample_files(study, "x.h5"), 0);
    }
}

static void names_of_files_of_any_kind_are_taken(void **state)
{
    static const char *const path[][2] = {{"plain", "plain.damaged"},
                                          {"a.b/plain", "a.b/plain.damaged"},
                                          {"a.b/x.h5", "a.b/x.damaged"},
                                          {"x.h5", "x.damaged"}};
    char here[512];
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(study) | mkdir("a.b", 0777), 0);
    for (size_t p = 0; p < FRACAS_COUNT(path); p++) {
        OWNED char *aside = NULL;
        OWNED char *again = NULL;
        write_bytes(path[p][0], "abc", 3);
        OK(fracas_disk_set_aside(path[p][0], &aside));
        assert_string_equal(aside, path[p][1]);
        assert_int_equal(access(aside, F_OK), 0);
        OK(fracas_disk_set_aside(path[p][0], &again)); /* somebody else has */
        assert_int_equal(access(aside, F_OK), 0);
    }
    OWNED char *temporary = NULL;
    OK(fracas_disk_temporary("x.h5", &temporary));
    assert_true(fracas_disk_is_temporary(temporary));
    assert_false(fracas_disk_is_temporary(".x.h5.tmp-"));
    assert_false(fracas_disk_is_temporary(".x.h5"));
    assert_int_equal(chdir(here), 0);
}

/* ---- the index ---- */

static void numbers_of_the_index_that_nobody_wrote(void **state)
{
    OWNED fracas_index_row *row = NULL;
    fracas_place place[REPLICAS];
    fracas_index_counts counts;
    size_t count;
    int part, parts;
    const fracas_point_table no_points = {3, sample_column, 0, point_row};
    OK(fracas_index_rows(index_, &no_points, &row, &count));
    assert_int_equal(count, 0);
    sql("INSERT OR REPLACE INTO meta VALUES ('part', '3/2')");
    OK(fracas_index_part(index_, &part, &parts));
    assert_int_equal(part * 10 + parts, 11); /* 1 of 1 */
    sql("INSERT OR REPLACE INTO meta VALUES ('part', '0/2')");
    OK(fracas_index_part(index_, &part, &parts));
    assert_int_equal(part * 10 + parts, 11);
    sql("PRAGMA ignore_check_constraints = ON; UPDATE realization SET outcome = 99 WHERE point = 1 "
        "AND replica = 0");
    OK(fracas_index_count(index_, &counts));
    int64_t outcomes = 0;
    for (int o = 0; o < FRACAS_NOUTCOMES; o++) outcomes += counts.outcome[o];
    assert_int_equal(counts.realizations, ALL);
    assert_int_equal(outcomes, ALL - 1);
    sql("DELETE FROM realization WHERE point = 1 AND replica = 1");
    OWNED fracas_index_row *none = NULL;
    FAILS(fracas_index_rows(index_, &table, &none, &count), FRACAS_DAMAGED,
          "replica 1 of point 0 was never planned");
    FAILS(fracas_index_summaries(index_, &point_row[0].hash, REPLICAS, place), FRACAS_DAMAGED,
          "3 of the first 4 replicas");
}

/* One that SQLite opens, and its integrity_check does not pass. */
static void an_unsound_index_is_not_taken_over(void **state)
{
    sql("PRAGMA ignore_check_constraints = ON; UPDATE realization SET status = 'fone' WHERE point "
        "= 1 AND replica = 0");
    OK(reindex());
    says("the index before cannot be used");
    says("CHECK constraint failed");
    says("3 segments read");
    verify_finds(1, "study.h5"); /* it has lost its seal */
}

/* More bytes than are read at the start of a run: sizes are looked at, contents when they are used.
 */
static void a_large_study_is_believed(void **state)
{
    bool sound;
    OK(fracas_study_sound(study, index_, &sound));
    assert_true(sound);
    flip_byte(merged, 20000);
    OK(fracas_study_sound(study, index_, &sound));
    assert_false(sound);
    OK(fracas_index_seal_study(index_, &(fracas_file_seal){3000000000, 1}));
    OK(fracas_study_sound(study, index_, &sound));
    assert_true(sound);
    flip_byte(sample_path(study, "segments/a.h5"), 20000);
    recover_says("");
    assert_true(fracas_study_is_kept(study, index_));
    assert_int_equal(unlink(sample_path(study, "segments/a.h5")), 0);
    assert_false(fracas_study_is_kept(study, index_));
}

/* ---- files that come and go ---- */

static void remove_next(void *context, const fracas_collected *item)
{
    int *calls = context;
    if (strstr(item->path, "index.sqlite.before-1"))
        unlink(sample_path(study, "index.sqlite.before-2"));
    assert_null(strstr(item->path, "index.sqlite.before-2")); /* it is gone */
    ++*calls;
}

static void files_may_vanish_and_strange_ones_stay(void **state)
{
    static const char *const stays[] = {
        ".reindex/mine", "attachments/00000000000000000000000000000002.old", "attachments/note"};
    static const char *const goes[] = {"index.sqlite.before-1", "index.sqlite.before-2",
                                       "attachments/00000000000000000000000000000002.tmp",
                                       "attachments/00000000000000000000000000000002"};
    uint64_t freed;
    int calls = 0;
    assert_int_equal(mkdir(sample_path(study, ".reindex"), 0777) |
                         mkdir(sample_path(study, "attachments"), 0777),
                     0);
    for (size_t n = 0; n < FRACAS_COUNT(stays); n++)
        write_bytes(sample_path(study, stays[n]), "abc", 3);
    for (size_t n = 0; n < FRACAS_COUNT(goes); n++)
        write_bytes(sample_path(study, goes[n]), "abc", 3);
    FAILS(fracas_study_collect(study, index_,
                               &(fracas_collect_options){.found = remove_next, .context = &calls},
                               &freed),
          FRACAS_ENVIRONMENT, ".reindex");
    for (size_t n = 0; n < FRACAS_COUNT(stays); n++)
        assert_int_equal(access(sample_path(study, stays[n]), F_OK), 0);
    assert_int_equal(unlink(sample_path(study, stays[0])), 0);
    OK(fracas_study_collect(
        study, index_, &(fracas_collect_options){.found = remove_next, .context = &calls}, &freed));
    for (size_t n = 0; n < FRACAS_COUNT(goes); n++)
        assert_int_not_equal(access(sample_path(study, goes[n]), F_OK), 0);
    for (size_t n = 1; n < FRACAS_COUNT(stays); n++)
        assert_int_equal(access(sample_path(study, stays[n]), F_OK), 0);
    assert_true(calls >= 5);
}

/* ---- joining ---- */

static char *other_study;
static fracas_index *other_index;

/* A second study with one segment `name` of point 0, which the first has planned only. */
static void begin_other(const char *name)
{
    char *kept = study;
    begin_study_again();
    fracas_index *kept_index = index_;
    set_up(NULL);
    commit_bare(name, 0);
    other_study = study;
    other_index = index_;
    study = kept;
    index_ = kept_index;
}

static fracas_err join(void)
{
    fracas_joined joined;
    return fracas_study_join(study, index_, other_study, other_index, &table, &joined);
}

static void end_other(void)
{
    fracas_index_close(other_index);
    sample_remove(other_study);
}

static void a_name_that_is_taken_is_not_replaced(void **state)
{
    char second[64];
    fracas_file_seal seal;
    begin_other("plain"); /* no segment of ours has such a name: without an end */
    OK(fracas_disk_seal_path(sample_path(other_study, "segments/plain"), &seal));
    snprintf(second, sizeof second, "segments/plain-%016llx.h5", (unsigned long long)seal.checksum);
    assert_int_equal(symlink("/nowhere/at/all", sample_path(study, "segments/plain")), 0);
    FAILS(join(), FRACAS_DAMAGED, "segments/plain is not there");
    assert_int_equal(sample_files(sample_path(study, "segments"), "plain"), 1); /* the link stays */
    assert_int_equal(unlink(sample_path(study, "segments/plain")), 0);
    write_bytes(sample_path(study, "segments/plain"), "ours", 4);
    write_bytes(sample_path(study, second), "ours too", 8);
    FAILS(join(), FRACAS_DAMAGED, second, "move it away");
    assert_int_equal(unlink(sample_path(study, second)), 0);
    OK(fracas_index_fail(index_, &point_row[0].hash, 1, "signal 9", true));
    sql("UPDATE realization SET status = 'quarantined' WHERE status = 'failed'");
    OK(join());
    assert_int_equal(count_all().done, REPLICAS);
    OWNED char *text = whole_file(sample_path(study, "segments/plain"));
    assert_string_equal(text, "ours");
    end_other();
}

static void a_contradicting_study_is_not_joined(void **state)
{
    static const char *const change[][2] = {
        {"UPDATE realization SET segment = 77 WHERE segment = 1", "has no segment 77"},
        {"UPDATE point SET hash = 'x' WHERE id = 1", "no valid hash"},
        {"UPDATE segment SET checksum = '0000000000000000'", "a.h5: damaged"}};
    begin_other("a.h5");
    fracas_index *kept = index_;
    for (size_t c = 0; c < FRACAS_COUNT(change); c++) {
        index_ = other_index;
        sql("PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; BEGIN");
        sql(change[c][0]);
        index_ = kept;
        FAILS(join(), FRACAS_DAMAGED, change[c][1]);
        index_ = other_index;
        sql("ROLLBACK");
        index_ = kept;
        assert_int_equal(count_all().done, 0);
        assert_int_equal(sample_files(sample_path(study, "segments"), ".h5"), 0);
    }
    sql("DELETE FROM realization; DELETE FROM point"); /* the first knows no point */
    FAILS(join(), FRACAS_DAMAGED, "has no point");
    end_other();
}

TESTS_EACH(set_up_merged, tear_down_merged, a_file_that_contradicts_itself_is_refused,
           a_file_of_another_shape_is_refused, a_seal_of_other_bytes_is_refused,
           an_empty_file_is_sound, columns_are_those_of_the_campaign,
           a_sealed_segment_with_a_wrong_row_is_named, decisions_that_decide_nothing_are_named,
           study_h5_at_odds_with_the_study_is_named, an_index_at_odds_with_the_study_is_named,
           a_segment_that_says_it_is_complete_is_named, what_a_run_may_be_writing_is_not_damaged,
           a_study_without_realizations_is_sound,
           results_are_of_what_the_index_and_the_file_agree_on,
           a_study_h5_of_another_plan_is_not_taken,
           rows_of_the_index_beyond_the_campaign_are_no_results, decisions_out_of_range_are_none,
           meshes_differ_by_any_number, an_interface_belongs_to_two_elements,
           records_that_contradict_themselves_are_not_written, columns_cannot_have_names_of_ours,
           names_of_files_of_any_kind_are_taken, numbers_of_the_index_that_nobody_wrote,
           an_unsound_index_is_not_taken_over, a_large_study_is_believed,
           files_may_vanish_and_strange_ones_stay, a_name_that_is_taken_is_not_replaced,
           a_contradicting_study_is_not_joined)
