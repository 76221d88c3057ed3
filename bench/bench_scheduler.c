/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How fast this machine leases and commits work: a whole run (launcher, ranks, servers, leases,
 * segments, index, merge) of realizations that sleep instead of computing. Because they sleep, more
 * workers than cores measure the scheduler and not the machine. The numbers are those of rank 0.
 *
 *   bench_scheduler --jobs 2 --tasks 1000000 */
#include "bench/synthetic_load.h"

#include "base/json.h"
#include "base/param.h"
#include "campaigns/scheduler/director/timings.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/worker/solve.h"
#include "cli/cli.h"

#include <errno.h>
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const fracas_option options[] = {
    {"tasks", "N", "realizations in all (10000)"},
    {"points", "N", "points of the campaign (1)"},
    {"task-time", "S", "s that a realization sleeps (0)"},
    {"long-share", "P", "share of realizations that sleep --long-time, 0 to 1 (0)"},
    {"long-time", "S", "s that these sleep (10)"},
    {"jobs", "N", "workers (one a core)"},
    {"lease-time", "S", "s that a lease should take; 0: one batch of 8 (1)"},
    {"segment-age", "S", "write a segment when it is S seconds old (5)"},
    {"isolation", "lease|none", "a process for each lease, or none (lease)"},
    {"study", "DIR", "make or continue the study there, and keep it (a temporary one)"},
    {"json", NULL, "print the numbers as JSON"},
    {0}};

typedef struct {
    int tasks, points;
    fracas_run_options run;
    char file[PATH_MAX];
} bench;

static synthetic_load load = {.long_seconds = 10}; /* inherited by the processes of leases */

/* ---- the synthetic load, linked in the place of fracas_solve ---- */

static void sleep_for(double seconds)
{
    struct timespec rest = {.tv_sec = (time_t)seconds,
                            .tv_nsec = (long)(1e9 * (seconds - (double)(time_t)seconds))};
    while (nanosleep(&rest, &rest) && errno == EINTR)
        ;
}

fracas_err __wrap_fracas_solve(const fracas_computation *computation, const int64_t *replica,
                               size_t count, fracas_record *record);
fracas_err __wrap_fracas_solve(const fracas_computation *computation, const int64_t *replica,
                               size_t count, fracas_record *record)
{
    double seconds = 0;
    for (size_t i = 0; i < count; i++) {
        seconds += synthetic_seconds(&load, computation->lease->point, replica[i]);
        record[i] = (fracas_record){.outcome = FRACAS_INTACT};
    }
    if (seconds > 0) sleep_for(seconds);
    return FRACAS_OK;
}

/* ---- options ---- */

static fracas_err read_options(const fracas_arguments *arguments, bench *b)
{
    int isolation = FRACAS_ISOLATION_LEASE;
    *b = (bench){.tasks = 10000, .points = 1};
    fracas_run_options_init(&b->run);
    TRY(fracas_arguments_integer(arguments, "tasks", 1, INT_MAX, &b->tasks));
    TRY(fracas_arguments_integer(arguments, "points", 1, 10000, &b->points));
    TRY(fracas_arguments_real(arguments, "task-time", 1.0, &load.seconds));
    TRY(fracas_arguments_real(arguments, "long-share", 1.0, &load.long_part));
    TRY(fracas_arguments_real(arguments, "long-time", 1.0, &load.long_seconds));
    TRY(fracas_arguments_integer(arguments, "jobs", 1, INT_MAX, &b->run.jobs));
    TRY(fracas_arguments_real(arguments, "lease-time", 1.0, &b->run.lease_seconds));
    TRY(fracas_arguments_real(arguments, "segment-age", 1.0, &b->run.segment_age));
    TRY(fracas_arguments_word(arguments, "isolation", fracas_isolation_name, 2, &isolation));
    b->run.isolation = (fracas_isolation)isolation;
    if (load.long_part > 1)
        return fracas_fail(FRACAS_USAGE, "--long-share is %g; a share is 0 to 1", load.long_part);
    if (b->tasks % b->points)
        return fracas_fail(FRACAS_USAGE, "--tasks %d is no whole number for each of --points %d",
                           b->tasks, b->points);
    return FRACAS_OK;
}

/* ---- the campaign ---- */

/* The smallest possible bar; the points differ in a rate without effect. */
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
                "time: {stop: quiet, end: 300 ns, quiet: 50 ns, safety: 0.25}\noutput: {history: "
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
            return fracas_fail(FRACAS_USAGE, "the path of --study is too long");
        char campaign[PATH_MAX], file[PATH_MAX];
        snprintf(campaign, sizeof campaign, "%s/campaign.yaml", folder);
        snprintf(file, sizeof file, "%s/bench.yaml", folder);
        if (!access(campaign, F_OK) && access(file, F_OK))
            return fracas_fail(FRACAS_USAGE,
                               "%s is the study of a campaign; choose another --study", folder);
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
    return 0; /* the rest is removed all the same */
}

/* ---- the numbers ---- */

/* Mean of all tasks [s]. */
static double mean_seconds(const bench *b)
{
    double sum = 0;
    for (int p = 0; p < b->points; p++)
        for (int r = 0; r < b->tasks / b->points; r++)
            sum += synthetic_seconds(&load, (uint64_t)p, r);
    return sum / b->tasks;
}

static double ratio(double a, double b)
{
    return b > 0 ? a / b : 0;
}

