/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study as a whole: identity, merge, recover, verify, lock. */
#include "campaigns/store/study.h"
#include "tests/support/study_fixture.h"

/* ---- what the study is of ---- */

/* Headers of another campaign or program whose points are the same, and what each differs in. */
enum { OTHERS = 4 };
static fracas_file_header other_header(int other)
{
    fracas_file_header header = sample_header();
    if (other == 0) strcpy(header.version, "0.2.1");
    if (other == 1) header.seed++;
    if (other == 2) header.history++;
    if (other == 3) header.interfaces = false;
    return header;
}

static const char *const difference[OTHERS] = {
    "program_version 0.1.0, not 0.2.1", "seed 18446744073709551611, not 18446744073709551612",
    "history 100, not 101", "interfaces 1, not 0"};

static void a_study_is_of_one_program_and_campaign(void **state)
{
    fracas_file_header header = sample_header();
    OK(fracas_index_claim(index_, &header));
    OK(fracas_index_claim(index_, &header));
    for (int other = 0; other < OTHERS; other++) {
        header = other_header(other);
        FAILS(fracas_index_claim(index_, &header), FRACAS_DAMAGED, difference[other]);
        assert_has(fracas_message(), "--study");
    }
}

static void segments_of_another_are_left_and_not_merged(void **state)
{
    commit_everything(5);
    fracas_index_close(index_);
    unlink(sample_path(study, "index.sqlite"));
    OK(fracas_index_open(study, true, &index_));
    for (int other = 0; other < OTHERS; other++) {
        fracas_file_header header = other_header(other);
        OWNED char *report;
        OK(fracas_study_recover(study, index_, &header, &table, &report));
        assert_has(report, difference[other]);
        assert_null(strstr(report, "adopted"));
        assert_int_equal(count_all().planned, ALL);
    }
    recover_says("adopted"); /* nothing was lost */
    assert_int_equal(count_all().planned, 0);
    for (int other = 0; other < OTHERS; other++) {
        fracas_file_header header = other_header(other);
        FAILS(fracas_study_merge(study, index_, &header, &table, NULL, NULL), FRACAS_DAMAGED,
              difference[other]);
    }
    fracas_file_header header = other_header(2);
    OK(fracas_index_claim(index_,
                          &header)); /* and verify compares with what the study was begun with */
    char text[8192];
    assert_true(verify(text) > 0);
    assert_has(text, "s0.h5: not of this study: history 100, not 101");
}

/* ---- merge ---- */

static void order_of_segments_changes_nothing(void **state)
{
    commit_everything(0);
    merge();
    keep_first();
    for (uint64_t seed = 1; seed < 4; seed++) {
        begin_study_again();
        commit_everything(seed);
        merge();
        assert_true(study_is_the_first());
        verify_finds(0, "");
    }
}

/* Writes every record in order, as `change` leaves it. */
static void write_whole(const char *name, void (*change)(size_t i, fracas_record *record),
                        fracas_file_seal *seal)
{
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    OK(fracas_writer_create(sample_path(study, name), &header, &table, &writer));
    for (size_t i = 0; i < ALL; i++) {
        FRACAS_CLEARED(fracas_record) record;
        sample_record(i / REPLICAS, (int64_t)(i % REPLICAS), MOST, &record);
        change(i, &record);
        OK(fracas_writer_append(writer, i / REPLICAS, (int64_t)(i % REPLICAS), &record));
    }
    OK(fracas_writer_finish(writer, false, seal));
}

static void unchanged(size_t i, fracas_record *record) {}

static void of_another_run(size_t i, fracas_record *record)
{
    if (i == 77) record->end_time = 1.5;
    if (i == 78 && record->nhistory) record->history[0].work = 2.5;
}

/* The merged file is what one writer would have written; failed rows are empty and make it
 * incomplete. */
static void merged_is_as_if_written_in_order(void **state)
{
    commit_everything(9);
    merge();
    fracas_file_seal seal;
    write_whole("direct.h5", unchanged, &seal);
    assert_true(count_all().failed > 0);
    assert_true(sample_same_file(sample_path(study, "study.h5"), sample_path(study, "direct.h5")));
}

static void merge_refuses_what_is_not_whole(void **state)
{
    fracas_file_header header = sample_header();
    FAILS(fracas_study_merge(study, index_, &header, &table, NULL, NULL), FRACAS_INTERRUPTED,
          "run again");
    commit_everything(3);
    strcpy(header.version, "0.2.1");
    FAILS(fracas_study_merge(study, index_, &header, &table, NULL, NULL), FRACAS_DAMAGED,
          "not of this study: program_version 0.1.0, not 0.2.1");
    header = sample_header();
    header.seed++;
    FAILS(fracas_study_merge(study, index_, &header, &table, NULL, NULL), FRACAS_DAMAGED, "seed");
    flip_byte(sample_path(study, "segments/s2.h5"), 30000);
    header = sample_header();
    FAILS(fracas_study_merge(study, index_, &header, &table, NULL, NULL), FRACAS_INTERRUPTED,
          "s2.h5: damaged");
    assert_int_equal(sample_files(study, "study.h5"), 0);
    assert_true(count_all().planned > 0); /* already */
    assert_int_equal(access(sample_path(study, "segments/s2.damaged"), F_OK), 0);
    compute_planned("again.h5");
    merge();
    verify_finds(0, "");
}

