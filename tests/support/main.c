/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PROGRAM NAME [ARGUMENT]: runs the file of tests NAME of a program. */
#include "tests/support/test.h"

const char *test_argument;

int test_run(const char *names, size_t count, const CMUnitTestFunction *test,
             CMFixtureFunction begin, CMFixtureFunction end, CMFixtureFunction set_up,
             CMFixtureFunction tear_down)
{
    struct CMUnitTest *tests = calloc(count, sizeof *tests);
    OWNED char *copy = strdup(names);
    if (!tests || !copy) return 1;
    char *next = copy;
    for (size_t t = 0; t < count; t++) {
        tests[t] = (struct CMUnitTest){strsep(&next, ","), test[t], set_up, tear_down, NULL};
        tests[t].name += strspn(tests[t].name, " ");
    }
    const int failed = _cmocka_run_group_tests("tests", tests, count, begin, end);
    free(tests);
    return failed;
}

int main(int argc, char **argv)
{
    test_argument = argc > 2 ? argv[2] : NULL;
    for (const file_of_tests *file = test_files; argc > 1 && file->name; file++)
        if (strcmp(argv[1], file->name) == 0) return file->run();
    fprintf(stderr, "usage: %s NAME [ARGUMENT], NAME one of:", argv[0]);
    for (const file_of_tests *file = test_files; file->name; file++)
        fprintf(stderr, " %s", file->name);
    fputc('\n', stderr);
    return 2;
}
