/* How much two means differ, and how well that is known (docs/theory/convergence.md). */
#ifndef FRACAS_ANALYSIS_CONVERGE_DIFFERENCE_H
#define FRACAS_ANALYSIS_CONVERGE_DIFFERENCE_H

#include "analysis/estimate/estimate.h"
#include "base/err.h"

typedef struct {
    double value;     /* mean after - mean before; NaN without either */
    double low, high; /* its 95 % interval; NaN where there is none */
    double p;         /* of no difference, two-sided; NaN where there is no interval */
} fracas_difference;

/* Of pairs, d_i = after_i - before_i, from the estimate of their mean  (convergence.1). */
fracas_difference fracas_difference_of_pairs(const fracas_estimate *pairs);

/* Of two independent samples (Welch 1947)  (convergence.2). */
fracas_difference fracas_difference_of_samples(const fracas_estimate *before, const fracas_estimate *after);

/* p[i] becomes the p-value of hypothesis i among all `n` (Holm 1979): rejecting those below a keeps the probability of one false
 * rejection or more below a, whatever their dependence. NaN is no hypothesis. FRACAS_ENVIRONMENT without memory  (convergence.3). */
FRACAS_MUST_USE fracas_err fracas_difference_adjust(double *p, size_t n);

#endif
