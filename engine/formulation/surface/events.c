/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Onsets and breaks of interfaces, one lane at a time: their times within the step. */
#include "engine/formulation/surface/surface.h"

#include <math.h>
#include <pthread.h>

/* The interface of an event, `back` before now [s]. */
static fracas_surface_view view_of(const fracas_surface_constants *c, const fracas_step *step,
                                   const fracas_surface_event *event, double back)
{
    const fracas_surface_tables *t = c->tables;
    const size_t size = fracas_surface_unknowns(t), fields = fracas_surface_interface_fields(c),
                 strengths = fracas_surface_strengths_at(c), lanes = (size_t)step->lanes;
    fracas_surface_view view;
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < size; k++)
            view.u[side][k] = event->element[side][(SURFACE_U * size + k) * lanes] -
                              back * event->element[side][(SURFACE_V * size + k) * lanes];
    for (size_t f = 0; f < fields; f++) view.fields[f] = event->fields[f * lanes];
    for (int g = 0; g < SURFACE_EDGE(t->order); g++)
        view.strength[g] = *fracas_surface_field(
            step, strengths + fracas_surface_strength_of(c, event->interface, g), event->lane);
    (*t->body->kernels)[FRACAS_ISA_BASELINE][1]->look[t->order - 1](c, event->interface, &view);
    return view;
}

/* t with value(t) = 1, linear between the step before and this one; held within the step
 * (membrane.12) */
static double crossing(const fracas_step *step, int lane, double before, double now)
{
    const double share = (now - 1) / (now - before);
    return step->time[lane] - step->drift[lane] * (share > 0 ? fmin(share, 1.0) : 0.0);
}

void fracas_surface_record_event(const fracas_surface_constants *c, fracas_step *step,
                                 const fracas_surface_event *event)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* events are rare */
    const int lane = event->lane;
    const fracas_surface_view before = view_of(c, step, event, step->drift[lane]),
                              now = view_of(c, step, event, 0);
    const size_t at = event->interface * (size_t)step->width + (size_t)lane;
    double first = INFINITY, last = -INFINITY;
    for (size_t p = 0; p < fracas_surface_points(c->tables); p++) {
        if (event->cracks[p])
            first = fmin(first, crossing(step, lane, before.onset[p], now.onset[p]));
        if (event->breaks[p])
            last = fmax(last, crossing(step, lane, before.opening[p], now.opening[p]));
    }
    pthread_mutex_lock(&lock);
    if (event->opens) {
        step->cracked[lane]++;
        step->first_onset[lane] = fmin(step->first_onset[lane], first); /* NaN: none yet */
        if (step->onset_time) step->onset_time[at] = first;
    }
    if (event->parts) {
        step->broken[lane]++;
        if (step->break_time) step->break_time[at] = last;
    }
    pthread_mutex_unlock(&lock);
}
