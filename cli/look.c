/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A look at a study, and looks at intervals. */
#include "cli/look.h"

#include "analysis/summary/statistics.h"
#include "base/text.h"
#include "campaigns/plan/plan.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/store/lock.h"
#include "cli/cli.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

/* ---- one look ---- */

static fracas_err take_checkpoint(void *context, const fracas_checkpoint_head *head, double age)
{
    fracas_look *look = context;
    const fracas_point_table *table = &look->campaign->table;
    size_t p = 0;
    while (p < table->npoints && !fracas_hash_equal(&table->point[p].hash, &head->point)) p++;
    if (p == table->npoints) return FRACAS_OK;
    TRY(fracas_grow(&look->long_one, sizeof *look->long_one, look->nlong, &look->room,
                    "the checkpoints"));
    look->long_one[look->nlong++] = (fracas_long_one){p, age, *head};
    return FRACAS_OK;
}

/* Counts the part of the study. */
static fracas_err count_part(fracas_look *look)
{
    OWNED fracas_index_row *row = NULL;
    size_t count;
    TRY(fracas_index_part(look->index, &look->part, &look->parts));
    look->part_all = look->running.all.realizations;
    look->part_left = fracas_index_missing(&look->running.all);
    if (look->parts < 2) return FRACAS_OK;
    TRY(fracas_index_rows(look->index, &look->campaign->table, &row, &count));
    count = fracas_run_part(look->part, look->parts, row, count);
    look->part_all = (int64_t)count;
    look->part_left = 0;
    for (size_t i = 0; i < count; i++)
        look->part_left += row[i].status == FRACAS_PLANNED || row[i].status == FRACAS_LEASED;
    return FRACAS_OK;
}

/* The costliest realizations come first, so costs tell more than numbers. */
void fracas_look_pace(fracas_look *look, const double *cost)
{
    const fracas_unfinished *running = &look->running;
    struct timespec clock;
    double computed = 0, work = 0, rest = 0;
    clock_gettime(CLOCK_REALTIME, &clock);
    const double now = (double)clock.tv_sec + 1e-9 * (double)clock.tv_nsec,
                 elapsed = fmax(now, running->run.latest) - running->run.began;
    for (size_t p = 0; p < running->npoints; p++) {
        const fracas_unfinished_point *point = &running->point[p];
        computed += (double)point->computed;
        work += (double)point->computed * (cost ? cost[p] : 1);
        rest += (double)fracas_index_missing(&point->counts) * (cost ? cost[p] : 1);
    }
    look->rate = look->left = NAN;
    if (!(elapsed > 0) || !(work > 0) || !fracas_look_going(look)) return;
    const double part = look->parts > 1 && fracas_index_missing(&running->all)
                            ? (double)look->part_left / (double)fracas_index_missing(&running->all)
                            : 1;
    look->rate = computed / elapsed;
    look->left = rest * part * elapsed / work;
}

fracas_err fracas_look_take(const char *study, const fracas_campaign *campaign, const double *cost,
                            fracas_look *look)
{
    *look = (fracas_look){.study = study, .campaign = campaign, .rate = NAN, .left = NAN};
    TRY(fracas_study_lock_state(study, &look->lock, look->holder));
    TRY(fracas_index_open(study, false, &look->index));
    TRY(fracas_unfinished_read(look->index, &campaign->table, fracas_look_going(look),
                               &look->running));
    TRY(count_part(look));
    TRY(fracas_checkpoints_each(study, take_checkpoint, look));
    fracas_look_pace(look, cost);
    if (fracas_index_missing(&look->running.all)) return FRACAS_OK; /* no file need be read */
    int64_t failed;
    return fracas_study_is_complete(study, look->index, campaign, &look->complete, &failed);
}

void fracas_look_clear(fracas_look *look)
{
    fracas_index_close(look->index);
    fracas_unfinished_clear(&look->running);
    free(look->long_one);
    *look = (fracas_look){0};
}

fracas_err fracas_look_costs(const fracas_campaign *campaign, double seconds, double **cost)
{
    const double end = fracas_now() + seconds;
    OWNED double *made = malloc((campaign->npoints + 1) * sizeof *made);
    *cost = NULL;
    if (!made) return fracas_no_memory("the costs of the points");
    for (size_t p = 0; p < campaign->npoints; p++) {
        if (fracas_now() > end) return FRACAS_OK;
        TRY(fracas_plan_cost(campaign, p, &made[p], NULL));
    }
    *cost = made;
    made = NULL;
    return FRACAS_OK;
}

bool fracas_look_going(const fracas_look *look)
{
    return look->lock == FRACAS_LOCK_HELD || look->lock == FRACAS_LOCK_ELSEWHERE;
}

bool fracas_look_over(const fracas_look *look)
{
    return look->lock != FRACAS_LOCK_HELD &&
           (look->complete || (look->parts > 1 && look->part_left == 0));
}

