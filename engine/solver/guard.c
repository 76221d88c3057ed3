/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/guard.h"

#include "base/own.h"
#include "engine/cohesive/law.h"
#include "engine/solver/pieces.h"

#include <float.h>
#include <math.h>

/* (fragments.6) */
fracas_err fracas_guard_beside(const fracas_model *model, fracas_step *step, int lane,
                               double *energy)
{
    const bool whole = step->broken[lane] == 0;
    FRACAS_CLEARED(fracas_pieces) pieces = {0};
    TRY(fracas_pieces_find(model, step, lane, whole ? model->rigid_part : FRACAS_MOTION_HOMOGENEOUS,
                           &pieces));
    *energy = 0;
    for (size_t f = 0; f < pieces.count; f++) {
        const fracas_fragment_sums *of = &pieces.beside[f];
        *energy += !whole && of->elements == 1 ? -of->strain_energy : of->kinetic;
    }
    return FRACAS_OK;
}

/* Remembers the last step with a sound balance, and whether fragments were final then: nothing had
 * broken over the last third of the time. */
static void note(fracas_guard *guard, const fracas_step *step, int lane, int64_t now, bool sound)
{
    if (step->broken[lane] > guard->broken) {
        guard->broken = step->broken[lane];
        guard->broke = step->time[lane];
    }
    if (!sound) return;
    guard->sound = now;
    guard->final = guard->broken > 0 && step->time[lane] >= FRACAS_GUARD_QUIET * guard->broke;
}

/* (bar.15) */
fracas_err fracas_guard_check(fracas_guard *guard, const fracas_ledger *ledger,
                              const fracas_model *model, fracas_step *step, int lane, int64_t now,
                              bool ends, bool *drifts)
{
    const bool whole = step->broken[lane] == 0;
    const double held = fracas_energy_held(ledger->energy, 1), /* all but kinetic */
        sure = whole ? held : fracas_energy_lost(ledger->energy), residual = fabs(ledger->residual);
    *drifts = false;
    note(guard, step, lane, now, residual <= FRACAS_GUARD_SOUND * sure);
    if (fracas_law_of(&model->spec)->open_ledger) return FRACAS_OK;
    if ((whole && now < FRACAS_GUARD_START) || residual <= model->tolerance * sure)
        return FRACAS_OK;
    const bool fresh = guard->measured > 0 && guard->whole == whole &&
                       now < guard->measured + FRACAS_GUARD_EVERY;
    if (fresh && !ends && residual <= model->tolerance * (held + guard->beside)) return FRACAS_OK;
    TRY(fracas_guard_beside(model, step, lane, &guard->beside));
    guard->measured = now;
    guard->whole = whole;
    /* Idle motion may have many times the elastic energy of a whole body: the rounding of its sum,
     * and of the load's work over all steps, is no drift. */
    const double terms = (double)model->elements + (double)now,
                 rounding = whole ? DBL_EPSILON * terms * fabs(ledger->kinetic) : 0;
    *drifts = !(residual <= model->tolerance * (held + guard->beside) + rounding);
    return FRACAS_OK;
}
