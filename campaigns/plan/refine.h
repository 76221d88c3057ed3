/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaigns for the convergence of another one: every point with a finer mesh, a shorter step,
 * stiffer interfaces or a later end. */
#ifndef FRACAS_CAMPAIGNS_PLAN_REFINE_H
#define FRACAS_CAMPAIGNS_PLAN_REFINE_H

#include "campaigns/campaign.h"

/* FRACAS_REFINE_NOTHING: the campaign with the random numbers of the refined ones. */
typedef enum {
    FRACAS_REFINE_NOTHING,
    FRACAS_REFINE_MESH,
    FRACAS_REFINE_STEP,
    FRACAS_REFINE_BETA,
    FRACAS_REFINE_END,
    FRACAS_NREFINEMENTS
} fracas_refinement;

extern const char *const fracas_refinement_name[FRACAS_NREFINEMENTS]; /* "base", "mesh", ... */
extern const char *const fracas_refinement_doc[FRACAS_NREFINEMENTS];  /* "half the element size" */

typedef struct {
    fracas_campaign *campaign; /* NAME-mesh, points in file order; NULL: no point can be refined */
    size_t *from;              /* its points' numbers in the file */
    double *cost;              /* its points' element-steps, maximum over all replicas */
    size_t left;               /* number of points left out */
    char why[512];             /* reason for the first of them */
} fracas_refined;

/* The campaign file at `path`, with `replicas` for every point (0: the file's), refined:
 *   mesh  mesh.elements x 2, mesh.size / 2 or mesh.divisions x 2: half the element size; own seed
 *   step  time.safety / 2
 *   beta  cohesive.beta x 2, for shells cohesive.beta_shear x 2 as well
 *   end   time.end x 2, and the time.transits, time.quiet or time.multiple of its stop rule
 * All have common random numbers: but for mesh, replica r of a point keeps its strengths, and
 * differences are those of pairs (docs/decisions/converge.md). Left out are points without such a
 * value (a mesh from a file, a law without beta), and those whose refined value is out of range or
 * refused by the engine. Errors as fracas_campaign_read and fracas_campaign_replicas. Cleared by
 * the caller, also after an error. */
FRACAS_MUST_USE fracas_err fracas_refined_create(const char *path, int64_t replicas,
                                                 fracas_refinement what, fracas_refined *refined);
void fracas_refined_clear(fracas_refined *refined);

#endif
