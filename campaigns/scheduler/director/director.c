/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/director/director.h"

#include "campaigns/scheduler/director/state.h"
#include "campaigns/scheduler/session/failures.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/session/space.h"
#include "campaigns/store/lock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- start ---- */

static fracas_err make_scheduler(fracas_director *director)
{
    const fracas_campaign *campaign = director->setup.campaign;
    OWNED fracas_index_row *row = NULL;
    size_t count;
    TRY(fracas_rounds_init(&director->rounds, campaign, director->index));
    TRY(fracas_index_rows(director->index, &director->rounds.table, &row, &count));
    fracas_scheduler_options options = {.cost = director->setup.cost,
                                        .first = director->ruled,
                                        .npoints = campaign->npoints,
                                        .workers = director->setup.workers,
                                        .width = fracas_run_width(director->setup.options),
                                        .seconds = director->setup.options->lease_seconds,
                                        .memory = director->setup.options->segment_age,
                                        .limit = director->setup.options->lease_limit,
                                        .parts = (size_t)campaign->parallel.parts,
                                        .shuffle = director->setup.options->shuffle,
                                        .seed = campaign->seed};
    count = fracas_run_part(director->setup.options->part, director->setup.options->parts, row,
                            count);
    TRY(fracas_scheduler_create(row, count, &options, &director->scheduler));
    for (size_t p = 0; p < campaign->npoints; p++)
        director->given[p] = director->rounds.point[p].replicas;
    return FRACAS_OK;
}

/* Tells the user and the index the state of the study and the work to do. */
static fracas_err announce(fracas_director *director, const char *report)
{
    fracas_counts count = fracas_scheduler_count(director->scheduler);
    const fracas_run_options *options = director->setup.options;
    char text[256], part[64] = "";
    if (options->parts > 1)
        snprintf(part, sizeof part, "part %d of %d, ", options->part, options->parts);
    snprintf(text, sizeof text, "%s%lld of %lld realizations of %zu point%s to do%s, %zu worker%s",
             part, (long long)(count.total - count.done - count.failed), (long long)count.total,
             director->setup.campaign->npoints, director->setup.campaign->npoints == 1 ? "" : "s",
             director->rounds.open ? ", and more as rules ask for them" : "",
             director->setup.workers, director->setup.workers == 1 ? "" : "s");
    if (*report) TRY(fracas_director_announce(director, "recovered", report));
    if (!options->quiet)
        fracas_channel_message(director->setup.channel, "%s: %s", director->setup.study, text);
    fracas_channel_progress(director->setup.channel, &count);
    return fracas_index_event(director->index, count.done ? "resumed" : "started", text);
}

static fracas_err open_study(fracas_director *director, bool *complete, int64_t *failed)
{
    const fracas_director_setup *setup = &director->setup;
    OWNED char *report = NULL;
    TRY(fracas_study_prepare(setup->study, setup->campaign, setup->options->force, &director->lock,
                             &director->index, &report));
    TRY(fracas_study_is_complete(setup->study, director->index, setup->campaign, complete, failed));
    TRY(fracas_index_set_part(director->index, setup->options->part, setup->options->parts));
    if (*complete) return FRACAS_OK;
    TRY(make_scheduler(director));
    return announce(director, report);
}

/* A launcher, if there is one, has warned and looked at the disk. */
static fracas_err find_costs(fracas_director *director)
{
    fracas_director_setup *setup = &director->setup;
    const bool launched = setup->channel->launcher;
    OWNED double *bytes = NULL;
    TRY(fracas_costs_create(setup->campaign, setup->options, launched ? NULL : stderr,
                            &director->cost, &bytes));
    setup->cost = director->cost;
    if (launched) return FRACAS_OK;
    return fracas_space_check(setup->study, setup->campaign, setup->options, bytes);
}

static fracas_err set_up(fracas_director *director, bool *complete, int64_t *failed)
{
    director->phase = calloc(director->setup.workers, sizeof *director->phase);
    director->flushing = calloc(director->setup.workers, sizeof *director->flushing);
    director->given = calloc(director->setup.campaign->npoints, sizeof *director->given);
    director->ruled = calloc(director->setup.campaign->npoints, sizeof *director->ruled);
    if (!director->phase || !director->flushing || !director->given || !director->ruled)
        return fracas_no_memory("the workers");
    for (size_t p = 0; p < director->setup.campaign->npoints; p++)
        director->ruled[p] = director->setup.campaign->point[p].rule.maximum > 0;
    if (!director->setup.cost) TRY(find_costs(director)); /* an impossible one leaves no files */
    return open_study(director, complete, failed);
}

