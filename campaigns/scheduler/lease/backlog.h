/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replicas of each point never leased so far, with the measured times. Each query and each change
 * takes O(log points) steps.
 *   est_p = seconds per realization of point p: measured at p, else cost_p x measured seconds per
 *           cost of all points, else (nothing is measured) cost_p */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LEASE_BACKLOG_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LEASE_BACKLOG_H

#include "base/own.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct fracas_backlog fracas_backlog;

/* `cost`: predicted for a realization of each point; `first`: points to go before all others,
 * NULL: none. Both must outlive the backlog. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_backlog_create(const double *cost, const bool *first,
                                                 size_t npoints, fracas_backlog **backlog);
void fracas_backlog_destroy(fracas_backlog *backlog); /* NULL is allowed */
FRACAS_OWNER(fracas_backlog, fracas_backlog_destroy)

/* Appends `count` replicas of a point. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_backlog_add(fracas_backlog *backlog, size_t point,
                                              const int64_t *replica, size_t count);
/* Shuffles the replicas of a point; `state` as in fracas_backlog_random. */
void fracas_backlog_shuffle(fracas_backlog *backlog, size_t point, uint64_t *state);
/* Takes the first `count` replicas, at most fracas_backlog_waiting. Valid until the next
 * fracas_backlog_add of the point. */
const int64_t *fracas_backlog_take(fracas_backlog *backlog, size_t point, size_t count);

/* `count` realizations of a point took `seconds`. */
void fracas_backlog_measure(fracas_backlog *backlog, size_t point, size_t count, double seconds);
bool fracas_backlog_measured(const fracas_backlog *backlog);                 /* any point */
double fracas_backlog_estimate(const fracas_backlog *backlog, size_t point); /* est_p */

size_t fracas_backlog_waiting(const fracas_backlog *backlog, size_t point);
double fracas_backlog_work(const fracas_backlog *backlog); /* sum_p waiting_p est_p */
/* Point with the largest est_p among those with waiting replicas, first among the `first`
 * points. Ties: the lower number. SIZE_MAX if nothing waits. */
size_t fracas_backlog_longest(const fracas_backlog *backlog);
/* A random point with waiting replicas, all equally likely. Something waits. */
size_t fracas_backlog_any(const fracas_backlog *backlog, uint64_t *state);

/* splitmix64 (Steele, Lea and Flood 2014). It only orders work, so the sampler's streams are not
 * needed. */
uint64_t fracas_backlog_random(uint64_t *state);

#endif
