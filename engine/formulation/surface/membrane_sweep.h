/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane's sweep: one step of central difference or Hulbert-Chung for all lanes, in one pass
 * over the elements (docs/theory/membrane.md).
 *
 * State of a group of lanes, one part after another:
 *   [element][field][lane]    SURFACE_U ..., each 2 MEMBRANE_NODES wide (node 0 x, y, node 1 x,
 * ...) [interface][field][lane]  the law's fields of each Gauss point [strength][lane] sigma_c
 * [Pa], one of each interface, or of each of its Gauss points [slot][field][lane]       what an
 * element collects from its interfaces while it is under way: slot = element & window */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_SWEEP_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_SWEEP_H

#include "engine/element/triangle.h"
#include "engine/formulation/surface/sweep.h"
#include "engine/formulation/surface/membrane_tables.h"

/* Of a slot: at each bulk point the stress and what symmetrisation adds to it (xx, yy, xy), then
 * the forces of interfaces. */
#define MEMBRANE_SLOT_STRESS 0
#define MEMBRANE_SLOT_EXTRA(order) (3 * MEMBRANE_BULK(order))
#define MEMBRANE_SLOT_FORCE(order) (6 * MEMBRANE_BULK(order))
#define MEMBRANE_SLOT(order) (6 * MEMBRANE_BULK(order) + 2 * MEMBRANE_NODES(order))

/* Everything a sweep needs that is the same for all lanes. */
typedef struct {
    const fracas_membrane_tables *tables;
    double c11, c12, c33;      /* Pa: E/(1 - nu^2), nu c11, E/(2 (1 + nu)) */
    double normal, tangential; /* 1: k_n and k_t by K of the interface  (membrane.6) */
    double energy, opening;    /* G_c [J/m2], or delta_c [m]: the other is 0 */
    double beta_c, mu_c;       /* 1 */
    int flux;                  /* the law's trait */
    int onset_mean, friction;
    int fields, point_fields; /* of an element, in units of 2 MEMBRANE_NODES; of a Gauss point */
    int strengths;            /* of an interface: 1, or one for each Gauss point */
    double speed, ramp;       /* rad/s, s: w = speed min(1, t/ramp) */
    fracas_surface_motion motion;
    int contact; /* SURFACE_OPERATOR: all interfaces broken and in contact; else whole */
} fracas_membrane_constants;

/* Places in a group's state, in units of one field's lanes. */
static inline size_t fracas_membrane_element_fields(const fracas_membrane_constants *c)
{
    return (size_t)c->fields * 2 * (size_t)MEMBRANE_NODES(c->tables->order);
}
static inline size_t fracas_membrane_joint_fields(const fracas_membrane_constants *c)
{
    return (size_t)MEMBRANE_EDGE(c->tables->order) * (size_t)c->point_fields;
}
static inline size_t fracas_membrane_joints_at(const fracas_membrane_constants *c)
{
    return c->tables->nelements * fracas_membrane_element_fields(c);
}
static inline size_t fracas_membrane_strengths_at(const fracas_membrane_constants *c)
{
    return fracas_membrane_joints_at(c) + c->tables->ninterfaces * fracas_membrane_joint_fields(c);
}
static inline size_t fracas_membrane_slots_at(const fracas_membrane_constants *c)
{
    return fracas_membrane_strengths_at(c) + c->tables->ninterfaces * (size_t)c->strengths;
}
/* Number of the strength that holds at Gauss point g of an interface. */
static inline size_t fracas_membrane_strength_of(const fracas_membrane_constants *c,
                                                 size_t interface, int g)
{
    return interface * (size_t)c->strengths + (c->strengths > 1 ? (size_t)g : 0);
}
static inline size_t fracas_membrane_state_fields(const fracas_membrane_constants *c)
{
    return fracas_membrane_slots_at(c) +
           (c->tables->visits.window + 1) * (size_t)MEMBRANE_SLOT(c->tables->order);
}

/* Advances the lanes first .. first + lanes - 1 of the step. */
typedef void fracas_membrane_sweep(const fracas_membrane_constants *membrane, fracas_step *step,
                                   int first);

/* Kernels of one instruction set, [law][order - 1][for 1, 4, 8 lanes]; NULL where there is no such
 * register. The operator's, for one lane alone, leaves M^-1 (-f)(u) where velocities are. */
typedef struct {
    fracas_membrane_sweep *sweep[SURFACE_SWEEPS][2];
} fracas_membrane_kernel;

/* ---- what happens at an interface in a step, booked lane by lane: it is rare ---- */

typedef struct {
    int cracks[FRACAS_EDGE_MOST],
        breaks[FRACAS_EDGE_MOST]; /* which Gauss points do so in this step */
    int opens, parts;             /* the interface's first point cracks, its last one breaks */
} fracas_membrane_event;

/* Books the event of lane `lane` of the step, at the times interpolated between the step before and
 * this one (membrane.12). */
void fracas_membrane_book(const fracas_membrane_constants *membrane, fracas_step *step, int lane,
                          size_t interface, const fracas_membrane_event *event);

#endif
