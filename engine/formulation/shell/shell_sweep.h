/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell's sweep: one step of central difference or Hulbert-Chung for all lanes, in one pass
 * over the elements (docs/theory/shell.md).
 *
 * State of a group of lanes, one part after another:
 *   [element][field][lane]    SURFACE_U ..., each SHELL_UNKNOWNS wide (node 0 x, y, z, node 1 x,
 * ...) [interface][field][lane]  the law's fields of each layer of each Gauss point
 *   [strength][lane]          sigma_c [Pa], one of each interface, or of each of its Gauss points
 *   [slot][field][lane]       what an element collects from its interfaces while it is under way:
 * slot = element & window */
#ifndef FRACAS_ENGINE_FORMULATION_SHELL_SHELL_SWEEP_H
#define FRACAS_ENGINE_FORMULATION_SHELL_SHELL_SWEEP_H

#include "engine/element/triangle.h"
#include "engine/formulation/shell/shell_tables.h"
#include "engine/formulation/surface/sweep.h"

/* Of a slot, at each bulk point: the resultants n_xx, n_yy, n_xy [N/m], m_xx, m_yy, m_xy [N], and
 * the strains that symmetrisation works with on each, times weight; then the forces on nodes. */
enum {
    SHELL_RESULTANTS = 6,
    SHELL_SLOT_RESULTANT = 0,
    SHELL_SLOT_EXTRA = SHELL_BULK * SHELL_RESULTANTS,
    SHELL_SLOT_FORCE = 2 * SHELL_BULK * SHELL_RESULTANTS,
    SHELL_SLOT = SHELL_SLOT_FORCE + SHELL_UNKNOWNS
};

/* Where a layer is, by the thickness, and its weight: Simpson's rule  (shell.12). */
#define SHELL_LAYER_PLACES \
    {                      \
        -0.5, 0.0, 0.5     \
    }
#define SHELL_LAYER_WEIGHTS       \
    {                             \
        1.0 / 6, 4.0 / 6, 1.0 / 6 \
    }

/* Everything a sweep needs that is the same for all lanes. */
typedef struct {
    const fracas_shell_tables *tables;
    double thickness;          /* m */
    double c11, c12, c33;      /* N/m: h E/(1 - nu^2), nu c11, h E/(2 (1 + nu)) */
    double d11, d12, d33;      /* N m: h^2/12 of those */
    double normal, tangential; /* 1: k_n and k_t by K of the interface  (membrane.6) */
    double energy, opening;    /* G_c [J/m2], or delta_c [m]: the other is 0 */
    double beta_c, mu_c;       /* 1 */
    int onset_mean, friction;
    int fields,
        point_fields; /* of an element, in units of SHELL_UNKNOWNS; of a layer of a Gauss point */
    int strengths;    /* of an interface: 1, or one for each Gauss point */
    fracas_surface_motion motion;
    int contact; /* SURFACE_OPERATOR: all interfaces broken and in contact; else whole */
} fracas_shell_constants;

/* Places in a group's state, in units of one field's lanes. */
static inline size_t fracas_shell_element_fields(const fracas_shell_constants *c)
{
    return (size_t)c->fields * SHELL_UNKNOWNS;
}
static inline size_t fracas_shell_joint_fields(const fracas_shell_constants *c)
{
    return SHELL_EDGE * SHELL_LAYERS * (size_t)c->point_fields;
}
static inline size_t fracas_shell_joints_at(const fracas_shell_constants *c)
{
    return c->tables->nelements * fracas_shell_element_fields(c);
}
static inline size_t fracas_shell_strengths_at(const fracas_shell_constants *c)
{
    return fracas_shell_joints_at(c) + c->tables->ninterfaces * fracas_shell_joint_fields(c);
}
static inline size_t fracas_shell_slots_at(const fracas_shell_constants *c)
{
    return fracas_shell_strengths_at(c) + c->tables->ninterfaces * (size_t)c->strengths;
}
/* Number of the strength that holds at Gauss point g of an interface. */
static inline size_t fracas_shell_strength_of(const fracas_shell_constants *c, size_t interface,
                                              int g)
{
    return interface * (size_t)c->strengths + (c->strengths > 1 ? (size_t)g : 0);
}
static inline size_t fracas_shell_state_fields(const fracas_shell_constants *c)
{
    return fracas_shell_slots_at(c) + (c->tables->visits.window + 1) * SHELL_SLOT;
}

/* Advances the lanes first .. first + lanes - 1 of the step. */
typedef void fracas_shell_sweep(const fracas_shell_constants *shell, fracas_step *step, int first);

/* Kernels of one instruction set, [law][for 1, 4, 8 lanes]; NULL where there is no such register.
 * The operator's, for one lane alone, leaves M^-1 (-f)(u) where velocities are. */
typedef struct {
    fracas_shell_sweep *sweep[SURFACE_SWEEPS];
} fracas_shell_kernel;

/* ---- what happens at an interface in a step, booked lane by lane: it is rare ---- */

typedef struct {
    int cracks[SHELL_EDGE][SHELL_LAYERS],
        breaks[SHELL_EDGE][SHELL_LAYERS]; /* which points do so in this step */
    int opens, parts; /* the interface's first point cracks, its last one breaks */
} fracas_shell_event;

/* Books the event of lane `lane` of the step, at the times interpolated between the step before and
 * this one  (membrane.12). */
void fracas_shell_book(const fracas_shell_constants *shell, fracas_step *step, int lane,
                       size_t interface, const fracas_shell_event *event);

#endif
