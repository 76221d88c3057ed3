/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The random numbers of resamples and permutations. */
#ifndef FRACAS_ANALYSIS_DATA_RANDOM_H
#define FRACAS_ANALYSIS_DATA_RANDOM_H

#include "base/own.h"

#include <gsl/gsl_rng.h>
#include <stdint.h>

/* `OWN(gsl_rng) random = fracas_random(seed);` */
FRACAS_OWNER(gsl_rng, gsl_rng_free)

/* Mersenne Twister (MT19937): equal seeds give equal numbers. Freed by gsl_rng_free; NULL without
 * memory. */
gsl_rng *fracas_random(uint64_t seed);

#endif
