/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/random.h"

gsl_rng *fracas_random(uint64_t seed)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    if (random) gsl_rng_set(random, (unsigned long)(seed ^ seed >> 32)); /* it takes 32 bits */
    return random;
}
