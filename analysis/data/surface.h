/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of a broken surface at any time of its run, from the mesh of the point and the times at
 * which interfaces cracked and broke. */
#ifndef FRACAS_ANALYSIS_DATA_SURFACE_H
#define FRACAS_ANALYSIS_DATA_SURFACE_H

#include "base/err.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/mesh.h"

#include <stddef.h>
#include <stdint.h>

typedef enum {
    FRACAS_INTERFACE_CLOSED,
    FRACAS_INTERFACE_CRACKED,
    FRACAS_INTERFACE_BROKEN
} fracas_interface_state;

enum { FRACAS_SURFACE_DUST = 2 }; /* most elements of dust */

typedef struct {
    double time;              /* s */
    size_t ncracked, nbroken; /* interfaces cracked, but not broken */
    size_t nfragments, ndust;
    uint8_t *interface; /* fracas_interface_state of each */
    uint32_t *fragment; /* number for each element, in the order of lowest elements */
    size_t *elements;   /* for each fragment */
} fracas_surface_state;

/* An interface is cracked from its onset time on, broken from its break time on. Fragments are sets
 * of elements connected over interfaces that are not broken. FRACAS_DAMAGED if the interfaces of
 * the record are not those of the mesh. Cleared by the caller. */
FRACAS_MUST_USE fracas_err fracas_surface_state_create(const fracas_stored_mesh *mesh,
                                                       const fracas_record *record, double time,
                                                       fracas_surface_state *state);
void fracas_surface_state_clear(fracas_surface_state *state);

/* FRACAS_DAMAGED if the interfaces of the record are not those of the mesh. */
FRACAS_MUST_USE fracas_err fracas_surface_check(const fracas_stored_mesh *mesh,
                                                const fracas_record *record);

typedef struct {
    double time; /* s; 0: before the start, in a notch */
    size_t interface;
} fracas_surface_break;

/* Broken interfaces in the order in which they broke, equal times by their numbers; *sorted freed
 * by the caller. */
FRACAS_MUST_USE fracas_err fracas_surface_breaks(const fracas_record *record,
                                                 fracas_surface_break **sorted, size_t *count);

/* *time: the earliest at which broken interfaces, connected by common vertices, reach from the
 * borders with one tag to those with the other: a crack through the width. NaN if they never do, if
 * there is no border of one of the tags, and if a vertex is on borders of both. */
FRACAS_MUST_USE fracas_err fracas_surface_through(const fracas_stored_mesh *mesh,
                                                  const fracas_record *record, const int64_t tag[2],
                                                  double *time);

/* When things happened first [s]; NaN: never. */
typedef struct {
    double onset, broken;
    double
        through[2]; /* fracas_surface_through from tag 1 to tag 2 (annulus: inner to outer circle;
                     * plate: left to right) and from tag 3 to tag 4 (plate: bottom to top) */
} fracas_surface_times;

/* Without cracks through the width. */
void fracas_surface_first_times(const fracas_record *record, fracas_surface_times *times);
FRACAS_MUST_USE fracas_err fracas_surface_times_of(const fracas_stored_mesh *mesh,
                                                   const fracas_record *record,
                                                   fracas_surface_times *times);

/* `*count` times [s], the last the end: until each before, an equal share of the times at which
 * interfaces broke is over; where those are fewer, evenly from the first onset. *count becomes 1
 * without any onset. */
FRACAS_MUST_USE fracas_err fracas_surface_moments(const fracas_record *record, double *time,
                                                  size_t *count);

#endif