/* Not before: should a worker be lost, the others are there to compute its leases again. */
static void stop_if_durable(fracas_director *director)
{
    if (!fracas_director_durable(director)) return;
    director->needless = true;
    fracas_director_stop(director);
}

fracas_err fracas_director_create(const fracas_director_setup *setup, fracas_director **director,
                                  fracas_err *result)
{
    fracas_director *d = calloc(1, sizeof *d);
    if (!d) return fracas_no_memory("the run");
    d->setup = *setup;
    d->lock = -1;
    fracas_timings_begin(&d->timings);
    bool complete = false;
    int64_t failed = 0;
    fracas_err err = set_up(d, &complete, &failed);
    d->timings.planned = fracas_timings_time(&d->timings);
    if (err || complete) {
        *result = err || !failed
                      ? err
                      : fracas_failure_report(setup->study, d->index, &setup->campaign->table);
        fracas_director_destroy(d);
        *director = NULL;
        return err;
    }
    *director = d;
    d->resumed_whole = fracas_director_computed(d);
    stop_if_durable(d); /* only study.h5 is missing */
    return FRACAS_OK;
}

void fracas_director_destroy(fracas_director *director)
{
    fracas_scheduler_destroy(director->scheduler);
    fracas_rounds_clear(&director->rounds);
    fracas_index_close(director->index);
    fracas_study_unlock(director->lock);
    free(director->cost);
    free(director->ruled);
    free(director->phase);
    free(director->flushing);
    free(director->given);
    free(director);
}

/* ---- leases ---- */

/* Marks the lease in the index, by runs of consecutive replicas. */
static fracas_err mark_leased(fracas_director *director, const fracas_lease *lease)
{
    const fracas_hash *point = &director->setup.campaign->point[lease->point].hash;
    for (size_t from = 0, to; from < lease->count; from = to) {
        for (to = from + 1; to < lease->count && lease->replica[to] == lease->replica[to - 1] + 1;
             to++)
            ;
        TRY(fracas_index_lease(director->index, point, lease->replica[from], (int64_t)(to - from)));
    }
    return FRACAS_OK;
}

static fracas_err lease_worker(fracas_director *director, size_t worker)
{
    fracas_lease lease;
    while (!director->stopping && director->phase[worker] == WORKING) {
        const double time = director->setup.now();
        bool given;
        if (fracas_director_too_late(director, worker, time)) break;
        TRY(fracas_scheduler_next(director->scheduler, worker, time, &lease, &given));
        if (!given) break;
        TRY(mark_leased(director, &lease));
        TRY(fracas_director_post(director, worker, FRACAS_PACKET_LEASE, &lease,
                                 fracas_lease_bytes(&lease)));
        director->timings.leases++;
        director->timings.giving += director->setup.now() - time;
    }
    return FRACAS_OK;
}

static fracas_err lease_all(fracas_director *director)
{
    for (size_t worker = 0; worker < director->setup.workers; worker++)
        TRY(lease_worker(director, worker));
    return FRACAS_OK;
}

/* ---- rounds ---- */

/* Adds the new replicas of point p, as its rounds have decided. */
static fracas_err add_more(fracas_director *director, size_t p)
{
    const fracas_point_row *point = &director->rounds.point[p];
    const size_t more = (size_t)(point->replicas - director->given[p]);
    if (!more) return FRACAS_OK;
    OWNED fracas_index_row *row = malloc(more * sizeof *row);
    if (!row) return fracas_no_memory("the plan");
    TRY(fracas_index_rows_from(director->index, point, p, director->given[p], row));
    TRY(fracas_scheduler_add(director->scheduler, row, more));
    director->given[p] = point->replicas;
    return FRACAS_OK;
}

static fracas_err add_all(fracas_director *director)
{
    for (size_t p = 0; p < director->setup.campaign->npoints; p++) TRY(add_more(director, p));
    return lease_all(director);
}

static bool anyone_idles(const fracas_director *director)
{
    for (size_t worker = 0; worker < director->setup.workers; worker++)
        if (director->phase[worker] == WORKING &&
            fracas_scheduler_idles(director->scheduler, worker))
            return true;
    return false;
}