static void print_numbers(const bench *b, const fracas_timings *t, double wall, bool as_json)
{
    const double work = t->rows * mean_seconds(b), working = t->computed - t->planned;
    const struct {
        const char *name, *text;
        double value;
    } number[] = {
        {"workers", "workers", t->workers},
        {"tasks", "tasks of this run", t->rows},
        {"wall", "wall, start and merge included [s]", wall},
        {"efficiency", "efficiency: time of tasks / (workers x wall)",
         ratio(work, t->workers * wall)},
        {"tasks_per_second", "tasks/s, of the wall", ratio(t->rows, wall)},
        {"planned", "until leases could be given [s]", t->planned},
        {"working", "first lease to the last worker's end [s]", working},
        {"working_efficiency", "efficiency in this", ratio(work, t->workers * working)},
        {"merging", "merge [s]", t->merging},
        {"around", "start and end of the ranks, and the launcher [s]", wall - t->seconds},
        {"leases", "leases", t->leases},
        {"messages", "messages to rank 0", t->messages},
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
    if (as_json) fracas_json_begin(&json, stdout);
    for (size_t i = 0; i < FRACAS_COUNT(number); i++) {
        if (as_json) fracas_json_real(&json, number[i].name, number[i].value);
        else printf("%-50s %.6g\n", number[i].text, number[i].value);
    }
    if (as_json) fracas_json_end(&json);
}

/* The numbers noted by rank 0 in its event `measured`. */
static const struct {
    const char *name;
    size_t at;
} timing[] = {
#define NUMBER(name)                          \
    {                                         \
#name, offsetof(fracas_timings, name) \
    }
    NUMBER(workers), NUMBER(seconds),    NUMBER(planned), NUMBER(computed), NUMBER(merging),
    NUMBER(giving),  NUMBER(committing), NUMBER(cpu),     NUMBER(memory),   NUMBER(messages),
    NUMBER(leases),  NUMBER(commits),    NUMBER(rows),
};

static fracas_err read_timings(fracas_index *index, bool *found, fracas_timings *timings)
{
    OWNED char *text = NULL;
    *timings = (fracas_timings){0};
    TRY(fracas_index_last_event(index, "measured", &text));
    *found = text != NULL;
    for (size_t i = 0; text && i < FRACAS_COUNT(timing); i++) {
        const char *at = strstr(text, timing[i].name);
        const double value = at ? strtod(at + strlen(timing[i].name), NULL) : 0;
        memcpy((char *)timings + timing[i].at, &value, sizeof value);
    }
    return FRACAS_OK;
}

static fracas_err print_study(const bench *b, double wall, bool as_json)
{
    fracas_index *index;
    fracas_timings timings;
    bool found;
    TRY(fracas_index_open(b->run.study, false, &index));
    fracas_err err = read_timings(index, &found, &timings);
    fracas_index_close(index);
    TRY(err);
    if (!found)
        return fracas_fail(FRACAS_DAMAGED, "the index of %s has no timings of the run",
                           b->run.study);
    print_numbers(b, &timings, wall, as_json);
    return FRACAS_OK;
}

/* ---- the run ---- */

/* The ranks get the folder by a --study behind the arguments of this process. */
static fracas_err run_in(bench *b, int argc, char **argv, const char *folder, bool as_json)
{
    char *words[2 * FRACAS_MOST_OPTIONS + 8];
    int n = 0;
    for (; n < argc && n < 2 * FRACAS_MOST_OPTIONS + 4; n++) words[n] = argv[n];
    words[n++] = "--study";
    words[n++] = (char *)(uintptr_t)folder;
    words[n] = NULL;
    FRACAS_CLEARED(fracas_run_facts) facts = {0};
    TRY(write_campaign(b));
    const double began = fracas_now();
    fracas_err err = fracas_run(&b->run, n, words, &facts);
    const double wall = fracas_now() - began;
    if (err && err != FRACAS_INTERRUPTED) return err;
    fracas_err printed = print_study(b, wall, as_json);
    return err ? err : printed;
}

static fracas_err measure(const fracas_arguments *arguments, int argc, char **argv)
{
    bench b;
    char folder[PATH_MAX - 16];
    FRACAS_CLEARED(fracas_run_facts) facts = {0};
    const char *study = fracas_given(arguments, "study");
    TRY(read_options(arguments, &b));
    if (fracas_run_is_rank()) snprintf(folder, sizeof folder, "%s", study ? study : ".");
    else TRY(make_folder(study, folder));
    b.run.study = folder;
    snprintf(b.file, sizeof b.file, "%s/bench.yaml", folder);
    b.run.file = b.file;
    if (fracas_run_is_rank()) return fracas_run(&b.run, argc, argv, &facts);
    fracas_err err = run_in(&b, argc, argv, folder, fracas_given(arguments, "json"));
    if (!study) nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
    return err;
}

int main(int argc, char **argv)
{
    static const fracas_command command = {.name = "bench_scheduler", .options = options};
    char *words[2 * FRACAS_MOST_OPTIONS + 8] = {argv[0], (char *)(uintptr_t)command.name};
    fracas_arguments arguments;
    int n = 2;
    for (int i = 1; i < argc && n < 2 * FRACAS_MOST_OPTIONS + 6; i++) words[n++] = argv[i];
    fracas_err err = fracas_arguments_read(&command, n, words, &arguments);
    if (!err && arguments.help)
        for (const fracas_option *o = options; o->name; o++)
            printf("  --%-12s %-11s %s\n", o->name, o->argument ? o->argument : "", o->doc);
    else if (!err) err = measure(&arguments, argc, argv);
    if (err) fprintf(stderr, "bench_scheduler: %s\n", fracas_message());
    return err;
}
