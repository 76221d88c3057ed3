/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/server.h"

#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/packet.h"
#include "campaigns/scheduler/worker/child.h"
#include "campaigns/scheduler/worker/compute.h"
#include "campaigns/scheduler/worker/models.h"
#include "campaigns/scheduler/worker/segment.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

/* A lease computed by the server itself. */
typedef struct {
    bool runs;
    fracas_computation computation;
    fracas_lease lease;
    size_t done;    /* realizations */
    double seconds; /* spent on them */
} own_lease;

typedef struct {
    int rank; /* connection to the rank */
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const char *study;
    fracas_lease waiting[FRACAS_LEASES_HELD];
    size_t first, nwaiting; /* a ring */
    fracas_child child;     /* this one or the next runs, or none */
    own_lease own;
    fracas_models models;
    fracas_segment segment;
    bool stopping; /* STOP came */
    bool orphan;   /* the rank is gone */
} server;

static bool works(const server *s)
{
    return s->child.pid || s->own.runs;
}

/* ---- messages to the rank ---- */

static fracas_err send_failed(server *s, const fracas_lease_failure *failure)
{
    return fracas_packet_send(s->rank, FRACAS_PACKET_FAILED, failure, sizeof *failure);
}

/* The lease has failed here: its batch of `count` realizations after the first `kept`. */
static fracas_err fail_lease(server *s, const fracas_lease *lease, size_t kept, size_t count)
{
    fracas_lease_failure failure = {.lease = lease->id, .kept = kept, .count = count};
    strncpy(failure.reason, fracas_message(), sizeof failure.reason - 1);
    return send_failed(s, &failure);
}

static fracas_err send_computed(server *s, uint64_t lease, double seconds)
{
    const fracas_lease_report report = {lease, seconds};
    return fracas_packet_send(s->rank, FRACAS_PACKET_COMPUTED, &report, sizeof report);
}

static fracas_err write_segment(server *s)
{
    fracas_packet *note;
    const double began = fracas_now();
    TRY(fracas_segment_write(&s->segment, s->study, s->campaign, s->options, &note));
    fracas_err err = fracas_packet_write(s->rank, note);
    free(note);
    s->child.deadline += fracas_now() - began; /* its messages have waited meanwhile */
    return err;
}

/* Adds the records of replica[0], replica[1] ... to the segment, which owns them from here on. */
static fracas_err add_records(server *s, uint64_t point, const int64_t *replica,
                              fracas_packet **record, size_t count)
{
    fracas_err err = FRACAS_OK;
    for (size_t i = 0; i < count; i++) {
        if (err) free(record[i]);
        else err = fracas_segment_add(&s->segment, (size_t)point, replica[i], record[i]);
    }
    return err;
}

/* ---- leases ---- */

/* Ends this process by SIGALRM after `seconds`; 0: no longer. */
static void set_alarm(double seconds)
{
    const double whole = floor(fmin(seconds, 1e9));
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)whole,
                     .tv_usec = (suseconds_t)(fmin(seconds - whole, 0.999999) * 1e6)}};
    setitimer(ITIMER_REAL, &timer, NULL);
}

/* Realizations in the batch of the lease after the first `done`. */
static size_t batch_of(const server *s, const fracas_lease *lease, size_t done)
{
    const size_t left = (size_t)lease->count - done, width = fracas_run_width(s->options);
    return left < width ? left : width;
}

/* Starts the next lease. An impossible model fails the lease, not the server. */
static fracas_err start_next(server *s)
{
    const fracas_lease *lease = &s->waiting[s->first];
    s->first = (s->first + 1) % FRACAS_LEASES_HELD;
    s->nwaiting--;
    fracas_computation computation = {
        .campaign = s->campaign, .options = s->options, .study = s->study, .lease = lease};
    if (lease->isolated) return fracas_child_start(&s->child, &computation, &s->models, s->rank);
    set_alarm(fmax(lease->limit, 0));
    fracas_err err = fracas_models_get(&s->models, &computation);
    set_alarm(0);
    if (err) return fail_lease(s, lease, 0, batch_of(s, lease, 0));
    if (s->options->isolation == FRACAS_ISOLATION_LEASE)
        return fracas_child_start(&s->child, &computation, &s->models, s->rank);
    s->own = (own_lease){.runs = true, .computation = computation};
    memcpy(&s->own.lease, lease, fracas_lease_bytes(lease));
    s->own.computation.lease = &s->own.lease;
    return FRACAS_OK;
}

/* Reads from the child. At its end its records go to the segment and a report to rank 0. */
static fracas_err receive_child(server *s)
{
    bool ended, good;
    TRY(fracas_child_receive(&s->child, &ended));
    if (!ended) return FRACAS_OK;
    fracas_child *child = &s->child;
    const double seconds = fracas_now() - child->began;
    const uint64_t lease = child->lease.id;
    fracas_lease_failure failure;
    TRY(fracas_child_collect(child, &good, &failure));
    const size_t count = child->count;
    child->count = 0; /* the segment owns them */
    TRY(add_records(s, child->lease.point, child->lease.replica, child->record, count));
    fracas_child_clear(child);
    s->segment.compute += seconds;
    return good ? send_computed(s, lease, seconds) : send_failed(s, &failure);
}

/* Computes one batch of the server's own lease. If the limit is over before, this batch is at
 * fault. */
