/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flipped bytes of a study, and what the next run makes of them. */
#include "tests/support/study_fixture.h"

#include "campaigns/store/results.h"
#include "campaigns/store/study.h"

/* What the next run does with a study: recovers, computes what is planned, merges. *rows: what it
 * computed. */
static fracas_err run_again(int64_t *rows)
{
    fracas_file_header header = sample_header();
    char *report, name[32];
    static int number;
    fracas_index_row *plan;
    size_t count;
    *rows = 0;
    TRY(fracas_study_recover(study, index_, &header, &table, &report));
    free(report);
    *rows = count_all().planned;
    TRY(fracas_index_rows(index_, &table, &plan, &count));
    free(plan);
    snprintf(name, sizeof name, "again%d.h5", number++);
    compute_planned(name);
    return fracas_study_merge(study, index_, &header, &table, NULL, NULL);
}

/* Every byte of a segment is found by the quick verification before, and costs no more than its
 * realizations. */
static void a_flipped_byte_of_a_segment_is_computed_again(void **state)
{
    commit_everything(11);
    merge();
    keep_first();
    merge();
    uint64_t random = 12;
    for (int i = 0; i < 16; i++) {
        OWNED char *path;
        int64_t rows;
        FRACAS_CLEARED(fracas_known_segments) known = {0};
        OK(fracas_index_segments_by_id(index_, &known));
        const fracas_known_segment *one = &known.segment[sample_bits(&random) % known.count];
        assert_true(asprintf(&path, "%s/segments/%s", study, one->name) > 0);
        if (i % 4 == 3)
            assert_int_equal(truncate(path, (off_t)(sample_bits(&random) % one->seal.bytes)), 0);
        else flip_byte(path, sample_bits(&random) % one->seal.bytes);
        verify_finds_as(false, 1, one->name);
        bool sound;
        OK(fracas_study_sound(study, index_, &sound));
        assert_false(sound);
        const int64_t most = one->rows;
        OK(run_again(&rows));
        assert_true(rows > 0 && rows <= most);
        assert_true(study_is_the_first());
        OK(fracas_study_sound(study, index_, &sound));
        assert_true(sound);
    }
    verify_finds(0, "");
    assert_int_equal(sample_files(sample_path(study, "segments"), ".damaged"), 16);
}

static void a_flipped_byte_of_the_merged_file_is_merged_again(void **state)
{
    commit_everything(0);
    merge();
    size_t size;
    unsigned char *bytes = whole_bytes(sample_path(study, "study.h5"), &size);
    write_bytes(sample_path(study, "first"), bytes, size);
    free(bytes);
    flip_byte(sample_path(study, "study.h5"), size / 3);
    verify_finds_as(false, 1, "study.h5: damaged");
    recover_says("study.h5: damaged");
    assert_false(is_sealed());
    merge();
    assert_true(study_is_the_first());
}

/* A statement changing something. */
static void execute(const char *text)
{
    sql(text);
    if (sqlite3_changes(index_->db) == 0) fail_msg("%s: changes nothing", text);
}

/* A flipped bit of a number, which SQLite cannot see: study.h5 is not made of it, and full
 * verification names it. */
static void a_flipped_number_of_the_index_is_not_merged(void **state)
{
    static const char *const flip[] = {"outcome = outcome + 1",
                                       "fragments = fragments + 1",
                                       "fragments_dust = fragments_dust + 1",
                                       "steps = steps - 1",
                                       "dissipated = 1.25",
                                       "residual = 2.5",
                                       "size = 1e-5",
                                       "row = row + 1",
                                       "segment = segment + 1",
                                       "status = 'failed'",
                                       "status = 'quarantined'"};
    commit_everything(13);
    merge();
    fracas_file_header header = sample_header();
    for (size_t f = 0; f < sizeof flip / sizeof *flip; f++) {
        char statement[512];
        execute("CREATE TABLE kept AS SELECT * FROM realization");
        snprintf(statement, sizeof statement,
                 "UPDATE realization SET %s WHERE (point, replica) IN (SELECT point, replica FROM "
                 "realization WHERE status = 'done' AND outcome = 0 AND segment < 6 AND dissipated "
                 "NOT NULL AND size NOT NULL LIMIT 1)",
                 flip[f]);
        execute(statement);
        FAILS(fracas_study_merge(study, index_, &header, &table, NULL, NULL), FRACAS_DAMAGED,
              "fracas reindex");
        char text[8192];
        assert_true(verify(text) > 0);
        assert_has(text, "fracas reindex");
        execute("DELETE FROM realization");
        execute("INSERT INTO realization SELECT * FROM kept");
        sql("DROP TABLE kept");
    }
    merge();
    verify_finds(0, "");
}

