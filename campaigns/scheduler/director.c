/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/director_state.h"

#include "campaigns/scheduler/study/costs.h"
#include "campaigns/scheduler/study/meshes.h"
#include "campaigns/scheduler/study/prepare.h"
#include "campaigns/scheduler/study/share.h"
#include "campaigns/scheduler/study/space.h"
#include "campaigns/scheduler/study/verdict.h"
#include "campaigns/scheduler/tally.h"
#include "campaigns/scheduler/worker/segment.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double MERGE_RATE = 50e6; /* bytes/s that a merge reads and writes at least */

static void stop(fracas_director *director);

/* Keeps the first thing that went wrong and drains. */
static void fail(fracas_director *director, const fracas_trouble *trouble)
{
    if (!director->trouble.code) director->trouble = *trouble;
    stop(director);
}

void fracas_director_check(fracas_director *director, fracas_err err)
{
    if (!err) return;
    fracas_trouble trouble;
    fracas_trouble_take(err, &trouble);
    fail(director, &trouble);
}

fracas_err fracas_director_tell(fracas_director *director, size_t worker, fracas_packet_kind kind,
                                const void *body, size_t size)
{
    fracas_packet *message;
    TRY(fracas_packet_create(kind, body, size, &message));
    fracas_err err = director->setup.send(director->setup.context, worker, message);
    free(message);
    return err;
}

void fracas_director_stop_worker(fracas_director *director, size_t worker)
{
    const int32_t kill = director->needless || director->overtime;
    director->phase[worker] = STOPPING;
    fracas_director_check(
        director, fracas_director_tell(director, worker, FRACAS_PACKET_STOP, &kill, sizeof kill));
}

static void stop(fracas_director *director)
{
    if (director->stopping) return;
    director->stopping = true;
    director->told = director->setup.now();
    for (size_t worker = 0; worker < director->setup.workers; worker++)
        if (director->phase[worker] == WORKING) fracas_director_stop_worker(director, worker);
}

/* ---- start ---- */

static fracas_err make_scheduler(fracas_director *director)
{
    const fracas_campaign *campaign = director->setup.campaign;
    int width = director->setup.options->width;
    fracas_index_row *row;
    size_t count;
    TRY(fracas_rounds_init(&director->rounds, campaign, director->index));
    TRY(fracas_index_rows(director->index, &director->rounds.table, &row, &count));
    fracas_scheduler_options options = {.cost = director->cost,
                                        .first = director->ruled,
                                        .npoints = campaign->npoints,
                                        .workers = director->setup.workers,
                                        .width = width ? (size_t)width : FRACAS_BATCH_MAX,
                                        .seconds = director->setup.options->lease_seconds,
                                        .memory = director->setup.options->segment_age,
                                        .limit = director->setup.options->lease_limit,
                                        .shuffle = director->setup.options->shuffle,
                                        .seed = campaign->seed};
    count = fracas_run_part(director->setup.options->part, director->setup.options->parts, row,
                            count);
    fracas_err err = fracas_scheduler_create(row, count, &options, &director->scheduler);
    free(row);
    for (size_t p = 0; p < campaign->npoints; p++)
        director->given[p] = director->rounds.point[p].replicas;
    return err;
}

/* Says what is there and what is to do, to the person and to the index. */
static fracas_err announce(fracas_director *director, const char *report)
{
    fracas_scheduler_counts count = fracas_scheduler_count(director->scheduler);
    const fracas_run_options *options = director->setup.options;
    char text[256], part[64] = "";
    if (options->parts > 1)
        snprintf(part, sizeof part, "part %d of %d, ", options->part, options->parts);
    snprintf(text, sizeof text, "%s%lld of %lld realizations of %zu point%s to do%s, %zu worker%s",
             part, (long long)(count.total - count.done - count.failed), (long long)count.total,
             director->setup.campaign->npoints, director->setup.campaign->npoints == 1 ? "" : "s",
             director->rounds.open ? ", and more as rules ask for them" : "",
             director->setup.workers, director->setup.workers == 1 ? "" : "s");
    if (report && *report) {
        fracas_voice_say(director->setup.voice, "%s", report);
        TRY(fracas_index_event(director->index, "recovered", report));
    }
    fracas_voice_say(director->setup.voice, "%s: %s", director->setup.study, text);
    fracas_voice_progress(director->setup.voice, &count);
    return fracas_index_event(director->index, count.done ? "resumed" : "started", text);
}

