/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/director/state.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

static const double TICK = 0.25;   /* between two ticks [s] */
static const double PATIENCE = 10; /* for the answer to STOP when everything is durable [s] */
static const double MARGIN = 2;    /* before the deadline, to write segments [s] */

/* Duration of the end [s]: workers write their last segments, and each is committed. */
static double margin(const fracas_director *director)
{
    const double commit = director->timings.commits > 0
                              ? director->timings.committing / (double)director->timings.commits
                              : 0;
    return MARGIN + commit * (double)director->setup.workers;
}

bool fracas_director_too_late(const fracas_director *director, size_t worker, double time)
{
    if (director->setup.deadline == 0) return false;
    const double seconds = fracas_scheduler_predicted(director->scheduler, worker, time);
    return time + (isnan(seconds) ? 0 : seconds) + margin(director) > director->setup.deadline;
}

/* Idle workers get copies of overdue leases. */
static fracas_err lease_overdue(fracas_director *director, double time)
{
    fracas_lease lease;
    int refused = 0; /* once: the overdue lease may be the worker's own; twice: there is none */
    for (size_t worker = 0; refused < 2 && worker < director->setup.workers; worker++) {
        size_t late;
        bool given;
        if (director->phase[worker] != WORKING ||
            !fracas_scheduler_idles(director->scheduler, worker))
            continue;
        fracas_scheduler_overdue(director->scheduler, worker, time, &lease, &late, &given);
        refused += !given;
        if (!given) continue;
        char text[200];
        snprintf(text, sizeof text,
                 "%" PRIu64 " realizations of point %" PRIu64 ", replica %" PRId64
                 " the first, take rank %zu far longer than predicted to compute or write: rank "
                 "%zu computes them as well",
                 lease.count, lease.point, lease.replica[0], late, worker);
        TRY(fracas_index_event(director->index, "overdue", text));
        TRY(fracas_director_post(director, worker, FRACAS_PACKET_LEASE, &lease,
                                 fracas_lease_bytes(&lease)));
    }
    return FRACAS_OK;
}

/* Some worker has a lease, or may get one before the deadline. Not all have ended. */
static bool goes_on(const fracas_director *director, double time)
{
    size_t idle = 0; /* any: all would get the same */
    for (size_t worker = 0; worker < director->setup.workers; worker++) {
        if (director->phase[worker] == ENDED) continue;
        if (!fracas_scheduler_idles(director->scheduler, worker)) return true;
        idle = worker;
    }
    return !fracas_director_too_late(director, idle, time);
}

static void mind_deadline(fracas_director *director, double time)
{
    if (director->setup.deadline == 0 || director->overtime) return;
    const bool over = time + margin(director) >= director->setup.deadline;
    if (!over && (director->stopping || goes_on(director, time))) return;
    director->late = director->late || !director->stopping;
    director->overtime = over;
    if (!director->stopping) fracas_director_drain(director);
    else
        for (size_t worker = 0; worker < director->setup.workers; worker++)
            if (director->phase[worker] == STOPPING) fracas_director_stop_worker(director, worker);
}

/* Gives up silent workers when everything is durable or no time is left. */
static fracas_err give_up(fracas_director *director, double time)
{
    const bool needless = fracas_director_durable(director) &&
                          time > director->stopped_at + PATIENCE;
    const bool out_of_time = director->overtime && time >= director->setup.deadline;
    if (!needless && !out_of_time) return FRACAS_OK;
    for (size_t worker = 0; worker < director->setup.workers; worker++) {
        if (director->phase[worker] == ENDED) continue;
        char text[128];
        snprintf(text, sizeof text, "rank %zu did not stop within %.0f s; the run ends without it",
                 worker, time - director->stopped_at);
        fracas_director_end_worker(director, worker);
        TRY(fracas_director_announce(director, "worker silent", text));
    }
    return FRACAS_OK;
}

void fracas_director_tick(fracas_director *director)
{
    const double time = director->setup.now();
    if (time < director->ticked + TICK) return;
    director->ticked = time;
    mind_deadline(director, time);
    fracas_director_check(director, director->stopping ? give_up(director, time)
                                                       : lease_overdue(director, time));
}