/* What the rows of the index say of each other is looked at by quick verification. */
static void an_index_that_contradicts_itself_is_found(void **state)
{
    static const struct {
        const char *flip, *said;
    } wrong[] = {
        {"UPDATE realization SET segment = NULL WHERE rowid_ = 'done'", "done without a segment"},
        {"UPDATE realization SET outcome = 0 WHERE rowid_ = 'failed'",
         "failed with another outcome"},
        {"UPDATE realization SET status = 'planned' WHERE rowid_ = 'done'",
         "planned, but have results"},
        {"UPDATE realization SET row = 1 WHERE segment = 1", "in the same row"},
        {"UPDATE realization SET row = 100000 WHERE rowid_ = 'done'", "rows that they have not"},
        {"UPDATE realization SET replica = 1000 WHERE rowid_ = 'done'", "lack replicas"},
    };
    static const char pick[] =
        "(point, replica) IN (SELECT point, replica FROM realization WHERE status";
    commit_everything(14);
    merge();
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        char statement[512];
        const char *at = strstr(wrong[w].flip, "rowid_");
        if (at)
            snprintf(statement, sizeof statement, "%.*s%s%s LIMIT 1)", (int)(at - wrong[w].flip),
                     wrong[w].flip, pick, at + 6);
        else snprintf(statement, sizeof statement, "%s", wrong[w].flip);
        execute("CREATE TABLE kept AS SELECT * FROM realization");
        execute(statement);
        char text[8192];
        assert_true(verify_as(false, false, text) > 0);
        assert_has(text, wrong[w].said);
        execute("DELETE FROM realization");
        execute("INSERT INTO realization SELECT * FROM kept");
        sql("DROP TABLE kept");
    }
    verify_finds_as(false, 0, "");
}

/* ... and before anything is computed by it, too. */
static void a_run_does_not_begin_with_a_damaged_index(void **state)
{
    fracas_file_header header = sample_header();
    char *report;
    commit_everything(0);
    sql("PRAGMA ignore_check_constraints = ON");
    execute("UPDATE realization SET status = 'fone' WHERE point = 1 AND replica = 3");
    sql("PRAGMA ignore_check_constraints = OFF");
    FAILS(fracas_study_recover(study, index_, &header, &table, &report), FRACAS_DAMAGED,
          "fracas reindex");
    execute("UPDATE realization SET status = 'done' WHERE point = 1 AND replica = 3");
    execute(
        "UPDATE point SET hash = '00000000000000000000000000000000' WHERE id = 1"); /* no point of
                                                                                       the campaign
                                                                                     */
    FAILS(fracas_study_recover(study, index_, &header, &table, &report), FRACAS_DAMAGED,
          "1 of its 3 points are not in the campaign");
}

/* Sampled flips of the index file: the next run gives the same study.h5, or says that the index is
 * damaged; never another one. */
static void flipped_bytes_of_the_index_make_no_wrong_study(void **state)
{
    commit_everything(15);
    merge();
    keep_first();
    fracas_index_close(index_);
    char path[512];
    snprintf(path, sizeof path, "%s/index.sqlite", study);
    size_t size;
    uint64_t random = 16;
    int refused = 0;
    unsigned char *bytes = whole_bytes(path, &size);
    for (int i = 0; i < 80; i++) {
        size_t at = sample_bits(&random) % size;
        unsigned char kept = bytes[at];
        int64_t rows;
        bytes[at] ^= (unsigned char)(1u << sample_bits(&random) % 8);
        write_bytes(path, bytes, size);
        bytes[at] = kept;
        index_ = NULL;
        fracas_err err = fracas_index_open(study, true, &index_);
        if (!err) err = run_again(&rows);
        if (err && err != FRACAS_DAMAGED)
            print_error("byte %zu: code %d: %s\n", at, err, fracas_message());
        if (err) assert_int_equal(err, FRACAS_DAMAGED);
        else
            assert_true(
                sample_same_file(sample_path(study, "study.h5"), sample_path(study, "first")));
        refused += err != FRACAS_OK;
        fracas_index_close(index_);
        unlink(sample_path(study, "index.sqlite-wal"));
        unlink(sample_path(study, "index.sqlite-shm"));
    }
    assert_true(refused > 2);
    write_bytes(path, bytes, size);
    free(bytes);
    OK(fracas_index_open(study, true, &index_));
}

/* A flipped digit of campaign.yaml is another campaign: of an interrupted study no seal tells it.
 */
static void another_campaign_is_found(void **state)
{
    static const sample_realization some[] = {{0, 0}, {1, 0}, {2, 1}};
    commit_segment("some.h5", some, 3);
    fracas_point_row row[SAMPLE_POINTS];
    fracas_point_table other = sample_table(row, table.point[0].replicas);
    fracas_file_header header = sample_header();
    fracas_results *results;
    char text[8192];
    int64_t problems;
    const fracas_verify_options how = {
        .table = &other, .header = &header, .say = keep_problem, .context = text};
    *text = '\0';
    OK(fracas_index_claim(index_, &header));
    OK(fracas_study_verify(study, &how, &problems));
    assert_int_equal(problems, 0);
    row[1].hash = fracas_hash_of("edited", 6);
    header.seed++;
    OK(fracas_study_verify(study, &how, &problems));
    assert_int_equal(problems, 2);
    assert_has(text, "1 of its 3 points are not in the campaign");
    assert_has(text, "campaign.yaml: seed 18446744073709551612, not 18446744073709551611");
    FAILS(fracas_results_open(study, &header.campaign, &other, &results), FRACAS_DAMAGED,
          "1 of its 3 points are not in the campaign");
}

TESTS_EACH(set_up, tear_down, a_flipped_byte_of_a_segment_is_computed_again,
           a_flipped_byte_of_the_merged_file_is_merged_again, another_campaign_is_found,
           a_flipped_number_of_the_index_is_not_merged, an_index_that_contradicts_itself_is_found,
           a_run_does_not_begin_with_a_damaged_index,
           flipped_bytes_of_the_index_make_no_wrong_study)
