/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/record.h"

#include <math.h>
#include <stdlib.h>

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
    fracas_record_init(record);
}
