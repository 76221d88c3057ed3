/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of checkpoints. Their states: tests/support/lanes.h. */
#include "tests/support/study_fixture.h"

#include "campaigns/store/checkpoint.h"

enum { NUMBERS = 5000 };

static fracas_checkpoint_head head_of(size_t point, int64_t replica)
{
    return (fracas_checkpoint_head){
        .point = table.point[point].hash, .replica = replica, .steps = 17, .time = 0.25, .end = 1};
}

/* Leaves a checkpoint of point 0 and this replica. */
static void write_numbers(int64_t replica, const char *version)
{
    fracas_file_header header = sample_header();
    OWN(fracas_checkpoint) file = NULL;
    fracas_checkpoint_head head = head_of(0, replica);
    snprintf(header.version, sizeof header.version, "%s", version);
    OK(fracas_checkpoint_create(study, &header, &head, &file));
    for (int i = 0; i < NUMBERS; i++) OK(fracas_checkpoint_put(file, &i, sizeof i));
    OK(fracas_checkpoint_finish(file));
}

static fracas_err open_numbers(int64_t replica, fracas_checkpoint **file)
{
    const fracas_file_header header = sample_header();
    fracas_checkpoint_head head;
    TRY(fracas_checkpoint_open(study, &header, &table.point[0].hash, replica, &head, file));
    if (!*file) return FRACAS_OK;
    assert_int_equal(head.steps, 17);
    assert_true(head.time == 0.25 && head.end == 1);
    return FRACAS_OK;
}

static const char *path_of(int64_t replica)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/checkpoints/%s-%lld", study,
             fracas_hash_hex(&table.point[0].hash).text, (long long)replica);
    return path;
}

static void bytes_come_back(void **state)
{
    OWN(fracas_checkpoint) none = NULL;
    OK(open_numbers(1, &none));
    assert_null(none);
    write_numbers(1, sample_header().version);
    write_numbers(1, sample_header().version); /* in its place */
    OWN(fracas_checkpoint) file = NULL;
    OK(open_numbers(1, &file));
    int number;
    for (int i = 0; i < NUMBERS; i++) {
        OK(fracas_checkpoint_get(file, &number, sizeof number));
        assert_int_equal(number, i);
    }
    char rest[64]; /* the seal behind them has 32 bytes */
    FAILS(fracas_checkpoint_get(file, rest, sizeof rest), FRACAS_DAMAGED, "too short");
}

static void an_unfinished_one_leaves_nothing(void **state)
{
    const fracas_file_header header = sample_header();
    fracas_checkpoint_head head = head_of(0, 3);
    fracas_checkpoint *file;
    OK(fracas_checkpoint_create(study, &header, &head, &file));
    fracas_checkpoint_close(file);
    assert_int_equal(sample_files(sample_path(study, "checkpoints"), "-"), 0);
}

static void another_version_is_named(void **state)
{
    fracas_checkpoint *file;
    write_numbers(1, "0.0.9");
    FAILS(open_numbers(1, &file), FRACAS_DAMAGED, "of fracas 0.0.9, not 0.1.0");
    write_numbers(2, sample_header().version);
    assert_int_equal(rename(path_of(2), sample_path(study, "kept")), 0);
    assert_int_equal(rename(sample_path(study, "kept"), path_of(1)), 0);
    FAILS(open_numbers(1, &file), FRACAS_DAMAGED, "of another realization");
}

static void damage_is_told(void **state)
{
    uint64_t random = 3;
    for (int i = 0; i < 200; i++) {
        fracas_checkpoint *file;
        size_t size;
        write_numbers(1, sample_header().version);
        free(whole_bytes(path_of(1), &size));
        const uint64_t at = sample_bits(&random) % size;
        if (i % 4 == 3) assert_int_equal(truncate(path_of(1), (off_t)at), 0);
        else flip_byte(path_of(1), at);
        FAILS(open_numbers(1, &file), FRACAS_DAMAGED, path_of(1));
        assert_null(file);
    }
}

static void those_no_longer_needed_go(void **state)
{
    commit_everything(0);
    char *report = NULL, *name = NULL;
    size_t size;
    fracas_segment_row row = {.point = table.point[0].hash, .replica = 1};
    for (int replica = 0; replica < 3; replica++) write_numbers(replica, sample_header().version);
    write_numbers(1000, sample_header().version); /* nobody asks for it */
    fracas_checkpoints_remove(study, &row, 1);
    assert_int_equal(access(path_of(1), F_OK), -1);
    sql("UPDATE realization SET status = 'planned', segment = NULL, row = NULL WHERE replica IN "
        "(2, "
        "3)");
    write_numbers(3, "0.0.9");
    assert_true(asprintf(&name, "%s/checkpoints/.half.tmp-12", study) > 0);
    write_bytes(name, "half", 4);
    FILE *out = open_memstream(&report, &size);
    const fracas_file_header header = sample_header();
    OK(fracas_checkpoints_sweep(study, &header, index_, out));
    fclose(out);
    assert_has(report, "half written");
    assert_has(report, "no longer needed");
    assert_has(
        report,
        "of fracas 0.0.9, not 0.1.0; it is removed, and its realization computed from the start");
    assert_int_equal(sample_files(sample_path(study, "checkpoints"), "-"), 1);
    assert_int_equal(access(path_of(2), F_OK), 0);
    fracas_checkpoints_end(study);
    assert_int_equal(access(sample_path(study, "checkpoints"), F_OK), -1);
    free(report);
    free(name);
}

TESTS_EACH(set_up, tear_down, bytes_come_back, an_unfinished_one_leaves_nothing,
           another_version_is_named, damage_is_told, those_no_longer_needed_go)
