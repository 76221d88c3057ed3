/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/ledger.h"

#include <math.h>

void fracas_ledger_update(fracas_ledger *ledger, const fracas_step *step, int lane, bool first)
{
    double before = ledger->power;
    for (int e = 0; e < FRACAS_ENERGIES; e++)
        if (fracas_energies[e].role != FRACAS_ROLE_LOAD) ledger->energy[e] = step->energy[e][lane];
    ledger->power = step->power[lane];
    if (first) {
        ledger->work = ledger->largest_residual = 0; /* energy that onsets create is no start's */
        ledger->initial = fracas_energy_residual(ledger->energy, 0);
    } else { /* (bar.13) */
        ledger->work += step->drift[lane] * (0.5 * (before + ledger->power)) + step->work[lane];
    }
    ledger->residual = fracas_energy_residual(ledger->energy, ledger->initial); /* (bar.14) */
    if (!(fabs(ledger->residual) <= ledger->largest_residual))
        ledger->largest_residual = fabs(ledger->residual);
}
