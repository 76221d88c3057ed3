/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/director/timings.h"

#include "base/param.h"
#include "campaigns/scheduler/types/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static const char event[] = "measured";

static const struct {
    const char *name;
    size_t at;
} number[] = {
#define NUMBER(name)                          \
    {                                         \
#name, offsetof(fracas_timings, name) \
    }
    NUMBER(workers), NUMBER(seconds),    NUMBER(planned), NUMBER(computed), NUMBER(merging),
    NUMBER(giving),  NUMBER(committing), NUMBER(cpu),     NUMBER(memory),   NUMBER(messages),
    NUMBER(leases),  NUMBER(commits),    NUMBER(rows),
};

static double cpu_seconds(struct rusage *used)
{
    getrusage(RUSAGE_SELF, used);
    return (double)(used->ru_utime.tv_sec + used->ru_stime.tv_sec) +
           1e-6 * (double)(used->ru_utime.tv_usec + used->ru_stime.tv_usec);
}

void fracas_timings_begin(fracas_timings *timings)
{
    struct rusage used;
    *timings = (fracas_timings){.seconds = fracas_now(), .cpu = cpu_seconds(&used)};
}

double fracas_timings_time(const fracas_timings *timings)
{
    return fracas_now() - timings->seconds;
}

void fracas_timings_end(fracas_timings *timings)
{
    struct rusage used;
    timings->seconds = fracas_timings_time(timings);
    timings->cpu = cpu_seconds(&used) - timings->cpu;
    timings->memory = 1024.0 * (double)used.ru_maxrss;
}

fracas_err fracas_timings_note(const fracas_timings *timings, fracas_index *index)
{
    char text[40 * FRACAS_COUNT(number)];
    size_t n = 0;
    for (size_t i = 0; i < FRACAS_COUNT(number); i++) {
        double value;
        memcpy(&value, (const char *)timings + number[i].at, sizeof value);
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s %.9g", i ? ", " : "", number[i].name,
                              value);
    }
    return fracas_index_event(index, event, text);
}

fracas_err fracas_timings_read(fracas_index *index, bool *found, fracas_timings *timings)
{
    OWNED char *text = NULL;
    *timings = (fracas_timings){0};
    TRY(fracas_index_last_event(index, event, &text));
    *found = text != NULL;
    for (size_t i = 0; text && i < FRACAS_COUNT(number); i++) {
        const char *at = strstr(text, number[i].name);
        const double value = at ? strtod(at + strlen(number[i].name), NULL) : 0;
        memcpy((char *)timings + number[i].at, &value, sizeof value);
    }
    return FRACAS_OK;
}
