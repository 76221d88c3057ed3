/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether the better of two fits is better by more than chance (docs/theory/fits.md). */
#ifndef FRACAS_ANALYSIS_FIT_COMPARE_H
#define FRACAS_ANALYSIS_FIT_COMPARE_H

#include "analysis/fit/likelihood.h"

typedef struct {
    bool nested;      /* one family is a special case of the other */
    double statistic; /* Vuong's z  (fits.14), positive where the first is the better one; nested: 2
                         log likelihood ratio  (fits.15) */
    double p; /* p of a difference as large though neither is better; nested: of a gain as large
                 though the special case holds; NaN where it is not known */
    int64_t resamples; /* for a nested one, number of refits that arrived */
} fracas_fit_comparison;

/* The variance is taken over realizations. Fewer than 4 realizations: no p. */
FRACAS_MUST_USE fracas_err fracas_fit_compare(const fracas_fit_sample *sample,
                                              const fracas_family *const family[2],
                                              const fracas_fit fit[2], int64_t resamples,
                                              uint64_t seed, fracas_fit_comparison *comparison);

#endif