static fracas_err open_study(fracas_director *director, bool *settled, int64_t *failed)
{
    const fracas_director_setup *setup = &director->setup;
    char *report = NULL;
    TRY(fracas_study_prepare(setup->study, setup->campaign, setup->options->force, &director->lock,
                             &director->index, &report));
    fracas_err err = fracas_study_settled(setup->study, director->index, setup->campaign, settled,
                                          failed);
    if (!err)
        err = fracas_index_set_part(director->index, setup->options->part, setup->options->parts);
    if (!err && !*settled) err = make_scheduler(director);
    if (!err && !*settled) err = announce(director, report);
    free(report);
    return err;
}

static fracas_err set_up(fracas_director *director, bool *settled, int64_t *failed)
{
    director->phase = calloc(director->setup.workers, sizeof *director->phase);
    director->flushing = calloc(director->setup.workers, sizeof *director->flushing);
    director->given = calloc(director->setup.campaign->npoints, sizeof *director->given);
    director->ruled = calloc(director->setup.campaign->npoints, sizeof *director->ruled);
    if (!director->phase || !director->flushing || !director->given || !director->ruled)
        return fracas_no_memory("the workers");
    for (size_t p = 0; p < director->setup.campaign->npoints; p++)
        director->ruled[p] = director->setup.campaign->point[p].rule.maximum > 0;
    /* First of all: a campaign that cannot be computed leaves nothing behind. */
    double *bytes;
    TRY(fracas_costs_create(director->setup.campaign, director->setup.options, &director->cost,
                            &bytes));
    fracas_err err = FRACAS_OK; /* a parent has looked before it started this */
    if (!director->setup.voice->parent)
        err = fracas_space_check(director->setup.study, director->setup.campaign,
                                 director->setup.options, bytes);
    free(bytes);
    TRY(err);
    return open_study(director, settled, failed);
}

/* Nothing is left to compute, nor will be. */
bool fracas_director_computed(const fracas_director *director)
{
    return fracas_scheduler_computed_all(director->scheduler) && director->rounds.open == 0;
}

bool fracas_director_durable(const fracas_director *director)
{
    return fracas_director_computed(director) &&
           fracas_scheduler_count(director->scheduler).memory == 0;
}

/* Not before everything is durable: should a worker not get so far, the others are there to compute
 * it again. */
static void stop_if_durable(fracas_director *director)
{
    if (!fracas_director_durable(director)) return;
    director->needless = true;
    stop(director);
}

