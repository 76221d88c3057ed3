/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "base/json.h"
#include "base/param.h"
#include "campaigns/scheduler/clock.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/scheduler/worker/stand_in.h"
#include "campaigns/scheduler/tally.h"

#include <errno.h>
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    TASKS,
    POINTS,
    TASK_TIME,
    LONG_SHARE,
    LONG_TIME,
    JOBS,
    LEASE_TIME,
    SEGMENT_AGE,
    ISOLATION,
    STUDY,
    JSON
};
static const fracas_option options[] = {
    [TASKS] = {"tasks", "N", "realizations in all (10000)"},
    [POINTS] = {"points", "N", "points that they are of (1)"},
    [TASK_TIME] = {"task-time", "S", "s that one sleeps instead of computing (0)"},
    [LONG_SHARE] = {"long-share", "P", "share of them that take --long-time, 0 to 1 (0)"},
    [LONG_TIME] = {"long-time", "S", "s that those sleep (10)"},
    [JOBS] = {"jobs", "N", "workers (one a core)"},
    [LEASE_TIME] = {"lease-time", "S",
                    "lease so many that they take S seconds; 0: one batch of 8 (1)"},
    [SEGMENT_AGE] = {"segment-age", "S", "write a segment when it is S seconds old (5)"},
    [ISOLATION] = {"isolation", "lease|none", "a process for each lease, or none (lease)"},
    [STUDY] = {"study", "DIR",
               "make the study there, or go on with it, and keep it (a temporary one)"},
    [JSON] = {"json", NULL, "print the figures as JSON"},
};

typedef struct {
    int tasks, points;
    fracas_stand_in stand_in;
    fracas_run_options run;
    char text[FRACAS_STAND_IN_TEXT]; /* of stand_in */
    char file[PATH_MAX];
} bench;

static fracas_err read_options(const fracas_arguments *arguments, bench *b)
{
    int isolation = FRACAS_ISOLATION_LEASE;
    *b = (bench){.tasks = 10000, .points = 1, .stand_in = {.longer = 10}};
    fracas_run_options_init(&b->run);
    TRY(fracas_arguments_integer(arguments, TASKS, 1, INT_MAX, &b->tasks));
    TRY(fracas_arguments_integer(arguments, POINTS, 1, 10000, &b->points));
    TRY(fracas_arguments_real(arguments, TASK_TIME, 1.0, &b->stand_in.seconds));
    TRY(fracas_arguments_real(arguments, LONG_SHARE, 1.0, &b->stand_in.share));
    TRY(fracas_arguments_real(arguments, LONG_TIME, 1.0, &b->stand_in.longer));
    TRY(fracas_arguments_integer(arguments, JOBS, 1, INT_MAX, &b->run.jobs));
    TRY(fracas_arguments_real(arguments, LEASE_TIME, 1.0, &b->run.lease_seconds));
    TRY(fracas_arguments_real(arguments, SEGMENT_AGE, 1.0, &b->run.segment_age));
    TRY(fracas_arguments_word(arguments, ISOLATION, fracas_isolation_name, 2, &isolation));
    b->run.isolation = (fracas_isolation)isolation;
    if (b->stand_in.share > 1)
        return fracas_fail(FRACAS_USAGE, "bench: --long-share is %g; a share is 0 to 1",
                           b->stand_in.share);
    if (b->tasks % b->points)
        return fracas_fail(FRACAS_USAGE,
                           "bench: --tasks %d is no whole number for each of --points %d", b->tasks,
                           b->points);
    fracas_stand_in_write(&b->stand_in, b->text);
    b->run.stand_in = b->text;
    return FRACAS_OK;
}

/* ---- the campaign ---- */

