/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/nodal_mass.h"

#include "engine/element/triangle.h"

#include <math.h>

void fracas_nodal_mass(const fracas_surface *surface, size_t element, double density,
                       double *consistent, double *lumped)
{
    const size_t nodes = surface->corners;
    double shape[6], total = 0, trace = 0;
    for (size_t i = 0; i < nodes * nodes; i++) consistent[i] = 0;
    for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
        const double *point = fracas_triangle_fine[g];
        const double weight = density * point[2] *
                              fracas_surface_density(surface, element, point[0], point[1], shape);
        total += weight;
        for (size_t k = 0; k < nodes; k++)
            for (size_t l = 0; l < nodes; l++)
                consistent[k * nodes + l] += weight * shape[k] * shape[l];
    }
    for (size_t k = 0; k < nodes; k++) trace += consistent[k * nodes + k];
    for (size_t k = 0; k < nodes; k++) lumped[k] = total * consistent[k * nodes + k] / trace;
}
