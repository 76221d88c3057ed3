/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/ensemble.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void fracas_ensemble_init(fracas_ensemble *ensemble, double lattice)
{
    *ensemble = (fracas_ensemble){.lattice = lattice};
}

void fracas_ensemble_clear(fracas_ensemble *ensemble)
{
    free(ensemble->value);
    free(ensemble->replica);
    free(ensemble->row);
    free(ensemble->first);
    free(ensemble->size);
    free(ensemble->mass);
    free(ensemble->elements);
    free(ensemble->dust);
    *ensemble = (fracas_ensemble){.lattice = ensemble->lattice, .surface = ensemble->surface};
}

static fracas_err grow(void *array, size_t count, size_t size)
{
    void *old, *grown;
    memcpy(&old, array, sizeof old);
    grown = realloc(old, count * size);
    if (!grown) return fracas_no_memory("the fragments of a point");
    memcpy(array, &grown, sizeof grown);
    return FRACAS_OK;
}

/* Room for one more realization and `more` more fragments, doubling. */
static fracas_err make_room(fracas_ensemble *ensemble, size_t more)
{
    if (ensemble->nrealizations == ensemble->room) {
        const size_t room = ensemble->room ? 2 * ensemble->room : 32;
        TRY(grow(&ensemble->value, room, sizeof *ensemble->value));
        TRY(grow(&ensemble->replica, room, sizeof *ensemble->replica));
        TRY(grow(&ensemble->row, room, sizeof *ensemble->row));
        TRY(grow(&ensemble->first, room + 1, sizeof *ensemble->first));
        ensemble->first[ensemble->nrealizations] = ensemble->nfragments;
        ensemble->room = room;
    }
    const size_t needed = ensemble->nfragments + more;
    if (needed > ensemble->fragment_room) {
        const size_t room = needed > 2 * ensemble->fragment_room ? needed
                                                                 : 2 * ensemble->fragment_room;
        TRY(grow(&ensemble->size, room, sizeof *ensemble->size));
        TRY(grow(&ensemble->mass, room, sizeof *ensemble->mass));
        TRY(grow(&ensemble->elements, room, sizeof *ensemble->elements));
        TRY(grow(&ensemble->dust, room, sizeof *ensemble->dust));
        ensemble->fragment_room = room;
    }
    return FRACAS_OK;
}

fracas_err fracas_ensemble_add(fracas_ensemble *ensemble, size_t row, int64_t replica,
                               const fracas_replica_values *value, const fracas_record *record)
{
    TRY(make_room(ensemble, record->nfragment));
    const size_t i = ensemble->nrealizations++;
    ensemble->value[i] = *value;
    ensemble->replica[i] = replica;
    ensemble->row[i] = row;
    for (const fracas_fragment *f = record->fragment; f < record->fragment + record->nfragment;
         f++) {
        const size_t at = ensemble->nfragments++;
        ensemble->size[at] = f->size;
        ensemble->mass[at] = f->mass;
        ensemble->elements[at] = (int32_t)f->elements;
        ensemble->dust[at] = f->dust != 0;
    }
    ensemble->first[i + 1] = ensemble->nfragments;
    return FRACAS_OK;
}

double fracas_ensemble_cut(const fracas_ensemble *ensemble) /* (estimators.14) */
{
    if (!ensemble->nfragments) return 0;
    if (ensemble->lattice > 0) return 1.5 * ensemble->lattice;
    double covered = 0, elements = 0;
    for (size_t i = 0; i < ensemble->nfragments; i++) {
        covered += ensemble->surface ? ensemble->size[i] * ensemble->size[i] : ensemble->size[i];
        elements += ensemble->elements[i];
    }
    const double element = covered / elements;
    return ensemble->surface ? sqrt(2.5 * element) : 1.5 * element;
}
