/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rings with Stershic's algorithm whose state is set between fracas_batch_begin and the first step,
 * which does not drift: what the state says is what that step sees. One lane. */
#ifndef FRACAS_TESTS_SUPPORT_STERSHIC_H
#define FRACAS_TESTS_SUPPORT_STERSHIC_H

#include "tests/support/ring.h"

#include "engine/formulation/chain/ring_sweep.h"
#include "tests/support/test.h"

#define YOUNG 275e9
#define DENSITY 2750.0

/* At rest, with no load: nothing moves but by what the state holds. */
static inline fracas_spec at_rest(int64_t elements)
{
    fracas_spec spec = ring_stershic(elements, 1e4, 1e-3);
    spec.loading = (fracas_loading){.type = &fracas_loading_initial_velocity};
    return spec;
}

static inline double *at(const one_run *run, size_t element, int field)
{
    return run->batch->step.state + element % run->n * RING_FIELDS_STERSHIC + field;
}

/* Along the ring, so many half elements from its start. */
static inline void along_ring(const one_run *run, size_t halves, double t[2])
{
    const double angle = M_PI * (double)(halves % (2 * run->n)) / (double)run->n;
    t[0] = -sin(angle);
    t[1] = cos(angle);
}

/* Directions of element e at the start, and of the vertex of interface e. */
static inline void chord_of(const one_run *run, size_t e, double t[2])
{
    along_ring(run, 2 * e + 1, t);
}

static inline void normal_of(const one_run *run, size_t e, double n[2])
{
    along_ring(run, 2 * e + 2, n);
}

/* Gives element e this stress [Pa], by moving its nodes apart along its chord: nodes of closed
 * links are no longer at one place, which the first step does not look at. */
static inline void set_stress(const one_run *run, size_t e, double stress)
{
    double t[2];
    chord_of(run, e, t);
    for (int i = 0; i < 2; i++) {
        *at(run, e, RING_U_LEFT + i) -= 0.5 * run->h * stress / YOUNG * t[i];
        *at(run, e, RING_U_RIGHT + i) += 0.5 * run->h * stress / YOUNG * t[i];
    }
}

/* Gives all elements this stress [Pa] by expanding the ring; nodes of a link stay at one place. */
static inline void expand(const one_run *run, double stress)
{
    const double pi = 3.14159265358979323846, radius = run->h / (2 * sin(pi / (double)run->n));
    for (size_t e = 0; e < run->n; e++)
        for (size_t side = 0; side < 2; side++) {
            const double theta = 2 * pi * (double)((e + side) % run->n) / (double)run->n;
            *at(run, e, side ? RING_U_RIGHT : RING_U_LEFT) = stress / YOUNG * radius * cos(theta);
            *at(run, e, side ? RING_U_RIGHT + 1 : RING_U_LEFT + 1) = stress / YOUNG * radius *
                                                                     sin(theta);
        }
}

/* Opens the jump of interface e by moving element e + 1 along the interface's normal, unstrained.
 */
static inline void set_jump(const one_run *run, size_t e, double q)
{
    double n[2];
    normal_of(run, e, n);
    for (int field = RING_U_LEFT; field < RING_V_LEFT; field++)
        *at(run, e + 1, field) += q * n[field & 1];
}

static inline double *link_of(const one_run *run, size_t e)
{
    return at(run, e, RING_LAW);
}

/* What the elements of interface e pull it apart with along its normal, as the step saw it [Pa]. */
static inline double pull_of(const one_run *run, size_t e)
{
    return *at(run, e, RING_PULL);
}

#endif
