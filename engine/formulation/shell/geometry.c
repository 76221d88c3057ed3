/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/shell/geometry.h"

#include "engine/element/triangle.h"

#include <math.h>

double fracas_shell_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void fracas_shell_cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double normalize(double a[3])
{
    const double length = sqrt(fracas_shell_dot(a, a));
    for (int i = 0; i < 3; i++) a[i] /= length;
    return length;
}

/* (shell.1), (shell.2) */
void fracas_shell_geometry_at(const fracas_surface *surface, size_t element, double xi, double eta,
                              fracas_shell_geometry *at)
{
    static const double second[3][6] = FRACAS_TRIANGLE_SECOND_2;
    *at = (fracas_shell_geometry){{0}};
    fracas_triangle_shape(2, xi, eta, at->shape, at->slope);
    for (int k = 0; k < 6; k++) {
        const double *x = fracas_surface_node(surface, element, (size_t)k);
        for (int i = 0; i < 3; i++) {
            for (int a = 0; a < 2; a++) at->base[a][i] += at->slope[k][a] * x[i];
            for (int ab = 0; ab < 3; ab++) at->second[ab][i] += second[ab][k] * x[i];
        }
    }
    fracas_shell_cross(at->base[0], at->base[1], at->normal);
    at->area = normalize(at->normal);
    fracas_shell_cross(at->base[1], at->normal, at->dual[0]); /* (phi_eta x t, t x phi_xi)/area */
    fracas_shell_cross(at->normal, at->base[0], at->dual[1]);
    for (int a = 0; a < 2; a++)
        for (int i = 0; i < 3; i++) at->dual[a][i] /= at->area;
    const double *from = fracas_surface_node(surface, element, 0),
                 *to = fracas_surface_node(surface, element, 1);
    for (int i = 0; i < 3; i++) at->x[i] = to[i] - from[i];
    const double off = fracas_shell_dot(at->x, at->normal);
    for (int i = 0; i < 3; i++) at->x[i] -= off * at->normal[i];
    normalize(at->x);
    fracas_shell_cross(at->normal, at->x, at->y);
}

void fracas_shell_edge_point(uint32_t edge, double s, double *xi, double *eta)
{
    *xi = edge == 0 ? s : edge == 1 ? 1 - s : 0;
    *eta = edge == 0 ? 0 : edge == 1 ? s : 1 - s;
}

double fracas_shell_edge_tangent(const fracas_shell_geometry *at, uint32_t edge, double tangent[3])
{
    static const double along[3][2] = {{1, 0}, {-1, 1}, {0, -1}};
    for (int i = 0; i < 3; i++)
        tangent[i] = along[edge][0] * at->base[0][i] + along[edge][1] * at->base[1][i];
    return normalize(tangent);
}
