/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a plan: what each point will cost. */
#ifndef FRACAS_CAMPAIGNS_PLAN_FORECAST_H
#define FRACAS_CAMPAIGNS_PLAN_FORECAST_H

#include "campaigns/campaign.h"

typedef struct {
    int64_t elements, interfaces, steps;
    double time_step; /* s */
    double speed;     /* element-steps per second of one core; 0 until it is timed */
    double time;      /* s, of all replicas (where a rule decides, of the most) on all jobs */
    double bytes;     /* in study.h5 */
    double
        coarseness; /* element size over E G_c/sigma_c^2, the length over which a crack softens */
    bool uniform;   /* half of the interfaces and more have the same strength */
    bool lines;     /* so it is, and the mesh is a regular one of triangles: cracks will follow its
                       lines */
    double spread; /* of the strengths of 98 of 100 interfaces [Pa], where a step forgets those that
                      it passes; else NaN */
    double step_stress; /* E |rate| dt [Pa]; NaN where the loading gives no strain rate */
    double turn; /* a ring's time from its greatest speed to its turning point: pi/2 R/c [s] */
    bool folds;  /* a ring is driven inward, or swings back whole and then inward before time.end */
    double turned;  /* angle by which a ring turns until time.end, where its interfaces open along
                       initial directions [rad] */
    bool lonely;    /* the fracture-limiting zone of one interface reaches around the ring */
    bool repeated;  /* strengths are given, so that replicas are equal, and there are several */
    double mean;    /* strength of an interface [Pa] */
    double element; /* mean element size [m] */
    double extent;  /* of the body, where strengths are correlated: diagonal of the box around its
                       interfaces [m] */
    bool flat;      /* a factor of the strengths is given, and is the same at all interfaces */
    double bound; /* stress that the uncracked body stays below until time.end [Pa]; INFINITY where
                     none is known */
} fracas_forecast;

/* Elements, time step, steps, coarseness of one point (speed 0). Refused if strengths are given and
 * not as many as there are interfaces, or not at their positions, or if the engine would refuse the
 * strength that the strongest of all its interfaces and replicas stays below with a probability of
 * 99 %. */
FRACAS_MUST_USE fracas_err fracas_forecast_make(const fracas_campaign *campaign, size_t point,
                                                fracas_forecast *forecast);

/* All of them, timed; `forecast` has room for every point. */
FRACAS_MUST_USE fracas_err fracas_forecast_all(const fracas_campaign *campaign, int jobs,
                                               fracas_forecast *forecast);

#endif
