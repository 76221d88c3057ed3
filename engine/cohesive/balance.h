/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The balance of crossings: a traction for the work that the time integration misses where an
 * interface passes a kink of its law T(S) within a step (docs/theory/balance.md).
 *
 * S the trial traction, S_0 that of the step before, dS = S - S_0; at S_k the slope of T goes from
 * a_0 to a_1, y_0 = S_0 - S_k, y = S - S_k, y_0 y < 0:
 *   C = (a_1 - a_0) y_0 y/2                                                             (balance.1)
 *   B = dS - G (T - m)/2,   G = 2 K dt^2/M z^2,  z = 1 - 1/(2 beta), 1 once broken      (balance.2)
 *   e = B C/(B^2 - G C/2)                                                               (balance.3)
 *   only where  B dS > max(1/10, sqrt(G)/2) dS^2,  so that B^2 > 2 G C                  (balance.4)
 */
#ifndef FRACAS_ENGINE_COHESIVE_BALANCE_H
#define FRACAS_ENGINE_COHESIVE_BALANCE_H

#include "engine/cohesive/kernels.h"

/* G/2 of whole and of broken interfaces, the least B/dS, and the lanes whose crossings are
 * balanced: of a body and its time step. */
typedef struct {
    vd whole, broken, least;
    vmask on;
} balance_coupling;

/* `spring` is K [Pa/m], `kick` dt/M summed over both sides [m/(s Pa)], `drift` dt [s], `square`
 * z^2, `on` 1 or 0. */
LANES_FUNCTION balance_coupling balance_couple(vd spring, vd kick, vd drift, vd square, vd on)
{
    const vd half = lanes_set(0.5), broken = half * (spring * kick * drift);
    return (balance_coupling){.whole = broken * square,
                              .broken = broken,
                              .least = lanes_max(lanes_set(0.1), lanes_sqrt(half * broken)),
                              .on = lanes_lt(lanes_set(0.0), on)};
}

/* e [Pa], 0 where no kink is passed; `change` is dS. */
LANES_FUNCTION vd balance_traction(const balance_coupling *c, const line_input *in,
                                   const line_result *it, vd change)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    const vd before = it->trial - change;
    /* closing and opening; the slope of an uncracked interface does not change */
    vd bend = half * (one - it->secant);
    bend = lanes_select(lanes_lt(zero, it->trial), zero - bend, bend);
    vd product = before * it->trial;
    vmask passes = lanes_lt(product, zero);
    /* reloading meets the softening branch; a break is no kink: T stays 0 after it */
    const vmask grows = lanes_and(lanes_lt(in->damage, it->damage), lanes_lt(it->damage, one)),
                softens = lanes_and(grows, lanes_lt(before, it->limit));
    if (__builtin_expect(lanes_any(softens), 0)) {
        const vd past = it->trial - it->limit,
                 falls = lanes_quotient(it->traction - it->held, past),
                 secant = lanes_quotient(it->held, it->limit);
        bend = lanes_select(softens, half * (falls - secant), bend);
        product = lanes_select(softens, (before - it->limit) * past, product);
        passes = lanes_or(passes, softens);
    }
    if (LANES == 1 && !lanes_any(passes))
        return zero;                   /* in many lanes, some pass one in most steps */
    const vd missing = bend * product; /* C */
    const vd half_coupling = lanes_select(lanes_le(one, in->damage), c->broken, c->whole);
    const vd ahead = change - half_coupling * (it->traction - in->mean); /* B */
    passes = lanes_and(lanes_and(passes, c->on),
                       lanes_lt(zero, (ahead - c->least * change) * change));
    const vd extra = ahead * lanes_quotient(missing, ahead * ahead - half_coupling * missing);
    return lanes_select(passes, extra, zero);
}

#endif
