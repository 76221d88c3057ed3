/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/settling.h"

#include "base/own.h"
#include "engine/solver/pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* dt 2^(look/8): powers of two by ldexp, for the same bits everywhere. */
static double time_of(int64_t look, double step)
{
    static const double root[FRACAS_LOOKS] = {0x1p0,
                                              0x1.172b83c7d517bp0,
                                              0x1.306fe0a31b715p0,
                                              0x1.4bfdad5362a27p0,
                                              0x1.6a09e667f3bcdp0,
                                              0x1.8ace5422aa0dbp0,
                                              0x1.ae89f995ad3adp0,
                                              0x1.d5818dcfba487p0};
    return ldexp(step * root[look % FRACAS_LOOKS], (int)(look / FRACAS_LOOKS));
}

bool fracas_settling_due(const fracas_settling *settling, double since, double step)
{
    return since >= time_of(settling->looks, step);
}

/* (settled.1), (settled.2) */
void fracas_settling_look(fracas_settling *settling, const fracas_model *model, double since,
                          const fracas_census *census)
{
    const int64_t count = census->all - census->held;
    for (; fracas_settling_due(settling, since, model->time_step); settling->looks++)
        settling->seen[settling->looks % (FRACAS_LOOKS + 1)] = count;
    const int64_t half = settling->looks - 1 - FRACAS_LOOKS; /* look at half of this time */
    const int64_t then = half < 0 ? 1 + settling->parted
                                  : settling->seen[half % (FRACAS_LOOKS + 1)];
    settling->transits = since * model->wave_speed / census->size;
    settling->growth = count > 0 ? 1 - (double)then / (double)count : NAN;
}

/* By sums of each element; the partition's labels are of fragments before and after. */
static fracas_err find_rest(const fracas_model *model, fracas_step *step, int lane,
                            const double *energy, fracas_rest *rest)
{
    const size_t n = model->elements;
    uint32_t *const label = step->partition.label;
    OWNED uint32_t *fragment = malloc(n * sizeof *fragment);
    OWNED fracas_fragment_sums *element = calloc(n, sizeof *element);
    if (!fragment || !element) return fracas_no_memory("the rest of the fragments");
    for (size_t e = 0; e < n; e++) {
        fragment[e] = label[e];
        label[e] = (uint32_t)e;
    }
    model->formulation->add_up(model, step, lane, NULL, element);
    memcpy(label, fragment, n * sizeof *label);
    return model->formulation->rest(model, step, lane, energy, element, rest);
}

/* (settled.3) */
fracas_err fracas_settling_energies(const fracas_model *model, fracas_step *step, int lane,
                                    const fracas_ledger *ledger, double *vibrating,
                                    fracas_rest *rest)
{
    FRACAS_CLEARED(fracas_pieces) pieces = {0};
    TRY(fracas_pieces_find(model, step, lane, FRACAS_MOTION_RIGID, &pieces));
    OWNED double *energy = malloc(pieces.count * sizeof *energy);
    if (!energy) return fracas_no_memory("the energies of fragments");
    const double stored = ledger->elastic + ledger->cohesive;
    double strain = 0;
    for (size_t f = 0; f < pieces.count; f++) strain += pieces.beside[f].strain_energy;
    *vibrating = stored;
    for (size_t f = 0; f < pieces.count; f++) {
        const fracas_fragment_sums *of = &pieces.beside[f];
        energy[f] = of->kinetic + (strain > 0 ? stored * (of->strain_energy / strain) : 0);
        *vibrating += of->kinetic;
    }
    *rest = FRACAS_REST_UNKNOWN;
    if (!model->formulation->rest || step->broken[lane] == 0) return FRACAS_OK;
    return find_rest(model, step, lane, energy, rest);
}
