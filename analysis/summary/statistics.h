/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of one point from its realizations. */
#ifndef FRACAS_ANALYSIS_SUMMARY_STATISTICS_H
#define FRACAS_ANALYSIS_SUMMARY_STATISTICS_H

#include "analysis/estimate/convergence.h"
#include "analysis/estimate/final.h"
#include "analysis/data/estimate.h"
#include "analysis/estimate/pooled.h"
#include "analysis/data/bands.h"
#include "analysis/data/ensemble.h"
#include "analysis/estimate/scales.h"
#include "base/err.h"
#include "campaigns/points.h"
#include "campaigns/store/datafile.h"

#include <stdbool.h>

/* Sizes over s0, rates over edot0: the scales are of the mean strength and taken as known. */
/* Whose mean strength scales and scaling laws take. */
typedef enum {
    FRACAS_STRENGTH_OF_INTERFACE, /* any: none has a size effect by volume */
    FRACAS_STRENGTH_OF_PIECE,     /* a piece s0 long  (scaling-laws.19) */
    FRACAS_STRENGTH_OF_MESH       /* an interface, which a finer mesh makes stronger */
} fracas_strength_by;

typedef struct {
    double rate;
    double size, size_half_width;            /* mean over replicas; Student's interval */
    fracas_interval mean, mass_mean, median; /* for all fragments together */
} fracas_normalised;

/* Sums over cracked realizations with a history, of studies up to format version 3: these do not
 * say how final their counts are. */
typedef struct {
    double realizations;
    double time;       /* s, from onset to end */
    double half, seen; /* fragments after half of that time, NaN: not known; and at the end */
} fracas_past;

typedef struct {
    /* Parameters of the point. */
    double rate;   /* 1/s, NaN where the point has none */
    double length; /* m, of a ring its circumference */
    double radius; /* m, of a ring; NaN of anything else */
    double end;    /* s, time.end */
    bool surface;  /* sizes are square roots of areas, and scaling laws say nothing */
    fracas_scales scales;
    fracas_strength_by strength_by;  /* for the scales */
    double law[FRACAS_SCALING_LAWS]; /* m, mean size by each law; NaN of surfaces */
    const char *without_mott;        /* why the size by Mott's law is NaN; NULL: it is not */

    /* Over its realizations. Usable are FRAGMENTED, INTACT and TIME_LIMIT: their fragments mean
     * something. */
    int64_t realizations, usable, unusable;
    int64_t outcome[FRACAS_NOUTCOMES];
#define FRACAS_MEMBER(key, unit, doc, ...)                \
    fracas_estimate key; /* mean over usable realizations \
                          */
    FRACAS_REALIZATION_NUMBERS(FRACAS_MEMBER)
#undef FRACAS_MEMBER
    int64_t kept;      /* TIME_LIMIT before time.end: they lost their energy balance later ... */
    double kept_at[2]; /* s, ... than these times, the first and the last */
    double residual;   /* largest over replicas of (largest |residual| over the run)/dissipated */
    double residual_total; /* the same by the largest total energy, made by add_history */
    double created;        /* largest over replicas of created/dissipated */
    double drift;          /* largest over replicas of |residual|/(largest energy at the end) */
    double heated;         /* largest over replicas of |residual at the end|/vibrating */
    int64_t drifted;       /* usable realizations with a drift above FRACAS_DRIFT_LIMIT */

    fracas_final final; /* the count when nothing more breaks */
    fracas_past past;

    fracas_ensemble ensemble; /* the usable realizations */

    /* Over the fragments of all usable realizations together. */
    size_t nfragments;
    double *fragment_size; /* m, ascending; made by finish */
    double elements;       /* elements of a mean fragment */
    double dust_share;     /* dust fragments/all fragments */
    uint64_t seed;         /* seed of all random draws, from the point's hash */
    fracas_pooled pooled;
    fracas_replica_convergence convergence; /* for the headline numbers */
    fracas_normalised normalised;
    fracas_bands bands; /* for the energies; made by a fracas_bands_collector */

    /* The replica whose dissipated energy is the nearest to the mean, the first of several. */
    int64_t typical_replica; /* -1 without a usable realization */
    size_t typical_row;      /* in the study */
    int64_t broken_replica;  /* the first FRAGMENTED one; -1 without one */
    size_t broken_row;
    size_t nhistory;
    fracas_history_row *history; /* for that replica; NULL until someone reads it */
    size_t nprobe;
    fracas_probe_row *probe; /* the same */
    size_t nreaction;
    fracas_reaction_row *reaction; /* the same */
} fracas_point_statistics;

/* A realization whose residual is a larger part of its largest energy is warned of; ENERGY_DRIFT
 * begins at 0.05. */
#define FRACAS_DRIFT_LIMIT 0.01
/* A point with a larger share of dust is warned of. */
#define FRACAS_DUST_LIMIT 0.05

/* Begins point `point` of the table, without realizations. */
void fracas_point_statistics_init(const fracas_point_table *table, size_t point,
                                  fracas_point_statistics *statistics);
/* Takes in the realization in row `row` of the study; `record` with its fragments. */
FRACAS_MUST_USE fracas_err fracas_point_statistics_add(fracas_point_statistics *statistics,
                                                       size_t row, int64_t replica,
                                                       const fracas_record *record);
/* Takes in the history of a realization that is usable; `record` with its history, if the study has
 * any. */
void fracas_point_statistics_add_history(fracas_point_statistics *statistics,
                                         const fracas_record *record);
/* Computes the estimates from all added realizations. */
FRACAS_MUST_USE fracas_err fracas_point_statistics_finish(fracas_point_statistics *statistics);
void fracas_point_statistics_clear(fracas_point_statistics *statistics);

/* Mean fragment size of a realization [m]: length/fragments of a chain, of a surface `mean`, that
 * of its fragments' sizes. */
double fracas_point_statistics_size(const fracas_point_statistics *statistics, int64_t fragments,
                                    double mean);

bool fracas_outcome_usable(int64_t outcome);
/* "FRAGMENTED"; "?" for an unknown number. */
const char *fracas_outcome_name(int64_t outcome);

/* Every number of a point's statistics, in fracas_point_statistics: the same keys in JSON and CSV,
 * in this order. */
extern const fracas_fields fracas_statistics;

#endif
