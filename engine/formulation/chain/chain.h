/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chain: elements in a row, an interface between each and the next. Common to bar and ring.
 *
 * The state of a batch is laid out [group][element][field][lane]: groups of step->lanes lanes one
 * after another. Interface e joins elements e and e+1, and its fields are kept with element e; the
 * last one closes the chain, if it is closed. */
#ifndef FRACAS_ENGINE_FORMULATION_CHAIN_H
#define FRACAS_ENGINE_FORMULATION_CHAIN_H

#include "engine/formulation/formulation.h"

typedef struct fracas_chain {
    int fields;    /* fields of an element */
    int damage;    /* number of the field delta_max/delta_c of the interface; behind it are ... */
    int strength;  /* ... sigma_c [Pa], and ... */
    int law;       /* ... the law's constant */
    double open;   /* value of `law` at a link that has opened; of laws without flux */
    double barred; /* the same at an interface that can never open; 0: none has it */
} fracas_chain;

/* Fills elements, interfaces, lengths and mass of a model with elements of one length.
 * FRACAS_USAGE for fewer elements than `least` or more than 1e8. */
FRACAS_MUST_USE fracas_err fracas_chain_model_init(fracas_model *model, const fracas_chain *chain,
                                                   int64_t least);

static inline bool fracas_chain_is_closed(const fracas_model *model)
{
    return model->interfaces == model->elements;
}

/* Open, with ends that move by themselves; with ends that the load moves. */
bool fracas_chain_is_free(const fracas_model *model);
static inline bool fracas_chain_is_held(const fracas_model *model)
{
    return !fracas_chain_is_closed(model) && !fracas_chain_is_free(model);
}

/* From free ends to the walls beyond at the start [m]; NaN: there are none. */
double fracas_chain_gap(const fracas_model *model);

/* Stiffness of contact over E/h; 1 for laws that have another measure. */
double fracas_chain_contact_factor(const fracas_spec *spec);

/* Element or vertex after e, around a closed chain. */
static inline size_t fracas_chain_next(const fracas_model *model, size_t e)
{
    return e + 1 < model->elements ? e + 1 : 0;
}

/* Length of an element [m]. */
static inline double fracas_chain_size(const fracas_model *model, size_t e)
{
    return model->sizes ? model->sizes[e] : model->element_size;
}

/* z^2 = (1 - 1/(2 beta))^2, of the factor beta of E/h  (balance.2). */
static inline double fracas_chain_whole(double beta)
{
    return (1 - 0.5 / beta) * (1 - 0.5 / beta);
}

/* Place of a field in the state. */
double *fracas_chain_field(const fracas_model *model, const fracas_step *step, size_t element,
                           int field, int lane);

/* As the functions of fracas_formulation; lane_init leaves all 0 but strengths and constants. */
double fracas_chain_interface_volume(const fracas_model *model, size_t e);
size_t fracas_chain_state_size(const fracas_model *model);
double *fracas_chain_strength(const fracas_model *model, const fracas_step *step, int lane,
                              size_t *stride);
void fracas_chain_lane_init(const fracas_model *model, const fracas_step *step, int lane);

#define FRACAS_CHAIN_FORMULATION                                                                 \
    .safety = 0.25, .interface_volume = fracas_chain_interface_volume,                           \
    .state_size = fracas_chain_state_size, .strength = fracas_chain_strength,                    \
    .count = fracas_chain_count, .partition = fracas_chain_partition, .rest = fracas_chain_rest, \
    .element_nodes = fracas_chain_element_nodes, .add_cracks = fracas_chain_add_cracks,          \
    .interface_nodes = fracas_chain_interface_nodes, .stress = {{"stress", 1}}

/* FRACAS_USAGE unless the strength [Pa], for a law with flux, lets the longest element soften as
 * slowly as the law asks, K > sigma_c/delta_c  (cohesive.7). */
FRACAS_MUST_USE fracas_err fracas_chain_check_strength(const fracas_model *model, double strength);

/* A closed chain needs two breaks to have two fragments, an open one is cut in two by the first. */
FRACAS_MUST_USE fracas_err fracas_chain_count(const fracas_model *model, fracas_step *step,
                                              int lane, fracas_census *census);

/* (settled.3) to (settled.6), of a chain with a break; energies are by the partition's labels. */
FRACAS_MUST_USE fracas_err fracas_chain_rest(const fracas_model *model, const fracas_step *step,
                                             int lane, const double *energy,
                                             const fracas_fragment_sums *element,
                                             fracas_rest *rest);

/* True where the interface on the right of `element` is broken, or there is none. */
bool fracas_chain_is_broken(const fracas_model *model, const fracas_step *step, size_t element,
                            int lane);

/* Elements connected by unbroken interfaces (bar.17), labelled, as the step's partition; returns
 * their number. */
size_t fracas_chain_partition(const fracas_model *model, fracas_step *step, int lane);

/* Adds a straight element between two ends [m], of this mass [kg], to its fragment's matter; its
 * cross-section counts as a square, since only the area is known. */
void fracas_chain_add_segment(const fracas_spec *spec, double mass, const double ends[2][3],
                              fracas_fragment_matter *matter);

/* As the functions of fracas_formulation. */
size_t fracas_chain_element_nodes(const fracas_model *model);
size_t fracas_chain_interface_nodes(const fracas_model *model);
void fracas_chain_add_cracks(const fracas_model *model, const fracas_step *step, int lane,
                             fracas_fragment *fragment);

/* Takes the point of element e nearest to `place` where it is nearer than the spot, not only by a
 * rounding; `ends` are the element's [m]. Element 0 is taken in any case. */
void fracas_chain_locate(const fracas_model *model, size_t e, const double ends[2][3],
                         const double place[3], fracas_spot *spot);

/* Fills an interface's fields but its opening; elements have their places. */
void fracas_chain_fill_interface(const fracas_model *model, const fracas_step *step, int lane,
                                 size_t interface, fracas_fields *fields);

/* The interface rows of a record, if they are kept. */
FRACAS_MUST_USE fracas_err fracas_chain_harvest_interfaces(const fracas_model *model,
                                                           const fracas_step *step, int lane,
                                                           fracas_record *record);

/* Fills critical_closed, critical_cracked and critical_step of the model: stiffness and mass per
 * area are E/h and rho h/2 a node, the law is the model's (bar.16). A ring's transverse motion is
 * softer: K between nodes, without the elements. */
FRACAS_MUST_USE fracas_err fracas_chain_critical_step(fracas_model *model);

#endif
