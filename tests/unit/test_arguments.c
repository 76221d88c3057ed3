/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The values of options. */
#include "cli/cli.h"

#include "tests/support/test.h"

static const fracas_option options[] = {{"count", "N", "how many"}, {0}};
static const fracas_command command = {.name = "try", .options = options};

static void a_value_is_read_if_it_is_given(void **state)
{
    fracas_arguments arguments = {.command = &command};
    int value = 7;
    OK(fracas_arguments_integer(&arguments, "count", 1, 9, &value));
    assert_int_equal(value, 7);
    fracas_arguments_set(&arguments, "count", "5");
    OK(fracas_arguments_integer(&arguments, "count", 1, 9, &value));
    assert_int_equal(value, 5);
    assert_int_equal(fracas_arguments_integer(&arguments, "count", 1, 4, &value), FRACAS_USAGE);
}

/* Misspelt in the code, it would never be given. */
static void an_option_that_the_command_lacks_is_a_bug(void **state)
{
    static const char *const word[] = {"one"};
    const fracas_arguments arguments = {.command = &command};
    int value = 7;
    double real = 7;
    const fracas_err err[] = {fracas_arguments_integer(&arguments, "cuont", 1, 9, &value),
                              fracas_arguments_real(&arguments, "cuont", 1, &real),
                              fracas_arguments_word(&arguments, "cuont", word, 1, &value),
                              fracas_arguments_time(&arguments, "cuont", &real)};
    for (int e = 0; e < 4; e++) assert_int_equal(err[e], FRACAS_BUG);
    assert_string_equal(fracas_message(), "try has no option --cuont");
}

TESTS(a_value_is_read_if_it_is_given, an_option_that_the_command_lacks_is_a_bug)