/* ---- recover ---- */

static void orphans_are_adopted(void **state)
{
    commit_everything(4);
    merge();
    keep_first();
    fracas_index_counts before = count_all();
    fracas_index_close(index_);
    unlink(sample_path(study, "index.sqlite"));
    OK(fracas_index_open(
        study, true, &index_)); /* not planned: recover must not take the segments for foreign */
    recover_says("adopted");
    fracas_index_counts after = count_all();
    assert_memory_equal(&after, &before, sizeof after);
    assert_int_equal(
        number("SELECT count(*) FROM segment WHERE provenance <> '" SAMPLE_PROVENANCE "'"), 0);
    merge();
    assert_true(study_is_the_first());
    recover_says("");
    fracas_reader *reader;
    char *provenance;
    OK(fracas_reader_open(sample_path(study, "study.h5"), &reader));
    OK(fracas_reader_provenance(reader, &provenance));
    assert_null(provenance);
    fracas_reader_close(reader);
}

/* A segment of before it told its provenance, and one that tells none that JSON is. */
static void segments_without_provenance_are_adopted(void **state)
{
    static const char *const tells[] = {NULL, "{\"host\": "};
    for (int i = 0; i < 2; i++) {
        fracas_file_header header = sample_header();
        fracas_writer *writer;
        FRACAS_CLEARED(fracas_record) record;
        fracas_file_seal seal;
        char name[32];
        snprintf(name, sizeof name, "segments/old%d.h5", i);
        OK(fracas_writer_create(sample_path(study, name), &header, &table, &writer));
        if (tells[i]) OK(fracas_writer_provenance(writer, tells[i]));
        sample_record(0, i, MOST, &record);
        OK(fracas_writer_append(writer, 0, i, &record));
        OK(fracas_writer_finish(writer, false, &seal));
    }
    recover_says("old1.h5 with 1 realizations");
    assert_int_equal(
        number("SELECT count(*) FROM segment WHERE provenance = '{\"adopted\": true}'"), 2);
}

static void half_written_files_go_and_foreign_ones_stay(void **state)
{
    sample_realization what[] = {{0, 0}, {0, 1}};
    fracas_segment_row row[2];
    fracas_file_seal seal;
    commit_segment("good.h5", what, 2);
    write_bytes(sample_path(study, "segments/.x.h5.tmp-123"), "abc", 3);
    write_bytes(sample_path(study, ".study.h5.tmp-99"), "abc", 3);
    write_bytes(sample_path(study, "segments/notes.txt"), "mine", 4);
    write_bytes(sample_path(study, "segments/torn.h5"), "\211HDF\r\n\032\n", 8);
    fracas_point_row foreign_row = {fracas_hash_of("foreign", 7), 9, sample_value[0]};
    fracas_point_table foreign = {3, sample_column, 1, &foreign_row};
    sample_segment(study, "foreign.h5", &foreign, what, 2, MOST, &seal, row);
    what[1].replica = REPLICAS; /* more replicas than planned here */
    fracas_point_row more_row[SAMPLE_POINTS];
    fracas_point_table more = sample_table(more_row, REPLICAS + 1);
    sample_segment(study, "more.h5", &more, what, 2, MOST, &seal, row);
    OWNED char *report;
    fracas_file_header header = sample_header();
    OK(fracas_study_recover(study, index_, &header, &table, &report));
    assert_int_equal(strstr(report, "good.h5") != NULL, 0);
    assert_has(report, "torn.h5");
    /* Sound, but of realizations that nobody asked for here: somebody may have, elsewhere. */
    assert_has(report, "foreign.h5, which has realizations that this campaign does not ask for");
    assert_has(report, "more.h5, which has realizations that this campaign does not ask for");
    assert_int_equal(sample_files(sample_path(study, "segments"), ".h5"), 3);
    assert_int_equal(sample_files(sample_path(study, "segments"), "good.h5"), 1);
    assert_int_equal(sample_files(sample_path(study, "segments"), "torn.h5"), 0);
    assert_int_equal(sample_files(sample_path(study, "segments"), "notes.txt"), 1);
    assert_int_equal(sample_files(study, "tmp"), 0);
    assert_int_equal(count_all().segments, 1);
}

