/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/status/describe.h"

#include <stdio.h>

fracas_duration fracas_duration_text(double seconds)
{
    fracas_duration duration = {"-"};
    if (!(seconds >= 0 && seconds < 1e8)) return duration;
    const long long s = (long long)(seconds + 0.5);
    if (s >= 3600)
        snprintf(duration.text, sizeof duration.text, "%lld:%02lld:%02lld", s / 3600, s / 60 % 60,
                 s % 60);
    else snprintf(duration.text, sizeof duration.text, "%lld:%02lld", s / 60, s % 60);
    return duration;
}

void fracas_counts_describe(const fracas_counts *counts, bool brief, double rate, double left,
                            char *text, size_t size)
{
    int n = snprintf(text, size, brief ? "%lld/%lld done" : "%lld of %lld realizations done",
                     (long long)counts->done, (long long)counts->total);
    if (counts->memory)
        n += snprintf(text + n, size - (size_t)n, ", %lld more computed%s",
                      (long long)counts->memory, brief ? "" : ", not yet stored");
    n += snprintf(text + n, size - (size_t)n, ", %lld failed", (long long)counts->failed);
    if (rate > 0) n += snprintf(text + n, size - (size_t)n, ", %.3g/s", rate);
    const fracas_duration rest = fracas_duration_text(left);
    if (*rest.text != '-') snprintf(text + n, size - (size_t)n, ", %s left", rest.text);
}

void fracas_bar_draw(int64_t done, int64_t total, char bar[FRACAS_BAR + 1])
{
    const int full = total ? (int)(FRACAS_BAR * done / total) : FRACAS_BAR;
    for (int i = 0; i < FRACAS_BAR; i++) bar[i] = i < full ? '#' : '.';
    bar[FRACAS_BAR] = '\0';
}
