/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads on surfaces: an amplitude over time by a density in space (docs/theory/loads.md).
 *
 *   f(x, t) = a(t, x) d(x)                                                          (loads.1)
 *
 * A load is one file, with its parameters and its density, and a line in loads.list.h. A number of
 * one load alone is own[] of the section (FRACAS_LOAD_NUMBER). The surface integrates the density
 * with the shape functions; masses, rotary inertia, reactions and the work in the ledger follow for
 * every body. A load with a path s(t) moves its edges or nodes instead:
 *
 *   u(x, t) = s(t) d(x)                                                             (loads.5) */
#ifndef FRACAS_ENGINE_LOADING_LOAD_H
#define FRACAS_ENGINE_LOADING_LOAD_H

#include "base/profile.h"
#include "engine/loading/loading.h"
#include "engine/mesh/line.h"

typedef enum {
    FRACAS_LOAD_ON_AREA, /* d in N/m2 of the mid-surface */
    FRACAS_LOAD_ON_MASS, /* d in m/s2 */
    FRACAS_LOAD_ON_EDGE, /* d in N/m of an edge; of a motion without a unit */
    FRACAS_LOAD_ON_LINE, /* d in N/m of edges inside the body */
    FRACAS_LOAD_ON_NODES /* d in N of all its nodes; of a motion without a unit */
} fracas_load_on;

/* Where a load acts. */
typedef struct {
    double x[3];       /* m, at the start */
    double normal[3];  /* unit normal of the mid-surface: elements are counter-clockwise from its
                          side */
    double outward[3]; /* edges: in the surface, away from the body; 1 */
    double along[3];   /* edges: the body on the left, 1 */
} fracas_place;

struct fracas_load {
    fracas_load_on on;
    void (*density)(const fracas_spec *spec, const fracas_loading *loading, const fracas_place *at,
                    double density[3]);
    /* Key of the i-th edge of the shape on which it acts, from 0; NULL after the last. NULL of
     * loads on areas and masses, on a line by its ends, and on nodes by limits. */
    const char *(*edge)(const fracas_loading *loading, int i);
    /* The line of a load on one, where it has no such key; NULL of other loads. `size`: as of
     * fracas_line_of. */
    fracas_line (*line)(const fracas_loading *loading, const char *section, double size);
    /* Path of a motion, from s(0) = 0 [m]; NULL: a force. */
    double (*path)(const fracas_loading *loading, const fracas_profile *history, double t);
    /* Load on nodes: how far x lies beside them [m], 0: a node there is one. A force at the foot of
     * a point where there is none: its place [m], unless `at` is NULL; false of others; NULL:
     * never. */
    double (*beside)(const fracas_loading *loading, int dimension, const double x[3]);
    bool (*middle)(const fracas_loading *loading, int dimension, double at[3]);
    /* Motion of nodes: the components that it prescribes, bits 1, 2, 4 for x, y, z; whether they
     * rest. */
    unsigned (*components)(const fracas_loading *loading, int dimension);
    bool (*rests)(const fracas_loading *loading);
};

/* Share of the load at a place: 1 up to spot from the middle of its spot, and exp(-(r - spot)/L) at
 * a distance r beyond, L = spot_decay, or 0 without one; 1 everywhere without a spot  (loads.9) */
double fracas_load_spot(const fracas_loading *loading, const double x[3]);

/* Names of edges, by their keys in the shapes' tables; `text` says what it does there. */
enum { FRACAS_LOAD_EDGES = 14 };
extern const fracas_kind *const fracas_load_edges[FRACAS_LOAD_EDGES];
#define FRACAS_LOAD_EDGE(key, member, text)                                 \
    FRACAS_ONE_OF(key, fracas_load_edges, offsetof(fracas_loading, member), \
                  text ", by its key in `geometry`"),                       \
        .keys_of = "geometry"

/* When the load reaches a place, by its front [s], 0 without one, INFINITY where it never does; and
 * the time constant of its decay there [s], INFINITY without one. */
typedef struct {
    double arrival, decay;
} fracas_load_clock;

fracas_load_clock fracas_load_clock_at(const fracas_loading *loading, const double x[3]);

/* The factors of `history`, read; none without one. As fracas_profile_read. */
FRACAS_MUST_USE fracas_err fracas_load_history(const fracas_loading *loading,
                                               fracas_profile *history);

/* a = min(1, s/rise) (1 - s/duration) exp(-s/decay) for s = t - arrival >= 0, else 0; factors not
 * given are 1. A history, if there is one, stands for the first two  (loads.2) */
double fracas_load_amplitude(const fracas_loading *loading, const fracas_profile *history,
                             const fracas_load_clock *clock, double t);

bool fracas_load_has_front(const fracas_loading *loading);

/* Largest |a| until t; INFINITY where it is unknown. */
double fracas_load_largest(const fracas_loading *loading, double t);

/* density = (own[first], own[first + 1], own[first + 2]) + own[first + 3] normal: along the axes,
 * and across. */
