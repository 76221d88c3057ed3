/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/data/format.h"
#include "analysis/summary/statistics.h"
#include "base/json.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/store.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* State of a study: all realizations, and each point's. */
typedef struct {
    const char *study;
    const fracas_campaign *campaign;
    fracas_index *index;
    bool complete;          /* study.h5 is of this campaign and nothing is left to compute */
    fracas_lock_state lock; /* held: a run computes it now */
    char holder[FRACAS_HOLDER_TEXT]; /* the lock's */
    int part, parts;                 /* its part of the campaign */
    int64_t part_all, part_left;     /* realizations of the part, and its uncomputed ones */
    fracas_index_counts all;
    fracas_index_counts *point; /* campaign->npoints */
} fracas_status;

static const char *const lock_name[] = {"free", "held", "left", "elsewhere"}; /* by lock state */
static const char *const lock_text[] = {
    "", "held", "left by a run that died, the next one takes it over",
    "of another host; if that run is gone, `fracas run --force` takes it over"};

static void write_counts(fracas_json *json, const fracas_index_counts *counts)
{
    fracas_json_integer(json, "realizations", counts->realizations);
    fracas_json_integer(json, "done", counts->done);
    fracas_json_integer(json, "failed", counts->failed);
    fracas_json_integer(json, "leased", counts->leased);
    fracas_json_integer(json, "planned", counts->planned);
    fracas_json_object(json, "outcomes");
    for (int o = 0; o < FRACAS_NOUTCOMES; o++)
        fracas_json_integer(json, fracas_outcome_name(o), counts->outcome[o]);
    fracas_json_close(json);
}

static void write_failure(void *json, const fracas_index_row *row, const char *reason)
{
    fracas_json_object(json, NULL);
    fracas_json_integer(json, "point", (int64_t)row->point);
    fracas_json_integer(json, "replica", row->replica);
    fracas_json_integer(json, "attempts", row->attempts);
    fracas_json_text(json, "reason", reason);
    fracas_json_close(json);
}

/* The decisions on the replicas of a point, by round. */
static fracas_err write_decisions(fracas_json *json, const fracas_status *status, size_t p)
{
    OWNED fracas_decision *decision = NULL;
    size_t count;
    if (status->campaign->point[p].rule.maximum == 0) return FRACAS_OK;
    TRY(fracas_index_decisions(status->index, &status->campaign->point[p].hash, &decision, &count));
    fracas_json_array(json, "decisions");
    for (size_t d = 0; d < count; d++) {
        fracas_json_object(json, NULL);
        fracas_json_integer(json, "round", decision[d].round);
        fracas_json_integer(json, "replicas", decision[d].replicas);
        fracas_json_integer(json, "used", decision[d].used);
        fracas_json_text(json, "quantity", fracas_quantity_name[decision[d].quantity]);
        fracas_json_real(json, "mean", decision[d].mean);
        fracas_json_real(json, "half_width", decision[d].half_width);
        fracas_json_text(json, "stop", fracas_sequential_stop_name[decision[d].stop]);
        fracas_json_close(json);
    }
    fracas_json_close(json);
    return FRACAS_OK;
}

/* ---- realizations that compute for long ---- */

typedef struct {
    const fracas_status *status;
    fracas_json *json; /* NULL: text */
    bool any;
} long_ones;

static fracas_err tell_checkpoint(void *context, const fracas_checkpoint_head *head, double age)
{
    long_ones *l = context;
    const fracas_point_table *table = &l->status->campaign->table;
    size_t p = 0;
    while (p < table->npoints && !fracas_hash_equal(&table->point[p].hash, &head->point)) p++;
    if (p == table->npoints) return FRACAS_OK;
    if (l->json) {
        fracas_json_object(l->json, NULL);
        fracas_json_integer(l->json, "point", (int64_t)p);
        fracas_json_integer(l->json, "replica", head->replica);
        fracas_json_integer(l->json, "steps", head->steps);
        fracas_json_real(l->json, "time", head->time);
        fracas_json_real(l->json, "end", head->end);
        fracas_json_real(l->json, "age", age);
        fracas_json_close(l->json);
        return FRACAS_OK;
    }
    if (!l->any) fputs("\ncheckpoints   of realizations that compute for long\n", stdout);
    l->any = true;
    printf("  point %zu replica %" PRId64 ": %s, %.3g of at most %.3g us, %" PRId64
           " steps, %.0f s ago\n",
           p, head->replica, head->over ? "computed" : "computing", 1e6 * head->time,
           1e6 * head->end, head->steps, age);
    return FRACAS_OK;
}

