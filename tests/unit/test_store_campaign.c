/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The campaign in study.h5: its text and files. */
#include "tests/support/store_sample.h"

#include "campaigns/store/datafile.h"

static char *folder;

static int set_up(void **state)
{
    folder = sample_folder();
    return 0;
}

static int tear_down(void **state)
{
    sample_remove(folder);
    return 0;
}

/* A text longer than an attribute, and files of any bytes, NUL at the end included. */
static char long_text[70001];
static const fracas_attachment campaign_file[] = {
    {.text = "300e6\n", .size = 6, .digest = "0123456789abcdef0123456789abcdef"},
    {.text = "\0\xff\n\0\0", .size = 5, .digest = "abcdef0123456789abcdef0123456789"},
    {.text = "x", .size = 1, .digest = "ffffffffffffffffffffffffffffffff"}};

/* A file without realizations; `copy` NULL: as a segment. */
static void write_file(const char *path, const fracas_campaign_copy *copy)
{
    fracas_point_row row[SAMPLE_POINTS];
    fracas_point_table table = sample_table(row, 0);
    const fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    OK(fracas_writer_create(path, &header, &table, &writer));
    if (copy) OK(fracas_writer_campaign(writer, copy));
    OK(fracas_writer_finish(writer, true, &seal));
}

static void write_campaign(const char *path, size_t files)
{
    fracas_attachment file[FRACAS_COUNT(campaign_file)];
    memcpy(file, campaign_file, sizeof file);
    memset(long_text, 'y', sizeof long_text - 1);
    write_file(path,
               &(fracas_campaign_copy){
                   .text = long_text, .size = sizeof long_text - 1, .nfiles = files, .file = file});
}

static void flip_text(const char *path, const char *text, size_t length)
{
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(path, &size);
    unsigned char *found = memmem(bytes, size, text, length);
    assert_non_null(found);
    *found ^= 0x10;
    write_bytes(path, bytes, size);
}

/* What is written is read, byte by byte; equal calls give equal files; a file without has none; a
 * flipped byte is found. */
static void campaigns_come_back(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    for (size_t files = 0; files <= FRACAS_COUNT(campaign_file); files++) {
        FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
        write_campaign(path, files);
        write_campaign(sample_path(folder, "b.h5"), files);
        assert_true(sample_same_file(path, sample_path(folder, "b.h5")));
        OWN(fracas_reader) reader = NULL;
        OK(fracas_reader_open(path, &reader));
        OK(fracas_reader_campaign(reader, &copy));
        assert_int_equal(copy.size, sizeof long_text - 1);
        assert_string_equal(copy.text, long_text);
        assert_int_equal(copy.nfiles, files);
        for (size_t i = 0; i < files; i++) {
            assert_int_equal(copy.file[i].size, campaign_file[i].size);
            assert_memory_equal(copy.file[i].text, campaign_file[i].text, campaign_file[i].size);
            assert_int_equal(copy.file[i].text[copy.file[i].size], 0);
            assert_string_equal(copy.file[i].digest, campaign_file[i].digest);
        }
    }
    for (int of = 0; of < 2; of++) {
        FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
        OWN(fracas_reader) reader = NULL;
        write_campaign(path, 1);
        flip_text(path, of ? "300e6\n" : "yyyyyyyyyyyyyyyy", of ? 6 : 16);
        OK(fracas_reader_open(path, &reader));
        FAILS(fracas_reader_campaign(reader, &copy), FRACAS_DAMAGED,
              of ? "/campaign/attachments/0123456789abcdef" : "/campaign/resolved");
    }
}

static void a_segment_has_no_campaign(void **state)
{
    FRACAS_CLEARED(fracas_campaign_copy) copy = {.size = 1};
    OWN(fracas_reader) reader = NULL;
    const char *path = sample_path(folder, "a.h5");
    write_file(path, NULL);
    OK(fracas_reader_open(path, &reader));
    OK(fracas_reader_campaign(reader, &copy));
    assert_true(!copy.text && !copy.file && !copy.size && !copy.nfiles);
}

TESTS_ALL(set_up, tear_down, campaigns_come_back, a_segment_has_no_campaign)
