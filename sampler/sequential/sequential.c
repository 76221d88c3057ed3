/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/sequential/sequential.h"

#include "sampler/special/student.h"

#include <math.h>
#include <stdbool.h>

const char *const fracas_quantity_name[FRACAS_NQUANTITIES] = {[FRACAS_MEAN_COUNT] = "mean-count",
                                                              [FRACAS_MEAN_SIZE] = "mean-size",
                                                              [FRACAS_DISSIPATED] = "dissipated"};
const char *const fracas_sequential_stop_name[3] = {
    [FRACAS_GO_ON] = "goes on", [FRACAS_PRECISE] = "precise", [FRACAS_AT_MAXIMUM] = "maximum"};

enum { WHOLE = 8 }; /* replicas are added in batches of the widest lanes */

/* (sequential.1) */
int64_t fracas_sequential_next(const fracas_sequential_rule *rule, int64_t replicas)
{
    if (replicas == 0) return rule->minimum;
    const int64_t half = (replicas + 1) / 2, more = (half + WHOLE - 1) / WHOLE * WHOLE;
    return more < rule->maximum - replicas ? replicas + more : rule->maximum;
}

/* Mean and half width of the t interval, in the values' order  (sequential.2), (sequential.3) */
static fracas_sequential_decision estimate(const fracas_sequential_rule *rule, const double *value,
                                           int64_t replicas)
{
    fracas_sequential_decision made = {.used = 0, .mean = NAN, .half_width = NAN};
    double sum = 0, squares = 0;
    for (int64_t r = 0; r < replicas; r++) {
        if (isnan(value[r])) continue;
        sum += value[r];
        made.used++;
    }
    if (made.used == 0) return made;
    const double n = (double)made.used;
    made.mean = sum / n;
    for (int64_t r = 0; r < replicas; r++)
        if (!isnan(value[r])) squares += (value[r] - made.mean) * (value[r] - made.mean);
    if (made.used > 1)
        made.half_width = fracas_student_quantile(rule->confidence, made.used - 1) *
                          sqrt(squares / (n - 1)) / sqrt(n);
    return made;
}

/* (sequential.6) */
static bool is_narrow(const fracas_sequential_rule *rule, const fracas_sequential_decision *made)
{
    return made->half_width <= rule->relative_half_width * fabs(made->mean); /* false with NaN */
}

fracas_sequential_decision fracas_sequential_decide(const fracas_sequential_rule *rule,
                                                    const double *value, int64_t replicas)
{
    fracas_sequential_decision made = estimate(rule, value, replicas);
    if (is_narrow(rule, &made)) made.stop = FRACAS_PRECISE;
    else if (replicas >= rule->maximum) made.stop = FRACAS_AT_MAXIMUM;
    return made;
}
