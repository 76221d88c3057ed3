/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fracas_record_init(fracas_record *record)
{
    *record = (fracas_record){
        .outcome = FRACAS_FAILED,
        .onset_time = NAN,
        .end_time = NAN,
        .time_step = NAN,
        .mass = NAN,
        .residual = NAN,
        .residual_end = NAN,
        .vibrating = NAN,
        .transits = NAN,
        .growth = NAN,
        .rest = NAN,
        .rest_variance = NAN,
        .rest_bound = NAN,
        .momentum = {NAN, NAN, NAN},
    };
    for (int e = 0; e < FRACAS_ENERGIES; e++) record->energy[e] = NAN;
}

void fracas_record_clear(fracas_record *record)
{
    free(record->fragment);
    free(record->history);
    free(record->interface);
    free(record->probe);
    free(record->reaction);
    fracas_record_init(record);
}

void fracas_probes_write(const fracas_probes *probes, char text[FRACAS_PROBES_TEXT])
{
    size_t used = 0;
    *text = '\0';
    for (size_t p = 0; p < probes->count; p++) {
        const fracas_probe *probe = &probes->probe[p];
        used += (size_t)snprintf(text + used, FRACAS_PROBES_TEXT - used, "%s%s %.15g %.15g %.15g",
                                 p ? "; " : "", probe->name, probe->place[0], probe->place[1],
                                 probe->place[2]);
    }
}

bool fracas_probes_parse(const char *text, fracas_probes *probes)
{
    *probes = (fracas_probes){0};
    while (*text) {
        int end = 0;
        if (probes->count == FRACAS_MOST_PROBES) return false;
        fracas_probe *probe = &probes->probe[probes->count];
        if (sscanf(text, "%31[A-Za-z0-9_-] %lf %lf %lf%n", probe->name, &probe->place[0],
                   &probe->place[1], &probe->place[2], &end) != 4)
            return false;
        probes->count++;
        text += end;
        if (!*text) return true;
        if (strncmp(text, "; ", 2) != 0 || !text[2]) return false;
        text += 2;
    }
    return true;
}
