/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas and lengths, by Gauss quadrature where elements are curved. */
#include "engine/mesh/surface/parts.h"

#include <math.h>

static const double *node_of(const fracas_surface *surface, size_t element, size_t corner)
{
    return surface->node[surface->element[element * surface->corners + corner]];
}

/* (meshes.1) Derivatives of the six shape functions along the edges from vertex 0 to 1 and to 2, at
 * the area coordinates (1 - r - s, r, s). */
static void slopes(double r, double s, double along_r[6], double along_s[6])
{
    const double q = 1.0 - r - s;
    const double dr[6] = {1.0 - 4.0 * q, 4.0 * r - 1.0, 0.0, 4.0 * (q - r), 4.0 * s, -4.0 * s};
    const double ds[6] = {1.0 - 4.0 * q, 0.0, 4.0 * s - 1.0, -4.0 * r, 4.0 * r, 4.0 * (q - s)};
    for (int k = 0; k < 6; k++) {
        along_r[k] = dr[k];
        along_s[k] = ds[k];
    }
}

/* Length of the normal x_r x x_s. */
static double area_density(const fracas_surface *surface, size_t element, double r, double s)
{
    static const double origin[3];
    double along_r[6], along_s[6], u[3] = {0.0}, v[3] = {0.0}, normal[3];
    slopes(r, s, along_r, along_s);
    for (size_t k = 0; k < 6; k++) {
        const double *x = node_of(surface, element, k);
        for (int i = 0; i < 3; i++) {
            u[i] += along_r[k] * x[i];
            v[i] += along_s[k] * x[i];
        }
    }
    fracas_surface_normal(origin, u, v, normal);
    return sqrt(fracas_surface_dot(normal, normal));
}

double fracas_surface_area(const fracas_surface *surface, size_t element)
{
    if (surface->order == 1) {
        double normal[3];
        fracas_surface_normal(node_of(surface, element, 0), node_of(surface, element, 1),
                              node_of(surface, element, 2), normal);
        return 0.5 * sqrt(fracas_surface_dot(normal, normal));
    }
    /* Strang and Fix, degree 4: the weights w and the points (1 - 2 a, a, a) and its turns. */
    static const double a[2] = {0.445948490915964886, 0.0915762135097707435};
    static const double w[2] = {0.223381589678011466, 0.109951743655321868};
    double sum = 0.0;
    for (int i = 0; i < 2; i++)
        sum += w[i] * (area_density(surface, element, a[i], a[i]) +
                       area_density(surface, element, 1.0 - 2.0 * a[i], a[i]) +
                       area_density(surface, element, a[i], 1.0 - 2.0 * a[i]));
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
    const double *a = node_of(surface, element, edge),
                 *b = node_of(surface, element, (edge + 1) % 3);
    if (surface->order == 1) {
        const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        return sqrt(fracas_surface_dot(d, d));
    }
    const double *m = node_of(surface, element, 3 + edge);
    const double t = 0.774596669241483377; /* sqrt(3/5): three points of Gauss */
    return (5.0 * (speed(a, m, b, -t) + speed(a, m, b, t)) + 8.0 * speed(a, m, b, 0.0)) / 9.0;
}
