/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of one lane: every term accumulated on its own, the residual is what they miss
 * by. */
#ifndef FRACAS_ENGINE_SOLVER_LEDGER_H
#define FRACAS_ENGINE_SOLVER_LEDGER_H

#include "engine/formulation/formulation.h"

#include <stdbool.h>

typedef struct {
    double kinetic, elastic, cohesive, dissipated, created, work; /* J */
    double dissipated_bending;                                    /* J, part of dissipated */
    double residual;                                              /* J, now */
    double largest_residual; /* J, of its absolute values so far */
    double initial;          /* J, kinetic + elastic + cohesive + dissipated of the first step */
    double power;            /* W, of the load */
} fracas_ledger;

/* Takes the step's energies of `lane`, with
 *   work_n = work_{n-1} + dt (P_{n-1} + P_n)/2 + W_n, W_n the step's own account (bar.13) residual
 * = kinetic + elastic + cohesive + dissipated - created - work - initial               (bar.14)
 * `first`: the step that the ledger starts with. */
void fracas_ledger_update(fracas_ledger *ledger, const fracas_step *step, int lane, bool first);

/* From the step FRACAS_ENERGY_START on, true when |residual| exceeds FRACAS_ENERGY_TOLERANCE of the
 * largest of kinetic, stored and dissipated energy, and work: such a run computes no longer what it
 * says  (bar.15). In the first steps of a body at rest all energies are near 0, and so is the truth
 * that they could be compared with. */
#define FRACAS_ENERGY_TOLERANCE 0.05
#define FRACAS_ENERGY_START 16
bool fracas_ledger_drifts(const fracas_ledger *ledger, int64_t step);

#endif
