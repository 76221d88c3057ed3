/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces of triangles without common nodes: the common part of membranes and shells
 * (docs/theory/membrane.md).
 *
 * The bodies differ in strains, fluxes, jumps and inertia. A body describes itself to the host by a
 * fracas_surface_body, and to the sweep by its kernel (engine/formulation/surface/kernel.h).
 */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_SURFACE_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_SURFACE_H

#include "engine/formulation/surface/division.h"
#include "engine/formulation/surface/traits.h"

/* Where the state of lane `lane` has a field, counted from the start of its group's. */
double *fracas_surface_field(const fracas_step *step, size_t field, int lane);
/* The operator K of all interfaces whole, or all broken and pressed together:
 *   acceleration = -M^-1 K u, for [element][unknown]; held components: 0
 * `apply` may be called any number of times between open and close. */
typedef struct fracas_surface_operator fracas_surface_operator;
FRACAS_MUST_USE fracas_err fracas_surface_operator_open(const fracas_model *model, int contact,
                                                        fracas_surface_operator **op);
void fracas_surface_operator_apply(fracas_surface_operator *op, const double *u,
                                   double *acceleration);
void fracas_surface_operator_close(fracas_surface_operator *op); /* NULL is allowed */
FRACAS_OWNER(fracas_surface_operator, fracas_surface_operator_close)

/* The model's critical steps, dt_c = Omega_c/omega_max of both operators  (membrane.16). */
FRACAS_MUST_USE fracas_err fracas_surface_critical_step(fracas_model *model);

/* 1/h_s = (|e|/A- + |e|/A+)/2 of an interface [1/m]  (membrane.5) */
double fracas_surface_inverse_size(const fracas_surface *surface, size_t interface);

/* ---- sums ---- */

/* w(t)^2, w = speed min(1, t/ramp): 0 where no body force acts [1/s2]. */
double fracas_surface_spin(const fracas_surface_constants *constants, double time);
/* s(t) of a motion, 0 to tables->motions - 1 [m]  (loads.6) */
double fracas_surface_path(const fracas_surface_constants *constants, int motion, double time);
/* After a sweep: sums of all blocks to energies [J], those of the potential (membrane.8),
 * (shell.11), power [W] and work [J]. */
void fracas_surface_totals(const fracas_surface_constants *constants, fracas_step *step);

/* ---- events: onset and break of points within a step, lane by lane; they are rare ---- */

typedef struct {
    size_t interface;
    int lane;                 /* the step's */
    const double *element[2]; /* its elements' fields in that lane ... */
    const double *fields;     /* ... and its own */
    int cracks[SURFACE_POINTS_MOST], breaks[SURFACE_POINTS_MOST]; /* by point */
    int opens, parts; /* the interface's first point cracks, its last one breaks */
} fracas_surface_event;

/* Counts an event, and keeps the times interpolated between the step before and this one
 * (membrane.12). Parts may call it at once. */
void fracas_surface_record_event(const fracas_surface_constants *constants, fracas_step *step,
                                 const fracas_surface_event *event);

/* ---- points of elements ---- */

/* Values of the shape functions, place [m], dx/dxi and dx/deta [m] of element e at (xi, eta). */
void fracas_surface_at(const fracas_surface *surface, size_t e, double xi, double eta,
                       double shape[6], double place[3], double base[2][3]);

/* ---- start ---- */

/* By the section `initial`: velocity [m/s], 0 of held components, and displacement [m] of unknown i
 * of element e  (initial.1), (initial.4) */
double fracas_surface_initial_velocity(const fracas_model *model, size_t e, size_t i);
double fracas_surface_initial_displacement(const fracas_model *model, size_t e, size_t i);
/* FRACAS_USAGE for stresses in a bent body, strains across a flat one, velocities of no node, half
 * waves shorter than two edges, and velocities or shear across a plane of symmetry. */
FRACAS_MUST_USE fracas_err fracas_surface_check_initial(const fracas_model *model);

/* ---- broken interfaces ---- */

/* All its points are. */
bool fracas_surface_is_broken(const fracas_surface_constants *constants, const fracas_step *step,
                              size_t interface, int lane);
/* An interface as a record has it; times are NaN where none are kept. */
fracas_interface_row fracas_surface_interface_row(const fracas_model *model,
                                                  const fracas_surface_constants *constants,
                                                  const fracas_step *step, size_t interface,
                                                  int lane);

