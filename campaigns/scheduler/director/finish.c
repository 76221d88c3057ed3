/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/director/state.h"
#include "campaigns/scheduler/session/failures.h"
#include "campaigns/scheduler/session/meshes.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/study.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double MERGE_RATE = 50e6; /* lower bound of a merge's speed [bytes/s] */

/* FRACAS_INTERRUPTED if the merge may not end before the deadline. A run with nothing but the merge
 * to do tries it all the same. */
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

/* FRACAS_INTERRUPTED if other parts of the study are not computed yet. */
static fracas_err check_parts(fracas_director *director, const fracas_counts *count)
{
    const fracas_run_options *options = director->setup.options;
    fracas_index_counts counts;
    if (options->parts < 2) return FRACAS_OK;
    TRY(fracas_index_count(director->index, &counts));
    if (fracas_index_missing(&counts) == 0) return FRACAS_OK;
    return fracas_fail(FRACAS_INTERRUPTED,
                       "part %d of %d is complete, %" PRId64 " realizations, %" PRId64
                       " of them FAILED; when the other parts are, `fracas merge-studies` makes "
                       "one study of them all",
                       options->part, options->parts, count->total, count->failed);
}

/* Removes the unfinished files of dead servers. */
static fracas_err sweep(fracas_director *director)
{
    OWNED char *report = NULL;
    TRY(fracas_study_sweep(director->setup.study, &report));
    return *report ? fracas_index_event(director->index, "swept", report) : FRACAS_OK;
}

static fracas_err merge(fracas_director *director, const fracas_counts *count)
{
    const fracas_campaign *campaign = director->setup.campaign;
    fracas_file_header header = fracas_campaign_header(campaign);
    fracas_mesh_source meshes = fracas_campaign_meshes(campaign);
    FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
    char text[128] = "study.h5 is written";
    const double began = director->setup.now();
    TRY(sweep(director));
    TRY(fracas_rounds_check(campaign, director->index));
    TRY(fracas_campaign_copy_make(campaign, &copy));
    TRY(fracas_study_merge(director->setup.study, director->index, &header, &director->rounds.table,
                           &meshes, &copy));
    fracas_checkpoints_end(director->setup.study);
    director->timings.merging = director->setup.now() - began;
    if (count->duplicates) {
        snprintf(text, sizeof text,
                 "study.h5 is written; %" PRId64
                 " realization%s computed twice, as the first took too long",
                 count->duplicates, count->duplicates > 1 ? "s were" : " was");
        fracas_channel_message(director->setup.channel, "%s", text);
    }
    TRY(fracas_index_event(director->index, "finished", text));
    return fracas_failure_report(director->setup.study, director->index, &director->rounds.table);
}

/* The reason for the lack of study.h5. */
static fracas_err unfinished(const fracas_director *director, const fracas_counts *count)
{
    const long long kept = (long long)(count->done + count->failed),
                    total = (long long)count->total;
    const char *study = director->setup.study;
    if (director->setup.channel->again) return fracas_trouble_fail(&director->trouble);
    if (director->trouble.code && !fracas_study_is_kept(study, director->index))
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "%s (%s, or a part of it, was moved or removed while it was computed; "
                           "the same command computes again what is not there)",
                           director->trouble.text, study);
    if (director->trouble.code)
        return fracas_fail(
            (fracas_err)director->trouble.code,
            "%s (%lld of %lld realizations are done and kept; the same command goes on from there)",
            director->trouble.text, kept, total);
    return fracas_fail(
        FRACAS_INTERRUPTED,
        "%s: %lld of %lld realizations are done and kept; the same command goes on from there",
        director->late ? "the walltime is nearly over" : "interrupted", kept, total);
}

/* Merges, or fails with the reason not to. */
static fracas_err conclude(fracas_director *director)
{
    const fracas_counts count = fracas_scheduler_count(director->scheduler);
    const bool computed = !director->trouble.code && count.done + count.failed == count.total;
    fracas_err err = computed ? check_parts(director, &count) : unfinished(director, &count);
    if (!err) err = check_merge_time(director);
    if (!err) return merge(director, &count);
    fracas_trouble result; /* stands, whether or not it can be noted */
    fracas_trouble_take(err, &result);
    if (fracas_index_event(director->index, err == FRACAS_INTERRUPTED ? "drained" : "stopped",
                           result.text))
        fracas_channel_message(director->setup.channel, "%s", fracas_message());
    return fracas_trouble_fail(&result);
}

fracas_err fracas_director_finish(fracas_director *director)
{
    director->timings.workers = (double)director->setup.workers;
    director->timings.computed = fracas_timings_time(&director->timings);
    fracas_err err = conclude(director); /* if it fails, the index may not be writable */
    fracas_timings_end(&director->timings);
    if (err && err != FRACAS_INTERRUPTED && err != FRACAS_SOME_FAILED) return err;
    fracas_trouble result;
    fracas_trouble_take(err, &result);
    if (fracas_timings_note(&director->timings, director->index))
        fracas_channel_message(director->setup.channel, "%s", fracas_message());
    return fracas_trouble_fail(&result);
}
