/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a surface over lanes: forces of a load on an element, and their work
 * (docs/theory/loads.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_LOAD_KERNEL_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_LOAD_KERNEL_H

#include "engine/formulation/surface/kernel.h"

/* Forces at amplitude 1 of a load, and its amplitudes at t_n and t_{n-1}. */
typedef struct {
    const double *force;
    vd now, before;
} surface_load;

/* The loads of an element, in the order of the campaign. */
typedef struct {
    int count;
    surface_load load[FRACAS_LOADINGS];
} surface_loads;

/* Amplitudes behind a front, lane by lane: each has its own time. */
__attribute__((noinline, unused)) static void
surface_front(const surface_context *c, int n, const fracas_load_clock *clock, surface_load *load)
{
    _Alignas(64) double now[LANES], before[LANES];
    const fracas_step *step = c->step;
    const fracas_loading *loading = c->constants->force[n];
    const fracas_profile *history = &c->tables->history[c->tables->force[n]];
    for (int l = 0; l < LANES; l++) {
        const double time = step->time[c->first + l], drift = step->drift[c->first + l];
        now[l] = fracas_load_amplitude(loading, history, clock, time);
        before[l] = fracas_load_amplitude(loading, history, clock, time - drift);
    }
    load->now = lanes_load(now);
    load->before = lanes_load(before);
}

/* (loads.1) */
LANES_FUNCTION surface_load surface_load_of(const surface_context *c, int n, size_t row, int order)
{
    const fracas_surface_tables *t = c->tables;
    const fracas_step *step = c->step;
    surface_load load = {t->load + row * (size_t)BODY_SIZE(order),
                         lanes_load(step->amplitude[n] + c->first),
                         lanes_load(step->amplitude_before[n] + c->first)};
    const double front = c->constants->force[n]->front;
    if (front > 0 || front < 0) surface_front(c, n, &t->load_clock[row], &load);
    return load;
}

/* (loads.10) */
LANES_FUNCTION void surface_loads_of(const surface_context *c, int order, size_t e,
                                     surface_loads *loads)
{
    const fracas_surface_tables *t = c->tables;
    loads->count = 0;
    if (__builtin_expect(!t->load_row, 1)) return;
    for (int n = 0; n < t->forces; n++) {
        const size_t row = t->load_row[(size_t)n * t->nelements + e];
        if (row > 0) loads->load[loads->count++] = surface_load_of(c, n, row - 1, order);
    }
}

/* Takes an element's loads off its inner forces. */
LANES_FUNCTION void surface_take_loads(const surface_loads *loads, int size, vd *force)
{
    for (int n = 0; n < loads->count; n++)
        UNROLL_FOR (int i = 0; i < size; i++)
            force[i] -= loads->load[n].now * lanes_set(loads->load[n].force[i]);
}

/* F . x [N m] of a load at amplitude 1. */
LANES_FUNCTION vd surface_along(const surface_load *load, int size, const vd *x)
{
    vd sum = lanes_set(0.0);
    UNROLL_FOR (int i = 0; i < size; i++) sum += lanes_set(load->force[i]) * x[i];
    return sum;
}

/* Adds the loads' work in this step at velocities `factor` x, by the mean of both amplitudes: exact
 * with leapfrog, whose displacements move by dt v  (loads.4) */
LANES_FUNCTION void surface_work(const surface_context *c, const surface_loads *loads, int size,
                                 vd factor, const vd *x, double *sums)
{
    for (int n = 0; n < loads->count; n++) {
        const surface_load *load = &loads->load[n];
        surface_add(surface_at(sums, SURFACE_WORK),
                    c->drift * (lanes_set(0.5) * (load->before + load->now)) *
                        (factor * surface_along(load, size, x)));
    }
}

#endif
