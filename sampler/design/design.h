/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Designs of experiments: where in the unit cube the points of a campaign lie, one coordinate for
 * each uncertain parameter. */
#ifndef FRACAS_SAMPLER_DESIGN_H
#define FRACAS_SAMPLER_DESIGN_H

#include "base/err.h"
#include "base/param.h"
#include "sampler/probability.h"

#include <stddef.h>
#include <stdint.h>

/* The types: random, latin-hypercube, sobol. */
extern const fracas_kind *const fracas_design_types[3];

typedef struct {
    const fracas_kind *type;
    uint64_t seed;             /* the campaign's */
    size_t points, parameters; /* at least 1 each */
    const uint64_t *name;      /* [parameters], all different: the names of their random numbers */
    const double *correlation; /* [parameters][parameters], of the scores Phi^-1(u); NULL: none */
} fracas_design;

/* How many parameters a design of this type can have: 40 with sobol, else SIZE_MAX. */
size_t fracas_design_most_parameters(const fracas_kind *type);

/* p[i*parameters + j] = u and 1 - u, 0 < u < 1, of parameter j at point i; same bits on every CPU.
 *
 * In random and sobol, point i does not depend on how many points there are; in latin-hypercube
 * each parameter has one point in each of the intervals (k/n, (k+1)/n). Parameter j does not depend
 * on those after it; without correlation, and but for sobol, it depends on no other and not on its
 * place. The correlation must have a factor (sampler/design/correlation.h), and the parameters be
 * no more than fracas_design_most_parameters. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_design_fill(const fracas_design *design, fracas_probability *p);

#endif
