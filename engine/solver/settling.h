/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How final the count of a lane's fragments is (docs/theory/settled.md). */
#ifndef FRACAS_ENGINE_SOLVER_SETTLING_H
#define FRACAS_ENGINE_SOLVER_SETTLING_H

#include "engine/formulation/formulation.h"
#include "engine/solver/ledger.h"

#include <stdbool.h>

enum { FRACAS_LOOKS = 8 /* in each doubling of the time since onset */ };

/* All 0 at first. */
typedef struct {
    int64_t parted;                 /* count before anything breaks, beyond 1 */
    int64_t looks;                  /* so far, look j from dt 2^(j/8) after the onset on */
    int64_t seen[FRACAS_LOOKS + 1]; /* count at look j, at [j % 9]; held fragments left out */
    double transits, growth;        /* k and Delta when they were last computed */
} fracas_settling;

/* True if a look is due at `since` [s] after the first onset (NaN: none yet), of time step dt. */
bool fracas_settling_due(const fracas_settling *settling, double since, double step);

/* Notes a census and computes k and Delta  (settled.1), (settled.2); all looks until now are due.
 */
void fracas_settling_look(fracas_settling *settling, const fracas_model *model, double since,
                          const fracas_census *census);

/* Energy of a lane beside the motion of each fragment as a rigid body [J], and the breaks to come,
 * unknown (NaN) before the first. Labels the partition. */
FRACAS_MUST_USE fracas_err fracas_settling_energies(const fracas_model *model, fracas_step *step,
                                                    int lane, const fracas_ledger *ledger,
                                                    double *vibrating, fracas_rest *rest);

#endif