fracas_err fracas_director_create(const fracas_director_setup *setup, fracas_director **director,
                                  fracas_err *verdict)
{
    fracas_director *d = calloc(1, sizeof *d);
    if (!d) return fracas_no_memory("the run");
    d->setup = *setup;
    d->lock = -1;
    fracas_tally_begin(&d->tally);
    bool settled = false;
    int64_t failed = 0;
    fracas_err err = set_up(d, &settled, &failed);
    d->tally.planned = fracas_tally_time(&d->tally);
    if (err || settled) {
        *verdict = err || !failed
                       ? err
                       : fracas_failed_verdict(setup->study, d->index, &setup->campaign->table);
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
    if (!director) return;
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

/* Marks the lease in the index, one run of consecutive replicas at a time. */
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

static fracas_err offer(fracas_director *director, size_t worker)
{
    fracas_lease lease;
    while (!director->stopping && director->phase[worker] == WORKING) {
        const double time = director->setup.now();
        bool given;
        if (fracas_director_too_late(director, worker, time)) break;
        TRY(fracas_scheduler_next(director->scheduler, worker, time, &lease, &given));
        if (!given) break;
        TRY(mark_leased(director, &lease));
        TRY(fracas_director_tell(director, worker, FRACAS_PACKET_LEASE, &lease,
                                 fracas_lease_bytes(&lease)));
        director->tally.leases++;
        director->tally.giving += director->setup.now() - time;
    }
    return FRACAS_OK;
}

static fracas_err offer_all(fracas_director *director)
{
    for (size_t worker = 0; worker < director->setup.workers; worker++)
        TRY(offer(director, worker));
    return FRACAS_OK;
}

/* ---- rounds ---- */

/* Gives out what the rounds have come to ask for since `given` replicas of point p. */
static fracas_err add_more(fracas_director *director, size_t p)
{
    const fracas_point_row *point = &director->rounds.point[p];
    const size_t more = (size_t)(point->replicas - director->given[p]);
    if (!more) return FRACAS_OK;
    fracas_index_row *row = malloc(more * sizeof *row);
    if (!row) return fracas_no_memory("the plan");
    fracas_err err = fracas_index_rows_from(director->index, point, p, director->given[p], row);
    if (!err) err = fracas_scheduler_add(director->scheduler, row, more);
    if (!err) director->given[p] = point->replicas;
    free(row);
    return err;
}

static fracas_err add_all(fracas_director *director)
{
    for (size_t p = 0; p < director->setup.campaign->npoints; p++) TRY(add_more(director, p));
    return offer_all(director);
}

static bool anyone_idles(const fracas_director *director)
{
    for (size_t worker = 0; worker < director->setup.workers; worker++)
        if (director->phase[worker] == WORKING &&
            fracas_scheduler_idles(director->scheduler, worker))
            return true;
    return false;
}

/* While rounds wait to be decided and a worker has nothing to do, none keeps its records to itself:
 * not even one that computes, for what it computes may be of a slower point. Nor does any when
 * everything is computed. */
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
        TRY(fracas_director_tell(director, worker, FRACAS_PACKET_FLUSH, NULL, 0));
    }
    return FRACAS_OK;
}

/* ---- what workers say ---- */

static fracas_err hear_ready(fracas_director *director, size_t worker, const fracas_packet *message)
{
    director->phase[worker] = WORKING;
    if (director->stopping) {
        fracas_director_stop_worker(director, worker);
        return FRACAS_OK;
    }
    fracas_hash campaign;
    TRY(fracas_packet_expect(message, sizeof campaign));
    memcpy(&campaign, message->body, sizeof campaign);
    if (!fracas_hash_equal(&campaign, &director->setup.campaign->hash))
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "rank %zu read another campaign from %s than rank 0: it changed while "
                           "the run started, or is not the same file on all hosts",
                           worker, director->setup.options->file);
    return offer(director, worker);
}

static fracas_err hear_computed(fracas_director *director, size_t worker,
                                const fracas_packet *message)
{
    fracas_lease_report report;
    TRY(fracas_packet_expect(message, sizeof report));
    memcpy(&report, message->body, sizeof report);
    TRY(fracas_scheduler_computed(director->scheduler, worker, report.lease, director->setup.now(),
                                  report.seconds));
    return offer(director, worker);
}

