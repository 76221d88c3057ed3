/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine's model of a point, its strength field, and its random streams. */
#ifndef FRACAS_CAMPAIGNS_PLAN_POINT_MODEL_H
#define FRACAS_CAMPAIGNS_PLAN_POINT_MODEL_H

#include "campaigns/campaign.h"
#include "engine/engine.h"

/* fracas_model_create of the point, with random moves of the nodes of a perturbed mesh. */
FRACAS_MUST_USE fracas_err fracas_point_model_create(const fracas_campaign *campaign, size_t point,
                                                     fracas_model **model);

/* The same with another spec: a shorter mesh, or less time. */
FRACAS_MUST_USE fracas_err fracas_point_model_like(const fracas_campaign *campaign, size_t point,
                                                   const fracas_spec *spec, fracas_model **model);

/* The field of the point's `strength`, which must outlive it, on the interfaces of its model.
 * Errors as fracas_field_create. */
FRACAS_MUST_USE fracas_err fracas_model_field(const fracas_model *model,
                                              const fracas_strength *strength,
                                              fracas_field **field);

/* Strengths of a realization: rows that fracas_model_interface_positions and a field fill. */
size_t fracas_model_strengths(const fracas_model *model);

/* Volume and area of an interface per strength: equal parts if it has several. */
fracas_extent fracas_model_extent(const fracas_model *model, size_t interface);

/* Factors of the strengths of a model's field. */
typedef struct {
    double mean, least, most; /* 1, 1, 1 without grading */
} fracas_factor_range;

/* Errors as fracas_grading_create. */
FRACAS_MUST_USE fracas_err fracas_model_factors(const fracas_model *model,
                                                const fracas_strength *strength,
                                                fracas_factor_range *range);

/* The stream of a point: (campaign's seed, purpose; point hash, replica), 0 for the hash with
 * common random numbers. */
fracas_stream fracas_point_stream(const fracas_campaign *campaign, size_t point, uint64_t purpose,
                                  uint64_t replica);

/* noise[i] = 2 u_i - 1, relative to the largest move: of node i of a chain, or of vertex i/2 of a
 * surface along its direction i%2. u_i is from the stream of FRACAS_PURPOSE_MESH, replica 0, for
 * any `count`. All realizations of a point have the same mesh. */
void fracas_point_mesh_noise(const fracas_campaign *campaign, size_t point, size_t count,
                             double *noise);

/* Extents of a mesh's interfaces: the means of volume and area, and the least of each, at which
 * strengths with a size effect are largest. */
typedef struct {
    fracas_extent mean, least;
} fracas_extents;
fracas_extents fracas_extents_of(const fracas_model *model);

#endif