/* ---- functions of the formulations ---- */

FRACAS_MUST_USE fracas_err fracas_surface_model_init(fracas_model *model);
void fracas_surface_part_notch(fracas_model *model);
FRACAS_MUST_USE fracas_err fracas_surface_check_strength(const fracas_model *model,
                                                         double strength);
double fracas_surface_interface_volume(const fracas_model *model, size_t interface);
size_t fracas_surface_state_size(const fracas_model *model);
size_t fracas_surface_parts_most(const fracas_model *model);
FRACAS_MUST_USE fracas_err fracas_surface_model_divide(const fracas_model *model, size_t parts,
                                                       fracas_division *division);
double *fracas_surface_strength(const fracas_model *model, const fracas_step *step, int lane,
                                size_t *stride);
void fracas_surface_lane_init(const fracas_model *model, const fracas_step *step, int lane);
void fracas_surface_advance(const fracas_model *model, fracas_step *step);
FRACAS_MUST_USE fracas_err fracas_surface_count(const fracas_model *model, fracas_step *step,
                                                int lane, fracas_census *census);
size_t fracas_surface_partition(const fracas_model *model, fracas_step *step, int lane);
void fracas_surface_add_up(const fracas_model *model, const fracas_step *step, int lane,
                           const fracas_fragment_motion *motion, fracas_fragment_sums *sums);
FRACAS_MUST_USE fracas_err fracas_surface_harvest(const fracas_model *model, fracas_step *step,
                                                  int lane, fracas_record *record);

void fracas_surface_add_matter(const fracas_model *model, const fracas_step *step, int lane,
                               const uint32_t *element, size_t count,
                               fracas_fragment_matter *matter, double (*node)[3]);
void fracas_surface_add_cracks(const fracas_model *model, const fracas_step *step, int lane,
                               fracas_fragment *fragment);
size_t fracas_surface_element_nodes(const fracas_model *model);
size_t fracas_surface_interface_nodes(const fracas_model *model);
void fracas_surface_fields(const fracas_model *model, const fracas_step *step, int lane,
                           fracas_fields *fields);
/* Fills the holds of a division. */
FRACAS_MUST_USE fracas_err fracas_surface_holds_fill(const fracas_model *model,
                                                     fracas_surface_division *division);
size_t fracas_surface_held_edges(const fracas_model *model, int64_t tag[FRACAS_HOLDERS]);
void fracas_surface_reactions(const fracas_model *model, const fracas_step *step, int lane,
                              double (*force)[3]);
/* The point of element e at `place`; false if the element is elsewhere. */
bool fracas_surface_has(const fracas_surface *surface, size_t e, const double place[3],
                        fracas_spot *spot);
void fracas_surface_locate(const fracas_model *model, const double place[3], fracas_spot *spot);
void fracas_surface_motion_at(const fracas_model *model, const fracas_step *step, int lane,
                              const fracas_spot *spot, double displacement[3], double velocity[3]);

/* All members of a formulation of surfaces but `stress` and `kind`, whose traits are the body. */
#define FRACAS_SURFACE_FORMULATION                                                              \
    .model_init = fracas_surface_model_init, .part_notch = fracas_surface_part_notch,           \
    .check_strength = fracas_surface_check_strength,                                            \
    .interface_volume = fracas_surface_interface_volume,                                        \
    .plan_destroy = fracas_surface_tables_destroy, .state_size = fracas_surface_state_size,     \
    .parts_most = fracas_surface_parts_most, .divide = fracas_surface_model_divide,             \
    .division_destroy = fracas_surface_division_destroy, .strength = fracas_surface_strength,   \
    .lane_init = fracas_surface_lane_init, .advance = fracas_surface_advance,                   \
    .count = fracas_surface_count, .partition = fracas_surface_partition,                       \
    .add_up = fracas_surface_add_up, .harvest = fracas_surface_harvest,                         \
    .element_nodes = fracas_surface_element_nodes, .add_matter = fracas_surface_add_matter,     \
    .add_cracks = fracas_surface_add_cracks, .interface_nodes = fracas_surface_interface_nodes, \
    .fields = fracas_surface_fields, .locate = fracas_surface_locate,                           \
    .motion_at = fracas_surface_motion_at, .held_edges = fracas_surface_held_edges,             \
    .reactions = fracas_surface_reactions

#endif
