#include "engine/record.h"

#include <math.h>
#include <stdlib.h>

void fracas_record_init(fracas_record *record)
{
    *record = (fracas_record){
        .outcome = FRACAS_FAILED,
        .onset_time = NAN, .end_time = NAN, .time_step = NAN, .mass = NAN,
        .kinetic = NAN, .elastic = NAN, .cohesive = NAN, .dissipated = NAN,
        .dissipated_bending = NAN, .created = NAN, .work = NAN,
        .residual = NAN, .residual_end = NAN, .momentum = {NAN, NAN, NAN},
    };
}

void fracas_record_clear(fracas_record *record)
{
    free(record->fragment);
    free(record->history);
    free(record->interface);
    fracas_record_init(record);
}

void fracas_record_take_fragments(fracas_record *record, fracas_fragment *fragment, size_t count, int64_t dust)
{
    for (int i = 0; i < 3; i++) record->momentum[i] = 0;
    for (fracas_fragment *f = fragment; f < fragment + count; f++) {
        for (int i = 0; i < 2; i++) {
            record->momentum[i] += f->velocity[i];
            f->position[i] /= f->mass;
            f->velocity[i] /= f->mass;
        }
        f->angular_momentum[2] -= f->mass * (f->position[0] * f->velocity[1] - f->position[1] * f->velocity[0]);
        f->dust = f->elements <= dust;
        record->fragments_dust += f->dust;
    }
    record->fragment = fragment;
    record->nfragment = count;
    record->fragments = (int64_t)count;
}
