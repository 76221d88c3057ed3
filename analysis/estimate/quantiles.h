/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quantiles of the sizes of all fragments of a point, by number and by mass, and their intervals.
 */
#ifndef FRACAS_ANALYSIS_ESTIMATE_QUANTILES_H
#define FRACAS_ANALYSIS_ESTIMATE_QUANTILES_H

#include "analysis/estimate/pooled.h"

/* Fills the quantiles of pooled->all, and of the fragments above `cut` those of pooled->above
 * (estimators.16). */
FRACAS_MUST_USE fracas_err fracas_quantiles_of(const fracas_ensemble *ensemble, double cut,
                                               uint64_t seed, fracas_pooled *pooled);

#endif
