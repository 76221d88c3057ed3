/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mid-surface of a shell at a point of an element  (shell.1), (shell.2). */
#ifndef FRACAS_ENGINE_FORMULATION_SHELL_GEOMETRY_H
#define FRACAS_ENGINE_FORMULATION_SHELL_GEOMETRY_H

#include "engine/mesh/surface/surface.h"

typedef struct {
    double shape[6], slope[6][2]; /* N_k, N_k,a */
    double base[2][3];            /* phi_a [m] */
    double dual[2][3];            /* phi^a [1/m] */
    double second[3][3];          /* phi,xixi, phi,etaeta, phi,xieta [m] */
    double normal[3];             /* t */
    double area;                  /* |phi_xi x phi_eta| [m2] */
    double x[3], y[3];            /* frame: the element's edge 0 projected on the surface, t x x */
} fracas_shell_geometry;

/* `surface` of quadratic triangles. */
void fracas_shell_geometry_at(const fracas_surface *surface, size_t element, double xi, double eta,
                              fracas_shell_geometry *at);

/* xi, eta at s on edge k, s from its first vertex. */
void fracas_shell_edge_point(uint32_t edge, double s, double *xi, double *eta);

/* Unit tangent of edge k from its first vertex; returns |dx/ds| [m]. */
double fracas_shell_edge_tangent(const fracas_shell_geometry *at, uint32_t edge, double tangent[3]);

double fracas_shell_dot(const double a[3], const double b[3]);
void fracas_shell_cross(const double a[3], const double b[3], double c[3]);

#endif
