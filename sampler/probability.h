/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A probability with both of its tails. */
#ifndef FRACAS_SAMPLER_PROBABILITY_H
#define FRACAS_SAMPLER_PROBABILITY_H

/* Probabilities of a value below and above: below + above = 1, each between 0 and 1. The smaller of
 * the two is right to its last digits however small it is. */
typedef struct {
    double below, above;
} fracas_probability;

/* u and 1 - u, 0 < u < 1. Both are exact for a u of a stream. */
static inline fracas_probability fracas_probability_of(double u)
{
    return (fracas_probability){u, 1.0 - u};
}

#endif