/* Of the least that a campaign can be; the points differ in a rate that nothing comes of. */
static fracas_err write_campaign(const bench *b)
{
    FILE *out = fopen(b->file, "w");
    if (out)
        fprintf(out,
                "name: scheduler\nseed: 1\nmodel: bar\ngeometry: {ends: periodic, length: 10 mm, "
                "area: 1 mm2}\nmesh: {elements: 10}\n"
                "material: {young: 275 GPa, density: 2750 kg/m3}\ncohesive: {law: nitsche, "
                "fracture_energy: 100 J/m2, beta: 4}\n"
                "strength: {distribution: constant, value: 300 MPa}\nloading: {type: imposed-rate, "
                "rate: 1 1/s}\n"
                "time: {stop: settled, end: 300 ns, quiet: 50 ns, safety: 0.25}\noutput: {history: "
                "0}\nreplicas: %d\n",
                b->tasks / b->points);
    if (out && b->points > 1)
        fprintf(out, "sweep:\n  - loading.rate: {from: 1 1/s, to: 2 1/s, points: %d}\n", b->points);
    if (out && !fclose(out)) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT, "cannot write %s: %s", b->file, strerror(errno));
}

static fracas_err make_folder(const char *given, char folder[PATH_MAX - 16])
{
    const char *temporary = getenv("TMPDIR");
    if (given) {
        if (snprintf(folder, PATH_MAX - 16, "%s", given) >= PATH_MAX - 16)
            return fracas_fail(FRACAS_USAGE, "bench: the path of --study is too long");
        char campaign[PATH_MAX], file[PATH_MAX];
        snprintf(campaign, sizeof campaign, "%s/campaign.yaml", folder);
        snprintf(file, sizeof file, "%s/bench.yaml", folder);
        if (!access(campaign, F_OK) && access(file, F_OK))
            return fracas_fail(FRACAS_USAGE,
                               "bench: %s is the study of a campaign; choose another --study",
                               folder);
        if (!mkdir(folder, 0777) || errno == EEXIST) return FRACAS_OK;
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot create %s: %s; choose another --study",
                           folder, strerror(errno));
    }
    const int size = snprintf(folder, PATH_MAX - 16, "%s/fracas-bench-XXXXXX",
                              temporary && *temporary ? temporary : "/tmp");
    if (size < PATH_MAX - 16 && mkdtemp(folder)) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "cannot make a folder as %s: %s; set TMPDIR to where you may write", folder,
                       strerror(errno));
}

static int remove_one(const char *path, const struct stat *info, int type, struct FTW *place)
{
    (void)info, (void)type, (void)place;
    remove(path);
    return 0; /* what cannot be removed stays */
}

/* ---- the figures ---- */

/* Mean of all tasks, s. */
static double mean_seconds(const bench *b)
{
    double sum = 0;
    for (int p = 0; p < b->points; p++)
        for (int r = 0; r < b->tasks / b->points; r++)
            sum += fracas_stand_in_seconds(&b->stand_in, (uint64_t)p, r);
    return sum / b->tasks;
}

static double ratio(double a, double b)
{
    return b > 0 ? a / b : 0;
}

static void print_figures(const bench *b, const fracas_tally *t, double wall, bool as_json)
{
    const double work = t->rows * mean_seconds(b), working = t->computed - t->planned;
    const struct {
        const char *name, *text;
        double value;
    } figure[] = {
        {"workers", "workers", t->workers},
        {"tasks", "tasks of this run", t->rows},
        {"wall", "wall, mpirun and merge included [s]", wall},
        {"efficiency", "efficiency: time of tasks / (workers x wall)",
         ratio(work, t->workers * wall)},
        {"tasks_per_second", "tasks/s, of the wall", ratio(t->rows, wall)},
        {"planned", "until leases could be given [s]", t->planned},
        {"working", "giving out to the last worker's end [s]", working},
        {"working_efficiency", "efficiency in this", ratio(work, t->workers * working)},
        {"merging", "merge [s]", t->merging},
        {"around", "mpirun's start and end, and the parent [s]", wall - t->seconds},
        {"leases", "leases", t->leases},
        {"messages", "messages that rank 0 heard", t->messages},
        {"messages_per_second", "messages/s", ratio(t->messages, working)},
        {"giving", "s of rank 0 for a lease", ratio(t->giving, t->leases)},
        {"commits", "commits (segments)", t->commits},
        {"commits_per_second", "commits/s", ratio(t->commits, working)},
        {"committing", "s of rank 0 for a commit", ratio(t->committing, t->commits)},
        {"rows_per_commit", "rows of a commit", ratio(t->rows, t->commits)},
        {"busy", "rank 0: share of the time for leases and commits",
         ratio(t->giving + t->committing, working)},
        {"cpu", "rank 0: CPU time [s]", t->cpu},
        {"cpu_share", "rank 0: share of a core", ratio(t->cpu, t->seconds)},
        {"memory", "rank 0: memory, at most [bytes]", t->memory},
    };
    fracas_json json;
    fracas_json_begin(&json, stdout);
    if (as_json) fracas_json_object(&json, NULL);
    for (size_t i = 0; i < FRACAS_COUNT(figure); i++) {
        if (as_json) fracas_json_real(&json, figure[i].name, figure[i].value);
        else printf("%-50s %.6g\n", figure[i].text, figure[i].value);
    }
    if (as_json) fracas_json_close_object(&json);
    if (as_json) fracas_json_end(&json);
}