const char *fracas_look_state(const fracas_look *look, char text[FRACAS_STATE_TEXT])
{
    if (look->lock == FRACAS_LOCK_HELD) return "being computed";
    if (look->complete)
        return look->running.all.failed == 0 ? "complete" : "computed, some realizations FAILED";
    if (look->parts > 1 && look->part_left == 0)
        return "its part is complete: `fracas merge-studies` makes one study of all parts";
    /* not the user's file: the study may have been extended since */
    snprintf(text, FRACAS_STATE_TEXT,
             "interrupted: `fracas run %.2000s --study %.2000s` resumes it",
             fracas_shell_path(look->study, "campaign.yaml").text,
             fracas_shell_path(look->study, NULL).text);
    return text;
}

fracas_counts fracas_look_counts(const fracas_look *look)
{
    const fracas_index_counts *all = &look->running.all;
    const bool part = look->parts > 1;
    return (fracas_counts){.total = part ? look->part_all : all->realizations,
                           .done = part ? look->part_all - look->part_left - all->failed
                                        : all->done,
                           .failed = all->failed};
}

/* ---- at intervals ---- */

/* The campaign of a study, and its costs. */
typedef struct {
    fracas_campaign *campaign;
    double *cost;
    struct stat file; /* when they were read */
} known;

static void known_clear(known *k)
{
    fracas_campaign_destroy(k->campaign);
    free(k->cost);
}

static fracas_err know(const char *study, known *k)
{
    enum { SECONDS = 5 };
    char path[PATH_MAX];
    struct stat file;
    snprintf(path, sizeof path, "%s/campaign.yaml", study);
    if (k->campaign && (stat(path, &file) || (file.st_ino == k->file.st_ino &&
                                              file.st_mtim.tv_sec == k->file.st_mtim.tv_sec &&
                                              file.st_mtim.tv_nsec == k->file.st_mtim.tv_nsec)))
        return FRACAS_OK;
    known_clear(k);
    *k = (known){0};
    TRY(fracas_cli_read_campaign(study, &k->campaign));
    if (stat(path, &k->file)) k->file = (struct stat){0};
    return fracas_look_costs(k->campaign, SECONDS, &k->cost);
}

static fracas_err end_of(const fracas_look *look)
{
    char state[FRACAS_STATE_TEXT];
    if (!fracas_look_over(look))
        return fracas_fail(FRACAS_INTERRUPTED, "no run computes %s any more; %s", look->study,
                           fracas_look_state(look, state));
    const int64_t failed = look->running.all.failed;
    if (!failed) return FRACAS_OK;
    return fracas_fail(FRACAS_SOME_FAILED,
                       "%" PRId64 " realization%s of %s FAILED: `fracas status %s` has the reasons",
                       failed, failed == 1 ? "" : "s", look->study,
                       fracas_shell_path(look->study, NULL).text);
}

static void wait_for(double seconds)
{
    const struct timespec time = {(time_t)seconds, (long)(1e9 * (seconds - floor(seconds)))};
    nanosleep(&time, NULL);
}

/* *over: nothing changes any more. `idle` counts looks at a study that no run had, `lost` those at
 * an index that a run has not made or extended yet, or that is out of reach for the moment. */
static fracas_err look_once(const char *study, known *k, int *idle, int *lost,
                            fracas_look_show *show, void *context, bool *over)
{
    enum { PATIENCE = 5 }; /* a run that starts its ranks again is gone for a moment */
    FRACAS_CLEARED(fracas_look) look = {0};
    *over = false;
    TRY(know(study, k));
    const fracas_err err = fracas_look_take(study, k->campaign, k->cost, &look);
    if (err == FRACAS_IN_USE) return FRACAS_OK; /* the next look may be luckier */
    if (err == FRACAS_DAMAGED && fracas_look_going(&look) && ++*lost < PATIENCE) return FRACAS_OK;
    TRY(err);
    *lost = 0;
    *idle = fracas_look_going(&look) ? 0 : *idle + 1;
    *over = fracas_look_over(&look) || *idle >= PATIENCE;
    TRY(show(context, &look, *over));
    return *over ? end_of(&look) : FRACAS_OK;
}

fracas_err fracas_watch(const char *study, double interval, fracas_look_show *show, void *context)
{
    FRACAS_CLEARED(known) k = {0};
    int idle = 0, lost = 0;
    for (bool over;;) {
        TRY(look_once(study, &k, &idle, &lost, show, context, &over));
        if (over) return FRACAS_OK;
        wait_for(interval);
    }
}

fracas_err fracas_watch_interval(const fracas_arguments *arguments, const char *watch,
                                 double *seconds)
{
    const char *given = fracas_given(arguments, "interval");
    if (given && !fracas_given(arguments, watch))
        return fracas_fail(FRACAS_USAGE, "%s: --interval is for --%s: give both, or leave it out",
                           arguments->command->name, watch);
    return fracas_arguments_time(arguments, "interval", seconds);
}
