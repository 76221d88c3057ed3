/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replicas of each point that were never given out, and what a realization takes by what was
 * measured so far. Every question is answered, and every change made, in log(points) steps at most,
 * however many realizations wait. est_p = s per realization of point p: measured of its own, else
 * cost_p times the measured s per cost of all points, else (nothing is measured at all) cost_p
 * itself */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LEASE_BACKLOG_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LEASE_BACKLOG_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct fracas_backlog fracas_backlog;

/* `cost`: predicted for a realization of each point; `first`: which points go before all others,
 * NULL: none. Both must outlive the backlog. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_backlog_create(const double *cost, const bool *first,
                                                 size_t npoints, fracas_backlog **backlog);
void fracas_backlog_destroy(fracas_backlog *backlog); /* NULL is allowed */

/* `count` replicas of a point wait behind those that are there. FRACAS_ENVIRONMENT without memory.
 */
FRACAS_MUST_USE fracas_err fracas_backlog_add(fracas_backlog *backlog, size_t point,
                                              const int64_t *replica, size_t count);
/* Puts what waits of a point into an order that `state` decides, which moves on. */
void fracas_backlog_shuffle(fracas_backlog *backlog, size_t point, uint64_t *state);
/* Takes the first `count`, at most fracas_backlog_waiting of the point: valid until replicas are
 * added to it. */
const int64_t *fracas_backlog_take(fracas_backlog *backlog, size_t point, size_t count);

/* `count` realizations of a point took `seconds`. */
void fracas_backlog_measure(fracas_backlog *backlog, size_t point, size_t count, double seconds);
bool fracas_backlog_measured(const fracas_backlog *backlog); /* anything, of any point */
double fracas_backlog_estimate(const fracas_backlog *backlog, size_t point); /* est_p */

size_t fracas_backlog_waiting(const fracas_backlog *backlog, size_t point);
double fracas_backlog_work(const fracas_backlog *backlog); /* sum of est_p over all that waits */
/* Of the points of which something waits, those that go first if there are any, the one with the
 * largest est_p, the first of equal ones; SIZE_MAX if nothing waits. */
size_t fracas_backlog_longest(const fracas_backlog *backlog);
/* Any point of which something waits, each as likely; SIZE_MAX if nothing waits. */
size_t fracas_backlog_any(const fracas_backlog *backlog, uint64_t *state);

/* splitmix64 (Steele, Lea and Flood 2014): only orders work, so it need not be one of the sampler's
 * streams. */
uint64_t fracas_backlog_random(uint64_t *state);

#endif
