/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results, writers, index and upkeep of a study with facts that nobody wrote. */
#include "campaigns/store/study.h"
#include "tests/support/merged_study.h"

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

static void a_leased_realization_is_not_merged(void **state)
{
    const fracas_file_header header = sample_header();
    sql("UPDATE realization SET status = 'leased', segment = NULL, row = NULL, outcome = NULL "
        "WHERE point = 1 AND replica = 0");
    FAILS(fracas_study_merge(study, index_, &header, &table, &meshes, NULL), FRACAS_INTERRUPTED,
          "replica 0 of point", "not computed yet");
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
    OWN(fracas_results) fewer = NULL; /* a ruled point that is not planned yet */
    sql("DELETE FROM decision; DELETE FROM realization WHERE point = 3; DELETE FROM point WHERE id "
        "= 3");
    OK(open_results(&fewer));
    assert_int_equal(fracas_results_realizations(fewer), 2 * REPLICAS - 1);
    assert_false(fracas_results_decided(fewer, RULED));
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
    fracas_row_place place[REPLICAS];
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

static void the_folder_of_segments_is_made_again(void **state)
{
    const fracas_file_header header = sample_header();
    OWNED char *report = NULL;
    sample_remove_tree(sample_path(study, "segments"));
    recover_says("segment a.h5 is missing");
    assert_int_equal(rmdir(sample_path(study, "segments")), 0);
    write_bytes(sample_path(study, "segments"), "abc", 3);
    FAILS(fracas_study_recover(study, index_, &header, &table, &report), FRACAS_ENVIRONMENT,
          "segments");
}

/* ---- files that come and go ---- */

static void remove_next(void *context, const fracas_collected *item)
{
    int *calls = context;
    if (strstr(item->path, "index.sqlite.before-20260101T000000.1"))
        unlink(sample_path(study, "index.sqlite.before-20260101T000000.2"));
    assert_null(strstr(item->path, "index.sqlite.before-20260101T000000.2")); /* it is gone */
    ++*calls;
}

static void files_may_vanish_and_strange_ones_stay(void **state)
{
    static const char *const stays[] = {
        ".reindex/mine", "attachments/00000000000000000000000000000002.old", "attachments/note"};
    static const char *const goes[] = {"index.sqlite.before-20260101T000000.1",
                                       "index.sqlite.before-20260101T000000.2",
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

TESTS_EACH(set_up_merged, tear_down_merged, results_are_of_what_the_index_and_the_file_agree_on,
           a_leased_realization_is_not_merged, a_study_h5_of_another_plan_is_not_taken,
           rows_of_the_index_beyond_the_campaign_are_no_results, decisions_out_of_range_are_none,
           meshes_differ_by_any_number, an_interface_belongs_to_two_elements,
           records_that_contradict_themselves_are_not_written, columns_cannot_have_names_of_ours,
           names_of_files_of_any_kind_are_taken, numbers_of_the_index_that_nobody_wrote,
           an_unsound_index_is_not_taken_over, a_large_study_is_believed,
           the_folder_of_segments_is_made_again, files_may_vanish_and_strange_ones_stay,
           a_name_that_is_taken_is_not_replaced, a_contradicting_study_is_not_joined)
