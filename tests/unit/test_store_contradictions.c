/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files and indexes that contradict themselves or each other, one fact at a time: each is named,
 * and nothing sound is. */
#define STUDY_REPLICAS 4
#define STUDY_ROWS 5
#include "tests/support/upkeep.h"

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

TESTS_EACH(set_up_merged, tear_down_merged, a_file_that_contradicts_itself_is_refused,
           study_h5_at_odds_with_the_study_is_named, an_index_at_odds_with_the_study_is_named,
           a_segment_that_says_it_is_complete_is_named, what_a_run_may_be_writing_is_not_damaged,
           a_study_without_realizations_is_sound,
           results_are_of_what_the_index_and_the_file_agree_on,
           rows_of_the_index_beyond_the_campaign_are_no_results, decisions_out_of_range_are_none,
           meshes_differ_by_any_number, records_that_contradict_themselves_are_not_written,
           columns_cannot_have_names_of_ours, names_of_files_of_any_kind_are_taken)