static fracas_err hear_failed(fracas_director *director, size_t worker,
                              const fracas_packet *message)
{
    fracas_lease_failure failure;
    TRY(fracas_packet_expect(message, sizeof failure));
    memcpy(&failure, message->body, sizeof failure);
    fracas_lease lease;
    bool final;
    TRY(fracas_scheduler_failed(director->scheduler, worker, failure.lease, director->setup.now(),
                                (size_t)failure.kept, (size_t)failure.count, &lease, &final));
    char hex[FRACAS_HASH_HEX], text[1400];
    const fracas_hash *point = &director->setup.campaign->point[lease.point].hash;
    fracas_hash_hex(point, hex);
    if (lease.count == 0) {
        snprintf(text, sizeof text, "a lease of point %llu (%s) that another worker has too: %s",
                 (unsigned long long)lease.point, hex, failure.reason);
        TRY(fracas_index_event(director->index, "copy failed", text));
    } else if (lease.count > 1) {
        snprintf(text, sizeof text,
                 "%llu realizations of point %llu (%s), replica %lld the first, are tried in two "
                 "halves: %s",
                 (unsigned long long)lease.count, (unsigned long long)lease.point, hex,
                 (long long)lease.replica[0], failure.reason);
        TRY(fracas_index_event(director->index, "lease failed", text));
    } else {
        snprintf(text, sizeof text, "replica %lld of point %llu (%s) FAILED %s: %s",
                 (long long)lease.replica[0], (unsigned long long)lease.point, hex,
                 final ? "for good" : "and is tried again", failure.reason);
        TRY(fracas_index_fail(director->index, point, lease.replica[0], failure.reason, final));
        TRY(fracas_index_event(director->index, "failed", text));
        if (final) fracas_voice_say(director->setup.voice, "%s", text);
        if (final && !director->rounds.stopped[lease.point])
            TRY(fracas_rounds_advance(&director->rounds, director->index, (size_t)lease.point));
    }
    return add_all(director);
}

/* Commits a segment: from here on its realizations are done. */
static fracas_err hear_segment(fracas_director *director, size_t worker,
                               const fracas_packet *message)
{
    fracas_segment_note note;
    TRY(fracas_packet_expect(message, sizeof note + 1));
    memcpy(&note, message->body, sizeof note);
    size_t room = message->size - sizeof note - 1;
    if (note.rows > room / sizeof(fracas_segment_row) || message->body[message->size - 1] != '\0')
        return fracas_fail(FRACAS_BUG, "a message of rank %zu about a segment is damaged", worker);
    const fracas_segment_row *row = (const void *)(message->body + sizeof note);
    const double began = director->setup.now();
    TRY(fracas_index_commit(director->index, note.name, &note.seal, row, (size_t)note.rows,
                            (const char *)(row + note.rows)));
    director->tally.committing += director->setup.now() - began;
    director->tally.commits++;
    director->tally.rows += (double)note.rows;
    fracas_scheduler_durable(director->scheduler, worker);
    director->flushing[worker] = false;
    if (director->rounds.open == 0) return FRACAS_OK;
    TRY(fracas_rounds_hear(&director->rounds, director->index, row, (size_t)note.rows));
    return add_all(director);
}

void fracas_director_end_worker(fracas_director *director, size_t worker)
{
    if (director->phase[worker] == ENDED) return;
    director->phase[worker] = ENDED;
    director->nended++;
    fracas_scheduler_lost(director->scheduler, worker); /* nothing, if it ended in order */
}

/* All that it had told of is in segments that were heard of before. */
static fracas_err hear_flushed(fracas_director *director, size_t worker)
{
    if (director->trouble.code) return FRACAS_OK; /* a commit may have failed */
    fracas_scheduler_durable(director->scheduler, worker);
    director->flushing[worker] = false;
    return FRACAS_OK;
}

static fracas_err hear_end(fracas_director *director, size_t worker, const fracas_packet *message)
{
    fracas_director_end_worker(director, worker);
    if (message->kind == FRACAS_PACKET_ENDED) return FRACAS_OK;
    fracas_trouble trouble;
    TRY(fracas_packet_expect(message, sizeof trouble));
    memcpy(&trouble, message->body, sizeof trouble);
    if (message->kind == FRACAS_PACKET_TROUBLE) {
        fail(director, &trouble);
        return FRACAS_OK;
    }
    fracas_voice_say(director->setup.voice, "%s; the others go on", trouble.text);
    TRY(fracas_index_event(director->index, "worker lost", trouble.text));
    if (fracas_director_over(director) && !director->stopping) fail(director, &trouble);
    return offer_all(director);
}

/* The worker's server died, and READY of a new one will come. What the dead one held or had in
 * memory is to be done, even where nothing was left and all were told to stop: then this worker
 * goes on. */
