/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads of the body: the section `loading`. */
#ifndef FRACAS_ENGINE_LOADING_LOADING_H
#define FRACAS_ENGINE_LOADING_LOADING_H

#include "engine/spec.h"

/* Maxima in a ring until a time t. */
typedef struct {
    double stress;  /* by a prescribed or initial radial velocity [Pa] */
    double outward; /* radial acceleration by the load [m/s2] */
    double along;   /* circumferential velocity [m/s] */
} fracas_ring_maxima;

/* Nothing, one component of the velocity or a force is prescribed for every node. */
typedef enum { FRACAS_RING_FREE, FRACAS_RING_HELD, FRACAS_RING_FORCED } fracas_ring_drive;

typedef struct {
    fracas_ring_drive drive;
    int circumferential; /* direction of the drive; else radial */
    double level, rate;  /* level + rate t: velocity [m/s], force by length of the ring [N/m] */
    double start[2];     /* FRACAS_RING_FREE: velocities outward and along the ring [m/s] */
} fracas_ring_motion;

typedef struct fracas_load fracas_load; /* engine/loading/load.h */

/* Stretch (1, ratio) strain of a plate at a time t. */
typedef struct {
    double strain,
        ratio;      /* |strain along x|; strain along y over that along x; INFINITY: unknown */
    double ratio_z; /* expansion: strain along z over that along x; NaN: 1 */
    double whole;   /* |strain| is below it until the body cracks; 0: no bound but `strain` */
    bool moving;    /* held edges move along */
    bool shock;     /* they start with a jump in velocity: the inside is at rest */
} fracas_stretch;

/* Traits of a loading. Functions are NULL for bodies without this loading. Those of the spec alone
 * are asked of the first loading. */
typedef struct {
    double (*rate)(const fracas_spec *spec); /* strain rate at the start [1/s]; NULL, NaN: none */
    fracas_ring_maxima (*ring)(const fracas_spec *spec, double t); /* bar: stress alone */
    /* Prescribed to nodes at this radius [m], those of a polygon around the ring's circle. */
    fracas_ring_motion (*motion)(const fracas_spec *spec, double radius);
    double (*path)(const fracas_spec *spec, double t); /* circumferential, ring [m]; NULL: 0 */
    /* True if it compresses a ring. `whole`: the ring does not break; `turn`: its time from the
     * greatest speed to the turning point [s]. NULL: never. */
    bool (*folds)(const fracas_spec *spec, bool whole, double turn);
    fracas_stretch (*surface)(const fracas_spec *spec, const fracas_loading *loading, double t);
    bool idle;               /* it drives nothing */
    bool released;           /* the body moves freely after the start */
    bool body_force;         /* it acts on every unit of mass of a surface, by where that started */
    const fracas_load *load; /* forces on a surface, or motion of its edges; NULL: none */
    /* Checks the section's values against each other; NULL: none. */
    fracas_err (*check)(const fracas_loading *loading);
} fracas_loading_traits;

static inline const fracas_loading_traits *fracas_loading_traits_of(const fracas_spec *spec)
{
    return spec->loading.type->traits;
}

/* Loading number n, from 0; NULL: there is none. */
const fracas_loading *fracas_loading_at(const fracas_spec *spec, int n);
/* The load of loading number n; NULL: there is none. */
const fracas_load *fracas_loading_load(const fracas_spec *spec, int n);
/* There is no loading beside the first. */
bool fracas_loading_is_alone(const fracas_spec *spec);
/* None of them drives anything. */
bool fracas_loading_is_idle(const fracas_spec *spec);
/* The stretch of a plate by all loadings together; INFINITY where loadings of unlike ratios give no
 * bound. It moves as the first says. */
fracas_stretch fracas_loading_stretch(const fracas_spec *spec, double t);

/* Section of loading number n; those from 1 on are loads, and optional. */
extern const fracas_section fracas_loading_sections[FRACAS_LOADINGS];
extern const fracas_kind fracas_loading_imposed_rate, fracas_loading_initial_velocity,
    fracas_loading_held_velocity, fracas_loading_force, fracas_loading_expansion,
    fracas_loading_centrifugal, fracas_loading_none;
#define LOAD(name) extern const fracas_kind fracas_loading_##name;
#include "engine/loading/loads.list.h"
#undef LOAD
extern const fracas_kind fracas_start_moving, fracas_start_rest;
extern const fracas_kind fracas_axis_radial, fracas_axis_circumferential;

#endif
