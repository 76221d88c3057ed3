/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies on which the shell's operator is looked at: a distorted plate, a panel of a cylinder, a
 * saddle with a twist, a whole sphere. */
#ifndef FRACAS_TESTS_SUPPORT_SHELL_BODIES_H
#define FRACAS_TESTS_SUPPORT_SHELL_BODIES_H

#include "tests/support/shell.h"

enum { PLATE, PANEL, SADDLE, SPHERE, BODIES };
static const char *const body_name[BODIES]
    __attribute__((unused)) = {"plate", "panel", "saddle", "sphere"};

static inline void saddle_map(const void *unused, double s, double t, double x[3])
{
    x[0] = s + 0.1 * sin(2 * t);
    x[1] = t - 0.1 * s * s;
    x[2] = 0.4 * s * s - 0.3 * t * t + 0.3 * s * t;
}

/* `how`: size, and by how much of it x grows along t: 0 a square, 0.5 a rhomb of equilateral
 * triangles. */
static inline void slant_map(const void *how, double s, double t, double x[3])
{
    const double *at = how;
    x[0] = at[0] * (s + at[1] * t);
    x[1] = at[0] * t * sqrt(1 - at[1] * at[1]);
    x[2] = 0;
}

static inline fracas_model *body_of(int which, fracas_spec spec, size_t n, uint64_t seed)
{
    static const double plate[2] = {1.2, 1}, panel[3] = {1, 1.2, 0.6};
    if (which == SPHERE) {
        spec.mesh.divisions = 1;
        return distorted_model(spec, DISTORTION, seed);
    }
    spec.geometry.shape = &fracas_shape_file;
    shell_map *const map[] = {flat_map, roof_map, saddle_map};
    const void *const how[] = {plate, panel, NULL};
    return grid_model(&spec, &(shell_grid){.nx = n,
                                           .ny = n,
                                           .map = map[which],
                                           .how = how[which],
                                           .distortion = DISTORTION,
                                           .seed = seed});
}

#endif
