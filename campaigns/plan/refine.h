/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The campaign beside a campaign that shows what its numbers owe to the discretisation: every point
 * with a finer mesh, a shorter step or stiffer interfaces, however its values came about. */
#ifndef FRACAS_CAMPAIGNS_PLAN_REFINE_H
#define FRACAS_CAMPAIGNS_PLAN_REFINE_H

#include "campaigns/campaign.h"

/* FRACAS_REFINE_NOTHING is the campaign as it is, with the random numbers that the others are
 * compared by. */
typedef enum {
    FRACAS_REFINE_NOTHING,
    FRACAS_REFINE_MESH,
    FRACAS_REFINE_STEP,
    FRACAS_REFINE_BETA,
    FRACAS_NREFINEMENTS
} fracas_refinement;

extern const char
    *const fracas_refinement_name[FRACAS_NREFINEMENTS]; /* "base", "mesh", "step", "beta" */
extern const char *const fracas_refinement_doc[FRACAS_NREFINEMENTS]; /* "half the element size" */

typedef struct {
    fracas_campaign *campaign; /* NAME-mesh, its points in the order of the file's; NULL if no point
                                  can be refined so */
    size_t *from;              /* of each of its points, the point of the file */
    double *cost;              /* of each of its points, element-steps of all replicas, at most */
    size_t left;               /* points of the file that cannot be refined so */
    char why[512];             /* for the first of them */
} fracas_refined;

/* The campaign file at `path`, with `replicas` for every point (0: the file's), refined:
 *   mesh: mesh.elements x 2, or mesh.size / 2, or mesh.divisions x 2, h being half; a seed of its
 * own step: time.safety / 2 beta: cohesive.beta x 2, of a shell cohesive.beta_shear x 2, too (the
 * critical time step follows) All with common random numbers: with step and beta replica r of a
 * point has the very strengths that it has without, so that differences are those of pairs
 * (docs/decisions/converge.md). A point that has no such value (a mesh from a file, a law without
 * beta), or whose refined value is out of its range or refused by the engine (strengths of each
 * interface from a file), is left out. Errors as fracas_campaign_read and fracas_campaign_replicas.
 * Cleared by the caller, also after an error. */
FRACAS_MUST_USE fracas_err fracas_refined_create(const char *path, int64_t replicas,
                                                 fracas_refinement what, fracas_refined *refined);
void fracas_refined_clear(fracas_refined *refined);

#endif
