/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chain: elements in a row, an interface between each and the next; what bar and ring have in
 * common.
 *
 * The state of a batch is laid out [group][element][field][lane]: groups of step->lanes lanes one
 * after another. Interface e joins elements e and e+1, and its fields are kept with element e; the
 * last one closes the chain, if it is closed. */
#ifndef FRACAS_ENGINE_FORMULATION_CHAIN_H
#define FRACAS_ENGINE_FORMULATION_CHAIN_H

#include "engine/formulation/formulation.h"

typedef struct {
    int fields;   /* of an element */
    int damage;   /* which of them is delta_max/delta_c of the interface */
    int strength; /* which is its sigma_c [Pa] */
} fracas_chain;

static inline bool fracas_chain_is_closed(const fracas_model *model)
{
    return model->interfaces == model->elements;
}

/* Where the state has this field. */
double *fracas_chain_field(const fracas_chain *chain, const fracas_model *model,
                           const fracas_step *step, size_t element, int field, int lane);

/* As fracas_formulation.strength. */
double *fracas_chain_strength(const fracas_chain *chain, const fracas_model *model,
                              const fracas_step *step, int lane, size_t *stride);

/* FRACAS_USAGE unless the strength [Pa] is positive and finite and, for the law nitsche, lets the
 * longest element soften as slowly as the law asks, K > sigma_c/delta_c  (cohesive.7). */
FRACAS_MUST_USE fracas_err fracas_chain_check_strength(const fracas_model *model, double strength);

/* Number of fragments: a closed chain needs two breaks to have two, an open one is cut in two by
 * the first. */
int64_t fracas_chain_fragment_count(const fracas_model *model, fracas_step *step, int lane);

/* True where the interface on the right of `element` is broken, or there is none. */
bool fracas_chain_is_broken(const fracas_chain *chain, const fracas_model *model,
                            const fracas_step *step, size_t element, int lane);

/* Elements connected by unbroken interfaces (bar.17), labelled, as the step's partition; returns
 * their number. */
size_t fracas_chain_partition(const fracas_chain *chain, const fracas_model *model,
                              fracas_step *step, int lane);

/* The interface rows of a record. */
FRACAS_MUST_USE fracas_err fracas_chain_harvest_interfaces(const fracas_chain *chain,
                                                           const fracas_model *model,
                                                           const fracas_step *step, int lane,
                                                           fracas_record *record);

/* The time step of a chain of elements of these sizes h [m] (NULL: all of model->element_size), of
 * which stiffness and mass per area are E/h and rho h/2 a node; the law is the model's: fills
 * critical_closed, critical_cracked, critical_step and contact (bar.16). A ring's transverse motion
 * is softer: K between nodes, without the elements. */
FRACAS_MUST_USE fracas_err fracas_chain_critical_step(fracas_model *model, const double *size);

#endif
