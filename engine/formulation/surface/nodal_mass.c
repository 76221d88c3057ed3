/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/nodal_mass.h"

#include "engine/element/triangle.h"

#include <math.h>

/* |dx/dxi x dx/deta|, and the shape functions, at a point of an element. */
static double area_density(const fracas_surface *surface, size_t element, double xi, double eta,
                           double *shape)
{
    double derivative[6][2], along[2][3] = {{0}};
    fracas_triangle_shape(surface->order, xi, eta, shape, derivative);
    for (size_t k = 0; k < surface->corners; k++) {
        const double *x = surface->node[surface->element[element * surface->corners + k]];
        for (int a = 0; a < 2; a++)
            for (int i = 0; i < 3; i++) along[a][i] += x[i] * derivative[k][a];
    }
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double normal = along[0][j] * along[1][k] - along[1][j] * along[0][k];
        square += normal * normal;
    }
    return sqrt(square);
}

void fracas_nodal_mass(const fracas_surface *surface, size_t element, double density,
                       double *consistent, double *lumped)
{
    const size_t nodes = surface->corners;
    double shape[6], total = 0, trace = 0;
    for (size_t i = 0; i < nodes * nodes; i++) consistent[i] = 0;
    for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
        const double *point = fracas_triangle_fine[g];
        const double weight = density * point[2] *
                              area_density(surface, element, point[0], point[1], shape);
        total += weight;
        for (size_t k = 0; k < nodes; k++)
            for (size_t l = 0; l < nodes; l++)
                consistent[k * nodes + l] += weight * shape[k] * shape[l];
    }
    for (size_t k = 0; k < nodes; k++) trace += consistent[k * nodes + k];
    for (size_t k = 0; k < nodes; k++) lumped[k] = total * consistent[k * nodes + k] / trace;
}
