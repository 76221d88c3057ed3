/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Onsets and breaks of interfaces, booked lane by lane: they are rare. */
#ifndef FRACAS_ENGINE_FORMULATION_CHAIN_EVENTS_H
#define FRACAS_ENGINE_FORMULATION_CHAIN_EVENTS_H

#include "base/lanes.h"
#include "engine/formulation/formulation.h"

#include <math.h>

/* An interface of lane l cracks at `time` [s], held within the step. */
static inline void fracas_chain_note_onset(fracas_step *step, int l, size_t interface, double time)
{
    double t = fmax(step->time[l] - step->drift[l], fmin(time, step->time[l]));
    step->cracked[l]++;
    step->first_onset[l] = fmin(step->first_onset[l], t); /* NaN: none yet */
    if (step->onset_time) step->onset_time[interface * (size_t)step->width + (size_t)l] = t;
}

typedef struct {
    vmask cracks, breaks;  /* lanes of events in this step */
    vd onset, broke;       /* their times [s]; held within the step */
    vd at_onset, at_break; /* energy created by them [J/m2] */
} chain_events;

__attribute__((noinline, cold, unused)) static void chain_note_events(fracas_step *step, int first,
                                                                      double area, size_t interface,
                                                                      const chain_events *event)
{
    double onset[LANES], broke[LANES], at_onset[LANES], at_break[LANES];
    memcpy(onset, &event->onset, sizeof onset);
    memcpy(broke, &event->broke, sizeof broke);
    memcpy(at_onset, &event->at_onset, sizeof at_onset);
    memcpy(at_break, &event->at_break, sizeof at_break);
    for (int i = 0; i < LANES; i++) {
        const int l = first + i;
        const size_t at = interface * (size_t)step->width + (size_t)l;
        const double earliest = step->time[l] - step->drift[l], latest = step->time[l];
        if (lanes_get(event->cracks, i)) {
            fracas_chain_note_onset(step, l, interface, onset[i]);
            step->created[l] += area * at_onset[i];
        }
        if (lanes_get(event->breaks, i)) {
            step->broken[l]++;
            step->created[l] += area * at_break[i];
            if (step->break_time) step->break_time[at] = fmax(earliest, fmin(broke[i], latest));
        }
    }
}

#endif