static fracas_err write_json(const fracas_status *status)
{
    fracas_json json;
    fracas_json_begin(&json, stdout);
    fracas_json_text(&json, "study", status->study);
    fracas_json_text(&json, "campaign", status->campaign->name);
    fracas_json_boolean(&json, "complete", status->complete);
    fracas_json_boolean(&json, "running", status->lock == FRACAS_LOCK_HELD);
    fracas_json_text(&json, "lock", lock_name[status->lock]);
    fracas_json_text(&json, "holder", status->holder);
    fracas_json_integer(&json, "part", status->part);
    fracas_json_integer(&json, "parts", status->parts);
    fracas_json_integer(&json, "part_realizations", status->part_all);
    fracas_json_integer(&json, "part_planned", status->part_left);
    write_counts(&json, &status->all);
    fracas_json_integer(&json, "segments", status->all.segments);
    fracas_json_integer(&json, "bytes", status->all.bytes);
    fracas_json_array(&json, "points");
    fracas_err code = FRACAS_OK;
    for (size_t i = 0; i < status->campaign->npoints; i++) {
        fracas_json_object(&json, NULL);
        fracas_json_integer(&json, "point", (int64_t)i);
        fracas_json_text(&json, "hash", fracas_hash_hex(&status->campaign->point[i].hash).text);
        write_counts(&json, &status->point[i]);
        if (!code) code = write_decisions(&json, status, i);
        fracas_json_close(&json);
    }
    fracas_json_close(&json);
    fracas_json_array(&json, "checkpoints");
    if (!code)
        code = fracas_checkpoints_each(status->study, tell_checkpoint,
                                       &(long_ones){status, &json, false});
    fracas_json_close(&json);
    fracas_json_array(&json, "failures");
    if (!code && status->all.failed)
        code = fracas_index_failures(status->index, &status->campaign->table, write_failure, &json);
    fracas_json_end(&json);
    return code;
}

static fracas_err print_points(const fracas_status *status)
{
    const fracas_point_table *table = &status->campaign->table;
    OWNED bool *varies = malloc((table->ncolumns + 1) * sizeof *varies);
    if (!varies) return fracas_no_memory("the points");
    for (size_t c = 0; c < table->ncolumns; c++) varies[c] = fracas_point_table_varies(table, c);
    fputs("\nrealizations    done  failed  point\n", stdout);
    for (size_t i = 0; i < table->npoints; i++) {
        const fracas_index_counts *counts = &status->point[i];
        printf("%12" PRId64 "%8" PRId64 "%8" PRId64 "  %zu", counts->realizations, counts->done,
               counts->failed, i);
        for (size_t c = 0; c < table->ncolumns; c++) {
            if (!varies[c]) continue;
            const fracas_value *value = &table->point[i].value[c];
            if (*value->text) printf(" %s=%s", table->column[c].path, value->text);
            else if (!isnan(value->real)) printf(" %s=%g", table->column[c].path, value->real);
        }
        putchar('\n');
    }
    return FRACAS_OK;
}

static fracas_err print_decisions(const fracas_status *status)
{
    bool first = true;
    for (size_t p = 0; p < status->campaign->npoints; p++) {
        const fracas_sequential_rule *rule = &status->campaign->point[p].rule;
        OWNED fracas_decision *decision = NULL;
        size_t count;
        if (rule->maximum == 0) continue;
        TRY(fracas_index_decisions(status->index, &status->campaign->point[p].hash, &decision,
                                   &count));
        if (first && count)
            fputs("\ndecisions on replicas\npoint  round  replicas  of what        mean  +-  half "
                  "width\n",
                  stdout);
        for (size_t d = 0; d < count; d++) {
            const double asked = 100 * decision[d].relative_half_width;
            printf("%5zu%7" PRId64 "%10" PRId64
                   "  %-10s  %.5g +- %.2g (%s %%; %.3g %% asked for): %s\n",
                   p, decision[d].round, decision[d].replicas,
                   fracas_quantity_name[decision[d].quantity], decision[d].mean,
                   decision[d].half_width,
                   fracas_beside(100 * fracas_decision_relative(&decision[d]), asked).text, asked,
                   fracas_sequential_stop_name[decision[d].stop]);
        }
        first = first && !count;
    }
    return FRACAS_OK;
}

static void print_failure(void *any, const fracas_index_row *row, const char *reason)
{
    bool *first = any;
    if (*first) fputs("\nfailed\n", stdout);
    *first = false;
    printf("  point %zu replica %" PRId64 ", %" PRId64 " attempts: %s\n", row->point, row->replica,
           row->attempts, reason);
}

