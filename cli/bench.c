/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "bench/kernels/kernels.h"

#include <string.h>
#include <unistd.h>

static const fracas_option options[] = {
    {"full", NULL, "every body, instruction set, number of lanes, state and size: some minutes"},
    {"only", "TEXT", "of those the cases whose name has TEXT in it, such as shell/ or avx512-8"},
    {"repeats", "N", "repeats of each case, of 10 ms and more (9)"},
    {"json", NULL, "print JSON"},
    {0}};

static fracas_err bench(const fracas_arguments *arguments)
{
    fracas_bench_options wanted = {.full = fracas_given(arguments, "full") != NULL,
                                   .only = fracas_given(arguments, "only"),
                                   .repeats = 9,
                                   .json = fracas_given(arguments, "json") != NULL};
    if (strcmp(arguments->operand, "kernels") != 0)
        return fracas_fail(FRACAS_USAGE, "bench: `%s` is nothing to measure; there is: kernels",
                           arguments->operand);
    TRY(fracas_arguments_integer(arguments, "repeats", 1, 10000, &wanted.repeats));
    return fracas_bench_kernels(&wanted, stdout, isatty(STDERR_FILENO) ? stderr : NULL);
}

const fracas_command fracas_command_bench = {
    .name = "bench",
    .operand = "kernels",
    .doc = "Measures how fast this machine computes, beside what it can do at most",
    .more =
        "\nBy processor time, median and quartiles of the repeats: element-steps a second; sums "
        "and "
        "products (flops), quotients and\n"
        "roots (div), bytes read and written an element-step; shares of this machine's "
        "multiply-add "
        "loop, of its divider, and of\n"
        "reading as much memory as the case has. Uncracked, or with cracks (half of the interfaces "
        "of surfaces, all of chains).\n"
        "Without options: bodies of 2500 elements, one lane and the most, some seconds. Other work "
        "on the machine costs a tenth\n"
        "or two all the same.\n",
    .options = options,
    .run = bench,
};
