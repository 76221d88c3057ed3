/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/director/timings.h"

#include "campaigns/scheduler/types/clock.h"

#include <stdio.h>
#include <sys/resource.h>

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
    const fracas_timings *t = timings;
    char text[512];
    snprintf(text, sizeof text,
             "workers %.9g, seconds %.9g, planned %.9g, computed %.9g, merging %.9g, giving %.9g, "
             "committing %.9g, cpu %.9g, memory %.9g, messages %.9g, leases %.9g, commits %.9g, "
             "rows %.9g",
             t->workers, t->seconds, t->planned, t->computed, t->merging, t->giving, t->committing,
             t->cpu, t->memory, t->messages, t->leases, t->commits, t->rows);
    return fracas_index_event(index, "measured", text);
}
