/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stored realization as it moves, without computing it again: each of its last fragments is a
 * rigid body (docs/theory/fragments.md). */
#ifndef FRACAS_ANALYSIS_DATA_FLIGHT_H
#define FRACAS_ANALYSIS_DATA_FLIGHT_H

#include "analysis/data/surface.h"
#include "base/err.h"
#include "campaigns/store/results.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A fragment of the end. */
typedef struct {
    double centre[3]; /* m, its centroid before any motion */
    double loose;     /* s, last break between it and others; end_time where none is */
    bool even; /* its centroid moves evenly from the start: the last velocity leads elsewhere */
} fracas_flight_piece;

typedef struct {
    fracas_stored_mesh mesh; /* lines, of a bar or ring */
    fracas_record record;    /* with its interfaces and fragments */
    size_t corners;          /* nodes of an element: 2, 3 or 6 */
    size_t ends;             /* nodes of an interface: 1, 2 or 3 */
    bool flat;               /* all nodes have one z */
    double period, rate;     /* m, 1/s, of a bar with periodic ends; 0: none */
    size_t head; /* so many first elements belong to the fragment at its end: they stand a period,
                  * as long as it is by then, behind where they are */
    double turn[3];             /* rad/s, of all fragments as one body, at the end */
    uint32_t *piece_of;         /* [element] its fragment at the end, of the record's */
    fracas_flight_piece *piece; /* [fragment] */
} fracas_flight;

/* FRACAS_USAGE if places or velocities of its fragments are no numbers. */
FRACAS_MUST_USE fracas_err fracas_flight_check(const fracas_record *record);

/* The realization in row `row` of the study, of point `point`. FRACAS_DAMAGED if its fragments are
 * not those between its broken interfaces, FRACAS_USAGE as fracas_flight_check. Without
 * interfaces in the study it has no element. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_flight_read(fracas_results *results, size_t point, size_t row,
                                              fracas_flight *flight);
void fracas_flight_clear(fracas_flight *flight);

/* A flight at a time. Arrays are [element][corner], but for the state's. */
typedef struct {
    fracas_surface_state state; /* its interfaces and fragments */
    double *mass;               /* [fragment of the state] kg */
    double (*place)[3];         /* m  (fragments.10) */
    double (*displacement)[3];  /* m */
    double (*velocity)[3];      /* m/s */
} fracas_flight_instant;

/* time >= 0 [s]; after end_time fragments fly on. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_flight_at(const fracas_flight *flight, double time,
                                            fracas_flight_instant *now);
void fracas_flight_instant_clear(fracas_flight_instant *now);

/* `count` > 0 times [s], rising: half of them after equal shares of the breaks, as
 * fracas_surface_moments, half evenly from 0 to the end. */
FRACAS_MUST_USE fracas_err fracas_flight_moments(const fracas_flight *flight, double *time,
                                                 size_t count);

#endif
