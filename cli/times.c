/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The option --times of pictures and grids. */
#include "base/param.h"
#include "base/units.h"
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_TIMES = 1000 };

/* "26us,28us"; *time freed by the caller. */
static fracas_err read_list(const fracas_arguments *arguments, const char *text, double **time,
                            size_t *count)
{
    OWN(fracas_units) units = NULL;
    OWNED char *copy = strdup(text);
    *time = malloc((strlen(text) + 1) * sizeof **time); /* at most one a character */
    *count = 0;
    if (!copy || !*time) return fracas_no_memory("the times of pictures");
    TRY(fracas_units_create(&units));
    char *rest = copy;
    for (char *one; (one = strsep(&rest, ","));) {
        fracas_err err = fracas_cli_read_time(units, one, &(*time)[(*count)++]);
        if (err)
            return fracas_fail_within(err, "%s: --times is `%s`", arguments->command->name, text);
    }
    return FRACAS_OK;
}

fracas_err fracas_cli_times(const fracas_arguments *arguments, size_t *count, double **time)
{
    const char *text = fracas_given(arguments, "times");
    int wanted = (int)*count;
    *time = NULL;
    if (text && strspn(text, "0123456789") != strlen(text))
        return read_list(arguments, text, time, count);
    TRY(fracas_arguments_integer(arguments, "times", 1, MOST_TIMES, &wanted));
    *count = (size_t)wanted;
    return FRACAS_OK;
}

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

fracas_err fracas_cli_times_in_order(const fracas_arguments *arguments, size_t *count, double *time)
{
    size_t kept = 0;
    qsort(time, *count, sizeof *time, by_value);
    if (*count && time[0] < 0)
        return fracas_fail(FRACAS_USAGE, "%s: --times is `%s`; no time is below 0",
                           arguments->command->name, fracas_given(arguments, "times"));
    for (size_t k = 0; k < *count; k++)
        if (k == 0 || time[k] > time[kept - 1]) time[kept++] = time[k];
    *count = kept;
    return FRACAS_OK;
}
