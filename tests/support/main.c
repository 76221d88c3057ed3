/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PROGRAM NAME [ARGUMENT]: runs the file of tests NAME; the list of the program's files is made by
 * CMake. */
#include "tests/support/test.h"

#define FILE_OF_TESTS(name) int test_##name(void);
#include FRACAS_TEST_LIST
#undef FILE_OF_TESTS

static const struct {
    const char *name;
    int (*run)(void);
} file[] = {
#define FILE_OF_TESTS(name) {#name, test_##name},
#include FRACAS_TEST_LIST
};

const char *test_argument;

int test_run(const char *names, size_t count, const CMUnitTestFunction *test,
             CMFixtureFunction begin, CMFixtureFunction end, CMFixtureFunction set_up,
             CMFixtureFunction tear_down)
{
    struct CMUnitTest *tests = calloc(count, sizeof *tests);
    char *copy = strdup(names);
    if (!tests || !copy) return 1;
    char *next = copy;
    for (size_t t = 0; t < count; t++)
        tests[t] = (struct CMUnitTest){strsep(&next, ","), test[t], set_up, tear_down, NULL};
    for (size_t t = 0; t < count; t++) tests[t].name += strspn(tests[t].name, " ");
    const int failed = _cmocka_run_group_tests("tests", tests, count, begin, end);
    free(copy);
    free(tests);
    return failed;
}

int main(int argc, char **argv)
{
    test_argument = argc > 2 ? argv[2] : NULL;
    for (size_t f = 0; argc > 1 && f < sizeof file / sizeof *file; f++)
        if (strcmp(argv[1], file[f].name) == 0) return file[f].run();
    fprintf(stderr, "usage: %s NAME [ARGUMENT], NAME one of:", argv[0]);
    for (size_t f = 0; f < sizeof file / sizeof *file; f++) fprintf(stderr, " %s", file[f].name);
    fputc('\n', stderr);
    return 2;
}
