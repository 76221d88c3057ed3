/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers of a loading to questions about an uncracked body, for forecasts. */
#ifndef FRACAS_ENGINE_LOADING_TRAITS_H
#define FRACAS_ENGINE_LOADING_TRAITS_H

#include "engine/spec.h"

/* Maxima in a ring until a time t. */
typedef struct {
    double stress;  /* by a prescribed or initial radial velocity [Pa] */
    double outward; /* radial acceleration by the load [m/s2] */
    double along;   /* circumferential velocity [m/s] */
} fracas_ring_drive;

/* Stretch (1, ratio) strain of a plate at a time t. */
typedef struct {
    double strain, ratio; /* |strain along x|; strain along y over that along x */
    bool moving;          /* held edges move along */
    bool shock;           /* they start with a jump in velocity */
} fracas_stretch;

/* Functions are NULL for bodies without this loading. */
typedef struct {
    fracas_ring_drive (*ring)(const fracas_spec *spec, double t); /* of a bar: stress alone */
    double (*path)(const fracas_spec *spec, double t); /* circumferential, ring [m]; NULL: 0 */
    /* True if it compresses a ring. `whole`: the ring does not break; `turn`: its time from the
     * greatest speed to the turning point [s]. NULL: never. */
    bool (*folds)(const fracas_spec *spec, bool whole, double turn);
    fracas_stretch (*surface)(const fracas_spec *spec, double t);
    bool released; /* the body moves freely after the start */
} fracas_loading_traits;

const fracas_loading_traits *fracas_loading_traits_of(const fracas_spec *spec);

#endif