static fracas_err advance(server *s)
{
    own_lease *own = &s->own;
    const bool limited = own->lease.limit > 0;
    const double left = own->lease.limit - own->seconds, began = fracas_now();
    fracas_packet *record[FRACAS_LANES_MAX];
    size_t count = batch_of(s, &own->lease, own->done);
    fracas_err err;
    if (limited && left <= 0) {
        err = fracas_fail(FRACAS_ENVIRONMENT,
                          "it took the %g s that a lease may take (--lease-limit)",
                          own->lease.limit);
    } else {
        set_alarm(limited ? fmax(left, 1e-3) : 0);
        err = fracas_compute_batch(&own->computation, own->done, record, &count);
        set_alarm(0);
    }
    const double seconds = fracas_now() - began;
    own->seconds += seconds;
    s->segment.compute += seconds;
    if (err) {
        own->runs = false;
        return fail_lease(s, &own->lease, own->done, count);
    }
    const bool empty = s->segment.count == 0;
    TRY(add_records(s, own->lease.point, own->lease.replica + own->done, record, count));
    if (empty) s->segment.began = began; /* batches write no segment: after a long one it is due */
    own->done += count;
    own->runs = own->done < own->lease.count;
    return own->runs ? FRACAS_OK : send_computed(s, own->lease.id, own->seconds);
}

/* ---- messages of the rank ---- */

static fracas_err on_stop(server *s, const fracas_packet *message)
{
    int32_t kill = 0;
    TRY(fracas_packet_body(message, &kill, sizeof kill));
    if (kill) {
        fracas_child_clear(&s->child);
        s->own.runs = false;
    }
    s->stopping = true;
    return FRACAS_OK;
}

static fracas_err on_lease(server *s, const fracas_packet *message)
{
    fracas_lease *lease = &s->waiting[(s->first + s->nwaiting) % FRACAS_LEASES_HELD];
    const size_t least = offsetof(fracas_lease, replica) + sizeof *lease->replica;
    if (message->size >= least && message->size <= sizeof *lease)
        memcpy(lease, message->body, message->size);
    else lease->count = 0;
    if (!lease->count || fracas_lease_bytes(lease) != message->size)
        return fracas_fail(FRACAS_BUG, "a lease of %u bytes", message->size);
    s->nwaiting++;
    return FRACAS_OK;
}

static fracas_err receive_rank(server *s)
{
    fracas_packet *message;
    TRY(fracas_packet_read(s->rank, &message));
    fracas_err err = FRACAS_OK;
    if (!message) s->orphan = true;
    else if (message->kind == FRACAS_PACKET_STOP) err = on_stop(s, message);
    else if (message->kind == FRACAS_PACKET_FLUSH)
        err = s->segment.count ? write_segment(s)
                               : fracas_packet_send(s->rank, FRACAS_PACKET_FLUSHED, NULL, 0);
    else if (message->kind == FRACAS_PACKET_LEASE && s->nwaiting < FRACAS_LEASES_HELD)
        err = on_lease(s, message);
    else err = fracas_fail(FRACAS_BUG, "a compute server got a message of kind %u", message->kind);
    free(message);
    return err;
}

/* ---- main loop ---- */

/* Has work without waiting for a message: a batch, the next lease, or the end. */
static bool has_more(const server *s)
{
    return s->own.runs || (!works(s) && (s->nwaiting || s->stopping));
}

/* Sleeps until a message comes, the segment is due or the child's time is over; not at all while
 * there is work. */
static fracas_err wait_and_receive(server *s)
{
    struct pollfd from[2] = {{.fd = s->rank, .events = POLLIN},
                             {.fd = s->child.fd, .events = POLLIN}};
    double wait = fracas_segment_wait(&s->segment, s->options);
    if (s->child.pid) wait = fmin(wait, s->child.deadline - fracas_now());
    if (has_more(s)) wait = 0;
    int timeout = isinf(wait) ? -1 : (int)fmin(ceil(fmax(wait, 0) * 1e3), 1e6);
    int ready = poll(from, s->child.pid ? 2 : 1, timeout);
    if (ready < 0 && errno != EINTR)
        return fracas_fail(FRACAS_ENVIRONMENT, "a compute server cannot wait: %s", strerror(errno));
    if (ready < 0) return FRACAS_OK;
    if (s->child.pid && ready > 0 && from[1].revents) TRY(receive_child(s));
    else if (s->child.pid && fracas_now() >= s->child.deadline) fracas_child_expire(&s->child);
    if (ready > 0 && from[0].revents) TRY(receive_rank(s));
    return FRACAS_OK;
}

/* Until STOP is obeyed or the rank is gone. */
static fracas_err serve(server *s)
{
    TRY(fracas_packet_send(s->rank, FRACAS_PACKET_READY, &s->campaign->hash, sizeof(fracas_hash)));
    while (!s->orphan) {
        if (!works(s) && s->stopping) {
            if (s->segment.count) TRY(write_segment(s));
            return fracas_packet_send(s->rank, FRACAS_PACKET_ENDED, NULL, 0);
        }
        while (!works(s) && s->nwaiting && !s->stopping) TRY(start_next(s));
        if (s->own.runs) TRY(advance(s));
        if (fracas_segment_wait(&s->segment, s->options) <= 0) TRY(write_segment(s));
        TRY(wait_and_receive(s));
    }
    return FRACAS_OK;
}

_Noreturn void fracas_server_run(const fracas_campaign *campaign, const fracas_run_options *options,
                                 const char *study, int rank)
{
    signal(SIGALRM, SIG_DFL); /* set_alarm */
    server s = {.rank = rank, .campaign = campaign, .options = options, .study = study};
    fracas_err err = serve(&s);
    if (err) {
        fracas_trouble trouble;
        fracas_trouble_take(err, &trouble);
        fracas_child_clear(&s.child);
        err = fracas_packet_send(s.rank, FRACAS_PACKET_TROUBLE, &trouble, sizeof trouble);
    }
    fracas_child_clear(&s.child);
    fracas_segment_clear(&s.segment);
    fracas_models_clear(&s.models);
    _exit(err ? FRACAS_ENVIRONMENT : 0); /* not exit: it would run the rank's handlers */
}