static fracas_err hear_replaced(fracas_director *director, size_t worker,
                                const fracas_packet *message)
{
    fracas_trouble trouble;
    TRY(fracas_packet_expect(message, sizeof trouble));
    memcpy(&trouble, message->body, sizeof trouble);
    fracas_scheduler_lost(director->scheduler, worker);
    director->phase[worker] = STARTING;
    director->flushing[worker] = false;
    if (director->needless && !fracas_director_computed(director)) {
        director->needless = false;
        director->stopping = director->drained || director->trouble.code;
    }
    fracas_voice_say(director->setup.voice, "%s", trouble.text);
    TRY(fracas_index_event(director->index, "server replaced", trouble.text));
    TRY(fracas_director_tell(director, worker, FRACAS_PACKET_FRESH, NULL, 0));
    return offer_all(director);
}

static fracas_err act(fracas_director *director, size_t worker, const fracas_packet *message)
{
    switch ((fracas_packet_kind)message->kind) {
    case FRACAS_PACKET_READY: return hear_ready(director, worker, message);
    case FRACAS_PACKET_COMPUTED: return hear_computed(director, worker, message);
    case FRACAS_PACKET_FAILED: return hear_failed(director, worker, message);
    case FRACAS_PACKET_SEGMENT: return hear_segment(director, worker, message);
    case FRACAS_PACKET_FLUSHED: return hear_flushed(director, worker);
    case FRACAS_PACKET_REPLACED: return hear_replaced(director, worker, message);
    case FRACAS_PACKET_TROUBLE:
    case FRACAS_PACKET_LOST:
    case FRACAS_PACKET_ENDED: return hear_end(director, worker, message);
    case FRACAS_PACKET_DRAIN: fracas_director_drain(director); return FRACAS_OK;
    default: return fracas_fail(FRACAS_BUG, "rank 0 got a message of kind %u", message->kind);
    }
}

void fracas_director_hear(fracas_director *director, size_t worker, const fracas_packet *message)
{
    if (director->phase[worker] == ENDED && message->kind != FRACAS_PACKET_DRAIN)
        return; /* it was given up */
    director->tally.messages++;
    fracas_director_check(director, act(director, worker, message));
    fracas_director_check(director, flush_all(director));
    stop_if_durable(director);
    fracas_scheduler_counts count = fracas_scheduler_count(director->scheduler);
    fracas_voice_progress(director->setup.voice, &count);
}

void fracas_director_note(fracas_director *director, const char *kind, const char *text)
{
    fracas_director_check(director, fracas_index_event(director->index, kind, text));
}

void fracas_director_drain(fracas_director *director)
{
    if (director->drained) return;
    director->drained = true;
    stop(director);
}

bool fracas_director_over(const fracas_director *director)
{
    return director->nended == director->setup.workers;
}

/* ---- end ---- */

/* FRACAS_INTERRUPTED if the merge may not end before the deadline; a run that has nothing else to
 * do tries it all the same, or it would never be done. */
static fracas_err check_merge_time(fracas_director *director)
{
    fracas_index_counts counts;
    if (director->setup.deadline == 0 || director->resumed_whole) return FRACAS_OK;
    TRY(fracas_index_count(director->index, &counts));
    const double seconds = (double)counts.bytes / MERGE_RATE;
    if (director->setup.now() + seconds <= director->setup.deadline) return FRACAS_OK;
    return fracas_fail(FRACAS_INTERRUPTED,
                       "the walltime is nearly over: all %" PRId64
                       " realizations are done and kept, only study.h5 is missing, which may take "
                       "%.0f s to write; the same command writes it",
                       counts.realizations, ceil(seconds));
}

/* FRACAS_INTERRUPTED if the study has realizations of other parts that are still to be computed. */
static fracas_err check_parts(fracas_director *director, const fracas_scheduler_counts *count)
{
    const fracas_run_options *options = director->setup.options;
    fracas_index_counts counts;
    if (options->parts < 2) return FRACAS_OK;
    TRY(fracas_index_count(director->index, &counts));
    if (counts.planned + counts.leased == 0) return FRACAS_OK;
    return fracas_fail(FRACAS_INTERRUPTED,
                       "part %d of %d is complete, %" PRId64 " realizations, %" PRId64
                       " of them FAILED; when the other parts are, `fracas merge-studies` makes "
                       "one study of them all",
                       options->part, options->parts, count->total, count->failed);
}

