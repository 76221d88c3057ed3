/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of a stranger's study (docs/decisions/trust.md). */
#include "base/version.h"
#include "campaigns/store/file/h5.h"
#include "campaigns/store/study.h"
#include "tests/support/study_fixture.h"

/* ---- the index ---- */

static void refuse(const char *script, const char *part)
{
    fracas_index *reader;
    sql(script);
    FAILS(fracas_index_open(study, false, &reader), FRACAS_DAMAGED, part);
    assert_has(fracas_message(), "reindex");
    FAILS(fracas_index_open(study, true, &reader), FRACAS_DAMAGED, part);
}

static void what_runs_in_an_index_is_refused(void **state)
{
    fracas_index *reader;
    refuse("CREATE TRIGGER t AFTER UPDATE ON meta BEGIN DELETE FROM event; END", "a trigger t");
    sql("DROP TRIGGER t");
    refuse("CREATE VIEW v AS SELECT randomblob(1e9)", "a view v");
    sql("DROP VIEW v");
    refuse("CREATE VIRTUAL TABLE r USING rtree(a, b, c)", "a virtual table r");
    sql("DROP TABLE r");
    refuse("ALTER TABLE event ADD COLUMN c TEXT AS (hex(zeroblob(1e9)))",
           "a computed column event.c");
    sql("ALTER TABLE event DROP COLUMN c");
    sql("CREATE INDEX mine ON event(kind); CREATE TABLE notes(text)"); /* of its owner */
    OK(fracas_index_open(study, false, &reader));
    fracas_index_close(reader);
}

static void a_reader_changes_nothing(void **state)
{
    fracas_index *reader;
    OK(fracas_index_open(study, false, &reader));
    FAILS(fracas_index_event(reader, "kind", "text"), FRACAS_ENVIRONMENT, "readonly");
    fracas_index_close(reader);
}

/* SQLite would take the victim for a journal of several databases that is done with. */
static void a_journal_that_names_another_file_is_refused(void **state)
{
    static const unsigned char mark[8] = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
    unsigned char bytes[2048] = {0};
    char victim[512];
    fracas_index *reader;
    snprintf(victim, sizeof victim, "%s", sample_path(study, "victim"));
    write_bytes(victim, "precious", 8);
    sql("PRAGMA journal_mode = DELETE");
    fracas_index_close(index_);
    index_ = NULL;
    write_bytes(sample_path(study, "index.sqlite-journal"), bytes, 64); /* SQLite's, put by */
    OK(fracas_index_open(study, false, &reader));
    fracas_index_close(reader);
    memcpy(bytes, mark, 8);
    const uint32_t length = (uint32_t)strlen(victim);
    uint32_t sum = 0;
    for (uint32_t i = 0; i < length; i++) sum += (uint32_t)victim[i];
    unsigned char *at = bytes + 512 + 4; /* after the page number of the lock page */
    memcpy(at, victim, length);
    at += length;
    for (int b = 3; b >= 0; b--) *at++ = (unsigned char)(length >> 8 * b);
    for (int b = 3; b >= 0; b--) *at++ = (unsigned char)(sum >> 8 * b);
    memcpy(at, mark, 8);
    write_bytes(sample_path(study, "index.sqlite-journal"), bytes, (size_t)(at + 8 - bytes));
    FAILS(fracas_index_open(study, false, &reader), FRACAS_DAMAGED, "names another file");
    FAILS(fracas_index_open(study, true, &reader), FRACAS_DAMAGED, "names another file");
    assert_int_equal(access(victim, F_OK), 0);
    unlink(sample_path(study, "index.sqlite-journal"));
    OK(fracas_index_open(study, true, &index_));
}

static void a_segment_is_a_file_of_its_folder(void **state)
{
    fracas_known_segments known = {0};
    sql("INSERT INTO segment VALUES (1, '..', 4096, '0123456789abcdef', 1, '{}')");
    FAILS(fracas_index_segments_by_id(index_, &known), FRACAS_DAMAGED, "`segment` is damaged");
    fracas_known_segments_clear(&known);
}

/* ---- HDF5 files ---- */

static char path[512];

