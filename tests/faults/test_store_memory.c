/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing and reading a file of results when memory runs out for good: the message says so, however
 * HDF5 comes to notice. */
#include "tests/support/store_sample.h"

#ifdef __SANITIZE_ADDRESS__
/* AddressSanitizer owns malloc; this program has nothing to do there. */
int fracas_test(void)
{
    return 0;
}
#else

#include "tests/support/failing_malloc.h"

#include <limits.h>
#include <signal.h>
#include <sys/wait.h>

enum { HDF5_ENDS = 255 /* exit(-1) of HDF5, see cli/main.c; or it crashed */ };
enum { TRIES = 150, ALL = 12, MOST = 30 };
static char *folder;
static fracas_point_row point_row[SAMPLE_POINTS];
static fracas_point_table table;
static fracas_record record[ALL];

static int set_up(void **state)
{
    folder = sample_folder();
    table = sample_table(point_row, ALL / SAMPLE_POINTS);
    for (size_t i = 0; i < ALL; i++)
        sample_record(i % SAMPLE_POINTS, (int64_t)(i / SAMPLE_POINTS), MOST, &record[i]);
    return 0;
}

static int tear_down(void **state)
{
    for (size_t i = 0; i < ALL; i++) fracas_record_clear(&record[i]);
    sample_remove(folder);
    return 0;
}

static fracas_err write_file(void)
{
    const fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    TRY(fracas_writer_create(sample_path(folder, "one.h5"), &header, &table, &writer));
    for (size_t i = 0; i < ALL; i++) {
        const fracas_err err = fracas_writer_append(writer, i % SAMPLE_POINTS,
                                                    (int64_t)(i / SAMPLE_POINTS), &record[i]);
        if (err) {
            fracas_writer_abandon(writer);
            return err;
        }
    }
    return fracas_writer_finish(writer, false, &seal);
}

static fracas_err read_file(void)
{
    fracas_reader *reader;
    TRY(fracas_reader_open(sample_path(folder, "one.h5"), &reader));
    fracas_reader_close(reader);
    return FRACAS_OK;
}

/* In a process of its own, since HDF5 may keep what it could not free: its exit status. */
static int end_of(fracas_err (*work)(void), long k)
{
    int status;
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        signal(SIGSEGV, SIG_DFL); /* cmocka would go on with the next test */
        lasting = true;
        countdown = k;
        const fracas_err err = work();
        countdown = 0;
        if (err == FRACAS_ENVIRONMENT && !strstr(fracas_message(), "no memory for") &&
            !strstr(fracas_message(), strerror(ENOMEM)))
            _exit(99);
        if (err && err != FRACAS_ENVIRONMENT) print_message("%ld: %s\n", k, fracas_message());
        fflush(NULL);
        _exit(err);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : HDF5_ENDS;
}

/* Allocations of the work without a failure. */
static long allocations(fracas_err (*work)(void))
{
    countdown = LONG_MAX;
    OK(work());
    const long count = LONG_MAX - countdown;
    countdown = 0;
    return count;
}

static void check(fracas_err (*work)(void))
{
    const long count = allocations(work);
    assert_true(count > 100);
    for (long i = 0; i < TRIES; i++) {
        const int end = end_of(work, 1 + i * count / TRIES);
        if (end != FRACAS_ENVIRONMENT && end != FRACAS_OK && end != HDF5_ENDS)
            fail_msg("allocation %ld of %ld: status %d", 1 + i * count / TRIES, count, end);
    }
}

static void a_file_is_written(void **state)
{
    check(write_file);
}

static void a_file_is_read(void **state)
{
    OK(write_file());
    check(read_file);
}

TESTS_ALL(set_up, tear_down, a_file_is_written, a_file_is_read)
#endif