static const char *state_of(const fracas_status *status, char text[5000])
{
    if (status->lock == FRACAS_LOCK_HELD) return "being computed";
    if (status->complete)
        return status->all.failed == 0 ? "complete" : "computed, some realizations FAILED (below)";
    if (status->parts > 1 && status->part_left == 0)
        return "its part is complete: `fracas merge-studies` makes one study of all parts";
    /* not the user's file: the study may have been extended since */
    snprintf(text, 5000,
             "interrupted: `fracas run %.2000s/campaign.yaml --study %.2000s` resumes it",
             status->study, status->study);
    return text;
}

static fracas_err print_text(const fracas_status *status)
{
    const fracas_index_counts *all = &status->all;
    printf("study         %s of campaign %s\n", status->study, status->campaign->name);
    char state[5000];
    printf("state         %s\n", state_of(status, state));
    if (status->parts > 1)
        printf("part          %d of %d: %" PRId64 " realizations, %" PRId64 " to be computed\n",
               status->part, status->parts, status->part_all, status->part_left);
    if (status->lock != FRACAS_LOCK_FREE)
        printf("lock          %s: %s\n", lock_text[status->lock], status->holder);
    printf("realizations  %" PRId64 ": %" PRId64 " done, %" PRId64 " failed, %" PRId64
           " leased, %" PRId64 " planned\n",
           all->realizations, all->done, all->failed, all->leased, all->planned);
    fputs("outcomes     ", stdout);
    for (int o = 0; o < FRACAS_NOUTCOMES; o++)
        if (all->outcome[o]) printf(" %" PRId64 " %s", all->outcome[o], fracas_outcome_name(o));
    printf("\nsegments      %" PRId64 ", %.1f MB\n", all->segments, (double)all->bytes / 1e6);
    TRY(print_points(status));
    TRY(print_decisions(status));
    TRY(fracas_checkpoints_each(status->study, tell_checkpoint, &(long_ones){status, NULL, false}));
    bool first = true;
    if (!all->failed) return FRACAS_OK;
    return fracas_index_failures(status->index, &status->campaign->table, print_failure, &first);
}

/* Counts the part of the study. */
static fracas_err count_part(fracas_status *status)
{
    OWNED fracas_index_row *row = NULL;
    size_t count;
    TRY(fracas_index_part(status->index, &status->part, &status->parts));
    status->part_all = status->all.realizations;
    status->part_left = fracas_index_missing(&status->all);
    if (status->parts < 2) return FRACAS_OK;
    TRY(fracas_index_rows(status->index, &status->campaign->table, &row, &count));
    count = fracas_run_part(status->part, status->parts, row, count);
    status->part_all = (int64_t)count;
    status->part_left = 0;
    for (size_t i = 0; i < count; i++)
        status->part_left += row[i].status == FRACAS_PLANNED || row[i].status == FRACAS_LEASED;
    return FRACAS_OK;
}

/* Without a run nothing is leased: old leases are to be computed again. */
static void unlease(fracas_index_counts *counts)
{
    counts->planned += counts->leased;
    counts->leased = 0;
}

static fracas_err count(fracas_status *status)
{
    const fracas_campaign *campaign = status->campaign;
    TRY(fracas_index_count_points(status->index, &campaign->table, &status->all, status->point));
    TRY(count_part(status));
    TRY(fracas_study_lock_state(status->study, &status->lock, status->holder));
    if (status->lock == FRACAS_LOCK_FREE || status->lock == FRACAS_LOCK_LEFT) {
        unlease(&status->all);
        for (size_t p = 0; p < campaign->npoints; p++) unlease(&status->point[p]);
    }
    status->complete = false;
    if (status->all.planned || status->all.leased) return FRACAS_OK; /* no file need be read */
    int64_t failed;
    return fracas_study_settled(status->study, status->index, campaign, &status->complete, &failed);
}

static fracas_err status(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    OWN(fracas_index) index = NULL;
    OWNED fracas_index_counts *point = calloc(campaign->npoints, sizeof *point);
    if (!point) return fracas_no_memory("the counts of the points");
    TRY(fracas_index_open(arguments->operand, false, &index));
    fracas_status state = {
        .study = arguments->operand, .campaign = campaign, .index = index, .point = point};
    TRY(count(&state));
    return fracas_given(arguments, "json") ? write_json(&state) : print_text(&state);
}

const fracas_command fracas_command_status = {
    .name = "status",
    .operand = "STUDY",
    .doc = "Says how far STUDY is, point by point",
    .more = "\nIt only looks: it can be asked while the study is being computed.\n",
    .options = fracas_json_option,
    .run_on = status,
};