/* A file of this program with the points of the sample, and no realization. */
static void write_file(const fracas_file_header *header)
{
    fracas_writer *writer;
    fracas_file_seal seal;
    snprintf(path, sizeof path, "%s", sample_path(study, "file.h5"));
    OK(fracas_writer_create(path, header, &table, &writer));
    OK(fracas_writer_finish(writer, false, &seal));
}

static fracas_file_header own_header(void)
{
    fracas_file_header header = sample_header();
    snprintf(header.version, sizeof header.version, "%s", FRACAS_VERSION);
    return header;
}

static void a_history_that_no_campaign_has_is_refused(void **state)
{
    fracas_file_header header = own_header();
    fracas_reader *reader;
    header.history = INT64_C(1) << 62;
    write_file(&header);
    FAILS(fracas_reader_open(path, &reader), FRACAS_DAMAGED,
          "history: damaged: it is out of range");
}

static void put_attribute(const char *object, const char *name, const char *text)
{
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT), type = H5Tcopy(H5T_C_S1),
          space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text));
    assert_true(file >= 0 && H5Adelete_by_name(file, object, name, H5P_DEFAULT) >= 0);
    hid_t attribute = H5Acreate_by_name(file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT,
                                        H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, type, text) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    assert_true(H5Fclose(file) >= 0);
}

/* In place of /fragment/mass: a link into another file, or a dataset whose bytes are in one. */
static void no_other_file_is_opened(void **state)
{
    const fracas_file_header header = own_header();
    char other[512];
    write_file(&header);
    snprintf(other, sizeof other, "%s", sample_path(study, "other.h5"));
    assert_int_equal(rename(path, other), 0);
    for (int how = 0; how < 3; how++) {
        fracas_reader *reader;
        write_file(&header);
        hsize_t most = 16;
        hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT),
              space = H5Screate_simple(1, &most, NULL), creation = H5Pcreate(H5P_DATASET_CREATE);
        assert_true(file >= 0 && H5Ldelete(file, "/fragment/mass", H5P_DEFAULT) >= 0);
        if (how == 0)
            assert_true(H5Lcreate_external(other, "/fragment/mass", file, "/fragment/mass",
                                           H5P_DEFAULT, H5P_DEFAULT) >= 0);
        if (how == 1) assert_true(H5Pset_external(creation, other, 0, 128) >= 0);
        if (how == 2)
            assert_true(H5Pset_virtual(creation, space, other, "/fragment/mass", space) >= 0);
        if (how > 0) {
            hid_t made = H5Dcreate2(file, "/fragment/mass", H5T_IEEE_F64LE, space, H5P_DEFAULT,
                                    creation, H5P_DEFAULT);
            assert_true(made >= 0 && H5Dclose(made) >= 0);
        }
        H5Pclose(creation);
        H5Sclose(space);
        assert_true(H5Fclose(file) >= 0);
        FAILS(fracas_reader_open(path, &reader), FRACAS_DAMAGED, "/fragment/mass");
    }
}

static void units_are_those_of_the_schema(void **state)
{
    static const char *const bad[][3] = {{"/fragment/mass", "unit", "g"},
                                         {"/history/time", "description", "something else"},
                                         {"/point/replicas", "unit", "m"}};
    const fracas_file_header header = own_header();
    for (size_t b = 0; b < sizeof bad / sizeof *bad; b++) {
        OWN(fracas_reader) reader = NULL;
        OWN(fracas_reader) changed = NULL;
        write_file(&header);
        OK(fracas_reader_open(path, &reader));
        OK(fracas_reader_check_schema(reader));
        put_attribute(bad[b][0], bad[b][1], bad[b][2]);
        OK(fracas_reader_open(path, &changed));
        FAILS(fracas_reader_check_schema(changed), FRACAS_DAMAGED, bad[b][0]);
    }
}

