/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/critical_step.h"

#include "engine/integrator/critical_step.h"
#include "engine/integrator/hulbert_chung.h"
#include "engine/integrator/integrator.h"

#include <math.h>
#include <stdlib.h>

/* A little of everything, most of it where elements are small; nothing where nodes are held. */
static void fill_start(const double *scale, size_t n, double *start)
{
    double least = INFINITY;
    for (size_t i = 0; i < n; i++)
        if (scale[i] > 0) least = fmin(least, scale[i]);
    uint64_t noise = 1;
    for (size_t i = 0; i < n; i++) {
        const double part = least / scale[i];
        noise = noise * 6364136223846793005u + 1442695040888963407u;
        start[i] = scale[i] > 0 ? part * part * ((double)(noise >> 40) / 16777216.0 - 0.5) : 0;
    }
}

fracas_err fracas_surface_frequency(const fracas_lanczos_problem *problem, const double *scale,
                                    double *omega)
{
    double square = 0, *start = malloc(problem->n * sizeof *start);
    if (!start) return fracas_no_memory("the critical time step");
    fill_start(scale, problem->n, start);
    const fracas_err err = fracas_lanczos(problem, start, &square);
    free(start);
    *omega = sqrt(square);
    if (!err && !(square > 0))
        return fracas_fail(
            FRACAS_USAGE, "every node of the mesh is held: leave an edge free, or refine the mesh");
    return err;
}

void fracas_surface_set_critical_step(fracas_model *model, double whole, double pressed)
{
    const fracas_time *time = &model->spec.time;
    /* Omega_c = 2 of central difference */
    const double limit = time->integrator == &fracas_integrator_hulbert_chung
                             ? fracas_hulbert_chung_of(time->spectral_radius).limit
                             : FRACAS_CENTRAL_DIFFERENCE_LIMIT;
    model->critical_closed = limit / whole;
    model->critical_cracked = limit / pressed;
    model->critical_step = fmin(model->critical_closed, model->critical_cracked);
}
