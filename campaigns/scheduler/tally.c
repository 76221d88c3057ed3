/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/tally.h"

#include "base/param.h"
#include "campaigns/scheduler/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static const char event[] = "measured";

static const struct {
    const char *name;
    size_t at;
} number[] = {
#define NUMBER(name)                        \
    {                                       \
#name, offsetof(fracas_tally, name) \
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

void fracas_tally_begin(fracas_tally *tally)
{
    struct rusage used;
    *tally = (fracas_tally){.seconds = fracas_now(), .cpu = cpu_seconds(&used)};
}

double fracas_tally_time(const fracas_tally *tally)
{
    return fracas_now() - tally->seconds;
}

void fracas_tally_end(fracas_tally *tally)
{
    struct rusage used;
    tally->seconds = fracas_tally_time(tally);
    tally->cpu = cpu_seconds(&used) - tally->cpu;
    tally->memory = 1024.0 * (double)used.ru_maxrss;
}

fracas_err fracas_tally_note(const fracas_tally *tally, fracas_index *index)
{
    char text[40 * FRACAS_COUNT(number)];
    size_t n = 0;
    for (size_t i = 0; i < FRACAS_COUNT(number); i++) {
        double value;
        memcpy(&value, (const char *)tally + number[i].at, sizeof value);
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s %.9g", i ? ", " : "", number[i].name,
                              value);
    }
    return fracas_index_event(index, event, text);
}

fracas_err fracas_tally_read(fracas_index *index, bool *found, fracas_tally *tally)
{
    char *text;
    *tally = (fracas_tally){0};
    TRY(fracas_index_last_event(index, event, &text));
    *found = text != NULL;
    for (size_t i = 0; text && i < FRACAS_COUNT(number); i++) {
        const char *at = strstr(text, number[i].name);
        const double value = at ? strtod(at + strlen(number[i].name), NULL) : 0;
        memcpy((char *)tally + number[i].at, &value, sizeof value);
    }
    free(text);
    return FRACAS_OK;
}
