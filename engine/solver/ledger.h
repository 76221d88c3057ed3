/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of one lane: a sum for each energy, and the residual of the balance. */
#ifndef FRACAS_ENGINE_SOLVER_LEDGER_H
#define FRACAS_ENGINE_SOLVER_LEDGER_H

#include "engine/formulation/formulation.h"

#include <stdbool.h>

typedef struct {
    FRACAS_ENERGY_MEMBERS;
    double residual;         /* J, now */
    double largest_residual; /* J, largest absolute value so far */
    double initial;          /* J, energy held at the first step */
    double power;            /* W, of the load */
} fracas_ledger;

/* Takes the energies of `lane` at a step, with
 *   work_n = work_{n-1} + dt (P_{n-1} + P_n)/2 + W_n                                     (bar.13)
 * with the step's own work W_n, and the residual of fracas_energy_residual.
 * `first`: the ledger starts with this step. */
void fracas_ledger_update(fracas_ledger *ledger, const fracas_step *step, int lane, bool first);

#endif
