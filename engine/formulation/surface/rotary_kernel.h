/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a surface over lanes: rotary inertia of an element (docs/theory/shell.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_ROTARY_KERNEL_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_ROTARY_KERNEL_H

#include "engine/formulation/surface/kernel.h"

/* Components along t of vectors at an element's nodes. */
LANES_FUNCTION void surface_turning(const double *table, const vd *at, vd along[6])
{
    UNROLL_FOR (int k = 0; k < 6; k++)
        along[k] = lanes_set(table[SURFACE_TURNING]) * at[3 * k] +
                   lanes_set(table[SURFACE_TURNING + 1]) * at[3 * k + 1] +
                   lanes_set(table[SURFACE_TURNING + 2]) * at[3 * k + 2];
}

/* Entry k of the product of a symmetric matrix and a vector. */
LANES_FUNCTION vd surface_row(const double *matrix, int k, const vd along[6])
{
    vd sum = lanes_set(matrix[fracas_surface_entry(k, 0)]) * along[0];
    UNROLL_FOR (int l = 1; l < 6; l++)
        sum += lanes_set(matrix[fracas_surface_entry(k, l)]) * along[l];
    return sum;
}

/* Rotary inertia's part of the accelerations  (shell.17) */
LANES_FUNCTION void surface_turn(const double *table, const vd *force, vd *acceleration)
{
    vd along[6];
    surface_turning(table, force, along);
    UNROLL_FOR (int k = 0; k < 6; k++) {
        const vd change = surface_row(table + SURFACE_ROTARY_INVERSE, k, along);
        UNROLL_FOR (int i = 0; i < 3; i++)
            acceleration[3 * k + i] -= lanes_set(table[SURFACE_TURNING + i]) * change;
    }
}

/* Power of the reactions to it at held components. */
LANES_FUNCTION vd surface_twist(const double *table, uint32_t held, const vd *acceleration,
                                const vd *velocity)
{
    vd free[18], along[6], sum = lanes_set(0.0);
    UNROLL_FOR (int i = 0; i < 18; i++) free[i] = held >> i & 1 ? lanes_set(0.0) : acceleration[i];
    surface_turning(table, free, along);
    UNROLL_FOR (int k = 0; k < 6; k++) {
        const vd moment = surface_row(table + SURFACE_ROTARY, k, along);
        for (int i = 0; i < 3; i++)
            if (held >> (3 * k + i) & 1)
                sum += lanes_set(table[SURFACE_TURNING + i]) * moment * velocity[3 * k + i];
    }
    return sum;
}

/* Product of the rotary inertia with vectors at its nodes, x.R y  (shell.18) */
LANES_FUNCTION vd surface_spun(const double *table, const vd *x, const vd *y)
{
    vd before[6], then[6], sum = lanes_set(0.0);
    surface_turning(table, x, before);
    surface_turning(table, y, then);
    UNROLL_FOR (int k = 0; k < 6; k++)
        sum += surface_row(table + SURFACE_ROTARY, k, before) * then[k];
    return sum;
}

#endif
