/* The engine's model of a point of a campaign, with what is drawn for it. */
#ifndef FRACAS_CAMPAIGNS_PLAN_POINT_MODEL_H
#define FRACAS_CAMPAIGNS_PLAN_POINT_MODEL_H

#include "campaigns/campaign.h"
#include "engine/engine.h"

/* fracas_model_create of the point; where the mesh is perturbed, with the moves of its nodes. */
FRACAS_MUST_USE fracas_err fracas_point_model_create(const fracas_campaign *campaign, size_t point, fracas_model **model);

/* The same with another spec: of a shorter mesh, or less time. */
FRACAS_MUST_USE fracas_err fracas_point_model_like(const fracas_campaign *campaign, size_t point, const fracas_spec *spec,
                                                   fracas_model **model);

/* noise[i] = 2 u_i - 1, the move of node i of a chain by the largest one, or of vertex i/2 of a surface along its direction i%2:
 * u_i from the stream of the campaign's seed, the point's hash, replica 0 and FRACAS_PURPOSE_MESH, whatever `count`. All realizations of a
 * point have one mesh. */
void fracas_point_mesh_noise(const fracas_campaign *campaign, size_t point, size_t count, double *noise);

#endif
