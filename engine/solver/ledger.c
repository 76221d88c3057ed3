/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/ledger.h"

#include <math.h>

void fracas_ledger_update(fracas_ledger *ledger, const fracas_step *step, int lane, bool first)
{
    double before = ledger->power;
    ledger->kinetic = step->kinetic[lane];
    ledger->elastic = step->elastic[lane];
    ledger->cohesive = step->cohesive[lane];
    ledger->dissipated = step->dissipated[lane];
    ledger->dissipated_bending = step->dissipated_bending[lane];
    ledger->created = step->created[lane];
    ledger->power = step->power[lane];
    double held = ledger->kinetic + ledger->elastic + ledger->cohesive + ledger->dissipated;
    if (first) {
        ledger->initial = held;
        ledger->work = ledger->largest_residual = 0;
    } else {
        ledger->work += step->drift[lane] * (0.5 * (before + ledger->power)) +
                        step->work[lane]; /* (bar.13) */
    }
    ledger->residual = held - ledger->created - ledger->work - ledger->initial; /* (bar.14) */
    if (!(fabs(ledger->residual) <= ledger->largest_residual))
        ledger->largest_residual = fabs(ledger->residual);
}

/* (bar.15) */
bool fracas_ledger_drifts(const fracas_ledger *ledger, int64_t step)
{
    double held = ledger->elastic + ledger->cohesive + ledger->dissipated;
    double scale = fmax(fmax(ledger->kinetic, held), fabs(ledger->work));
    return step >= FRACAS_ENERGY_START && fabs(ledger->residual) > FRACAS_ENERGY_TOLERANCE * scale;
}
