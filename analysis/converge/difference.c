#include "analysis/converge/difference.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Student's interval and test of a difference. Without any deviation, equal values are equal and others are not. */
static fracas_difference make(double value, double standard_error, double freedom)
{
    const double reach = standard_error > 0 ? gsl_cdf_tdist_Pinv(0.975, freedom) * standard_error : standard_error;
    fracas_difference made = {value, value - reach, value + reach, NAN};
    if (standard_error > 0) made.p = 2 * gsl_cdf_tdist_Q(fabs(value) / standard_error, freedom);
    else if (standard_error == 0) made.p = value == 0;
    return made;
}

/* (convergence.1) */
fracas_difference fracas_difference_of_pairs(const fracas_estimate *pairs)
{
    return make(pairs->mean, pairs->deviation / sqrt((double)pairs->n), (double)(pairs->n - 1));
}

/* (convergence.2) */
fracas_difference fracas_difference_of_samples(const fracas_estimate *before, const fracas_estimate *after)
{
    const double a = before->deviation * before->deviation / (double)before->n, b = after->deviation * after->deviation / (double)after->n;
    const double freedom = (a + b) * (a + b) / (a * a / (double)(before->n - 1) + b * b / (double)(after->n - 1));
    return make(after->mean - before->mean, sqrt(a + b), freedom);
}

/* (convergence.3) */
fracas_err fracas_difference_adjust(double *p, size_t n)
{
    double *value = calloc(n + 1, sizeof *value), largest = 0;
    size_t *order = calloc(n + 1, sizeof *order), m = 0;
    const bool room = value && order;
    for (size_t i = 0; room && i < n; i++) {
        value[i] = isnan(p[i]) ? 2 : p[i]; /* behind all others */
        m += !isnan(p[i]);
    }
    if (room) gsl_sort_index(order, value, 1, n);
    for (size_t k = 0; room && k < m; k++) {
        largest = fmax(largest, fmin(1, (double)(m - k) * value[order[k]]));
        p[order[k]] = largest;
    }
    free(value);
    free(order);
    return room ? FRACAS_OK : fracas_no_memory("the p-values");
}
