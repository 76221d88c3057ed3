/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/draw.h"

#include <stdlib.h>
#include <string.h>

fracas_err fracas_fit_draw_create(size_t n, uint64_t seed, fracas_fit_draw *draw)
{
    *draw = (fracas_fit_draw){.n = n,
                              .weight = malloc((n + 1) * sizeof *draw->weight),
                              .random = gsl_rng_alloc(gsl_rng_mt19937)};
    if (!draw->weight || !draw->random) return fracas_no_memory("a resample");
    gsl_rng_set(draw->random, (unsigned long)(seed ^ seed >> 32)); /* it takes 32 bits */
    return FRACAS_OK;
}

void fracas_fit_draw_clear(fracas_fit_draw *draw)
{
    free(draw->weight);
    if (draw->random) gsl_rng_free(draw->random);
    *draw = (fracas_fit_draw){0};
}

const uint32_t *fracas_fit_draw_next(fracas_fit_draw *draw)
{
    memset(draw->weight, 0, draw->n * sizeof *draw->weight);
    for (size_t i = 0; i < draw->n; i++) draw->weight[gsl_rng_uniform_int(draw->random, draw->n)]++;
    return draw->weight;
}
