/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy guard of one lane: whether a realization still computes its model, and until when the
 * numbers of one that does not were final (docs/decisions/energy-guard.md). */
#ifndef FRACAS_ENGINE_SOLVER_GUARD_H
#define FRACAS_ENGINE_SOLVER_GUARD_H

#include "engine/solver/ledger.h"

#define FRACAS_GUARD_SOUND 0.01 /* up to it a run's numbers may be kept */
#define FRACAS_GUARD_QUIET 1.5  /* times the last break's time: fragments are final */
enum { FRACAS_GUARD_START = 16, FRACAS_GUARD_EVERY = 16 }; /* steps */

/* All 0 at first. */
typedef struct {
    double beside;    /* J, of fracas_guard_beside, when it was last computed ... */
    int64_t measured; /* ... at this step ... */
    bool whole;       /* ... of a body without a break */
    int64_t broken;   /* interfaces broken so far ... */
    double broke;     /* s, ... the last of them seen at this time */
    int64_t sound;    /* last step with a sound balance; fragments were final then ... */
    bool final;       /* ... or not */
} fracas_guard;

/* Energy of a lane able to break things, beside all stored and lost ones [J]: the
 * kinetic energy beside the motion of each fragment as a whole (before the first break: beside
 * the rigid part of the body); less the energy of fragments of one element  (fragments.6). */
FRACAS_MUST_USE fracas_err fracas_guard_beside(const fracas_model *model, fracas_step *step,
                                               int lane, double *energy);

/* Shows step number `now` of a lane to its guard. *drifts, from the first break or step
 * FRACAS_GUARD_START on (energies of a body at rest are near 0 at first):
 *   |residual| > tolerance (stored + sinks + beside)                        (bar.15)
 * Such a run no longer computes its model; a law with an open ledger has none to lose. `beside` is
 * computed only where other energies do not explain the residual; it then counts for
 * FRACAS_GUARD_EVERY steps, unless the realization `ends`.
 */
FRACAS_MUST_USE fracas_err fracas_guard_check(fracas_guard *guard, const fracas_ledger *ledger,
                                              const fracas_model *model, fracas_step *step,
                                              int lane, int64_t now, bool ends, bool *drifts);

#endif