static inline void fracas_load_vector(const fracas_loading *loading, size_t first,
                                      const fracas_place *at, double density[3])
{
    const double *own = loading->own + first;
    for (int i = 0; i < 3; i++) density[i] = own[i] + own[3] * at->normal[i];
}

/* Trait `surface` of a load without a known bound of the strain. */
fracas_stretch fracas_load_unbounded(const fracas_spec *spec, const fracas_loading *loading,
                                     double t);

/* FRACAS_USAGE unless the keys of the amplitude go together. */
FRACAS_MUST_USE fracas_err fracas_load_check(const fracas_loading *loading);

extern const fracas_kind fracas_front_x, fracas_front_y, fracas_front_z;
extern const fracas_kind *const fracas_front_axes[3];

/* A number of any sign, 0 where it is not given; `member`: own[...] of a load's own. */
#define FRACAS_LOAD_NUMBER(key, member, si, what, models)                    \
    FRACAS_BRACES(key, FRACAS_REAL, si, what, 0, -INFINITY, INFINITY, false, \
                  offsetof(fracas_loading, member), .only = models)

/* The keys of the spot, before those of the amplitude. */
#define FRACAS_LOAD_LENGTH(key, member, what)                                             \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "m", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .maximum = INFINITY, .minimum_open = true, \
                  .offset = offsetof(fracas_loading, member), .optional = true)
#define FRACAS_LOAD_MIDDLE(axis, i, models)                                               \
    FRACAS_BRACES(.name = "spot_" axis, .type = FRACAS_REAL, .unit = "m",                 \
                  .doc = axis " of the middle of the spot; none is 0",                    \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_loading, spot_at[i]), .optional = true,       \
                  .only = models)
#define FRACAS_LOAD_SPOT                                                                         \
    FRACAS_LOAD_LENGTH("spot", spot, "radius of a spot, in space: within it the load is whole"), \
        FRACAS_LOAD_LENGTH("spot_decay", spot_decay,                                             \
                           "length of its exponential decay beyond the spot; none: it ends "     \
                           "there"),                                                             \
        FRACAS_LOAD_MIDDLE("x", 0, 0), FRACAS_LOAD_MIDDLE("y", 1, 0),                            \
        FRACAS_LOAD_MIDDLE("z", 2, FRACAS_GROUP_SHELL)

/* The keys of the amplitude, last in a load's parameters. */
#define FRACAS_LOAD_TIME(key, member, what)                                               \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "s", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .maximum = INFINITY, .minimum_open = true, \
                  .offset = offsetof(fracas_loading, member), .optional = true)
#define FRACAS_LOAD_PLACE(key, member, what)                                              \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "m", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_loading, member), .optional = true)
#define FRACAS_LOAD_HISTORY(others)                                                              \
    FRACAS_BRACES(.name = "history", .type = FRACAS_ATTACHMENT, .unit = "1",                     \
                  .doc =                                                                         \
                      "text whose lines begin with a time [s] and a factor, linear between two " \
                      "lines, in place of " others,                                              \
                  .offset = offsetof(fracas_loading, history), .optional = true)
#define FRACAS_LOAD_AMPLITUDE                                                                   \
    FRACAS_LOAD_TIME("rise", rise, "time in which it rises from 0, in proportion to time"),     \
        FRACAS_LOAD_TIME("decay", decay, "time constant of its exponential decay"),             \
        FRACAS_LOAD_TIME("duration", duration,                                                  \
                         "time after which its sign changes: Friedlander's factor "             \
                         "1 - t/duration"),                                                     \
        FRACAS_LOAD_HISTORY("rise and duration"),                                               \
        {.name = "front",                                                                       \
         .type = FRACAS_REAL,                                                                   \
         .unit = "m/s",                                                                         \
         .doc = "speed of a front behind which the load acts: all times above count from its "  \
                "arrival",                                                                      \
         .fallback = FRACAS_REQUIRED,                                                           \
         .minimum = -INFINITY,                                                                  \
         .maximum = INFINITY,                                                                   \
         .offset = offsetof(fracas_loading, front),                                             \
         .optional = true},                                                                     \
        {FRACAS_ONE_OF("front_along", fracas_front_axes, offsetof(fracas_loading, front_along), \
                       "axis along which the front runs")},                                     \
        FRACAS_LOAD_PLACE("front_at", front_at, "coordinate of the front at t = 0; none is 0"), \
        FRACAS_LOAD_PLACE(                                                                      \
            "front_from", front_from,                                                           \
            "coordinate at which the front began to run: nothing behind it is loaded"),         \
    {                                                                                           \
        .name = "decay_by_travel", .type = FRACAS_REAL, .unit = "1",                            \
        .doc = "time constant of its decay over the time that the front took from front_from",  \
        .fallback = FRACAS_REQUIRED, .maximum = INFINITY, .minimum_open = true,                 \
        .offset = offsetof(fracas_loading, decay_by_travel), .optional = true                   \
    }

#endif
