/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The usable realizations of one point and their fragments, by realization: the units of
 * resampling. */
#ifndef FRACAS_ANALYSIS_DATA_ENSEMBLE_H
#define FRACAS_ANALYSIS_DATA_ENSEMBLE_H

#include "analysis/data/numbers.h"
#include "base/err.h"
#include "campaigns/store/datafile.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The numbers of one usable realization. Every member is double: fracas_estimate_of strides over
 * them. */
typedef struct {
#define FRACAS_MEMBER(key, unit, doc, ...) double key; /* NaN: the realization has none */
    FRACAS_REALIZATION_NUMBERS(FRACAS_MEMBER)
#undef FRACAS_MEMBER
} fracas_replica_values;

enum { FRACAS_REPLICA_STRIDE = sizeof(fracas_replica_values) / sizeof(double) };

typedef struct {
    size_t nrealizations;         /* FRAGMENTED, INTACT and TIME_LIMIT, in the order of the study */
    fracas_replica_values *value; /* for each */
    int64_t *replica;             /* for each */
    size_t *row;                  /* for each, in the study */
    size_t *first; /* nrealizations + 1: fragments first[i] to first[i + 1] - 1 are of i */
    size_t nfragments;
    double *size, *mass; /* for each fragment [m], [kg] */
    int32_t *elements;   /* for each */
    uint8_t *dust;       /* for each: 1, or 0 */
    double lattice;      /* m: every size is a multiple of it (equal elements); 0: they are not */
    bool surface;        /* a size is the square root of an area; false after init */
    size_t room, fragment_room;
} fracas_ensemble;

/* An empty one; cleared by the caller. */
void fracas_ensemble_init(fracas_ensemble *ensemble, double lattice);
void fracas_ensemble_clear(fracas_ensemble *ensemble);

/* Takes in a usable realization with the fragments of `record`. */
FRACAS_MUST_USE fracas_err fracas_ensemble_add(fracas_ensemble *ensemble, size_t row,
                                               int64_t replica, const fracas_replica_values *value,
                                               const fracas_record *record);

/* Cut-off c [m] of the mesh's resolution. Fragments of size > c are resolved; estimates and fits
 * "without dust" leave out all others, so their sizes are truncated from the left at c. With D the
 * dimension and h^D the mean length or area of an element, h^D = sum s_i^D/sum elements_i over all
 * fragments: c = 1.5 h of lengths, sqrt(2.5) h of surfaces (estimators.14). It lies between one
 * element and two, or two and three: where all elements are equal, c separates dust from other
 * fragments, and no fragment is of size c. On a lattice h is the lattice itself. 0 of an ensemble
 * without fragments. */
double fracas_ensemble_cut(const fracas_ensemble *ensemble);

#endif
