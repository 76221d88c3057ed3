/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/replay.h"

#include "base/text.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/scheduler/worker/models.h"
#include "campaigns/store/file/difference.h"
#include "campaigns/store/results.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

FRACAS_OWNER(fracas_lease, free)

static fracas_err check_known(const fracas_campaign *campaign, size_t point, int64_t replica)
{
    if (point >= campaign->npoints)
        return fracas_fail(FRACAS_USAGE,
                           "there is no point %zu in campaign %s; it has %zu, from 0 on", point,
                           campaign->name, campaign->npoints);
    const int64_t most = fracas_point_most(&campaign->point[point]);
    if (replica < most) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "there is no replica %" PRId64
                       " of point %zu in campaign %s; it has %" PRId64 ", from 0 on",
                       replica, point, campaign->name, most);
}

static fracas_err check_version(const char *study, const fracas_campaign *campaign,
                                const fracas_results *results)
{
    const fracas_file_header ours = fracas_campaign_header(campaign),
                             *stored = fracas_results_header(results);
    if (!strcmp(ours.version, stored->version)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s was computed by fracas %s, this is %s, whose bits may differ: replay it "
                       "with %s, or compute the campaign anew, `fracas run %s --study NEW`",
                       study, stored->version, ours.version, stored->version,
                       fracas_shell_path(study, "campaign.yaml").text);
}

fracas_err fracas_replay_find(const char *study, const fracas_campaign *campaign, size_t point,
                              int64_t replica, fracas_replay *replay)
{
    OWN(fracas_results) results = NULL;
    size_t row;
    *replay = (fracas_replay){.campaign = campaign, .point = point, .replica = replica};
    TRY(check_known(campaign, point, replica));
    TRY(fracas_results_open(study, &campaign->hash, &campaign->table, &results));
    TRY(check_version(study, campaign, results));
    TRY(fracas_results_find(results, point, replica, &row));
    if (row == fracas_results_realizations(results))
        return fracas_fail(FRACAS_INTERRUPTED,
                           "realization %zu/%" PRId64
                           " of %s is not computed, or not yet: `fracas status %s` counts those "
                           "that are",
                           point, replica, study, fracas_shell_path(study, NULL).text);
    fracas_record_init(&replay->stored);
    TRY(fracas_results_record(results, row, FRACAS_READ_ALL, &point, &replica, &replay->stored));
    if (replay->stored.outcome != FRACAS_FAILED) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "realization %zu/%" PRId64 " of %s FAILED and has no record: `fracas retry "
                       "%s --failed` tries it again",
                       point, replica, study, fracas_shell_path(study, NULL).text);
}

void fracas_replay_clear(fracas_replay *replay)
{
    if (replay->campaign) fracas_record_clear(&replay->stored);
    *replay = (fracas_replay){0};
}

/* Computes a lease of this one realization as a worker does, in one lane. With fields, times of
 * interfaces are kept, whatever the campaign says. */
static fracas_err compute(fracas_replay *replay, const fracas_fields_request *request, FILE *out,
                          fracas_record *record)
{
    fracas_campaign copy = *replay->campaign;
    const fracas_campaign *campaign = &copy;
    copy.output.interfaces |= request != NULL;
    FRACAS_CLEARED(fracas_models) models = {0};
    FRACAS_CLEARED(fracas_field_files) files = {0};
    OWN(fracas_lease) lease = calloc(1, sizeof *lease);
    fracas_run_options options;
    if (!lease) return fracas_no_memory("a realization");
    fracas_run_options_init(&options);
    options.width = 1;
    lease->point = replay->point;
    lease->count = 1;
    lease->parts = campaign->parallel.parts > 0 ? (uint64_t)campaign->parallel.parts : 1;
    lease->replica[0] = replay->replica;
    replay->overlap = NAN;
    fracas_computation computation = {.campaign = campaign, .options = &options, .lease = lease};
    TRY(fracas_models_get(&models, &computation));
    if (request) {
        TRY(fracas_field_files_open(request, computation.realizer->model, &replay->stored, &files,
                                    out));
        computation.watch = &files.watch;
    }
    TRY(fracas_solve(&computation, lease->replica, 1, record));
    if (!request) return FRACAS_OK;
    TRY(fracas_field_files_finish(&files, out));
    replay->overlap = files.overlap;
    return FRACAS_OK;
}

fracas_err fracas_replay_run(fracas_replay *replay, const fracas_fields_request *request, FILE *out)
{
    FRACAS_CLEARED(fracas_record) record;
    fracas_record_init(&record);
    TRY(compute(replay, request, out, &record));
    fracas_record_difference difference;
    fracas_record_compare(&replay->stored, &record, replay->campaign->output.interfaces,
                          &difference);
    if (!difference.column) return FRACAS_OK;
    const char *folder = request ? request->folder : NULL;
    return fracas_fail(FRACAS_DAMAGED,
                       "realization %zu/%" PRId64
                       " differs from the study: first in %s, row %zu of "
                       "the realization: stored %s, computed %s; `fracas verify --full` checks the "
                       "study%s%s%s",
                       replay->point, replay->replica, difference.column, difference.row,
                       difference.value[0], difference.value[1], folder ? "; fields in " : "",
                       folder ? folder : "", folder ? " are of the computed one" : "");
}