/* What servers that died, and were replaced, had half written. */
static fracas_err sweep(fracas_director *director)
{
    char *report;
    TRY(fracas_study_sweep(director->setup.study, &report));
    fracas_err err = *report ? fracas_index_event(director->index, "swept", report) : FRACAS_OK;
    free(report);
    return err;
}

static fracas_err merge(fracas_director *director, const fracas_scheduler_counts *count)
{
    const fracas_campaign *campaign = director->setup.campaign;
    fracas_file_header header = fracas_segment_header(campaign);
    fracas_mesh_source meshes = fracas_campaign_meshes(campaign);
    char text[128] = "study.h5 is written";
    const double began = director->setup.now();
    TRY(sweep(director));
    TRY(fracas_rounds_check(campaign, director->index));
    TRY(fracas_study_merge(director->setup.study, director->index, &header, &director->rounds.table,
                           &meshes));
    director->tally.merging = director->setup.now() - began;
    if (count->duplicates) {
        snprintf(text, sizeof text,
                 "study.h5 is written; %" PRId64
                 " realization%s computed twice, as the first took too long",
                 count->duplicates, count->duplicates > 1 ? "s were" : " was");
        fracas_voice_say(director->setup.voice, "%s", text);
    }
    TRY(fracas_index_event(director->index, "finished", text));
    return fracas_failed_verdict(director->setup.study, director->index, &director->rounds.table);
}

/* Why study.h5 is not written. */
static fracas_err say_unfinished(const fracas_director *director,
                                 const fracas_scheduler_counts *count)
{
    const long long kept = (long long)(count->done + count->failed),
                    total = (long long)count->total;
    if (director->trouble.code)
        return fracas_fail(
            (fracas_err)director->trouble.code,
            "%s (%lld of %lld realizations are done and kept; the same command goes on from there)",
            director->trouble.text, kept, total);
    if (director->drained)
        return fracas_fail(
            FRACAS_INTERRUPTED,
            "%s: %lld of %lld realizations are done and kept; the same command goes on from there",
            director->late ? "the walltime is nearly over" : "interrupted", kept, total);
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "a compute server died at the end: %lld of %lld realizations are done and "
                       "kept; the same command goes on from there",
                       kept, total);
}

/* Merges, or says why not. */
static fracas_err conclude(fracas_director *director)
{
    const fracas_scheduler_counts count = fracas_scheduler_count(director->scheduler);
    const bool computed = !director->trouble.code && count.done + count.failed == count.total &&
                          director->rounds.open == 0;
    fracas_err err = computed ? check_parts(director, &count) : say_unfinished(director, &count);
    if (!err) err = check_merge_time(director);
    if (!err) return merge(director, &count);
    /* The verdict stands, whether or not it can be noted. */
    fracas_trouble verdict;
    fracas_trouble_take(err, &verdict);
    if (fracas_index_event(director->index, err == FRACAS_INTERRUPTED ? "drained" : "stopped",
                           verdict.text))
        fracas_voice_say(director->setup.voice, "%s", fracas_message());
    return fracas_fail(err, "%s", verdict.text);
}

fracas_err fracas_director_finish(fracas_director *director)
{
    director->tally.workers = (double)director->setup.workers;
    director->tally.computed = fracas_tally_time(&director->tally);
    fracas_err err = conclude(director);
    fracas_tally_end(&director->tally);
    if (!err || err == FRACAS_INTERRUPTED ||
        err == FRACAS_SOME_FAILED) { /* else it is not sure that anything can be written */
        fracas_trouble verdict;
        fracas_trouble_take(err, &verdict);
        fracas_err noted = fracas_tally_note(&director->tally, director->index);
        if (noted) fracas_voice_say(director->setup.voice, "%s", fracas_message());
        if (err) return fracas_fail(err, "%s", verdict.text);
    }
    return err;
}
