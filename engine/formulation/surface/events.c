/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Onsets and breaks of interfaces, one lane at a time: their times within the step. */
#include "engine/formulation/surface/surface.h"

#include <math.h>

/* Interface i of a lane, `back` before now [s]. */
static fracas_surface_view view_of(const fracas_surface_constants *c, const fracas_step *step,
                                   int lane, size_t i, double back)
{
    const fracas_surface_tables *t = c->tables;
    const size_t size = fracas_surface_unknowns(t), fields = fracas_surface_interface_fields(c),
                 strengths = fracas_surface_strengths_at(c);
    fracas_surface_view view;
    for (int side = 0; side < 2; side++) {
        const size_t at = t->element[i][side] * fracas_surface_element_fields(c);
        for (size_t k = 0; k < size; k++)
            view.u[side][k] = *fracas_surface_field(c, step, at + SURFACE_U * size + k, lane) -
                              back *
                                  *fracas_surface_field(c, step, at + SURFACE_V * size + k, lane);
    }
    for (size_t f = 0; f < fields; f++)
        view.fields[f] = *fracas_surface_field(
            c, step, fracas_surface_interfaces_at(c) + i * fields + f, lane);
    for (int g = 0; g < SURFACE_EDGE(t->order); g++)
        view.strength[g] = *fracas_surface_field(
            c, step, strengths + fracas_surface_strength_of(c, i, g), lane);
    (*t->body->kernels)[FRACAS_ISA_BASELINE][1]->look[t->order - 1](c, i, &view);
    return view;
}

/* t with value(t) = 1, linear between the step before and this one; held within the step
 * (membrane.12) */
static double crossing(const fracas_step *step, int lane, double before, double now)
{
    const double share = (now - 1) / (now - before);
    return step->time[lane] - step->drift[lane] * (share > 0 ? fmin(share, 1.0) : 0.0);
}

void fracas_surface_book(const fracas_surface_constants *c, fracas_step *step, int lane, size_t i,
                         const fracas_surface_event *event)
{
    const fracas_surface_view before = view_of(c, step, lane, i, step->drift[lane]),
                              now = view_of(c, step, lane, i, 0);
    const size_t at = i * (size_t)step->width + (size_t)lane;
    double first = INFINITY, last = -INFINITY;
    for (size_t p = 0; p < fracas_surface_points(c->tables); p++) {
        if (event->cracks[p])
            first = fmin(first, crossing(step, lane, before.onset[p], now.onset[p]));
        if (event->breaks[p])
            last = fmax(last, crossing(step, lane, before.opening[p], now.opening[p]));
    }
    if (event->opens) {
        step->cracked[lane]++;
        step->first_onset[lane] = fmin(step->first_onset[lane], first); /* NaN: none yet */
        if (step->onset_time) step->onset_time[at] = first;
    }
    if (event->parts) {
        step->broken[lane]++;
        if (step->break_time) step->break_time[at] = last;
    }
}
