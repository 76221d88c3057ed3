/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What membranes and shells do alike with their mesh, strengths and fragments. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_COMMON_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_COMMON_H

#include "engine/formulation/formulation.h"

/* A perturbed mesh has its random numbers. */
FRACAS_MUST_USE fracas_err fracas_surface_check_noise(const fracas_mesh *mesh);
/* cohesive.beta makes the operator of such elements positive. */
FRACAS_MUST_USE fracas_err fracas_surface_check_beta(const fracas_model *model);
/* Something moves: not all starts at rest, or edges are held that move (`held`). */
FRACAS_MUST_USE fracas_err fracas_surface_check_motion(const fracas_model *model, bool held);
/* As check_strength and interface_volume of a formulation. */
FRACAS_MUST_USE fracas_err fracas_surface_check_strength(const fracas_model *model,
                                                         double strength);
double fracas_surface_interface_volume(const fracas_model *model, size_t interface);

/* 1/h_s = (|e|/A- + |e|/A+)/2 of an interface [1/m]  (membrane.5) */
double fracas_surface_inverse_size(const struct fracas_surface *surface, size_t interface);
/* model->element_size, longest from its interfaces, from a mass that is known. */
void fracas_surface_measure_model(fracas_model *model);

/* Component i of the velocity that a node at x starts with [m/s]: that of the expansion, everywhere
 * or where it is held, none where it is fixed  (membrane.17) */
double fracas_surface_start_velocity(const fracas_loading *loading, const double *x, int i,
                                     bool held, bool fixed);

/* D of an interface of a lane: the mean over its points by their weights, 1 only where all are
 * broken  (membrane.18) */
typedef double fracas_surface_damage(const fracas_model *model, const fracas_step *step,
                                     size_t interface, int lane);

/* Adds the nodes of an element to its fragment's sums. */
typedef void fracas_surface_add_element(const fracas_model *model, const fracas_step *step,
                                        int lane, size_t element, fracas_fragment_sums *sums);

/* As fragment_count and harvest of a formulation  (membrane.19). */
int64_t fracas_surface_fragment_count(const fracas_model *model, fracas_step *step, int lane,
                                      fracas_surface_damage *damage);
FRACAS_MUST_USE fracas_err fracas_surface_harvest(const fracas_model *model, fracas_step *step,
                                                  int lane, fracas_surface_damage *damage,
                                                  fracas_surface_add_element *add,
                                                  fracas_record *record);

#endif
