/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Realizations drawn with replacement. */
#ifndef FRACAS_ANALYSIS_FIT_DRAW_H
#define FRACAS_ANALYSIS_FIT_DRAW_H

#include "base/err.h"

#include <gsl/gsl_rng.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    size_t n;
    uint32_t *weight;
    gsl_rng *random;
} fracas_fit_draw;

/* Cleared by the caller, whatever this returns. */
FRACAS_MUST_USE fracas_err fracas_fit_draw_create(size_t n, uint64_t seed, fracas_fit_draw *draw);
void fracas_fit_draw_clear(fracas_fit_draw *draw);
/* How often each of n realizations was drawn in n drawings; its own until the next call. */
const uint32_t *fracas_fit_draw_next(fracas_fit_draw *draw);

#endif