static void lost_segments_are_planned_again(void **state)
{
    commit_everything(6);
    merge();
    keep_first();
    fracas_index_counts before = count_all();
    assert_int_equal(truncate(sample_path(study, "segments/s1.h5"), 5000), 0);
    unlink(sample_path(study, "segments/s0.h5"));
    recover_says("planned again");
    fracas_index_counts after = count_all();
    assert_true(after.planned > 0);
    assert_int_equal(after.segments, before.segments - 2);
    assert_int_equal(after.planned + after.done + after.failed, ALL);
    assert_int_equal(access(sample_path(study, "segments/s1.h5"), F_OK), -1);
    compute_planned("again.h5");
    after = count_all();
    assert_int_equal(after.done, before.done);
    merge();
    assert_true(study_is_the_first());
    verify_finds(0, "");
}

/* ---- verify ---- */

static void verify_names_what_is_wrong(void **state)
{
    verify_finds(0, "");
    commit_everything(7);
    verify_finds(1, "every realization is computed");
    merge();
    verify_finds(0, "");
    flip_byte(sample_path(study, "segments/s1.h5"), 50001);
    verify_finds(1, "s1.h5: damaged");
    flip_byte(sample_path(study, "segments/s1.h5"), 50001);
    verify_finds(0, "");
    sql("UPDATE realization SET steps = steps - 1 WHERE point = 1 AND replica = "
        "(SELECT min(replica) FROM realization WHERE point = 1 AND status = 'done')");
    verify_finds(1, "differs from its record");
}

static void every_byte_of_the_merged_file_is_sealed(void **state)
{
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
    commit_everything(0);
    merge();
    fracas_file_seal seal;
    write_whole("study.h5", of_another_run, &seal);
    OK(fracas_index_seal_study(index_, &seal)); /* as if a merge had written it */
    verify_finds(2, "row 77 differs");
}

/* Flipped bytes of the index: nothing crashes, and none is taken for a bug of ours or another run.
 * What lies in free space or in a text for people cannot be found. */
static void verify_bears_a_damaged_index(void **state)
{
    commit_everything(0);
    merge();
    fracas_index_close(index_);
    char path[512];
    snprintf(path, sizeof path, "%s/index.sqlite", study);
    size_t size;
    int found = 0;
    uint64_t random = 8;
    unsigned char *bytes = whole_bytes(path, &size);
    for (int i = 0; i < 300; i++) {
        size_t at = i < 100 ? (size_t)i : sample_bits(&random) % size;
        char text[8192] = "";
        int64_t problems;
        unsigned char kept = bytes[at];
        bytes[at] ^= (unsigned char)(1 + sample_bits(&random) % 255);
        write_bytes(path, bytes, size);
        bytes[at] = kept;
        OK(fracas_study_verify(
            study, &(fracas_verify_options){.full = true, .say = keep_problem, .context = text},
            &problems));
        found += problems > 0;
        unlink(sample_path(study, "index.sqlite-wal"));
        unlink(sample_path(study, "index.sqlite-shm"));
    }
    assert_true(found > 30); /* this small database is mostly free space */
    write_bytes(path, bytes, size);
    free(bytes);
    OK(fracas_index_open(study, true, &index_));
    verify_finds(0, "");
}

/* What a killed run leaves is noted, and no problem. */
static void leftovers_are_noted(void **state)
{
    char text[8192];
    commit_everything(0);
    merge();
    write_bytes(sample_path(study, "segments/.x.h5.tmp-123"), "abc", 3);
    write_bytes(sample_path(study, ".study.h5.tmp-99"), "abc", 3);
    write_bytes(sample_path(study, "segments/orphan.h5"), "abc", 3);
    write_bytes(sample_path(study, "segments/old.damaged"), "abc", 3);
    static const char lock[] =
        "host=node9 pid=77 since=2026-01-31T12:00:00Z start=5 boot=b9 job=- restart=0\n";
    write_bytes(sample_path(study, "lock"), lock, strlen(lock));
    assert_int_equal(verify_as(false, true, text), 0);
    static const char *const said[] = {
        "segments/.x.h5.tmp-123: half written", "/.study.h5.tmp-99: half written",
        "orphan.h5: not in the index",          "old.damaged: set aside",
        "lock: left by another host",           "host node9, pid 77"};
    for (size_t i = 0; i < sizeof said / sizeof *said; i++) assert_has(text, said[i]);
}

TESTS_EACH(set_up, tear_down, a_study_is_of_one_program_and_campaign,
           segments_of_another_are_left_and_not_merged, order_of_segments_changes_nothing,
           merged_is_as_if_written_in_order, merge_refuses_what_is_not_whole, orphans_are_adopted,
           segments_without_provenance_are_adopted, half_written_files_go_and_foreign_ones_stay,
           lost_segments_are_planned_again, verify_names_what_is_wrong,
           every_byte_of_the_merged_file_is_sealed, verify_compares_every_record,
           verify_bears_a_damaged_index, leftovers_are_noted)
