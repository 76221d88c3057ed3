/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One file of tests. Several are linked into one program, which runs one of them: PROGRAM NAME. */
#ifndef FRACAS_TESTS_SUPPORT_TEST_H
#define FRACAS_TESTS_SUPPORT_TEST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/err.h"
#include "base/own.h"

/* A long series of cases takes each seventh under the sanitizers: kernels take ten to twenty times
 * as long there, and each case goes through the same memory. */
#ifdef __SANITIZE_ADDRESS__
enum { CASE_STRIDE = 7 };
#else
enum { CASE_STRIDE = 1 };
#endif

/* The call succeeds; else its message is shown. */
#define OK(call)                                               \
    do {                                                       \
        if (call) fail_msg("%s: %s", #call, fracas_message()); \
    } while (0)

/* The call fails with this code, and its message has these parts. */
#define FAILS(call, code, ...) \
    test_fails(#call, call, code, (const char *const[]){__VA_ARGS__, NULL}, SIZE_MAX)

/* The same with `most` parts, or those before the first NULL. */
void test_fails(const char *call, fracas_err err, fracas_err wanted, const char *const part[],
                size_t most);

void assert_has(const char *text, const char *part);

/* |got - expected| <= relative |expected|. cmocka's own compares as float, and takes infinity and
 * NaN for any number. */
void assert_close(double got, double expected, double relative);
#undef assert_float_equal
#undef assert_float_not_equal

/* A stream, and what was written to it: closes the stream, the text is freed by the caller. One at
 * a time. */
FILE *text_begin(void);
char *text_end(FILE *out);

/* A file's content and a 0 after it, freed by the caller. */
char *whole_file(const char *path);
unsigned char *whole_bytes(const char *path, size_t *size);

void write_bytes(const char *path, const void *bytes, size_t size);

/* A record that is initialised here, and cleared where the block ends. */
#define RECORD(name)                    \
    FRACAS_CLEARED(fracas_record) name; \
    fracas_record_init(&name)

/* A number in [0, 1), by Knuth's MMIX generator. */
static inline double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* In [-1/2, 1/2). */
static inline double random_noise(uint64_t *state)
{
    return random_share(state) - 0.5;
}

/* Memory; the test fails without. */
static inline void *taken(size_t size)
{
    void *memory = malloc(size);
    assert_non_null(memory);
    return memory;
}

static inline void *zeroed(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    assert_non_null(memory);
    return memory;
}

/* The file's function `fracas_test` is its main; CMake gives each file's a name of its own. */
#define TESTS(...) TESTS_RUN(NULL, NULL, NULL, NULL, __VA_ARGS__)
/* The same with a fixture around each test, or around all together. */
#define TESTS_EACH(set_up, tear_down, ...) TESTS_RUN(NULL, NULL, set_up, tear_down, __VA_ARGS__)
#define TESTS_ALL(set_up, tear_down, ...) TESTS_RUN(set_up, tear_down, NULL, NULL, __VA_ARGS__)

#define TESTS_RUN(begin, end, set_up, tear_down, ...)                                       \
    int fracas_test(void)                                                                   \
    {                                                                                       \
        static const CMUnitTestFunction test[] = {__VA_ARGS__};                             \
        return test_run(#__VA_ARGS__, sizeof test / sizeof *test, test, begin, end, set_up, \
                        tear_down);                                                         \
    }

int fracas_test(void);

/* Runs `count` tests under their `names`, separated by ", ". Returns how many failed. */
int test_run(const char *names, size_t count, const CMUnitTestFunction *test,
             CMFixtureFunction begin, CMFixtureFunction end, CMFixtureFunction set_up,
             CMFixtureFunction tear_down);

/* The files of a program, in a table that CMake writes; its end has no name. */
typedef struct {
    const char *name;
    int (*run)(void);
} file_of_tests;

extern const file_of_tests test_files[];

/* The program's second argument, or NULL. */
extern const char *test_argument;

#endif