static void points_are_those_of_the_campaign(void **state)
{
    fracas_column column[4];
    fracas_value value[SAMPLE_POINTS][4];
    fracas_point_row row[SAMPLE_POINTS];
    const fracas_point_table other = {3, column, SAMPLE_POINTS, row},
                             longer = {4, column, SAMPLE_POINTS, row};
    const fracas_file_header header = own_header();
    OWN(fracas_reader) reader = NULL;
    write_file(&header);
    OK(fracas_reader_open(path, &reader));
    for (int c = 0; c < 6; c++) {
        memcpy(column, sample_column, sizeof sample_column);
        column[3] = (fracas_column){"time.end", "s", "End", false};
        for (size_t p = 0; p < SAMPLE_POINTS; p++) {
            memcpy(value[p], sample_value[p], sizeof sample_value[p]);
            value[p][3] = (fracas_value){NAN, ""};
            row[p] = table.point[SAMPLE_POINTS - 1 - p]; /* in another order */
            row[p].value = value[SAMPLE_POINTS - 1 - p];
        }
        if (c == 1) value[1][1].real = -1;
        if (c == 2) value[0][0].text = "<b>x";
        if (c == 3) column[1].unit = "kPa";
        if (c == 4) column[2].doc = "of something else";
        if (c == 5) value[2][3].real = 1;
        static const char *const where[] = {"",
                                            "/point/material.young: the value of point 1",
                                            "/point/cohesive.law: the value of point 0",
                                            "/point/material.young: its type, unit",
                                            "/point/strength.shape: its type, unit",
                                            "/point/time.end: the value of point 2"};
        const fracas_point_table *wanted = c == 5 ? &longer : &other;
        if (c == 0) OK(fracas_reader_check_points(reader, wanted));
        else FAILS(fracas_reader_check_points(reader, wanted), FRACAS_DAMAGED, where[c]);
        if (c == 0) OK(fracas_reader_check_points(reader, &longer)); /* no point has it */
    }
}

/* ---- verify ---- */

static int64_t verify_against(const fracas_point_table *campaign, char text[8192])
{
    int64_t problems;
    const fracas_verify_options how = {.table = campaign, .say = keep_problem, .context = text};
    text[0] = '\0';
    fracas_index_close(index_);
    OK(fracas_study_verify(study, &how, &problems));
    OK(fracas_index_open(study, true, &index_));
    return problems;
}

static void verify_compares_with_the_campaign(void **state)
{
    char text[8192];
    fracas_value value[SAMPLE_POINTS][3];
    fracas_point_row row[SAMPLE_POINTS];
    const fracas_point_table other = {3, sample_column, SAMPLE_POINTS, row};
    commit_everything(0);
    merge();
    assert_int_equal(verify_against(&table, text), 0);
    memcpy(value, sample_value, sizeof value);
    value[1][1].real = 69e9;
    for (size_t p = 0; p < SAMPLE_POINTS; p++) row[p] = table.point[p], row[p].value = value[p];
    assert_int_equal(verify_against(&other, text), 1 + count_all().segments);
    assert_has(text, "study.h5, and `fracas merge` it: /point/material.young");
    sql("UPDATE point SET replicas = 9223372036854775807 WHERE id = 1");
    assert_int_equal(verify_against(&table, text), 1);
    assert_has(text, "more than the campaign asks for");
    sql("UPDATE point SET replicas = 0 WHERE id = 1");
    assert_int_equal(verify_against(&table, text), 1);
    assert_has(text, "more realizations than they were planned to have");
}

/* A symbolic link where a command will write is found. */
static void verify_finds_links(void **state)
{
    commit_everything(0);
    merge();
    assert_int_equal(symlink("/dev/null", sample_path(study, "lock")), 0);
    verify_finds(1, "lock: it is a symbolic link");
    unlink(sample_path(study, "lock"));
    assert_int_equal(symlink("segments", sample_path(study, "report")), 0);
    verify_finds(1, "report: it is a symbolic link");
}

TESTS_EACH(set_up, tear_down, what_runs_in_an_index_is_refused, a_reader_changes_nothing,
           a_journal_that_names_another_file_is_refused, a_segment_is_a_file_of_its_folder,
           a_history_that_no_campaign_has_is_refused, no_other_file_is_opened,
           units_are_those_of_the_schema, points_are_those_of_the_campaign,
           verify_compares_with_the_campaign, verify_finds_links)