/* Lets all workers write their segments when everything is computed, or when rounds wait for a
 * decision and some worker is idle: a working one may be busy with a slower point. */
static fracas_err flush_all(fracas_director *director)
{
    const bool rounds_wait = director->rounds.open > 0 && anyone_idles(director);
    if (director->stopping || !(rounds_wait || fracas_director_computed(director)))
        return FRACAS_OK;
    for (size_t worker = 0; worker < director->setup.workers; worker++) {
        if (director->flushing[worker] || director->phase[worker] != WORKING ||
            !fracas_scheduler_keeps(director->scheduler, worker))
            continue;
        director->flushing[worker] = true;
        TRY(fracas_director_post(director, worker, FRACAS_PACKET_FLUSH, NULL, 0));
    }
    return FRACAS_OK;
}

/* ---- messages of workers ---- */

static fracas_err on_ready(fracas_director *director, size_t worker, const fracas_packet *message)
{
    director->phase[worker] = WORKING;
    if (director->stopping) {
        fracas_director_stop_worker(director, worker);
        return FRACAS_OK;
    }
    fracas_hash campaign;
    TRY(fracas_packet_body(message, &campaign, sizeof campaign));
    if (!fracas_hash_equal(&campaign, &director->setup.campaign->hash))
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "rank %zu read another campaign from %s than rank 0: it changed while "
                           "the run started, or is not the same file on all hosts",
                           worker, director->setup.options->file);
    return lease_worker(director, worker);
}

static fracas_err on_computed(fracas_director *director, size_t worker,
                              const fracas_packet *message)
{
    fracas_lease_report report;
    TRY(fracas_packet_body(message, &report, sizeof report));
    TRY(fracas_scheduler_computed(director->scheduler, worker, report.lease, director->setup.now(),
                                  report.seconds));
    return lease_worker(director, worker);
}

/* Notes a failed lease: one failed realization, or the two halves to be tried next. */
static fracas_err note_failed(fracas_director *director, const fracas_lease *lease, bool final,
                              const char *reason)
{
    char text[1400];
    const unsigned long long number = lease->point, count = lease->count;
    const long long replica = lease->replica[0];
    const fracas_hash *point = &director->setup.campaign->point[lease->point].hash;
    const fracas_hash_text hex = fracas_hash_hex(point);
    if (count == 0) {
        snprintf(text, sizeof text, "a lease of point %llu (%s) that another worker has too: %s",
                 number, hex.text, reason);
        return fracas_index_event(director->index, "copy failed", text);
    }
    if (count > 1) {
        snprintf(text, sizeof text,
                 "%llu realizations of point %llu (%s), replica %lld the first, are tried in two "
                 "halves: %s",
                 count, number, hex.text, replica, reason);
        return fracas_index_event(director->index, "lease failed", text);
    }
    snprintf(text, sizeof text, "replica %lld of point %llu (%s) FAILED %s: %s", replica, number,
             hex.text, final ? "for good" : "and is tried again", reason);
    TRY(fracas_index_fail(director->index, point, replica, reason, final));
    if (!final) return fracas_index_event(director->index, "failed", text);
    TRY(fracas_director_announce(director, "failed", text));
    if (director->rounds.stopped[lease->point]) return FRACAS_OK;
    return fracas_rounds_advance(&director->rounds, director->index, (size_t)lease->point);
}

static fracas_err on_failed(fracas_director *director, size_t worker, const fracas_packet *message)
{
    fracas_lease_failure failure;
    fracas_lease lease;
    bool final;
    TRY(fracas_packet_body(message, &failure, sizeof failure));
    TRY(fracas_scheduler_failed(director->scheduler, worker, failure.lease, director->setup.now(),
                                (size_t)failure.kept, (size_t)failure.count, &lease, &final));
    TRY(note_failed(director, &lease, final, failure.reason));
    return add_all(director);
}

