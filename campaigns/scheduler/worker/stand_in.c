/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/stand_in.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

void fracas_stand_in_write(const fracas_stand_in *stand_in, char text[FRACAS_STAND_IN_TEXT])
{
    snprintf(text, FRACAS_STAND_IN_TEXT, "%.17g+%.17g:%.17g", stand_in->seconds, stand_in->share,
             stand_in->longer);
}

fracas_err fracas_stand_in_read(const char *text, fracas_stand_in *stand_in)
{
    int end = 0;
    *stand_in = (fracas_stand_in){0};
    const int found = sscanf(text, "%lf%n+%lf:%lf%n", &stand_in->seconds, &end, &stand_in->share,
                             &stand_in->longer, &end);
    const bool good = (found == 1 || found == 3) && !text[end] && stand_in->seconds >= 0 &&
                      stand_in->share >= 0 && stand_in->share <= 1 && stand_in->longer >= 0 &&
                      isfinite(stand_in->seconds) && isfinite(stand_in->longer);
    if (good) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "a stand-in for computing is `%s`; it must be SECONDS or "
                       "SECONDS+SHARE:SECONDS, such as 0.001+0.01:10",
                       text);
}

double fracas_stand_in_seconds(const fracas_stand_in *stand_in, uint64_t point, int64_t replica)
{
    /* splitmix64 (Steele, Lea and Flood 2014) of the name. */
    uint64_t x = (point << 40) + (uint64_t)replica + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    x ^= x >> 31;
    return (double)(x >> 11) * 0x1p-53 < stand_in->share ? stand_in->longer : stand_in->seconds;
}

static void sleep_for(double seconds)
{
    struct timespec rest = {.tv_sec = (time_t)seconds,
                            .tv_nsec = (long)(1e9 * (seconds - floor(seconds)))};
    while (nanosleep(&rest, &rest) && errno == EINTR)
        ;
}

fracas_err fracas_stand_in_compute(const char *text, uint64_t point, const int64_t *replica,
                                   size_t count, fracas_record *record)
{
    fracas_stand_in stand_in;
    double seconds = 0;
    TRY(fracas_stand_in_read(text, &stand_in));
    for (size_t i = 0; i < count; i++) {
        seconds += fracas_stand_in_seconds(&stand_in, point, replica[i]);
        record[i] = (fracas_record){.outcome = FRACAS_INTACT};
    }
    if (seconds > 0) sleep_for(seconds);
    return FRACAS_OK;
}
