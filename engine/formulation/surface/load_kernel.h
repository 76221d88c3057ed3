/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a surface over lanes: forces of a load on an element, and their work
 * (docs/theory/loads.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_LOAD_KERNEL_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_LOAD_KERNEL_H

#include "engine/formulation/surface/kernel.h"

/* Forces at amplitude 1 of a load, and its amplitudes at t_n and t_{n-1}. */
typedef struct {
    const double *force; /* NULL: the element has no load */
    vd now, before;
} surface_load;

/* Amplitudes behind a front, lane by lane: each has its own time. */
__attribute__((noinline, unused)) static void
surface_front(const surface_context *c, const fracas_load_clock *clock, surface_load *load)
{
    _Alignas(64) double now[LANES], before[LANES];
    const fracas_step *step = c->step;
    for (int l = 0; l < LANES; l++) {
        const double time = step->time[c->first + l], drift = step->drift[c->first + l];
        now[l] = fracas_load_amplitude(c->constants->loading, &c->tables->load_history, clock,
                                       time);
        before[l] = fracas_load_amplitude(c->constants->loading, &c->tables->load_history, clock,
                                          time - drift);
    }
    load->now = lanes_load(now);
    load->before = lanes_load(before);
}

/* (loads.1) */
LANES_FUNCTION surface_load surface_load_of(const surface_context *c, int order, size_t e)
{
    const fracas_surface_tables *t = c->tables;
    surface_load load = {NULL, c->amplitude, c->amplitude_before};
    if (__builtin_expect(!t->load_row, 1) || t->load_row[e] == 0) return load;
    const size_t row = t->load_row[e] - 1;
    load.force = t->load + row * (size_t)BODY_SIZE(order);
    const double front = c->constants->loading->front;
    if (front > 0 || front < 0) surface_front(c, &t->load_clock[row], &load);
    return load;
}

/* F . x [N m] of a load at amplitude 1. */
LANES_FUNCTION vd surface_along(const surface_load *load, int size, const vd *x)
{
    vd sum = lanes_set(0.0);
    UNROLL_FOR (int i = 0; i < size; i++) sum += lanes_set(load->force[i]) * x[i];
    return sum;
}

/* Work in this step by the mean of both amplitudes: exact with leapfrog, whose displacements move
 * by dt v  (loads.4) */
LANES_FUNCTION vd surface_work(const surface_context *c, const surface_load *load, vd along)
{
    return c->drift * (lanes_set(0.5) * (load->before + load->now)) * along;
}

#endif
