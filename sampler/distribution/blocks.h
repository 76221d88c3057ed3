/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quantiles of blocks of random numbers, over lanes. */
#ifndef FRACAS_SAMPLER_BLOCKS_H
#define FRACAS_SAMPLER_BLOCKS_H

#include "base/isa.h"
#include "sampler/strength.h"

#include <stddef.h>

/* sigma_c[j] = F^-1(u[j]) [Pa], with the bits of the distribution's `quantile`. u are numbers of a
 * stream, n is a multiple of FRACAS_LANES_MAX, both arrays are aligned to 64 bytes. */
typedef void fracas_block_quantile(const fracas_strength *strength, size_t n, const double *u,
                                   double *sigma_c);

/* Distributions with such a function. */
typedef enum {
    FRACAS_BLOCK_NONE,
    FRACAS_BLOCK_UNIFORM,
    FRACAS_BLOCK_WEIBULL,
    FRACAS_BLOCK_LOGNORMAL,
    FRACAS_BLOCKS
} fracas_block;

/* A unit of the kernel (base/isa.h). */
typedef struct {
    fracas_block_quantile *quantile[FRACAS_BLOCKS];
} fracas_block_kernel;

/* The quantile of the instruction set's widest unit of at most `width` lanes; NULL for
 * FRACAS_BLOCK_NONE. */
fracas_block_quantile *fracas_block_quantile_of(fracas_block block, fracas_isa isa, int width);

#endif
