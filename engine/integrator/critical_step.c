/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/integrator/critical_step.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* (bar.16) */
fracas_err fracas_power_iteration(fracas_operator *apply, const void *context, size_t n,
                                  double *start, double *omega_squared)
{
    enum { LIMIT = 2000, CALM = 20 };
    double *image = malloc(n * sizeof *image);
    if (!image) return fracas_no_memory("the critical time step");
    double value = 0;
    for (int step = 0, calm = 0; step < LIMIT && calm < CALM; step++) {
        double norm = 0, dot = 0;
        apply(context, start, image);
        for (size_t i = 0; i < n; i++) {
            norm += start[i] * start[i];
            dot += start[i] * image[i];
        }
        double next = dot / norm;
        calm = fabs(next - value) <= 1e-9 * next ? calm + 1 : 0;
        value = next;
        for (size_t i = 0; i < n; i++) start[i] = image[i] / next;
    }
    free(image);
    *omega_squared = value;
    return FRACAS_OK;
}
