/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command status: one look as text or JSON, or looks at intervals. */
#include "cli/look.h"

#include "analysis/data/columns.h"
#include "analysis/data/format.h"
#include "analysis/export/tables.h"
#include "analysis/summary/statistics.h"
#include "base/json.h"
#include "base/terminal.h"
#include "campaigns/scheduler/status/describe.h"
#include "campaigns/store/lock.h"
#include "cli/cli.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
static fracas_err write_decisions(fracas_json *json, const fracas_look *look, size_t p)
{
    OWNED fracas_decision *decision = NULL;
    size_t count;
    if (look->campaign->point[p].rule.maximum == 0) return FRACAS_OK;
    TRY(fracas_index_decisions(look->index, &look->campaign->point[p].hash, &decision, &count));
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

static void write_long_ones(fracas_json *json, const fracas_look *look)
{
    fracas_json_array(json, "checkpoints");
    for (size_t i = 0; i < look->nlong; i++) {
        const fracas_long_one *one = &look->long_one[i];
        fracas_json_object(json, NULL);
        fracas_json_integer(json, "point", (int64_t)one->point);
        fracas_json_integer(json, "replica", one->head.replica);
        fracas_json_integer(json, "steps", one->head.steps);
        fracas_json_real(json, "time", one->head.time);
        fracas_json_real(json, "end", one->head.end);
        fracas_json_real(json, "age", one->age);
        fracas_json_close(json);
    }
    fracas_json_close(json);
}

static fracas_err write_point(fracas_json *json, const fracas_look *look, size_t p)
{
    const fracas_unfinished_point *point = &look->running.point[p];
    fracas_json_object(json, NULL);
    fracas_json_integer(json, "point", (int64_t)p);
    fracas_json_text(json, "hash", fracas_hash_hex(&look->campaign->point[p].hash).text);
    write_counts(json, &point->counts);
    fracas_fields_json_object(json, "count", &fracas_estimate_fields, &point->count);
    fracas_fields_json_object(json, "size", &fracas_estimate_fields, &point->size);
    const fracas_err code = write_decisions(json, look, p);
    fracas_json_close(json);
    return code;
}

static void write_state(fracas_json *json, const fracas_look *look)
{
    fracas_json_text(json, "study", look->study);
    fracas_json_text(json, "campaign", look->campaign->name);
    fracas_json_boolean(json, "complete", look->complete);
    fracas_json_boolean(json, "running", look->lock == FRACAS_LOCK_HELD);
    fracas_json_text(json, "lock", lock_name[look->lock]);
    fracas_json_text(json, "holder", look->holder);
    fracas_json_integer(json, "part", look->part);
    fracas_json_integer(json, "parts", look->parts);
    fracas_json_integer(json, "part_realizations", look->part_all);
    fracas_json_integer(json, "part_planned", look->part_left);
    fracas_json_real(json, "rate", look->rate);
    fracas_json_real(json, "seconds_left", look->left);
    write_counts(json, &look->running.all);
    fracas_json_integer(json, "segments", look->running.all.segments);
    fracas_json_integer(json, "bytes", look->running.all.bytes);
}

fracas_err fracas_look_write_json(const fracas_look *look, bool line, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    json.line = line;
    write_state(&json, look);
    fracas_json_array(&json, "points");
    fracas_err code = FRACAS_OK;
    for (size_t p = 0; p < look->campaign->npoints && !code; p++)
        code = write_point(&json, look, p);
    fracas_json_close(&json);
    write_long_ones(&json, look);
    fracas_json_array(&json, "failures");
    if (!code && look->running.all.failed)
        code = fracas_index_failures(look->index, &look->campaign->table, write_failure, &json);
    fracas_json_end(&json);
    return code;
}

/* ---- as text ---- */

static const fracas_table_column point_columns[] = {
#define AT(member) offsetof(fracas_unfinished_point, member)
    {"realizations", "", FRACAS_CELL_INTEGER, AT(counts.realizations)},
    {"done", "", FRACAS_CELL_INTEGER, AT(counts.done)},
    {"failed", "", FRACAS_CELL_INTEGER, AT(counts.failed)},
    {"fragments", "", FRACAS_CELL_ESTIMATE, AT(count)},
    {"size", "m", FRACAS_CELL_ESTIMATE, AT(size), .prefixed = true},
#undef AT
};

static fracas_err print_points(const fracas_look *look, int width)
{
    const fracas_point_table *points = &look->campaign->table;
    const fracas_table_rows rows = {.first = look->running.point,
                                    .count = points->npoints,
                                    .size = sizeof *look->running.point};
    FRACAS_CLEARED(fracas_columns) columns = {0};
    FRACAS_CLEARED(fracas_result_table) table = {0};
    TRY(fracas_columns_create(points, &columns));
    TRY(fracas_table_empty(points->npoints, FRACAS_COUNT(point_columns) + 1,
                           (const char *const[FRACAS_COUNT(point_columns) + 1]){"point"}, &table));
    fracas_table_fill(&table, 1, point_columns, FRACAS_COUNT(point_columns), &rows, false);
    for (size_t p = 0; p < points->npoints; p++) {
        char label[FRACAS_CELL - 24];
        fracas_columns_label(points, &columns, p, label, sizeof label);
        snprintf(fracas_result_table_cell(&table, FRACAS_RESULT_TABLE_HEAD + p, 0), FRACAS_CELL,
                 "%zu %s", p, label);
    }
    putchar('\n');
    fracas_table_print(&table, "", 1, true, width, stdout);
    return FRACAS_OK;
}

static void print_long_ones(const fracas_look *look)
{
    if (look->nlong) fputs("\ncheckpoints   of realizations that compute for long\n", stdout);
    for (size_t i = 0; i < look->nlong; i++) {
        const fracas_checkpoint_head *head = &look->long_one[i].head;
        printf("  point %zu replica %" PRId64 ": %s, %.3g of at most %.3g us, %" PRId64
               " steps, %.0f s ago\n",
               look->long_one[i].point, head->replica, head->over ? "computed" : "computing",
               1e6 * head->time, 1e6 * head->end, head->steps, look->long_one[i].age);
    }
}

static fracas_err print_decisions(const fracas_look *look)
{
    bool first = true;
    for (size_t p = 0; p < look->campaign->npoints; p++) {
        const fracas_sequential_rule *rule = &look->campaign->point[p].rule;
        OWNED fracas_decision *decision = NULL;
        size_t count;
        if (rule->maximum == 0) continue;
        TRY(fracas_index_decisions(look->index, &look->campaign->point[p].hash, &decision, &count));
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

static void print_event(void *context, const char *time, const char *kind, const char *text)
{
    (void)context;
    printf("  %.19sZ  %-15s %s\n", time, kind, text);
}

static fracas_err print_events(const fracas_look *look)
{
    fputs("\nevents\n", stdout);
    return fracas_index_events(look->index, print_event, NULL);
}

static void print_counts(const fracas_look *look)
{
    const fracas_index_counts *all = &look->running.all;
    printf("realizations  %" PRId64 ": %" PRId64 " done, %" PRId64 " failed, %" PRId64
           " leased, %" PRId64 " planned\n",
           all->realizations, all->done, all->failed, all->leased, all->planned);
    if (isfinite(look->left))
        printf("pace          %.3g realizations/s, %s left\n", look->rate,
               fracas_duration_text(look->left).text);
    fputs("outcomes     ", stdout);
    for (int o = 0; o < FRACAS_NOUTCOMES; o++)
        if (all->outcome[o]) printf(" %" PRId64 " %s", all->outcome[o], fracas_outcome_name(o));
    printf("\nsegments      %" PRId64 ", %.1f MB\n", all->segments, (double)all->bytes / 1e6);
}

static fracas_err print_text(const fracas_look *look, int width)
{
    char state[FRACAS_STATE_TEXT];
    printf("study         %s of campaign %s\nstate         ", look->study, look->campaign->name);
    fracas_paint(look->complete && !look->running.all.failed ? FRACAS_GREEN
                 : fracas_look_going(look)                   ? FRACAS_CYAN
                                                             : FRACAS_YELLOW);
    fputs(fracas_look_state(look, state), stdout);
    fracas_paint(FRACAS_PLAIN);
    putchar('\n');
    if (look->parts > 1)
        printf("part          %d of %d: %" PRId64 " realizations, %" PRId64 " to be computed\n",
               look->part, look->parts, look->part_all, look->part_left);
    if (look->lock != FRACAS_LOCK_FREE)
        printf("lock          %s: %s\n", lock_text[look->lock], look->holder);
    print_counts(look);
    TRY(print_points(look, width));
    TRY(print_decisions(look));
    print_long_ones(look);
    bool first = true;
    if (!look->running.all.failed) return FRACAS_OK;
    return fracas_index_failures(look->index, &look->campaign->table, print_failure, &first);
}

/* ---- the command ---- */

static const fracas_option options[] = {
    {"json", NULL, "print it as JSON"},
    {"verbose", NULL, "also the events of its runs: starts, losses, decisions, ends"},
    {"watch", NULL, "look again and again until the study is computed"},
    FRACAS_INTERVAL_OPTION("2s"),
    FRACAS_WIDE_OPTION,
    {"prometheus", "FILE", "also write it to FILE for Prometheus, whole at each look"},
    {0}};

static fracas_err print_once(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    enum { SECONDS = 1 };
    const char *file = fracas_given(arguments, "prometheus");
    FRACAS_CLEARED(fracas_look) look = {0};
    OWNED double *cost = NULL;
    TRY(fracas_look_take(arguments->operand, campaign, NULL, &look));
    if (isfinite(look.left)) {
        TRY(fracas_look_costs(campaign, SECONDS, &cost));
        fracas_look_pace(&look, cost);
    }
    if (file) TRY(fracas_look_write_prometheus(&look, file));
    if (fracas_given(arguments, "json")) return fracas_look_write_json(&look, false, stdout);
    TRY(print_text(&look, fracas_cli_columns(arguments)));
    return fracas_given(arguments, "verbose") ? print_events(&look) : FRACAS_OK;
}

static fracas_err status(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    double interval = 2;
    TRY(fracas_watch_interval(arguments, "watch", &interval));
    if (!fracas_given(arguments, "watch")) return print_once(arguments, campaign);
    fracas_watch_view view = {.json = fracas_given(arguments, "json"),
                              .prometheus = fracas_given(arguments, "prometheus")};
    return fracas_watch(arguments->operand, interval, fracas_watch_show, &view);
}

const fracas_command fracas_command_status = {
    .name = "status",
    .operand = "STUDY",
    .doc = "Says how far STUDY is, point by point",
    .more = "\nIt only looks: it can be asked while the study is being computed, from another "
            "shell or host. With --watch a terminal shows a\n"
            "map of the replicas and their means; Ctrl-C ends that and leaves the run alone. "
            "Elsewhere each look is a line, with --json\n"
            "an object of one line.\n",
    .options = options,
    .run_on = status,
};
