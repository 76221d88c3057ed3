/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Predicted cost and stresses of each point, and warnings by them before its run. */
#ifndef FRACAS_CAMPAIGNS_PLAN_FORECAST_H
#define FRACAS_CAMPAIGNS_PLAN_FORECAST_H

#include "base/lines.h"
#include "campaigns/campaign.h"
#include "engine/mesh/surface/survey.h"

typedef struct {
    int64_t elements, interfaces, steps;
    double time_step;   /* s */
    double speed;       /* element-steps per second of one core; 0 until it is timed */
    double time;        /* for all replicas (with a rule, the maximum) on all jobs [s] */
    double bytes;       /* all replicas have in study.h5 */
    double memory;      /* a process takes for it, without libraries [bytes] */
    double coarseness;  /* element size over E G_c/sigma_c^2, a crack's softening length */
    bool uniform;       /* at least half of the interfaces have the same strength */
    bool equal;         /* all interfaces have the same strength */
    bool lines;         /* uniform, on a regular mesh: cracks will follow its lines */
    double spread;      /* 1 % to 99 % range of strengths [Pa], for laws without flux; else NaN */
    double step_stress; /* E |rate| dt [Pa]; NaN without a strain rate */
    int64_t parts;      /* parallel.parts */
    size_t parts_most;  /* into which the body can be divided */
    double transits;    /* k at time.end, of fragments of Grady's size; NaN as step_stress */
    double long_safety; /* largest time.safety for long runs */
    double turn;        /* pi/2 R/c, from a ring's greatest speed to its turning point [s] */
    bool folds;         /* a whole ring moves inward before time.end */
    double turned;      /* turn of a ring with initial opening directions until time.end [rad] */
    bool zone_covers_ring; /* the fracture-limiting zone of one interface reaches around the ring */
    bool repeated;         /* several replicas with strengths from a file: all are equal */
    double mean;           /* strength of an interface [Pa] */
    double element;        /* mean element size [m] */
    fracas_surface_survey mesh; /* a mesh file's; no parts: another body */
    fracas_surface_group loose; /* the least physical group of edges without a key; 0: none */
    size_t nloose;              /* such groups */
    bool unheld;                /* `edges` holds no edge: all are of groups with keys */
    fracas_surface_group inner; /* the least physical group of edges between elements; 0: none */
    double extent;              /* diagonal of the box around all interfaces [m] */
    bool flat;                  /* a factor of the strengths is the same at all interfaces */
    double volume;              /* a mean interface has [m3] */
    double mesh_effect; /* share of the count that halved elements lose (fracas_mesh_effect) */
    double mesh_effect_bounded; /* share lost or gained so above a least strength */
    double factor;              /* the least of the factors of the strengths; 1: none is below */
    double opening;             /* critical opening there, at the mean strength [m] */
    double available;           /* opening that the load can give an interface until time.end [m] */
    bool unbroken;  /* at the strongest 1 % of strengths the opening there is larger ... */
    bool whole;     /* ... also where the factor is largest */
    double pieces;  /* size of fragments there, by Grady's law [m]; NaN without a strain rate */
    double scatter; /* standard deviation of the strengths by their mean */
    double fragments, history; /* rows of a realization */
    int tried;                 /* realizations that were computed for that; 0: none */
    int intact, lost;          /* among them: INTACT; ENERGY_DRIFT or NONFINITE */
    double ratio;       /* fragments by those of the scaling law, where some were tried; 0: none */
    bool estimated;     /* from a coarser mesh, without a check of strengths */
    double bound;       /* on the stress in the uncracked body until time.end [Pa] */
    bool stress_grows;  /* it is larger until twice that time ... */
    bool opening_grows; /* ... and so is `available` */
    fracas_lines_doubts doubts; /* about a file of strengths, factors or a load's history ... */
    const char *doubted;        /* ... of this name; NULL: none */
    double started;             /* fastest node at the start, by `initial` [m/s] */
    double released; /* share of the initial stress without an edge to keep it (start.h) */
} fracas_forecast;

/* The forecast of one point, without speed, time and bytes. FRACAS_USAGE if strengths from a file
 * do not match the interfaces, or if the engine refuses the 99 % quantile of the strongest
 * interface of all replicas. */
FRACAS_MUST_USE fracas_err fracas_forecast_make(const fracas_campaign *campaign, size_t point,
                                                fracas_forecast *forecast);

/* Forecasts of all points, timed. quick: those of surfaces with more than FRACAS_FORECAST_QUICK
 * divisions are estimated from a mesh of so many, r times as coarse: elements and interfaces grow
 * by r^2, steps by r (by up to r^2 where bending limits them), and strengths are not checked. After
 * some seconds, and before large meshes, it says on stderr where it is. */
enum { FRACAS_FORECAST_QUICK = 64 };
FRACAS_MUST_USE fracas_err fracas_forecast_all(const fracas_campaign *campaign, int jobs,
                                               bool quick, fracas_forecast *forecast);

/* Realizations computed side by side. */
size_t fracas_forecast_lanes(const fracas_point *point);

/* Realizations are computed for the numbers of their rows until chains' steps have passed through
 * so many bytes of state, about a second. It is no time: equal plans count equal realizations. */
static const double FRACAS_ROWS_BUDGET = 6e9;

/* Writes a warning; how bad it is (> 0), to be compared among points, or 0, with any text, if it
 * does not apply. */
typedef double fracas_plan_warning(const fracas_point *point, const fracas_forecast *forecast,
                                   char *text, size_t size);

/* Factor by which rotary inertia would lengthen the time step: 2.5 thickness/edge, at least 1 (2.5
 * to 3.1 on spheres with thickness/edge from 0.5 to 2.5); 1 for a body that has it or does not
 * bend. */
double fracas_bending_steps(const fracas_spec *spec, double element);

/* A run says the first of them itself before it begins: of meshes that make another body. */
enum { FRACAS_PLAN_WARNINGS = 45, FRACAS_RUN_WARNINGS = 3, FRACAS_WARNING_TEXT = 400 /* bytes */ };
extern fracas_plan_warning *const fracas_plan_warnings[FRACAS_PLAN_WARNINGS];
/* One of them: no realization breaks. */
fracas_plan_warning fracas_plan_warn_unbroken;

#endif
