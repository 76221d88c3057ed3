/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas and lengths, by Gauss quadrature where elements are curved. */
#include "engine/element/triangle.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>

void fracas_surface_box(const fracas_surface *surface, double side[3])
{
    for (int i = 0; i < 3; i++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t n = 0; n < surface->nnodes; n++) {
            least = fmin(least, surface->node[n][i]);
            most = fmax(most, surface->node[n][i]);
        }
        side[i] = most - least;
    }
}

/* (meshes.1) */
double fracas_surface_density(const fracas_surface *surface, size_t element, double xi, double eta,
                              double shape[6])
{
    static const double origin[3];
    double slope[6][2], along[2][3] = {{0}}, normal[3];
    fracas_triangle_shape(surface->order, xi, eta, shape, slope);
    for (size_t k = 0; k < surface->corners; k++)
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 2; a++)
                along[a][i] += slope[k][a] * fracas_surface_node(surface, element, k)[i];
    fracas_surface_normal(origin, along[0], along[1], normal);
    return sqrt(fracas_surface_dot(normal, normal));
}

/* (meshes.1) */
double fracas_surface_find_area(const fracas_surface *surface, size_t element)
{
    if (surface->order == 1) {
        double normal[3];
        fracas_surface_normal(fracas_surface_node(surface, element, 0),
                              fracas_surface_node(surface, element, 1),
                              fracas_surface_node(surface, element, 2), normal);
        return 0.5 * sqrt(fracas_surface_dot(normal, normal));
    }
    /* Strang and Fix, degree 4: the weights w and the points (1 - 2 a, a, a) and its turns. */
    static const double a[2] = {0.445948490915964886, 0.0915762135097707435};
    static const double w[2] = {0.223381589678011466, 0.109951743655321868};
    double shape[6], sum = 0.0;
    for (int i = 0; i < 2; i++)
        sum += w[i] * (fracas_surface_density(surface, element, a[i], a[i], shape) +
                       fracas_surface_density(surface, element, 1.0 - 2.0 * a[i], a[i], shape) +
                       fracas_surface_density(surface, element, a[i], 1.0 - 2.0 * a[i], shape));
    return 0.5 * sum;
}

/* Length of dx/dt at t from -1 to 1 on the parabola from a over m to b. */
static double speed(const double a[3], const double m[3], const double b[3], double t)
{
    double d[3];
    for (int i = 0; i < 3; i++) d[i] = (t - 0.5) * a[i] - 2.0 * t * m[i] + (t + 0.5) * b[i];
    return sqrt(fracas_surface_dot(d, d));
}

double fracas_surface_length(const fracas_surface *surface, size_t element, size_t edge)
{
    const double *a = fracas_surface_node(surface, element, edge),
                 *b = fracas_surface_node(surface, element, (edge + 1) % 3);
    if (surface->order == 1) {
        const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        return sqrt(fracas_surface_dot(d, d));
    }
    const double *m = fracas_surface_node(surface, element, 3 + edge);
    const double t = 0.774596669241483377; /* sqrt(3/5): three points of Gauss */
    return (5.0 * (speed(a, m, b, -t) + speed(a, m, b, t)) + 8.0 * speed(a, m, b, 0.0)) / 9.0;
}