/* Commits a segment: its realizations are done from here on. */
static fracas_err on_segment(fracas_director *director, size_t worker, const fracas_packet *message)
{
    fracas_segment_note note;
    TRY(fracas_packet_body(message, &note, sizeof note));
    const size_t room = message->size - sizeof note;
    if (!room || note.rows > (room - 1) / sizeof(fracas_segment_row) ||
        message->body[message->size - 1] != '\0')
        return fracas_fail(FRACAS_BUG, "a message of rank %zu about a segment is damaged", worker);
    const fracas_segment_row *row = (const void *)(message->body + sizeof note);
    const double began = director->setup.now();
    TRY(fracas_index_commit(director->index, note.name, &note.seal, row, (size_t)note.rows,
                            (const char *)(row + note.rows)));
    director->timings.committing += director->setup.now() - began;
    director->timings.commits++;
    director->timings.rows += (double)note.rows;
    fracas_scheduler_durable(director->scheduler, worker);
    director->flushing[worker] = false;
    if (director->rounds.open == 0) return FRACAS_OK;
    TRY(fracas_rounds_commit(&director->rounds, director->index, row, (size_t)note.rows));
    return add_all(director);
}

/* All its records are in segments committed before. */
static fracas_err on_flushed(fracas_director *director, size_t worker)
{
    if (director->trouble.code) return FRACAS_OK; /* a commit may have failed */
    fracas_scheduler_durable(director->scheduler, worker);
    director->flushing[worker] = false;
    return FRACAS_OK;
}

static fracas_err on_end(fracas_director *director, size_t worker, const fracas_packet *message)
{
    fracas_director_end_worker(director, worker);
    if (message->kind == FRACAS_PACKET_ENDED) return FRACAS_OK;
    fracas_trouble trouble;
    TRY(fracas_packet_body(message, &trouble, sizeof trouble));
    if (message->kind == FRACAS_PACKET_TROUBLE) {
        fracas_director_fail(director, &trouble);
        return FRACAS_OK;
    }
    TRY(fracas_index_event(director->index, "worker lost", trouble.text));
    if (!fracas_director_over(director)) {
        fracas_channel_message(director->setup.channel, "%s; the others go on", trouble.text);
        return lease_all(director);
    }
    if (director->stopping) return FRACAS_OK;
    director->setup.channel->again = director->setup.channel->launcher && trouble.again;
    fracas_director_fail(director, &trouble);
    return FRACAS_OK;
}

/* The worker's server died, and READY of a new one follows. Leases of the dead one wait again. */
static fracas_err on_replaced(fracas_director *director, size_t worker,
                              const fracas_packet *message)
{
    fracas_trouble trouble;
    TRY(fracas_packet_body(message, &trouble, sizeof trouble));
    fracas_scheduler_lost(director->scheduler, worker);
    director->phase[worker] = STARTING;
    director->flushing[worker] = false;
    /* First: without it the new server hears nothing, not even STOP after an error below. */
    TRY(fracas_director_post(director, worker, FRACAS_PACKET_FRESH, NULL, 0));
    TRY(fracas_director_announce(director, "server replaced", trouble.text));
    return lease_all(director);
}

static fracas_err act(fracas_director *director, size_t worker, const fracas_packet *message)
{
    switch ((fracas_packet_kind)message->kind) {
    case FRACAS_PACKET_READY: return on_ready(director, worker, message);
    case FRACAS_PACKET_COMPUTED: return on_computed(director, worker, message);
    case FRACAS_PACKET_FAILED: return on_failed(director, worker, message);
    case FRACAS_PACKET_SEGMENT: return on_segment(director, worker, message);
    case FRACAS_PACKET_FLUSHED: return on_flushed(director, worker);
    case FRACAS_PACKET_REPLACED: return on_replaced(director, worker, message);
    case FRACAS_PACKET_TROUBLE:
    case FRACAS_PACKET_LOST:
    case FRACAS_PACKET_ENDED: return on_end(director, worker, message);
    case FRACAS_PACKET_DRAIN: fracas_director_drain(director); return FRACAS_OK;
    default: return fracas_fail(FRACAS_BUG, "rank 0 got a message of kind %u", message->kind);
    }
}

void fracas_director_receive(fracas_director *director, size_t worker, const fracas_packet *message)
{
    if (director->phase[worker] == ENDED && message->kind != FRACAS_PACKET_DRAIN) return; /* gone */
    director->timings.messages++;
    fracas_director_check(director, act(director, worker, message));
    fracas_director_check(director, flush_all(director));
    stop_if_durable(director);
    fracas_counts count = fracas_scheduler_count(director->scheduler);
    fracas_channel_progress(director->setup.channel, &count);
}
