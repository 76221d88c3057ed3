/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The record of one realization: a row of /realization, and its rows of /fragment, /history,
 * /interface, /probe and /reaction. */
#ifndef FRACAS_ENGINE_RECORD_H
#define FRACAS_ENGINE_RECORD_H

#include "engine/energies.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
    FRACAS_FRAGMENTED = 0,
    FRACAS_INTACT = 1,     /* nothing broken at the end */
    FRACAS_TIME_LIMIT = 2, /* stopped at time.end with cracks still running */
    FRACAS_NONFINITE = 3,
    FRACAS_ENERGY_DRIFT = 4,
    FRACAS_FAILED = 5 /* crashed, timed out, quarantined: values NaN */
} fracas_outcome;

#define FRACAS_NOUTCOMES 6

typedef struct {
    double mass; /* kg */
    double size; /* m: length in 1D, sqrt(area) in 2D */
    int64_t elements;
    int64_t dust;       /* 1 for too few elements (one in 1D): the mesh decides its size */
    double position[3]; /* m, centre of mass at end_time */
    double velocity[3]; /* m/s, of the centre of mass with the background, half a step later */
    double angular_momentum[3]; /* kg m2/s, about the centre of mass */
    double spin[3]; /* rad/s, rigid body's; 0 in a bar and about an axis without inertia */
    /* Its shape at end_time (docs/theory/fragments.md). */
    double volume;       /* m3, before any motion */
    double semi_axis[3]; /* m, of the ellipsoid of the same second moments, the largest first ... */
    double axis[3][3];   /* ... and their directions, unit vectors */
    double extent;       /* m, largest distance of two of its nodes */
    double crack_area;   /* m2, of its faces on broken interfaces, before any motion */
} fracas_fragment;

typedef struct {
    double time; /* s */
    FRACAS_ENERGY_MEMBERS;
    double residual; /* J */
    int64_t fragments, broken;
} fracas_history_row;

#define FRACAS_MOST_HISTORY 1000000 /* intervals of time.end in a history: output.history */

/* Points of the body whose motion is kept at the times of the history. */
enum { FRACAS_MOST_PROBES = 16, FRACAS_PROBE_NAME = 32, FRACAS_PROBES_TEXT = 2048 };
typedef struct {
    char name[FRACAS_PROBE_NAME]; /* letters, digits, _ and - */
    double place[3];              /* m, before any motion */
} fracas_probe;
typedef struct {
    size_t count;
    fracas_probe probe[FRACAS_MOST_PROBES];
} fracas_probes;

typedef struct {
    double time;     /* s */
    int64_t edge;    /* its tag, 1 to 8; 0: all other edges; -n: nodes of the n-th loading */
    double force[3]; /* N, of the edge, or nodes, on the body */
} fracas_reaction_row;

/* "tip 0.009 0 0; middle 0 0 0"; "" without a probe. */
void fracas_probes_write(const fracas_probes *probes, char text[FRACAS_PROBES_TEXT]);
/* The inverse, of numbers of 15 digits; false for any other text. */
bool fracas_probes_parse(const char *text, fracas_probes *probes);

typedef struct {
    double time;            /* s */
    int64_t probe;          /* its number, from 0 */
    double displacement[3]; /* m, the background's included */
    double velocity[3];     /* m/s, of central difference half a step later */
} fracas_probe_row;

typedef struct {
    double strength;   /* Pa; the least of its Gauss points */
    double damage;     /* delta_max/delta_c, 0 to 1 */
    double onset_time; /* s, NaN if it never cracked */
    double break_time; /* s, NaN if it never broke */
} fracas_interface_row;

typedef struct {
    int64_t outcome;   /* fracas_outcome */
    int64_t fragments; /* dust included */
    int64_t fragments_dust;
    int64_t fragments_held;  /* on an edge moved by the load */
    int64_t broken, cracked; /* interfaces */
    int64_t steps;
    double onset_time;          /* s, first onset, NaN if none */
    double end_time, time_step; /* s */
    double mass;                /* kg */
    FRACAS_ENERGY_MEMBERS;      /* at end_time */
    double residual;            /* J, largest absolute value over the run */
    double residual_end;        /* J */
    double vibrating;           /* J, energy beside the motion of each fragment as a rigid body */
    /* How final the count is (docs/theory/settled.md); NaN without an onset: k, Delta, ... */
    double transits, growth;
    double rest, rest_variance, rest_bound; /* ... R, its variance, B; NaN also of surfaces */
    double momentum[3]; /* kg m/s, of the peculiar motion, half a step after end_time */
    /* rows below; nfragment == fragments unless FAILED */
    size_t nfragment, nhistory, ninterface, nprobe, nreaction;
    fracas_fragment *fragment; /* owned by the record, freed by fracas_record_clear */
    fracas_history_row *history;
    fracas_interface_row *interface; /* NULL unless asked for */
    fracas_probe_row *probe;         /* by history row and probe; NULL without probes */
    fracas_reaction_row *reaction;   /* by history row and held edge; NULL unless asked for */
} fracas_record;

/* An empty record of outcome FAILED, every value NaN and every count 0. */
void fracas_record_init(fracas_record *record);

/* Frees the rows of the record and makes it empty. */
void fracas_record_clear(fracas_record *record);

#endif