static fracas_err print_study(const bench *b, double wall, bool as_json)
{
    fracas_index *index;
    fracas_tally tally;
    bool found;
    TRY(fracas_index_open(b->run.study, false, &index));
    fracas_err err = fracas_tally_read(index, &found, &tally);
    fracas_index_close(index);
    TRY(err);
    if (!found)
        return fracas_fail(FRACAS_DAMAGED, "the run in %s has not left its figures in the index",
                           b->run.study);
    print_figures(b, &tally, wall, as_json);
    return FRACAS_OK;
}

/* ---- the run ---- */

/* The ranks get the folder by a --study behind the arguments of this process. */
static fracas_err run_in(bench *b, const fracas_arguments *arguments, const char *folder)
{
    char *argv[2 * FRACAS_MOST_OPTIONS + 8];
    int argc = 0;
    for (; argc < arguments->argc && argc < 2 * FRACAS_MOST_OPTIONS + 4; argc++)
        argv[argc] = arguments->argv[argc];
    argv[argc++] = "--study";
    argv[argc++] = (char *)(uintptr_t)folder;
    argv[argc] = NULL;
    bool ran;
    TRY(write_campaign(b));
    const double began = fracas_now();
    fracas_err err = fracas_run(&b->run, argc, argv, &ran);
    const double wall = fracas_now() - began;
    if (err && err != FRACAS_INTERRUPTED) return err;
    fracas_err verdict = print_study(b, wall, arguments->value[JSON]);
    return err ? err : verdict;
}

static fracas_err measure(const fracas_arguments *arguments)
{
    bench b;
    char folder[PATH_MAX - 16];
    bool ran;
    if (strcmp(arguments->operand, "scheduler"))
        return fracas_fail(FRACAS_USAGE, "bench: `%s` cannot be measured; `scheduler` can",
                           arguments->operand);
    TRY(read_options(arguments, &b));
    if (fracas_run_is_rank())
        snprintf(folder, sizeof folder, "%s",
                 arguments->value[STUDY] ? arguments->value[STUDY] : ".");
    else TRY(make_folder(arguments->value[STUDY], folder));
    b.run.study = folder;
    snprintf(b.file, sizeof b.file, "%s/bench.yaml", folder);
    b.run.file = b.file;
    if (fracas_run_is_rank()) return fracas_run(&b.run, arguments->argc, arguments->argv, &ran);
    fracas_err err = run_in(&b, arguments, folder);
    if (!arguments->value[STUDY]) nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
    return err;
}

const fracas_command fracas_command_bench = {
    .name = "bench",
    .operand = "WHAT",
    .doc = "Measures how fast this machine gives out work: WHAT is `scheduler`",
    .more = "\nThe whole machinery of `fracas run` works, on realizations that sleep instead of "
            "computing: mpirun, ranks, servers, leases,\n"
            "segments, index and merge. Because they sleep, more workers than cores measure the "
            "scheduler, not the machine. Which ones\n"
            "take --long-time depends on their names alone: every run has the same work. The "
            "figures are of rank 0.\n",
    .options = options,
    .noptions = FRACAS_COUNT(options),
    .run = measure,
};
