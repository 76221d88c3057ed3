/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cracks of a surface over time: length, tips and speed, from the mesh of the point and the times
 * at which interfaces broke. Equations: docs/theory/cracks.md. */
#ifndef FRACAS_ANALYSIS_DATA_CRACKS_H
#define FRACAS_ANALYSIS_DATA_CRACKS_H

#include "analysis/data/field.h"
#include "base/err.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/mesh.h"

#include <stddef.h>
#include <stdint.h>

enum { FRACAS_CRACK_WINDOW = 8 }; /* vertices of a path behind a speed */

/* A break after the start. */
typedef struct {
    double time;         /* s */
    size_t interface;    /* which one broke */
    size_t crack;        /* its crack, or the older of the two that it joins */
    double length;       /* m, of all cracks, this break included: a(t)  (cracks.1) */
    double crack_length; /* m, of this crack */
    double tip[3];       /* m, its end that is farther on the way of the crack, before any motion */
    double distance;     /* m, of that end on this way from the start of the crack  (cracks.2) */
    double speed;        /* m/s  (cracks.3); NaN: too few breaks, or it closes a loop */
} fracas_crack_break;

/* A set of broken interfaces connected by vertices, from its first break until the end, or until it
 * met an older one. */
typedef struct {
    double start_time, end_time; /* s, of its first and last break; NaN of a notch without breaks */
    double start[3];             /* m, where the way to its tip begins; NaN of such a notch */
    int64_t breaks, branches;    /* branches: vertices of three or more broken interfaces */
    double length, notch;        /* m, broken after and before the start */
    double between;              /* m, part of the length between two fragments at the end */
    double reach, tip[3];        /* m, largest distance of a tip  (cracks.2), and its place */
    double extent;               /* m, straight from start to tip */
    double speed;                /* m/s, over the whole way to the tip  (cracks.3) */
    double fastest;              /* m/s, largest of its breaks; NaN: none has a speed */
    size_t met;                  /* the older crack; SIZE_MAX: none */
    double met_time;             /* s */
} fracas_crack;

typedef struct {
    size_t ncracks, nbreaks;
    fracas_crack *crack;       /* notches, then in the order of their first breaks */
    fracas_crack_break *broke; /* in the order of times, equal ones of interfaces */
} fracas_cracks;

extern const fracas_fields fracas_crack_fields, fracas_crack_break_fields;

/* FRACAS_DAMAGED if the interfaces of the record are not those of the mesh, FRACAS_ENVIRONMENT
 * without memory. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_cracks_find(const fracas_stored_mesh *mesh,
                                              const fracas_record *record, fracas_cracks *cracks);
void fracas_cracks_clear(fracas_cracks *cracks);

/* The crack of the greatest length, the first of several; SIZE_MAX where none grew. */
size_t fracas_cracks_longest(const fracas_cracks *cracks);

/* Speed of Rayleigh waves along the edge of a plate in plane stress  (cracks.4) [m/s]: young [Pa],
 * density [kg/m3], 0 <= poisson < 0.5. NaN without one of them. */
double fracas_rayleigh_speed(double young, double density, double poisson);

#endif
